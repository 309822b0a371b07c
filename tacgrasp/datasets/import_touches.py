"""Make a data set of measured contacts: files, and a table of their labels.

Columns of the table (CSV, UTF-8): ``file`` (a cloud, a height map or a frame as
``cltp.sensing.touch_files`` reads them, relative to the folder), and, where known, ``shape``,
``texture``, ``depth``, ``position``, ``area`` (words of ``cltp.tactile.states``; depth also as a
number of mm), ``force_n``, ``object``, ``split`` and ``series`` (presses of one object in one
place share a number; without it each row is a series of its own).

Empty cells: shape and texture stay unknown. Depth, position and area are measured from the heights,
noise included, as ``describe`` measures them. The force is estimated by a law that was fitted to a
GelSight Mini's gel. The contact's ``measured`` names all that was measured. Numbers are always
measured, except a depth or a force that the table gives.

A depth or an area that the heights refute by far is a bad row: most often its unit is another one.
Nothing is written unless every row is good. A row without contact has no labels, and is counted as
such.
"""

from __future__ import annotations

import csv
import dataclasses
import itertools
import math
import os
import re
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from cltp.data.contact import Contact, Split
from cltp.data.dataset import NUMBER_COLUMNS
from cltp.data.dataset_writer import DatasetWriter
from cltp.errors import TouchError
from cltp.sensing.touch_files import read_heights
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.measure import NO_CONTACT_MM, contact_state
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import (
    DIMENSIONS,
    MEASURABLE,
    Area,
    ContactState,
    Depth,
    Position,
    Shape,
    Texture,
    depth_word,
)
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets.refuted_labels import refuted_area, refuted_depth, refuted_number
from tacgrasp.datasets.requests import ImportRequest

COLUMNS = ("file", *DIMENSIONS, "force_n", "object", "split", "series")
MEASURED = frozenset({*MEASURABLE, "cut", *NUMBER_COLUMNS.values()})
"""Fields that are measured where the table gives none."""

SHOWN_ROWS = 20
LARGEST_FORCE_N = 1000.0
SHARD_CONTACTS = 256
NUMBER = re.compile(r"[-−+.\d]|nan|inf", re.IGNORECASE)
"""How a depth begins that is meant as a number of mm, good or not; no word begins so."""

RISEN_MM = 0.3
"""Largest rise of a gel without contact [mm]. Our choice: drift, tilt and the halos of real frames
(-0.1 mm) stay below. Beside a contact the gel rises by less than it sinks under it."""

Word = TypeVar("Word", bound=StrEnum)


class RowError(Exception):
    """An error in one row of the table; it never leaves this module."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportCounts:
    """Numbers of imported contacts.

    Attributes:
        contacts: Number of contacts, and of rows without contact.
        untouched: Number of rows without contact.
        given, measured, unknown: Number of the other ones, by dimension and for the force, whose
            label the table gives, was measured, or is unknown.
    """

    contacts: int
    untouched: int
    given: Mapping[str, int]
    measured: Mapping[str, int]
    unknown: Mapping[str, int]


def import_touches(source: ImportRequest) -> ImportCounts:
    """Write a new data set of measured contacts.

    Raises:
        UsageError: The output exists or can't be written, the table does not have these columns, or
            rows are bad; each is named by the table's line and its file.
    """
    sensor, out = sensor_named(source.sensor), source.out
    if out.exists():
        raise UsageError(f"--out {out} exists already; name a new folder, nothing is added to it")
    rows = _rows(source.labels)
    part = out.with_name(f".{out.name}.{os.getpid()}.part")
    try:
        counts, bad = _write(source, sensor, rows, part)
        if bad:
            more = f"; and {len(bad) - SHOWN_ROWS} more" if len(bad) > SHOWN_ROWS else ""
            raise UsageError(
                f"{len(bad)} of {len(rows)} rows are bad and nothing was written: "
                f"{'; '.join(bad[:SHOWN_ROWS])}{more}"
            )
        part.rename(out)
    except OSError as error:
        raise UsageError(f"--out {out} can't be written: {error.strerror or error}") from None
    finally:
        shutil.rmtree(part, ignore_errors=True)
    return counts


@dataclass(frozen=True, slots=True)
class _Row:
    """A line of the table: its number, its cells, and whether there are more cells than columns."""

    line: int
    cells: Mapping[str, str]
    has_extra_cells: bool


def _rows(labels: Path) -> list[_Row]:
    try:
        with labels.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file, strict=True)
            header = [name.strip().lower() for name in reader.fieldnames or ()]
            unknown = [name for name in header if name not in COLUMNS]
            if "file" not in header or unknown or len(set(header)) != len(header):
                is_one = len(header) == 1 and any(mark in header[0] for mark in ";\t")
                hint = "; put commas between the columns" if is_one else ""
                raise UsageError(
                    f"--labels {labels} needs a header with the column file and any of "
                    f"{', '.join(COLUMNS[1:])}, each once; got "
                    f"{', '.join(header) or 'nothing'}{hint}"
                )
            reader.fieldnames = header
            rows = [_row(reader.line_num, dict(cells)) for cells in reader]
    except OSError as error:
        raise UsageError(f"--labels {labels} can't be read: {error.strerror or error}") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise UsageError(f"--labels {labels} is not a table of UTF-8 text (CSV): {error}") from None
    if not rows:
        raise UsageError(f"--labels {labels} has a header but no rows")
    return rows


def _row(line: int, cells: dict[str | None, Any]) -> _Row:
    has_extra_cells = cells.pop(None, None) is not None  # csv puts them under None
    named = {str(name): value.strip() for name, value in cells.items() if value and value.strip()}
    return _Row(line, named, has_extra_cells)


def _write(
    source: ImportRequest, sensor: SensorSpec, rows: list[_Row], folder: Path
) -> tuple[ImportCounts, list[str]]:
    bad: list[str] = []
    slots, origins = (*DIMENSIONS, "force_n"), ("given", "measured", "unknown")
    counts = {origin: dict.fromkeys(slots, 0) for origin in origins}
    lines: dict[str, int] = {}
    untouched = 0
    series = _series(rows)
    splits = _splits(rows, series, source.held_out, source.seed)
    about = {
        "made_by": "tacgrasp data import",
        "contacts": str(len(rows)),
        "sensor": sensor.name,
        "labels": source.labels.name,
    }
    with DatasetWriter(folder, shard_size=SHARD_CONTACTS, about=about) as writer:
        for row, one in zip(rows, series, strict=True):
            name = row.cells.get("file", "no file")
            try:
                path = os.path.normpath(name)
                if path in lines:
                    raise RowError(f"the same file as line {lines[path]}")
                contact = _contact(source, sensor, row, one, splits[one])
            except (RowError, TouchError) as error:
                text = str(error).removeprefix(f"{source.folder / name}: ")
                bad.append(f"{source.labels.name} line {row.line} ({name}): {text}")
                continue
            lines[path] = row.line
            untouched += not contact.state.in_contact
            for slot in slots if contact.state.in_contact else ():
                counts[_origin(contact, slot)][slot] += 1
            if not bad:
                writer.add(contact)
    return ImportCounts(contacts=writer.num_written, untouched=untouched, **counts), bad


def _origin(contact: Contact, slot: str) -> str:
    if slot in contact.measured:
        return "measured"
    return "unknown" if getattr(contact.state, slot) is None else "given"


def _series(rows: Sequence[_Row]) -> list[str]:
    """The series of each row: a number, the same for '8' and '08', or what is no number.

    A row that names none is one of its own.
    """
    named = [row.cells.get("series", "") for row in rows]
    named = [str(int(each)) if _is_number(each) else each for each in named]
    free = itertools.count(1 + max((int(each) for each in named if _is_number(each)), default=-1))
    return [each or str(next(free)) for each in named]


def _is_number(series: str) -> bool:
    return re.fullmatch(r"\d{1,18}", series, re.ASCII) is not None


def _splits(
    rows: Sequence[_Row], series: Sequence[str], fraction: float, seed: int
) -> dict[str, str]:
    """The split of each series: what a row of it names, or drawn.

    Args:
        rows: The table.
        series: The series of each row.
        fraction: Fraction of the series without a split that is not to be learned from.
        seed: Seed of the draw.
    """
    named = {
        one: row.cells["split"].lower()
        for row, one in zip(rows, series, strict=True)
        if "split" in row.cells
    }
    others = [one for one in dict.fromkeys(series) if one not in named]
    drawn = np.random.default_rng(seed).permutation(others).tolist()
    held_out = round(fraction * len(drawn))
    return (
        named
        | dict.fromkeys(drawn[:held_out], Split.TEST.value)
        | dict.fromkeys(drawn[held_out:], Split.TRAIN.value)
    )


def _contact(
    source: ImportRequest, sensor: SensorSpec, row: _Row, series: str, split: str
) -> Contact:
    cells = row.cells
    if row.has_extra_cells:
        raise RowError("more cells than the header has")
    if "file" not in cells:
        raise RowError("names no file")
    path = source.folder / cells["file"]
    if not path.resolve().is_relative_to(source.folder.resolve()):
        raise RowError(f"lies outside of the folder {source.folder}; copy it there")
    try:
        heights = read_heights(
            path,
            sensor,
            background=source.background,
            calibration=source.calibration,
        )
    except OSError as error:
        raise RowError(f"can't be read: {error.strerror or error}") from None
    lowest, highest = float(heights.min()), float(heights.max())
    if -lowest > max(highest, RISEN_MM):
        raise RowError(
            f"heights from {lowest:.2f} to {highest:+.2f} mm rise more than they sink; expected "
            "+ into the gel: is the sign turned, or is the untouched gel not at 0?"
        )
    if not _is_number(series):
        raise RowError(f"series must be a number from 0, got {series!r}")
    if cells.get("split", split).lower() != split:
        raise RowError(f"series {series} is in the splits {cells['split']!r} and {split!r}")
    cloud = cloud_from_heights(heights, sensor)
    # A tip that is finer than a cell of the measurement touches as well.
    is_told = source.least_depth_mm != NO_CONTACT_MM or any(name in cells for name in DIMENSIONS)
    touching = highest >= source.least_depth_mm if is_told else None
    measured_state = contact_state(cloud, in_contact=touching)
    if measured_state.in_contact:
        _check_labels(cells, measured_state, highest)
    state, measured = _with_labels(measured_state, cells, source.least_depth_mm)
    return Contact(
        height_mm=heights,
        sensor=sensor,
        state=state,
        object=cells.get("object", "unknown"),
        series=int(series),
        split=_word(Split, "split", {"split": split}) or Split.TRAIN,
        measured=measured,
    )


def _with_labels(
    state: ContactState, cells: Mapping[str, str], least_mm: float
) -> tuple[ContactState, frozenset[str]]:
    """A measured state with the table's labels in it, and the names of its measured fields."""
    labels = dict(_labels(cells))
    named = [name for name in (*DIMENSIONS, "force_n") if name in cells]
    if not state.in_contact:
        if named:
            raise RowError(
                f"labelled ({', '.join(named)}), but nothing touches: the heights stay below "
                f"{least_mm:g} mm; leave its labels empty to import it as no contact"
            )
        return state, MEASURED
    measured = MEASURED - set(labels)
    return dataclasses.replace(state, **labels), measured  # type: ignore[arg-type]


def _check_labels(cells: Mapping[str, str], measured: ContactState, highest_mm: float) -> None:
    """Refuse a depth or an area that the heights refute."""
    depth_mm, refuted = measured.depth_mm, ""
    if "depth" in cells and NUMBER.match(cells["depth"]):
        told_mm = _float(cells["depth"])
        if 0 < told_mm < math.inf:  # else it is refused as no depth
            refuted = refuted_number(told_mm, depth_mm, highest_mm)
    elif (depth := _word(Depth, "depth", cells)) is not None:
        refuted = refuted_depth(depth, depth_mm, highest_mm)
    area = _word(Area, "area", cells)
    if not refuted and area is not None:
        refuted = refuted_area(area, measured.area_fraction, depth_mm)
    if refuted:
        raise RowError(refuted)


def _labels(cells: Mapping[str, str]) -> Iterator[tuple[str, object]]:
    """Fields of a state in a row of the table."""
    for slot, kind in (("shape", Shape), ("texture", Texture), ("position", Position)):
        if slot in cells:
            yield slot, _word(kind, slot, cells)
    if "area" in cells:
        yield "area", _word(Area, "area", cells)
    if "depth" in cells and NUMBER.match(cells["depth"]):
        depth_mm = _number("depth", cells, 10.0)
        yield from (("depth_mm", depth_mm), ("depth", depth_word(depth_mm)))
    elif "depth" in cells:
        yield "depth", _word(Depth, "depth", cells)
    if "force_n" in cells:
        yield "force_n", _number("force_n", cells, LARGEST_FORCE_N)


def _word(kind: type[Word], name: str, cells: Mapping[str, str]) -> Word | None:
    if name not in cells:
        return None
    try:
        return kind(cells[name].lower())
    except ValueError:
        raise RowError(f"{name} {cells[name]!r} is not one of {', '.join(kind)}") from None


def _number(name: str, cells: Mapping[str, str], most: float) -> float:
    value = _float(cells[name])
    if not 0 < value <= most:
        raise RowError(f"{name} must be a number above 0, up to {most:g}; got {cells[name]!r}")
    return value


def _float(text: str) -> float:
    """A number that its unit may follow; nan for any other text."""
    try:
        return float(text.removesuffix("mm").removesuffix("N"))
    except ValueError:
        return math.nan
