"""Files of rows: everything that one row of the tables measured, in one JSON file for each seed.

A file is made by ``tacgrasp eval row`` and read by ``tacgrasp eval report``, which trains and
measures nothing. Its ``scores`` have the keys of ``report --json``.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, ClassVar

from cltp.atomic_write import write_atomically
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.report.rows import DATA, ROWS, wanted
from tacgrasp.pretraining.report.store import (
    ROW_FILES,
    VERSION,
    Budget,
    Result,
    grouped,
    load,
    nested,
)

PLOTTED = ("zero_shot", "probe")
"""Tables whose confusion matrices a page draws, of CLTP."""

_DIGITS = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class RowFile:
    """One row, made with one seed.

    Attributes:
        row: Name out of ``rows.ROWS``.
        seed: Random seed of pre-training, noise and probes.
        method: Name out of ``store.TITLES``.
        variant: Encoder preset, and what differs from the method's usual recipe.
        command: Command that makes it, without the folders of the machine that did.
        data: ``ContactDataset.origin`` of the data set that was measured on.
        learned_from: That of the data set that was learned from; None where nothing was.
        checksums: SHA-256 of both as they were on the machine that made the row, by name.
        budget: Size of the pre-training; None where there was none.
        points: Points of the encoder's input; None for images.
        minutes: Minutes by part: ``clip``, ``train``, ``measure``; None where unknown.
        limit: Largest number of contacts of each split; None for all.
        precision: Precision of matrix products in training.
        device: Device that the encoder was trained on; None where it was not trained.
        versions: Versions by package.
        contacts: Number of contacts by split.
        scores: By table, method, split and dimension, as ``store.nested`` makes them.
        confusion: Counts by table, split and dimension, where a page draws them.
    """

    format: ClassVar[str] = "tacgrasp-row"

    row: str
    seed: int
    method: str
    variant: str
    command: str
    data: str
    learned_from: str | None
    checksums: Mapping[str, str]
    budget: Budget | None
    points: int | None
    minutes: Mapping[str, float | None]
    limit: int | None
    precision: str
    device: str | None
    versions: Mapping[str, str]
    contacts: Mapping[str, int]
    scores: Mapping[str, Any]
    confusion: Mapping[str, Mapping[str, Mapping[str, list[list[int]]]]] = field(
        default_factory=dict
    )

    @property
    def file(self) -> str:
        """Name of its file."""
        return file_name(self.row, self.seed)

    @property
    def samples(self) -> int:
        """Samples that the encoder saw."""
        return 0 if self.budget is None else self.budget.samples

    @property
    def total_minutes(self) -> float | None:
        """Minutes of all parts, as of one command in empty folders; None where one is unknown."""
        known = [value for value in self.minutes.values() if value is not None]
        return sum(known) if len(known) == len(self.minutes) else None

    @property
    def marks(self) -> list[str]:
        """What differs from the row that the list wants: data, budget, number of contacts."""
        wanted_row = ROWS.get(self.row)
        if wanted_row is None:
            return ["not in the list of rows"]
        marks = []
        if self.data != DATA["paper"]:
            marks.append(f"other data ({self.data:.60})")
        other = wanted_row.learns_from != "paper"
        expected = DATA[wanted_row.learns_from] if other else self.data
        if self.learned_from not in (None, expected):
            marks.append(f"learned from other data ({self.learned_from:.60})")
        if self.samples != wanted_row.samples:
            marks.append(f"{self.samples:,} samples, not {wanted_row.samples:,}")
        if self.limit is not None:
            marks.append(f"at most {self.limit} contacts of a split")
        return marks

    def results(self) -> list[Result]:
        """Its results, marked in their variants, so that they are never averaged with others."""
        return [
            self._result(table, method, split, values)
            for table, of_table in self.scores.items()
            for method, of_method in (
                {self.method: of_table} if table == "numbers" else of_table
            ).items()
            for split, values in of_method.items()
        ]

    def _result(self, table: str, method: str, split: str, values: Mapping[str, Any]) -> Result:
        """One of them; a row of captions also has trivial ones, which are of no method."""
        is_own = method == self.method
        return Result(
            table=table,
            method=method,
            variant=", ".join([self.variant, *self.marks]) if is_own else "",
            split=split,
            seed=self.seed,
            data=self.data,
            budget=self.budget,
            command=self.command,
            contacts=self.contacts[split],
            values={k: v for k, v in values.items() if not isinstance(v, Mapping)},
            confusion=self.confusion.get(table, {}).get(split, {}),
            device=self.device,
            learned_seed=None if self.learned_from is None else self.seed,
            points=self.points,
            minutes=self.total_minutes,
            title=ROWS[self.row].about if is_own and self.row in ROWS else "",
        )


def file_name(row: str, seed: int) -> str:
    """Name of the file of a row."""
    return f"{row}-seed{seed}.json"


def measured(results: Sequence[Result]) -> dict[str, Any]:
    """``contacts``, ``scores`` and ``confusion`` of a row from all of its results."""
    confusion: dict[str, dict[str, Any]] = {}
    for result in results:
        if result.method == "cltp" and result.table in PLOTTED and result.confusion:
            confusion.setdefault(result.table, {})[result.split] = result.confusion
    return {
        "contacts": {result.split: result.contacts for result in results},
        "scores": _rounded(nested(grouped(results))),
        "confusion": confusion,
    }


def _rounded(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _rounded(each) for key, each in value.items()}
    return round(value, _DIGITS) if isinstance(value, float) else value


def save_row(folder: Path, row: RowFile) -> Path:
    """Write a row atomically, in the place of an earlier one.

    Raises:
        UsageError: It can't be written.
    """
    header = {"format": row.format, "version": VERSION, "samples": row.samples}
    lines = [f" {json.dumps(key)}: {_text(value)}" for key, value in (header | asdict(row)).items()]
    path = folder / row.file
    try:
        folder.mkdir(exist_ok=True)
        write_atomically(path, "{\n" + ",\n".join(lines) + "\n}\n")
    except OSError as error:
        raise UsageError(f"{path} can't be written: {error.strerror}") from None
    return path


def _text(value: Any, depth: int = 3) -> str:
    """JSON with a line for each split, and none for each count of a confusion matrix."""
    if not isinstance(value, Mapping) or depth == 0 or not value:
        return json.dumps(value)
    pad = " " * (5 - depth)
    rows = (f"{pad}{json.dumps(key)}: {_text(each, depth - 1)}" for key, each in value.items())
    return "{\n" + ",\n".join(rows) + "\n" + pad[1:] + "}"


def load_rows(folder: Path) -> list[RowFile]:
    """All rows of a folder, in the order of the list; may be none.

    Raises:
        TouchError: One is damaged, or of another version.
    """
    rows = [load(RowFile, path) for path in sorted(folder.glob(ROW_FILES))]
    order = list(ROWS)
    return sorted(
        rows, key=lambda r: (order.index(r.row) if r.row in ROWS else len(order), r.row, r.seed)
    )


def missing(rows: Iterable[RowFile]) -> list[tuple[str, int]]:
    """Name and seed of the rows that are wanted and not there; a marked one is there."""
    there = {(row.row, row.seed) for row in rows}
    return [each for each in wanted() if each not in there]
