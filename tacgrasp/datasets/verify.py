"""Check a data set row by row: bytes, words, numbers, clouds, texts, splits.

Each problem names its file and row. Nothing is repaired: make a damaged set again.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
from numpy.typing import NDArray

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.errors import TouchError
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.markers import marker_cloud
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import DIMENSIONS, ContactState, Side, area_word, depth_word, position_word
from cltp.texts.captions import caption, parse_caption, slots_of
from cltp.texts.contact_texts import texts_of
from cltp.texts.paraphrases import read_paraphrase

DEPTH_TOLERANCE_MM = 0.02
"""Largest difference between the deepest stored height and the label of depth [mm]. Our choice:
labels come from the solver's grid, which may be finer than the stored one."""

ROUNDING = 1e-6
"""Relative error of stored numbers (float32); it can carry one across the limit of a class."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Problem:
    """An error in a data set.

    Attributes:
        file: Name of the file.
        row: Row of the file, from 0; None for the whole file.
        text: What was expected, and what is there.
    """

    file: str
    row: int | None
    text: str

    def __str__(self) -> str:
        location = self.file if self.row is None else f"{self.file} row {self.row}"
        return f"{location}: {self.text}"


def problems(folder: Path) -> Iterator[tuple[int, Problem | None]]:
    """Check every shard and contact.

    Yields:
        The number of contacts checked so far, and a problem, or None after each contact.

    Raises:
        TouchError: The folder is not a data set of this version, or a shard can't be read.
    """
    data = ContactDataset(folder, partial=True)
    for problem in (*_size(data), *_shards(data.folder), *_splits(data)):
        yield 0, problem
    names, rows = _locations(data)
    for index in range(len(data)):
        for text in _contact(data, index):
            yield index + 1, Problem(file=names[index], row=rows[index], text=text)
        yield index + 1, None


def _size(data: ContactDataset) -> Iterator[Problem]:
    expected = data.about.get("contacts")
    if expected is not None and str(expected).isdigit() and int(expected) != len(data):
        yield Problem(
            file="dataset.json",
            row=None,
            text=f"expected {expected} contacts, found {len(data)}; run the same generate again",
        )
    for path in sorted(data.folder.glob("*.part")):
        yield Problem(file=path.name, row=None, text="left by a writer that was interrupted")


def _shards(folder: Path) -> Iterator[Problem]:
    for path in sorted(folder.glob("shard-*.parquet")):
        stored = (pq.read_schema(path).metadata or {}).get(b"heights_sha256", b"").decode()
        heights = path.with_suffix(".heights")
        with heights.open("rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
        if stored != digest:
            yield Problem(
                file=heights.name,
                row=None,
                text=f"SHA-256 is {digest[:12]}…, the index says {stored[:12] or 'none'}…",
            )
    for heights in sorted(folder.glob("shard-*.heights")):
        if not heights.with_suffix(".parquet").exists():
            yield Problem(file=heights.name, row=None, text="heights without an index")


def _splits(data: ContactDataset) -> Iterator[Problem]:
    """Check that no series is in two splits, and that what a split calls unseen is unseen.

    The contacts of a series are nearly the same. ``Split.OBJECT`` promises objects, and
    ``Split.PHYSICS`` gels, that training never shows.
    """
    splits = data.column("split")
    presses = list(zip(data.column("object"), data.column("series"), strict=True))
    gels = list(
        zip(*(data.column(f"gel_{name}") for name in ("thickness_mm", "poisson")), strict=True)
    )
    is_learned = np.isin(splits.astype(str), [Split.TRAIN.value, Split.VALIDATION.value])
    yield from _shared(data, "press", presses, splits.astype(str))
    for split, kind, items in (
        (Split.OBJECT, "object", [(name,) for name in data.column("object")]),
        (Split.PHYSICS, "gel", gels),
    ):
        mask = splits.astype(str) == split.value
        groups = np.where(mask, split.value, np.where(is_learned, "what is learned from", ""))
        yield from _shared(data, kind, items, groups)


def _shared(
    data: ContactDataset, kind: str, items: Sequence[tuple[Any, ...]], groups: NDArray[np.str_]
) -> Iterator[Problem]:
    """Items that are in two groups, each reported once; the group '' does not count."""
    names, rows = _locations(data)
    first: dict[tuple[Any, ...], int] = {}
    reported: set[tuple[Any, ...]] = set()
    for index in np.flatnonzero(groups != "").tolist():
        item = items[index]
        other = first.setdefault(item, index)
        if groups[other] != groups[index] and item not in reported:
            reported.add(item)
            yield Problem(
                file=names[index],
                row=rows[index],
                text=f"{kind} {' '.join(map(str, item))} is in {groups[index]}, but in "
                f"{groups[other]} in {names[other]} row {rows[other]}",
            )


def _locations(data: ContactDataset) -> tuple[list[str], list[int]]:
    """File and row of every contact."""
    names: list[str] = []
    rows: list[int] = []
    for path in sorted(data.folder.glob("shard-*.parquet")):
        count = pq.read_metadata(path).num_rows
        names += [path.name] * count
        rows += range(count)
    return names, rows


def _contact(data: ContactDataset, index: int) -> Iterator[str]:
    row = {name: data.column(name)[index] for name in ("sensor", "cut", "series", *DIMENSIONS)}
    outside = list(_outside_vocabulary(row))
    yield from outside
    try:
        sensor = sensor_named(row["sensor"])
        heights = data.height_mm(index)
        (marker_cloud if sensor.markers else cloud_from_heights)(heights, sensor)
    except TouchError as error:
        yield str(error)
        return
    if outside:
        return
    state = data.state(index)
    simulated = np.isfinite(float(data.column("gel_young_mpa")[index] or np.nan))
    try:
        if parse_caption(caption(state)) != slots_of(state):
            yield f"the caption {caption(state)!r} does not read back as its labels"
        if read_paraphrase(texts_of(data, index).paraphrase) != slots_of(state):
            yield f"the paraphrase {texts_of(data, index).paraphrase!r} does not read back"
    except TouchError as error:
        yield str(error)
    if not (simulated and state.in_contact):
        return  # a person's labels need not agree with the measured numbers
    for slot, words in _expected(state, sensor).items():
        if getattr(state, slot) not in words:
            yield f"{slot} is {getattr(state, slot)}, its numbers give {words[0]}"
    if abs(float(heights.max()) - state.depth_mm) > DEPTH_TOLERANCE_MM:
        yield f"depth is {state.depth_mm:.3f} mm, the heights reach {heights.max():.3f} mm"


def _expected(state: ContactState, sensor: SensorSpec) -> dict[str, list[StrEnum]]:
    """The words that a state's numbers allow: two where rounding crosses the limit of a class."""
    errors = (0.0, -ROUNDING, ROUNDING)
    return {
        "depth": [depth_word(state.depth_mm * (1 + by)) for by in errors],
        "area": [area_word(state.area_fraction * (1 + by)) for by in errors],
        "position": [
            position_word(state.x_mm + by * sensor.width_mm, state.y_mm + up, sensor)
            for by in errors
            for up in (each * sensor.height_mm for each in errors)
        ],
    }


def _outside_vocabulary(row: dict[str, Any]) -> Iterator[str]:
    for slot, kind in DIMENSIONS.items():
        words = [str(word) for word in kind]
        if row[slot] is not None and row[slot] not in words:
            yield f"{slot} {row[slot]!r} is not one of {', '.join(words)}"
    unknown = set(str(row["cut"] or "").split()) - {str(side) for side in Side}
    if unknown:
        yield f"cut {row['cut']!r} names unknown sides: {', '.join(sorted(unknown))}"
    if (row["depth"] is None) != (row["position"] is None or row["area"] is None):
        yield "depth, position and area must be given together, or none of them"
