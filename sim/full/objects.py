"""The objects of the set: which there are, and which one each series presses.

Three families make every shape: ``parametric`` (height functions, all sizes drawn anew),
``scanned`` (irregular meshes of such) and ``assembled`` (solids of the paper's catalogue, resized,
with other edges). With them ``held``: berries, tomatoes, eggs and pegs as a gripper holds them; and
nothing.

Not here: how an object is drawn (``sim.full.drawn.faces`` and its neighbours).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache

import numpy as np

from cltp.tactile.states import Shape
from sim.full.drawn.bands import BANDS
from sim.full.drawn.dots import DOTS
from sim.full.drawn.faces import FACES, Draw
from sim.full.drawn.patterns import PATTERNS
from sim.full.drawn.rounds import ROUNDS
from sim.objects.catalogue import CATALOGUE, UNSEEN


class Origin(StrEnum):
    """Family of an object."""

    PARAMETRIC = "parametric"
    SCANNED = "scanned"
    ASSEMBLED = "assembled"
    HELD = "held"
    NOTHING = "nothing"


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """An object of the set.

    Attributes:
        name: Its name in data sets.
        origin: Its family.
        kind: Name by which it is drawn.
    """

    name: str
    origin: Origin
    kind: str


DRAWN: Mapping[Shape, Mapping[str, Draw]] = {
    shape: group[shape] for group in (FACES, BANDS, ROUNDS, PATTERNS, DOTS) for shape in group
}
DRAW_OF: Mapping[str, Draw] = {
    name: draw for group in DRAWN.values() for name, draw in group.items()
}

HELD_OUT: frozenset[str] = frozenset(
    {
        "cuboid_askew",
        "triangle_scalene",
        "hexagon_stretched",
        "disc_nicked",
        "plane_wavy",
        "ring_nut",
        "crescent_horseshoe",
        "hole_square",
        "sphere_cap",
        "ellipsoid_torus",
        "cylinder_flanks",
        "peak_stepped",
        "edge_bent",
        "corner_worn",
        "line_wavy",
        "cross_unequal",
        "stripes_fanned",
        "dots_spiral",
        "wave_uneven",
    }
)
"""Drawn objects that are in no training contact, one of each shape; of the catalogue ``UNSEEN``."""

HELD_KINDS = {"strawberry": 40, "cherry_tomato": 14, "egg": 14, "peg": 14}
"""Bodies that a gripper holds, and their slots in a cycle."""

SCANNED_OF_A_SHAPE = 3
NOTHING_SLOTS, SCANNED_SLOTS, PARAMETRIC_SLOTS = 15, 6, 16
MORE_SLOTS = {Shape.DOTS: 10, Shape.TRIANGLE: 6, Shape.STRIPES: 4, Shape.LINE: 2}
"""Slots of a cycle of series: of nothing; of a shape's scanned and parametric objects, and how many
more of shapes that are read badly on real frames. Each object of the catalogue has one. Our
choice."""


def _alternatives() -> list[list[Choice]]:
    """What each slot of a cycle can hold: in every cycle the next of its objects."""
    slots: list[list[Choice]] = [
        [Choice(name="nothing", origin=Origin.NOTHING, kind="nothing")]
    ] * NOTHING_SLOTS
    for shape, group in DRAWN.items():
        own = [
            Choice(name=name, origin=Origin.PARAMETRIC, kind=name)
            for name in group
            if name not in HELD_OUT
        ]
        held_out = [
            Choice(name=name, origin=Origin.PARAMETRIC, kind=name)
            for name in group
            if name in HELD_OUT
        ]
        scans = [
            Choice(name=f"scan_{each.name}", origin=Origin.SCANNED, kind=each.kind)
            for each in own[:SCANNED_OF_A_SHAPE]
        ]
        for first in range(PARAMETRIC_SLOTS + MORE_SLOTS.get(shape, 0)):
            slots.append([own[(first + i) % len(own)] for i in range(len(own))])
        for first in range(SCANNED_SLOTS):
            slots.append([scans[(first + i) % len(scans)] for i in range(len(scans))])
        slots.append(held_out)
    slots += [[Choice(name=o.name, origin=Origin.ASSEMBLED, kind=o.name)] for o in CATALOGUE]
    for kind, count in HELD_KINDS.items():
        slots += [[Choice(name=f"held_{kind}", origin=Origin.HELD, kind=kind)]] * count
    return slots


@cache
def _cycle() -> list[list[Choice]]:
    slots = _alternatives()
    return [slots[i] for i in np.random.default_rng(19).permutation(len(slots))]


def object_of(number: int) -> Choice:
    """The object of series ``number``, from 0."""
    slots = _cycle()
    options = slots[number % len(slots)]
    return options[number // len(slots) % len(options)]


def is_held_out(choice: Choice) -> bool:
    """Whether an object is in no training contact."""
    return choice.kind in (UNSEEN if choice.origin is Origin.ASSEMBLED else HELD_OUT)


def all_objects() -> list[Choice]:
    """Every object of the set once, but for nothing."""
    unique = {choice.name: choice for slot in _alternatives() for choice in slot}
    return [choice for choice in unique.values() if choice.origin is not Origin.NOTHING]
