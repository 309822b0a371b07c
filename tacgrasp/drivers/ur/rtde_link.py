"""ur_rtde as the UR arm's worker uses it: connect, set up, sample, move, stop; a False is an error.

What the library gets wrong is kept in here (each measured against 1.6.5): failures are False and
not exceptions; a dropped link shows in ``isConnected`` alone; getters return old values for ever;
``stopL`` is a joint-space stop until the first asynchronous one; its reconnect never recovers.
Not here: when to do what (``ur_worker``).
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from primitives.errors import RobotError
from tacgrasp.drivers.ur.preflight import safety_words
from tacgrasp.drivers.ur.settings import UrSettings

STILL_M_S = 1e-3
PLAYING = 2
RUNNING = 7
ZEROED_N = 5.0
"""Largest force that a sensor that was just zeroed at rest may say [N]."""

VARIABLES = [
    "timestamp", "actual_TCP_pose", "actual_TCP_speed", "actual_TCP_force", "robot_mode",
    "safety_mode", "safety_status_bits", "robot_status_bits", "runtime_state",
    "target_speed_fraction", "payload",
]  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class RtdeSample:
    """What the controller last sent, as the library holds it.

    Attributes:
        stamp_s: The controller's time of it [s].
        pose, speed, force: Of the TCP, six numbers each [m, rad; m/s, rad/s; N, N m].
        robot_mode, runtime_state, safety_bits: As RTDE numbers them.
        speed_fraction: The speed slider, 0 to 1.
    """

    stamp_s: float
    pose: tuple[float, ...]
    speed: tuple[float, ...]
    force: tuple[float, ...]
    robot_mode: int
    runtime_state: int
    safety_bits: int
    speed_fraction: float

    @property
    def speed_m_s(self) -> float:
        """Speed of the TCP [m/s]."""
        return math.hypot(*self.speed[:3])

    @property
    def force_n(self) -> float:
        """Size of the force on the tool [N]."""
        return math.hypot(*self.force[:3])

    def wrong(self) -> str:
        """What forbids to go on, '' when nothing.

        Protective and emergency flags alone would miss a safeguard stop: all safety bits count.
        """
        if words := safety_words(self.safety_bits):
            return f"the controller reports: {words}"
        if self.robot_mode != RUNNING:
            return f"the arm is not running (robot mode {self.robot_mode}, expected {RUNNING})"
        if self.runtime_state != PLAYING:
            return (
                f"the program on the controller does not run (runtime state {self.runtime_state}, "
                f"expected {PLAYING}): stopped or paused at the pendant, or by its watchdog"
            )
        return ""


class UrLink:
    """The library's two connections to one controller."""

    def __init__(
        self,
        settings: UrSettings,
        step: Callable[[str], None],
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        """Connect; may hang for ever on a controller that falls silent: the owner bounds it.

        Args:
            settings: Which controller.
            step: Told what is being done, so that the owner can say where a start hung.
            sleep: Lets time pass [s].

        Raises:
            RobotError: The controller refuses.
        """
        step("loading ur_rtde")
        import rtde_control
        import rtde_receive

        self._settings, self._sleep = settings, sleep
        rate_hz = settings.supervision_hz
        try:
            step("connecting to receive")
            self._receive: Any = rtde_receive.RTDEReceiveInterface(
                settings.host, rate_hz, VARIABLES
            )
            step("connecting to control: upload of the control script")
            self._control: Any = rtde_control.RTDEControlInterface(settings.host, rate_hz)
        except RuntimeError as error:
            raise RobotError(
                f"ur_rtde can't connect to {settings.host}: {error}. See tacgrasp doctor"
            ) from None

    def set_up(self, step: Callable[[str], None]) -> None:
        """Payload, TCP, zeroed force sensor, stop mode: all at rest, all read back.

        Raises:
            RobotError: Something was not taken as set, or the arm is not at rest.
        """
        settings, control = self._settings, self._control
        step("waiting for the program to run")
        self._until(lambda s: s.runtime_state == PLAYING, "the program does not start")
        self._until(lambda s: s.speed_m_s < STILL_M_S, "the arm is not at rest")
        if wrong := self.sample().wrong():
            raise RobotError(wrong)
        step("setting payload and TCP")
        tcp = [*settings.tcp_offset_m, *settings.tcp_offset_rad]
        _taken(control.setPayload(settings.payload_kg, list(settings.payload_cog_m)), "payload")
        _taken(control.setTcp(tcp), "TCP")
        got = control.getTCPOffset()
        if len(got) != 6 or any(abs(a - b) > 1e-6 for a, b in zip(got, tcp, strict=True)):
            raise RobotError(f"the controller took the TCP offset as {got}, not {tcp}")
        self._wait_for_payload()
        step("zeroing the force sensor")
        _taken(control.zeroFtSensor(), "zero of the force sensor")
        self._until(lambda s: s.force_n < ZEROED_N, "the force sensor does not come to zero")
        step("setting up stops")
        # Until the first asynchronous stop, stopL brakes in joint space; make it the straight one.
        self.stop()

    def arm_watchdog(self) -> None:
        """From now on the program ends unless it is kicked: rounds must begin at once.

        Raises:
            RobotError: The controller did not take it.
        """
        _taken(self._control.setWatchdog(self._settings.watchdog_hz), "watchdog")

    @property
    def connected(self) -> bool:
        """Both connections stand. The library's other calls go on saying True when they don't."""
        return bool(self._control.isConnected() and self._receive.isConnected())

    def sample(self) -> RtdeSample:
        """What the controller last sent; may be old: compare stamps."""
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
        """Number of the last asynchronous operation, and whether it still runs."""
        status = self._control.getAsyncOperationProgressEx()
        return status.operationId(), status.isAsyncOperationRunning()

    def move(self, pose: tuple[float, ...], speed_m_s: float, acceleration_m_s2: float) -> None:
        """Begin a straight move; asynchronous, since the other kind can't be stopped.

        Raises:
            RobotError: The library refused it.
        """
        begun = self._control.moveL(list(pose), speed_m_s, acceleration_m_s2, True)
        _taken(begun, "move")

    def stop(self) -> None:
        """Begin to brake on the present course; returns nothing that could be checked."""
        self._control.stopL(self._settings.stop_deceleration_m_s2, True)

    def kick(self) -> None:
        """Let the controller's watchdog know that we live.

        Raises:
            RobotError: The library could not send it, or it would hang: it waits for a program that
                has ended.
        """
        alive = self._control.isProgramRunning() and self._control.kickWatchdog()
        _taken(alive, "sign of life")

    def end(self) -> None:
        """End the program; the end of the process hangs up (``disconnect`` sleeps for 0.5 s)."""
        self._control.stopScript()

    def _wait_for_payload(self) -> None:
        wanted_kg = self._settings.payload_kg
        for _ in range(50):
            if abs(self._receive.getPayload() - wanted_kg) < 1e-6:
                return
            self._sleep(0.01)
        got_kg = self._receive.getPayload()
        raise RobotError(f"the controller took the payload as {got_kg} kg, not {wanted_kg} kg")

    def _until(self, true_of: Callable[[RtdeSample], bool], otherwise: str) -> None:
        for _ in range(100):
            if true_of(self.sample()):
                return
            self._sleep(0.01)
        raise RobotError(f"{otherwise} (waited 1 s)")


def _taken(answer: object, what: str) -> None:
    """The library's failures are False."""
    if answer is not True:
        raise RobotError(f"the controller did not take the {what}: ur_rtde said {answer!r}")
