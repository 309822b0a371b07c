"""How an episode can end, and what is told about its ticks while it goes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from tacgrasp.episodes.record import TickRecord, Truth


class EndReason(StrEnum):
    """Every end of an episode. Source: our choice; Algorithm 1 of the paper has only the first."""

    SUCCESS = "success"  # declared by the policy and verified by lifting
    UNVERIFIED = "unverified"  # declared, but the lift showed otherwise
    MAX_STEPS = "max_steps"  # as many actions as the task allows
    TIMEOUT = "timeout"  # as much time as the task allows
    NO_ACTION = "no_action"  # the policy kept naming no action, or two
    LIMIT = "limit"  # travel, workspace or force: a command was refused
    CONTACT_LOST = "contact_lost"  # the second reset
    FAULT = "fault"  # robot, sensor, policy or recorder failed
    OPERATOR = "operator"  # a person stopped it


@dataclass(frozen=True, slots=True, kw_only=True)
class Verification:
    """What the lift showed.

    Attributes:
        passed: The contact stayed what it was.
        message: Why, with the numbers.
        shift_mm: How far the contact moved on the pad [mm].
        area_ratio: Area after the lift over before.
        depth_ratio: Depth after over before.
    """

    passed: bool
    message: str
    shift_mm: float = math.nan
    area_ratio: float = math.nan
    depth_ratio: float = math.nan


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """How an episode ended.

    Attributes:
        reason: The named end.
        message: What happened, for people.
        declared: The policy declared success.
        verified: The lift confirmed it; None when it was not tried.
        steps: Actions that were carried out.
        turns: Times that the gel was felt and the policy asked.
        duration_s: From the first command to the safe state [s]; includes simulated motion.
        safe_state: How the gripper was left, for people.
        truth: What the simulator knows of the moment before the safe state; None on a real rig.
    """

    reason: EndReason
    message: str
    declared: bool
    verified: bool | None
    steps: int
    turns: int
    duration_s: float
    safe_state: str
    truth: Truth | None = None


Observer = Callable[[TickRecord], None]
"""Told of every turn after it has been recorded (views, benchmarks)."""


class EndOfEpisode(Exception):  # noqa: N818 - an end, not an error
    """Raised inside the loop where an episode comes to a named end."""

    def __init__(self, reason: EndReason, message: str) -> None:
        super().__init__(message)
        self.reason, self.message = reason, message
