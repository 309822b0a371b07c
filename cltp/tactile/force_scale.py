"""From nominal newtons to newtons: the stiffness of one unit's gel.

The heights of a contact depend on force over stiffness alone (linear elasticity), so that a force
read from heights is the force on a gel of nominal stiffness: nominal newtons. A unit's force
calibration gives the factor to newtons.

Not here: measuring the factor (``cltp.sensing.force_calibration``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cltp.errors import TouchError

UNCALIBRATED_SOURCE = "uncalibrated"
"""Source of the scale of a unit without a calibration, in episodes too."""

POSSIBLE_RATIO = 3.0
"""Largest ratio of a felt force to the commanded one, either way. Our choice: grippers are off by
up to 2 (``sim.grasp.rig``); far beyond that the gel, its scale or the gripper is another one, or
what is felt is the gel's drift."""

MAX_FACTOR = 10.0
"""Largest factor, and one over the smallest: beyond it the sensor is not of its model."""

UNCALIBRATED_SPREAD = 0.3
"""Standard deviation of ln F among units. Source: moduli of 0.6 to 1.4 of nominal give 0.25 (drawn
evenly), the rest is our allowance for thicknesses of 3.2 to 4.2 mm."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceScale:
    """How the nominal newtons of one unit become newtons.

    Attributes:
        factor: Newtons per nominal newton.
        spread: Standard deviation of ln F that the factor leaves.
        source: Unit and day of the calibration; ``UNCALIBRATED_SOURCE`` without one.

    Raises:
        TouchError: A number that no unit has.
    """

    factor: float
    spread: float
    source: str

    def __post_init__(self) -> None:
        if not (1 / MAX_FACTOR <= self.factor <= MAX_FACTOR and 0 <= self.spread <= 1):
            raise TouchError(
                f"a force scale has a factor of {1 / MAX_FACTOR:g} to {MAX_FACTOR:g} and a spread "
                f"of 0 to 1, got {self.factor} and {self.spread}; calibrate this unit: "
                "tacgrasp calibrate force"
            )

    @property
    def is_calibrated(self) -> bool:
        return self.source != UNCALIBRATED_SOURCE

    @property
    def mark(self) -> str:
        """What people must read behind a force of this unit; '' for a calibrated one."""
        if self.is_calibrated:
            return ""
        low, high = (100 * (math.exp(sign * self.spread) - 1) for sign in (-1, 1))
        return f"{UNCALIBRATED_SOURCE}, {low:+.0f} to {high:+.0f} %"


UNCALIBRATED = ForceScale(factor=1.0, spread=UNCALIBRATED_SPREAD, source=UNCALIBRATED_SOURCE)
"""Scale of a unit without a force calibration."""
