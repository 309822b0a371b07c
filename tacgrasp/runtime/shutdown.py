"""The end of every episode, on every path: the robot made safe, the record finished."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass, replace
from typing import TypeVar

from primitives.errors import TorqueOffError
from tacgrasp.base.errors import error_text
from tacgrasp.config.schema import RunConfig, VerifyConfig
from tacgrasp.episodes import EpisodeEnd
from tacgrasp.episodes.interrupts import delayed_interrupts
from tacgrasp.episodes.record import TruthFacts
from tacgrasp.rig.protocols import Rig
from tacgrasp.rig.release import FREE_BY_HAND, unopened_text
from tacgrasp.runtime.outcome import RELEASED, EndOfEpisode, EndReason, Outcome, Verification
from tacgrasp.runtime.steps import Recorder, Step, Steps

log = logging.getLogger(__name__)

T = TypeVar("T")

INTERRUPTS_SURVIVED = 3
"""Number of times that an interrupted safety command is repeated."""

KEPT = "the gripper keeps its grip"
HANGING = (
    f"{KEPT}, since what it holds may hang in the air: support it, then let go with tacgrasp jog "
    "--open"
)
"""States of the gripper at the end of an episode that leaves it closed."""

STORED_NAMES = {"gripper_force_gain": "gripper_factor"}
"""Names of the truth's facts in episode files where they differ from the simulator's."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ending:
    """An episode at its end.

    Attributes:
        rig, config, recorder, steps: Those of the episode.
        end: Reason and message.
        last_step: The last step, recorded or not; None before the first decision.
        verification: Result of the lift; None when none was tried.
        open_width_m: Opening before the first grasp [m].
    """

    rig: Rig
    config: RunConfig
    recorder: Recorder
    steps: Steps
    end: EndOfEpisode
    last_step: Step | None
    verification: Verification | None
    open_width_m: float = 0.0


def close(ending: Ending) -> Outcome:
    """Stop the arm, hold or release as the task says, and write how the episode ended.

    A failure here turns the end into ``fault``, that of a plugin's device too, which may raise
    anything. Ctrl-C waits until it is done, and then tells the end that it hides; of an episode
    that the operator has stopped, it is what was asked for already.
    """
    rig, steps, end = ending.rig, ending.steps, ending.end
    is_dry = ending.config.dry_run  # which grips nothing: there is no truth and no gain of a grip
    is_stopped = end.reason is EndReason.OPERATOR
    with _interrupted(is_expected=is_stopped) as told, delayed_interrupts():
        truth = None if is_dry else read_truth(rig, ending.config.verify)  # before it opens
        safe_state, problems = _make_safe(ending)
        refusals = _refusals(lambda: steps.record_cut_short(ending.last_step, end.message))
        if end.reason is not EndReason.FAULT:  # a fault may be the recorder's own error already
            problems += refusals
        outcome = Outcome(
            reason=EndReason.FAULT if problems else end.reason,
            message="; ".join([end.message, *problems]),
            declared=ending.last_step is not None and ending.last_step.declared,
            verified=None if ending.verification is None else ending.verification.passed,
            num_actions=steps.num_actions,
            num_steps=steps.num_steps,
            duration_s=steps.elapsed_s,
            safe_state=safe_state,
            truth=truth,
            peak_felt_n=steps.peak_felt_n,
            force_mark=steps.force_mark,
            force_residual=steps.force_residual,
            gain=None if is_dry else steps.gain,
            lifted=ending.verification is None or ending.verification.lifted,
        )
        told.append(f"{outcome.message}; {safe_state}")
        refusals = _refusals(lambda: ending.recorder.finish(_episode_end(rig, outcome)))
    if refusals and outcome.reason is not EndReason.FAULT:
        message = "; ".join([outcome.message, *refusals])
        outcome = replace(outcome, reason=EndReason.FAULT, message=message)
    return outcome


def read_truth(rig: Rig, verify: VerifyConfig) -> TruthFacts | None:
    """Truth of a simulated world for the record; None on a real rig, or when its emulators died.

    A body that hangs in the fingers is held, however far it slid, where a task lifts off by slides
    that the reflex catches.
    """
    try:
        truth = rig.truth()
    except Exception as error:  # the robot must be made safe all the same
        log.warning("the truth can't be recorded: %s", error_text(error))
        return None
    if truth is None:
        return None
    facts = {STORED_NAMES.get(name, name): value for name, value in asdict(truth).items()}
    x_mm, y_mm = facts.pop("offset_mm")
    if verify.lift_off_mm > 0:
        facts["held"] = truth.force_n > 0 and not truth.dropped
    return facts | {"offset_x_mm": x_mm, "offset_y_mm": y_mm}


@contextmanager
def _interrupted(*, is_expected: bool) -> Iterator[list[str]]:
    """Tell the lines in the yielded list when Ctrl-C comes, which hides what is returned."""
    told: list[str] = []
    try:
        yield told
    except KeyboardInterrupt:
        if not is_expected:
            for line in told:
                log.warning("%s", line)
            raise


def _make_safe(ending: Ending) -> tuple[str, list[str]]:
    """Stop, then hold or release; return the state of the gripper, and what is not as desired.

    What may hang in the air is held whatever the task says of a failed episode: it would fall.
    Fingers that closed on nothing, at the start pose, open as wide as they were before the first
    grasp, so that the next run finds them around the object. All others open by ``clear_mm``.
    """
    rig, config, end = ending.rig, ending.config, ending.end
    if config.dry_run:
        return "nothing was sent", []
    problems = [*_failure("arm", rig.arm.stop), *_failure("gripper", rig.gripper.stop)]
    action = config.on_success if end.reason is EndReason.SUCCESS else config.on_failure
    state, is_desired = _kept(rig, end.message) if action == "hold" else _released(ending)
    return state, problems if is_desired else [*problems, state]


def _failure(name: str, stop: Callable[[], None]) -> list[str]:
    """Stop a device; why it could not, which keeps no other one from being stopped."""
    try:
        _despite_interrupts(stop)
    except Exception as error:
        return [f"the {name} could not be stopped: {error_text(error)}"]
    return []


def _released(ending: Ending) -> tuple[str, bool]:
    """State of a gripper that is to let go, and whether it has, as far as it may."""
    rig, config, end = ending.rig, ending.config, ending.end
    try:
        state = _despite_interrupts(rig.gripper.state)
        if not state.closed:
            return "the gripper is open", True
        if ending.steps.may_hang and end.reason is not EndReason.SUCCESS:
            return HANGING, True
        clear_m = config.primitives.clear_mm / 1000
        if end.reason is EndReason.CONTACT_LOST:
            clear_m = max(clear_m, ending.open_width_m - state.width_m)
        _despite_interrupts(lambda: rig.gripper.open_by(clear_m))
    except Exception as error:
        return unopened_text(error, end.message), False
    except KeyboardInterrupt:
        reason = "interrupted again and again"
        return f"the gripper could not be opened: {reason}; {FREE_BY_HAND}", False
    return RELEASED, True


def _kept(rig: Rig, told: str) -> tuple[str, bool]:
    """State of a gripper that is to hold, and whether it does as far as is known."""
    try:
        _despite_interrupts(rig.gripper.state)
    except TorqueOffError as error:
        return unopened_text(error, told), False
    except (Exception, KeyboardInterrupt):
        pass  # it takes no command, and keeps its grip
    return KEPT, True


def _refusals(write: Callable[[], None]) -> list[str]:
    """Write to the record; an error is returned, since neither safety nor the end may lack it."""
    try:
        write()
    except Exception as error:  # of a device too, whose state is recorded
        return [error_text(error)]
    return []


def _episode_end(rig: Rig, outcome: Outcome) -> EpisodeEnd:
    return EpisodeEnd(
        reason=outcome.reason.value,
        declared_success=outcome.declared,
        verified_success=outcome.verified,
        message=outcome.message,
        stamp=rig.clock.stamp(),
        truth=outcome.truth,
        commands=rig.commands(),
    )


def _despite_interrupts(command: Callable[[], T]) -> T:
    """Repeat a safety command that Ctrl-C interrupts."""
    for _ in range(INTERRUPTS_SURVIVED):
        with suppress(KeyboardInterrupt):
            return command()
    return command()
