"""The objects of TCL3D by name, 55 small and 62 large ones, and the ones that are held out.

Not here: their solids (``sim.objects.primitives``).
"""

from __future__ import annotations

from sim.objects.catalogue_large import LARGE
from sim.objects.catalogue_small import SMALL
from sim.objects.object import SolidObject

CATALOGUE: tuple[SolidObject, ...] = (*SMALL, *LARGE)
_BY_NAME = {obj.name: obj for obj in CATALOGUE}

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
"""Held-out objects, in no training contact: 16 of all kinds and textures. Our choice."""


def object_named(name: str) -> SolidObject:
    """Return the object called ``name``.

    Raises:
        ValueError: No object has this name; the message lists those that exist.
    """
    if name not in _BY_NAME:
        raise ValueError(f"unknown object {name!r}; known: {', '.join(sorted(_BY_NAME))}")
    return _BY_NAME[name]


if len(_BY_NAME) != len(CATALOGUE):
    raise RuntimeError("two objects of the catalogue have one name")
if not _BY_NAME.keys() >= UNSEEN:
    raise RuntimeError("an unseen object is not in the catalogue")
