"""The gripper's force gain, the ratio of felt to commanded force, over the grips of a run.

It is hidden until something is felt. Two things are wanted of it, and both are kept here:

* an estimate from all grips. What differs from grip to grip becomes less with their number; what
  all readings of one sensor and body share does not. The estimate is therefore relative to the
  sensor's calibrated force, whose own residual belongs beside it.
* a bound on the true ratio, for the hard limit: that of the clearest reading alone. It grows no
  narrower with more grips, since what readings share could lie at its end. A sensor that has lost
  a part of its depths feels too little in every grip: the bound allows for that too, as far as the
  rig states that its gripper can press.

Not here: keeping the limit (``primitives.force_guard``), the sensor's calibration
(``cltp.sensing.force_calibration``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from primitives.sense import Interval

LEAST_FELT_N = 0.2
"""Felt force from which the ratio is learned [N]. Our choice: below it the drift of the gel can be
as large as what is felt; at 0.3 a weak gripper under a limit of 1.2 N never learned it, and stopped
short of its band."""

TRUSTED_N = 0.5
"""Felt force from which a ratio above the rig's own bound is believed [N]. Our choice, likewise."""

KEPT = 0.8
"""Part of a ratio of ``TRUSTED_N`` that an equally clear one may have and take its place. Our
choice: three times ``GRIP_SPREAD``."""

LOST = 2.2
"""True force over the felt one of a sensor that may have lost sensitivity. Our choice: of two
fifths of its depths, since the felt force goes as the 1.5th power of them: 0.6^-1.5 = 2.15."""

ROSE = 1.3
"""Factor above the bound's value from which a force in a single frame counts as a ratio that has
risen. Our choice: above the noise of a frame of a clear contact."""

GRIP_SPREAD = 0.06
"""Standard deviation of ln(felt over commanded) from grip to grip. Source: simulated strawberries
of 25 seeds, 10 grips each, anywhere within 6 mm of the pad's centre, 0.3 to 1.5 N: 0.042 of clear
contacts, 0.060 of those that the pad's edge cuts or that are lightly felt."""

NINE_OF_TEN = 1.645
"""Half width, in standard deviations, of an interval that holds nine of ten."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GainEstimate:
    """The ratio of felt to commanded force, as a sensor calibrated without a residual would feel.

    Attributes:
        value: Best estimate.
        low, high: Hold the ratio of the sensor's force to the command in nine cases of ten.
        num_grips: Number of grips behind it.
    """

    value: float
    low: float
    high: float
    num_grips: int


class GainEstimator:
    """Learns the ratio of one gripper.

    Args:
        max_gain: Largest ratio of true to commanded force that the rig states; a larger one is
            believed of a clearly felt force alone.
    """

    def __init__(self, max_gain: float) -> None:
        self._max_gain = max_gain
        self._grips: list[list[float]] = [[]]  # ln(felt over commanded) of each reading
        self._bound: Interval | None = None
        self._spread = math.inf  # upper bound over value of the felt force behind it
        self._trusted = 0.0  # highest possible ratio as clear as that, of ``TRUSTED_N`` at least

    def new_grip(self) -> None:
        """A command was sent: what is felt from now on is another grip."""
        if self._grips[-1]:
            self._grips.append([])

    def feel(self, felt: Interval, commanded_n: float) -> None:
        """Learn from the force that is felt under a command [N].

        For the bound the narrowest interval is kept, since a contact on the edge of the pad tells
        less than one in the middle; the later one of two, since the ratio belongs to the gripper.
        One of at least ``TRUSTED_N`` gives way to no much lower one (``KEPT``): what is felt of a
        contact that leaves the pad falls.
        """
        if felt.value < LEAST_FELT_N or commanded_n <= 0:
            return
        most = math.inf if felt.value >= TRUSTED_N else self._max_gain
        low, value, high = (
            min(most, force_n / commanded_n) for force_n in (felt.low, felt.value, felt.high)
        )
        self._grips[-1].append(math.log(value))
        spread = felt.high / felt.value
        is_clearer, is_as_clear = spread < 0.99 * self._spread, spread <= 1.01 * self._spread
        if is_clearer or (is_as_clear and value >= KEPT * self._trusted):
            is_trusted = felt.value >= TRUSTED_N and value <= self._max_gain
            before = 0.0 if is_clearer else self._trusted
            self._trusted = max(before, value if is_trusted else 0.0)
            self._bound, self._spread = Interval(value=value, low=low, high=high), spread

    def rise(self, felt_n: float, commanded_n: float) -> None:
        """Widen the bound for a force [N] that clearly grew under one command [N], in any frame.

        One frame is believed no further than the rig's own bound.
        """
        if self._bound is None or commanded_n <= 0 or felt_n < LEAST_FELT_N:
            return
        factor = min(self._max_gain, felt_n / commanded_n) / self._bound.value
        if factor > ROSE:
            old = self._bound
            self._bound = Interval(
                value=factor * old.value, low=factor * old.low, high=factor * old.high
            )

    @property
    def most(self) -> float:
        """Largest true ratio that the hard limit reckons with."""
        if self._bound is None:
            return self._max_gain
        return max(self._bound.high, min(self._max_gain, LOST * self._bound.value))

    @property
    def bound(self) -> Interval | None:
        """The true ratio as the clearest reading has it; None before anything was felt."""
        return self._bound

    @property
    def estimate(self) -> GainEstimate | None:
        """The ratio as all grips have it, each with the same weight; None before any was felt."""
        means = [sum(each) / len(each) for each in self._grips if each]
        if not means:
            return None
        value = math.exp(sum(means) / len(means))
        factor = math.exp(NINE_OF_TEN * GRIP_SPREAD / math.sqrt(len(means)))
        return GainEstimate(
            value=value, low=value / factor, high=value * factor, num_grips=len(means)
        )
