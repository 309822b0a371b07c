"""Why an episode did not end well: the first fault, refusal or failed verification, or a stop.

Not here: replaying it (``tacgrasp.playback.replay``), which the printed command does.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from tacgrasp.episodes.command_log import Command, pose_text
from tacgrasp.episodes.record import (
    NO_END,
    PHASE_LABELS,
    Episode,
    StepPhase,
    StepRecord,
    end_label,
)

SHOWN_SURVIVED = 5
"""Most survived failures that are named. Our choice."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trouble:
    """The first thing that went wrong in an episode.

    Attributes:
        kind: fault, refusal, failed verification, operator, crash, or the named end without one of
            these.
        message: Explanation for people.
        step: The step in or after which it happened; None before the first.
    """

    kind: str
    message: str
    step: StepRecord | None


def first_trouble(episode: Episode) -> Trouble | None:
    """What ended an episode badly, at its first sign; None in an episode that ended well.

    The end says of which kind it is. A failure or refusal that the loop survived is no trouble.
    """
    end, last = episode.end, episode.steps[-1] if episode.steps else None
    if end is None:
        message = episode.problem or "no end was recorded"
        return Trouble(kind="crash", message=f"{NO_END}: {message}", step=last)
    label = end_label(end.reason, end.truth)
    if label in ("success", "dry_run"):
        return None
    if end.reason in _FIRST_SIGN:
        kind, sign_of = _FIRST_SIGN[end.reason]
        for step in episode.steps:
            if message := sign_of(step):
                return Trouble(kind=kind, message=message, step=step)
    if end.reason == "unverified":  # the state before the lift that showed it
        before = [step for step in episode.steps if step.phase is StepPhase.VERIFY_BEFORE]
        last = before[-1] if before else last
    kinds = {"unverified": "failed verification", "limit": "refusal"}
    message = end.message if end.reason != "success" else label
    return Trouble(kind=kinds.get(end.reason, label), message=message, step=last)


def _fault_in(step: StepRecord) -> str:
    """What failed within a step; empty for nothing."""
    failed = [command for command in step.commands if command.error]
    if failed:
        return f"{failed[0].device}: {failed[0].error}"
    return step.note if "Error:" in step.note or step.note.startswith("cut short") else ""


def _refusal_in(step: StepRecord) -> str:
    """What was refused within a step; empty for nothing."""
    decision, executed = step.decision, step.executed
    if decision is not None and decision.reason.startswith("beyond the contract"):
        return decision.reason
    if executed is not None and executed.sent_nothing and not executed.dry_run:
        return "; ".join(executed.clamped) or f"{executed.asked}: nothing was sent"
    return ""


_FIRST_SIGN: Mapping[str, tuple[str, Callable[[StepRecord], str]]] = {
    "fault": ("fault", _fault_in),
    "limit": ("refusal", _refusal_in),
    "no_action": ("refusal", _refusal_in),
}
"""Kind of the trouble of an end, and what its first sign in a step is."""


def _survived(episode: Episode, trouble: Trouble | None) -> list[str]:
    """Failures and refusals after which the run went on, for people."""
    texts = []
    for step in episode.steps if trouble is None else episode.steps[:-1]:
        text = _fault_in(step) or _refusal_in(step)
        if text and (trouble is None or step is not trouble.step):
            texts.append(f"step {step.index}: {text}")
    more = len(texts) - SHOWN_SURVIVED
    return [*texts[:SHOWN_SURVIVED], *([f"and {more} more"] if more > 0 else [])]


def explain(episode: Episode, path: str) -> list[tuple[str, str]]:
    """What went wrong first, for people: name and value of each line.

    Args:
        episode: The episode.
        path: Its file, for the commands that replay it.
    """
    trouble, rows = first_trouble(episode), []
    survived = [("survived", text) for text in _survived(episode, trouble)]
    if not episode.complete and (trouble is None or trouble.kind != "crash"):  # which says it too
        problem = episode.problem or "the file was not finished"
        rows.append(("incomplete", f"{problem}; what is missing can't be judged"))
    if trouble is None:
        end, read = episode.end, "" if episode.complete else " in what was read"
        found = "what failed was survived" if survived else "no fault, no refusal"
        return [
            *rows,
            ("trouble", f"none{read}: {found}, no failed verification"),
            *survived,
            ("end", f"{end.reason} - {end.message}" if end else ""),
        ]
    rows.append(("trouble", f"{trouble.kind}: {trouble.message}"))
    rows += survived
    if trouble.step is not None:
        rows += _state_rows(episode, trouble.step)
    if episode.end is not None:
        label = end_label(episode.end.reason, episode.end.truth)
        rows.append(("end", f"{label} - {episode.end.message}"))
        rows += [("sent at the end", _command_text(each)) for each in episode.end.commands]
    return [*rows, *_commands(episode, path)]


def _state_rows(episode: Episode, step: StepRecord) -> list[tuple[str, str]]:
    """State before the trouble, what was said, and what was sent."""
    elapsed_s = step.stamp.monotonic_s - episode.header.stamp.monotonic_s
    label = PHASE_LABELS.get(step.phase, "")
    phase = f", {label}" if label else ""
    gripper, felt = step.gripper, step.felt_force_n
    fingers = "closed" if gripper.closed else "open"
    rows = [
        ("step", f"{step.index} of {len(episode.steps)}, {elapsed_s:.1f} s after the start{phase}"),
        ("arm before", pose_text(step.tcp_pose)),
        (
            "gripper before",
            f"{fingers}, {1000 * gripper.width_m:.1f} mm, commanded {gripper.force_n:.2f} N",
        ),
    ]
    if step.in_contact is False:
        rows.append(("felt before", "nothing touches the gel"))
    elif felt is not None:
        rows.append(("felt before", f"{felt.value:.2f} N ({felt.low:.2f}-{felt.high:.2f})"))
    if step.decision is not None:
        rows.append(("said", f"“{step.decision.text}”"))
        rows.append(("read from it", step.decision.reason))
    if step.executed is not None:
        rows.append(("asked", step.executed.asked))
        rows.append(("sent", step.executed.sent))
        rows += [("limits", change) for change in step.executed.clamped]
    rows += [("on the wire", _command_text(command)) for command in step.commands]
    return [*rows, *([("note", step.note)] if step.note else [])]


def _command_text(command: Command) -> str:
    result = f"FAILED: {command.error}" if command.error else f"reached {command.reached}"
    return f"{command.device}: {command.asked}; sent {command.sent or 'nothing'}; {result}"


def _commands(episode: Episode, path: str) -> list[tuple[str, str]]:
    """Commands that go on from here."""
    rows = [("decide again", f"tacgrasp replay {path} --decide")]
    repeatable = not episode.header.dry_run and not episode.missing
    if episode.header.seed is not None and repeatable:
        rows.append(("move again", f"tacgrasp replay {path} --execute"))
    return [*rows, ("look at it", f"tacgrasp view {path}")]
