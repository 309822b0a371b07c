"""Watches an episode from outside: the true force against the limit, and bounds that end a hang.

The force of the simulated world changes in steps: by a command, when it has settled, or by a fault.
It is sampled after each of them.
"""

from __future__ import annotations

import math

from cltp.tactile.sensors import SensorSpec

PERIODS, MARGIN_S = 2, 0.025
TAXELS_S = 0.045
"""Longest time above the limit after a change that no command caused [s]: two periods of a camera
and 25 ms; 45 ms with taxels, which are faster than the gripper."""

ROUNDING = 1e-6
"""Relative excess that is rounding."""

EXTRA_S = 120.0
"""Simulated time that an episode may take beyond ``loop.timeout_s``: a reply that has begun, and
the lift [s]."""

MAX_CALLS = 3000
"""Readings and decisions that an episode may take."""


class Hung(Exception):  # noqa: N818 - a finding, not an error
    """An episode went on beyond its bounds; nothing in the runtime catches this."""


def grace_s(sensor: SensorSpec) -> float:
    """Longest time above the limit that counts as none, after a change without a command [s]."""
    return TAXELS_S if sensor.name == "taxels" else PERIODS / sensor.frame_hz + MARGIN_S


class ForceWatch:
    """The true force over time against a limit.

    Args:
        limit_n: The limit [N].
        grace_s: As the function of that name [s].

    Attributes:
        exceeded: Why the limit counts as exceeded, for people; '' where it does not.
        peak_n: Largest true force [N].
        longest_s: Longest time above the limit, of whatever cause [s].
    """

    def __init__(self, limit_n: float, grace_s: float) -> None:
        self._limit_n, self._grace_s = limit_n, grace_s
        self._changed_s = -math.inf
        self._over_s: float | None = None  # since when
        self.exceeded = ""
        self.peak_n = self.longest_s = 0.0

    def sample(self, now_s: float, force_n: float, *, is_change: bool = False) -> None:
        """Take the force of a moment.

        Args:
            now_s: Simulated time [s].
            force_n: True force [N]; 0 where nothing is held.
            is_change: Whether it has just changed without a command.
        """
        self.peak_n = max(self.peak_n, force_n)
        if is_change:
            self._changed_s = now_s
        if self._over_s is not None:
            self._note_time(now_s)
        if force_n <= self._limit_n * (1 + ROUNDING):
            self._over_s = None
        elif self._over_s is None:
            is_caused = now_s - self._changed_s > self._grace_s
            self._over_s = now_s if is_caused else max(self._changed_s, 0.0)
            if is_caused:
                self._exceed(f"a command made {force_n:.3f} N")

    def finish(self, now_s: float, *, is_kept: bool) -> None:
        """End of the episode: a grip that is kept above the limit stays above it."""
        if self._over_s is not None:
            self._note_time(now_s)
            if is_kept:
                self._exceed("the episode ended above the limit, and the grip was kept")

    def _note_time(self, now_s: float) -> None:
        assert self._over_s is not None
        over_s = now_s - self._over_s
        self.longest_s = max(self.longest_s, over_s)
        if over_s > self._grace_s + ROUNDING:
            self._exceed(f"above the limit for {1000 * over_s:.0f} ms, without a command")

    def _exceed(self, reason: str) -> None:
        self.exceeded = self.exceeded or reason


class Bounds:
    """Ends an episode that does not end: by simulated time, and by the number of calls.

    Args:
        timeout_s: The loop's own bound [s].
    """

    def __init__(self, timeout_s: float) -> None:
        self._most_s, self.calls = timeout_s + EXTRA_S, 0

    def check(self, now_s: float, *, counts: bool = True) -> None:
        """One more reading or decision at a simulated time [s].

        Raises:
            Hung: It was one too many, or too late.
        """
        self.calls += counts
        if now_s > self._most_s or self.calls > MAX_CALLS:
            raise Hung(f"{now_s:.0f} s of simulated time, {self.calls} readings and decisions")
