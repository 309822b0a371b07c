"""What an episode prints: two lines a step, then its end and the truth; consoles and spinners.

Not here: measuring the contact (``cltp.tactile.measure``), deciding (``policies``), the live table
of a terminal (``tacgrasp.viewer.live_table``).
"""

from __future__ import annotations

import re
import textwrap
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from rich.console import Console, ConsoleOptions, RenderableType
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.segment import Segment
from rich.text import Text

from cltp.tactile.force_scale import UNCALIBRATED_SOURCE, ForceScale
from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from primitives.execution import Executed
from tacgrasp.base.printable import printable
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes.record import PHASE_LABELS, StepRecord, TruthFacts
from tacgrasp.runtime.end_text import end_text, gain_text
from tacgrasp.runtime.outcome import RELEASED, Outcome

COMPLETED = "Grasp completed successfully"
"""Final line of Algorithm 1; printed for a verified grasp, in simulation an unbruised one."""

COLUMNS = 100
"""Largest width of what a run prints; only the path of a file may be longer."""

SPINNER_DELAY_S = 0.3
"""Time after which something slow shows a spinner [s]."""

_INDENT = " " * 14
_SENTENCE_END = re.compile(r"(?<=[.!?])\s+(?=[A-Z<])")


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


@contextmanager
def working(text: str, console: Console | None = None) -> Iterator[None]:
    """Show a spinner with ``text`` from ``SPINNER_DELAY_S`` on, for as long as the block runs.

    Args:
        text: What is being done ('loading the language model').
        console: Console of the spinner; by default on standard error. Nothing is printed where it
            is no terminal.
    """
    console = console or SafeConsole(stderr=True)
    if not console.is_terminal:
        yield
        return
    done, spinner = threading.Event(), console.status(f"{text} …")

    def show() -> None:
        if not done.wait(SPINNER_DELAY_S):
            spinner.start()
            done.wait()
            spinner.stop()

    thread = threading.Thread(target=show, name="spinner", daemon=True)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()


class StepPrinter:
    """Prints two lines for every step, with the time since the first; an ``Observer`` of the loop.

    Args:
        console: Where to.
        verbose: Whether each step is printed whole: all of D_t, the command as sent, the durations.
        started_s: Time that is counted from, on the clock of the steps [s]; the first step's when
            not given.
    """

    def __init__(
        self, console: Console, *, verbose: bool = False, started_s: float | None = None
    ) -> None:
        self._console, self._verbose = console, verbose
        self._started_s = started_s

    def __call__(self, record: StepRecord) -> None:
        if self._started_s is None:
            self._started_s = record.stamp.monotonic_s
        elapsed_s = record.stamp.monotonic_s - self._started_s
        state = contact_state(record.cloud, in_contact=record.in_contact)
        lines = verbose_lines if self._verbose else step_lines
        for line in lines(record, state, elapsed_s, width_of(self._console)):
            self._console.print(line)


def width_of(console: Console) -> int:
    """Width of what is printed: that of a terminal, at most ``COLUMNS``."""
    return min(console.width, COLUMNS) if console.is_terminal else COLUMNS


def step_lines(
    record: StepRecord, state: ContactState, elapsed_s: float, width: int = COLUMNS
) -> list[Text]:
    """One step: what is felt, then what is said and done; each at most ``width`` wide.

    More lines follow only where a limit changed the command, or a failure was survived.
    """
    felt = Text(f"{record.index:3d} {elapsed_s:6.1f} s  ")
    felt.append(_fitted(felt_parts(record, state), width - len(felt)), style="cyan")
    room = width - len(_INDENT)
    act = action_text(record)
    line = Text(_INDENT)
    if record.decision is not None:
        line.append(f"“{last_words(record.decision.text, room - len(act) - 5)}” → ")
    line.append(act, style="bold")
    line.truncate(width, overflow="ellipsis")
    return [felt, line, *_remarks(record, width)]


def verbose_lines(
    record: StepRecord, state: ContactState, elapsed_s: float, width: int = COLUMNS
) -> list[Text]:
    """One step with everything that is known of it for people, wrapped at ``width``."""
    parts = filter(None, [*felt_parts(record, state), record.cloud.force_scale.mark])
    head = wrapped(f"{record.index} {elapsed_s:6.1f} s  {', '.join(parts)}", 2, len(_INDENT), width)
    lines = [Text(line, style="cyan") for line in head]
    decision, executed = record.decision, record.executed
    rows = [("phase", PHASE_LABELS.get(record.phase, ""))]
    rows += [("object", "" if record.need is None else record.need.felt)]
    if decision is not None:
        rows += [("said", f"“{decision.text}”"), ("read", decision.reason)]
        rows += [("confidence", f"{decision.confidence:.2f}")]
    rows.append(("done", action_text(record)))
    if executed is not None:
        rows += [("asked", executed.asked), ("sent", executed.sent)]
    rows.append(("commanded", f"{record.gripper.force_n:.2f} N at the start of the step"))
    rows.append(("took", f"{record.step_ms:.0f} ms"))
    for name, value in rows:
        if value:
            lines += [Text(line) for line in wrapped(f"{name:10}  {value}", 4, 16, width)]
    return [*lines, *_remarks(record, width)]


def felt_parts(record: StepRecord, state: ContactState) -> list[str]:
    """What is felt, the most important first: force with its interval, depth, place, area, cut."""
    if not state.in_contact and record.in_contact is None:
        return ["nothing stands out that could not be drift, in a frame alone"]
    if not state.in_contact:
        return ["nothing touches the gel"]
    scale = record.cloud.force_scale
    mark = "" if scale.is_calibrated else UNCALIBRATED_SOURCE
    felt = record.felt_force_n
    if felt is None:
        force = f"felt about {state.force_n:.2f} N" + (f" ({mark})" if mark else "")
    else:
        interval = ", ".join(filter(None, [f"{felt.low:.2f}-{felt.high:.2f}", mark]))
        force = f"felt {felt.value:.2f} N ({interval})"
    if record.need is not None:
        force += f", needs {record.need.force_n.low:.2f}-{record.need.force_n.high:.2f}"
    parts = [force, f"{state.depth_mm:.2f} mm deep", place_text(state)]
    parts.append(f"{state.area_fraction:.0%} of the pad")
    return [*parts, *([cut_text(state)] if state.cut else [])]


def place_text(state: ContactState) -> str:
    """Position of a contact on the pad, gel frame."""
    return f"at ({state.x_mm:+.1f}, {state.y_mm:+.1f}) mm"


def cut_text(state: ContactState) -> str:
    """Sides of the pad that the contact runs over; empty for none."""
    return f"cut: {' '.join(sorted(state.cut))}" if state.cut else ""


def action_text(record: StepRecord) -> str:
    """What was done in a step, in a few words; a commanded force is called so."""
    decision, executed = record.decision, record.executed
    if decision is None:
        return PHASE_LABELS.get(record.phase, "observed")
    if decision.action is None:
        return "success declared" if decision.success else "nothing moved: no clear action"
    name = decision.action.value
    if executed is None:
        return f"{name}: not executed"
    if executed.dry_run:
        return f"{name}: dry run, would be {_brief(executed.asked)}"
    return f"{name}: {_sent_text(executed)}"


def last_words(text: str, room: int) -> str:
    """The last whole sentences of a text within ``room`` characters, '… ' before them."""
    text = " ".join(text.split())
    if len(text) <= room:
        return text
    sentences, kept = _SENTENCE_END.split(text), ""
    while sentences and len(f"… {sentences[-1]} {kept}".strip()) <= room:
        kept = f"{sentences.pop()} {kept}".strip()
    return f"… {kept}" if kept else "… " + text[-max(room - 2, 8) :].partition(" ")[2]


def wrapped(text: str, indent: int = 0, hanging: int = 2, width: int = COLUMNS) -> list[str]:
    """Lines of at most ``width``, the first indented by ``indent``, the others by ``hanging``."""
    return textwrap.wrap(
        text,
        width,
        initial_indent=" " * indent,
        subsequent_indent=" " * hanging,
        break_on_hyphens=False,
    )


def contact_text(state: ContactState, scale: ForceScale) -> str:
    """A contact in numbers, with the mark of the unit's forces; its words are those of D_t."""
    if not state.in_contact:
        return "no contact"
    mark = "" if scale.is_calibrated else f" ({scale.mark})"
    parts = [
        place_text(state).removeprefix("at "),
        f"{state.depth_mm:.2f} mm deep",
        f"{state.area_fraction:.0%} of the pad",
        f"felt {state.force_n:.1f} N{mark}",
        cut_text(state),
    ]
    return ", ".join(filter(None, parts))


def end_lines(outcome: Outcome, config: RunConfig, width: int = COLUMNS) -> list[Text]:
    """Why the episode ended, its counts, the truth if known, what happened in plain words.

    The paper's last line follows a completed grasp. No line is wider than ``width``.
    """
    actions = "1 action" if outcome.num_actions == 1 else f"{outcome.num_actions} actions"
    paragraphs = [
        (f"end: {outcome.label} - {outcome.message}", ""),
        (
            f"{actions} in {outcome.num_steps} steps, {outcome.duration_s:.1f} s; "
            f"{outcome.safe_state}",
            "",
        ),
        *([(gain_text(outcome), "")] if outcome.gain is not None else []),
        *([(_truth_line(outcome), "")] if outcome.truth is not None else []),
        (end_text(outcome, config), "bold"),
    ]
    if outcome.completed:
        paragraphs.append((COMPLETED, "bold green"))
    return [
        Text(line, style=style) for text, style in paragraphs for line in wrapped(text, width=width)
    ]


def _truth_line(outcome: Outcome) -> str:
    assert outcome.truth is not None
    when = ", before it opened" if outcome.safe_state == RELEASED else ""
    return f"truth{when}: {truth_text(outcome.truth)}"


def truth_text(truth: TruthFacts) -> str:
    """Facts of the simulator: the true ones, the false ones, then numbers with their units."""
    flags = {name: value for name, value in truth.items() if isinstance(value, bool)}
    positive = [name.replace("_", " ") for name, value in flags.items() if value]
    negative = [f"not {name.replace('_', ' ')}" for name, value in flags.items() if not value]
    numbers = [
        f"{name} {value:.3g}" for name, value in truth.items() if type(value) in (int, float)
    ]
    return ", ".join([*positive, *negative, *numbers])


def _fitted(parts: list[str], room: int) -> str:
    """The parts, without the area and then without the place where they are too long."""
    for droppable in (3, 2):
        if len(", ".join(parts)) > room and len(parts) > droppable:
            parts = [part for i, part in enumerate(parts) if i != droppable]
    return ", ".join(parts)


def _remarks(record: StepRecord, width: int) -> list[Text]:
    """What limits changed and which failures were survived, for people; mostly nothing."""
    changes = [] if record.executed is None else list(record.executed.clamped)
    notes = [record.note] if record.note else []
    if record.reflex is not None:
        notes.append(record.reflex.text)
    lines = [line for each in [*changes, *notes] for line in wrapped(each, len(_INDENT), 16, width)]
    return [Text(line, style="yellow") for line in lines]


def _sent_text(executed: Executed) -> str:
    if executed.sent_nothing:
        return "nothing sent"
    if executed.primitive is not None and executed.primitive.value.endswith("_force"):
        return f"commanded {executed.force_n:.2f} N"
    return _brief(executed.sent)


def _brief(command: str) -> str:
    """A command without its direction in coordinates, and with its force called commanded."""
    command = re.sub(r", \([^)]*\) mm in the base frame", "", command)
    return re.sub(r"\b([\d.]+ N)\b", r"\1 commanded", command)
