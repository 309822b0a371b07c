"""What a body is drawn for, and what a drawn body is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from sim.gel.gap import NO_BODY_MM

Parts = Callable[[FloatArray, FloatArray], NDArray[np.int64]]


@dataclass(frozen=True, slots=True, kw_only=True)
class PressRecipe:
    """What a body is drawn for.

    Attributes:
        depth_mm: Depth to which it will be pressed [mm].
        small: Whether the contact shall be a small one.
    """

    depth_mm: float
    small: bool


def no_parts(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
    """Parts of a surface without any."""
    return np.full(np.broadcast_shapes(u.shape, v.shape), -1)


@dataclass(frozen=True, slots=True, kw_only=True)
class HeightBody:
    """A body above the pad, in its own frame (u, v) [mm].

    Attributes:
        variant: Kind within its shape.
        behind_mm: Depth of its surface behind its foremost point; ``NO_BODY_MM`` beside it [mm].
        parts: Number of the part of the body at a point, negative beside them. A flat face is one.
        needed: Number of parts that must touch for the label to hold.
        textured: Whether its surface is broad enough for a relief.
        is_compact: Whether its contact can lie on the pad as a whole.
        max_tilt: Largest slope of its base [mm per mm]; flat faces have one by depth and size.
        extent_mm: Size of a flat face, for that slope; 0 for other bodies [mm].
    """

    variant: str
    behind_mm: Callable[[FloatArray, FloatArray], FloatArray]
    parts: Parts = no_parts
    needed: int = 1
    textured: bool = False
    is_compact: bool = True
    max_tilt: float = 0.0
    extent_mm: float = 0.0


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """A number whose logarithm is uniform between two limits."""
    return float(low * (high / low) ** rng.random())


def bevelled(distance: FloatArray, bevel: float, steep: float) -> FloatArray:
    """Flat face inside an outline, its rim bevelled over ``bevel`` [mm] with a slope."""
    return np.where(distance < 0, steep * (distance + bevel).clip(min=0), NO_BODY_MM)
