"""What was tried on the way to the results: a table that a person keeps beside them, ``tries.csv``.

A row a try. Columns: ``about`` (sampling, points, groups, prompts, loss, data, ...), ``tried``,
``table``, ``trial``, the five dimensions in % right (empty where not measured), ``note`` (why it is
so, what followed) and ``command``.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

from cltp.tactile.states import CLASSES
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.report.store import TABLES

FILE = "tries.csv"
COLUMNS = ("about", "tried", "table", "trial", *CLASSES, "note", "command")


@dataclass(frozen=True, slots=True, kw_only=True)
class Try:
    """One of them; see ``COLUMNS``.

    Attributes:
        about: What was varied.
        tried: How.
        table: Out of ``tacgrasp.pretraining.report.store.TABLES``.
        trial: What it was tried on.
        right: Percent by dimension; None where not measured.
        note: Why it is so, or what followed.
        command: That measured it.
    """

    about: str
    tried: str
    table: str
    trial: str
    right: dict[str, float | None]
    note: str
    command: str


def load_tries(results: Path) -> list[Try]:
    """The tries beside results, in the order of the file; none without a file.

    Raises:
        UsageError: The file, a column or a row is wrong; it names file and row.
    """
    path = results / FILE
    if not path.exists():
        return []
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file, restkey="", restval="")
            names = tuple(reader.fieldnames or ())
            rows = list(reader)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise UsageError(f"tries can't be read from {path}: {error}") from None
    if set(names) != set(COLUMNS):
        raise UsageError(f"{path} needs the columns {', '.join(COLUMNS)}, got {', '.join(names)}")
    return [_try(path, number, row) for number, row in enumerate(rows, start=2)]


def _try(path: Path, number: int, row: dict[str, str]) -> Try:
    if "" in row:
        raise UsageError(f"{path}, row {number}: more cells than columns; quote cells with commas")
    if row["table"] not in TABLES or not row["tried"]:
        raise UsageError(
            f"{path}, row {number}: needs what was tried, and a table out of {', '.join(TABLES)}"
        )
    right: dict[str, float | None] = {}
    for slot in CLASSES:
        try:
            right[slot] = float(row[slot]) if row[slot].strip() else None
        except ValueError:
            raise UsageError(f"{path}, row {number}: no number in {slot}: {row[slot]!r}") from None
        if not 0 <= (right[slot] or 0.0) <= 100:
            raise UsageError(f"{path}, row {number}: {slot} {row[slot]} is no percentage")
    return Try(
        about=row["about"],
        tried=row["tried"],
        table=row["table"],
        trial=row["trial"],
        right=right,
        note=row["note"],
        command=row["command"],
    )
