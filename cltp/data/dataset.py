"""Data sets of contacts on disk: one folder, written shard by shard, read lazily.

    folder/
      dataset.json            {"format": "tacgrasp-contacts", "version": 1, "about": {...}}
      shard-<part>-00000.heights    packed height maps (``cltp.data.contact``), one after another
      shard-<part>-00000.parquet    a row for each contact: labels, and where its heights lie

Clean heights and labels are all that is stored; clouds, noise, captions and images are derived when
they are needed. A shard exists as soon as its Parquet file does: both files are written beside and
renamed, the heights first, so that an interrupted writer leaves only whole shards.
"""

from __future__ import annotations

import hashlib
import io
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from cltp.atomic_write import write_atomically
from cltp.data.contact import Contact, Gel, Split, checksum, pack_heights, unpack_heights
from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import DIMENSIONS, NUMBERS, ContactState, Side

FORMAT = "tacgrasp-contacts"
VERSION = 1

SCHEMA = pa.schema(
    [
        ("offset", pa.int64()),
        ("size", pa.int32()),
        ("crc32", pa.uint32()),
        ("rows", pa.int32()),
        ("columns", pa.int32()),
        ("sensor", pa.string()),
        ("object", pa.string()),
        ("series", pa.int64()),
        ("split", pa.string()),
        ("seed", pa.int64()),
        ("depth_mm", pa.float32()),
        ("x_mm", pa.float32()),
        ("y_mm", pa.float32()),
        ("area_share", pa.float32()),
        ("force_n", pa.float32()),
        ("depth", pa.string()),
        ("position", pa.string()),
        ("area", pa.string()),
        ("cut", pa.string()),
        ("shape", pa.string()),
        ("texture", pa.string()),
        ("gel_thickness_mm", pa.float32()),
        ("gel_young_mpa", pa.float32()),
        ("gel_poisson", pa.float32()),
    ]
)
"""Columns of every data set of this version."""

SIMULATED = pa.schema(
    [("unsure", pa.string()), ("approach_mm", pa.float32()), ("peak_kpa", pa.float32())]
)
"""Further columns of shards whose maker knows the truth; in others they read as null."""

IMPORTED = pa.schema([("measured", pa.string())])
"""Further column of shards with labels that were measured; in others it reads as null."""

OPTIONAL = pa.unify_schemas([SIMULATED, IMPORTED])

NUMBER_COLUMNS = {name: "area_share" if name == "area_fraction" else name for name in NUMBERS}
"""The column of each of ``NUMBERS``."""


class DatasetWriter:
    """Appends contacts to a folder, a shard at a time. A context manager.

    Contacts that don't fill a shard are written when the ``with`` block ends well; when it ends by
    an exception they are dropped, and ``num_written`` says how many are safe.

    Args:
        folder: Made when missing; an existing data set is appended to.
        part: Part of the shards' names: processes that write at once each need their own.
        shard_size: Contacts in a shard.
        about: Written into ``dataset.json`` when the data set is new: command, seed, versions.

    Raises:
        TouchError: The folder holds something else, or a data set of another version.
    """

    def __init__(
        self,
        folder: Path,
        *,
        part: str = "0",
        shard_size: int = 1024,
        about: Mapping[str, str] | None = None,
    ) -> None:
        if not re.fullmatch(r"[A-Za-z0-9_]+", part) or shard_size < 1:
            raise TouchError(f"bad part {part!r} or shard size {shard_size} of a data set")
        self._folder = Path(folder)
        self._part = part
        self._shard_size = shard_size
        self._contacts: list[Contact] = []
        self.num_written = 0
        self._folder.mkdir(parents=True, exist_ok=True)
        if (self._folder / "dataset.json").exists():
            _read_header(self._folder)
        elif any(self._folder.glob("shard-*")):
            raise TouchError(f"{self._folder} has shards but no dataset.json; use another folder")
        else:
            header = {"format": FORMAT, "version": VERSION, "about": dict(about or {})}
            text = json.dumps(header, indent=2) + "\n"
            write_atomically(self._folder / "dataset.json", text)

    def add(self, contact: Contact) -> None:
        """Append one contact; it is safe on disk once its shard is full or the writer is closed."""
        self._contacts.append(contact)
        if len(self._contacts) >= self._shard_size:
            self.flush()

    def flush(self) -> None:
        """Write what was added since the last shard as a shard of its own."""
        if not self._contacts:
            return
        number = len(list(self._folder.glob(f"shard-{self._part}-*.parquet")))
        stem = self._folder / f"shard-{self._part}-{number:05d}"
        packed = [pack_heights(contact.height_mm) for contact in self._contacts]
        offsets = np.cumsum([0, *(len(p) for p in packed)])
        rows = [
            _row(contact, int(offset), data)
            for contact, offset, data in zip(self._contacts, offsets[:-1], packed, strict=True)
        ]
        blob = b"".join(packed)
        write_atomically(stem.with_suffix(".heights"), blob)
        digest = hashlib.sha256(blob).hexdigest()
        schema = _schema_of(self._contacts)
        table = pa.Table.from_pylist(rows, schema=schema.with_metadata({"heights_sha256": digest}))
        index = io.BytesIO()
        pq.write_table(table, index, compression="zstd")
        write_atomically(stem.with_suffix(".parquet"), index.getvalue())
        self.num_written += len(rows)
        self._contacts.clear()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if kind is None:
            self.flush()


def _schema_of(contacts: list[Contact]) -> pa.Schema:
    parts = [SCHEMA]
    if any(contact.unsure is not None for contact in contacts):
        parts.append(SIMULATED)
    if any(contact.measured for contact in contacts):
        parts.append(IMPORTED)
    return pa.unify_schemas(parts)


def _row(contact: Contact, offset: int, packed: bytes) -> dict[str, Any]:
    state, gel = contact.state, contact.gel
    return {
        "offset": offset,
        "size": len(packed),
        "crc32": checksum(packed),
        "rows": contact.height_mm.shape[0],
        "columns": contact.height_mm.shape[1],
        "sensor": contact.sensor.name,
        "object": contact.object,
        "series": contact.series,
        "split": contact.split.value,
        "seed": contact.seed,
        **{column: getattr(state, name) for name, column in NUMBER_COLUMNS.items()},
        **{name: getattr(state, name) for name in DIMENSIONS},
        "cut": " ".join(sorted(state.cut)),
        "gel_thickness_mm": gel and gel.thickness_mm,
        "gel_young_mpa": gel and gel.young_mpa,
        "gel_poisson": gel and gel.poisson,
        "unsure": None if contact.unsure is None else " ".join(sorted(contact.unsure)),
        "approach_mm": contact.approach_mm,
        "peak_kpa": contact.peak_kpa,
        "measured": " ".join(sorted(contact.measured)) or None,
    }


def _read_header(folder: Path) -> dict[str, Any]:
    path = folder / "dataset.json"
    try:
        header = json.loads(path.read_text())
    except FileNotFoundError:
        raise TouchError(f"{folder} is no data set of contacts: dataset.json is missing") from None
    except (OSError, ValueError) as error:
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
    """The contacts of a folder, or those of one split, read when asked for.

    Labels are held in memory as columns; heights stay on disk and are read and checked one by one.

    Args:
        folder: What ``DatasetWriter`` wrote.
        split: Only its contacts; None for all.
        partial: Whether a data set that is still being made may be read.
        also: Folders whose contacts come after its own, for learning from several sets.

    Raises:
        TouchError: No data set, another version, damaged or missing shards, nothing in it, or less
            than its header announces.
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
        abouts: list[dict[str, str]] = [_read_header(each)["about"] for each in folders]
        self.about = abouts[0]
        self._index_files: list[Path] = []
        tables: list[pa.Table] = []
        for each, about in zip(folders, abouts, strict=True):
            files, read = _read_shards(each, about, partial=partial)
            self._index_files += files
            tables += read
        shard = np.concatenate([np.full(len(t), i) for i, t in enumerate(tables)])
        table = pa.concat_tables(tables)
        if split is not None:
            keep = np.flatnonzero(np.array(table["split"].to_pylist()) == split.value)
            table, shard = table.take(pa.array(keep)), shard[keep]
        if len(table) == 0:
            raise TouchError(f"{folder} has no contacts of the split {split}")
        self._shard = shard
        self._columns = {name: table[name].to_numpy() for name in table.column_names}
        self._maps: dict[int, NDArray[np.uint8]] = {}

    def __len__(self) -> int:
        return len(self._shard)

    @property
    def column_names(self) -> list[str]:
        """Names that ``column`` knows."""
        return list(self._columns)

    def column(self, name: str) -> NDArray[Any]:
        """Values of one column of ``SCHEMA`` or ``OPTIONAL`` for every contact, shape (len,).

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
        packed = self._map(shard)[offset : offset + int(self._columns["size"][index])]
        if checksum(packed.data) != int(self._columns["crc32"][index]):
            name = self._index_files[shard].with_suffix(".heights")
            raise TouchError(f"contact {index} in {name} is damaged; generate the data again")
        return unpack_heights(
            packed.data, int(self._columns["rows"][index]), int(self._columns["columns"][index])
        )

    def state(self, index: int) -> ContactState:
        """The labels of a contact."""
        row = {name: values[index] for name, values in self._columns.items()}
        numbers: dict[str, Any] = {
            name: float(row[column]) for name, column in NUMBER_COLUMNS.items()
        }
        words: dict[str, Any] = {
            name: None if row[name] is None else classes(row[name])
            for name, classes in DIMENSIONS.items()
        }
        return ContactState(
            **numbers,
            **words,
            cut=frozenset(Side(side) for side in row["cut"].split()),
        )

    def contact(self, index: int) -> Contact:
        """Everything that is known of a contact."""
        row = {name: values[index] for name, values in self._columns.items()}
        gel = None
        if row["gel_young_mpa"] is not None and not np.isnan(row["gel_young_mpa"]):
            gel = Gel(
                thickness_mm=float(row["gel_thickness_mm"]),
                young_mpa=float(row["gel_young_mpa"]),
                poisson=float(row["gel_poisson"]),
            )
        return Contact(
            height_mm=self.height_mm(index),
            sensor=sensor_named(row["sensor"]),
            state=self.state(index),
            object=row["object"],
            series=int(row["series"]),
            split=Split(row["split"]),
            gel=gel,
            seed=int(row["seed"]),
            unsure=None if row["unsure"] is None else frozenset(row["unsure"].split()),
            approach_mm=_known(row["approach_mm"]),
            peak_kpa=_known(row["peak_kpa"]),
            measured=frozenset((row["measured"] or "").split()),
        )

    def checksum(self) -> str:
        """SHA-256 over the index files, which contain those of the heights: names the data."""
        total = hashlib.sha256()
        for path in self._index_files:
            total.update(hashlib.sha256(path.read_bytes()).digest())
        return total.hexdigest()

    def _map(self, shard: int) -> NDArray[np.uint8]:
        if shard not in self._maps:
            path = self._index_files[shard].with_suffix(".heights")
            self._maps[shard] = np.memmap(path, dtype=np.uint8, mode="r")
        return self._maps[shard]


def _known(value: Any) -> float | None:
    return None if value is None or np.isnan(value) else float(value)


def _read_shards(
    folder: Path, about: Mapping[str, str], *, partial: bool
) -> tuple[list[Path], list[pa.Table]]:
    """The index files of a folder and what is in them, at least one."""
    files = sorted(folder.glob("shard-*.parquet"))
    tables = [_read_index(path) for path in files]
    if not tables:
        raise TouchError(f"{folder} has no shards: generation was stopped before the first")
    there = sum(map(len, tables))
    announced = int(about.get("contacts", there))
    if there != announced and not partial:
        raise TouchError(
            f"{folder} holds {there} of {announced} contacts: it is still being made, or "
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
    known = [column for column in OPTIONAL if column.name in table.column_names]
    if not table.schema.equals(pa.schema([*SCHEMA, *known]), check_metadata=False):
        raise TouchError(f"shard {path} has other columns than version {VERSION}; generate again")
    for column in OPTIONAL:
        if column not in known:
            table = table.append_column(column, pa.nulls(len(table), column.type))
    table = table.select([*SCHEMA.names, *OPTIONAL.names])
    ends = table["offset"].to_numpy() + table["size"].to_numpy()
    if len(table) and int(ends.max()) != size:
        raise TouchError(f"{heights} has {size} bytes where {int(ends.max())} were expected")
    return table
