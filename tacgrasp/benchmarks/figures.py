"""What all benchmarks share: durations of a call, tables of numbers, the file of figures."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from rich.table import Table

from tacgrasp.base.result_file import write_result


@dataclass(frozen=True, slots=True)
class Figure:
    """One line of a benchmark's table.

    Attributes:
        key: Name in the JSON file.
        what: The measured quantity in words.
        value: The result; None where it was not measured.
        unit: Its unit, empty for a ratio.
        note: Setting, limit, or the reason why there is no value.
    """

    key: str
    what: str
    value: float | None
    unit: str
    note: str


def times_ms(
    call: Callable[[], object],
    repeats: int,
    *,
    warm_up: int = 1,
    clock: Callable[[], float] = time.perf_counter,
) -> list[float]:
    """Durations of ``repeats`` calls, after ``warm_up`` calls that don't count [ms]."""
    times = []
    for _ in range(warm_up + repeats):
        began = clock()
        call()
        times.append(1e3 * (clock() - began))
    return times[warm_up:]


def median_ms(call: Callable[[], object], repeats: int) -> float:
    """Median duration of a call [ms]."""
    return median(times_ms(call, repeats))


def number_table(title: str, columns: Sequence[str], text: Sequence[str] = ("",)) -> Table:
    """An empty table; all columns but those named in ``text`` are aligned to the right."""
    table = Table(title=title)
    for column in columns:
        table.add_column(column, justify="left" if column in text else "right")
    return table


def write_figures(path: Path | None, report: Mapping[str, Any]) -> None:
    """Write the figures as JSON if a path is given: a file all at once, or to a pipe.

    Raises:
        UsageError: The file can't be written.
    """
    if path is not None:
        write_result(path, report)
