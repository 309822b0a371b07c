"""Which rows of the tables are there, which are missing, and which differ from what is wanted.

Loads no torch, so that a list of rows is printed at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from tacgrasp.pretraining.report.row_file import RowFile, missing
from tacgrasp.pretraining.report.rows import ROWS, row_command, wanted

HEAD = ("row", "seed", "what it is", "points", "samples", "minutes", "state")

MEASURED = "measured"


def row_statuses(rows: Sequence[RowFile]) -> list[list[str]]:
    """Cells of ``HEAD`` for every row that is wanted, then for those that are there besides."""
    there = {(row.row, row.seed): row for row in rows}
    order = dict.fromkeys([*wanted(), *there])
    return [_cells(name, seed, there.get((name, seed))) for name, seed in order]


def _cells(name: str, seed: int, row: RowFile | None) -> list[str]:
    recipe = ROWS.get(name)
    title = [name.replace("_", "-"), str(seed), recipe.about if recipe else "–"]
    if row is None:
        samples = f"{recipe.samples:,}" if recipe else "–"
        return [*title, "–", samples, "–", f"missing: {row_command(name, seed)}"]
    minutes = "–" if row.total_minutes is None else f"{row.total_minutes:.0f}"
    state = "; ".join(row.marks) or MEASURED
    return [*title, points_text(row.points), f"{row.samples:,}", minutes, state]


def points_text(points: int | None) -> str:
    """Number of points of an encoder's input; none for images."""
    return "–" if points is None else f"{points:,}"


def row_figures(rows: Sequence[RowFile]) -> dict[str, Any]:
    """Points, samples, minutes, data and marks by row and seed, and the missing ones' commands."""
    made: dict[str, dict[str, Any]] = {}
    for row in rows:
        made.setdefault(row.row, {})[f"seed{row.seed}"] = {
            "points": row.points,
            "samples": row.samples,
            "minutes": row.total_minutes,
            "data": row.data,
            "marks": row.marks,
            "scores": row.scores,
        }
    return {"rows": made, "missing": [row_command(*each) for each in missing(rows)]}
