"""The worker's use of ur_rtde: connect, set up, sample, move, stop; a returned False is an error.

This module hides the library's pitfalls (each measured with 1.6.5): failures are False instead of
exceptions; a dropped link shows in ``isConnected`` alone; getters return old values for ever;
``stopL`` is a joint-space stop until the first asynchronous one; its reconnect never recovers.
Not here: the sequence of calls (``supervisor``).
"""

from __future__ import annotations

import fcntl
import math
import os
import socket
import termios
import time
from array import array
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from primitives.errors import RobotError
from tacgrasp.drivers.ur.dashboard import RTDE_PORT
from tacgrasp.drivers.ur.preflight import safety_text
from tacgrasp.drivers.ur.settings import UrSettings

REST_M_S = 1e-3
PLAYING = 2
RUNNING = 7
ZEROED_N = 5.0
"""Largest force of a sensor just zeroed at rest [N]."""

DROPPED = "the link to the controller dropped"

VARIABLES = [
    "timestamp", "actual_TCP_pose", "actual_TCP_speed", "actual_TCP_force", "robot_mode",
    "safety_mode", "safety_status_bits", "robot_status_bits", "runtime_state",
    "target_speed_fraction", "payload",
]  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class RtdeSample:
    """The controller's last data, as the library holds them.

    Attributes:
        stamp_s: The controller's time of the data [s].
        pose, speed, force: Of the TCP, six numbers each [m, rad; m/s, rad/s; N, N m].
        robot_mode, runtime_state, safety_bits: In RTDE's numbering.
        speed_fraction: Position of the speed slider, 0 to 1.

    Raises:
        RobotError: A number is not finite: no comparison with a limit would notice.
    """

    stamp_s: float
    pose: tuple[float, ...]
    speed: tuple[float, ...]
    force: tuple[float, ...]
    robot_mode: int
    runtime_state: int
    safety_bits: int
    speed_fraction: float

    def __post_init__(self) -> None:
        single = (self.stamp_s, self.speed_fraction)
        for name, unit, numbers in (
            ("pose", "m, rad", self.pose),
            ("speed", "m/s, rad/s", self.speed),
            ("force", "N, N m", self.force),
            ("time and speed slider", "s, 0 to 1", single),
        ):
            if not all(map(math.isfinite, numbers)):
                raise RobotError(
                    f"the controller reports a {name} that is not finite: {list(numbers)} "
                    f"({unit}); a sensor or its cable is damaged: see the controller's log, and "
                    "restart it"
                )

    @property
    def speed_m_s(self) -> float:
        return math.hypot(*self.speed[:3])

    @property
    def force_n(self) -> float:
        """Magnitude of the force on the tool [N]."""
        return math.hypot(*self.force[:3])

    @property
    def has_ended(self) -> bool:
        """Whether the program has ended or paused by itself, by its watchdog or at the pendant."""
        is_well = not safety_text(self.safety_bits) and self.robot_mode == RUNNING
        return is_well and self.runtime_state != PLAYING

    def problem(self) -> str:
        """Reason to stop; empty for none.

        All safety bits count: protective and emergency flags alone would miss a safeguard stop.
        """
        if text := safety_text(self.safety_bits):
            return f"the controller reports: {text}"
        if self.robot_mode != RUNNING:
            return f"the arm is not running (robot mode {self.robot_mode}, expected {RUNNING})"
        if self.has_ended:
            return (
                f"the program on the controller does not run (runtime state {self.runtime_state}, "
                f"expected {PLAYING}): stopped or paused at the pendant, or by its watchdog"
            )
        return ""


class UrLink:
    """The library's two connections to one controller."""

    def __init__(self, settings: UrSettings, report_step: Callable[[str], None]) -> None:
        """Connect; may hang for ever on a silent controller: the owner bounds the wait.

        Args:
            settings: The arm's section of the rig's file.
            report_step: Called with each step, so that the owner can name the one that hangs.

        Raises:
            RobotError: The controller refuses.
        """
        report_step("loading ur_rtde")
        import rtde_control
        import rtde_receive

        self._settings = settings
        rate_hz = settings.supervision_hz
        try:
            report_step("connecting to receive")
            self._receive: Any = rtde_receive.RTDEReceiveInterface(
                settings.host, rate_hz, VARIABLES
            )
            report_step("connecting to control: upload of the control script")
            self._control: Any = rtde_control.RTDEControlInterface(settings.host, rate_hz)
        except RuntimeError as error:
            raise RobotError(
                f"ur_rtde can't connect to {settings.host}: {error}. See tacgrasp doctor"
            ) from None
        self._sockets = _sockets_to(RTDE_PORT)

    def set_up(self, report_step: Callable[[str], None]) -> None:
        """Set payload, TCP, zero of the force sensor and stop mode, at rest, and read them back.

        Raises:
            RobotError: The controller did not accept a value, or the arm is not at rest.
        """
        settings, control = self._settings, self._control
        report_step("waiting for the program to run")
        self._wait_until(lambda s: s.runtime_state == PLAYING, "the program does not start")
        self._wait_until(lambda s: s.speed_m_s < REST_M_S, "the arm is not at rest")
        if problem := self.sample().problem():
            raise RobotError(problem)
        report_step("setting payload and TCP")
        tcp = [*settings.tcp_offset_m, *settings.tcp_offset_rad]
        cog_m = list(settings.payload_cog_m)
        _check_accepted(control.setPayload(settings.payload_kg, cog_m), "payload")
        _check_accepted(control.setTcp(tcp), "TCP")
        offset = control.getTCPOffset()
        if len(offset) != 6 or not all(
            abs(a - b) <= 1e-6 for a, b in zip(offset, tcp, strict=True)
        ):
            raise RobotError(f"the controller took the TCP offset as {offset}, not {tcp}")
        self._wait_for_payload()
        report_step("zeroing the force sensor")
        _check_accepted(control.zeroFtSensor(), "zero of the force sensor")
        self._wait_until(lambda s: s.force_n < ZEROED_N, "the force sensor does not come to zero")
        report_step("setting up stops")
        # The first asynchronous stop switches stopL from joint space to a straight line.
        self.stop()

    def arm_watchdog(self, least_hz: float) -> None:
        """Arm the watchdog: from now on the program ends unless ``kick`` is called so often [Hz].

        Raises:
            RobotError: The controller did not accept it.
        """
        _check_accepted(self._control.setWatchdog(least_hz), "watchdog")

    @property
    def connected(self) -> bool:
        """Whether both connections stand; the library's other calls return True even if not."""
        return bool(self._control.isConnected() and self._receive.isConnected())

    def has_unread(self) -> bool:
        """Whether data of the controller wait to be read: then this computer is late, not it."""
        waiting = array("i", [0])
        for connection in self._sockets:
            with suppress(OSError):
                fcntl.ioctl(connection.fileno(), termios.FIONREAD, waiting)
                if waiting[0] > 0:
                    return True
        return False

    def sample(self) -> RtdeSample:
        """The controller's last data; may be old: compare stamps.

        Raises:
            RobotError: A number is not finite.
        """
        receive = self._receive
        return RtdeSample(
            stamp_s=receive.getTimestamp(),
            pose=tuple(receive.getActualTCPPose()),
            speed=tuple(receive.getActualTCPSpeed()),
            force=tuple(receive.getActualTCPForce()),
            robot_mode=receive.getRobotMode(),
            runtime_state=receive.getRuntimeState(),
            safety_bits=receive.getSafetyStatusBits(),
            speed_fraction=receive.getTargetSpeedFraction(),
        )

    def operation(self) -> tuple[int, bool]:
        """Number of the last asynchronous operation, and whether it is running."""
        with _told_of_a_drop():
            status = self._control.getAsyncOperationProgressEx()
        return status.operationId(), status.isAsyncOperationRunning()

    def move(self, pose: tuple[float, ...], speed_m_s: float, acceleration_m_s2: float) -> None:
        """Begin a straight move; asynchronous, since a synchronous one can't be stopped.

        Raises:
            RobotError: The library refused it.
        """
        with _told_of_a_drop():
            accepted = self._control.moveL(list(pose), speed_m_s, acceleration_m_s2, True)
        _check_accepted(accepted, "move")

    def stop(self) -> None:
        """Begin to brake on the present course; the library returns no result to check."""
        with _told_of_a_drop():
            self._control.stopL(self._settings.stop_deceleration_m_s2, True)

    def kick(self) -> None:
        """Send the signal that the controller's watchdog expects.

        Raises:
            RobotError: The library could not send it, or would hang, waiting for an ended program.
        """
        with _told_of_a_drop():
            alive = self._control.isProgramRunning() and self._control.kickWatchdog()
        _check_accepted(alive, "sign of life")

    def end(self) -> None:
        """End the program; the end of the process disconnects (``disconnect`` sleeps for 0.5 s)."""
        self._control.stopScript()

    def _wait_for_payload(self) -> None:
        set_kg = self._settings.payload_kg
        for _ in range(50):
            if abs(self._receive.getPayload() - set_kg) < 1e-6:
                return
            time.sleep(0.01)
        read_kg = self._receive.getPayload()
        raise RobotError(f"the controller took the payload as {read_kg} kg, not {set_kg} kg")

    def _wait_until(self, condition: Callable[[RtdeSample], bool], failure: str) -> None:
        for _ in range(100):
            if condition(self.sample()):
                return
            time.sleep(0.01)
        raise RobotError(f"{failure} (waited 1 s)")


def _sockets_to(port: int) -> list[socket.socket]:
    """Duplicates of this process's connections to a port; the library shows none of its own."""
    sockets = []
    for path in Path("/proc/self/fd").iterdir():
        try:
            found = socket.socket(fileno=os.dup(int(path.name)))
        except OSError:  # closed by now, or no socket
            continue
        try:
            is_sought = found.getpeername()[1] == port
        except (OSError, IndexError):  # not connected, or of another family
            is_sought = False
        if is_sought:
            sockets.append(found)
        else:
            found.close()
    return sockets


@contextmanager
def _told_of_a_drop() -> Iterator[None]:
    """Name what the library raises as it tries to connect anew: the link dropped under a call."""
    try:
        yield
    except RuntimeError as error:
        raise RobotError(f"{DROPPED}; ur_rtde said: {error}") from None


def _check_accepted(result: object, name: str) -> None:
    if result is not True:
        raise RobotError(f"the controller did not take the {name}: ur_rtde said {result!r}")
