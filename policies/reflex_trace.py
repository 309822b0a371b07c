"""What the reflex saw and did between two steps, as an episode keeps it.

Not here: the reflex (``policies.reflex``), and what drives it (``tacgrasp.runtime.reflex_loop``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

NO_SLIP = -100.0
"""Recorded in place of log odds that there are none of."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceCorrection:
    """A correction of the gripper's force.

    Attributes:
        t_s: Time of the command, monotonic [s].
        before_n, after_n: Commanded force before and after it [N].
        reason: Why, for people.
    """

    t_s: float
    before_n: float
    after_n: float
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ReflexTrace:
    """Readings and corrections of the reflex since the step before.

    Attributes:
        t_s: Time of each reading, monotonic [s].
        felt_n: Force felt in each [N]; 0 where nothing was felt.
        commanded_n: Force commanded at each [N].
        slip: Log odds of a slip over the threshold in each; ``NO_SLIP`` where it could not be told.
        corrections: What was commanded.
        num_blind: Moments without a reading; the force was held then.
        blind: Reason of the last of them; '' for none.
        absent: Why there was no reflex at all; '' where there was one.
    """

    t_s: NDArray[np.float64]
    felt_n: NDArray[np.float64]
    commanded_n: NDArray[np.float64]
    slip: NDArray[np.float64]
    corrections: tuple[ForceCorrection, ...] = ()
    num_blind: int = 0
    blind: str = ""
    absent: str = ""

    @property
    def text(self) -> str:
        """All of it in one line, for people."""
        if self.absent:
            return f"reflex: none, {self.absent}"
        readings = "1 reading" if len(self.t_s) == 1 else f"{len(self.t_s)} readings"
        parts = [f"reflex: {readings}"]
        if self.num_blind:
            moments = "1 moment" if self.num_blind == 1 else f"{self.num_blind} moments"
            parts.append(f"{moments} without one ({self.blind})")
        ups = [each for each in self.corrections if each.after_n > each.before_n]
        downs = [each for each in self.corrections if each.after_n < each.before_n]
        for name, some in (("raised", ups), ("lowered", downs)):
            if some:
                times = "once" if len(some) == 1 else f"{len(some)} times"
                change = f"{some[0].before_n:.2f} to {some[-1].after_n:.2f} N commanded"
                parts.append(f"{name} {times}, {change} ({some[-1].reason})")
        if not self.corrections:
            parts.append("force kept")
        return ", ".join(parts)


def absent_trace(reason: str) -> ReflexTrace:
    """The trace where no reflex could run."""
    nothing = np.zeros(0)
    return ReflexTrace(
        t_s=nothing, felt_n=nothing, commanded_n=nothing, slip=nothing, absent=reason
    )
