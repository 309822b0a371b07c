"""The policy that repeats decisions made earlier (a replayed episode).

Reading them from a file is the application's part.
"""

from __future__ import annotations

from collections.abc import Sequence

from cltp.tactile.cloud import TactileCloud
from policies.errors import PolicyError
from policies.policy import Decision


class RecordedPolicy:
    """Gives recorded decisions in order, whatever is felt; ``start`` begins again."""

    def __init__(self, decisions: Sequence[Decision]) -> None:
        """Take the decisions of one episode, in order."""
        self._decisions = tuple(decisions)
        self._next = 0

    @property
    def name(self) -> str:
        """'recorded'."""
        return "recorded"

    def start(self) -> None:
        """Begin again with the first decision."""
        self._next = 0

    def decide(self, cloud: TactileCloud, instruction: str) -> Decision:
        """Give the next recorded decision.

        Raises:
            PolicyError: There are no more.
        """
        if self._next >= len(self._decisions):
            raise PolicyError(
                f"the recording has {len(self._decisions)} decisions and all were given; "
                "replay from the start, or decide with another policy"
            )
        self._next += 1
        return self._decisions[self._next - 1]
