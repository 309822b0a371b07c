"""Transactions with Dynamixel servos over the manufacturer's SDK, with the checks that it lacks.

Every reply is checked for its length: a late reply to an earlier read would pass for this one.
After a missing reply, stray bytes are drained before the next read. A failed read is repeated, once
at least, until ``patience_ms`` are over. An unacknowledged write is read back. A stuck or lost port
is rebuilt. A value is either what the servo sent or an error, never a substitute.

Not thread-safe: only the thread that owns the port (``poller``) calls it.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from primitives.errors import RobotError
from tacgrasp.drivers.check import EMULATOR_ADVICE
from tacgrasp.drivers.dynamixel.errors import (
    STATUS_ERRORS,
    BusError,
    BusFault,
    BusFaultCounts,
    BusReply,
)
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.serial_ports import find_port

if TYPE_CHECKING:
    from tacgrasp.drivers.dynamixel.port import ClaimedPort

DEVICE = "the gripper"

_PING, _READ, _WRITE, _SYNC_WRITE = 1, 2, 3, 0x83
_BROADCAST = 0xFE
_ERROR_AT, _SHORTEST = 8, 11  # bytes of a status packet without parameters
_TX_BUSY, _CORRUPT = -1000, -3002
_QUIET_S = 0.003


class Bus:
    """One serial line with servos on it.

    Attributes:
        counts: Transient faults since the start.
        path: Path of the port; empty before the first ``open``.
        patience_s: Time for which a silent or corrupt servo is asked again [s].
    """

    def __init__(self, settings: DynamixelSettings) -> None:
        self._settings = settings
        self._port: ClaimedPort | None = None
        self._sdk: Any = None
        self.counts = BusFaultCounts()
        self.patience_s = settings.patience_ms / 1000
        self.path = ""

    def open(self, baud: int | None = None) -> None:
        """Open and claim the port; an open port is closed and opened again.

        Args:
            baud: Baud rate in place of the settings' one [bit/s].

        Raises:
            RobotError: The port does not exist, is in use by another program or can't be opened.
        """
        import termios

        from dynamixel_sdk import Protocol2PacketHandler

        from tacgrasp.drivers.dynamixel.port import ClaimedPort

        self.close()
        self.path = find_port(self._settings.port, DEVICE)
        timeout_s = self._settings.reply_timeout_ms / 1000
        try:
            self._port = ClaimedPort(self.path, baud or self._settings.baud, timeout_s, DEVICE)
        except (OSError, termios.error) as error:
            raise RobotError(
                f"the serial port {self.path} of {DEVICE} can't be opened: {error}; check the "
                "cable, and that you may use the port (group dialout)"
            ) from None
        self._sdk = Protocol2PacketHandler()

    def close(self) -> None:
        """Close the port; the servos keep torque and goals. Idempotent, never raises."""
        port, self._port = self._port, None
        if port is not None:
            try:
                port.closePort()
            except Exception:  # closing fails on an unplugged port
                self.path = ""

    def ping(self, servo: int) -> int:
        """Model number of a servo. Raises ``BusError``."""
        data = self._read_with_retry(servo, lambda: self._transact(servo, _PING, b"", 3)).data
        return int.from_bytes(data[:2], "little")

    def read(self, servo: int, address: int, length: int) -> BusReply:
        """Read registers of a servo; never three bytes, the length of a reply to a ping.

        Raises:
            BusError: No valid reply in two attempts.
        """
        if length == 3:
            raise ValueError("three bytes can't be told from the reply to a ping")
        body = _u16(address) + _u16(length)
        return self._read_with_retry(servo, lambda: self._transact(servo, _READ, body, length))

    def read_number(self, servo: int, address: int, length: int, signed: bool = False) -> int:
        """Read one register. Raises ``BusError``."""
        return int.from_bytes(self.read(servo, address, length).data, "little", signed=signed)

    def write(self, servo: int, address: int, data: bytes) -> None:
        """Write registers; an unacknowledged write is read back and repeated once if needed.

        Raises:
            BusError: The servo refuses, or the write can't be confirmed.
        """
        for attempt in (1, 2):
            try:
                self._transact(servo, _WRITE, _u16(address) + data, 0)
                return
            except BusError as error:
                if error.kind in (BusFault.REFUSED, BusFault.LOST):
                    raise
                self._recover(servo, error, time.monotonic())
                if self.read(servo, address, len(data)).data == data:
                    return
                if attempt == 2:
                    raise
                self.counts.rewritten += 1

    def write_all(self, address: int, data: Mapping[int, bytes]) -> None:
        """Write the same registers of several servos at once, and read them back.

        A sync write has no replies, so that a refusal shows in the reading back only.

        Raises:
            BusError: The write of a servo can't be confirmed.
        """
        (first, values), *others = data.items()
        if not others:
            self.write(first, address, values)
            return
        length = len(values)
        body = _u16(address) + _u16(length)
        body += b"".join(bytes([servo]) + values for servo, values in data.items())
        self._transact(_BROADCAST, _SYNC_WRITE, body, 0)
        for servo, values in data.items():
            if self.read(servo, address, length).data != values:
                self.write(servo, address, values)  # succeeds, or raises the servo's refusal

    def _read_with_retry(self, servo: int, read: Callable[[], BusReply]) -> BusReply:
        began_s, is_repeated = time.monotonic(), False
        while True:
            try:
                return read()
            except BusError as error:
                over = is_repeated and time.monotonic() - began_s >= self.patience_s
                if error.kind not in (BusFault.SILENT, BusFault.CORRUPT) or over:
                    raise
                self._recover(servo, error, began_s)
                is_repeated = True

    def _recover(self, servo: int, error: BusError, began_s: float) -> None:
        """After a bad reply: ping the servo until it replies, then drain the line.

        The reply to a ping has a length that none of our reads has, so that a ping is safe before
        the drain ends.

        Args:
            servo: Id of the servo.
            error: The bad reply.
            began_s: Start of the transaction; the patience is counted from it [s].

        Raises:
            BusError: The servo does not reply to pings either.
        """
        if error.kind is BusFault.CORRUPT:
            self.counts.corrupt += 1
        else:
            self.counts.silent += 1
        replied = self._ping_until_reply(servo, began_s)
        drain_s = self._settings.drain_ms / 1000 if error.timed_out else _QUIET_S
        if self._drain(time.monotonic() + drain_s) and replied:
            self.counts.late += 1

    def _ping_until_reply(self, servo: int, began_s: float) -> bool:
        """Ping until bytes arrive; returns whether they were the ping's own reply.

        Raises:
            BusError: Nothing arrives until the patience is over.
        """
        while True:
            try:
                self._transact(servo, _PING, b"", 3)
                return True
            except BusError as error:
                if error.kind is BusFault.CORRUPT:
                    return False
                over = time.monotonic() - began_s >= self.patience_s
                if error.kind is not BusFault.SILENT or over:
                    raise

    def _drain(self, until_s: float) -> bool:
        """Discard what arrives until then; returns whether anything arrived."""
        port, received = self._open_port(), False
        with self._port_errors():
            while time.monotonic() < until_s:
                received = bool(port.readPort(256)) or received
        return received

    def _transact(self, servo: int, code: int, body: bytes, length: int) -> BusReply:
        """Send one packet and, unless it is a broadcast, read a reply of ``length`` data bytes."""
        port = self._open_port()
        size = len(body) + 3
        packet = [0, 0, 0, 0, servo, size & 0xFF, size >> 8, code, *body, 0, 0]
        start_s, num_stray = time.monotonic(), 0
        with self._port_errors():
            received, result, _ = self._sdk.txRxPacket(port, packet)
            while result == 0 and servo != _BROADCAST and _is_stray(received, servo, length):
                num_stray += 1  # a reply to an earlier packet; ours is still to come
                received, result = self._sdk.rxPacket(port, False)
        name = f"servo {servo} on {self.path}"
        self.counts.late += num_stray
        if result == _TX_BUSY:
            self.open()
            self.counts.rebuilt += 1
            raise BusError(BusFault.CORRUPT, f"the port of {name} was stuck and was rebuilt")
        if result != 0 and num_stray:
            raise BusError(
                BusFault.CORRUPT, f"{name} answered an earlier packet only", timed_out=True
            )
        if result != 0:
            raise self._failure(result, name, time.monotonic() - start_s)
        if servo == _BROADCAST:
            return BusReply(data=b"", alert=False)
        if error := received[_ERROR_AT] & 0x7F:
            reason = STATUS_ERRORS.get(error, f"error {error}")
            raise BusError(BusFault.REFUSED, f"{name} refused: {reason}")
        data = bytes(received[_ERROR_AT + 1 : _ERROR_AT + 1 + length])
        return BusReply(data=data, alert=bool(received[_ERROR_AT] & 0x80))

    def _failure(self, result: int, name: str, duration_s: float) -> BusError:
        timeout_ms = self._settings.reply_timeout_ms
        if result == _CORRUPT:
            return BusError(
                BusFault.CORRUPT,
                f"{name} answered with a wrong CRC or half a packet",
                timed_out=1000 * duration_s >= timeout_ms,
            )
        advice = f"check power, cable, id and baud ({self._settings.baud})"
        if self._settings.is_emulated:
            advice = EMULATOR_ADVICE
        return BusError(
            BusFault.SILENT,
            f"{name} does not answer within {timeout_ms:g} ms: {advice}",
            timed_out=True,
        )

    def _open_port(self) -> ClaimedPort:
        if self._port is None:
            raise BusError(BusFault.LOST, f"the serial port of {DEVICE} is not open")
        return self._port

    @contextmanager
    def _port_errors(self) -> Iterator[None]:
        """Turn pyserial's errors for a lost port into one ``BusError``, and close the port."""
        import termios

        try:
            yield
        except IndexError as error:  # raised by the SDK for a reply that is too short
            raise BusError(BusFault.CORRUPT, f"a broken reply on {self.path}") from error
        except (OSError, termios.error) as error:
            path = self.path
            self.close()
            raise BusError(
                BusFault.LOST,
                f"the serial port {path} of {DEVICE} is gone ({error}): unplugged, or the adapter "
                "lost power; what it grips is still held by the servo",
            ) from error


def _is_stray(received: Sequence[int], servo: int, length: int) -> bool:
    """Whether a packet is not the expected reply, by its sender or its length."""
    data_length = received[5] + (received[6] << 8) + 7 - _SHORTEST
    refused = data_length == 0 and received[_ERROR_AT] & 0x7F
    return received[4] != servo or (data_length != length and not refused)


def _u16(value: int) -> bytes:
    return value.to_bytes(2, "little")
