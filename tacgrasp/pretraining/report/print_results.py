"""Print results of ``tacgrasp eval zero-shot | probe | retrieval``, and write their figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.table import Table

from tacgrasp.base.result_file import write_result
from tacgrasp.console import make_console, make_table_console
from tacgrasp.pretraining.report.store import (
    GEOMETRIC_BASELINE,
    TITLES,
    USUAL_VARIANTS,
    Result,
    grouped,
    means,
    merged_accuracy,
    nested,
)


def print_real_results(results: Sequence[Result], predictions: Path) -> None:
    """Print what the tables of real touches do not hold."""
    console = make_console()
    for result in results:
        merged = merged_accuracy(result, "sphere", "ellipsoid")
        if merged is not None:
            console.print(f"{result.method}: shape {merged:.1f} % with sphere and ellipsoid as one")
    console.print(f"one row a prediction: {predictions}", markup=False, highlight=False)
    if not all(result.data for result in results):
        console.print(
            "not stored for the report: these weights don't say what they were trained on"
        )


def print_results(results: Sequence[Result], json_path: Path | None) -> None:
    """Print a table for each table and split; write the figures where a path is given."""
    console = make_table_console()
    tables: dict[tuple[str, str], Table] = {}
    for (table, method, variant, split), rows in grouped(results).items():
        values = means(rows)
        if (table, split) not in tables:
            title = f"{table.replace('_', ' ')}, {split}: {rows[0].contacts} contacts"
            tables[table, split] = Table(title=title)
            tables[table, split].add_column("", justify="left")
            for column in values:
                tables[table, split].add_column(column.replace("_", " "), justify="right")
        is_plain = (method, variant) == (GEOMETRIC_BASELINE, USUAL_VARIANTS[GEOMETRIC_BASELINE])
        name = TITLES[method] + ("" if is_plain else f" ({variant})")
        cells = ("-" if value is None else f"{value:.3g}" for value in values.values())
        tables[table, split].add_row(name, *cells)
    for shown in tables.values():
        console.print(shown)
    write_figures(results, json_path)


def write_figures(
    results: Sequence[Result], json_path: Path | None, more: Mapping[str, Any] | None = None
) -> None:
    """Write figures as JSON, nested as by ``report.store.nested``; nothing without a path."""
    if json_path is not None:
        write_result(json_path, {**nested(grouped(results)), **(more or {})})
