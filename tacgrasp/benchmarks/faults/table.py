"""The table of the fault benchmark: figures per fault, on the screen and in docs/faults.md."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np
from rich.table import Table

from tacgrasp.benchmarks.faults.cases import FaultCase, InjectionPhase
from tacgrasp.benchmarks.faults.reaction import (
    LOADED_MS,
    RECOVERED_MS,
    REFUSED_S,
    STOPPED_MS,
    InjectionResult,
)
from tacgrasp.benchmarks.figures import number_table


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultRow:
    """Figures of the repeats of one fault; the attributes are the keys of the JSON file.

    Attributes:
        name: Name of the fault.
        phase: start, motion or transient.
        injected: Number of repeats.
        detected: Number of repeats in which the driver reported the fault as expected, in time.
        stop_ms_p50, stop_ms_p95, stop_ms_max: Time from injection to rest [ms]; None where nothing
            moves, or where the arm moves on.
        hung: Number of calls that did not return.
        invented_value: Number of returned values that were not measured.
        moved: Number of repeats in which something moved although it must not, or did not stop; for
            a transient fault, in which the move did not end at its target.
        noticed_ms_p50, noticed_ms_max: Time until the program noticed, by holding the arm or by a
            fault; for a transient fault, until the next good value [ms].
        spurious: Number of repeats in which another fault was reported than the injected one.
        load: Whether all cores were kept busy.
        told: Last message to the operator, or that of the first repeat that was not as expected.
        episode: State of recorded episodes: 'intact', 'none begun', or their problem.
    """

    name: str
    phase: str
    injected: int
    detected: int
    stop_ms_p50: float | None
    stop_ms_p95: float | None
    stop_ms_max: float | None
    hung: int
    invented_value: int
    moved: int
    noticed_ms_p50: float
    noticed_ms_max: float
    told: str
    episode: str
    spurious: int
    load: bool

    @property
    def passed(self) -> bool:
        longest_ms = LOADED_MS if self.load else STOPPED_MS
        in_time = self.stop_ms_max is None or self.stop_ms_max <= longest_ms
        clean = not (self.hung or self.invented_value or self.moved or self.spurious)
        is_recorded = self.episode in ("intact", "none begun")
        return self.detected == self.injected and clean and in_time and is_recorded


def row_of(case: FaultCase, results: Sequence[InjectionResult], *, load: bool = False) -> FaultRow:
    """Figures of the repeats of one fault."""
    stops = [r.stop_ms for r in results if r.stop_ms is not None]
    timed = [r for r in results if not r.episode]  # an episode's fault is noticed only at its end
    noticed = [r.noticed_ms for r in (timed or results)]
    problems = {r.episode for r in results if r.episode} - {"intact"}
    no_problem = "none begun" if case.phase is InjectionPhase.START else "intact"
    return FaultRow(
        name=case.name,
        phase=case.phase.value,
        injected=len(results),
        detected=sum(r.detected for r in results),
        stop_ms_p50=median(stops) if stops else None,
        stop_ms_p95=float(np.percentile(stops, 95)) if stops else None,
        stop_ms_max=max(stops, default=None),
        hung=sum(r.hung for r in results),
        invented_value=sum(r.invented for r in results),
        moved=sum(r.moved for r in results),
        noticed_ms_p50=median(noticed),
        noticed_ms_max=max(noticed),
        told=next(
            (r.message for r in results if r.spurious or not r.detected), results[-1].message
        ),
        episode="; ".join(sorted(problems)) or no_problem,
        spurious=sum(r.spurious for r in results),
        load=load,
    )


_COLUMNS = (
    "fault",
    "phase",
    "detected",
    "at rest, ms",
    "noticed, ms",
    "hung",
    "invented",
    "spurious",
    "episode",
)
_REACTIONS: Mapping[str, str] = {
    InjectionPhase.START: "nothing moved.",
    InjectionPhase.MOTION: "the arm came to rest.",
    InjectionPhase.TRANSIENT: "the arm moved on and arrived.",
}


def table_of(rows: Sequence[FaultRow]) -> Table:
    """Table for the screen; rows of faults that did not pass are red."""
    table = number_table(
        "faults of the emulated rig: p50 / p95 / max", _COLUMNS, ("fault", "phase")
    )
    table.columns[0].no_wrap = True
    for row in rows:
        table.add_row(*_cells(row), style="" if row.passed else "red")
    return table


def markdown_of(rows: Sequence[FaultRow], command: str) -> str:
    """The text of docs/faults.md."""
    lines = [
        "# Faults",
        "",
        f"Written by `{command}`. Every fault is injected into the emulated rig through its",
        "control channel; drivers and device libraries are those of real hardware. Times to rest",
        "are measured by the emulator, from the injection at 0.4 m/s until the tool is below",
        f"1 mm/s. Requirements: a fault at the start is refused within {REFUSED_S:g} s and nothing",
        f"moves; after a fault in motion the arm is at rest within {STOPPED_MS:g} ms, and within",
        f"{LOADED_MS:g} ms with all cores busy; a transient fault is survived within",
        f"{RECOVERED_MS:g} ms and counted. A device that falls silent is noticed when its last",
        "reading is older than two of its periods and 20 ms: the arm is held, and the fault comes",
        "after a second. One repeat of every fault in motion and of every transient fault happens",
        "inside a recorded episode. After a fault the gripper does as the task says, but what may",
        "hang in the air is not released: see [hardware.md](hardware.md), which also lists the",
        "checks that need real hardware.",
        "",
        "| " + " | ".join(_COLUMNS) + " |",
        "|---|---|" + "---:|" * 6 + "---|",
        *("| " + " | ".join(_cells(row)) + " |" for row in rows),
        "",
        "## Reaction of the arm and message to the operator",
        "",
    ]
    for row in rows:
        lines += [f"- **{row.name}**: {_REACTIONS[row.phase]} “{row.told}”"]
    return "\n".join(lines) + "\n"


def _cells(row: FaultRow) -> tuple[str, ...]:
    stop = "-"
    if row.stop_ms_p50 is not None:
        stop = f"{row.stop_ms_p50:.0f} / {row.stop_ms_p95:.0f} / {row.stop_ms_max:.0f}"
    return (
        row.name,
        row.phase,
        f"{row.detected} of {row.injected}",
        stop,
        f"{row.noticed_ms_p50:.0f} / {row.noticed_ms_max:.0f}",
        str(row.hung),
        str(row.invented_value),
        str(row.spurious),
        row.episode,
    )
