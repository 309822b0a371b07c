"""The large objects: 36 from a household and 26 from a workshop, in mm.

They stand for the paper's scans, which are not public. Our choice: sizes are those of everyday
objects; where the YCB set has the object, its published size to a few mm, as far as analytic solids
allow.
"""

from __future__ import annotations

import math
from dataclasses import replace

from cltp.tactile.states import Shape
from sim.objects.compounds import Around, Blend, Hollow, Placed, along, moved
from sim.objects.faces import Form
from sim.objects.object import Family, Mount, Part, SolidObject
from sim.objects.primitives import (
    ball,
    block,
    bored,
    box,
    bumps,
    cone,
    crossing,
    flat_bar,
    hexagonal,
    lattice,
    lengthwise,
    oval,
    parallel,
    rod,
    rounded,
    taper,
    tube,
    waves,
)
from sim.objects.skins import SMOOTH, Skin, bumpy, ridged, rough, woven
from sim.objects.solids import Hoop, Rods, Solid


def _in_family(family: Family, *rows: SolidObject) -> tuple[SolidObject, ...]:
    return tuple(replace(row, family=family) for row in rows)


def _make(
    name: str,
    features: str,
    *solids: Solid | Part,
    skin: Skin = SMOOTH,
    mounted: float = 0.0,
    mount_at: tuple[float, float, float] = (0.0, 0.0, 0.0),
    soft_mpa: float | None = None,
) -> SolidObject:
    """An object of solids with one skin, or of parts with their own.

    ``mounted`` is the fraction of its presses in which its side +z faces the pad.
    """
    parts = tuple(one if isinstance(one, Part) else Part(one, skin) for one in solids)
    mounts = (Mount(point=mount_at, most_tilt_deg=1.0),) if mounted else ()
    return SolidObject(name, Family.HOUSEHOLD, features, parts, mounts, mounted, soft_mpa)


def _ribs(num: int, distance: float, low: float, high: float, radius: float) -> Around:
    """Round rods around z, at a distance from it, between two heights."""
    return Around(Rods((((distance, 0.0, low), (distance, 0.0, high)),), radius), num)


def _link() -> Solid:
    """A link of two half rings and two straight rods."""
    back = ((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0))
    bend = Hoop(4.0, 0.75, math.pi / 2)
    sides = Rods(
        (((-2.5, 4.0, 0), (2.5, 4.0, 0)), ((-2.5, -4.0, 0), (2.5, -4.0, 0))), 0.75, Form.LOOP
    )
    return moved(Blend((moved(bend, 2.5), Placed(bend, (-2.5, 0.0, 0.0), back), sides)), z=-0.75)


_CARD = rough(0.03, 0.6)

HOUSEHOLD = _in_family(
    Family.HOUSEHOLD,
    _make("cracker_box", "large carton", box(60, 160, 210, 0.5)),
    _make("sugar_box", "carton, rough", box(38, 89, 175, 0.5), skin=_CARD),
    _make("gift_box", "box in ribbed paper", box(70, 70, 50, 0.4), skin=ridged(0.08, 1.2)),
    _make("woven_basket", "wicker box", box(90, 60, 40, 1.2), skin=woven(0.2, 1.4)),
    _make("toy_block", "block of wood", box(13, 10, 30, 0.5), skin=ridged(0.07, 1.1)),
    _make("soup_can", "can", rod(66, 101, 0.8), skin=ridged(0.06, 1.5)),
    _make("chips_can", "tall can", rod(75, 150, 0.5), skin=rough(0.03, 0.5)),
    _make("tuna_can", "flat can", rod(85, 33, 1.0)),
    _make(
        "mustard_bottle",
        "bottle with a pointed cap",
        Blend((oval(58, 95, 240), moved(rod(28, 40), z=132)), 4.0),
        moved(cone(22, 22, 0.5, 17.0), z=152),
    ),
    _make(
        "water_bottle",
        "ribbed bottle",
        Part(rod(62, 120, 6.0), ridged(0.2, 1.5)),
        Part(moved(Blend((rod(28, 16, 0.8), _ribs(38, 14.0, -14.5, -1.5, 0.55))), z=12)),
    ),
    _make("banana", "banana", Hoop(75, 17, 0.75, Form.CURVED), soft_mpa=1.0),
    # a tube so thick that it closes to a ball with dimples
    _make("apple", "apple", Hoop(14, 24, form=Form.CURVED), soft_mpa=2.5),
    _make("orange", "orange, pimpled peel", ball(74), skin=bumpy(0.08, 1.8), soft_mpa=1.2),
    _make(
        "lemon",
        "lemon, rough peel",
        Blend((oval(60, 46, 46), moved(ball(14), x=29), moved(ball(10), x=-29)), 5.0),
        skin=bumpy(0.06, 1.2),
        soft_mpa=1.2,
    ),
    _make("peach", "peach, furry", ball(60), skin=rough(0.04, 0.35), soft_mpa=0.8),
    _make("pear", "pear", Blend((ball(62), moved(ball(38), z=40)), 12.0), soft_mpa=1.5),
    _make("plum", "plum", oval(40, 38, 38), soft_mpa=1.0),
    _make(
        "strawberry",
        "strawberry with seeds",
        Blend((oval(32, 32, 30), moved(ball(14), z=-13)), 6.0),
        skin=bumpy(0.1, 2.6),
        soft_mpa=0.5,
    ),
    _make("egg", "hen's egg", oval(44, 44, 58)),
    _make("tennis_ball", "felt ball", ball(66), skin=rough(0.08, 0.6), soft_mpa=1.5),
    _make("golf_ball", "dimpled ball", ball(42.7), skin=bumpy(0.18, 2.9)),
    _make("marble_25", "glass ball", ball(25)),
    _make(
        "mug",
        "mug with a handle",
        Hollow(rod(82, 90, 1.0, Shape.CRESCENT), moved(rod(74, 86, 1.0), z=0.5)),
        moved(along("y", Hoop(24, 5, 1.5, Form.CURVED)), 41, 0, -45),
    ),
    _make("napkin_ring", "band", tube(12.4, 10, 24), mounted=0.55),
    _make(
        "fork",
        "fork",
        parallel(4, 4.4, 46, 1.5),
        Rods((((26.0, -7.0, -1.2), (26.0, 7.0, -1.2)),), 2.0, Form.CURVED),
        moved(box(90, 12, 3, 1.0), 72, 0, -1.8),
        mounted=0.6,
    ),
    _make("spoon", "spoon", oval(32, 55, 14), moved(along("y", lengthwise(5, 110)), 0, 130, 2)),
    _make("kitchen_knife", "blade, 1.2 mm thick", flat_bar(120, 1.2, 30), mounted=0.55),
    _make(
        "spatula",
        "slotted turner",
        parallel(8, 3.4, 60, 1.4),
        moved(box(16, 28, 1.4, 0.4), 38, 0, -0.8),
        moved(box(8, 28, 1.4, 0.4), -34, 0, -0.8),
        mounted=0.55,
    ),
    _make(
        "pencil",
        "round rod with a point",
        cone(26, 6.9, 0.3, 7.4),
        moved(rod(7.4, 100), z=-6.7),
        mounted=0.35,
    ),
    _make("marker", "round pen", lengthwise(16, 110), moved(rod(9, 14), z=20)),
    _make("sponge", "sponge", box(95, 62, 26, 4.0), skin=rough(0.05, 0.32), soft_mpa=0.3),
    _make("rope", "rope, laid", along("x", moved(lengthwise(12, 120), z=60)), skin=woven(0.2, 1.5)),
    _make(
        "hairbrush",
        "brush with balls",
        moved(bumps(lattice(9, 6, 4.0, 0.5), 2.0), z=7.0),
        moved(box(66, 36, 8, 2.0), z=1.2),
        mounted=0.75,
        mount_at=(0, 0, 7),
    ),
    _make(
        "comb",
        "comb",
        parallel(17, 2.5, 34, 1.2),
        moved(box(10, 44, 3, 0.8), 21, 0, -1.6),
        mounted=0.65,
    ),
    _make("soap", "oval bar of soap, knobbed", oval(85, 55, 30), skin=bumpy(0.12, 2.4)),
    _make("cork", "cork", taper(13, 15.5, 28, 0.6), skin=rough(0.07, 0.5)),
)

INDUSTRIAL = _in_family(
    Family.INDUSTRIAL,
    _make(
        "bolt_m12",
        "bolt with a hexagonal head",
        hexagonal(13.8, 7.5, 0.4),
        Part(moved(rod(9, 45), z=-7.4), ridged(0.2, 1.5)),
        mounted=0.5,
    ),
    _make("nut_m8", "hexagonal nut", bored(hexagonal(14.5, 7, 0.4), 8), mounted=0.5),
    _make("washer_m8", "washer", tube(16, 8.4, 1.6, 0.2), mounted=0.6),
    _make("retaining_ring", "open ring", moved(Hoop(5.6, 0.75, 2.0), z=-0.75), mounted=0.75),
    _make("chain_link", "oval link", _link(), mounted=0.6),
    _make("o_ring", "rubber ring", moved(Hoop(5.2, 0.75), z=-0.75), mounted=0.75),
    _make("shackle", "bent rod", Hoop(14, 3.5, 1.7, Form.CURVED), skin=rough(0.05, 0.4)),
    _make(
        "castor",
        "wheel with a round tread",
        Blend((Hoop(20, 12, form=Form.CURVED), rod(36, 8)), 1.0),
        skin=ridged(0.1, 1.2),
    ),
    _make(
        "belt_pulley",
        "wheel with narrow teeth",
        Blend((rod(40, 24, 0.5), _ribs(38, 21.0, -23.0, -1.0, 0.7))),
    ),
    _make(
        "heat_sink",
        "fins",
        parallel(9, 2.8, 30, 1.1),
        moved(box(32, 26, 6, 0.4), z=-7.0),
        mounted=0.75,
    ),
    _make("corrugated_sheet", "corrugated sheet", waves(90, 90, 5.5, 0.45), mounted=0.85),
    _make(
        "corrugated_hose",
        "hose with rings",
        Blend(tuple(moved(Hoop(13.0, 1.0, form=Form.BAR), z=3.6 * i - 43.2) for i in range(13))),
        moved(rod(25, 90), z=45.0),
    ),
    _make("file", "flat file", box(40, 150, 8, 0.4), skin=woven(0.1, 0.7)),
    _make("rasp", "round rasp", along("x", moved(rod(24, 120, 1.0), z=60)), skin=bumpy(0.2, 2.2)),
    _make("hexagonal_bar", "hexagonal bar", along("x", moved(hexagonal(21, 100, 0.5), z=50))),
    _make("dowel", "wooden rod", along("x", moved(rod(8, 100), z=50)), skin=rough(0.035, 0.5)),
    _make("pipe", "pipe", along("x", moved(tube(34, 28, 120, 0.6), z=60)), skin=rough(0.05, 0.5)),
    _make(
        "flange",
        "disc with a bore",
        bored(rod(14.4, 9, 0.5), 6.0),
        skin=ridged(0.07, 0.9),
        mounted=0.3,
    ),
    _make("knurled_knob", "knurled knob", rod(24, 16, 1.2), skin=woven(0.15, 1.1)),
    _make("rubber_foot", "dome", rounded(14, 12, 26), skin=bumpy(0.1, 1.5), soft_mpa=3.0),
    _make("ball_knob", "ball on a rod", ball(24), moved(rod(8, 40), z=-10)),
    _make(
        "angle_bar",
        "angle, sharp outside",
        Blend((moved(box(40, 3, 100, 0.3), 20, 1.5), moved(box(3, 40, 100, 0.3), 1.5, 20))),
        skin=rough(0.04, 0.5),
    ),
    _make("square_bar", "square bar", box(24, 24, 120, 0.5), skin=ridged(0.08, 0.7)),
    _make(
        "centre_punch",
        "punch with a point",
        Blend((cone(35, 9.0, 0.3, 12.0), moved(rod(12, 80), z=-8.0))),
        mounted=0.5,
    ),
    _make(
        "phillips_driver",
        "cross tip, ribbed handle",
        crossing(5.4, 5.4, 1.2),
        moved(rod(6.2, 60), z=-1.4),
        Part(moved(rod(26, 70, 4.0), z=-58.0), rough(0.03, 0.4)),
        _ribs(18, 13.0, -120.0, -66.0, 0.75),
        mounted=0.5,
    ),
    _make(
        "perforated_plate",
        "plate with a hole",
        bored(block(14, 12, 9), 5.5),
        skin=woven(0.08, 0.9),
        mounted=0.4,
    ),
)

LARGE: tuple[SolidObject, ...] = (*HOUSEHOLD, *INDUSTRIAL)
