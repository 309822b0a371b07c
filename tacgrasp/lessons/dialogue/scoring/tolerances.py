"""How far a number in an answer may be off."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerance:
    """How far a number may be off: in its unit, or as a fraction of it, whichever is more."""

    absolute: float = 0.0
    fraction: float = 0.0

    def of(self, value: float) -> float:
        """Largest error of a value."""
        return max(self.absolute, self.fraction * abs(value))

    def times(self, scale: float) -> Tolerance:
        """The same of values in a unit that is so many times smaller."""
        return Tolerance(absolute=self.absolute * scale, fraction=self.fraction)


TOLERANCES: Mapping[str, Tolerance] = {
    "x_mm": Tolerance(absolute=1.0),
    "y_mm": Tolerance(absolute=1.0),
    "depth_mm": Tolerance(absolute=0.05, fraction=0.15),
    "area_percent": Tolerance(absolute=1.0, fraction=0.25),
    "area_mm2": Tolerance(absolute=3.0, fraction=0.25),
    "force_n": Tolerance(absolute=0.1, fraction=0.25),
    "holds_g": Tolerance(absolute=5.0, fraction=0.25),
    "gram_n": Tolerance(absolute=0.01, fraction=0.02),
}
"""Tolerance of a number by a name in its truth; 2 % where none of these is in it.

Source: single frames of an uncalibrated unit (``cltp.texts.tolerances``); of the force our choice:
the depth scale of units, ±15 %, and drift allow no less."""

EXACT = Tolerance(fraction=0.02)


def tolerance_of(names: Collection[str]) -> Tolerance:
    """Usual tolerance of a number whose truth has these names."""
    return next((each for name, each in TOLERANCES.items() if name in names), EXACT)
