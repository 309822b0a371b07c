"""Replay a recorded episode: decide its steps again, or move a rig through them again.

Not here: reading the file (``tacgrasp.episodes``), the limits (``primitives.limits``).
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from pydantic import ValidationError

from cltp import TouchError
from policies import Policy, PolicyError
from primitives.contract import Contract
from primitives.devices import Pose
from primitives.execution import Executed
from primitives.limits import check_travel, check_workspace, distance_mm
from tacgrasp.base.strict_yaml import YamlError, read_yaml
from tacgrasp.config.errors import explain
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.episodes import Episode, EpisodeError, StepPhase, StepRecord
from tacgrasp.episodes.codec import to_json
from tacgrasp.rig.factory import make_executor
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import EndReason
from tacgrasp.runtime.steps import NO_CONTACT_DECISION, Readings, decide

SOFT_SPEED_M_S = 0.02
"""Speed of the move to the start of the episode. Our choice: slow enough to be stopped by hand."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """A step with a decision that differs from the recorded one.

    Attributes:
        index: Number of the step.
        text: Recorded and new value of all that differs, or the error of the policy.
    """

    index: int
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RepeatedAction:
    """One action that was executed again.

    Attributes:
        index: Number of its step.
        executed: The action as sent and reached now.
        deviation_mm: Distance between the recorded pose and the one reached now [mm].
        deviation_n: Force commanded now less the recorded one [N].
    """

    index: int
    executed: Executed
    deviation_mm: float
    deviation_n: float


def config_of(episode: Episode, path: Path) -> RunConfig:
    """Configuration of a recorded run.

    Raises:
        EpisodeError: It is missing, or of another version.
    """
    try:
        return RunConfig.model_validate(read_yaml(episode.header.config_yaml))
    except (ValidationError, YamlError) as error:
        reason = explain(error.errors()[0]) if isinstance(error, ValidationError) else "not YAML"
        raise EpisodeError(
            f"the configuration in {path} is not one of this version of tacgrasp ({reason}); "
            "it can be shown, but neither decided nor moved again"
        ) from None


def contract_in(episode: Episode, config: RunConfig) -> Contract:
    """Contract of a recorded run; made anew for an episode of an older version."""
    return episode.header.contract or contract_of(config)


def lacks_first_step(episode: Episode) -> bool:
    """Whether the step is missing that times are counted from."""
    return bool(episode.steps) and episode.steps[0].index > 0


def times_from_s(episode: Episode) -> float:
    """Time that those of the steps are counted from, on the episode's clock [s].

    That of the first step, or the start of the episode where that step is missing: it is earlier by
    the approach and the closing of the gripper.
    """
    if not episode.steps or lacks_first_step(episode):
        return episode.header.stamp.monotonic_s
    return episode.steps[0].stamp.monotonic_s


def asked_policy(step: StepRecord) -> bool:
    """Whether the policy decided a step; without contact the runtime does."""
    return step.phase is StepPhase.LOOP and step.decision not in (None, NO_CONTACT_DECISION)


def differences(episode: Episode, policy: Policy, contract: Contract) -> Iterator[Difference]:
    """Ask a policy again for each recorded decision of one, in order, under that step's target.

    Yields:
        Every step with another text, action or success.

    Raises:
        LimitError: The contract is refused.
    """
    policy.start()
    for step in episode.steps:
        contract = step.contract or contract
        if not asked_policy(step):
            continue
        target = step.under(contract)
        try:
            elapsed_s = step.stamp.monotonic_s - times_from_s(episode)
            decision = decide(policy, _readings(step).for_policy(elapsed_s), target)
        except (TouchError, PolicyError) as error:
            yield Difference(index=step.index, text=str(error))
            continue
        old, new = (
            {name: to_json(getattr(each, name)) for name in ("action", "success", "text")}
            for each in (step.decision, decision)
        )
        texts = [f"{n}: {old[n]!r} then, {new[n]!r} now" for n in old if old[n] != new[n]]
        if texts:
            yield Difference(index=step.index, text="; ".join(texts))


def _readings(step: StepRecord) -> Readings:
    return Readings(
        cloud=step.cloud,
        tcp_pose=step.tcp_pose,
        gripper=step.gripper,
        stamp=step.stamp,
        started_s=math.nan,
        in_contact=step.in_contact,
        felt_force_n=step.felt_force_n,
        shear=step.shear,
    )


def repeat(episode: Episode, rig: Rig, config: RunConfig) -> Generator[RepeatedAction, None, None]:
    """Move a rig as in the episode: slowly to its start, then action by action, within limits.

    The recorded clouds play no part. What a failed episode had lifted is lowered again. At the end,
    after an error too, the arm is stopped and the gripper holds or releases as the task says; what
    hangs in the air after an error is held.

    Yields:
        Every action, after its execution.

    Raises:
        LimitError: The episode leaves the limits, nothing was sent for that action; or its contract
            is refused.
        RobotError: A device failed.
        EpisodeError: The episode has no step, and so no start pose; or one of its steps is missing;
            or it was a dry run.
    """
    if not episode.steps:
        raise EpisodeError("the episode has no step, so no start pose; nothing was moved")
    if episode.missing:  # the next action would start where its step did not
        raise EpisodeError(
            f"{episode.missing}, so that the motion has a hole; nothing was moved. Look at what "
            "was read with `tacgrasp replay` without --execute, or with --decide"
        )
    if episode.header.dry_run:
        raise EpisodeError("the episode was a dry run, which moved nothing; nothing to repeat")
    is_success = episode.end is not None and episode.end.reason == EndReason.SUCCESS
    may_hang = is_done = False
    try:
        _approach(rig, episode.steps[0].tcp_pose, config)
        executor = make_executor(rig, config, _contract_to_repeat(episode, config))
        executor.grasp(episode.steps[0].gripper.force_n or None)
        for step in episode.steps:
            recorded = step.executed
            if recorded is not None and recorded.primitive is not None:
                executed = executor.execute(recorded.primitive, recorded.force_n or None)
                deviation_mm = distance_mm(executed.reached, recorded.reached)
                yield RepeatedAction(
                    index=step.index,
                    executed=executed,
                    deviation_mm=deviation_mm,
                    deviation_n=executed.force_n - recorded.force_n,
                )
            elif step.phase is StepPhase.VERIFY_AFTER:
                start, may_hang = rig.arm.pose(), True
                for pose in (step.tcp_pose,) if is_success else (step.tcp_pose, start):
                    check_workspace(pose, config.limits())
                    rig.arm.move_to(
                        pose,
                        speed_m_s=config.verify.speed_m_s,
                        acceleration_m_s2=config.verify.acceleration_m_s2,
                    )
                may_hang = is_success
        is_done = True
    finally:
        rig.arm.stop()
        action = config.on_success if is_success else config.on_failure
        if action == "release" and (is_done or not may_hang):
            rig.gripper.open_by(config.primitives.clear_mm / 1000)


def _contract_to_repeat(episode: Episode, config: RunConfig) -> Contract:
    """The contract after what was felt then: nothing is felt now that could object again."""
    softer = [step.contract for step in episode.steps if step.contract is not None]
    return replace(softer[-1] if softer else contract_in(episode, config), soft=None)


def _approach(rig: Rig, target: Pose, config: RunConfig) -> None:
    """Move to ``target`` slowly, in moves no longer than the limits allow.

    Raises:
        LimitError: The target is outside the workspace or the allowed travel; nothing was sent.
        RobotError: The arm failed.
    """
    limits = config.limits()
    start = rig.arm.pose()
    check_workspace(target, limits)
    offset_mm = distance_mm(start, target)
    check_travel(0.0, offset_mm, limits)
    if offset_mm < 0.01:
        return
    num_moves = math.ceil(offset_mm / limits.max_step_mm)
    for move in range(1, num_moves + 1):
        fraction = move / num_moves
        position_m = start.position_m + (target.position_m - start.position_m) * fraction
        rotvec_rad = start.rotvec_rad + (target.rotvec_rad - start.rotvec_rad) * fraction
        rig.arm.move_to(
            Pose(position_m=position_m, rotvec_rad=rotvec_rad),
            speed_m_s=min(SOFT_SPEED_M_S, limits.max_speed_m_s),
        )
