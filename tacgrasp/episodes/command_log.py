"""Log of every command to a rig's devices: as requested, as sent, and the measured result.

``Executed`` holds the same for a whole primitive; this log has each command within it, lift, shake
and release included, with the driver's own words on the wire. A rig of real devices wraps its arm
and gripper; the episode takes the commands with its next record.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

from primitives.devices import AdjustableGripper, Arm, Gripper, GripperState, Pose

T = TypeVar("T")


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """One command to one device.

    Attributes:
        device: arm or gripper.
        asked: The program's request to the driver.
        sent: The driver's message on the wire, in the device's own words and units; '' when nothing
            was sent.
        reached: Measurement afterwards; '' when the command failed.
        error: Error of the command; '' when it succeeded.
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
        """All commands since the last call, oldest first."""
        with self._lock:
            commands, self._commands = tuple(self._commands), []
        return commands

    def run(
        self,
        device: str,
        request: str,
        command: Callable[[], T],
        *,
        sent: Callable[[], str],
        reached: Callable[[T], str] = lambda _: "",
    ) -> T:
        """Run a command and log it, also when it fails."""
        started_s, measured, error = self._clock(), "", ""
        try:
            result = command()
            measured = reached(result)
        except BaseException as failure:
            error = str(failure) or type(failure).__name__
            raise
        finally:
            entry = Command(
                device=device,
                asked=request,
                sent=sent(),
                reached=measured,
                error=error,
                started_s=started_s,
                ended_s=self._clock(),
            )
            with self._lock:
                self._commands.append(entry)
        return result


class LoggedArm:
    """An arm whose commands are logged; ``sent`` returns its driver's last message on the wire."""

    def __init__(self, arm: Arm, log: CommandLog, sent: Callable[[], str]) -> None:
        self._arm, self._log, self._sent = arm, log, sent
        self.pose, self.disconnect = arm.pose, arm.disconnect  # passed through

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        limits = {"speed_m_s": speed_m_s, "acceleration_m_s2": acceleration_m_s2}
        return self._log.run(
            "arm",
            f"move to {pose_text(pose)} at {speed_m_s:g} m/s, {acceleration_m_s2:g} m/s²",
            lambda: self._arm.move_to(pose, **limits),
            sent=self._sent,
            reached=pose_text,
        )

    def stop(self) -> None:
        self._log.run("arm", "stop", self._arm.stop, sent=self._sent)


class LoggedGripper:
    """A gripper whose commands are logged; a ``primitives.devices.Gripper``.

    It has ``adjust`` where the gripper is an ``AdjustableGripper``.
    """

    def __init__(self, gripper: Gripper, log: CommandLog, sent: Callable[[], str]) -> None:
        self._gripper, self._log, self._sent = gripper, log, sent
        if isinstance(gripper, AdjustableGripper):
            self.adjust = partial(self._adjust, gripper)
        self.state, self.disconnect = gripper.state, gripper.disconnect  # passed through

    def grip(self, force_n: float) -> GripperState:
        return self._run(f"grip with {force_n:.4g} N", lambda: self._gripper.grip(force_n))

    def _adjust(self, gripper: AdjustableGripper, force_n: float) -> GripperState:
        return self._run(f"adjust to {force_n:.4g} N", lambda: gripper.adjust(force_n))

    def open_by(self, clear_m: float) -> GripperState:
        request = f"open by {1000 * clear_m:.4g} mm"
        return self._run(request, lambda: self._gripper.open_by(clear_m))

    def stop(self) -> None:
        self._log.run("gripper", "stop", self._gripper.stop, sent=self._sent)

    def _run(self, request: str, command: Callable[[], GripperState]) -> GripperState:
        return self._log.run("gripper", request, command, sent=self._sent, reached=_state_text)


def pose_text(pose: Pose) -> str:
    """A pose in numbers: position [m] and rotation vector [rad], base frame."""
    x, y, z = pose.position_m
    rx, ry, rz = pose.rotvec_rad
    return f"({x:.5f}, {y:.5f}, {z:.5f}) m, ({rx:.4f}, {ry:.4f}, {rz:.4f}) rad"


def _state_text(state: GripperState) -> str:
    fingers = "closed" if state.closed else "open"
    return f"{fingers}, {1000 * state.width_m:.3f} mm, {state.force_n:.4g} N commanded"
