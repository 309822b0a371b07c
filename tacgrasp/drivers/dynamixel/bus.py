"""Transactions with Dynamixel servos over the real SDK, and what the SDK leaves to its user.

Every answer is checked for its length (a late answer to another read would pass for this one);
after an answer that did not come, stray ones are drained before anything else is read; reads are
tried once more; a write whose answer is lost is read back; a port that is stuck or gone is rebuilt.
A value is either what the servo said or an error, never made up.

For one thread only: the one that owns the port (``dynamixel_watch``).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from primitives.errors import RobotError
from tacgrasp.drivers.dynamixel.errors import Answer, BusError, Counts, Trouble, refusal_words
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.serial_ports import find_port

if TYPE_CHECKING:
    from tacgrasp.drivers.dynamixel.port import ClaimedPort

WHAT = "the gripper"

_PING, _READ, _WRITE, _REBOOT, _SYNC_WRITE = 1, 2, 3, 8, 0x83
_BROADCAST = 0xFE
_ERROR_AT, _SHORTEST = 8, 11  # bytes of a status packet without parameters
_TX_BUSY, _CORRUPT = -1000, -3002
_QUIET_S = 0.003


class Bus:
    """One serial line with servos on it.

    Attributes:
        counts: Transient faults so far.
        path: Of the port; empty before it was opened.
        hurried: Says whether a silence must be known at once, because the arm moves; never, until
            this is set.
    """

    def __init__(
        self,
        settings: DynamixelSettings,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._settings, self._clock, self._sleep = settings, clock, sleep
        self._port: ClaimedPort | None = None
        self._sdk: Any = None
        self.counts = Counts()
        self.hurried: Callable[[], bool] = lambda: False
        self.path = ""

    def open(self, baud: int | None = None) -> None:
        """Open and claim the port, anew when it is open.

        Args:
            baud: Instead of the settings' [bit/s].

        Raises:
            RobotError: It does not exist, is taken by another program or can't be opened.
        """
        import termios

        from dynamixel_sdk import Protocol2PacketHandler

        from tacgrasp.drivers.dynamixel.port import ClaimedPort

        self.close()
        self.path = find_port(self._settings.port, WHAT)
        try:
            self._port = ClaimedPort(
                self.path,
                baud or self._settings.baud,
                self._settings.reply_timeout_ms / 1000,
                WHAT,
            )
        except (OSError, termios.error) as error:
            raise RobotError(
                f"the serial port {self.path} of {WHAT} can't be opened: {error}; check the cable, "
                "and that you may use it (group dialout)"
            ) from None
        self._sdk = Protocol2PacketHandler()

    def close(self) -> None:
        """Close the port; the servos keep doing what they do. Idempotent, never raises."""
        port, self._port = self._port, None
        if port is not None:
            try:
                port.closePort()
            except Exception:  # an unplugged port can't even be closed in order
                self.path = ""

    def ping(self, servo: int) -> int:
        """Model number of a servo. Raises ``BusError``."""
        data = self._again(servo, lambda: self._transact(servo, _PING, b"", 3)).data
        return int.from_bytes(data[:2], "little")

    def read(self, servo: int, address: int, length: int) -> Answer:
        """Registers of a servo as they are now; never three bytes, which are a ping's answer.

        Raises:
            BusError: No good answer, twice.
        """
        if length == 3:
            raise ValueError("three bytes can't be told from the answer to a ping")
        return self._again(servo, lambda: self._read_once(servo, address, length))

    def read_number(self, servo: int, address: int, length: int, signed: bool = False) -> int:
        """One register. Raises ``BusError``."""
        return int.from_bytes(self.read(servo, address, length).data, "little", signed=signed)

    def write(self, servo: int, address: int, data: bytes) -> None:
        """Write registers; what is not acknowledged is read back, and written once more if needed.

        Raises:
            BusError: It is refused, or can't be confirmed.
        """
        for attempt in (1, 2):
            try:
                self._transact(servo, _WRITE, _u16(address) + data, 0)
                return
            except BusError as error:
                if error.trouble in (Trouble.REFUSED, Trouble.LOST):
                    raise
                self._recover(servo, error)
                if self.read(servo, address, len(data)).data == data:
                    return
                if attempt == 2:
                    raise
                self.counts.rewritten += 1

    def write_all(self, address: int, data: Mapping[int, bytes]) -> None:
        """Write the same registers of several servos at once, and read them back.

        Nobody answers a sync write, refusals stay unsaid: hence the reading back.

        Raises:
            BusError: It can't be confirmed of a servo.
        """
        if len(data) == 1:
            for servo, each in data.items():
                self.write(servo, address, each)
            return
        length = len(next(iter(data.values())))
        body = _u16(address) + _u16(length)
        body += b"".join(bytes([servo]) + each for servo, each in data.items())
        self._transact(_BROADCAST, _SYNC_WRITE, body, 0)
        for servo, each in data.items():
            if self.read(servo, address, length).data != each:
                self.write(servo, address, each)  # says why, or does it

    def reboot(self, servo: int) -> None:
        """Restart a servo: clears a hardware error, drops what is held. Raises ``BusError``."""
        self._transact(servo, _REBOOT, b"", 0)

    def _again(self, servo: int, read: Callable[[], Answer]) -> Answer:
        try:
            return read()
        except BusError as error:
            if error.trouble not in (Trouble.SILENT, Trouble.CORRUPT):
                raise
            self._recover(servo, error)
            return read()

    def _read_once(self, servo: int, address: int, length: int) -> Answer:
        return self._transact(servo, _READ, _u16(address) + _u16(length), length)

    def _recover(self, servo: int, error: BusError) -> None:
        """After a bad answer: find out at once whether the servo lives, and drain.

        A ping's answer has a length that no read of ours has, so that it is safe to ask before the
        drain is over: a servo that is gone is known after two timeouts.

        Raises:
            BusError: It does not answer the ping either.
        """
        failed_s = self._clock()
        if error.trouble is Trouble.CORRUPT:
            self.counts.corrupt += 1
        else:
            self.counts.silent += 1
        answered = self._lives(servo, failed_s)
        drain_s = self._settings.drain_ms / 1000 if error.waited else _QUIET_S
        if self._drain(self._clock() + drain_s) and answered:
            self.counts.late += 1

    def _lives(self, servo: int, failed_s: float) -> bool:
        """Ping until something comes; returns whether it was the ping's own answer.

        Raises:
            BusError: Nothing comes: at once when hurried, else when patience is over.
        """
        while True:
            try:
                self._transact(servo, _PING, b"", 3)
                return True
            except BusError as error:
                if error.trouble is Trouble.CORRUPT:
                    return False
                over = 1000 * (self._clock() - failed_s) > self._settings.patience_ms
                if error.trouble is not Trouble.SILENT or over or self.hurried():
                    raise

    def _drain(self, until_s: float) -> bool:
        """Throw away what comes until then; returns whether anything came."""
        port, came = self._opened(), False
        with _PortErrors(self):
            while self._clock() < until_s:
                came = bool(port.readPort(256)) or came
        return came

    def _transact(self, servo: int, code: int, body: bytes, length: int) -> Answer:
        """One packet there and, unless it is for all, one back with ``length`` bytes of data."""
        port = self._opened()
        size = len(body) + 3
        sent = [0, 0, 0, 0, servo, size & 0xFF, size >> 8, code, *body, 0, 0]
        began_s, stray = self._clock(), 0
        with _PortErrors(self):
            received, result, _ = self._sdk.txRxPacket(port, sent)
            while result == 0 and servo != _BROADCAST and _is_stray(received, servo, length):
                stray += 1  # an answer to an earlier question; ours is still to come
                received, result = self._sdk.rxPacket(port, False)
        what = f"servo {servo} on {self.path}"
        self.counts.late += stray
        if result == _TX_BUSY:
            self.open()
            self.counts.rebuilt += 1
            raise BusError(Trouble.CORRUPT, f"the port of {what} was stuck and was rebuilt")
        if result != 0 and stray:
            raise BusError(
                Trouble.CORRUPT, f"{what} answered an earlier question only", waited=True
            )
        if result != 0:
            raise self._failure(result, what, self._clock() - began_s)
        if servo == _BROADCAST:
            return Answer(data=b"", alert=False)
        error = received[_ERROR_AT]
        if error & 0x7F:
            raise BusError(Trouble.REFUSED, f"{what} refused: {refusal_words(error & 0x7F)}")
        data = bytes(received[_ERROR_AT + 1 : _ERROR_AT + 1 + length])
        return Answer(data=data, alert=bool(error & 0x80))

    def _failure(self, result: int, what: str, took_s: float) -> BusError:
        timeout_ms = self._settings.reply_timeout_ms
        waited = 1000 * took_s >= timeout_ms
        if result == _CORRUPT:
            message = f"{what} answered with a wrong CRC or half a packet"
            return BusError(Trouble.CORRUPT, message, waited=waited)
        return BusError(
            Trouble.SILENT,
            f"{what} does not answer within {timeout_ms:g} ms: check power, cable, id and baud "
            f"({self._settings.baud})",
            waited=True,
        )

    def _opened(self) -> ClaimedPort:
        if self._port is None:
            raise BusError(Trouble.LOST, f"the serial port of {WHAT} is not open")
        return self._port


class _PortErrors:
    """Turns what pyserial raises when a port is gone into one ``BusError``, and closes the port."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        import termios

        if isinstance(error, IndexError):  # the SDK, on an answer that is too short
            raise BusError(Trouble.CORRUPT, f"a broken answer on {self._bus.path}") from error
        if isinstance(error, (OSError, termios.error)):
            path = self._bus.path
            self._bus.close()
            raise BusError(
                Trouble.LOST,
                f"the serial port {path} of {WHAT} is gone ({error}): unplugged, or the adapter "
                "lost power; what it grips is still held by the servo",
            ) from error


def _is_stray(received: Sequence[int], servo: int, length: int) -> bool:
    """Whether this is not the answer that was asked for, by its sender or its length."""
    told = received[5] + (received[6] << 8) + 7 - _SHORTEST
    refused = told == 0 and received[_ERROR_AT] & 0x7F
    return received[4] != servo or (told != length and not refused)


def _u16(value: int) -> bytes:
    return value.to_bytes(2, "little")
