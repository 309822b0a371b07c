"""Go through a recorded episode again: show it, decide it again, or move it again.

Not here: reading the file (``tacgrasp.episodes``), the limits (``primitives.limits``).
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass
from pathlib import Path

import yaml
from pydantic import ValidationError

from cltp import TouchError
from policies import Decision, Policy, PolicyError
from primitives.devices import Pose
from primitives.execution import Executed
from primitives.limits import check_travel, check_workspace, distance_mm
from tacgrasp.config.errors import explain
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import Episode, EpisodeError, Phase, TickRecord
from tacgrasp.rig.factory import make_executor
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import EndReason

SOFT_SPEED_M_S = 0.02
"""Speed of the way to where the episode began. Our choice: slow enough to be stopped by hand."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """A turn on which a policy decides otherwise than was recorded.

    Attributes:
        index: Number of the turn.
        recorded: What was said then.
        now: What is said now; None when it could not decide.
        why: What differs.
    """

    index: int
    recorded: Decision
    now: Decision | None
    why: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Repeated:
    """One turn that was moved again.

    Attributes:
        index: Number of the turn.
        executed: What was sent and reached now.
        off_mm: Distance between the poses reached then and now [mm].
    """

    index: int
    executed: Executed
    off_mm: float


def config_of(episode: Episode, path: Path) -> RunConfig:
    """The configuration that an episode was run with.

    Raises:
        EpisodeError: It is missing, or of another version.
    """
    try:
        return RunConfig.model_validate(yaml.safe_load(episode.header.config_yaml))
    except (ValidationError, yaml.YAMLError) as error:
        why = explain(error.errors()[0]) if isinstance(error, ValidationError) else "not YAML"
        raise EpisodeError(
            f"the configuration in {path} is not one of this version of tacgrasp ({why}); "
            "it can be shown, but neither decided nor moved again"
        ) from None


def differences(episode: Episode, policy: Policy) -> Iterator[Difference]:
    """Ask a policy again on every recorded touch, in order.

    Yields:
        Every turn on which text, action or success differs.
    """
    policy.start()
    for tick in episode.ticks:
        if tick.phase is not Phase.TICK or tick.decision is None:
            continue
        recorded = tick.decision
        try:
            now = policy.decide(tick.cloud, episode.header.instruction)
        except (TouchError, PolicyError) as error:
            yield Difference(index=tick.index, recorded=recorded, now=None, why=str(error))
            continue
        differing = [
            f"{name}: {then!r} then, {now_!r} now"
            for name, then, now_ in (
                ("action", _named(recorded), _named(now)),
                ("success", recorded.success, now.success),
                ("text", recorded.text, now.text),
            )
            if then != now_
        ]
        if differing:
            why = "; ".join(differing)
            yield Difference(index=tick.index, recorded=recorded, now=now, why=why)


def _named(decision: Decision) -> str | None:
    return None if decision.action is None else decision.action.value


def repeat(episode: Episode, rig: Rig, config: RunConfig) -> Generator[Repeated, None, None]:
    """Move a rig as in the episode: softly to its start, then action by action, within limits.

    The gripper opens first; what it felt is not looked at. Stopped early or by an error, the arm
    is brought to rest and the gripper left as the task says.

    Yields:
        Every action, after it was carried out.

    Raises:
        LimitError: The episode leaves the limits; nothing was sent for that action.
        RobotError: A device failed.
        EpisodeError: There is no touch, so no pose to begin at; or it was a dry run.
    """
    if not episode.ticks:
        raise EpisodeError("the episode has no touch, so no pose to begin at; nothing was moved")
    if episode.header.dry_run:
        raise EpisodeError("the episode was a dry run, which moved nothing; nothing to repeat")
    good = episode.end is not None and episode.end.reason == EndReason.SUCCESS
    try:
        approach(rig, episode.ticks[0].tcp_pose, config)
        executor = make_executor(rig, config)
        executor.grasp()
        for tick in episode.ticks:
            if tick.executed is not None and tick.executed.primitive is not None:
                executed = executor.execute(tick.executed.primitive)
                off_mm = distance_mm(executed.reached, tick.executed.reached)
                yield Repeated(index=tick.index, executed=executed, off_mm=off_mm)
            elif tick.phase is Phase.VERIFY_AFTER:
                _lift(rig, tick, config)
    finally:
        rig.arm.stop()
        if (config.on_success if good else config.on_failure) == "release":
            rig.gripper.open_by(config.primitives.clear_mm / 1000)


def approach(rig: Rig, target: Pose, config: RunConfig) -> int:
    """Go to ``target`` slowly, in steps no longer than the limits allow; returns how many.

    Raises:
        LimitError: It lies outside the workspace or beyond the allowed travel; nothing was sent.
        RobotError: The arm failed.
    """
    limits = config.limits()
    here = rig.arm.pose()
    check_workspace(target, limits)
    way_mm = distance_mm(here, target)
    check_travel(0.0, way_mm, limits)
    num_steps = max(1, int(-(-way_mm // limits.max_step_mm)))
    if way_mm < 0.01:
        return 0
    for step in range(1, num_steps + 1):
        share = step / num_steps
        between = here.position_m + (target.position_m - here.position_m) * share
        rotvec_rad = here.rotvec_rad + (target.rotvec_rad - here.rotvec_rad) * share
        rig.arm.move_to(
            Pose(position_m=between, rotvec_rad=rotvec_rad),
            speed_m_s=min(SOFT_SPEED_M_S, limits.max_speed_m_s),
        )
    return num_steps


def _lift(rig: Rig, tick: TickRecord, config: RunConfig) -> None:
    check_workspace(tick.tcp_pose, config.limits())
    rig.arm.move_to(
        tick.tcp_pose,
        speed_m_s=config.verify.speed_m_s,
        acceleration_m_s2=config.verify.acceleration_m_s2,
    )
