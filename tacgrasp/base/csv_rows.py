"""Rows of a CSV file that a person wrote."""

from __future__ import annotations

import csv
from pathlib import Path

from tacgrasp.base.errors import UsageError


def csv_rows(source: Path) -> list[dict[str, str]]:
    """All rows, by the names of the first line.

    Raises:
        UsageError: The file can't be read.
    """
    try:
        with source.open(encoding="utf-8-sig", newline="") as file:
            return list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise UsageError(f"{source} can't be read as CSV: {error}") from None
