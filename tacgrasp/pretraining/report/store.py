"""Stored results: one JSON file for each table, method, evaluation split and seed.

Each result names the data by checksum, the budget, the seed and the command, so that a report can
be made later from results alone, and is refused where they were measured on different data.

Not here: the files that hold all results of a row (``row_file``).
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from itertools import groupby
from operator import attrgetter
from pathlib import Path
from typing import Any, ClassVar, Protocol, TypeVar

from pydantic import TypeAdapter

from cltp.atomic_write import write_atomically
from cltp.errors import TouchError
from cltp.tactile.states import CLASSES
from cltp.train.methods import METHODS
from tacgrasp.base.errors import UsageError

VERSION = 2
"""Version of the format of every measurement."""

ROW_FILES = "*-seed*.json"
"""Files of whole rows among those of a folder."""


class Stored(Protocol):
    """What a file of this module's formats holds."""

    format: ClassVar[str]


M = TypeVar("M", bound=Stored)

CAPTIONS = "captions"
"""The table of rated captions (``tacgrasp eval captions``)."""

TABLES = (
    "zero_shot",
    "zero_shot_ensemble",
    "zero_shot_unseen",
    "zero_shot_synonyms",
    "probe",
    "numbers",
    "retrieval",
    CAPTIONS,
)

GEOMETRIC_BASELINE = "geometric_baseline"
MOST_FREQUENT, SHUFFLED, EXACT_HEIGHTS = "most_frequent", "shuffled", "exact_heights"
"""Trivial captions: always the same one, and that of another contact."""

EVERY_NUMBER, WORDS_ALONE = "every_number", "words_alone"
"""Captions of Tac3D-LLM with every number, however well known, and without any."""

TITLES = {name: method.title for name, method in METHODS.items()} | {
    GEOMETRIC_BASELINE: "geometric baseline",
    MOST_FREQUENT: "most frequent caption",
    SHUFFLED: "another contact's caption",
    EXACT_HEIGHTS: "exact heights, true shape and texture",
    EVERY_NUMBER: "Tac3D-LLM, every number said",
    WORDS_ALONE: "Tac3D-LLM, its words alone",
}
"""Names in tables, in the order of rows: the methods, then the baselines that have no encoder."""

USUAL_VARIANTS = {name: method.preset for name, method in METHODS.items()} | {
    GEOMETRIC_BASELINE: "measured",
    MOST_FREQUENT: "",
    SHUFFLED: "",
    EXACT_HEIGHTS: "",
    EVERY_NUMBER: "",
    WORDS_ALONE: "",
}
"""The variant of each method that stands first, and whose figures ``nested`` takes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Budget:
    """Size of a pre-training.

    Attributes:
        steps: Number of optimiser steps.
        batch_size: Contacts in each.
    """

    steps: int
    batch_size: int

    @property
    def samples(self) -> int:
        """Samples seen, each as often as it was drawn."""
        return self.steps * self.batch_size


@dataclass(frozen=True, slots=True, kw_only=True)
class Measurement:
    """What was measured; the same measurement again takes the place of an earlier one.

    Attributes:
        format: Name of the file format.
        folder: Folder of the files within that of all results.
        table: Name out of ``TABLES``.
        method: Name out of ``TITLES``.
        variant: Encoder preset, and what differs from the method's usual recipe.
        split: Name out of ``cltp.evaluation.splits.EVALUATION_SPLITS``, or ``real``.
        seed: Random seed of the probes and of the noise.
        data: Checksum of the data set.

    Raises:
        UsageError: An unknown table or method.
    """

    format: ClassVar[str]
    folder: ClassVar[str] = ""

    table: str
    method: str
    variant: str
    split: str
    seed: int
    data: str

    def __post_init__(self) -> None:
        if self.table not in TABLES or self.method not in TITLES:
            raise UsageError(
                f"no table {self.table!r} or method {self.method!r}; tables are "
                f"{', '.join(TABLES)}, methods {', '.join(TITLES)}"
            )

    @property
    def file(self) -> str:
        """Name of its file in a folder."""
        parts = (self.table, self.method, self.variant, self.split, f"s{self.seed}")
        return "-".join(parts).replace("/", "_") + ".json"


@dataclass(frozen=True, slots=True, kw_only=True)
class Result(Measurement):
    """One row of a table.

    Attributes:
        budget: Budget of the pre-training; None where there was none.
        command: Command that measured it.
        contacts: Number of contacts.
        values: Percent right, or median errors and coverages; None without a labelled contact.
        confusion: Counts by dimension, labels by row; empty where there are no classes.
        device: Device that the encoder was trained on; None where unknown or not trained.
        learned_seed: Random seed of the pre-training; None likewise.
        judge: What rated captions beside the rule; '' where nothing did.
        points: Points of the encoder's input; None for images, or where unknown.
        minutes: Minutes of training and measuring together; None where unknown.
        title: Name in tables; that of the method when empty.
    """

    format: ClassVar[str] = "tacgrasp-result"

    budget: Budget | None
    command: str
    contacts: int
    values: Mapping[str, float | None]
    confusion: Mapping[str, list[list[int]]] = field(default_factory=dict)
    device: str | None = None
    learned_seed: int | None = None
    judge: str = ""
    points: int | None = None
    minutes: float | None = None
    title: str = ""

    @property
    def name(self) -> str:
        """Name in tables."""
        return self.title or TITLES[self.method]


def save(folder: Path, measurement: Measurement) -> Path:
    """Write a measurement atomically, in the place of an earlier one.

    Raises:
        UsageError: It can't be written.
    """
    path = folder / measurement.folder / measurement.file
    document = {"format": measurement.format, "version": VERSION, **asdict(measurement)}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, json.dumps(document, indent=1) + "\n")
    except OSError as error:
        raise UsageError(f"{path} can't be written: {error.strerror}") from None
    return path


def load(kind: type[M], path: Path) -> M:
    """Read a measurement.

    Raises:
        TouchError: It is none, is damaged, or of another format or version.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(content, dict) or "format" not in content:
            raise TouchError(f"{path} is no measurement; name another folder, or move it")
        stored = content["format"], content["version"]
        if stored == (kind.format, VERSION):
            return TypeAdapter(kind).validate_python(content)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise TouchError(f"{path} is damaged; measure again: {error}") from error
    raise TouchError(
        f"{path} is {stored[0]} of version {stored[1]}, not {kind.format} of version {VERSION}; "
        "delete it and measure again"
    )


def load_results(folder: Path) -> list[Result]:
    """All results of a folder, but for those in the files of rows; may be none.

    Raises:
        TouchError: One is damaged, of another version, or of other data than the others.
    """
    paths = sorted({*folder.glob("*.json")} - {*folder.glob(ROW_FILES)})
    results = [load(Result, path) for path in paths]
    checksums = {result.data: result.file for result in results}
    if len(checksums) > 1:
        named = ", ".join(f"{file} ({data[:12]})" for data, file in checksums.items())
        raise TouchError(
            f"results in {folder} are of different data sets and make no table: {named}; "
            "measure again or keep them in folders of their own"
        )
    return results


Key = tuple[str, str, str, str]
"""Table, method, variant, split."""

Groups = Mapping[Key, Sequence[Result]]
"""Results that differ in the seed alone."""


def grouped(results: Iterable[Result]) -> Groups:
    """Group results by table, method, variant and split; the usual variant stands first."""
    order = list(TITLES)

    def rank(result: Result) -> tuple[object, ...]:
        is_other = result.variant != USUAL_VARIANTS[result.method]
        row = TABLES.index(result.table), order.index(result.method)
        return *row, is_other, result.variant, result.split, result.seed

    ranked = groupby(sorted(results, key=rank), attrgetter("table", "method", "variant", "split"))
    return {key: list(rows) for key, rows in ranked}


def means(rows: Sequence[Result]) -> dict[str, float | None]:
    """Means over seeds of every value of a group."""
    return {name: mean([row.values.get(name) for row in rows]) for name in rows[0].values}


def nested(groups: Groups) -> dict[str, Any]:
    """Means by table, method (of its usual variant) and split.

    ``numbers`` has no methods: ``numbers.<split>.<quantity>`` is of CLTP.
    """
    tables: dict[str, Any] = {}
    for (table, method, _, split), rows in groups.items():
        of_table = tables.setdefault(table, {})
        if table != "numbers":
            of_table.setdefault(method, {}).setdefault(split, means(rows))
        elif method == "cltp":
            of_table.setdefault(split, with_quantities(means(rows)))
    return tables


def with_quantities(values: Mapping[str, float | None]) -> dict[str, Any]:
    """Figures of numbers, and beside them ``median_error``, ``inside`` and ``width`` of each.

    Depth and position are in mm, area and force in % of the true value, inside in %.
    """
    units = {"depth": "mm", "position": "mm", "area": "percent", "force": "percent"}
    quantities = {
        name: {
            "median_error": values.get(f"{name}_{unit}"),
            "inside": values.get(f"coverage_{name}"),
            "width": values.get(f"width_{name}"),
        }
        for name, unit in units.items()
    }
    return {**values, **quantities}


def mean(values: Sequence[float | None]) -> float | None:
    """Mean of the numbers among values; None without any."""
    numbers = [value for value in values if value is not None]
    return sum(numbers) / len(numbers) if numbers else None


def spread(values: Sequence[float | None]) -> float | None:
    """Largest minus smallest of the numbers among values; None for fewer than two."""
    numbers = [value for value in values if value is not None]
    return max(numbers) - min(numbers) if len(numbers) > 1 else None


def merged_accuracy(result: Result, one: str, other: str) -> float | None:
    """Percent of shapes right when two shapes count as one; None without a labelled shape.

    Sphere and ellipsoid are hard to tell apart on frames of an uncalibrated unit.
    """
    counts = result.confusion.get("shape")
    total = sum(map(sum, counts)) if counts else 0
    if counts is None or not total:
        return None
    a, b = (CLASSES["shape"].index(name) for name in (one, other))
    right = sum(row[n] for n, row in enumerate(counts)) + counts[a][b] + counts[b][a]
    return 100 * right / total
