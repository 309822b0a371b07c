"""Read the records of an MCAP file from its start, as far as they are whole.

The stock reader starts at the summary at a file's end, which a killed run never wrote. A scan needs
no summary: it reads each complete record, leaves out a chunk with a wrong checksum, and stops where
the bytes end.

A file's size, the content of its chunks and the number of its records are bounded before anything
is unpacked: a chunk of kilobytes can announce gigabytes.

Not here: the meaning of the records (``tacgrasp.episodes.reader``).
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from zlib import crc32

import lz4.frame
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, McapRecord, Message, Metadata, Schema
from mcap.writer import MCAP0_MAGIC

from tacgrasp.episodes.errors import EpisodeError

MAX_BYTES = 128_000_000
"""Most bytes of a file, and of what its chunks hold: 1,400 steps of the simulated sensor's 4,800
points, 106 of a GelSight Mini's 76,800. Our choice, so that a crafted file can't fill the memory:
an episode is read as a whole. A task has 25 actions unless it asks for more; the writer refuses a
step beyond."""

MAX_RECORDS = 100_000
"""Most records of a file: 10,000 steps. Our choice."""

SHOWN_PROBLEMS = 5

_PREFIX = struct.Struct("<BQ")  # opcode, length of what follows
_ZSTD_WINDOW_BYTES = 8_000_000  # as large as RFC 8878 asks of every reader


@dataclass(frozen=True, slots=True, kw_only=True)
class Scan:
    """Content of a file.

    Attributes:
        groups: Schemas, channels, messages and metadata in the order of the file; the records of
            one chunk are one group.
        finished: True when footer and closing magic exist and everything between is whole.
        problem: Missing or damaged parts, for people; empty when finished.
        lost: Those parts of ``problem`` that may have cost records, which no recovery brings back;
            empty when finished, and for a file that a killed run left.
    """

    groups: tuple[tuple[McapRecord, ...], ...]
    finished: bool
    problem: str
    lost: str = ""

    @property
    def records(self) -> Iterator[McapRecord]:
        """All records in order."""
        return (record for group in self.groups for record in group)


class _DamagedError(Exception):
    """The next record is incomplete or damaged."""


class _TooLargeError(Exception):
    """The file holds more than is read."""


def scan_file(path: Path) -> Scan:
    """Scan ``path``.

    Raises:
        EpisodeError: It can't be read, is empty, is not an MCAP file, or is larger than the bounds
            above.
    """
    if path.is_dir():
        raise EpisodeError(
            f"{path} is a folder; name an episode in it (`tacgrasp episodes ls {path}` lists them)"
        )
    try:
        size = path.stat().st_size
        data = path.read_bytes() if size <= MAX_BYTES else b""
    except FileNotFoundError:
        raise EpisodeError(
            f"{path} does not exist; `tacgrasp episodes ls` lists those that do"
        ) from None
    except OSError as error:
        raise EpisodeError(f"can't read {path}: {error.strerror or error}") from None
    if size > MAX_BYTES:
        raise EpisodeError(f"{path} has {size} bytes; at most {MAX_BYTES} are read")
    if not data:
        raise EpisodeError(
            f"{path} is empty: the run was killed before it recorded anything; delete it"
        )
    if not data.startswith(MCAP0_MAGIC):
        if MCAP0_MAGIC.startswith(data):
            raise EpisodeError(f"{path} ends inside its first {len(MCAP0_MAGIC)} bytes; delete it")
        raise EpisodeError(f"{path} is not an MCAP file; expected an episode (.mcap) of tacgrasp")
    try:
        return _Scanner(data).scan()
    except _TooLargeError as error:
        raise EpisodeError(f"{path} is no episode of ours: {error}") from None


class _Scanner:
    """One pass over a file; it counts what it has read and unpacked."""

    def __init__(self, data: bytes) -> None:
        self._data = memoryview(data)
        self._problems: list[str] = []
        self._losses: list[str] = []
        self._num_records = self._num_messages = self._num_bytes = 0

    def scan(self) -> Scan:
        data, offset = self._data, len(MCAP0_MAGIC)
        groups: list[tuple[McapRecord, ...]] = []
        in_summary = finished = False
        while not finished:
            try:
                opcode, payload = self._next_record(data, offset)
            except _DamagedError as damage:
                self._problems.append(f"{damage} at byte {offset} of {len(data)}")
                if not in_summary and data[-len(MCAP0_MAGIC) :] == MCAP0_MAGIC:
                    # It was closed once, so that this is no crash: what follows can't be found.
                    self._losses.append(f"{self._problems[-1]}, and the rest was not read")
                break
            start, offset = offset, offset + _PREFIX.size + len(payload)
            finished = opcode == Opcode.FOOTER
            in_summary = in_summary or opcode == Opcode.DATA_END
            if opcode == Opcode.STATISTICS:
                self._compare(payload)
            if in_summary:
                continue
            try:
                if group := self._group(opcode, payload):
                    groups.append(group)
            except _DamagedError as damage:  # its length is right: the next can still be read
                self._lose(f"{damage} at byte {start} of {len(data)}, left out")
        if finished and data[offset:] != MCAP0_MAGIC:
            self._problems.append("the closing bytes are missing or followed by others")
        finished = finished and not self._problems
        problem, lost = _listed(self._problems), _listed(self._losses)
        return Scan(groups=tuple(groups), finished=finished, problem=problem, lost=lost)

    def _lose(self, problem: str) -> None:
        self._problems.append(problem)
        self._losses.append(problem)

    def _compare(self, payload: memoryview) -> None:
        """Compare the file's own count of its messages with the number that was read."""
        (written,) = struct.unpack_from("<Q", bytes(payload[:8]).ljust(8, b"\0"))
        if self._num_messages != written:
            self._lose(f"{self._num_messages} messages were read, {written} written")

    def _next_record(self, data: memoryview, offset: int) -> tuple[int, memoryview]:
        self._num_records += 1
        if self._num_records > MAX_RECORDS:
            raise _TooLargeError(f"it has more than {MAX_RECORDS} records, which is the most read")
        if len(data) - offset < _PREFIX.size:
            raise _DamagedError("it ends without a summary")
        opcode, length = _PREFIX.unpack_from(data, offset)
        start = offset + _PREFIX.size
        if opcode == 0:  # a power cut can leave zeros where data had not reached the disk
            raise _DamagedError("it holds zeros instead of a record")
        if length > len(data) - start:
            raise _DamagedError("it ends inside a record")
        return opcode, data[start : start + length]

    def _group(self, opcode: int, payload: memoryview) -> tuple[McapRecord, ...]:
        """Records of a chunk, or a metadata record; nothing for the others (indexes)."""
        try:
            if opcode == Opcode.CHUNK:
                return self._chunk(Chunk.read(_stream(payload)))
            # Outside chunks nothing has a checksum; our schemas, channels and messages are inside.
            return (Metadata.read(_stream(payload)),) if opcode == Opcode.METADATA else ()
        except _READ_ERRORS as error:
            reason = str(error) or type(error).__name__
            raise _DamagedError(f"a record can't be read ({reason})") from None

    def _chunk(self, chunk: Chunk) -> tuple[McapRecord, ...]:
        self._num_bytes += chunk.uncompressed_size
        if self._num_bytes > MAX_BYTES:
            raise _TooLargeError(
                f"its chunks announce {self._num_bytes} bytes; at most {MAX_BYTES} are unpacked"
            )
        data, records, offset = memoryview(_unpacked(chunk)), [], 0
        while offset < len(data):
            opcode, payload = self._next_record(data, offset)
            offset += _PREFIX.size + len(payload)
            if opcode == Opcode.MESSAGE:
                records.append(Message.read(_stream(payload), len(payload)))
            elif opcode == Opcode.CHANNEL:
                records.append(Channel.read(_stream(payload)))
            elif opcode == Opcode.SCHEMA:
                records.append(Schema.read(_stream(payload)))
        self._num_messages += sum(isinstance(record, Message) for record in records)
        return tuple(records)


_READ_ERRORS = (
    McapError,
    ValueError,
    RuntimeError,
    OverflowError,
    EOFError,
    MemoryError,
    zstandard.ZstdError,
    struct.error,
)
"""What the libraries raise for bytes that are no record."""


def _listed(problems: Sequence[str]) -> str:
    shown, more = problems[:SHOWN_PROBLEMS], len(problems) - SHOWN_PROBLEMS
    return "; ".join([*shown, *([f"and {more} more"] if more > 0 else [])])


def _stream(payload: memoryview) -> ReadDataStream:
    return ReadDataStream(io.BytesIO(payload))


def _unpacked(chunk: Chunk) -> bytes:
    """Content of a chunk: at most one byte more than it announces is ever unpacked."""
    size = chunk.uncompressed_size
    if chunk.compression == "lz4":
        data = lz4.frame.LZ4FrameDecompressor().decompress(chunk.data, max_length=size + 1)
    elif chunk.compression == "zstd":
        reader = zstandard.ZstdDecompressor(max_window_size=_ZSTD_WINDOW_BYTES)
        data = reader.stream_reader(chunk.data).read(size + 1)
    elif chunk.compression == "":
        data = chunk.data
    else:
        raise ValueError(f"compression {chunk.compression[:20]!r} is not known")
    if len(data) != size:
        raise ValueError(f"a chunk of {size} bytes holds {len(data)}, or more")
    if chunk.uncompressed_crc not in (0, crc32(data)):
        raise ValueError("the checksum of a chunk is wrong")
    return bytes(data)
