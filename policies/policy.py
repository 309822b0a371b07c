"""The contract of a policy and the decision that it returns."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from numbers import Real
from typing import Protocol

from policies.errors import PolicyError
from policies.extraction import extract
from policies.observation import Observation
from primitives import Primitive
from primitives.contract import Contract


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """The text of a policy on one contact, and the action and verdict read out of it.

    Attributes:
        text: D_t, the text of the policy; action and success are read from it alone.
        action: The primitive that the text asks for; None when it asks for none.
        success: Whether the text declares the grasp good (``policies.extraction``).
        reason: Explanation of ``action`` and ``success`` for people.
        confidence: Probability that the policy gave its choice, 0 to 1; 1 for rules.
        stage_ms: Measured durations of the stages of the decision [ms], by name.
    """

    text: str
    action: Primitive | None
    success: bool
    reason: str
    confidence: float = 1.0
    stage_ms: Mapping[str, float] = field(default_factory=dict)


class Policy(Protocol):
    """Decides from a cloud and the episode's contract alone, never from a simulator's truth."""

    @property
    def name(self) -> str:
        """Name on the command line and in episodes."""
        ...

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        """Describe the contact and decide what to do to keep the contract.

        Deterministic: the same observation and contract after the same ``start`` give the same
        Decision (a random policy draws from the seed given at its construction).

        Raises:
            PolicyError: No decision is possible (a broken model).
            LimitError: The contract is refused.
            TouchError: The cloud can't be used.
        """
        ...

    def start(self) -> None:
        """Begin an episode: forget earlier contacts."""
        ...


def decision_of(text: str, *, confidence: float = 1.0) -> Decision:
    """The decision that a text is: what it asks for, and whether it declares the grasp good."""
    extraction = extract(text)
    return Decision(
        text=text,
        action=extraction.action,
        success=extraction.success,
        reason=extraction.reason,
        confidence=confidence,
    )


def is_unicode(text: str) -> bool:
    """Whether a text has no half of a surrogate pair, as bytes that were read wrongly leave."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def checked(reply: object) -> Decision:
    """A policy's reply, once it is a Decision that can be carried out.

    Raises:
        PolicyError: It is none, names an action that no robot has, holds a number that is not
            finite, or a text that no record can hold.
    """
    if not isinstance(reply, Decision):
        raise PolicyError(f"the policy replied {reply!r:.80}; expected a Decision")
    if reply.action is not None and not isinstance(reply.action, Primitive):
        raise PolicyError(
            f"the policy asks for the unknown action {reply.action!r:.80}; known: "
            f"{', '.join(Primitive)}"
        )
    if not (isinstance(reply.text, str) and isinstance(reply.success, bool)):
        raise PolicyError(
            "a decision needs a text, and True or False for success; got "
            f"{reply.text!r:.80} and {reply.success!r:.80}"
        )
    if not (isinstance(reply.reason, str) and isinstance(reply.stage_ms, Mapping)):
        raise PolicyError(
            "a decision's reason is a text, and its stage_ms durations by their names; got "
            f"{reply.reason!r:.80} and {reply.stage_ms!r:.80}"
        )
    for name, text in (("text", reply.text), ("reason", reply.reason)):
        if not is_unicode(text):
            raise PolicyError(f"the policy's {name} is no Unicode, got {text!r:.80}")
    for name, number in (("confidence", reply.confidence), *reply.stage_ms.items()):
        if not (isinstance(number, Real) and math.isfinite(number)):
            raise PolicyError(f"the policy's {name} is {number!r:.80}; expected a finite number")
    return reply
