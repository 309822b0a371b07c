"""Ends and outcome of an episode, and the observers of its steps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from primitives.gain import GainEstimate
from tacgrasp.episodes.record import StepRecord, TruthFacts, end_label


class EndReason(StrEnum):
    """Every end of an episode. Source: our choice; Algorithm 1 of the paper has only the first."""

    SUCCESS = "success"  # declared by the policy and verified by lifting
    UNVERIFIED = "unverified"  # declared, but the lift showed otherwise
    MAX_STEPS = "max_steps"  # as many actions as the task allows
    TIMEOUT = "timeout"  # as much time as the task allows
    NO_ACTION = "no_action"  # decisions in a row moved nothing
    LIMIT = "limit"  # travel, workspace or force: a command was refused
    CONTACT_LOST = "contact_lost"  # the fingers closed on nothing twice in a row
    DRY_RUN = "dry_run"  # one decision was made, nothing was sent
    FAULT = "fault"  # robot, sensor, policy or recorder failed
    OPERATOR = "operator"  # a person stopped it


RELEASED = "the gripper has released"
"""State of the gripper at the end of an episode that opens it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Verification:
    """Result of a verification by lifting.

    Attributes:
        passed: The contact stayed as it was, within the task's thresholds.
        message: Explanation with the numbers.
        shift_mm: Shift of the contact on the pad [mm].
        area_ratio: Area after the lift over the area before.
        depth_ratio: Depth after the lift over the depth before.
        lifted: Whether it was lifted; False where it was lost as it was lifted off.
    """

    passed: bool
    message: str
    shift_mm: float = math.nan
    area_ratio: float = math.nan
    depth_ratio: float = math.nan
    lifted: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """Result of an episode.

    Attributes:
        reason: The named end.
        message: Explanation for people.
        declared: The policy declared success.
        verified: The lift confirmed it; None when no lift was tried.
        num_actions: Number of executed actions.
        num_steps: Number of recorded observations, those of the verification included.
        duration_s: Time from the first command to the safe state [s]; includes simulated motion.
        safe_state: State of the gripper afterwards, for people.
        truth: Facts from the simulator just before the safe state; None on a real rig and in a dry
            run.
        slip_minimum_n: Least true force that would have held the simulated body, centred [N]; None
            where it was not computed.
        peak_felt_n: Largest force felt at a step [N]; None when none was.
        force_mark: Mark of the sensor's forces; empty for a calibrated unit.
        force_residual: Relative residual of their calibration; None where none was felt.
        gain: The gripper's force gain, relative to the sensor's force; None where none was felt.
        lifted: Whether a lift that was tried went on after the lift-off.
    """

    reason: EndReason
    message: str
    declared: bool
    verified: bool | None
    num_actions: int
    num_steps: int
    duration_s: float
    safe_state: str
    truth: TruthFacts | None = None
    slip_minimum_n: float | None = None
    peak_felt_n: float | None = None
    force_mark: str = ""
    force_residual: float | None = None
    gain: GainEstimate | None = None
    lifted: bool = True

    @property
    def label(self) -> str:
        """The reason for people, in simulation held against the truth."""
        return end_label(self.reason, self.truth)

    @property
    def completed(self) -> bool:
        """Verified, and neither bruised nor lost as far as is known."""
        return self.label == EndReason.SUCCESS


Observer = Callable[[StepRecord], None]
"""Called with every step after it has been recorded (console, benchmarks)."""


class EndOfEpisode(Exception):  # noqa: N818 - an end, not an error
    """Raised inside the loop to end the episode with a named reason."""

    def __init__(self, reason: EndReason, message: str) -> None:
        super().__init__(message)
        self.reason, self.message = reason, message
