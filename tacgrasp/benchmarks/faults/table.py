"""The fault matrix: what every fault came to, as figures, on the screen and in docs/faults.md."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from rich.table import Table

from tacgrasp.benchmarks.faults.cases import FaultCase, InjectionPhase
from tacgrasp.benchmarks.faults.injection import (
    RECOVERED_MS,
    REFUSED_S,
    STOPPED_MS,
    InjectionResult,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultRow:
    """What the repeats of one fault came to.

    Attributes:
        name: Of the fault.
        phase: start, motion or transient.
        injected: How often.
        detected: How often the driver said what it must, in time.
        stop_ms_p50, stop_ms_max: From injection to rest [ms]; None where nothing moves, or where
            the arm moves on.
        hung: How often a call did not come back.
        invented_value: How often a value was given that was not measured.
        moved: How often something moved that must not, or did not stop; for a transient fault, how
            often the move did not end where it should.
        noticed_ms_p50, noticed_ms_max: Until the program knew, or, for a transient fault, until the
            next good value [ms].
        told: What the operator was told, the last time.
        episode: What became of recorded episodes: 'intact', 'none begun', or what was wrong.
    """

    name: str
    phase: str
    injected: int
    detected: int
    stop_ms_p50: float | None
    stop_ms_max: float | None
    hung: int
    invented_value: int
    moved: int
    noticed_ms_p50: float
    noticed_ms_max: float
    told: str
    episode: str

    @property
    def passed(self) -> bool:
        """Whether the fault was dealt with every time as it must be."""
        in_time = self.stop_ms_max is None or self.stop_ms_max <= STOPPED_MS
        clean = not (self.hung or self.invented_value or self.moved)
        whole = self.episode in ("intact", "none begun")
        return self.detected == self.injected and clean and in_time and whole


def row_of(case: FaultCase, trials: Sequence[InjectionResult]) -> FaultRow:
    """Sum up the repeats of one fault."""
    stops = [t.stop_ms for t in trials if t.stop_ms is not None]
    bare = [t for t in trials if not t.episode]  # an episode is noticed only when it has ended
    noticed = [t.noticed_ms for t in (bare or trials)]
    wrong = {t.episode for t in trials if t.episode} - {"intact"}
    whole = "none begun" if case.phase is InjectionPhase.START else "intact"
    return FaultRow(
        name=case.name,
        phase=case.phase.value,
        injected=len(trials),
        detected=sum(t.detected for t in trials),
        stop_ms_p50=median(stops) if stops else None,
        stop_ms_max=max(stops, default=None),
        hung=sum(t.hung for t in trials),
        invented_value=sum(t.invented for t in trials),
        moved=sum(t.moved for t in trials),
        noticed_ms_p50=median(noticed),
        noticed_ms_max=max(noticed),
        told=trials[-1].told,
        episode="; ".join(sorted(wrong)) or whole,
    )


_COLUMNS = (
    "fault",
    "phase",
    "detected",
    "at rest, ms",
    "noticed, ms",
    "hung",
    "invented",
    "episode",
)


def table_of(rows: Sequence[FaultRow]) -> Table:
    """For the screen; rows that are not as they must be are red."""
    table = Table(title="faults of the emulated rig: p50 / max")
    for column in _COLUMNS:
        left = column in ("fault", "phase")
        table.add_column(column, justify="left" if left else "right", no_wrap=column == "fault")
    for row in rows:
        table.add_row(*_cells(row), style="" if row.passed else "red")
    return table


def markdown_of(rows: Sequence[FaultRow], command: str) -> str:
    """The page docs/faults.md."""
    lines = [
        "# Faults",
        "",
        f"Written by `{command}`. Every fault is injected into the emulated rig through its",
        "control channel; drivers and device libraries are those of real hardware. Times to rest",
        "are measured by the emulator, from the injection until the tool is below 1 mm/s, at",
        f"0.4 m/s. Required: faults at the start are refused within {REFUSED_S:g} s and nothing",
        f"moves; in motion the arm is at rest within {STOPPED_MS:g} ms; a passing fault is",
        f"survived within {RECOVERED_MS:g} ms and counted. One repeat of every fault in motion,",
        "and of every passing one, is inside a recorded episode. What real hardware alone can show",
        "is listed in [hardware.md](hardware.md).",
        "",
        "| " + " | ".join(_COLUMNS) + " |",
        "|---|---|" + "---:|" * 5 + "---|",
        *("| " + " | ".join(_cells(row)) + " |" for row in rows),
        "",
        "## What the arm did, and what the operator was told",
        "",
    ]
    for row in rows:
        lines += [f"- **{row.name}**: {_did(row)} “{row.told}”"]
    return "\n".join(lines) + "\n"


def _did(row: FaultRow) -> str:
    if row.phase == InjectionPhase.START:
        return "nothing moved."
    if row.phase == InjectionPhase.TRANSIENT:
        return "the arm moved on and arrived."
    return "the arm came to rest."


def _cells(row: FaultRow) -> tuple[str, ...]:
    stop = "-" if row.stop_ms_p50 is None else f"{row.stop_ms_p50:.0f} / {row.stop_ms_max:.0f}"
    return (
        row.name,
        row.phase,
        f"{row.detected} of {row.injected}",
        stop,
        f"{row.noticed_ms_p50:.0f} / {row.noticed_ms_max:.0f}",
        str(row.hung),
        str(row.invented_value),
        row.episode,
    )
