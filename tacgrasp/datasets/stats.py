"""Statistics of a data set: counts of classes, quantiles of numbers, ambiguity, checksum."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console, Group
from rich.table import Table
from rich.text import Text

from cltp.data.dataset import NUMBER_COLUMNS, ContactDataset
from cltp.tactile.states import DIMENSIONS
from tacgrasp.base.counted import counted

QUANTILES = (0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0)
UNKNOWN = "(unknown)"
MIN_CLASS_FRACTION = 0.01
"""Fraction of a set that each class should hold; smaller classes are pointed out."""

_BAR = 28


@dataclass(frozen=True, slots=True, kw_only=True)
class DataStats:
    """Figures of a data set.

    Attributes:
        contacts: Number of contacts.
        series: Number of series; a series presses one object in one pose.
        classes: Number of contacts by dimension and class, 0 included. Contacts without a label
            are counted under ``UNKNOWN``.
        splits, objects, sensors: Number of contacts of each.
        cut: Number of contacts that run over the edge of the pad.
        ambiguous: Number of ambiguous contacts by dimension, and under ``any``; None where the
            data set does not mark them.
        quantiles: Values of each number at ``QUANTILES``; NaN where none is known.
        about: Facts in ``dataset.json``.
        checksum: ``ContactDataset.checksum``.
    """

    contacts: int
    series: int
    classes: Mapping[str, Mapping[str, int]]
    splits: Mapping[str, int]
    objects: Mapping[str, int]
    sensors: Mapping[str, int]
    cut: int
    ambiguous: Mapping[str, int] | None
    quantiles: Mapping[str, tuple[float, ...]]
    about: Mapping[str, str]
    checksum: str

    @property
    def missing(self) -> int:
        """Number of contacts that the data set should hold and does not."""
        return int(self.about.get("contacts", self.contacts)) - self.contacts

    def smallest_class(self) -> tuple[str, str, float]:
        """Dimension, name and fraction of the class with the fewest contacts."""
        fractions = [
            (slot, name, count / self.contacts)
            for slot, counts in self.classes.items()
            for name, count in counts.items()
            if name != UNKNOWN
        ]
        return min(fractions, key=lambda each: each[2])


def stats(folder: Path) -> DataStats:
    """Count the contents of a data set.

    Raises:
        TouchError: The folder is not a data set of this version, or it is damaged.
    """
    data = ContactDataset(folder, partial=True)
    return DataStats(
        contacts=len(data),
        series=len(np.unique(data.column("series"))),
        classes={slot: _classes(data.column(slot), kind) for slot, kind in DIMENSIONS.items()},
        splits=_counts(data.column("split")),
        objects=_counts(data.column("object")),
        sensors=_counts(data.column("sensor")),
        cut=int(sum(bool(sides) for sides in data.column("cut"))),
        ambiguous=_ambiguous(data),
        quantiles={name: _quantiles(data.column(name)) for name in NUMBER_COLUMNS.values()},
        about=data.about,
        checksum=data.checksum(),
    )


def as_json(counts: DataStats) -> dict[str, Any]:
    """``DataStats`` for a JSON file: quantiles by name, NaN as null."""
    plain = asdict(counts)
    plain["quantiles"] = {
        name: {
            f"p{100 * q:g}": None if np.isnan(value) else round(value, 6)
            for q, value in zip(QUANTILES, values, strict=True)
        }
        for name, values in counts.quantiles.items()
    }
    return plain


def show(counts: DataStats, console: Console) -> None:
    """Print tables with bars."""
    console.print(f"{counted(counts.contacts, 'contact')} in {counts.series:,} series")
    if counts.missing:
        console.print(
            f"INCOMPLETE: {counts.missing:,} contacts are missing; run the same generate again"
        )
    groups = {**counts.classes, "split": counts.splits, "sensor": counts.sensors}
    for name, group in groups.items():
        console.print(_bars(name, group, counts.contacts))
    sizes = np.array(list(counts.objects.values()))
    console.print(
        f"objects   {len(sizes)}, contacts of each: {sizes.min():,} to {sizes.max():,}, "
        f"median {np.median(sizes):,.0f}"
    )
    console.print(_numbers(counts))
    ambiguous = "not marked in this data"
    if counts.ambiguous is not None:
        ambiguous = ", ".join(
            f"{name} {count:,} ({count / counts.contacts:.1%})"
            for name, count in counts.ambiguous.items()
        )
    console.print(f"ambiguous {ambiguous}; cut by the edge {counts.cut / counts.contacts:.1%}")
    slot, name, fraction = counts.smallest_class()
    warning = f", below the {MIN_CLASS_FRACTION:.0%} that a class needs"
    verdict = warning if fraction < MIN_CLASS_FRACTION else ""
    console.print(f"smallest class: {slot} {name}, {fraction:.2%}{verdict}")
    console.print(f"checksum {counts.checksum}")


def _classes(values: NDArray[Any], kind: type) -> dict[str, int]:
    return {str(word): 0 for word in kind} | _counts(values)  # type: ignore[attr-defined]


def _counts(values: NDArray[Any]) -> dict[str, int]:
    counts = Counter(UNKNOWN if value is None else str(value) for value in values)
    return dict(sorted(counts.items()))


def _ambiguous(data: ContactDataset) -> dict[str, int] | None:
    """Number of contacts that are ambiguous in each dimension, and in any."""
    if "unsure" not in data.column_names:
        return None
    marks = data.column("unsure")
    if all(mark is None for mark in marks):
        return None
    slots = [str(mark or "").split() for mark in marks]
    return {
        **{name: sum(name in each for each in slots) for name in DIMENSIONS},
        "any": sum(bool(each) for each in slots),
    }


def _quantiles(values: NDArray[Any]) -> tuple[float, ...]:
    finite = values[np.isfinite(values)]
    if len(finite) == 0:
        return tuple(float("nan") for _ in QUANTILES)
    return tuple(float(value) for value in np.quantile(finite, QUANTILES))


def _bars(title: str, counts: Mapping[str, int], total: int) -> Group:
    table = Table.grid(padding=(0, 2))
    most = max(counts.values())
    for name, count in counts.items():
        bar = "█" * round(_BAR * count / most) if count else ""
        low = "red" if count < MIN_CLASS_FRACTION * total else "cyan"
        table.add_row(f"  {name}", Text(bar.ljust(_BAR), low), f"{count:,}", f"{count / total:.1%}")
    return Group(Text(title, style="bold"), table)


def _numbers(counts: DataStats) -> Table:
    table = Table(box=None, padding=(0, 1))
    table.add_column("number", no_wrap=True)
    for q in QUANTILES:
        table.add_column(f"p{100 * q:g}", justify="right", no_wrap=True)
    for name, values in counts.quantiles.items():
        table.add_row(name, *(f"{value:.3f}" for value in values))
    return table
