"""Read the records of an MCAP file from its start, as far as they are whole.

The stock reader starts at the summary at a file's end, which a killed run never wrote. A scan needs
no summary: it reads each complete record, leaves out a chunk with a wrong checksum, and stops where
the bytes end.

Not here: the meaning of the records (``tacgrasp.episodes.reader``).
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Chunk, McapRecord, Message, Metadata
from mcap.stream_reader import breakup_chunk
from mcap.writer import MCAP0_MAGIC

from tacgrasp.episodes.errors import EpisodeError

_PREFIX = struct.Struct("<BQ")  # opcode, length of what follows


@dataclass(frozen=True, slots=True, kw_only=True)
class Scan:
    """Content of a file.

    Attributes:
        groups: Schemas, channels, messages and metadata in the order of the file; the records of
            one chunk are one group.
        finished: True when footer and closing magic exist and everything between is whole.
        problem: Missing or damaged parts, for people; empty when finished.
    """

    groups: tuple[tuple[McapRecord, ...], ...]
    finished: bool
    problem: str

    @property
    def records(self) -> Iterator[McapRecord]:
        """All records in order."""
        return (record for group in self.groups for record in group)


class _DamagedError(Exception):
    """The next record is incomplete or damaged."""


def scan_file(path: Path) -> Scan:
    """Scan ``path``.

    Raises:
        EpisodeError: It can't be read, is empty, or is not an MCAP file.
    """
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        raise EpisodeError(
            f"{path} does not exist; `tacgrasp episodes ls` lists those that do"
        ) from None
    except OSError as error:
        raise EpisodeError(f"can't read {path}: {error.strerror or error}") from None
    if not data:
        raise EpisodeError(
            f"{path} is empty: the run was killed before it recorded anything; delete it"
        )
    if not data.startswith(MCAP0_MAGIC):
        if MCAP0_MAGIC.startswith(data):
            raise EpisodeError(f"{path} ends inside its first {len(MCAP0_MAGIC)} bytes; delete it")
        raise EpisodeError(f"{path} is not an MCAP file; expected an episode (.mcap) of tacgrasp")
    return _scan(data)


def _scan(data: bytes) -> Scan:
    groups: list[tuple[McapRecord, ...]] = []
    problems: list[str] = []
    offset = len(MCAP0_MAGIC)
    in_summary = finished = False
    while not finished:
        try:
            opcode, payload = _next_record(data, offset)
        except _DamagedError as damage:
            problems.append(f"{damage} at byte {offset} of {len(data)}")
            break
        start, offset = offset, offset + _PREFIX.size + len(payload)
        finished = opcode == Opcode.FOOTER
        in_summary = in_summary or opcode == Opcode.DATA_END
        if opcode == Opcode.STATISTICS:
            problems += _missing(payload, groups)
        if in_summary:
            continue
        try:
            if group := _group(opcode, payload):
                groups.append(group)
        except _DamagedError as damage:  # its length is right: the next record can still be read
            problems.append(f"{damage} at byte {start} of {len(data)}, left out")
    if finished and data[offset:] != MCAP0_MAGIC:
        problems.append("the closing bytes are missing or followed by others")
    finished = finished and not problems
    return Scan(groups=tuple(groups), finished=finished, problem="; ".join(problems))


def _missing(payload: bytes, groups: list[tuple[McapRecord, ...]]) -> list[str]:
    """Compare the file's own count of its messages with the number that was read."""
    num_read = sum(isinstance(record, Message) for group in groups for record in group)
    (written,) = struct.unpack_from("<Q", payload.ljust(8, b"\0"))  # first field of Statistics
    return [] if num_read == written else [f"{num_read} messages were read, {written} written"]


def _next_record(data: bytes, offset: int) -> tuple[int, bytes]:
    if len(data) - offset < _PREFIX.size:
        raise _DamagedError("it ends without a summary")
    opcode, length = _PREFIX.unpack_from(data, offset)
    start = offset + _PREFIX.size
    if opcode == 0:  # a power cut can leave zeros where data had not reached the disk
        raise _DamagedError("it holds zeros instead of a record")
    if length > len(data) - start:
        raise _DamagedError("it ends inside a record")
    return opcode, data[start : start + length]


def _group(opcode: int, payload: bytes) -> tuple[McapRecord, ...]:
    """Records of a chunk, or a metadata record; nothing for the others (indexes)."""
    stream = ReadDataStream(io.BytesIO(payload))
    try:
        if opcode == Opcode.CHUNK:
            return tuple(breakup_chunk(Chunk.read(stream), validate_crc=True))
        # Outside chunks nothing has a checksum; our schemas, channels and messages are all inside.
        return (Metadata.read(stream),) if opcode == Opcode.METADATA else ()
    except (McapError, ValueError, RuntimeError, zstandard.ZstdError, struct.error) as error:
        raise _DamagedError(f"a record can't be read ({error or type(error).__name__})") from None
