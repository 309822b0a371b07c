"""Numeric goal of a grasp, for the teacher and for the lessons of the language model."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Band:
    """A closed interval; the unit is in the name of the bounded quantity.

    Raises:
        ValueError: A bound is not finite, or ``low`` is above ``high``.
    """

    low: float
    high: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low <= self.high):
            raise ValueError(f"a band needs finite low <= high, got {self.low} .. {self.high}")

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high


@dataclass(frozen=True, slots=True, kw_only=True)
class Goal:
    """Bands of the contact state in a good grasp.

    Attributes:
        force_n: Normal force estimated from the indentation [N].
        depth_mm: Largest indentation of the gel [mm]; the upper end guards against bruises.
        area_fraction: Fraction of the sensing area in contact, 0 to 1.
        x_mm: Position of the contact along the pad's x [mm].
        y_mm: Position of the contact along the pad's y [mm].
    """

    force_n: Band
    depth_mm: Band
    area_fraction: Band
    x_mm: Band
    y_mm: Band
