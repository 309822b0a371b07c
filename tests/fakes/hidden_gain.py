"""A gripper that presses with a hidden multiple of its command, and what is honestly felt of it."""

from __future__ import annotations

from primitives.devices import GripperState
from primitives.sense import Interval


class HiddenGainGripper:
    """Presses with ``gain`` times the command; the contact gives way by Hertz.

    Args:
        gain: Ratio of true to commanded force.
        softness_mm: Approach per finger at 1 N [mm].
    """

    def __init__(self, gain: float = 1.0, *, softness_mm: float = 0.3) -> None:
        self.gain, self.softness_mm = gain, softness_mm
        self.rest_mm = 30.0  # opening at the first touch
        self.peak_n = 0.0
        self.commands_n: list[float] = []
        self.calls: list[str] = []
        self._now = GripperState(width_m=0.05, force_n=0.0, closed=False)

    @property
    def true_n(self) -> float:
        """Force that presses on the object [N]."""
        return self.gain * self._now.force_n

    def felt(self, spread: float = 1.35, bias: float = 1.0) -> Interval:
        """A reading whose interval holds the true force.

        Args:
            spread: Bounds over the reading, as a factor.
            bias: Reading over the true force, within the spread.
        """
        value_n = self.true_n * bias
        return Interval(value=value_n, low=value_n / spread, high=value_n * spread)

    def state(self) -> GripperState:
        return self._now

    def grip(self, force_n: float) -> GripperState:
        self.commands_n.append(force_n)
        self.peak_n = max(self.peak_n, self.gain * force_n)
        width_mm = self.rest_mm - 2 * self.softness_mm * (self.gain * force_n) ** (2 / 3)
        self._now = GripperState(width_m=width_mm / 1000, force_n=force_n, closed=True)
        return self._now

    def open_by(self, clear_m: float) -> GripperState:
        self._now = GripperState(width_m=self._now.width_m + clear_m, force_n=0.0, closed=False)
        return self._now

    def stop(self) -> None:
        self.calls.append("stop")

    def disconnect(self) -> None:
        self.calls.append("disconnect")
