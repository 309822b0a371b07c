"""Packets of a serial taxel array, encoded and parsed: framed, checksummed displacements of a gel.

The format is ours (``docs/taxels.md`` describes it for authors of firmware): any sensor that can
send heights can be used. Version 1 has heights alone, version 2 displacements along the gel too. A
frame carries the last mark of the host that the sensor had received
before the capture, so that the host can tell a new frame from an old one without comparing clocks.

Not here: the serial port (``tacgrasp.drivers.taxels.connect``), clouds from heights
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
HEIGHTS, DISPLACEMENTS = 1, 2
"""Versions: of frames of heights alone, and of all marks; of frames of displacements."""

FRAME, MARK = 1, 2
"""Kinds of packets: a frame from the sensor; a mark from the host."""

MAX_TAXELS = 131_072
"""Most taxels of a frame: 320 × 240 fit; a header with more is foreign."""

UM_LIMIT = 32_000
"""Largest count of a taxel, ± [µm]; values beyond stand for faults such as saturation."""

_HEADER = struct.Struct("<4sBBHHIIQ")  # sync, version, kind, rows, columns, sequence, mark, clock
_CHECKSUM = struct.Struct("<I")
HEADER_BYTES = _HEADER.size + _CHECKSUM.size
_WRAP = 2**32
_TAXEL_BYTES = {HEIGHTS: 2, DISPLACEMENTS: 6}


@dataclass(frozen=True, slots=True, kw_only=True)
class TaxelFrame:
    """One frame, as it was sent.

    Attributes:
        sequence: Number of the frame, modulo 2**32.
        mark: Number in the last mark packet received before the capture began; 0 for none.
        clock_us: Sensor's own clock when the capture began [µs].
        counts_um: (rows, columns) int16, indentation [µm], row 0 at the top; read-only.
        along_um: (rows, columns, 2) int16, displacement along x and y, gel frame [µm]; read-only.
            None in version 1.

    Raises:
        TouchError: Another shape or type, too many taxels, or a number out of its range.
    """

    sequence: int
    mark: int
    clock_us: int
    counts_um: NDArray[np.int16]
    along_um: NDArray[np.int16] | None = None

    def __post_init__(self) -> None:
        counts = np.array(self.counts_um)
        if counts.ndim != 2 or counts.dtype != np.int16 or not 0 < counts.size <= MAX_TAXELS:
            raise TouchError(
                f"a taxel frame needs (rows, columns) of int16, at most {MAX_TAXELS} taxels; got "
                f"{counts.shape} of {counts.dtype}"
            )
        is_32_bits = 0 <= self.sequence < _WRAP and 0 <= self.mark < _WRAP
        if not (is_32_bits and 0 <= self.clock_us < 2**64):
            raise TouchError("sequence and mark of a taxel frame are 32 bits, its clock 64")
        counts.setflags(write=False)
        object.__setattr__(self, "counts_um", counts)
        if self.along_um is not None:
            along = np.array(self.along_um)
            if along.shape != (*counts.shape, 2) or along.dtype != np.int16:
                raise TouchError(
                    f"a taxel frame of {counts.shape} needs (rows, columns, 2) of int16 along the "
                    f"gel; got {along.shape} of {along.dtype}"
                )
            along.setflags(write=False)
            object.__setattr__(self, "along_um", along)

    @property
    def height_mm(self) -> NDArray[np.float32]:
        """Heights, (rows, columns) [mm], positive into the gel."""
        return self.counts_um.astype(np.float32) * np.float32(1e-3)

    @property
    def along_mm(self) -> NDArray[np.float32] | None:
        """Displacements along the gel, (rows, columns, 2) [mm, gel frame]; None in version 1."""
        if self.along_um is None:
            return None
        return self.along_um.astype(np.float32) * np.float32(1e-3)


@dataclass(frozen=True, slots=True, kw_only=True)
class TaxelMark:
    """The packet of the host: frames captured after it carry its number.

    Attributes:
        mark: 1 to 2**32 - 1; frames carry 0 before the first one.
    """

    mark: int


@dataclass(slots=True)
class WireCounts:
    """Packets and damage in a stream.

    Attributes:
        packets: Whole packets.
        damaged: Packets with a wrong checksum, or cut off.
        foreign: Whole headers of an unknown version or kind.
        garbage_bytes: Bytes that belong to no packet.
    """

    packets: int = 0
    damaged: int = 0
    foreign: int = 0
    garbage_bytes: int = 0


def counts_of(height_mm: NDArray[np.floating]) -> NDArray[np.int16]:
    """Heights or displacements [mm], of any shape, as rounded counts [µm].

    Raises:
        TouchError: Not finite, or beyond ± ``UM_LIMIT``.
    """
    um = np.rint(np.asarray(height_mm, dtype=np.float64) * 1e3)
    if not (np.isfinite(um).all() and np.abs(um).max(initial=0) <= UM_LIMIT):
        raise TouchError(f"displacements to send must be finite and within ±{UM_LIMIT / 1e3:g} mm")
    return um.astype(np.int16)


def encode_frame(frame: TaxelFrame) -> bytes:
    """The packet of a frame."""
    rows, columns = frame.counts_um.shape
    version, counts = HEIGHTS, frame.counts_um
    if frame.along_um is not None:
        version, counts = DISPLACEMENTS, np.concatenate([frame.along_um, counts[:, :, None]], 2)
    payload = counts.astype("<i2").tobytes()
    numbers = rows, columns, frame.sequence, frame.mark, frame.clock_us
    head = _header(version, FRAME, *numbers)
    return head + payload + _CHECKSUM.pack(zlib.crc32(payload))


def encode_mark(mark: int) -> bytes:
    """The packet of a mark.

    Raises:
        TouchError: Not 1 to 2**32 - 1.
    """
    if not 0 < mark < _WRAP:
        raise TouchError(f"a mark is 1 to {_WRAP - 1}, got {mark}")
    return _header(HEIGHTS, MARK, 0, 0, 0, mark, 0)


def _header(
    version: int, kind: int, rows: int, columns: int, sequence: int, mark: int, clock_us: int
) -> bytes:
    head = _HEADER.pack(SYNC, version, kind, rows, columns, sequence, mark, clock_us)
    return head + _CHECKSUM.pack(zlib.crc32(head))


def frame_bytes(rows: int, columns: int, *, with_shear: bool) -> int:
    """Bytes of a frame's packet, of version 2 if it is one ``with_shear``."""
    taxel = _TAXEL_BYTES[DISPLACEMENTS if with_shear else HEIGHTS]
    return HEADER_BYTES + taxel * rows * columns + _CHECKSUM.size


@dataclass(slots=True)
class PacketParser:
    """Finds packets in a stream that arrives in pieces, and continues after damage.

    The header has a checksum of its own: a damaged size can't make the parser wait for bytes that
    never come. After a damaged packet the search continues at the byte after its start, so a packet
    that began inside a torn one is not lost.

    Attributes:
        counts: Packets and damage so far.
    """

    counts: WireCounts = field(default_factory=WireCounts)
    _buffer: bytearray = field(default_factory=bytearray)

    def feed(self, data: bytes) -> list[TaxelFrame | TaxelMark]:
        """Take the next bytes; returns the packets that they complete, in order."""
        self._buffer += data
        packets: list[TaxelFrame | TaxelMark] = []
        while self._find_sync() and len(self._buffer) >= HEADER_BYTES:
            size = self._packet_size()
            if size is None:
                continue
            if len(self._buffer) < size:
                break
            packet = self._packet(size)
            if packet is not None:
                packets.append(packet)
        return packets

    def _find_sync(self) -> bool:
        """Drop the bytes before the next sync; False if there is none."""
        start = self._buffer.find(SYNC)
        if start >= 0:
            self._drop(start)
            return True
        partial = next(n for n in (3, 2, 1, 0) if self._buffer.endswith(SYNC[:n]))
        self._drop(len(self._buffer) - partial)
        return False

    def _drop(self, count: int) -> None:
        self.counts.garbage_bytes += count
        del self._buffer[:count]

    def _packet_size(self) -> int | None:
        """Size of the packet at the start of the buffer; None drops the sync of a bad header."""
        (checksum,) = _CHECKSUM.unpack_from(self._buffer, _HEADER.size)
        _, version, kind, rows, columns, *_ = _HEADER.unpack_from(self._buffer)
        if zlib.crc32(self._buffer[: _HEADER.size]) != checksum:
            self.counts.damaged += 1
        elif (version, kind) == (HEIGHTS, MARK):
            return HEADER_BYTES
        elif version in _TAXEL_BYTES and kind == FRAME and 0 < rows * columns <= MAX_TAXELS:
            return HEADER_BYTES + _TAXEL_BYTES[version] * rows * columns + _CHECKSUM.size
        else:
            self.counts.foreign += 1
        self._drop(1)
        return None

    def _packet(self, size: int) -> TaxelFrame | TaxelMark | None:
        _, version, kind, rows, columns, sequence, mark, clock_us = _HEADER.unpack_from(
            self._buffer
        )
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
        counts = np.frombuffer(payload, dtype="<i2").astype(np.int16).reshape(rows, columns, -1)
        return TaxelFrame(
            sequence=sequence,
            mark=mark,
            clock_us=clock_us,
            counts_um=counts[:, :, -1],
            along_um=counts[:, :, :2] if version == DISPLACEMENTS else None,
        )


@dataclass(slots=True)
class SequenceCount:
    """Checks the sequence numbers of frames.

    Attributes:
        missing: Numbers that were left out.
        repeated: Frames with the number of the frame before.
        restarts: Steps backwards: the sensor was switched off and on.
    """

    missing: int = 0
    repeated: int = 0
    restarts: int = 0
    _last: int | None = None

    def is_new(self, sequence: int) -> bool:
        """Take the next number; False if it is that of the frame before."""
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
