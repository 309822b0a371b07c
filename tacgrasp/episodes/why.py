"""Why an episode did not end well: the first fault, refusal or failed verification in it.

Not here: replaying it (``tacgrasp.playback.replay``), which the printed command does.
"""

from __future__ import annotations

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Trouble:
    """The first thing that went wrong in an episode.

    Attributes:
        kind: fault, refusal, failed verification, or the named end without one of these.
        message: Explanation for people.
        step: The step in or after which it happened; None before the first.
    """

    kind: str
    message: str
    step: StepRecord | None


def first_trouble(episode: Episode) -> Trouble | None:
    """The first fault, refusal or failed verification; None in an episode that ended well."""
    for step in episode.steps:
        if found := _trouble_in(step):
            return Trouble(kind=found[0], message=found[1], step=step)
    end, last = episode.end, episode.steps[-1] if episode.steps else None
    if end is None:
        message = episode.problem or "no end was recorded"
        return Trouble(kind="crash", message=f"{NO_END}: {message}", step=last)
    label = end_label(end.reason, end.truth)
    if label in ("success", "dry_run"):
        return None
    if end.reason == "unverified":  # the state before the lift that showed it
        before = [step for step in episode.steps if step.phase is StepPhase.VERIFY_BEFORE]
        last = before[-1] if before else last
    kinds = {"unverified": "failed verification", "limit": "refusal", "fault": "fault"}
    message = end.message if end.reason != "success" else label
    return Trouble(kind=kinds.get(end.reason, label), message=message, step=last)


def _trouble_in(step: StepRecord) -> tuple[str, str] | None:
    """Kind and message of what went wrong within a step."""
    failed = [command for command in step.commands if command.error]
    if failed:
        return "fault", f"{failed[0].device}: {failed[0].error}"
    decision, executed = step.decision, step.executed
    if decision is not None and decision.reason.startswith("beyond the contract"):
        return "refusal", decision.reason
    if executed is not None and executed.sent_nothing and not executed.dry_run:
        return "refusal", "; ".join(executed.clamped) or f"{executed.asked}: nothing was sent"
    if "not executed" in step.note:
        return "refusal", step.note
    if "Error:" in step.note or step.note.startswith("cut short"):
        return "fault", step.note
    return None


def explain(episode: Episode, path: str) -> list[tuple[str, str]]:
    """What went wrong first, for people: name and value of each line.

    Args:
        episode: The episode.
        path: Its file, for the commands that replay it.
    """
    trouble, rows = first_trouble(episode), []
    if not episode.complete and (trouble is None or trouble.kind != "crash"):  # which says it too
        problem = episode.problem or "the file was not finished"
        rows.append(("incomplete", f"{problem}; what is missing can't be judged"))
    if trouble is None:
        end, read = episode.end, "" if episode.complete else " in what was read"
        return [
            *rows,
            ("trouble", f"none{read}: no fault, no refusal, no failed verification"),
            ("end", f"{end.reason} - {end.message}" if end else ""),
        ]
    rows.append(("trouble", f"{trouble.kind}: {trouble.message}"))
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
