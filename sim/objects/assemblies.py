"""Solids of several pieces for single objects of the catalogue, in mm.

Not here: pieces that more than one object uses (``sim.objects.primitives``).
"""

from __future__ import annotations

import math

from cltp.tactile.states import Shape
from sim.objects.booleans import Around, Blend, Hollow
from sim.objects.faces import Form
from sim.objects.object import Part
from sim.objects.placing import Placed, along, moved
from sim.objects.primitives import (
    ball,
    box,
    bumps,
    cone,
    crossing,
    hexagonal,
    lattice,
    oval,
    parallel,
    rod,
)
from sim.objects.skins import SMOOTH, ridged, rough
from sim.objects.solids import Hoop, Rods, Solid


def mug() -> tuple[Solid, ...]:
    """A mug, open at +z, with a handle."""
    wall = Hollow(rod(82, 90, 1.0, Shape.CRESCENT), moved(rod(74, 86, 1.0), z=0.5))
    handle = moved(along("y", Hoop(24, 5, 1.5, Form.CURVED)), 41, 0, -45)
    return wall, handle


def apple() -> Solid:
    """A tube so thick that it closes to a ball with dimples."""
    return Hoop(14, 24, form=Form.CURVED)


def lemon() -> Solid:
    """An ellipsoid with two nipples."""
    return Blend((oval(60, 46, 46), moved(ball(14), x=29), moved(ball(10), x=-29)), 5.0)


def pear() -> Solid:
    """Two blended balls."""
    return Blend((ball(62), moved(ball(38), z=40)), 12.0)


def strawberry() -> Solid:
    """Round at the top, pointed below."""
    return Blend((oval(32, 32, 30), moved(ball(14), z=-13)), 6.0)


def mustard_bottle() -> Solid:
    """An oval bottle with shoulders and a neck."""
    return Blend((oval(58, 95, 240), moved(rod(28, 40), z=132)), 4.0)


def ribbed_cap(diameter: float, height: float, num: int, rib: float) -> Solid:
    """A screw cap with ribs along its side."""
    side = Rods((((diameter / 2, 0.0, -height + 1.5), (diameter / 2, 0.0, -1.5)),), rib / 2)
    return Blend((rod(diameter, height, 0.8), Around(side, num)))


def fork() -> tuple[Solid, ...]:
    """Four tines along x, and a handle."""
    tines = parallel(4, 4.4, 46, 1.5)
    handle = Rods((((26.0, -7.0, -1.2), (26.0, 7.0, -1.2)),), 2.0, Form.CURVED)
    return tines, handle, moved(box(90, 12, 3, 1.0), 72, 0, -1.8)


def spatula() -> tuple[Solid, ...]:
    """A turner of slats along x, framed at both ends."""
    slats = parallel(8, 3.4, 60, 1.4)
    return (
        slats,
        moved(box(16, 28, 1.4, 0.4), 38, 0, -0.8),
        moved(box(8, 28, 1.4, 0.4), -34, 0, -0.8),
    )


def pencil() -> tuple[Solid, ...]:
    """A round rod with a sharpened end."""
    return cone(26, 6.9, 0.3, 7.4), moved(rod(7.4, 100), z=-6.7)


def hairbrush() -> tuple[Solid, ...]:
    """Round pins on a plate."""
    pins = moved(bumps(lattice(9, 6, 4.0, 0.5), 2.0), z=7.0)
    return pins, moved(box(66, 36, 8, 2.0), z=1.2)


def comb() -> tuple[Solid, ...]:
    """Teeth along x and a spine."""
    return parallel(17, 2.5, 34, 1.2), moved(box(10, 44, 3, 0.8), 21, 0, -1.6)


def link() -> Solid:
    """A link of two half rings and two straight rods."""
    back = ((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0))
    bend = Hoop(4.0, 0.75, math.pi / 2)
    sides = Rods(
        (((-2.5, 4.0, 0), (2.5, 4.0, 0)), ((-2.5, -4.0, 0), (2.5, -4.0, 0))), 0.75, Form.LOOP
    )
    return moved(Blend((moved(bend, 2.5), Placed(bend, (-2.5, 0.0, 0.0), back), sides)), z=-0.75)


def pulley() -> Solid:
    """A wheel for a toothed belt: 38 narrow round teeth, 24 mm long."""
    tooth = Rods((((21.0, 0.0, -23.0), (21.0, 0.0, -1.0)),), 0.7)
    return Blend((rod(40, 24, 0.5), Around(tooth, 38)))


def heat_sink() -> tuple[Solid, ...]:
    """Fins along x on a base."""
    return parallel(9, 2.8, 30, 1.1), moved(box(32, 26, 6, 0.4), z=-7.0)


def hose() -> tuple[Solid, ...]:
    """A hose with rings around it."""
    rings = tuple(moved(Hoop(13.0, 1.0, form=Form.BAR), z=3.6 * i - 43.2) for i in range(13))
    return Blend(rings), moved(rod(25, 90), z=45.0)


def angle_bar() -> Solid:
    """Two plates at a right angle, 3 mm thick."""
    return Blend((moved(box(40, 3, 100, 0.3), 20, 1.5), moved(box(3, 40, 100, 0.3), 1.5, 20)))


def centre_punch() -> Solid:
    """A rod with a point."""
    return Blend((cone(35, 9.0, 0.3, 12.0), moved(rod(12, 80), z=-8.0)))


def phillips_driver() -> tuple[Part, ...]:
    """A cross tip on a shaft, and a ribbed handle."""
    shaft = moved(rod(6.2, 60), z=-1.4)
    handle = moved(rod(26, 70, 4.0), z=-58.0)
    rib = Rods((((13.0, 0.0, -120.0), (13.0, 0.0, -66.0)),), 0.75)
    return (
        Part(crossing(5.4, 5.4, 1.2)),
        Part(shaft),
        Part(handle, rough(0.03, 0.4)),
        Part(Around(rib, 18)),
    )


def bolt() -> tuple[Part, ...]:
    """A hexagonal head on a threaded shank."""
    return (
        Part(hexagonal(13.8, 7.5, 0.4), SMOOTH),
        Part(moved(rod(9, 45), z=-7.4), ridged(0.2, 1.5)),
    )
