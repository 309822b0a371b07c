"""What the objects of the set are drawn for, and the surface that a drawn object has.

A surface is a height function over its own plane (u, v) [mm]: the depth behind its foremost point,
``NO_BODY_MM`` beside it. Its elements (a flat face, a bar, a dot, an arm, a crest) are numbered.

Not here: pose and press (``sim.full.series``), labels (``sim.full.labels``).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.gel.gap import NO_BODY_MM

Height = Callable[[FloatArray, FloatArray], FloatArray]
Elements = Callable[[FloatArray, FloatArray], NDArray[np.int64]]
Option = TypeVar("Option")

BASE_MM = 2.2
"""Depth of what carries a pattern, behind its tops: out of reach of the deepest press."""


class Draws:
    """Random numbers of one object, and what it is drawn for.

    Args:
        rng: Random generator.
        lightest_mm: Depth of its lightest press [mm].
        small: Whether its contact shall be small.
        scale: Size of the sensing area over that of a GelSight Mini.
    """

    def __init__(
        self, rng: np.random.Generator, *, lightest_mm: float, small: bool, scale: float
    ) -> None:
        self.rng, self.lightest_mm, self.small, self.scale = rng, lightest_mm, small, scale

    def uniform(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def log(self, low: float, high: float) -> float:
        """A number whose logarithm is uniform between two limits."""
        return float(low * (high / low) ** self.rng.random())

    def size(self, low: float, high: float, small: tuple[float, float]) -> float:
        """A length that grows with the sensing area [mm], from its own limits if small."""
        if self.small:
            return self.log(*small)
        return self.log(low, high * self.scale)

    def chance(self, fraction: float) -> bool:
        return bool(self.rng.random() < fraction)

    def one_of(self, options: Sequence[Option]) -> Option:
        return options[int(self.rng.integers(len(options)))]

    def count(self, low: int, high: int) -> int:
        """A whole number, both limits included."""
        return int(self.rng.integers(low, high + 1))


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """A drawn object.

    Attributes:
        shape: Label of a contact that shows the object as it was drawn.
        behind_mm: Its height function.
        elements: Number of the element at a position, negative beside them.
        needed: Number of elements that must touch for the label to hold.
        extent_mm: Radius about the origin that holds it, or the part that makes its label [mm].
        is_flat: Whether it is one flat face, which must touch as a whole.
        is_compact: Whether its contact can lie on the pad as a whole.
        can_be_textured: Whether it is broad enough for a relief.
        largest_lean: Largest slope of its base at which the label holds; flat faces and patterns
            have one by the depth of the press.
    """

    shape: Shape
    behind_mm: Height
    elements: Elements
    needed: int = 0
    extent_mm: float
    is_flat: bool = False
    is_compact: bool = True
    can_be_textured: bool = False
    largest_lean: float = 0.0


def no_elements(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
    """Elements of a surface without any."""
    return np.full(np.broadcast_shapes(np.shape(u), np.shape(v)), -1, dtype=np.int64)


def dome(squared: FloatArray, radius: float, opening: float) -> FloatArray:
    """Round tip of curvature 1 / radius, over the squared distance from it.

    Args:
        squared: Squared distance [mm²].
        radius: Radius of curvature at the tip [mm].
        opening: -1 is a ball, 0 a paraboloid, above 0 a hyperboloid.
    """
    if abs(opening) < 1e-3:
        return np.asarray(squared / (2 * radius))
    inside = 1 + opening * squared / radius**2
    behind = (np.sqrt(inside.clip(min=0)) - 1) * (radius / opening)
    return np.where(inside > 0, behind, NO_BODY_MM)


def round_bar(distance: FloatArray, half: float) -> FloatArray:
    """Round bar over the distance from its middle line."""
    inside = 1 - (distance / half) ** 2
    return np.where(inside > 0, half * (1 - np.sqrt(inside.clip(min=0))), NO_BODY_MM)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rim:
    """Profile of the rim of a flat face, over the signed distance from its outline.

    Attributes:
        width_mm: Distance from the outline to the flat face [mm].
        slope: Slope of a chamfer; 0 is a round edge.
        wall: Slope of the wall beyond; 0 is an upright one.
    """

    width_mm: float
    slope: float = 0.0
    wall: float = 0.0

    @classmethod
    def draw(cls, draws: Draws, half_width_mm: float) -> Rim:
        """Draw a rim that leaves most of a face of a half width flat."""
        widest = min(0.15 if draws.small else 0.55, 0.4 * half_width_mm)
        width = draws.log(min(0.04, 0.5 * widest), widest)
        slope = draws.uniform(0.4, 2.2) if draws.chance(0.4) else 0.0
        wall = draws.uniform(1.2, 6.0) if draws.chance(0.35) else 0.0
        return cls(width_mm=width, slope=slope, wall=wall)

    def behind(self, distance: FloatArray) -> FloatArray:
        over = ((distance + self.width_mm) / self.width_mm).clip(0, 1)
        if self.slope:
            edge, end = self.slope * self.width_mm * over, self.slope * self.width_mm
        else:
            edge, end = self.width_mm * (1 - np.sqrt(1 - over**2)), self.width_mm
        if not self.wall:
            return np.where(distance < 0, edge, NO_BODY_MM)
        down = end + self.wall * distance
        return np.where(distance < 0, edge, np.where(down < 4.0, down, NO_BODY_MM))


def face(
    shape: Shape,
    outline: Height,
    draws: Draws,
    *,
    half_width_mm: float,
    extent_mm: float,
    is_compact: bool = True,
    can_be_textured: bool = True,
) -> Surface:
    """A flat face within an outline, its rim and a slight crown drawn.

    Args:
        shape: Its label.
        outline: Signed distance [mm].
        draws: Random numbers.
        half_width_mm: Half of its least width [mm].
        extent_mm: See ``Surface``.
        is_compact: See ``Surface``.
        can_be_textured: See ``Surface``; small faces are smooth.
    """
    rim = Rim.draw(draws, half_width_mm)
    # A crown drops by a quarter of the lightest press at most: the whole face still touches.
    crown = draws.uniform(0, 0.25) * draws.lightest_mm / extent_mm**2 if draws.chance(0.3) else 0.0

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        return rim.behind(outline(u, v)) + crown * (u**2 + v**2)

    def elements(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
        return np.where(outline(u, v) < -rim.width_mm, 0, -1)

    return Surface(
        shape=shape,
        behind_mm=behind,
        elements=elements,
        needed=1,
        extent_mm=extent_mm,
        is_flat=True,
        is_compact=is_compact,
        can_be_textured=can_be_textured and not draws.small,
    )


def radians(*degrees: float) -> FloatArray:
    """Angles in radians."""
    return np.array([math.radians(each) for each in degrees])
