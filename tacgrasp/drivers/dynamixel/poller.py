"""The one thread that talks to the gripper's servos: it polls them and runs jobs for other threads.

Polling never pauses, whatever the rest of the program does, also while the arm moves: a fault is
detected within a few polls and latched. Polling also feeds the servos' bus watchdog.

Source: our notes on the SDK: two threads on one port get error -1000; a sync read drops the alert
bit, hence single reads and register 70.
"""

from __future__ import annotations

import logging
import queue
import struct
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeoutError
from dataclasses import dataclass
from typing import TypeVar

from primitives.errors import RobotError
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.errors import BusError, BusFault
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings

T = TypeVar("T")

CALL_S = 2.0
"""Longest wait for a job to end [s]; the thread is busy for about 0.1 s at most."""

_WATCHDOG_POLLS = 10
_NUM_WAITS = 4
_PRESENT = struct.Struct("<B3xhii10xB")
"""Registers 122, 126, 128, 132 and 146 from ``reg.PRESENT`` on, as in ``ServoSample``."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class ServoSample:
    """State of one servo at one poll; current in the model's units, signed like the position."""

    moving: bool
    current: int
    velocity: int
    position: int
    temperature_c: int


@dataclass(frozen=True, slots=True, kw_only=True)
class PollSample:
    """State of all servos at one poll; ``number`` counts the polls."""

    number: int
    servos: Sequence[ServoSample]


class ServoPoller:
    """The I/O thread of one gripper. Starts polling at once.

    Attributes:
        fault: The latched fault; empty while there is none.
        num_polls: Number of the last sample; 0 before the first.
    """

    def __init__(self, bus: Bus, settings: DynamixelSettings) -> None:
        self._bus, self._settings = bus, settings
        self._jobs: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._changed = threading.Condition()
        self.fault = ""
        self._sample: PollSample | None = None
        self.num_polls = 0
        self._closed = False
        self._thread = threading.Thread(target=self._run, name="gripper", daemon=True)
        self._thread.start()

    def call(self, job: Callable[[Bus], T], *, despite_fault: bool = False) -> T:
        """Run a job on the I/O thread and return its result.

        Raises:
            RobotError: The gripper has a fault, the job failed, or the thread does not answer.
        """
        result: Future[T] = Future()

        def run() -> None:
            if self.fault and not despite_fault:
                result.set_exception(RobotError(self.fault))
                return
            try:
                result.set_result(job(self._bus))
            except BaseException as error:
                result.set_exception(error)
                if isinstance(error, BusError) and error.kind is not BusFault.REFUSED:
                    self._latch_fault(f"{error}")

        if not self._thread.is_alive():
            raise RobotError(self.fault or "the gripper is disconnected")
        self._jobs.put(run)
        try:
            return result.result(CALL_S)
        except FutureTimeoutError:
            raise RobotError(
                f"the gripper's I/O thread did not answer within {CALL_S:g} s; is this computer "
                "overloaded?"
            ) from None

    def next_sample(self, after: int) -> PollSample:
        """Wait for the first sample with a number above ``after``.

        Raises:
            RobotError: The gripper has a fault, or no sample arrived in time.
        """
        with self._changed:
            # Several short waits: after a pause of the whole process the poller must run first.
            for _ in range(_NUM_WAITS):
                if self._changed.wait_for(
                    lambda: self._closed or self.fault or self.num_polls > after,
                    CALL_S / _NUM_WAITS,
                ):
                    break
            if self.fault or self._closed:
                raise RobotError(self.fault or "the gripper is disconnected")
            if self._sample is None or self._sample.number <= after:
                raise RobotError(
                    f"the gripper was not polled for {CALL_S:g} s; is this computer overloaded?"
                )
            return self._sample

    def close(self) -> None:
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self._jobs.put(None)
        if self._thread is not threading.current_thread():
            self._thread.join(timeout=CALL_S)

    def _run(self) -> None:
        period_s = self._settings.poll_ms / 1000
        due_s = time.monotonic()
        while True:
            try:
                job = self._jobs.get(timeout=max(0.0, due_s - time.monotonic()))
                if job is None:
                    return
                job()
            except queue.Empty:
                pass
            if time.monotonic() >= due_s:
                due_s = max(due_s + period_s, time.monotonic())
                if not self.fault:
                    self._poll()

    def _poll(self) -> None:
        try:
            servos = [self._poll_servo(servo) for servo in self._settings.ids]
        except RobotError as error:
            self._latch_fault(f"{error}")
            return
        except Exception as error:
            _log.exception("the gripper's polling failed")
            self._latch_fault(f"the gripper's driver failed: {type(error).__name__}: {error}")
            return
        with self._changed:
            self.num_polls += 1
            self._sample = PollSample(number=self.num_polls, servos=servos)
            self._changed.notify_all()

    def _poll_servo(self, servo: int) -> ServoSample:
        reply = self._bus.read(servo, reg.PRESENT, reg.PRESENT_LENGTH)
        error = self._bus.read_number(servo, reg.HARDWARE_ERROR, 1)
        if error or reply.alert:
            torque = self._bus.read_number(servo, reg.TORQUE, 1)
            raise RobotError(_hardware_error_message(servo, error, bool(torque)))
        moving, *numbers = _PRESENT.unpack(reply.data)
        sample = ServoSample(bool(moving), *numbers)
        if sample.temperature_c > self._settings.max_temperature_c:
            raise RobotError(
                f"servo {servo} of the gripper is {sample.temperature_c} °C hot, beyond "
                f"{self._settings.max_temperature_c:g} °C; let it cool, and grip with less force "
                "or for less time"
            )
        if self._settings.bus_watchdog_ms and self.num_polls % _WATCHDOG_POLLS == 0:
            watchdog = self._bus.read_number(servo, reg.WATCHDOG, 1)
            if watchdog == reg.WATCHDOG_TRIPPED:
                raise RobotError(
                    f"the bus watchdog of servo {servo} has tripped: this program was stalled for "
                    f"more than {self._settings.bus_watchdog_ms} ms; start the run again"
                )
        return sample

    def _latch_fault(self, fault: str) -> None:
        with self._changed:
            self.fault = self.fault or fault
            self._changed.notify_all()


def _hardware_error_message(servo: int, error: int, torque: bool) -> str:
    text = reg.hardware_error_text(error) or "a hardware error that was gone when it was read"
    grip = "it still holds" if torque else "its torque is off: what was held has been let go"
    return (
        f"servo {servo} of the gripper reports: {text} (hardware error {error:#04x}); {grip}. "
        "Remove the cause, then reboot the servo or switch its power off and on"
    )
