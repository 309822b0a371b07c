"""Policies whose replies are late, corrupt, or always ask for more force."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, cast

from policies import Decision, Observation, Policy, PolicyError, decision_of
from primitives import Primitive
from primitives.contract import Contract
from tacgrasp.benchmarks.limits.draw import Fault, FaultKind
from tacgrasp.benchmarks.limits.watch import Bounds
from tacgrasp.rig.protocols import Clock

GARBLED = "\x00\ufffd{]<incr \udcff ease_f orce>> NaN N \u202e.derucs si ti"
UNKNOWN = "The grasp needs more. Action: <squeeze_hard>."
MORE = "The grip is far too light. Increase the gripping force."


class FaultyPolicy:
    """A policy whose replies have the fault of the episode.

    Args:
        policy: The policy.
        fault: The fault.
        clock: In whose time late replies are late.
        bounds: Count the decisions.

    Attributes:
        num_faulty: Number of faulty replies so far.
    """

    def __init__(self, policy: Policy, fault: Fault, clock: Clock, bounds: Bounds) -> None:
        self._policy, self._fault, self._clock, self._bounds = policy, fault, clock, bounds
        self._num_asked = self.num_faulty = 0

    @property
    def name(self) -> str:
        return self._policy.name

    def start(self) -> None:
        self._policy.start()

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        """The reply, faulty where it is to be.

        Raises:
            PolicyError: As the policy, or the fault of this episode.
            Hung: The episode takes too long.
        """
        self._bounds.check(0.0)
        is_due = self._fault.onset_s <= self._num_asked < self._fault.onset_s + self._fault.count
        self._num_asked += 1
        if self._fault.is_greedy:
            self.num_faulty += 1
            return decision_of(MORE)
        reply = self._policy.decide(observation, contract)
        if not is_due or self._fault.kind not in (FaultKind.LATE, FaultKind.CORRUPT):
            return reply
        self.num_faulty += 1
        if self._fault.kind is FaultKind.LATE:
            self._clock.sleep(self._fault.size)
            return reply
        return corrupt(reply, self._fault.how)


def corrupt(reply: Decision, how: str) -> Decision:
    """A corrupt reply in place of a right one, as a broken policy could give it.

    Args:
        reply: The right one.
        how: One of ``tacgrasp.benchmarks.limits.draw.CORRUPTIONS``.

    Raises:
        PolicyError: ``how`` is 'error'.
    """
    match how:
        case "garbled":
            return decision_of(GARBLED)
        case "unknown words":
            return decision_of(UNKNOWN)
        case "unknown action":
            return replace(reply, action=cast("Primitive", "squeeze_hard"), success=False)
        case "not finite":
            return replace(reply, confidence=math.nan, stage_ms={"decide": math.inf})
        case "nothing":
            return cast("Decision", cast("Any", None))
    raise PolicyError("the policy is broken, on purpose")
