"""Which rows of the tables are there, which are missing, and which differ from what is wanted."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tacgrasp.pretraining.report.pages import PageSection, PageTable
from tacgrasp.pretraining.report.row_file import RowFile, missing
from tacgrasp.pretraining.report.rows import BUDGET, DATA, ROWS, row_command, wanted

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


def row_section(rows: Sequence[RowFile], folder: Path) -> PageSection:
    """The rows with points, samples and minutes; what is missing and what differs."""
    absent, marked = missing(rows), [row for row in rows if row.marks]
    text = (
        f"Made from {len(rows)} files of rows in {folder.as_posix()}. Nothing was trained or "
        f"measured for this page. {len(absent)} of {len(list(wanted()))} rows are missing; the "
        "command that makes each stands beside it."
    )
    parts = {recipe.part for recipe in ROWS.values()} - {1}
    budget = (
        f"One budget for every method: {BUDGET:,} samples seen by the encoder; rows of "
        f"{', '.join(map(str, sorted(parts)))} of it are marked so. Data {DATA['paper'][:16]}."
    )
    if marked:
        budget += f" {len(marked)} rows are of other data or of another budget, as marked."
    return PageSection(
        title="Rows",
        text=[text, budget],
        table=PageTable(head=list(HEAD), rows=row_statuses(rows)),
        note="Points: of the encoder's input; – for images, and where nothing is measured yet. "
        "Minutes: of the whole command in empty folders, CLIP's training included.",
    )


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
