"""Every command that a rig's devices were given: what was asked, what was sent, what was reached.

``Executed`` says it of a primitive; this of each command on the way, lift, shake and release
included, with what the driver put on the wire. A rig of real devices wraps its arm and gripper; the
episode takes the commands with its next record.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from primitives.devices import Arm, Gripper, GripperState, Pose

T = TypeVar("T")


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """One command to one device, seen from both sides.

    Attributes:
        device: arm or gripper.
        asked: What the program asked of the driver.
        sent: What the driver put on the wire for it, in the device's own words and units; '' when
            nothing was sent.
        reached: What was measured afterwards; '' when the command failed.
        error: Why it failed; '' when it did not.
        started_s, ended_s: On the rig's clock, monotonic [s].
    """

    device: str
    asked: str
    sent: str
    reached: str
    error: str
    started_s: float
    ended_s: float


class CommandLog:
    """Commands in order, until they are taken for the record."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._lock = threading.Lock()
        self._commands: list[Command] = []

    def take(self) -> tuple[Command, ...]:
        """All commands since the last time, oldest first."""
        with self._lock:
            taken, self._commands = tuple(self._commands), []
        return taken

    def during(
        self,
        device: str,
        asked: str,
        command: Callable[[], T],
        *,
        reached: Callable[[T], str],
        sent: Callable[[], str],
    ) -> T:
        """Carry out a command and note it, also when it fails."""
        started, answer, error = self._clock(), "", ""
        try:
            result = command()
            answer = reached(result)
        except BaseException as failure:
            error = str(failure) or type(failure).__name__
            raise
        finally:
            noted = Command(
                device=device,
                asked=asked,
                sent=sent(),
                reached=answer,
                error=error,
                started_s=started,
                ended_s=self._clock(),
            )
            with self._lock:
                self._commands.append(noted)
        return result


class LoggedArm:
    """An arm whose commands are noted; a ``primitives.devices.Arm``."""

    def __init__(self, arm: Arm, log: CommandLog, sent: Callable[[], str]) -> None:
        """Wrap an arm; ``sent`` tells what its driver last put on the wire."""
        self._arm, self._log, self._sent = arm, log, sent

    def pose(self) -> Pose:
        """As the arm says."""
        return self._arm.pose()

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move, and note it."""
        return self._log.during(
            "arm",
            f"move to {pose_words(pose)} at {speed_m_s:g} m/s, {acceleration_m_s2:g} m/s²",
            lambda: self._arm.move_to(
                pose, speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2
            ),
            reached=pose_words,
            sent=self._sent,
        )

    def stop(self) -> None:
        """Stop, and note it."""
        self._log.during("arm", "stop", self._arm.stop, reached=lambda _: "", sent=self._sent)

    def disconnect(self) -> None:
        """As the arm does."""
        self._arm.disconnect()


class LoggedGripper:
    """A gripper whose commands are noted; a ``primitives.devices.Gripper``."""

    def __init__(self, gripper: Gripper, log: CommandLog, sent: Callable[[], str]) -> None:
        """Wrap a gripper; ``sent`` tells what its driver last put on the wire."""
        self._gripper, self._log, self._sent = gripper, log, sent

    def state(self) -> GripperState:
        """As the gripper says."""
        return self._gripper.state()

    def grip(self, force_n: float) -> GripperState:
        """Close, and note it."""
        return self._noted(f"grip with {force_n:.4g} N", lambda: self._gripper.grip(force_n))

    def open_by(self, clear_m: float) -> GripperState:
        """Open, and note it."""
        asked = f"open by {1000 * clear_m:.4g} mm"
        return self._noted(asked, lambda: self._gripper.open_by(clear_m))

    def stop(self) -> None:
        """Stop, and note it."""
        self._log.during(
            "gripper", "stop", self._gripper.stop, reached=lambda _: "", sent=self._sent
        )

    def disconnect(self) -> None:
        """As the gripper does."""
        self._gripper.disconnect()

    def _noted(self, asked: str, command: Callable[[], GripperState]) -> GripperState:
        return self._log.during("gripper", asked, command, reached=_state_words, sent=self._sent)


def pose_words(pose: Pose) -> str:
    """A pose in numbers: position [m] and rotation vector [rad], base frame."""
    x, y, z = pose.position_m
    rx, ry, rz = pose.rotvec_rad
    return f"({x:.5f}, {y:.5f}, {z:.5f}) m, ({rx:.4f}, {ry:.4f}, {rz:.4f}) rad"


def _state_words(state: GripperState) -> str:
    shut = "closed" if state.closed else "open"
    return f"{shut}, {1000 * state.width_m:.3f} mm, {state.force_n:.4g} N commanded"
