"""What is in a data set: counts per class, spread of the numbers, doubtful contacts, checksum."""

from __future__ import annotations

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

QUANTILES = (0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0)
NOBODY_SAYS = "(unknown)"
LEAST_SHARE = 0.01
"""No class should hold less of a set than this; smaller ones are pointed out."""

_BAR = 28


@dataclass(frozen=True, slots=True, kw_only=True)
class DataStats:
    """Figures of a data set.

    Attributes:
        contacts: How many.
        series: Presses, each of one object in one pose.
        classes: By dimension and class: contacts. Classes without any are 0; contacts without a
            label are under ``NOBODY_SAYS``, where there are some.
        splits, objects, sensors: Contacts of each.
        cut: Contacts that run over the edge of the pad.
        ambiguous: By dimension, and under ``any``: contacts marked so; None where nobody looked.
        quantiles: By number: its values at ``QUANTILES``; NaN where nothing is known.
        about: What the data set says of itself.
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
        """Contacts that the data set was made to hold and does not."""
        return int(self.about.get("contacts", self.contacts)) - self.contacts

    def smallest_class(self) -> tuple[str, str, float]:
        """Dimension, class and share of the class with the fewest contacts."""
        named = [
            (slot, name, count / self.contacts)
            for slot, counts in self.classes.items()
            for name, count in counts.items()
            if name != NOBODY_SAYS
        ]
        return min(named, key=lambda each: each[2])


def stats(folder: Path) -> DataStats:
    """Count what a data set holds.

    Raises:
        TouchError: It is no data set of this version, or damaged.
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
        ambiguous=_unsure(data),
        quantiles={name: _quantiles(data.column(name)) for name in NUMBER_COLUMNS.values()},
        about=data.about,
        checksum=data.checksum(),
    )


def as_json(found: DataStats) -> dict[str, Any]:
    """For a file: ``DataStats`` with the numbers' quantiles by name, NaN as null."""
    plain = asdict(found)
    plain["quantiles"] = {
        name: {
            f"p{100 * q:g}": None if np.isnan(value) else round(value, 6)
            for q, value in zip(QUANTILES, values, strict=True)
        }
        for name, values in found.quantiles.items()
    }
    return plain


def show(found: DataStats, to: Console) -> None:
    """Print tables with bars."""
    to.print(f"{found.contacts:,} contacts in {found.series:,} series")
    if found.missing:
        to.print(f"INCOMPLETE: {found.missing:,} contacts are missing; run the same generate again")
    for slot, counts in found.classes.items():
        to.print(_bars(slot, counts, found.contacts))
    for name, counts in (("split", found.splits), ("sensor", found.sensors)):
        to.print(_bars(name, counts, found.contacts))
    to.print(_objects(found))
    to.print(_numbers(found))
    doubtful = "not marked in this data"
    if found.ambiguous is not None:
        doubtful = ", ".join(
            f"{name} {count:,} ({count / found.contacts:.1%})"
            for name, count in found.ambiguous.items()
        )
    to.print(f"ambiguous {doubtful}; cut by the edge {found.cut / found.contacts:.1%}")
    slot, name, share = found.smallest_class()
    verdict = "" if share >= LEAST_SHARE else f", below the {LEAST_SHARE:.0%} that a class needs"
    to.print(f"smallest class: {slot} {name}, {share:.2%}{verdict}")
    to.print(f"checksum {found.checksum}")


def _classes(values: NDArray[Any], kind: type) -> dict[str, int]:
    counts = {str(word): 0 for word in kind}  # type: ignore[attr-defined]
    for name, count in _counts(values).items():
        counts[name] = count
    return counts


def _counts(values: NDArray[Any]) -> dict[str, int]:
    names, counts = np.unique(
        np.array([NOBODY_SAYS if value is None else str(value) for value in values]),
        return_counts=True,
    )
    return {str(name): int(count) for name, count in zip(names, counts, strict=True)}


def _unsure(data: ContactDataset) -> dict[str, int] | None:
    """Contacts that are ambiguous in each dimension, and in any."""
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
    known = values[np.isfinite(values)]
    if len(known) == 0:
        return tuple(float("nan") for _ in QUANTILES)
    return tuple(float(value) for value in np.quantile(known, QUANTILES))


def _bars(title: str, counts: Mapping[str, int], total: int) -> Group:
    table = Table.grid(padding=(0, 2))
    most = max(counts.values())
    for name, count in counts.items():
        bar = "█" * round(_BAR * count / most) if count else ""
        low = "red" if count < LEAST_SHARE * total else "cyan"
        table.add_row(f"  {name}", Text(bar.ljust(_BAR), low), f"{count:,}", f"{count / total:.1%}")
    return Group(Text(title, style="bold"), table)


def _objects(found: DataStats) -> str:
    counts = np.array(list(found.objects.values()))
    return (
        f"objects   {len(counts)}, contacts of each: {counts.min():,} to {counts.max():,}, "
        f"median {np.median(counts):,.0f}"
    )


def _numbers(found: DataStats) -> Table:
    table = Table(box=None, padding=(0, 1))
    table.add_column("number", no_wrap=True)
    for q in QUANTILES:
        table.add_column(f"p{100 * q:g}", justify="right", no_wrap=True)
    for name, values in found.quantiles.items():
        table.add_row(name, *(f"{value:.3f}" for value in values))
    return table
