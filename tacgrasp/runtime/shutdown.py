"""The end of every episode: the robot in the task's state, the episode ended, on every path."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import TypeVar

from primitives import RobotError
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import EpisodeEnd, EpisodeError
from tacgrasp.episodes.interrupts import interrupts_held
from tacgrasp.rig.factory import commands_of, truth_of
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import EndOfEpisode, EndReason, Outcome
from tacgrasp.runtime.tick import Recorder, Turns

T = TypeVar("T")

INTERRUPTS_SURVIVED = 3
"""How often a step of making safe is taken up again when it is interrupted."""

FREE_BY_HAND = (
    "what it grips may still be held: support it, then switch the gripper's power off, or remove "
    "the cause and open with tacgrasp jog (key o)"
)
"""What to do when a gripper that was to release has failed: it takes no command any more."""


def close(
    rig: Rig,
    config: RunConfig,
    recorder: Recorder,
    turns: Turns,
    end: EndOfEpisode,
    declared: bool,
    verified: bool | None,
    steps: int,
) -> Outcome:
    """Stop the arm, hold or release as the task says, and write how the episode ended.

    A failure here turns the end into ``fault``. Ctrl-C waits until it is done.

    Raises:
        Exception: A bug in a device; the record is ended all the same.
    """
    with interrupts_held():
        try:
            truth = truth_of(rig)  # before the gripper opens
        finally:
            safe_state, released = _make_safe(rig, config, end)
        problems = [] if released else [safe_state]
        unfinished = _refusals(lambda: turns.record(None, note=f"cut short: {end.message}"))
        if end.reason is not EndReason.FAULT:  # which may be the recorder's own, and said already
            problems += unfinished
        outcome = Outcome(
            reason=EndReason.FAULT if problems else end.reason,
            message="; ".join([end.message, *problems]),
            declared=declared,
            verified=verified,
            steps=steps,
            turns=turns.count,
            duration_s=turns.elapsed_s,
            safe_state=safe_state,
            truth=truth,
        )
        late = _refusals(lambda: recorder.finish(_episode_end(rig, outcome)))
    if late and outcome.reason is not EndReason.FAULT:
        message = "; ".join([outcome.message, *late])
        outcome = replace(outcome, reason=EndReason.FAULT, message=message)
    return outcome


def _make_safe(rig: Rig, config: RunConfig, end: EndOfEpisode) -> tuple[str, bool]:
    """Stop, then hold or release; returns how the gripper was left, and whether that was wanted."""
    if config.dry_run:
        return "nothing was sent", True
    wanted = config.on_success if end.reason is EndReason.SUCCESS else config.on_failure
    _despite_interrupts(rig.arm.stop)
    _despite_interrupts(rig.gripper.stop)
    if wanted == "hold":
        return "the gripper keeps its grip", True
    try:
        if not _despite_interrupts(rig.gripper.state).closed:
            return "the gripper is open", True
        _despite_interrupts(lambda: rig.gripper.open_by(config.primitives.clear_mm / 1000))
    except RobotError as error:
        why = "" if str(error) in end.message else f": {error}"
        return f"the gripper could not be opened{why}; {FREE_BY_HAND}", False
    except KeyboardInterrupt:
        return (
            f"the gripper could not be opened: interrupted again and again; {FREE_BY_HAND}",
            False,
        )
    return "the gripper has released", True


def _refusals(write: Callable[[], None]) -> list[str]:
    """Write to the record; says why when it can't be, which must not keep the robot from safety."""
    try:
        write()
    except EpisodeError as error:
        return [str(error)]
    return []


def _episode_end(rig: Rig, outcome: Outcome) -> EpisodeEnd:
    return EpisodeEnd(
        reason=outcome.reason.value,
        declared_success=outcome.declared,
        verified_success=outcome.verified,
        message=outcome.message,
        stamp=rig.clock.stamp(),
        truth=outcome.truth,
        commands=commands_of(rig),
    )


def _despite_interrupts(step: Callable[[], T]) -> T:
    """Take a step of making safe up again when Ctrl-C cuts it short."""
    for _ in range(INTERRUPTS_SURVIVED):
        with suppress(KeyboardInterrupt):
            return step()
    return step()
