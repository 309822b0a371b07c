"""What a person sees while an episode runs: a line a turn, then the end and the truth.

Not here: what is felt (``cltp.tactile.measure``) or decided (the policies).
"""

from __future__ import annotations

from rich.console import Console
from rich.text import Text

from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from tacgrasp.episodes.record import StepPhase, StepRecord, Truth
from tacgrasp.runtime.outcome import EndReason, Outcome

COMPLETED = "Grasp completed successfully"
"""What Algorithm 1 returns; printed for a verified grasp only."""

_LABELS = {StepPhase.VERIFY_BEFORE: "before the lift", StepPhase.VERIFY_AFTER: "after lift and hold"}


def console() -> Console:
    """A console that keeps a line a line when nobody sees it."""
    return Console(soft_wrap=True, highlight=False, markup=False)


class LineView:
    """Prints every turn; an ``Observer`` of the loop."""

    def __init__(self, to: Console, began_s: float | None = None) -> None:
        self._to = to
        self._began_s = began_s

    def __call__(self, record: StepRecord) -> None:
        """Print one turn; the first one starts the time."""
        if self._began_s is None:
            self._began_s = record.stamp.monotonic_s
        since_s = record.stamp.monotonic_s - self._began_s
        self._to.print(turn_line(record, contact_state(record.cloud), since_s))


def turn_line(record: StepRecord, state: ContactState, since_s: float) -> Text:
    """One turn: number, time, contact, D_t, action, force, and what it took."""
    line = Text(f"{record.index:3d} {since_s:6.1f} s  ")
    line.append(contact_words(state), style="cyan")
    if record.decision is None:
        return line.append(f" | {_LABELS.get(record.phase, '')}{_noted(record)}")
    action = record.decision.action
    line.append(f" | “{record.decision.text}”")
    line.append(f" | {action.value if action else 'no action'}", style="bold")
    if record.executed is None:
        line.append(f" | grip {record.gripper.force_n:.2f} N")
    else:
        done = record.executed
        line.append(f": {f'dry run, would be {done.asked}' if done.dry_run else done.sent}")
        line.append(f" | grip {done.force_n:.2f} N")
        for clamped in done.clamped:
            line.append(f" ({clamped})", style="yellow")
    return line.append(f" | {record.tick_ms:.0f} ms{_noted(record)}")


def contact_words(state: ContactState) -> str:
    """A contact in numbers; the words are D_t's to say."""
    if not state.in_contact:
        return "no contact"
    cut = f", cut at the {' and '.join(sorted(state.cut))}" if state.cut else ""
    return (
        f"({state.x_mm:+.1f}, {state.y_mm:+.1f}) mm, {state.depth_mm:.2f} mm deep, "
        f"{state.area_fraction:.0%}, {state.force_n:.1f} N{cut}"
    )


def end_lines(outcome: Outcome) -> list[Text]:
    """The end's reason, the truth where there is one, and the paper's last line when earned."""
    lines = [
        Text(f"end: {outcome.reason} - {outcome.message}", style="bold"),
        Text(
            f"{outcome.num_actions} actions in {outcome.num_steps} turns, {outcome.duration_s:.1f} s; "
            f"{outcome.safe_state}"
        ),
    ]
    if outcome.truth is not None:
        lines.append(Text(f"truth: {truth_words(outcome.truth)}"))
    if outcome.reason is EndReason.SUCCESS:
        lines.append(Text(COMPLETED, style="bold green"))
    return lines


def truth_words(truth: Truth) -> str:
    """What the simulator knows, in words: facts that are true by name, numbers with their units."""
    facts = [name.replace("_", " ") for name, value in truth.items() if value is True]
    denied = [name.replace("_", " ") for name, value in truth.items() if value is False]
    numbers = [
        f"{name} {value:.3g}" for name, value in truth.items() if type(value) in (int, float)
    ]
    said = [*facts, *(f"not {name}" for name in denied), *numbers]
    return ", ".join(said)


def _noted(record: StepRecord) -> str:
    return f" | {record.note}" if record.note else ""
