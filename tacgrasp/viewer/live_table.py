"""The steps of a run as a table that grows on a terminal; each step has two lines.

Not here: the plain lines where there is no terminal (``tacgrasp.console``).
"""

from __future__ import annotations

from dataclasses import dataclass
from types import TracebackType
from typing import Self

from rich.console import Console, ConsoleOptions, RenderResult
from rich.live import Live
from rich.spinner import Spinner
from rich.table import Table
from rich.text import Text

from cltp.tactile.force_scale import UNCALIBRATED_SOURCE
from cltp.tactile.measure import contact_state
from primitives.contract import Contract
from tacgrasp.console import COLUMNS, SafeConsole, action_text, last_words, place_text
from tacgrasp.episodes.record import StepRecord

REFRESHES_PER_S = 4.0
"""Redraws of the table in a second, in a thread of its own. Our choice: a spinner that moves."""

SPARE_ROWS = 8
"""Lines of the terminal that are left for what is printed above the table."""


@dataclass(frozen=True, slots=True)
class _Row:
    """Cells of one step; ``text`` is cut to the column's width when it is drawn."""

    index: str
    time: str
    felt: Text
    contact: str
    text: str
    action: Text


class LiveTable:
    """A table of steps; an ``Observer`` of the loop and a context manager.

    While it is open it shows as many steps as fit; on leaving it is printed whole.

    Args:
        contract: Contract of the run; its band and limit colour the felt force.
        console: The terminal.
    """

    def __init__(self, contract: Contract, console: Console | None = None) -> None:
        self._contract = contract
        self._console = console or SafeConsole(highlight=False, markup=False)
        self._rows: list[_Row] = []
        self._started_s: float | None = None
        self._is_calibrated = True
        self._spinner = Spinner("dots", Text("closing the fingers …", style="dim"))
        self._live = Live(
            self, console=self._console, refresh_per_second=REFRESHES_PER_S, transient=True
        )

    def __enter__(self) -> Self:
        self._live.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._live.stop()
        if self._rows:
            self._console.print(self._table(self._rows, self._width))

    def __call__(self, record: StepRecord) -> None:
        """Add a step; drawing it is left to the table's thread."""
        self._is_calibrated = record.cloud.force_scale.is_calibrated
        if record.contract is not None:
            self._contract = record.contract
        if self._started_s is None:
            self._started_s = record.stamp.monotonic_s
        self._rows.append(self._row(record, record.stamp.monotonic_s - self._started_s))
        self._spinner.update(text=Text(f"step {record.index + 1} …", style="dim"))

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """The last steps that fit on the terminal, and a spinner below."""
        num_shown = max(1, (console.height - SPARE_ROWS) // 2)
        if self._rows:
            yield self._table(self._rows[-num_shown:], self._width)
        yield self._spinner

    @property
    def _width(self) -> int:
        return min(self._console.width, COLUMNS)

    def _row(self, record: StepRecord, elapsed_s: float) -> _Row:
        state = contact_state(record.cloud, in_contact=record.in_contact)
        cells = "nothing touches\n "
        if state.in_contact:
            place = place_text(state).removeprefix("at ")
            cut = ", cut" if state.cut else ""
            cells = f"{state.depth_mm:.2f} mm, {state.area_fraction:.0%}{cut}\n{place}"
        action = Text(action_text(record), style="bold")
        if record.executed is not None and record.executed.clamped:
            action.append(f" ({record.executed.clamped[0]})", style="yellow")
        if record.note:
            action.append(f" ({record.note})", style="yellow")
        return _Row(
            index=str(record.index),
            time=f"{elapsed_s:.1f}",
            felt=self._felt(record),
            contact=cells,
            text="" if record.decision is None else record.decision.text,
            action=action,
        )

    def _felt(self, record: StepRecord) -> Text:
        """The felt force, coloured by the step's target, over its interval."""
        felt, terms = record.felt_force_n, self._contract.terms
        if felt is None:
            return Text("-\n ")
        target = terms.force_n if record.need is None else record.need.force_n
        style = "green" if felt.value in target else "yellow"
        style = "red" if felt.value > terms.limit_n else style
        text = Text(f"{felt.value:.2f} N", style=style)
        return text.append(f"\n{felt.low:.2f}-{felt.high:.2f}", style="dim")

    def _table(self, rows: list[_Row], width: int) -> Table:
        band = self._contract.terms.force_n
        table = Table(
            box=None, width=width, header_style="dim", padding=(0, 2, 0, 0), pad_edge=False
        )
        widths = (4, 6, 12, 17)
        mark = "" if self._is_calibrated else f"\n{UNCALIBRATED_SOURCE}"
        table.add_column("step", justify="right", width=widths[0], no_wrap=True)
        table.add_column("time\n[s]", justify="right", width=widths[1], no_wrap=True)
        table.add_column(f"felt force\n{band.low:.2f}-{band.high:.2f} N{mark}", width=widths[2])
        table.add_column("depth, area\nplace", width=widths[3])
        table.add_column("said, and done", ratio=1)
        room = max(12, width - sum(widths) - 2 * len(widths))
        for row in rows:
            text = _cut(f"“{last_words(row.text, room - 2)}”" if row.text else "", room)
            last = Text(f"{text}\n" if text else "")
            last.append_text(row.action)
            last.truncate(len(text) + 1 + 2 * room)
            table.add_row(row.index, row.time, row.felt, row.contact, last)
        return table


def _cut(text: str, room: int) -> str:
    return text if len(text) <= room else f"{text[: room - 2]}…”"
