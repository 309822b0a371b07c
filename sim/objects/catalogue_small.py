"""The small objects: 20 pegs for holes and 35 indenters on round shanks, in mm.

They stand for the paper's self-made pegs and probes. Our choice: every shape of the vocabulary
occurs as an end, in more than one size, and every texture on several.
"""

from __future__ import annotations

from sim.objects.compounds import moved
from sim.objects.object import Family, Mount, Part, SolidObject
from sim.objects.primitives import (
    bars,
    block,
    bored,
    bumps,
    cone,
    crossing,
    dished,
    flat_bar,
    hexagonal,
    lattice,
    on_base,
    on_corner,
    oval,
    parallel,
    polygon,
    pyramid,
    rod,
    roof,
    rounded,
    taper,
    triangle,
    triangular,
    tube,
    waves,
)
from sim.objects.skins import SMOOTH, Skin, bumpy, ridged, rough, woven
from sim.objects.solids import Hoop, Solid

_LEVEL = (Mount(most_tilt_deg=1.0),)
_LEANING = (Mount(most_tilt_deg=15.0),)


def _peg(name: str, features: str, solid: Solid, skin: Skin = SMOOTH) -> SolidObject:
    return SolidObject(name, Family.PEG, features, (Part(solid, skin),), _LEVEL, 0.62)


def _indenter(
    name: str, features: str, solid: Solid, skin: Skin = SMOOTH, mounts: tuple[Mount, ...] = _LEVEL
) -> SolidObject:
    return SolidObject(name, Family.INDENTER, features, (Part(solid, skin),), mounts, 0.88)


def _shanked(name: str, features: str, pattern: Solid, diameter: float) -> SolidObject:
    """An indenter with a pattern on its shank."""
    return _indenter(name, features, on_base(pattern, diameter))


PEGS: tuple[SolidObject, ...] = (
    _peg("peg_round_4", "round, flat end", rod(4, 18)),
    _peg("peg_round_7", "round, flat end", rod(7, 22), rough(0.05, 0.45)),
    _peg("peg_round_11", "round, flat end", rod(11, 24), woven(0.12, 1.0)),
    _peg("peg_round_ribbed", "round, turned flat end", rod(9, 22), ridged(0.12, 1.0)),
    _peg("peg_tapered", "truncated cone, flat end", taper(5, 9, 20)),
    _peg("peg_square_5", "square", block(5, 5, 20)),
    _peg("peg_square_8", "square, sawn", block(8, 8, 22), ridged(0.1, 0.9)),
    _peg("peg_square_10", "square, cast", block(10, 10, 22), rough(0.06, 0.5)),
    _peg("peg_flat_6x10", "rectangular", block(10, 6, 22), woven(0.1, 0.9)),
    _peg("peg_flat_5x9", "rectangular", block(9, 5, 20)),
    _peg("peg_triangle_7", "equilateral triangle", triangular(polygon(3, 7.5), 20)),
    _peg(
        "peg_triangle_11",
        "equilateral triangle, cast",
        triangular(polygon(3, 11.5), 22),
        rough(0.045, 0.4),
    ),
    _peg("peg_triangle_right", "right-angled triangle", triangular(triangle(0, 110, 180, 5.2), 20)),
    _peg(
        "peg_triangle_scalene",
        "scalene triangle, dimpled",
        triangular(triangle(0, 95, 215, 6.4), 22),
        bumpy(0.12, 1.6),
    ),
    _peg("peg_hexagon_6", "hexagon", hexagonal(6.5, 20)),
    _peg("peg_hexagon_9", "hexagon, brushed", hexagonal(9.5, 22), ridged(0.08, 0.8)),
    _peg("peg_hexagon_12", "hexagon, cast", hexagonal(12, 22), rough(0.06, 0.55)),
    _peg("peg_bored_9", "round with a bore", bored(rod(9, 20), 4.2), ridged(0.1, 0.9)),
    _peg("peg_bored_square", "square with a bore", bored(block(10, 10, 20), 4.6)),
    _peg("peg_pipe", "thin-walled tube", tube(8, 5.8, 22)),
)

INDENTERS: tuple[SolidObject, ...] = (
    _indenter("ball_5", "ball end", rounded(2.5, 16, 5), mounts=_LEANING),
    _indenter("ball_9", "ball end", rounded(4.5, 18, 9), rough(0.04, 0.4), mounts=_LEANING),
    _indenter(
        "ball_16_studded", "ball end, studded", rounded(8, 18, 15.5), bumpy(0.12, 1.4), _LEANING
    ),
    _indenter("dome_50", "shallow dome", rounded(25, 14, 16), rough(0.05, 0.5), _LEANING),
    _indenter(
        "egg_tip_12x7",
        "ellipsoid end",
        moved(oval(12, 6.5, 9), z=-4.5),
        ridged(0.08, 0.7),
        mounts=_LEANING,
    ),
    _indenter(
        "egg_tip_17x9", "ellipsoid end", moved(oval(17, 9.4, 9), z=-4.5), woven(0.1, 0.8), _LEANING
    ),
    _indenter("egg_tip_26x16", "ellipsoid end", moved(oval(28, 15, 16), z=-8), rough(0.04, 0.4)),
    _indenter("cone_30", "cone, half-angle 30°", cone(30, 18), mounts=_LEANING),
    _indenter("cone_50", "cone, half-angle 50°", cone(50, 14), mounts=_LEANING),
    _indenter("pyramid_4_40", "four-sided pyramid", pyramid(4, 40, 16), mounts=_LEANING),
    _indenter("pyramid_6_52", "six-sided pyramid", pyramid(6, 52, 14), mounts=_LEANING),
    _indenter("chisel_70", "wedge, 70°, on its edge", roof(70, 10, 13)),
    _indenter("chisel_100", "wedge, 100°, on its edge", roof(100, 8, 22, 6)),
    _indenter(
        "cube_corner",
        "cube on its corner",
        moved(on_corner(9.0), z=-7.35),
        mounts=(Mount(most_tilt_deg=10.0),),
    ),
    _indenter(
        "three_faces",
        "blunt corner of three faces",
        pyramid(3, 48, 14),
        mounts=(Mount(most_tilt_deg=8.0),),
    ),
    _indenter("blade_10", "blade, 1 mm wide", flat_bar(10, 1.0)),
    _indenter("blade_16", "blade, 1.4 mm wide", flat_bar(16, 1.4)),
    _shanked("wire_7", "straight wire, 1 mm thick", bars([(-3.5, 0, 3.5, 0)], 1.0), 8),
    _shanked("cross_8", "two wires crossing", crossing(8, 8, 1.1), 10),
    _shanked("cross_12", "two wires crossing at 65°", crossing(12, 9, 1.3, 65), 13),
    _shanked("bars_2", "two parallel bars", parallel(2, 2.8, 9, 1.2), 11),
    _shanked("bars_3", "three parallel bars", parallel(3, 2.6, 8, 1.0), 11),
    _shanked("bars_5", "five parallel bars", parallel(5, 2.4, 11, 1.1), 16),
    _shanked("dots_3", "three bumps", bumps(polygon(3, 4.6), 1.6), 8),
    _shanked("dots_6", "two rows of three bumps", bumps(lattice(3, 2, 3.0), 1.4), 10),
    _shanked("dots_7", "seven bumps in a hexagon", bumps([(0, 0), *polygon(6, 7.0)], 1.5), 10.5),
    _shanked("dots_12", "twelve bumps", bumps(lattice(4, 3, 2.6, 0.5), 1.3), 13),
    _indenter("waves_33", "corrugated end, 3.3 mm", waves(11, 9, 3.3, 0.3)),
    _indenter("waves_5", "corrugated end, 5 mm", waves(17, 14, 5.0, 0.4), rough(0.035, 0.35)),
    _shanked("ring_6", "round wire ring", moved(Hoop(3.0, 0.6), z=-0.6), 8),
    _shanked("ring_10", "round wire ring", moved(Hoop(4.6, 0.7), z=-0.7), 11),
    _shanked("crescent_5", "half a wire ring", moved(Hoop(3.4, 0.6, 1.6), z=-0.6), 9),
    _shanked("crescent_8", "third of a wire ring", moved(Hoop(5.5, 0.7, 1.15), z=-0.7), 13),
    _indenter("cup_9", "round end with a hollow", dished(9.5, 16, 3.2, 1.9)),
    _indenter("hole_plate", "hexagonal end with a hole", bored(hexagonal(13, 16), 5)),
)

SMALL: tuple[SolidObject, ...] = (*PEGS, *INDENTERS)
