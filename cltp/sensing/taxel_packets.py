"""Packets of a serial taxel array: heights of a gel, framed and checksummed, both ways.

The format is ours (``docs/taxels.md`` has it for whoever writes firmware): any sensor that can be
made to send heights can be used. A frame says which mark of the host the sensor had seen before it
captured, so that the host knows a new touch from an old one without comparing clocks.

Not here: the serial port (``tacgrasp.drivers.taxels.connect``), what heights mean
(``cltp.tactile.cloud``).
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError

SYNC = b"\xa5TX\x5a"
VERSION = 1

FRAME, MARK = 1, 2
"""Kinds of packets: heights from the sensor; a mark from the host."""

MAX_TAXELS = 131_072
"""Most taxels of a frame: 320 × 240 fit; a header that claims more is damage."""

UM_LIMIT = 32_000
"""Counts of one taxel reach this far, ± [µm]; beyond lie marks such as a saturated converter's."""

_HEADER = struct.Struct("<4sBBHHIIQ")  # sync, version, kind, rows, columns, sequence, mark, clock
_CHECKSUM = struct.Struct("<I")
HEADER_BYTES = _HEADER.size + _CHECKSUM.size
_WRAP = 2**32


@dataclass(frozen=True, slots=True, kw_only=True)
class TaxelFrame:
    """One frame of heights, as it was sent.

    Attributes:
        sequence: Counts frames, modulo 2**32.
        mark: Of the last mark packet that came before the capture began; 0 when none did.
        clock_us: Sensor's own clock when the capture began [µs].
        counts_um: (rows, columns) int16, indentation [µm], row 0 at the top; read-only.

    Raises:
        TouchError: Not such a grid, too many taxels, or a number out of its range.
    """

    sequence: int
    mark: int
    clock_us: int
    counts_um: NDArray[np.int16]

    def __post_init__(self) -> None:
        counts = np.array(self.counts_um)
        if counts.ndim != 2 or counts.dtype != np.int16 or not 0 < counts.size <= MAX_TAXELS:
            raise TouchError(
                f"a taxel frame needs (rows, columns) of int16, at most {MAX_TAXELS} taxels; got "
                f"{counts.shape} of {counts.dtype}"
            )
        if not (
            0 <= self.sequence < _WRAP and 0 <= self.mark < _WRAP and 0 <= self.clock_us < 2**64
        ):
            raise TouchError("sequence and mark of a taxel frame are 32 bits, its clock 64")
        counts.setflags(write=False)
        object.__setattr__(self, "counts_um", counts)

    @property
    def height_mm(self) -> NDArray[np.float32]:
        """Heights, (rows, columns) [mm], positive into the gel."""
        return self.counts_um.astype(np.float32) * np.float32(1e-3)


@dataclass(frozen=True, slots=True, kw_only=True)
class TaxelMark:
    """What the host sends: frames captured from now on are to carry this number.

    Attributes:
        mark: 1 to 2**32 - 1; 0 is what frames carry before the first one.
    """

    mark: int


@dataclass(slots=True)
class WireCounts:
    """What a parser has seen.

    Attributes:
        packets: Whole ones.
        damaged: Packets whose checksum was wrong, or that were cut off.
        foreign: Whole headers of a version or kind that isn't known.
        garbage_bytes: Bytes that belong to no packet.
    """

    packets: int = 0
    damaged: int = 0
    foreign: int = 0
    garbage_bytes: int = 0


def counts_of(height_mm: NDArray[np.floating]) -> NDArray[np.int16]:
    """Heights [mm] as counts [µm], rounded.

    Raises:
        TouchError: Not finite, or beyond ± ``UM_LIMIT``.
    """
    um = np.rint(np.asarray(height_mm, dtype=np.float64) * 1e3)
    if not (np.isfinite(um).all() and np.abs(um).max(initial=0) <= UM_LIMIT):
        raise TouchError(f"heights to send must be finite and within ±{UM_LIMIT / 1e3:g} mm")
    return um.astype(np.int16)


def encode_frame(frame: TaxelFrame) -> bytes:
    """The packet of a frame."""
    rows, columns = frame.counts_um.shape
    payload = frame.counts_um.astype("<i2").tobytes()
    head = _header(FRAME, rows, columns, frame.sequence, frame.mark, frame.clock_us)
    return head + payload + _CHECKSUM.pack(zlib.crc32(payload))


def encode_mark(mark: int) -> bytes:
    """The packet of a mark.

    Raises:
        TouchError: Not 1 to 2**32 - 1.
    """
    if not 0 < mark < _WRAP:
        raise TouchError(f"a mark is 1 to {_WRAP - 1}, got {mark}")
    return _header(MARK, 0, 0, 0, mark, 0)


def _header(kind: int, rows: int, columns: int, sequence: int, mark: int, clock_us: int) -> bytes:
    head = _HEADER.pack(SYNC, VERSION, kind, rows, columns, sequence, mark, clock_us)
    return head + _CHECKSUM.pack(zlib.crc32(head))


@dataclass(slots=True)
class PacketParser:
    """Finds packets in a stream that arrives in pieces, and goes on behind whatever is damaged.

    The header has a checksum of its own: a damaged size can't make it wait for bytes that never
    come. Behind a damaged packet it searches from the byte after its start, so a packet that began
    inside a torn one is not lost.

    Attributes:
        counts: What was seen so far.
    """

    counts: WireCounts = field(default_factory=WireCounts)
    _buffer: bytearray = field(default_factory=bytearray)

    def feed(self, data: bytes) -> list[TaxelFrame | TaxelMark]:
        """Take the next bytes; returns the packets that are whole by now, in order."""
        self._buffer += data
        found: list[TaxelFrame | TaxelMark] = []
        while self._find_sync() and len(self._buffer) >= HEADER_BYTES:
            size = self._packet_size()
            if size is None:
                continue
            if len(self._buffer) < size:
                break
            packet = self._packet(size)
            if packet is not None:
                found.append(packet)
        return found

    def _find_sync(self) -> bool:
        """Drop what stands before the next sync; False when none is there."""
        place = self._buffer.find(SYNC)
        if place < 0:
            kept = next(n for n in (3, 2, 1, 0) if self._buffer.endswith(SYNC[:n]))
            self._drop(len(self._buffer) - kept)
            return False
        self._drop(place)
        return True

    def _drop(self, count: int) -> None:
        self.counts.garbage_bytes += count
        del self._buffer[:count]

    def _packet_size(self) -> int | None:
        """Size of the packet at the start of the buffer; None: it is none, and its sync is gone."""
        (checksum,) = _CHECKSUM.unpack_from(self._buffer, _HEADER.size)
        _, version, kind, rows, columns, *_ = _HEADER.unpack_from(self._buffer)
        if zlib.crc32(self._buffer[: _HEADER.size]) != checksum:
            self.counts.damaged += 1
        elif version == VERSION and kind == MARK:
            return HEADER_BYTES
        elif version == VERSION and kind == FRAME and 0 < rows * columns <= MAX_TAXELS:
            return HEADER_BYTES + 2 * rows * columns + _CHECKSUM.size
        else:
            self.counts.foreign += 1
        self._drop(1)
        return None

    def _packet(self, size: int) -> TaxelFrame | TaxelMark | None:
        *_, kind, rows, columns, sequence, mark, clock_us = _HEADER.unpack_from(self._buffer)
        payload = bytes(self._buffer[HEADER_BYTES : max(HEADER_BYTES, size - _CHECKSUM.size)])
        if kind == FRAME:
            (checksum,) = _CHECKSUM.unpack_from(self._buffer, size - _CHECKSUM.size)
            if zlib.crc32(payload) != checksum:
                self.counts.damaged += 1
                self._drop(1)
                return None
        del self._buffer[:size]
        self.counts.packets += 1
        if kind == MARK:
            return TaxelMark(mark=mark)
        counts = np.frombuffer(payload, dtype="<i2").reshape(rows, columns).astype(np.int16)
        return TaxelFrame(sequence=sequence, mark=mark, clock_us=clock_us, counts_um=counts)


@dataclass(slots=True)
class SequenceCount:
    """Follows the numbers of frames.

    Attributes:
        missing: Numbers that never came.
        repeated: Frames that came again.
        restarts: Times that the numbers began anew: the sensor was switched off and on.
    """

    missing: int = 0
    repeated: int = 0
    restarts: int = 0
    _last: int | None = None

    def is_new(self, sequence: int) -> bool:
        """Take the next number; False when it is that of the frame before."""
        if self._last is None:
            self._last = sequence
            return True
        step = (sequence - self._last) % _WRAP
        if step == 0:
            self.repeated += 1
            return False
        if step < _WRAP // 2:
            self.missing += step - 1
        else:
            self.restarts += 1
        self._last = sequence
        return True
