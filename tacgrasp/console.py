"""Console output of an episode: a line for each step, then its end and the truth.

Not here: measuring the contact (``cltp.tactile.measure``), deciding (``policies``).
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable

from rich.console import Console, ConsoleOptions, RenderableType
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.segment import Segment
from rich.text import Text

from cltp.tactile.force_scale import ForceScale
from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from tacgrasp.base.printable import printable
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes.record import PHASE_LABELS, StepRecord, TruthFacts
from tacgrasp.runtime.end_text import end_text
from tacgrasp.runtime.outcome import Outcome

COMPLETED = "Grasp completed successfully"
"""Final line of Algorithm 1; printed for a verified grasp, in simulation an unbruised one."""

END_COLUMNS = 100
"""Largest width of the lines of the end."""


class SafeConsole(Console):
    """A console on which text from files and devices can't steer the terminal."""

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        for segment in super().render(renderable, options):
            text = segment.text if segment.control else printable(segment.text)
            yield segment if text == segment.text else Segment(text, segment.style)


def make_console() -> Console:
    """A console that never wraps a line."""
    return SafeConsole(soft_wrap=True, highlight=False, markup=False)


def make_table_console() -> Console:
    """A console of the terminal's width; without a terminal wide enough for the tables."""
    console = SafeConsole()
    return console if console.is_terminal else SafeConsole(width=160)


def count_progress(console: Console | None = None) -> Progress:
    """A progress bar with counts; by default on standard error."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    return Progress(*columns, TimeRemainingColumn(), console=console or Console(stderr=True))


class StepPrinter:
    """Prints a line for every step, with the time since the first; an ``Observer`` of the loop."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._started_s: float | None = None

    def __call__(self, record: StepRecord) -> None:
        if self._started_s is None:
            self._started_s = record.stamp.monotonic_s
        elapsed_s = record.stamp.monotonic_s - self._started_s
        state = contact_state(record.cloud, in_contact=record.in_contact)
        self._console.print(step_line(record, state, elapsed_s))


def step_line(record: StepRecord, state: ContactState, elapsed_s: float) -> Text:
    """One step: number, time, contact, D_t, action, force and duration."""
    note = f" | {record.note}" if record.note else ""
    line = Text(f"{record.index:3d} {elapsed_s:6.1f} s  ")
    scale = record.cloud.force_scale
    line.append(contact_text(state, scale), style="cyan")
    if record.decision is None:
        return line.append(f" | {PHASE_LABELS.get(record.phase, '')}{note}")
    action, executed = record.decision.action, record.executed
    line.append(f" | “{record.decision.text}”")
    if not scale.is_calibrated:
        line.append(f" (its N {scale.source})", style="yellow")
    line.append(f" | {action.value if action else 'no action'}", style="bold")
    if executed is None:
        line.append(f" | grip {record.gripper.force_n:.2f} N")
    else:
        command = f"dry run, would be {executed.asked}" if executed.dry_run else executed.sent
        line.append(f": {command} | grip {executed.force_n:.2f} N")
        for limit in executed.clamped:
            line.append(f" ({limit})", style="yellow")
    return line.append(f" | {record.step_ms:.0f} ms{note}")


def contact_text(state: ContactState, scale: ForceScale) -> str:
    """A contact in numbers, with the mark of the unit's forces; its words are those of D_t."""
    if not state.in_contact:
        return "no contact"
    cut = f", cut at the {' and '.join(sorted(state.cut))}" if state.cut else ""
    mark = "" if scale.is_calibrated else f" ({scale.mark})"
    return (
        f"({state.x_mm:+.1f}, {state.y_mm:+.1f}) mm, {state.depth_mm:.2f} mm deep, "
        f"{state.area_fraction:.0%}, {state.force_n:.1f} N{mark}{cut}"
    )


def end_lines(outcome: Outcome, config: RunConfig) -> list[Text]:
    """Why the episode ended, its counts, the truth if known, what happened in plain words.

    The paper's last line follows a completed grasp. No line is wider than ``END_COLUMNS``.
    """
    actions = "1 action" if outcome.num_actions == 1 else f"{outcome.num_actions} actions"
    paragraphs = [
        (f"end: {outcome.label} - {outcome.message}", ""),
        (
            f"{actions} in {outcome.num_steps} steps, {outcome.duration_s:.1f} s; "
            f"{outcome.safe_state}",
            "",
        ),
        *([(f"truth: {truth_text(outcome.truth)}", "")] if outcome.truth is not None else []),
        (end_text(outcome, config), "bold"),
    ]
    if outcome.completed:
        paragraphs.append((COMPLETED, "bold green"))
    return [
        Text(line, style=style)
        for paragraph, style in paragraphs
        for line in textwrap.wrap(
            paragraph, END_COLUMNS, subsequent_indent="  ", break_on_hyphens=False
        )
    ]


def truth_text(truth: TruthFacts) -> str:
    """Facts of the simulator: the true ones, the false ones, then numbers with their units."""
    flags = {name: value for name, value in truth.items() if isinstance(value, bool)}
    positive = [name.replace("_", " ") for name, value in flags.items() if value]
    negative = [f"not {name.replace('_', ' ')}" for name, value in flags.items() if not value]
    numbers = [
        f"{name} {value:.3g}" for name, value in truth.items() if type(value) in (int, float)
    ]
    return ", ".join([*positive, *negative, *numbers])
