"""Data sets of contacts on disk: their format, and reading them lazily.

    folder/
      dataset.json            {"format": "tacgrasp-contacts", "version": 1, "about": {...}}
      shard-<part>-00000.heights    packed height maps (``cltp.data.contact``), one after another
      shard-<part>-00000.parquet    a row for each contact: labels, and offset of its heights

Only clean heights and labels are stored; clouds, noise, captions and images are derived when they
are needed. A shard exists as soon as its Parquet file does: both files are written atomically, the
heights first, so that an interrupted writer leaves only whole shards.

Not here: writing (``cltp.data.dataset_writer``).
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from cltp.data.contact import Contact, Gel, Split, unpack_heights
from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import DIMENSIONS, NUMBERS, ContactState, Side

FORMAT = "tacgrasp-contacts"
VERSION = 1

NUMBER_COLUMNS = {name: "area_share" if name == "area_fraction" else name for name in NUMBERS}
"""The column of each of ``NUMBERS``."""

GEL_COLUMNS = {field.name: f"gel_{field.name}" for field in dataclasses.fields(Gel)}
"""The column of each property of a gel."""

SCHEMA = pa.schema(
    (name, kind)
    for kind, names in (
        (pa.int64(), ("offset",)),
        (pa.int32(), ("size",)),
        (pa.uint32(), ("crc32",)),
        (pa.int32(), ("rows", "columns")),
        (pa.string(), ("sensor", "object")),
        (pa.int64(), ("series",)),
        (pa.string(), ("split",)),
        (pa.int64(), ("seed",)),
        (pa.float32(), NUMBER_COLUMNS.values()),
        (pa.string(), ("depth", "position", "area", "cut", "shape", "texture")),
        (pa.float32(), GEL_COLUMNS.values()),
    )
    for name in names
)
"""Columns of every data set of this version."""

SIMULATED = pa.schema(
    [
        ("unsure", pa.string()),
        ("approach_mm", pa.float32()),
        ("peak_kpa", pa.float32()),
        ("force_factor", pa.float32()),
    ]
)
"""Further columns of simulated shards; in others they read as null."""

IMPORTED = pa.schema([("measured", pa.string())])
"""Further column of shards with measured labels; in others it reads as null."""

OPTIONAL = pa.unify_schemas([SIMULATED, IMPORTED])


def read_header(folder: Path) -> dict[str, Any]:
    """Read ``dataset.json``, whose "about" is always there.

    Raises:
        TouchError: Missing, damaged, or of another format or version.
    """
    path = folder / "dataset.json"
    try:
        header = json.loads(path.read_text())
    except NotADirectoryError:
        raise TouchError(f"{folder} is a file; expected the folder of a data set") from None
    except FileNotFoundError:
        if not folder.exists():
            raise TouchError(
                f"{folder} is no data set of contacts: there is no such folder"
            ) from None
        raise TouchError(f"{folder} is no data set of contacts: dataset.json is missing") from None
    except OSError as error:
        raise TouchError(f"{path} can't be read: {error.strerror or error}") from None
    except ValueError as error:
        raise TouchError(f"{path} can't be read: {error}") from error
    if not isinstance(header, dict) or header.get("format") != FORMAT:
        raise TouchError(f"{path} does not describe a {FORMAT} data set")
    if header.get("version") != VERSION:
        raise TouchError(
            f"{path} has version {header.get('version')}, this program reads {VERSION}; "
            "generate the data again"
        )
    about = header.setdefault("about", {})
    if not isinstance(about, dict) or not str(about.get("contacts", 0)).isdigit():
        raise TouchError(
            f'{path} is damaged: "about" must name a number of contacts, if any, got {about!r}'
        )
    return header


class ContactDataset:
    """The contacts of a folder, or those of one split, read lazily.

    Labels are held in memory as columns; heights stay on disk and are read and checked one by one.

    Args:
        folder: Folder of a ``DatasetWriter``.
        split: Only its contacts; None for all.
        partial: Whether a data set that is still being made may be read.
        also: Further folders, whose contacts come after, for learning from several sets.

    Raises:
        TouchError: Not a data set, another version, damaged or missing shards, no contacts, or
            fewer than its header announces.
    """

    def __init__(
        self,
        folder: Path,
        *,
        split: Split | None = None,
        partial: bool = False,
        also: Sequence[Path] = (),
    ) -> None:
        self.folder = Path(folder)
        folders = [self.folder, *map(Path, also)]
        abouts: list[dict[str, str]] = [read_header(each)["about"] for each in folders]
        self.about = abouts[0]
        self._index_files: list[Path] = []
        tables: list[pa.Table] = []
        first_shards = 0
        for each, about in zip(folders, abouts, strict=True):
            files, shards = _read_shards(each, about, partial=partial)
            self._index_files += files
            tables += shards
            first_shards = first_shards or len(shards)
        shard = np.concatenate([np.full(len(t), i) for i, t in enumerate(tables)])
        no_rows = pa.schema([*SCHEMA, *OPTIONAL]).empty_table()
        table = pa.concat_tables([no_rows, *tables], promote_options="default")
        if split is not None:
            keep = np.flatnonzero(np.array(table["split"].to_pylist()) == split.value)
            table, shard = table.take(pa.array(keep)), shard[keep]
        if len(table) == 0:
            raise TouchError(f"{folder} has no contacts of the split {split}")
        self._shard = shard
        self._num_also = int(np.count_nonzero(shard >= first_shards))
        self._columns = {name: table[name].to_numpy() for name in table.column_names}
        self._maps: dict[int, NDArray[np.uint8]] = {}

    def __len__(self) -> int:
        return len(self._shard)

    @property
    def num_also(self) -> int:
        """Number of contacts of the further folders; they are the last ones."""
        return self._num_also

    @property
    def column_names(self) -> list[str]:
        return list(self._columns)

    def column(self, name: str) -> NDArray[Any]:
        """Values of one column of ``SCHEMA`` or ``OPTIONAL``, one for each contact.

        Raises:
            TouchError: There is no such column.
        """
        if name not in self._columns:
            raise TouchError(f"no column {name!r}; there are {', '.join(self._columns)}")
        return self._columns[name]

    def height_mm(self, index: int) -> NDArray[np.float32]:
        """Clean heights of a contact, shape (H, W) [mm].

        Raises:
            TouchError: The stored bytes are damaged.
        """
        shard, offset = int(self._shard[index]), int(self._columns["offset"][index])
        path = self._index_files[shard].with_suffix(".heights")
        if shard not in self._maps:
            self._maps[shard] = np.memmap(path, dtype=np.uint8, mode="r")
        packed = self._maps[shard][offset : offset + int(self._columns["size"][index])]
        if zlib.crc32(packed.data) != int(self._columns["crc32"][index]):
            raise TouchError(f"contact {index} in {path} is damaged; generate the data again")
        return unpack_heights(
            packed.data, int(self._columns["rows"][index]), int(self._columns["columns"][index])
        )

    def state(self, index: int) -> ContactState:
        """The labels of a contact."""
        row = self._row(index)
        words: dict[str, Any] = {
            name: None if row[name] is None else classes(row[name])
            for name, classes in DIMENSIONS.items()
        }
        cut = frozenset(Side(side) for side in row["cut"].split())
        return ContactState(**_numbers(row, NUMBER_COLUMNS), **words, cut=cut)

    def nominal_state(self, index: int) -> ContactState:
        """The labels, with the force that the sensor's nominal gel would need.

        Heights alone tell this force; a unit's force calibration makes newtons of it.
        """
        state, factor = self.state(index), _optional(self._columns["force_factor"][index])
        return (
            state if factor is None else dataclasses.replace(state, force_n=state.force_n / factor)
        )

    def contact(self, index: int) -> Contact:
        """The whole record of a contact."""
        row = self._row(index)
        has_gel = _optional(row["gel_young_mpa"]) is not None
        return Contact(
            height_mm=self.height_mm(index),
            sensor=sensor_named(row["sensor"]),
            state=self.state(index),
            object=row["object"],
            series=int(row["series"]),
            split=Split(row["split"]),
            gel=Gel(**_numbers(row, GEL_COLUMNS)) if has_gel else None,
            seed=int(row["seed"]),
            unsure=None if row["unsure"] is None else frozenset(row["unsure"].split()),
            approach_mm=_optional(row["approach_mm"]),
            peak_kpa=_optional(row["peak_kpa"]),
            force_factor=_optional(row["force_factor"]),
            measured=frozenset((row["measured"] or "").split()),
        )

    @property
    def origin(self) -> str:
        """Set, maker, seed and number of contacts, the same on every machine; else the checksum.

        The contacts of one command differ between kinds of processors by the rounding of heights
        to 1 µm, and so do the checksums.
        """
        names = ("set", "maker", "seed", "contacts")
        if not all(name in self.about for name in names):
            return self.checksum()
        further = f", meshes {self.about['meshes']}" if "meshes" in self.about else ""
        return ", ".join(f"{name} {self.about[name]}" for name in names) + further

    def checksum(self) -> str:
        """SHA-256 over the index files, which contain the checksums of the heights."""
        total = hashlib.sha256()
        for path in self._index_files:
            total.update(hashlib.sha256(path.read_bytes()).digest())
        return total.hexdigest()

    def _row(self, index: int) -> dict[str, Any]:
        return {name: values[index] for name, values in self._columns.items()}


def _numbers(row: Mapping[str, Any], columns: Mapping[str, str]) -> dict[str, Any]:
    return {name: float(row[column]) for name, column in columns.items()}


def _optional(value: Any) -> float | None:
    return None if value is None or np.isnan(value) else float(value)


def _read_shards(
    folder: Path, about: Mapping[str, str], *, partial: bool
) -> tuple[list[Path], list[pa.Table]]:
    """The index files of a folder, at least one, and their tables."""
    files = sorted(folder.glob("shard-*.parquet"))
    tables = [_read_index(path) for path in files]
    if not tables:
        raise TouchError(f"{folder} has no shards: generation was stopped before the first")
    count = sum(map(len, tables))
    announced = int(about.get("contacts", count))
    if count != announced and not partial:
        raise TouchError(
            f"{folder} holds {count} of {announced} contacts: it is still being made, or "
            "that was interrupted; the command that made it goes on where it stopped"
        )
    return files, tables


def _read_index(path: Path) -> pa.Table:
    heights = path.with_suffix(".heights")
    try:
        table = pq.read_table(path)
        size = heights.stat().st_size
    except (OSError, pa.ArrowException) as error:
        raise TouchError(f"shard {path} is damaged or incomplete: {error}") from error
    present = [column for column in OPTIONAL if column.name in table.column_names]
    if not table.schema.equals(pa.schema([*SCHEMA, *present]), check_metadata=False):
        raise TouchError(f"shard {path} has other columns than version {VERSION}; generate again")
    ends = table["offset"].to_numpy() + table["size"].to_numpy()
    if len(table) and int(ends.max()) != size:
        raise TouchError(f"{heights} has {size} bytes where {int(ends.max())} were expected")
    return table
