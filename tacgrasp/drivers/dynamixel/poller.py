"""The one thread that talks to the gripper's servos: it polls them and runs jobs for other threads.

Polling never pauses, whatever the rest of the program does, also while the arm moves: a fault is
detected within a few polls and latched. Polling also feeds the servos' bus watchdog.

Every poll reads torque, operating mode, bus watchdog, hardware error and goals of every servo, and
compares them with what was commanded (``servo_state``).

Source: our notes on the SDK: two threads on one port get error -1000; a sync read drops the alert
bit, hence single reads and register 70.
"""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeoutError
from dataclasses import dataclass, replace
from typing import TypeVar

from primitives.errors import RobotError, TorqueOffError
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.errors import BusError, BusFault
from tacgrasp.drivers.dynamixel.servo_state import STATE_LENGTH, ServoCommand, ServoSample
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.scheduling import request_priority

T = TypeVar("T")

CALL_S = 2.0
"""Longest wait for a job to begin, and again to end [s]. Our choice: twice a servo's patience."""

_NUM_WAITS = 4
_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True, kw_only=True)
class PollSample:
    """State of all servos at one poll; ``number`` counts the polls, ``at_s`` is its end [s]."""

    number: int
    at_s: float
    servos: Sequence[ServoSample]


class ServoPoller:
    """The I/O thread of one gripper. Starts polling at once.

    Attributes:
        fault: The latched fault; empty while there is none.
        is_limp: Whether a servo was without torque when it was latched.
        num_polls: Number of the last sample; 0 before the first.
    """

    def __init__(
        self, bus: Bus, settings: DynamixelSettings, commanded: Mapping[int, ServoCommand]
    ) -> None:
        """Start polling.

        Args:
            bus: The open bus; used by this thread alone from now on.
            settings: The gripper's section of the rig's file.
            commanded: What each servo was set to, by its id.
        """
        self._bus, self._settings, self._commanded = bus, settings, dict(commanded)
        self._unit_ma = reg.MODELS[settings.model].unit_ma
        self._began_s = time.monotonic()
        self._jobs: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._changed = threading.Condition()
        self.fault, self.is_limp = "", False
        self._sample: PollSample | None = None
        self.num_polls = 0
        self._closed = self._is_busy = False  # busy: a job or a poll is under way
        self._thread = threading.Thread(target=self._run, name="gripper", daemon=True)
        self._thread.start()

    def expect(self, servo: int, **registers: int) -> None:
        """Note what a job has just written to a servo; called by that job, on the I/O thread."""
        self._commanded[servo] = replace(self._commanded[servo], **registers)

    def error(self, otherwise: str = "") -> RobotError:
        """The latched fault as an error, or another message where there is none."""
        return (TorqueOffError if self.is_limp else RobotError)(self.fault or otherwise)

    def check_alive(self) -> str:
        """Return at once: why the last sample is too old to move by; empty while it is fresh.

        Raises:
            RobotError: The gripper has a fault; ``TorqueOffError`` where it has let go.
        """
        sample = self._sample
        if self.fault:
            raise self.error()
        age_s = time.monotonic() - (self._began_s if sample is None else sample.at_s)
        if age_s <= self._settings.stale_s:
            return ""
        message = f"the gripper's last whole reply is {1e3 * age_s:.0f} ms old"
        if not self._is_busy:  # nobody asks it, though a poll is due
            message += "; this computer was late to ask for one: end other work, and see "
            message += "tacgrasp doctor"
        return message

    def read_now(self) -> PollSample:
        """Poll at once, with every check of a poll.

        Raises:
            RobotError: As ``call``; or a servo is not as it was commanded, which is latched.
        """

        def poll(_: Bus) -> PollSample:
            self._poll()
            if self.fault or self._sample is None:
                raise self.error("the gripper gave no sample")
            return self._sample

        return self.call(poll)

    def call(self, job: Callable[[Bus], T], *, despite_fault: bool = False) -> T:
        """Run a job on the I/O thread and return its result.

        Raises:
            RobotError: The gripper has a fault (``TorqueOffError`` where it has let go), the job
                failed, or the thread does not answer; what has not begun by then never does.
        """
        result: Future[T] = Future()

        def run() -> None:
            if not result.set_running_or_notify_cancel():
                return
            if self.fault and not despite_fault:
                result.set_exception(self.error())
                return
            try:
                result.set_result(job(self._bus))
            except BaseException as error:
                result.set_exception(error)
                if isinstance(error, BusError) and error.kind is not BusFault.REFUSED:
                    self._latch_fault(f"{error}")

        if not self._thread.is_alive():
            raise self.error("the gripper is disconnected")
        self._jobs.put(run)
        try:
            try:
                return result.result(CALL_S)
            except FutureTimeoutError:
                if result.cancel():
                    raise
                return result.result(CALL_S)  # it has begun
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
                raise self.error("the gripper is disconnected")
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
        request_priority()
        period_s = self._settings.poll_ms / 1000
        due_s = time.monotonic()
        while True:
            try:
                job = self._jobs.get(timeout=max(0.0, due_s - time.monotonic()))
                if job is None:
                    return
                self._is_busy = True
                job()
            except queue.Empty:
                pass
            if time.monotonic() >= due_s:
                due_s = max(due_s + period_s, time.monotonic())
                if not self.fault:
                    self._is_busy = True
                    self._poll()
            self._is_busy = False

    def _poll(self) -> None:
        try:
            servos = [self._poll_servo(servo) for servo in self._settings.ids]
        except RobotError as error:
            self._latch_fault(f"{error}", is_limp=isinstance(error, TorqueOffError))
            return
        except Exception as error:
            _log.exception("the gripper's polling failed")
            self._latch_fault(f"the gripper's driver failed: {type(error).__name__}: {error}")
            return
        with self._changed:
            self.num_polls += 1
            now_s = time.monotonic()
            self._sample = PollSample(number=self.num_polls, at_s=now_s, servos=servos)
            self._changed.notify_all()

    def _poll_servo(self, servo: int) -> ServoSample:
        mode = self._bus.read(servo, reg.OPERATING_MODE, 1)
        reply = self._bus.read(servo, reg.TORQUE, STATE_LENGTH)
        sample = ServoSample.unpacked(mode.data[0], reply.data)
        if problem := sample.problem(
            servo,
            self._commanded[servo],
            alert=mode.alert or reply.alert,
            unit_ma=self._unit_ma,
        ):
            raise (RobotError if sample.torque else TorqueOffError)(problem)
        if sample.temperature_c > self._settings.max_temperature_c:
            raise RobotError(
                f"servo {servo} of the gripper is {sample.temperature_c} °C hot, beyond "
                f"{self._settings.max_temperature_c:g} °C; let it cool, and grip with less force "
                "or for less time"
            )
        return sample

    def _latch_fault(self, fault: str, *, is_limp: bool = False) -> None:
        with self._changed:
            if not self.fault:
                self.fault, self.is_limp = fault, is_limp
            self._changed.notify_all()
