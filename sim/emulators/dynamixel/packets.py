"""Packets of the Dynamixel Protocol 2.0 as the servo's side reads and writes them.

Source: ROBOTIS e-Manual, 'DYNAMIXEL Protocol 2.0': header FF FF FD 00, id, u16 length of all that
follows, instruction, parameters, CRC-16 (polynomial 0x8005, start 0, not reflected). Where FF FF FD
stands inside instruction or parameters another FD is stuffed in.

Not here: what the instructions do (``dynamixel_servo``).
"""

from __future__ import annotations

from dataclasses import dataclass

PING, READ, WRITE, REBOOT = 0x01, 0x02, 0x03, 0x08
SYNC_READ, SYNC_WRITE, FAST_SYNC_READ = 0x82, 0x83, 0x8A
STATUS = 0x55
BROADCAST = 0xFE

OK, FAILED, NO_INSTRUCTION, BAD_CRC, OUT_OF_RANGE, BAD_LENGTH, BEYOND_LIMIT, NO_ACCESS = range(8)
"""Error numbers of a status packet, its lower seven bits."""

ALERT = 0x80
"""Bit of a status packet's error: the servo's hardware error status (70) is not zero."""

_HEADER = b"\xff\xff\xfd"
_LONGEST = 1024


def _crc_table() -> tuple[int, ...]:
    table = []
    for byte in range(256):
        value = byte << 8
        for _ in range(8):
            value = (value << 1) ^ (0x8005 if value & 0x8000 else 0)
        table.append(value & 0xFFFF)
    return tuple(table)


_CRC = _crc_table()


def crc16(data: bytes) -> int:
    """CRC of a packet up to, and without, its last two bytes."""
    value = 0
    for byte in data:
        value = ((value << 8) ^ _CRC[(value >> 8) ^ byte]) & 0xFFFF
    return value


def packet(servo_id: int, body: bytes) -> bytes:
    """A whole packet.

    Args:
        servo_id: Id in the header.
        body: Instruction (``STATUS`` from a servo) and what follows it, up to the CRC, unstuffed.
    """
    stuffed = body.replace(_HEADER, _HEADER + b"\xfd")
    head = _HEADER + bytes([0, servo_id]) + (len(stuffed) + 2).to_bytes(2, "little") + stuffed
    return head + crc16(head).to_bytes(2, "little")


def status(servo_id: int, error: int, parameters: bytes = b"") -> bytes:
    """The packet that a servo answers with."""
    return packet(servo_id, bytes([STATUS, error]) + parameters)


def fast_sync_status(parts: list[tuple[int, int, bytes]]) -> bytes:
    """The one packet that several servos write together; each has (id, error, data).

    Every servo adds its error, id, data and a CRC over all that went before; data are not stuffed.
    """
    length = 1 + sum(4 + len(data) for _, _, data in parts)
    line = _HEADER + bytes([0, BROADCAST]) + length.to_bytes(2, "little") + bytes([STATUS])
    for servo_id, error, data in parts:
        line += bytes([error, servo_id]) + data
        line += crc16(line).to_bytes(2, "little")
    return line


@dataclass(frozen=True, slots=True, kw_only=True)
class PacketInstruction:
    """An instruction packet as it came; ``intact`` is False when its CRC is wrong."""

    servo_id: int
    code: int
    parameters: bytes
    intact: bool = True


class PacketReader:
    """Cuts a stream of bytes into instruction packets; rubbish between them is skipped."""

    def __init__(self) -> None:
        self._left = b""

    def feed(self, data: bytes) -> list[PacketInstruction]:
        """The packets that are complete with these bytes."""
        self._left += data
        found = []
        while (packet := self._next()) is not None:
            if packet.code != STATUS:  # a servo hears the other servos' answers too
                found.append(packet)
        return found

    def _next(self) -> PacketInstruction | None:
        while True:
            start = self._left.find(_HEADER)
            if start < 0:
                self._left = self._left[-2:]
                return None
            self._left = self._left[start:]
            if len(self._left) < 8:
                return None
            length = int.from_bytes(self._left[5:7], "little")
            if self._left[3] == 0xFD or not 3 <= length <= _LONGEST:
                self._left = self._left[3:]
                continue
            if len(self._left) < 7 + length:
                return None
            whole, self._left = self._left[: 7 + length], self._left[7 + length :]
            body = whole[7:-2].replace(_HEADER + b"\xfd", _HEADER)
            return PacketInstruction(
                servo_id=whole[4],
                code=body[0],
                parameters=body[1:],
                intact=crc16(whole[:-2]) == int.from_bytes(whole[-2:], "little"),
            )
