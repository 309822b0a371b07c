"""The objects of TCL3D: 55 small and 62 large ones, by name, and which of them are held out.

Not here: what they are built of (``sim.objects.primitives``, ``sim.objects.assemblies``).
"""

from __future__ import annotations

from sim.objects.catalogue_large import LARGE
from sim.objects.catalogue_small import SMALL
from sim.objects.object import Thing

THINGS: tuple[Thing, ...] = (*SMALL, *LARGE)

UNSEEN: frozenset[str] = frozenset(
    {
        "peg_round_7",
        "peg_hexagon_9",
        "peg_triangle_right",
        "egg_tip_12x7",
        "cone_50",
        "cross_12",
        "dots_6",
        "ring_10",
        "chisel_100",
        "sugar_box",
        "peach",
        "mug",
        "chips_can",
        "comb",
        "knurled_knob",
        "golf_ball",
    }
)
"""Objects that no training contact shows: 16 of all kinds and textures. Our choice."""


def thing_named(name: str) -> Thing:
    """Return the object called ``name``.

    Raises:
        ValueError: No object has this name; the message lists those that exist.
    """
    for thing in THINGS:
        if thing.name == name:
            return thing
    known = ", ".join(sorted(thing.name for thing in THINGS))
    raise ValueError(f"unknown object {name!r}; known: {known}")


if len({thing.name for thing in THINGS}) != len(THINGS):
    raise RuntimeError("two objects of the catalogue have one name")
if not {thing.name for thing in THINGS} >= UNSEEN:
    raise RuntimeError("an unseen object is not in the catalogue")
