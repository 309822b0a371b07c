"""Writing data sets of contacts, shard by shard; their format is in ``cltp.data.dataset``."""

from __future__ import annotations

import hashlib
import io
import json
import re
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from cltp.atomic_write import write_atomically
from cltp.data.contact import Contact, pack_heights
from cltp.data.dataset import (
    FORMAT,
    GEL_COLUMNS,
    IMPORTED,
    NUMBER_COLUMNS,
    SCHEMA,
    SIMULATED,
    VERSION,
    read_header,
)
from cltp.errors import TouchError
from cltp.tactile.states import DIMENSIONS


@dataclass(frozen=True, slots=True)
class PackedShard:
    """The bytes of a shard's two files: packed heights, and the index of labels."""

    heights: bytes
    index: bytes

    def write(self, stem: Path) -> None:
        """Write both files beside each other, the index last: the shard exists from then on.

        Raises:
            OSError: They can't be written.
        """
        write_atomically(stem.with_suffix(".heights"), self.heights)
        write_atomically(stem.with_suffix(".parquet"), self.index)


def shard_stem(folder: Path, part: str, number: int = 0) -> Path:
    """Path of a shard's files without their suffix."""
    return folder / f"shard-{part}-{number:05d}"


def packed_shard(contacts: Sequence[Contact]) -> PackedShard:
    """Pack contacts, at least one, into the files of a shard; they depend on the contacts alone."""
    packed = [pack_heights(contact.height_mm) for contact in contacts]
    offsets = np.cumsum([0, *(len(p) for p in packed)])
    rows = [
        _row(contact, int(offset), data)
        for contact, offset, data in zip(contacts, offsets[:-1], packed, strict=True)
    ]
    blob = b"".join(packed)
    digest = hashlib.sha256(blob).hexdigest()
    parts = [SCHEMA]
    if any(contact.unsure is not None for contact in contacts):
        parts.append(SIMULATED)
    if any(contact.measured for contact in contacts):
        parts.append(IMPORTED)
    schema = pa.unify_schemas(parts).with_metadata({"heights_sha256": digest})
    table = pa.Table.from_pylist(rows, schema=schema)
    index = io.BytesIO()
    pq.write_table(table, index, compression="zstd")
    return PackedShard(heights=blob, index=index.getvalue())


class DatasetWriter:
    """Appends contacts to a folder, a shard at a time. A context manager.

    Contacts that don't fill a shard are written when the ``with`` block ends normally; when it ends
    by an exception they are dropped, and ``num_written`` counts the contacts on disk.

    Args:
        folder: Created if missing; an existing data set is appended to.
        part: Part of the shards' names: each of several writing processes needs its own.
        shard_size: Contacts in a shard.
        about: Content of ``dataset.json`` for a new data set: command, seed, versions.

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
            read_header(self._folder)
        elif any(self._folder.glob("shard-*")):
            raise TouchError(f"{self._folder} has shards but no dataset.json; use another folder")
        else:
            header = {"format": FORMAT, "version": VERSION, "about": dict(about or {})}
            text = json.dumps(header, indent=2) + "\n"
            write_atomically(self._folder / "dataset.json", text)

    def add(self, contact: Contact) -> None:
        """Append one contact; it is on disk once its shard is full or the writer is closed."""
        self._contacts.append(contact)
        if len(self._contacts) >= self._shard_size:
            self.flush()

    def flush(self) -> None:
        """Write the contacts since the last shard as a shard of their own."""
        if not self._contacts:
            return
        number = len(list(self._folder.glob(f"shard-{self._part}-*.parquet")))
        stem = shard_stem(self._folder, self._part, number)
        packed_shard(self._contacts).write(stem)
        self.num_written += len(self._contacts)
        self._contacts.clear()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is None:
            self.flush()


def _row(contact: Contact, offset: int, packed: bytes) -> dict[str, Any]:
    state, gel = contact.state, contact.gel
    return {
        "offset": offset,
        "size": len(packed),
        "crc32": zlib.crc32(packed),
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
        **{column: gel and getattr(gel, name) for name, column in GEL_COLUMNS.items()},
        "unsure": None if contact.unsure is None else " ".join(sorted(contact.unsure)),
        "approach_mm": contact.approach_mm,
        "peak_kpa": contact.peak_kpa,
        "force_factor": contact.force_factor,
        "measured": " ".join(sorted(contact.measured)) or None,
    }
