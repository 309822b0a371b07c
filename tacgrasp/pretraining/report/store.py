"""Results of pre-training on disk: one JSON file for each table, method, trial and seed.

Each names the data by checksum, the budget, the seed and the command, so that a report can be put
together later from results alone, and refuses to put together what was measured on other data.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from cltp.atomic_write import write_atomically
from cltp.encoder.encoder import DEFAULT_PRESETS
from cltp.errors import TouchError
from cltp.tactile.states import CLASSES
from tacgrasp.base.errors import UsageError

FORMAT, VERSION = "tacgrasp-result", 1

TABLES = ("zero_shot", "zero_shot_ensemble", "probe", "numbers", "retrieval")

METHODS = {
    "point_bert": "Point-BERT",
    "point_mae": "Point-MAE",
    "cltp_no_image": "CLTP w/o image",
    "cltp": "CLTP",
    "unitouch": "UniTouch (image)",
    "tvl": "TVL (image)",
    "random": "random encoder",
    "ceiling": "ceiling",
}
"""Names of the methods, in the paper's order, and as tables write them."""

USUAL = {**DEFAULT_PRESETS, "ceiling": "measured"}
"""Variants that come first and that ``nested`` takes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Budget:
    """How much a method could learn.

    Attributes:
        steps: Optimiser steps of pre-training.
        batch_size: Contacts in each.
    """

    steps: int
    batch_size: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Result:
    """One row of a table.

    Attributes:
        table: Out of ``TABLES``.
        method: Out of ``METHODS``.
        variant: Encoder preset, and what differs from the method's usual recipe.
        trial: What it was tried on, out of ``cltp.evaluation.splits.TRIALS``, or ``real``.
        seed: Of what was learned here (probes) or drawn (noise).
        data: Checksum of the data set.
        budget: Of the pre-training; None where there was none.
        command: That measured this.
        contacts: How many were judged.
        values: Percent right, or median errors and coverages; None where nothing could be judged.
        confusion: By dimension, counts, truth by row; empty where there are no classes.
        device: On which the encoder was trained; None where nobody knows or nothing was.
        learned_seed: Of the pre-training; None likewise.

    Raises:
        UsageError: An unknown table or method.
    """

    table: str
    method: str
    variant: str
    trial: str
    seed: int
    data: str
    budget: Budget | None
    command: str
    contacts: int
    values: Mapping[str, float | None]
    confusion: Mapping[str, list[list[int]]] = field(default_factory=dict)
    device: str | None = None
    learned_seed: int | None = None

    def __post_init__(self) -> None:
        if self.table not in TABLES or self.method not in METHODS:
            raise UsageError(
                f"no table {self.table!r} or method {self.method!r}; tables are "
                f"{', '.join(TABLES)}, methods {', '.join(METHODS)}"
            )

    @property
    def file(self) -> str:
        """Its name in a folder: the same measurement again takes its place."""
        parts = (self.table, self.method, self.variant, self.trial, f"s{self.seed}")
        return "-".join(parts).replace("/", "_") + ".json"


def save(folder: Path, result: Result) -> Path:
    """Write a result, beside and then in its place.

    Raises:
        UsageError: It can't be written.
    """
    path = folder / result.file
    content = {"format": FORMAT, "version": VERSION, **asdict(result)}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_atomically(path, json.dumps(content, indent=1) + "\n")
    except OSError as error:
        raise UsageError(f"the result {path} can't be written: {error.strerror}") from None
    return path


def load(folder: Path) -> list[Result]:
    """All results of a folder.

    Raises:
        TouchError: One is damaged, of another version, or of other data than the others.
        UsageError: There are none.
    """
    found = [read(path) for path in sorted(folder.glob("*.json"))]
    if not found:
        raise UsageError(f"no results in {folder}; measure with `tacgrasp eval zero-shot|probe`")
    checksums = {result.data: result.file for result in found}
    if len(checksums) > 1:
        named = ", ".join(f"{file} ({data[:12]})" for data, file in checksums.items())
        raise TouchError(
            f"results in {folder} are of different data sets and make no table: {named}; "
            "measure again or keep them in folders of their own"
        )
    return found


def read(path: Path) -> Result:
    """One result.

    Raises:
        TouchError: It is damaged, or of another version.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if (content.pop("format"), content.pop("version")) != (FORMAT, VERSION):
            raise TouchError(f"{path} is no result of this version; measure again")
        budget = content.pop("budget")
        return Result(**content, budget=Budget(**budget) if budget is not None else None)
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise TouchError(f"the result {path} is damaged; measure again: {error}") from error


def percent(right: Mapping[str, float]) -> dict[str, float | None]:
    """Shares in %, None where there is no number."""
    return {name: None if math.isnan(v) else 100 * v for name, v in right.items()}


def nested(results: Iterable[Result]) -> dict[str, Any]:
    """Figures by table, method (of its usual variant) and trial; the seeds' mean.

    ``numbers`` has no methods: ``numbers.<trial>.<quantity>`` is of CLTP.
    """
    found: dict[str, Any] = {}
    for (table, method, _, trial), rows in grouped(results).items():
        figures = {name: mean([row.values.get(name) for row in rows]) for name in rows[0].values}
        place = found.setdefault(table, {})
        if table == "numbers":
            if method == "cltp":
                place.setdefault(trial, figures)
        else:
            place.setdefault(method, {}).setdefault(trial, figures)
    return found


Key = tuple[str, str, str, str]
"""Table, method, variant, trial."""


def grouped(results: Iterable[Result]) -> dict[Key, list[Result]]:
    """Results that differ in the seed alone, by table, method and variant, the usual first."""
    rows: dict[Key, list[Result]] = {}
    order = list(METHODS)

    def rank(result: Result) -> tuple[object, ...]:
        other = result.variant != USUAL[result.method]
        place = TABLES.index(result.table), order.index(result.method)
        return *place, other, result.variant, result.trial, result.seed

    ranked = sorted(results, key=rank)
    for result in ranked:
        key = (result.table, result.method, result.variant, result.trial)
        rows.setdefault(key, []).append(result)
    return rows


def usual_variant(method: str, results: Iterable[Result]) -> str | None:
    """The variant of a method that comes first among results; None without any."""
    there = sorted({result.variant for result in results if result.method == method})
    usual = USUAL[method]
    return usual if usual in there else next(iter(there), None)


def mean(values: Sequence[float | None]) -> float | None:
    """Of those that there are."""
    there = [value for value in values if value is not None]
    return sum(there) / len(there) if there else None


def spread(values: Sequence[float | None]) -> float | None:
    """Largest minus smallest; None for fewer than two."""
    there = [value for value in values if value is not None]
    return max(there) - min(there) if len(there) > 1 else None


def as_one(result: Result, one: str, other: str) -> float | None:
    """Percent of shapes right when two of them count as one; None where none is judged.

    Sphere and ellipsoid are hard to tell apart on frames of an uncalibrated unit.
    """
    counts = result.confusion.get("shape")
    total = sum(map(sum, counts)) if counts else 0
    if counts is None or not total:
        return None
    a, b = (CLASSES["shape"].index(name) for name in (one, other))
    right = sum(row[n] for n, row in enumerate(counts)) + counts[a][b] + counts[b][a]
    return 100 * right / total
