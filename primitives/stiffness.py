"""How soft a contact is, from the opening between two forces.

A berry between gelled fingers gives way about four times as far as an egg. The ratio of two
commanded forces is known, so only their scale rests on what is felt. Not here: what is made of it
(``primitives.execution``).
"""

from __future__ import annotations

from primitives.sense import Interval

SOFT_MM = 0.31
"""Approach per finger and N^(2/3) [mm] above which a contact is soft.

Source: simulated grasps (40 of each kind, seeds from 5000, contact on the pad, true forces of 0.3
to 2.4 N): strawberries 0.62 to 1.15, cherry tomatoes 0.47 to 0.77, eggs 0.14 to 0.21, pegs 0.11 to
0.14. A felt force that is off by a factor of 1.5 moves them by 1.31."""

LEAST_N = 0.25
"""Least force [N] of a pair. Our choice: below it the felt force is mostly noise."""

LEAST_CLOSING_MM = 0.25
"""Least closing of the fingers [mm] that a pair would show at ``SOFT_MM``. Our choice: more than
twice the resolution of a servo of 9 ticks a millimetre."""

HERTZ = 2 / 3
"""Approach grows with the force to this power. Source: Hertz."""


class StiffnessReader:
    """Collects commanded forces and openings of one contact, until they tell whether it is soft."""

    def __init__(self) -> None:
        self._pairs: list[tuple[float, float]] = []  # commanded force [N], opening [mm]
        self.is_soft: bool | None = None
        """Whether the contact is soft; None until two forces have told."""

    def new_contact(self) -> None:
        """Forget the pairs: the fingers have opened."""
        self._pairs = []

    def feel(self, commanded_n: float, width_m: float, gain: Interval | None) -> None:
        """Take a commanded force [N] and the opening [m] under it.

        Args:
            commanded_n: The force.
            width_m: The opening.
            gain: Ratio of felt to commanded force; None where nothing is felt clearly.
        """
        width_mm = 1e3 * width_m
        self._pairs.append((commanded_n, width_mm))
        if gain is None:
            return
        for other_n, other_mm in self._pairs:
            (low_n, low_mm), (high_n, high_mm) = sorted(
                ((gain.value * other_n, other_mm), (gain.value * commanded_n, width_mm))
            )
            steps = high_n**HERTZ - low_n**HERTZ
            if low_n >= LEAST_N and 2 * SOFT_MM * steps >= LEAST_CLOSING_MM:
                self.is_soft = (low_mm - high_mm) / 2 > SOFT_MM * steps
