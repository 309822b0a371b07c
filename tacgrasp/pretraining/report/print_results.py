"""Print results of ``tacgrasp eval zero-shot | probe | retrieval``, and write their figures."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table

from tacgrasp.pretraining.report.store import METHODS, USUAL, Result, as_one, grouped, mean, nested


def show_real(found: Sequence[Result], predictions: Path) -> None:
    """Print what a table does not hold of real touches."""
    to = Console(soft_wrap=True)
    for result in found:
        merged = as_one(result, "sphere", "ellipsoid")
        if merged is not None:
            to.print(f"{result.method}: shape {merged:.1f} % with sphere and ellipsoid as one")
    to.print(f"one row a prediction: {predictions}", markup=False, highlight=False)
    if not all(result.data for result in found):
        to.print("not stored for the report: these weights don't say what they were trained on")


def show(found: Sequence[Result], json_path: Path | None) -> None:
    """Print a table for each table and trial; write the figures where they are wanted."""
    to = Console()
    to = to if to.is_terminal else Console(width=160)
    by_table: dict[tuple[str, str], list[tuple[str, list[Result]]]] = {}
    for (table, method, variant, trial), rows in grouped(found).items():
        plain = (method, variant) == ("ceiling", USUAL["ceiling"])
        name = METHODS[method] + ("" if plain else f" ({variant})")
        by_table.setdefault((table, trial), []).append((name, rows))
    for (table, trial), lines in by_table.items():
        count = lines[0][1][0].contacts
        shown = Table(title=f"{table.replace('_', ' ')}, {trial}: {count} contacts")
        shown.add_column("", justify="left")
        columns = list(lines[0][1][0].values)
        for column in columns:
            shown.add_column(column.replace("_", " "), justify="right")
        for name, rows in lines:
            values = (mean([row.values.get(column) for row in rows]) for column in columns)
            shown.add_row(name, *("-" if v is None else f"{v:.3g}" for v in values))
        to.print(shown)
    write_figures(found, json_path)


def write_figures(found: Sequence[Result], json_path: Path | None) -> None:
    """Write figures as JSON, nested as by ``report.store.nested``; nothing without a path."""
    if json_path is None:
        return
    json_path.write_text(json.dumps(nested(found), indent=1) + "\n", encoding="utf-8")
