"""An arm that is stopped when another device of its rig fails while it moves.

The drivers notice their own faults; this looks at them every few milliseconds during a move. Not
here: faults of the arm itself, which its driver stops for.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence

from cltp.errors import TouchError
from primitives.devices import Arm, Pose
from primitives.errors import RobotError

LOOK_S = 0.005
"""How often the other devices are looked at during a move [s]."""

Look = Callable[[], None]
"""Raises ``RobotError`` or ``TouchError`` when a device is not well; costs next to nothing."""


class GuardedArm:
    """A ``primitives.devices.Arm`` that does not move on while another device has failed."""

    def __init__(self, arm: Arm, looks: Sequence[Look]) -> None:
        """Guard an arm; ``looks`` are the other devices'."""
        self._arm, self._looks = arm, looks
        self._why = ""
        self._moving, self._ended = threading.Event(), threading.Event()
        self._deciding = threading.Lock()  # no stop is sent for a move that has ended
        self._thread = threading.Thread(target=self._watch, name="guard", daemon=True)
        self._thread.start()

    def moves(self) -> bool:
        """Whether a move is under way; costs nothing."""
        return self._moving.is_set()

    def pose(self) -> Pose:
        """As the arm says."""
        return self._arm.pose()

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move while all devices are well.

        Raises:
            RobotError: Another device has failed, before the move (nothing is sent) or during it
                (the arm has been stopped); or as the arm says.
        """
        if why := self._trouble():
            raise RobotError(f"{why}; the arm was not moved")
        self._why = ""
        self._moving.set()
        try:
            reached = self._arm.move_to(
                pose, speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2
            )
        except RobotError:
            if self._why:
                raise RobotError(f"{self._why}; the arm was stopped") from None
            raise
        finally:
            with self._deciding:
                self._moving.clear()
        if self._why:
            raise RobotError(f"{self._why}; the arm was stopped")
        return reached

    def stop(self) -> None:
        """As the arm does."""
        self._arm.stop()

    def disconnect(self) -> None:
        """As the arm does, and watch no more."""
        self._ended.set()
        self._moving.set()  # wakes the thread
        self._thread.join(timeout=2)
        self._arm.disconnect()

    def _watch(self) -> None:
        while True:
            self._moving.wait()
            if self._ended.is_set():
                return
            why = self._trouble()
            with self._deciding:
                if why and not self._why and self._moving.is_set():
                    self._why = why
                    self._arm.stop()
            self._ended.wait(LOOK_S)

    def _trouble(self) -> str:
        for look in self._looks:
            try:
                look()
            except (RobotError, TouchError) as error:
                return str(error)
        return ""
