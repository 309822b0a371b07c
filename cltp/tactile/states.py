"""The vocabulary of contact states: 19 shapes, 5 textures, 4 depths, 9 positions, 5 areas.

The paper (section 3.2) names the counts and some of the words; the others, and the limits between
classes, are our completion and stand beside each class below. Loads no torch.

Not here: computing a state from a cloud (``cltp.tactile.measure``), wording it
(``cltp.texts.captions``).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from cltp.tactile.sensors import SensorSpec


class Shape(StrEnum):
    """Local geometry of the object in contact."""

    SPHERE = "sphere"  # cap, ratio of principal curvatures below 1.4
    ELLIPSOID = "ellipsoid"  # cap, ratio 1.4 to 4
    CUBOID = "cuboid"  # flat punch, rectangular outline, aspect below 2.5
    TRIANGLE = "triangle"  # flat punch, triangular outline
    HEXAGON = "hexagon"  # flat punch, hexagonal outline
    DISC = "disc"  # flat punch, circular outline
    PEAK = "peak"  # cone or pyramid tip, half-angle 20-60°
    PLANE = "plane"  # flat, more than 80 % of the sensing area
    CYLINDER = "cylinder"  # side of a rod, radius at least 1.5 mm
    RING = "ring"  # annulus or torus
    CRESCENT = "crescent"  # part of one
    EDGE = "edge"  # dihedral of 60-120°
    CORNER = "corner"  # three faces
    LINE = "line"  # bar at most 1.5 mm wide
    CROSS = "cross"  # two bars crossing
    STRIPES = "stripes"  # two or more parallel bars
    DOTS = "dots"  # three or more bumps, pitch 2-5 mm
    WAVE = "wave"  # sinusoid, wavelength 3-6 mm
    HOLE = "hole"  # flat with a cavity


class Texture(StrEnum):
    """Fine relief on the surface in contact."""

    SMOOTH = "smooth"  # below 10 µm
    ROUGH = "rough"  # isotropic, σ 30-80 µm, correlation 0.3-0.6 mm
    RIDGED = "ridged"  # one direction, 0.05-0.2 mm high, period 0.6-1.5 mm
    BUMPY = "bumpy"  # caps 0.05-0.2 mm high, pitch 1-3 mm
    WOVEN = "woven"  # two crossed directions


class Depth(StrEnum):
    """Largest indentation."""

    SLIGHT = "slight"  # below 0.3 mm
    MODERATE = "moderate"  # 0.3-0.6 mm
    DEEP = "deep"  # 0.6-0.9 mm
    VERY_DEEP = "very deep"  # 0.9 mm and more


class Position(StrEnum):
    """Cell of the sensing area, in thirds, that holds the contact."""

    TOP_LEFT = "top-left"
    TOP_CENTER = "top-center"
    TOP_RIGHT = "top-right"
    MIDDLE_LEFT = "middle-left"
    CENTERED = "centered"
    MIDDLE_RIGHT = "middle-right"
    BOTTOM_LEFT = "bottom-left"
    BOTTOM_CENTER = "bottom-center"
    BOTTOM_RIGHT = "bottom-right"


class Area(StrEnum):
    """Fraction of the sensing area in contact."""

    TINY = "tiny"  # below 3 %
    SMALL = "small"  # 3-8 %
    MEDIUM = "medium"  # 8-15 %
    LARGE = "large"  # 15-30 %
    VERY_LARGE = "very large"  # 30 % and more


class Side(StrEnum):
    """A side of the pad, where it may cut a contact off."""

    TOP = "top"
    BOTTOM = "bottom"
    LEFT = "left"
    RIGHT = "right"

    @property
    def opposite(self) -> Side:
        return _OPPOSITE[self]


_OPPOSITE = dict(zip(Side, (Side.BOTTOM, Side.TOP, Side.RIGHT, Side.LEFT), strict=True))


DIMENSIONS: Mapping[str, type[StrEnum]] = {
    "shape": Shape,
    "texture": Texture,
    "depth": Depth,
    "position": Position,
    "area": Area,
}
"""The five dimensions of a contact state and their classes. Trained weights depend on the order."""

CLASSES: Mapping[str, list[str]] = {
    name: [word.value for word in words] for name, words in DIMENSIONS.items()
}
"""The classes of each dimension as plain text, in the order of a classifier's outputs."""

MEASURABLE = ("depth", "position", "area")
"""Dimensions that a cloud alone gives (``cltp.tactile.measure``); the others need an encoder."""

NUMBERS = ("depth_mm", "x_mm", "y_mm", "area_fraction", "force_n")
"""Numbers of a contact state that heads and probes read. Trained weights depend on the order."""

DEPTH_LIMITS_MM = (0.3, 0.6, 0.9)
AREA_LIMITS = (0.03, 0.08, 0.15, 0.30)

CUT_MM = 0.6
"""Length of border in contact from which a side cuts a contact. Our choice: a point of a cloud."""


def depth_word(depth_mm: float) -> Depth:
    """Class of an indentation [mm]."""
    return list(Depth)[sum(depth_mm >= limit for limit in DEPTH_LIMITS_MM)]


def area_word(fraction: float) -> Area:
    """Class of a fraction of the sensing area, 0 to 1."""
    return list(Area)[sum(fraction >= limit for limit in AREA_LIMITS)]


def position_word(x_mm: float, y_mm: float, sensor: SensorSpec) -> Position:
    """Cell, in thirds of the sensing area, of a point [mm, gel frame]."""
    column = sum(x_mm >= limit for limit in (-sensor.width_mm / 6, sensor.width_mm / 6))
    row = sum(y_mm <= limit for limit in (sensor.height_mm / 6, -sensor.height_mm / 6))
    return list(Position)[3 * row + column]


_CLOSE = 1e-6
"""Distance from a limit at which a number is still of the class below it; less than is written."""


def number_limits(
    words: Mapping[str, str], sensor: SensorSpec | None
) -> dict[str, tuple[float, float]]:
    """Least and greatest of the numbers that words stand for, by their names in ``NUMBERS``.

    Args:
        words: Words of ``MEASURABLE`` dimensions, others among them.
        sensor: The sensor; places have no limits where it is None.
    """
    limits = {
        "depth_mm": _limits(DEPTH_LIMITS_MM, CLASSES["depth"].index(words["depth"])),
        "area_fraction": _limits(AREA_LIMITS, CLASSES["area"].index(words["area"])),
    }
    if sensor is not None:
        row, column = divmod(CLASSES["position"].index(words["position"]), 3)
        x_mm, y_mm = sensor.width_mm / 6, sensor.height_mm / 6
        limits["x_mm"] = _limits((-x_mm, x_mm), column)
        limits["y_mm"] = _limits((-y_mm, y_mm), 2 - row)
    return limits


def _limits(limits: Sequence[float], number: int) -> tuple[float, float]:
    """Ends of one of the classes that limits part, in ascending order."""
    ends = (-math.inf, *limits, math.inf)
    return ends[number] + _CLOSE, ends[number + 1] - _CLOSE


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactState:
    """A contact in numbers and words.

    Attributes:
        depth_mm: Largest indentation [mm]; 0 without contact.
        x_mm, y_mm: Position [mm, gel frame]: the deepest point, and for flat contacts the centre of
            the footprint; 0, 0 without contact.
        area_fraction: Fraction of the sensing area in contact, 0 to 1.
        force_n: Normal force that the gel's shape suggests [N]; an estimate.
        depth, position, area: Classes of these numbers; None without contact.
        cut: Sides of the pad that the contact runs over.
        shape, texture: Classes from a learned encoder or a label; None without either.
    """

    depth_mm: float
    x_mm: float
    y_mm: float
    area_fraction: float
    force_n: float
    depth: Depth | None
    position: Position | None
    area: Area | None
    cut: frozenset[Side] = frozenset()
    shape: Shape | None = None
    texture: Texture | None = None

    @property
    def in_contact(self) -> bool:
        return self.depth is not None


_NOTHING: Mapping[str, Any] = dict.fromkeys(NUMBERS, 0.0) | dict.fromkeys(MEASURABLE)
NO_CONTACT_STATE = ContactState(**_NOTHING)
