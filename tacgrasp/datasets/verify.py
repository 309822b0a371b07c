"""Check a data set row by row: bytes, words, numbers, clouds, texts, splits.

Every problem names its file and row. Nothing is repaired: a damaged set is to be made again.
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
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

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
"""How far the deepest stored height may lie from the depth's label. Our choice: labels come from
the solver's own grid, which may be finer than what is stored."""


ROUNDING = 1e-6
"""Numbers are stored in float32: one that lay on the limit of a class may have crossed it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Problem:
    """Something that is wrong.

    Attributes:
        file: In which file.
        row: In which row of it, from 0; None where it concerns the whole file.
        what: Expected, and found.
    """

    file: str
    row: int | None
    what: str

    def __str__(self) -> str:
        where = self.file if self.row is None else f"{self.file} row {self.row}"
        return f"{where}: {self.what}"


def bar() -> Progress:
    """A progress bar on standard error."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    return Progress(*columns, TimeRemainingColumn(), console=Console(stderr=True))


def problems(folder: Path) -> Iterator[tuple[int, Problem | None]]:
    """Look at every shard and contact.

    Yields:
        How many contacts have been looked at, and a problem, or None after each contact.

    Raises:
        TouchError: It is no data set of this version, or a shard is too damaged to be read at all.
    """
    data = ContactDataset(folder, partial=True)
    for problem in (*_whole(data), *_shards(data.folder), *_splits(data)):
        yield 0, problem
    names, rows = _places(data)
    for index in range(len(data)):
        for what in _contact(data, index):
            yield index + 1, Problem(file=names[index], row=rows[index], what=what)
        yield index + 1, None


def _whole(data: ContactDataset) -> Iterator[Problem]:
    expected = data.about.get("contacts")
    if expected is not None and str(expected).isdigit() and int(expected) != len(data):
        yield Problem(
            file="dataset.json",
            row=None,
            what=f"expected {expected} contacts, found {len(data)}; run the same generate again",
        )
    for left_over in sorted(data.folder.glob("*.part")):
        yield Problem(file=left_over.name, row=None, what="left by a writer that was interrupted")


def _shards(folder: Path) -> Iterator[Problem]:
    for path in sorted(folder.glob("shard-*.parquet")):
        stored = (pq.read_schema(path).metadata or {}).get(b"heights_sha256", b"").decode()
        heights = path.with_suffix(".heights")
        with heights.open("rb") as file:
            found = hashlib.file_digest(file, "sha256").hexdigest()
        if stored != found:
            yield Problem(
                file=heights.name,
                row=None,
                what=f"SHA-256 is {found[:12]}…, the index says {stored[:12] or 'none'}…",
            )
    for heights in sorted(folder.glob("shard-*.heights")):
        if not heights.with_suffix(".parquet").exists():
            yield Problem(file=heights.name, row=None, what="heights without an index")


def _splits(data: ContactDataset) -> Iterator[Problem]:
    """A press, deeper and deeper, is in one split; what a split calls unseen is in no other.

    Contacts of a press are nearly the same. ``Split.OBJECT`` promises objects, and
    ``Split.PHYSICS`` gels, that training never shows.
    """
    splits = data.column("split")
    presses = list(zip(data.column("object"), data.column("series"), strict=True))
    gels = list(
        zip(*(data.column(f"gel_{name}") for name in ("thickness_mm", "poisson")), strict=True)
    )
    seen = np.isin(splits.astype(str), [Split.TRAIN.value, Split.VALIDATION.value])
    yield from _shared(data, "press", presses, splits.astype(str))
    for split, what, of in (
        (Split.OBJECT, "object", [(name,) for name in data.column("object")]),
        (Split.PHYSICS, "gel", gels),
    ):
        chosen = splits.astype(str) == split.value
        groups = np.where(chosen, split.value, np.where(seen, "what is learned from", ""))
        yield from _shared(data, what, of, groups)


def _shared(
    data: ContactDataset, what: str, of: Sequence[tuple[Any, ...]], groups: NDArray[np.str_]
) -> Iterator[Problem]:
    """Things that are in two groups, each told once; the group '' is not looked at."""
    names, rows = _places(data)
    first: dict[tuple[Any, ...], int] = {}
    told: set[tuple[Any, ...]] = set()
    for index in np.flatnonzero(groups != "").tolist():
        known = first.setdefault(of[index], index)
        if groups[known] != groups[index] and of[index] not in told:
            told.add(of[index])
            yield Problem(
                file=names[index],
                row=rows[index],
                what=f"{what} {' '.join(map(str, of[index]))} is in {groups[index]}, but in "
                f"{groups[known]} in {names[known]} row {rows[known]}",
            )


def _places(data: ContactDataset) -> tuple[list[str], list[int]]:
    """File and row of every contact."""
    names: list[str] = []
    rows: list[int] = []
    for path in sorted(data.folder.glob("shard-*.parquet")):
        count = pq.read_metadata(path).num_rows
        names += [path.name] * count
        rows += range(count)
    return names, rows


def _contact(data: ContactDataset, index: int) -> Iterator[str]:
    """What is wrong with one contact."""
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
        return  # what a person said need not agree with what was measured
    for slot, words in _expected(state, sensor).items():
        if getattr(state, slot) not in words:
            yield f"{slot} is {getattr(state, slot)}, its numbers say {words[0]}"
    if abs(float(heights.max()) - state.depth_mm) > DEPTH_TOLERANCE_MM:
        yield f"depth is {state.depth_mm:.3f} mm, the heights reach {heights.max():.3f} mm"


def _expected(state: ContactState, sensor: SensorSpec) -> dict[str, list[StrEnum]]:
    """The words that a state's numbers allow: two where rounding crosses the limit of a class."""
    off = (0.0, -ROUNDING, ROUNDING)
    return {
        "depth": [depth_word(state.depth_mm * (1 + by)) for by in off],
        "area": [area_word(state.area_fraction * (1 + by)) for by in off],
        "position": [
            position_word(state.x_mm + by * sensor.width_mm, state.y_mm + up, sensor)
            for by in off
            for up in (each * sensor.height_mm for each in off)
        ],
    }


def _outside_vocabulary(row: dict[str, Any]) -> Iterator[str]:
    for slot, kind in DIMENSIONS.items():
        words = [str(word) for word in kind]
        if row[slot] is not None and row[slot] not in words:
            yield f"{slot} {row[slot]!r} is none of {', '.join(words)}"
    unknown = set(str(row["cut"] or "").split()) - {str(side) for side in Side}
    if unknown:
        yield f"cut {row['cut']!r} names what is no side: {', '.join(sorted(unknown))}"
    if (row["depth"] is None) != (row["position"] is None or row["area"] is None):
        yield "depth, position and area must be given together, or none of them"
