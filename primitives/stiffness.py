"""How soft a contact is, from the opening between two forces.

A berry between gelled fingers gives way about four times as far as an egg. Not here: what is made
of it (``primitives.execution``).
"""

from __future__ import annotations

from primitives.sense import Interval

SOFT_MM = 0.45
"""Approach per finger and N^(2/3) [mm] above which a contact is soft.

Source: simulated grasps (40 of each kind, seeds from 5000, contact on the pad): strawberries 0.61 to
1.28, cherry tomatoes 0.48 to 0.84, eggs 0.16 to 0.54 where the forces differ by 1.4 and below 0.35
where they differ by ``LEAST_RATIO``, pegs 0.17 to 0.26."""

LEAST_RATIO = 1.7
"""Least ratio of two forces that tells stiffness. Our choice: the felt force varies by some percent
from frame to frame."""

LEAST_N = 0.25
"""Least felt force [N] of a pair. Our choice: below it the felt force is mostly noise."""

HERTZ = 2 / 3
"""Approach grows with the force to this power. Source: Hertz."""


class StiffnessReader:
    """Collects openings and felt forces of one contact, until they tell whether it is soft."""

    def __init__(self) -> None:
        self._pairs: list[tuple[float, float]] = []  # felt force [N], opening [mm]
        self.is_soft: bool | None = None
        """Whether the contact is soft; None until two forces have told."""

    def new_contact(self) -> None:
        """Forget the pairs: the fingers have opened."""
        self._pairs = []

    def feel(self, felt: Interval | None, width_m: float) -> None:
        """Take the felt force and the opening of the present grip."""
        if felt is None or felt.value < LEAST_N:
            return
        now_n, now_mm = felt.value, 1e3 * width_m
        for force_n, width_mm in self._pairs:
            low, high = sorted(((force_n, width_mm), (now_n, now_mm)))
            if high[0] >= LEAST_RATIO * low[0]:
                approach_mm = (low[1] - high[1]) / 2
                self.is_soft = approach_mm > SOFT_MM * (high[0] ** HERTZ - low[0] ** HERTZ)
        self._pairs.append((now_n, now_mm))
