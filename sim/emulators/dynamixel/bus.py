"""The servos of one bus under the instructions of Protocol 2.0: who answers, in which order.

Not here: the port and the passing of time (``bus_process``), one servo's registers (``servo``).

Source: ROBOTIS e-Manual, 'DYNAMIXEL Protocol 2.0', 'Instruction Details'.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel import packets as protocol
from sim.emulators.dynamixel.control_table import BAUDS
from sim.emulators.dynamixel.packets import PacketInstruction
from sim.emulators.dynamixel.servo import EmulatedServo, Written

_READS = (protocol.READ, *protocol.GROUP_READS)
_TO_ALL = (
    protocol.WRITE,
    protocol.REG_WRITE,
    protocol.ACTION,
    protocol.FACTORY_RESET,
    protocol.REBOOT,
    protocol.CLEAR,
)
"""Instructions that every servo carries out, without an answer, when they are broadcast."""

Block = tuple[int, int, int]
"""Id, first address and length of one servo's part in a read of several."""


class ServoBus:
    """Servos on one line. Not thread-safe: the caller holds a lock."""

    def __init__(
        self,
        servos: Sequence[EmulatedServo],
        is_silent: Callable[[int], bool],
        on_written: Callable[[Written], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Connect the servos.

        Args:
            servos: At most a few; their ids may change, and may be equal.
            is_silent: Whether the servo with an id does not answer.
            on_written: Called with the addresses that an instruction has written.
            clock: Monotonic [s].
        """
        self._servos, self._is_silent = servos, is_silent
        self._on_written, self._clock = on_written, clock

    def hearing(self, baud: int) -> Sequence[EmulatedServo]:
        """The servos that listen at a baud rate, in the order of their ids."""
        heard = [servo for servo in self._servos if BAUDS[servo.table[at.BAUD]] == baud]
        return sorted(heard, key=lambda servo: servo.id)

    def execute(self, instruction: PacketInstruction, baud: int) -> list[bytes]:
        """Carry out an instruction; returns the status packets in their order on the line."""
        servos, code = self.hearing(baud), instruction.code
        if instruction.intact:
            for servo in servos:
                servo.feed_watchdog(self._clock())
        if instruction.servo_id != protocol.BROADCAST:
            addressed = [servo for servo in servos if servo.id == instruction.servo_id]
            return [packet for s in addressed if (packet := self._answer(s, instruction))]
        if not instruction.intact:
            return []
        if code == protocol.PING:
            return [packet for s in servos if (packet := self._answer(s, instruction))]
        if code in _TO_ALL and not _resets_all(instruction):
            for servo in servos:
                self._execute(servo, instruction)
        elif code in protocol.GROUP_READS:
            return self._read_group(code, servos, _read_blocks(instruction))
        elif code in (protocol.SYNC_WRITE, protocol.BULK_WRITE):
            self._write_group(servos, _write_blocks(instruction))
        return []

    def _answer(self, servo: EmulatedServo, instruction: PacketInstruction) -> bytes:
        """Status packet of one servo; empty where it says nothing."""
        code, data = instruction.code, b""
        error = protocol.BAD_CRC
        answers = _answers(servo, code)  # as it was set before this instruction
        if instruction.intact:
            error, data = self._execute(servo, instruction)
        if self._is_silent(servo.id) or not answers:
            return b""
        # A write may have changed the id: the answer still comes from the addressed one.
        sender = servo.id if instruction.servo_id == protocol.BROADCAST else instruction.servo_id
        return protocol.status(sender, _with_alert(servo, error), data)

    def _execute(self, servo: EmulatedServo, instruction: PacketInstruction) -> tuple[int, bytes]:
        error, data, written = servo.execute(instruction.code, instruction.parameters)
        if written:
            self._on_written(written)
        return error, data

    def _read_group(
        self, code: int, servos: Sequence[EmulatedServo], blocks: Sequence[Block]
    ) -> list[bytes]:
        """Answer in the order of the ids; each servo waits for the one before it.

        So the servos after a missing one stay silent, and an id can be asked only once.
        """
        parts = []
        waiting = {servo.id: servo for servo in reversed(servos)}
        for servo_id, address, length in blocks:
            servo = waiting.pop(servo_id, None)
            if servo is None or self._is_silent(servo_id) or not _answers(servo, code):
                break
            error, data = servo.table.read(address, length)
            parts.append((servo_id, _with_alert(servo, error), data))
        if code in (protocol.FAST_SYNC_READ, protocol.FAST_BULK_READ):
            length = protocol.fast_length([length for _, _, length in blocks])
            return [protocol.fast_status(parts, length)] if parts else []
        return [protocol.status(servo_id, error, data) for servo_id, error, data in parts]

    def _write_group(
        self, servos: Sequence[EmulatedServo], blocks: Iterator[tuple[int, int, bytes]]
    ) -> None:
        """Write to several servos at once; none of them answers, not even with a refusal."""
        written: Written = frozenset()
        for servo_id, address, data in blocks:
            for servo in servos:
                if servo.id == servo_id:
                    written |= servo.write(address, data)[2]
        if written:
            self._on_written(written)


def _answers(servo: EmulatedServo, code: int) -> bool:
    """Whether the servo's status return level lets it answer an instruction."""
    level = servo.table[at.STATUS_RETURN]
    return code == protocol.PING or level == 2 or (level == 1 and code in _READS)


def _with_alert(servo: EmulatedServo, error: int) -> int:
    return error | (protocol.ALERT if servo.table[at.HARDWARE_ERROR] else 0)


def _resets_all(instruction: PacketInstruction) -> bool:
    """Whether it is the broadcast of a reset of everything, which servos ignore."""
    return instruction.code == protocol.FACTORY_RESET and instruction.parameters[:1] == b"\xff"


def _read_blocks(instruction: PacketInstruction) -> Sequence[Block]:
    parameters = instruction.parameters
    if instruction.code in (protocol.SYNC_READ, protocol.FAST_SYNC_READ):
        address, length = protocol.u16(parameters), protocol.u16(parameters[2:])
        return [(servo_id, address, length) for servo_id in parameters[4:]]
    whole = range(0, len(parameters) - 4, 5)
    return [
        (parameters[i], protocol.u16(parameters[i + 1 :]), protocol.u16(parameters[i + 3 :]))
        for i in whole
    ]


def _write_blocks(instruction: PacketInstruction) -> Iterator[tuple[int, int, bytes]]:
    """Id, address and data of each servo; a part that is cut off is left out."""
    parameters, start = instruction.parameters, 0
    if instruction.code == protocol.SYNC_WRITE:
        address, length = protocol.u16(parameters), protocol.u16(parameters[2:])
        for start in range(4, len(parameters) - length, 1 + length):
            yield parameters[start], address, parameters[start + 1 : start + 1 + length]
        return
    while len(parameters) - start >= 5:
        address = protocol.u16(parameters[start + 1 :])
        length = protocol.u16(parameters[start + 3 :])
        data = parameters[start + 5 : start + 5 + length]
        if len(data) == length:
            yield parameters[start], address, data
        start += 5 + length
