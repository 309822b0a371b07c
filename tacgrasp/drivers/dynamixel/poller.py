"""The one thread that talks with the gripper's servos: it polls them and runs what it is given.

Polling goes on whatever the rest of the program does, also while the arm moves and nobody asks for
the gripper: a fault is noticed within a few polls, latched, and told to ``on_fault``. It also feeds
the servos' bus watchdog.

Source: the notes: two threads on a port get -1000; a sync read drops the alert bit, hence single
reads and register 70.
"""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeoutError
from dataclasses import dataclass
from typing import TypeVar

from primitives.errors import RobotError
from tacgrasp.drivers.dynamixel import registers as at
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.errors import BusError, Trouble
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings

T = TypeVar("T")
OnFault = Callable[[str], None]

CALL_S = 2.0
"""Longest wait for the thread to do what it is given; it is busy for some 0.1 s at most."""

_WATCHDOG_POLLS = 10
_PARTS = 4

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoSample:
    """One servo as it was polled; current in the model's units, signed as the position."""

    moving: bool
    current: int
    velocity: int
    position: int
    voltage_v: float
    temperature_c: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """All servos as they were polled; ``number`` counts up, ``taken_s`` is monotonic."""

    number: int
    taken_s: float
    servos: Sequence[ServoSample]


class Watch:
    """The I/O thread of one gripper. Starts polling at once."""

    def __init__(
        self,
        bus: Bus,
        settings: DynamixelSettings,
        on_fault: OnFault | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._bus, self._settings, self._clock = bus, settings, clock
        self._on_fault = on_fault
        self._ids = [servo.id for servo in settings.servos]
        self._jobs: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._changed = threading.Condition()
        self._fault = ""
        self._sample: Sample | None = None
        self._polls = 0
        self._closed = False
        self._thread = threading.Thread(target=self._run, name="gripper", daemon=True)
        self._thread.start()

    @property
    def fault(self) -> str:
        """Why the gripper can't be used any more; empty while it can."""
        return self._fault

    def tell(self, on_fault: OnFault) -> None:
        """Call this once, from the I/O thread, with a fault's reason; at once if there is one."""
        with self._changed:
            self._on_fault, why = on_fault, self._fault
        if why:
            _tell(on_fault, why)

    def healthy(self) -> bool:
        """Whether all is well, from what was polled last; costs nothing."""
        sample = self._sample
        if self._fault or sample is None or not self._thread.is_alive():
            return False
        stale_s = 0.2 + 2 * self._settings.poll_ms / 1000
        return self._clock() - sample.taken_s < stale_s

    def call(self, job: Callable[[Bus], T], *, despite_fault: bool = False) -> T:
        """Run a job on the I/O thread and return what it returns.

        Raises:
            RobotError: The gripper has a fault, the job failed, or the thread does not answer.
        """
        result: Future[T] = Future()

        def run() -> None:
            if self._fault and not despite_fault:
                result.set_exception(RobotError(self._fault))
                return
            try:
                result.set_result(job(self._bus))
            except BaseException as error:
                result.set_exception(error)
                if isinstance(error, BusError) and error.trouble is not Trouble.REFUSED:
                    self._latch(f"{error}")

        if not self._thread.is_alive():
            raise RobotError(self._fault or "the gripper is disconnected")
        self._jobs.put(run)
        try:
            return result.result(CALL_S)
        except FutureTimeoutError:
            raise RobotError(
                f"the gripper's I/O thread did not answer within {CALL_S:g} s; is this computer "
                "overloaded?"
            ) from None

    def next_sample(self, after: int, timeout_s: float = CALL_S) -> Sample:
        """The first sample with a number above ``after``.

        Raises:
            RobotError: The gripper has a fault, or none came in time.
        """
        with self._changed:
            # in parts: after a pause of the whole process the other thread must have its turn first
            for _ in range(_PARTS):
                if self._changed.wait_for(lambda: self._news(after), timeout_s / _PARTS):
                    break
            if self._fault or self._closed:
                raise RobotError(self._fault or "the gripper is disconnected")
            if self._sample is None or self._sample.number <= after:
                raise RobotError(
                    f"the gripper was not polled for {timeout_s:g} s; is this computer overloaded?"
                )
            return self._sample

    def _news(self, after: int) -> bool:
        newer = self._sample is not None and self._sample.number > after
        return bool(self._closed or self._fault or newer)

    @property
    def num_samples(self) -> int:
        """Number of the last sample; 0 before the first."""
        return self._polls

    def close(self) -> None:
        """End the thread. Idempotent."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self._jobs.put(None)
        if self._thread is not threading.current_thread():
            self._thread.join(timeout=CALL_S)

    def _run(self) -> None:
        period_s = self._settings.poll_ms / 1000
        due_s = self._clock()
        while True:
            try:
                job = self._jobs.get(timeout=max(0.0, due_s - self._clock()))
                if job is None:
                    return
                job()
            except queue.Empty:
                pass
            if self._clock() >= due_s:
                due_s = max(due_s + period_s, self._clock())
                if not self._fault:
                    self._poll()

    def _poll(self) -> None:
        try:
            servos = [self._look_at(servo) for servo in self._ids]
        except RobotError as error:
            self._latch(f"{error}")
            return
        except Exception as error:
            _log.exception("the gripper's polling failed")
            self._latch(f"the gripper's driver failed: {type(error).__name__}: {error}")
            return
        with self._changed:
            self._polls += 1
            self._sample = Sample(number=self._polls, taken_s=self._clock(), servos=servos)
            self._changed.notify_all()

    def _look_at(self, servo: int) -> ServoSample:
        answer = self._bus.read(servo, at.PRESENT, at.PRESENT_LENGTH)
        error = self._bus.read_number(servo, at.HARDWARE_ERROR, 1)
        if error or answer.alert:
            torque = self._bus.read_number(servo, at.TORQUE, 1)
            raise RobotError(_hardware_error(servo, error, bool(torque)))
        sample = parsed(answer.data)
        if sample.temperature_c > self._settings.max_temperature_c:
            raise RobotError(
                f"servo {servo} of the gripper is {sample.temperature_c} °C hot, beyond "
                f"{self._settings.max_temperature_c:g} °C; let it cool, and grip with less force "
                "or for less time"
            )
        if self._settings.bus_watchdog_ms and self._polls % _WATCHDOG_POLLS == 0:
            watchdog = self._bus.read_number(servo, at.WATCHDOG, 1)
            if watchdog == at.WATCHDOG_TRIPPED:
                raise RobotError(
                    f"the bus watchdog of servo {servo} has tripped: this program was stalled for "
                    f"more than {self._settings.bus_watchdog_ms} ms; start the run again"
                )
        return sample

    def _latch(self, why: str) -> None:
        with self._changed:
            if self._fault:
                return
            self._fault, told = why, self._on_fault
            self._changed.notify_all()
        if told is not None:
            _tell(told, why)


def _tell(on_fault: OnFault, why: str) -> None:
    try:
        on_fault(why)
    except Exception:
        _log.exception("what was to be done about a fault of the gripper failed: %s", why)


def parsed(data: bytes) -> ServoSample:
    """A servo's registers from ``at.PRESENT`` on."""

    def number(address: int, length: int, signed: bool = True) -> int:
        start = address - at.PRESENT
        return int.from_bytes(data[start : start + length], "little", signed=signed)

    return ServoSample(
        moving=bool(number(at.PRESENT, 1, signed=False)),
        current=number(126, 2),
        velocity=number(128, 4),
        position=number(at.PRESENT_POSITION, 4),
        voltage_v=0.1 * number(at.VOLTAGE, 2, signed=False),
        temperature_c=number(at.TEMPERATURE, 1, signed=False),
    )


def _hardware_error(servo: int, error: int, torque: bool) -> str:
    what = at.error_words(error) or "a hardware error that was gone when it was read"
    held = "it still holds" if torque else "its torque is off: what was held has been let go"
    return (
        f"servo {servo} of the gripper reports: {what} (hardware error {error:#04x}); {held}. "
        "Remove the cause, then reboot the servo or switch its power off and on"
    )
