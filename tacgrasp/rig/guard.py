"""An arm that is stopped when another device of its rig fails while it moves.

The drivers detect their own faults; this polls them every few milliseconds during a move. Not
here: faults of the arm itself, for which its driver stops it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence

from cltp.errors import TouchError
from primitives.devices import Arm, Pose
from primitives.errors import RobotError

POLL_S = 0.005
"""Interval of the checks of the other devices during a move [s]."""

Check = Callable[[], None]
"""Raises ``RobotError`` or ``TouchError`` when a device has failed; costs next to nothing."""


class GuardedArm:
    """A ``primitives.devices.Arm`` that does not move on while another device has failed.

    Args:
        arm: The arm.
        checks: Checks of the other devices.
    """

    def __init__(self, arm: Arm, checks: Sequence[Check]) -> None:
        self._arm, self._checks = arm, checks
        self.pose, self.stop = arm.pose, arm.stop  # passed through
        self._fault = ""
        self._moving, self._ended = threading.Event(), threading.Event()
        self._stopping = threading.Lock()  # no stop is sent for a move that has ended
        self._thread = threading.Thread(target=self._watch, name="guard", daemon=True)
        self._thread.start()

    def is_moving(self) -> bool:
        """Whether a move is under way; costs nothing."""
        return self._moving.is_set()

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move while no device has failed.

        Raises:
            RobotError: Another device has failed, before the move (nothing is sent) or during it
                (the arm has been stopped); or as the arm raises it.
        """
        if fault := self._failure():
            raise RobotError(f"{fault}; the arm was not moved")
        self._fault = ""
        self._moving.set()
        try:
            reached = self._arm.move_to(
                pose, speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2
            )
        except RobotError:
            if not self._fault:
                raise
        finally:
            with self._stopping:
                self._moving.clear()
        if self._fault:
            raise RobotError(f"{self._fault}; the arm was stopped")
        return reached

    def disconnect(self) -> None:
        """Disconnect the arm and end the checks."""
        self._ended.set()
        self._moving.set()  # wakes the thread
        self._thread.join(timeout=2)
        self._arm.disconnect()

    def _watch(self) -> None:
        while True:
            self._moving.wait()
            if self._ended.is_set():
                return
            fault = self._failure()
            with self._stopping:
                if fault and not self._fault and self._moving.is_set():
                    self._fault = fault
                    self._arm.stop()
            self._ended.wait(POLL_S)

    def _failure(self) -> str:
        for check in self._checks:
            try:
                check()
            except (RobotError, TouchError) as error:
                return str(error)
        return ""
