"""How strong each error of a sensor is: the same for all, one by one, or drawn from wide ranges.

Not here: the errors themselves and their measured sizes (``cltp.tactile.sensor_noise``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cltp.errors import TouchError


@dataclass(frozen=True, slots=True, kw_only=True)
class NoiseLevels:
    """Strength of each error.

    Attributes:
        fine: Factor on the error of single pixels and markers; 1 is the measured sensor, 0 none.
        drift: Factor on the low-frequency errors: drift, reconstruction error, dead border.
        tilt: Factor on the slope.
        scale: Factor on the spread of the depth scale.
        missing: Fraction of the points that a frame loses, 0 to below 1.
        shuffled: Whether the points of a frame come in a random order.

    Raises:
        TouchError: A factor is negative or not finite, or a fraction is out of range.
    """

    fine: float = 1.0
    drift: float = 1.0
    tilt: float = 1.0
    scale: float = 1.0
    missing: float = 0.0
    shuffled: bool = False

    def __post_init__(self) -> None:
        factors = (self.fine, self.drift, self.tilt, self.scale)
        if not (all(0 <= factor < math.inf for factor in factors) and 0 <= self.missing < 1):
            raise TouchError(
                "noise needs levels of 0 or more and a missing fraction in [0, 1), got "
                f"fine {self.fine}, drift {self.drift}, tilt {self.tilt}, scale {self.scale}, "
                f"missing {self.missing}"
            )

    @classmethod
    def of(cls, level: float | NoiseLevels) -> NoiseLevels:
        """Levels as they are, or one factor on all errors, with no point missing."""
        if isinstance(level, NoiseLevels):
            return level
        return cls(fine=level, drift=level, tilt=level, scale=level)


@dataclass(frozen=True, slots=True, kw_only=True)
class NoiseRange:
    """Ranges that the levels of a sample are drawn from, each error by itself.

    Attributes:
        factor: Range of the factors on fine noise, drift and tilt, log-uniform.
        scale: Factor on the spread of the depth scale, always the same.
        missing: Largest fraction of missing points, uniform from 0.
        with_missing: Fraction of the samples that miss points at all.

    Raises:
        TouchError: A range is empty or not positive, or a fraction is out of range.

    The order of the points is not drawn: ``cltp.tactile.encoder_input`` sorts them.
    """

    factor: tuple[float, float] = (0.05, 4.0)
    scale: float = 1.0
    missing: float = 0.3
    with_missing: float = 0.5

    def __post_init__(self) -> None:
        low, high = self.factor
        if not (0 < low <= high < math.inf and 0 <= self.scale < math.inf):
            raise TouchError(
                f"a range of noise needs 0 < low <= high and a scale of 0 or more, got {self}"
            )
        if not (0 <= self.missing < 1 and 0 <= self.with_missing <= 1):
            raise TouchError(f"a range of noise needs fractions below 1, got {self}")

    def draw(self, rng: np.random.Generator) -> NoiseLevels:
        """Draw the levels of one sample."""
        low, high = (math.log(limit) for limit in self.factor)
        fine, drift, tilt = np.exp(rng.uniform(low, high, 3)).tolist()
        missing = float(rng.uniform(0, self.missing))
        if rng.random() >= self.with_missing:
            missing = 0.0
        return NoiseLevels(fine=fine, drift=drift, tilt=tilt, scale=self.scale, missing=missing)


WIDE = NoiseRange()
"""Noise of training: on a GelSight Mini fine noise of 0.5 to 40 µm, drift of 0.002 to 0.16 mm, tilt
of 0.00015 to 0.012 mm per mm, depth scale ±15 %, and in half of the samples up to 30 % of the
points missing.

Source: what is drawn with one amplitude fails at twice that amplitude (project's notes, 'Noise
cliffs'), so each is drawn at least three times as wide as measured; the depth scale's ±15 % is the
range of units, not the error of one.
"""
