"""An arm that is held while another device of its rig is silent, and stopped when one has failed.

A reading is stale after two of its device's periods and 20 ms. A moving arm is then stopped; it
goes on to the same target when readings are fresh again. Without a fresh reading within ``HOLD_S``,
the motion's own deadline, the move is a fault. Not here: faults of the arm itself, for which its
driver stops it.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence

from primitives.devices import Arm, Pose
from primitives.errors import RobotError
from tacgrasp.base.errors import error_text
from tacgrasp.drivers.scheduling import request_priority

POLL_S = 0.001
"""Interval of the checks of the other devices during a move [s]."""

HOLD_S = 1.0
"""Longest hold of a move [s]. Our choice: as long as a UR's move may take beyond its time."""

MAX_HOLDS = 30
"""Most holds of one move; a line that needs more is no line to move by. Our choice."""

Check = Callable[[], str]
"""Why a device's readings are too old to move by; empty while they are fresh. Raises ``RobotError``
or ``TouchError`` when the device has failed; costs next to nothing."""


class _DeviceError(Exception):
    """Another device of the rig has failed, or its check has."""


class GuardedArm:
    """A ``primitives.devices.Arm`` that moves only while the other devices give fresh readings.

    Args:
        arm: The arm.
        checks: Checks of the other devices.

    Attributes:
        num_holds: Number of holds since the start.
        last_hold_s: Time of the last hold, monotonic [s]; NaN before the first.
    """

    def __init__(self, arm: Arm, checks: Sequence[Check]) -> None:
        self._arm, self._checks = arm, checks
        self.pose = arm.pose  # passed through
        self.num_holds, self.last_hold_s = 0, float("nan")
        self._fault = self._stale = ""
        self._moving, self._ended = threading.Event(), threading.Event()
        self._cancelled = threading.Event()
        self._stopping = threading.Lock()  # no stop is sent for a move that has ended
        self._thread = threading.Thread(target=self._watch, name="guard", daemon=True)
        self._thread.start()

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move while no device has failed; hold while readings are stale.

        Raises:
            RobotError: Another device has failed, before the move (nothing is sent) or during it
                (the arm has been stopped); or as the arm raises it.
        """
        self._cancelled.clear()
        if fault := self._failure(self._wait_until_fresh()):
            raise RobotError(f"{fault}; the arm was not moved")
        for _ in range(MAX_HOLDS):
            reached = self._move(pose, speed_m_s, acceleration_m_s2)
            if reached is not None:
                return reached
            if fault := self._fault or self._failure(self._wait_until_fresh()):
                raise RobotError(f"{fault}; the arm was stopped")
        raise RobotError(
            f"the arm was held {MAX_HOLDS} times in one move, the last time because {self._stale}; "
            "the arm was stopped"
        )

    def stop(self) -> None:
        """Stop the arm; a move that is held does not go on."""
        self._cancelled.set()
        self._arm.stop()

    def disconnect(self) -> None:
        """Disconnect the arm and end the checks."""
        self._ended.set()
        self._moving.set()  # wakes the thread
        self._thread.join(timeout=2)
        self._arm.disconnect()

    def _move(self, pose: Pose, speed_m_s: float, acceleration_m_s2: float) -> Pose | None:
        """One try: the reached pose, or None when the arm was held or stopped on its way."""
        self._fault = self._stale = ""
        self._moving.set()
        try:
            return self._arm.move_to(pose, speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2)
        except RobotError:
            with self._stopping:  # a stop that is under way ends first
                if self._cancelled.is_set() or not (self._fault or self._stale):
                    raise
            return None
        finally:
            with self._stopping:
                self._moving.clear()

    def _wait_until_fresh(self) -> float:
        """Wait for fresh readings, at most ``HOLD_S``; returns the time waited [s]."""
        began_s = time.monotonic()
        while not self._cancelled.is_set() and time.monotonic() - began_s < HOLD_S:
            try:
                if not self._staleness():
                    break
            except _DeviceError:
                break
            time.sleep(POLL_S)
        return time.monotonic() - began_s

    def _watch(self) -> None:
        request_priority()
        while True:
            self._moving.wait()
            if self._ended.is_set():
                return
            fault, stale = "", ""
            try:
                stale = self._staleness()
            except _DeviceError as error:
                fault = str(error)
            with self._stopping:
                is_new = not (self._fault or self._stale)
                if (fault or stale) and is_new and self._moving.is_set():
                    self._fault, self._stale = fault, stale
                    if stale:
                        self.num_holds, self.last_hold_s = self.num_holds + 1, time.monotonic()
                    self._arm.stop()
            self._ended.wait(POLL_S)

    def _staleness(self) -> str:
        """Reason to hold; empty for none.

        Raises:
            _DeviceError: A check raised, be it what a plugin's may raise: anything.
        """
        try:
            return next(filter(None, (check() for check in self._checks)), "")
        except Exception as error:
            raise _DeviceError(error_text(error)) from error

    def _failure(self, waited_s: float) -> str:
        """Why the arm must not move, after a wait for fresh readings; empty for none."""
        if self._cancelled.is_set():
            return "the move was cut short by a stop"
        try:
            stale = self._staleness()
        except _DeviceError as error:
            return str(error)
        return f"{stale}; nothing newer came within {waited_s:.1f} s" if stale else ""
