"""The contract of a policy, and what it returns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from policies.observation import Observation
from primitives import Primitive


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """What a policy said about one touch, and what was read out of it.

    Attributes:
        text: D_t, the sentence that the policy said; extraction read only this.
        action: The primitive that the text names, None when it names none.
        success: True when the text declares the grasp stable, appropriate, secure or reliable.
        reason: How extraction came to ``action`` and ``success``, for people.
        confidence: Probability that the policy gave its choice, in [0, 1]; 1 for rules.
        stage_ms: Measured durations of the stages of the decision [ms], by name.
    """

    text: str
    action: Primitive | None
    success: bool
    reason: str
    confidence: float = 1.0
    stage_ms: Mapping[str, float] = field(default_factory=dict)


class Policy(Protocol):
    """Decides from touch and a person's instruction alone; it never sees a simulator's truth."""

    @property
    def name(self) -> str:
        """What the command line and the episodes call it."""
        ...

    def decide(self, observation: Observation, instruction: str) -> Decision:
        """Say what the contact is and what to do.

        Deterministic: the same observation and instruction after the same ``start`` give the same
        Decision (a random policy draws from the seed given at its construction).

        Raises:
            PolicyError: It can't decide (an unusable instruction, a broken model).
            TouchError: The cloud can't be used.
        """
        ...

    def start(self) -> None:
        """Forget earlier touches: an episode begins."""
        ...
