"""Packets of the Dynamixel Protocol 2.0, as servos read and write them.

Source: ROBOTIS e-Manual, 'DYNAMIXEL Protocol 2.0': header FF FF FD 00, id, u16 length of the
rest, instruction, parameters, CRC-16 (polynomial 0x8005, start 0, not reflected). An FF FF FD
inside instruction or parameters is followed by a stuffed FD.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

PING, READ, WRITE, REG_WRITE, ACTION = 0x01, 0x02, 0x03, 0x04, 0x05
FACTORY_RESET, REBOOT, CLEAR = 0x06, 0x08, 0x10
SYNC_READ, SYNC_WRITE, FAST_SYNC_READ = 0x82, 0x83, 0x8A
BULK_READ, BULK_WRITE, FAST_BULK_READ = 0x92, 0x93, 0x9A
GROUP_READS = (SYNC_READ, FAST_SYNC_READ, BULK_READ, FAST_BULK_READ)
STATUS = 0x55
BROADCAST = 0xFE

OK, FAILED, NO_INSTRUCTION, BAD_CRC, OUT_OF_RANGE, BAD_LENGTH, BEYOND_LIMIT, NO_ACCESS = range(8)
"""Error numbers of a status packet, its lower seven bits."""

ALERT = 0x80
"""Bit of a status packet's error: the servo's hardware error status (70) is not zero."""

_HEADER = b"\xff\xff\xfd"
_LONGEST = 1024
_NO_IDS = (0xFD, 0xFF)


def _crc_table() -> tuple[int, ...]:
    table = []
    for byte in range(256):
        value = byte << 8
        for _ in range(8):
            value = (value << 1) ^ (0x8005 if value & 0x8000 else 0)
        table.append(value & 0xFFFF)
    return tuple(table)


_CRC = _crc_table()


def u16(data: bytes) -> int:
    """The number in the first two bytes."""
    return int.from_bytes(data[:2], "little")


def crc16(data: bytes) -> int:
    """CRC of a packet without its last two bytes."""
    value = 0
    for byte in data:
        value = ((value << 8) ^ _CRC[(value >> 8) ^ byte]) & 0xFFFF
    return value


def packet(servo_id: int, body: bytes) -> bytes:
    """A complete packet.

    Args:
        servo_id: Id in the header.
        body: Instruction (``STATUS`` from a servo) and parameters, before stuffing.
    """
    stuffed = body.replace(_HEADER, _HEADER + b"\xfd")
    head = _HEADER + bytes([0, servo_id]) + (len(stuffed) + 2).to_bytes(2, "little") + stuffed
    return head + crc16(head).to_bytes(2, "little")


def status(servo_id: int, error: int, parameters: bytes = b"") -> bytes:
    """The answer packet of a servo."""
    return packet(servo_id, bytes([STATUS, error]) + parameters)


def fast_length(lengths: Sequence[int]) -> int:
    """Length field of the one answer to a fast read of so many data bytes of each servo."""
    return (1 + sum(4 + length for length in lengths)) & 0xFFFF


def fast_status(parts: Sequence[tuple[int, int, bytes]], length: int) -> bytes:
    """The one answer packet of several servos; each part is (id, error, data).

    Every servo adds its error, id, data and a CRC over all bytes before; data are not stuffed. The
    first one writes the length of the whole packet; when a servo is missing, the packet breaks off.
    """
    line = _HEADER + bytes([0, BROADCAST]) + length.to_bytes(2, "little") + bytes([STATUS])
    for servo_id, error, data in parts:
        line += bytes([error, servo_id]) + data
        line += crc16(line).to_bytes(2, "little")
    return line


@dataclass(frozen=True, slots=True, kw_only=True)
class PacketInstruction:
    """A received instruction packet; ``intact`` is False when its CRC is wrong."""

    servo_id: int
    code: int
    parameters: bytes
    intact: bool = True


class PacketReader:
    """Cuts a stream of bytes into instruction packets; other bytes between them are skipped.

    An instruction inside the bytes that a damaged header announces is lost, as on a real line,
    where the host repeats it; ``forget`` is called after a silence.
    """

    def __init__(self) -> None:
        self._buffer = b""

    def feed(self, data: bytes) -> list[PacketInstruction]:
        self._buffer += data
        instructions = []
        while (packet := self._next()) is not None:
            if packet.code != STATUS:  # a servo receives the other servos' answers too
                instructions.append(packet)
        return instructions

    def forget(self) -> None:
        """Drop a packet that has broken off."""
        self._buffer = b""

    def _next(self) -> PacketInstruction | None:
        while True:
            start = self._buffer.find(_HEADER)
            if start < 0:
                self._buffer = self._buffer[-2:]
                return None
            self._buffer = self._buffer[start:]
            if len(self._buffer) < 8:
                return None
            length = u16(self._buffer[5:])
            is_packet = self._buffer[3] != 0xFD and self._buffer[4] not in _NO_IDS
            if not (is_packet and 3 <= length <= _LONGEST):
                self._buffer = self._buffer[3:]
                continue
            if len(self._buffer) < 7 + length:
                return None
            whole, self._buffer = self._buffer[: 7 + length], self._buffer[7 + length :]
            body = whole[7:-2].replace(_HEADER + b"\xfd", _HEADER)
            return PacketInstruction(
                servo_id=whole[4],
                code=body[0],
                parameters=body[1:],
                intact=crc16(whole[:-2]) == u16(whole[-2:]),
            )
