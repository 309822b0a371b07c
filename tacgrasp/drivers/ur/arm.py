"""A UR arm as a ``primitives.devices.Arm``: commands to its worker process, faults latched.

``connect_arm`` checks the controller (``preflight``), starts a worker (``worker``) and sends it
commands. A fault is latched: after it every call but ``stop`` and ``disconnect`` raises with the
same explanation, until an operator calls ``reset``, which starts a new worker. Nothing here
reconnects by itself, and no returned state is older than the worker's last round.
"""

from __future__ import annotations

import logging
import math
import threading
import time
from contextlib import closing
from dataclasses import dataclass

import numpy as np

from primitives.devices import Pose
from primitives.errors import LimitError, RobotError
from tacgrasp.drivers.ur.dashboard import CONFIRMED, Dashboard, stop_from_outside
from tacgrasp.drivers.ur.motion_limits import expected_duration_s, nearest_rotvec, refusal
from tacgrasp.drivers.ur.preflight import preflight
from tacgrasp.drivers.ur.settings import UrSettings
from tacgrasp.drivers.ur.shared_state import (
    MOTION,
    PERIOD,
    ArmCommand,
    CommandOutcome,
    CommandRecord,
    Distribution,
    WorkerPhase,
    WorkerState,
)
from tacgrasp.drivers.ur.worker_process import POLL_S, WorkerProcess

log = logging.getLogger(__name__)

HANG_S = 0.12
"""Longest time without a round of a live worker [s]; longer than any watchdog of the controller, so
that the arm is stopped by then."""

BRAKE_S = 0.25
"""Longest wait for a worker that brakes the arm itself [s]."""

NOTICE_S = 0.04
"""Longest wait for the method of the worker's stop before its fault is raised [s]."""

STOP_S = 1.0
END_S = 2.0
REACTION_S = 2.0
"""Longest time that a move may take beyond the worker's own time limit [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmTiming:
    """Regularity of the supervision and delay of the motion, since the last (re)start.

    Attributes:
        period: Time between two rounds of supervision; 8 ms at the nominal 125 Hz.
        command_to_motion: Time from a command to the first data with a speed above 1 mm/s.
    """

    period: Distribution
    command_to_motion: Distribution


def connect_arm(settings: UrSettings) -> UrArm:
    """Check the controller, start the worker, and wait until the arm is under supervision.

    Raises:
        RobotError: The arm is not ready; nothing has moved.
    """
    arm = UrArm(settings)
    arm.start()
    return arm


class UrArm:
    """A UR arm; see ``primitives.devices.Arm`` for the contract of each method.

    Attributes:
        sent: The last command on the wire, in the controller's words; empty for none.
    """

    def __init__(self, settings: UrSettings) -> None:
        """Start nothing yet; see ``connect_arm``."""
        self.settings = settings
        self._lock = threading.RLock()
        self._worker: WorkerProcess | None = None
        self._fault = "the UR arm is not connected"
        self._unsafe = False
        self._number = 0
        self._rotvec: tuple[float, ...] = (math.pi, 0.0, 0.0)
        self.sent = ""

    @property
    def fault(self) -> str:
        return self._fault

    def pose(self) -> Pose:
        return self._as_pose(self._state())

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        self.sent, state = "", self._state()
        command = self._new_command(
            ArmCommand.MOVE,
            (*pose.position_m.tolist(), *pose.rotvec_rad.tolist()),
            float(speed_m_s),
            float(acceleration_m_s2),
        )
        if reason := refusal(command, state.pose, self.settings):
            raise LimitError(reason)
        self._send(command)
        duration_s = expected_duration_s(command, state.pose) / max(0.01, state.speed_fraction)
        timeout_s = duration_s + self.settings.move_margin_s + REACTION_S
        state = self._wait_for(command.number, timeout_s)
        if state.done != command.number:
            raise RobotError("the move was cut short by a stop")
        if state.outcome == CommandOutcome.REFUSED:
            raise LimitError(state.text)
        self._rotvec = tuple(pose.rotvec_rad.tolist())
        return self._as_pose(state)

    def stop(self) -> None:
        self.sent = ""
        try:
            if self._fault:
                self._make_safe()
                return
            command = self._new_command(ArmCommand.STOP)
            self._send(command)
            self._wait_for(command.number, STOP_S)
        except Exception as error:
            # any error: it matters more to stop the arm by another method
            log.warning("UR stop: %s", error)
            self._make_safe()

    def disconnect(self) -> None:
        with self._lock:
            worker = self._worker
            if worker is None:
                return
            try:
                if not self._fault:
                    self._send(self._new_command(ArmCommand.END))
                    worker.wait(END_S)
            except Exception as error:
                log.warning("UR disconnect: %s", error)
            if not worker.exited_cleanly:
                self._unsafe = self._unsafe or not self._fault
                self._make_safe()
            worker.close()
            self._worker = None
            self._fault = self._fault or "the UR arm is disconnected"

    def reset(self, *, unlock_protective_stop: bool = False) -> None:
        """Start again after a fault; only for an operator who has looked at the arm.

        Args:
            unlock_protective_stop: Also release a protective stop (the controller requires at least
                five seconds between the stop and the release).

        Raises:
            RobotError: The arm is not ready.
        """
        self.disconnect()
        if unlock_protective_stop:
            with closing(Dashboard(self.settings.host)) as dashboard:
                log.info("UR: %s", dashboard.ask("unlock protective stop"))
        self.start()

    def start(self) -> None:
        """Check the controller and start the worker; once, or after ``disconnect``.

        Raises:
            RobotError: The arm is not ready, or is already connected.
        """
        with self._lock:
            if self._worker is not None:
                raise RobotError("the UR arm is connected already: disconnect or reset it")
            preflight(self.settings)
            self._unsafe = True  # from here on a program on the controller is ours
            self._number, self._worker = 0, WorkerProcess(self.settings)
            try:
                self._worker.await_ready()
                self._fault, self._unsafe = "", False
                self._check_start_position()
            except BaseException:
                self.disconnect()
                raise

    def timing(self) -> ArmTiming:
        """Regularity of the supervision, and delay from commands to motion.

        Raises:
            RobotError: The arm is not connected.
        """
        with self._lock:
            if self._worker is None:
                raise RobotError("the UR arm is not connected")
            return ArmTiming(
                period=self._worker.block.distribution(PERIOD),
                command_to_motion=self._worker.block.distribution(MOTION),
            )

    def _new_command(
        self,
        kind: ArmCommand,
        pose: tuple[float, ...] = (0.0,) * 6,
        speed_m_s: float = 0.0,
        acceleration_m_s2: float = 0.0,
    ) -> CommandRecord:
        with self._lock:
            self._number += 1
            return CommandRecord(
                kind, self._number, time.monotonic(), pose, speed_m_s, acceleration_m_s2
            )

    def _send(self, command: CommandRecord) -> None:
        worker = self._connected()
        try:
            worker.send(command)
            self.sent = _command_text(command, self.settings)
        except OSError as error:
            self._state()  # raises the worker's fault, if it has published one
            self._latch(f"the UR arm's worker takes no commands any more ({error})")

    def _wait_for(self, number: int, timeout_s: float) -> WorkerState:
        """Wait until a command (or a later one) has ended."""
        until_s = time.monotonic() + timeout_s
        while True:
            state = self._state()
            if state.done >= number:
                return state
            if time.monotonic() > until_s:
                self._latch(
                    f"the UR arm's worker has not carried out a command in {timeout_s:.1f} s"
                )
            time.sleep(POLL_S)

    def _connected(self) -> WorkerProcess:
        worker = self._worker
        if worker is None or self._fault:
            raise RobotError(self._fault or "the UR arm is not connected")
        return worker

    def _state(self) -> WorkerState:
        """State of a live worker without a fault; latches any fault."""
        worker = self._connected()
        # Before reading: the state of an ended worker is final, and a pause here is not counted.
        ended, now_s = worker.has_ended, time.monotonic()
        state = worker.read()
        if state.phase != WorkerPhase.READY:
            worker.wait(NOTICE_S)  # the worker brakes the arm now, and publishes the method
            self._latch(worker.read().text)
        if ended:
            self._latch(worker.exit_message(state))
        silent_s = now_s - state.beat_s
        if silent_s > HANG_S:
            self._latch(f"supervision of the UR arm has hung for {1e3 * silent_s:.0f} ms")
        return state

    def _check_start_position(self) -> None:
        """The TCP must start inside the workspace, or every move back would begin outside."""
        state, settings = self._connected().read(), self.settings
        limits = (settings.max_speed_m_s, settings.max_acceleration_m_s2)
        stay = CommandRecord(ArmCommand.MOVE, 0, 0.0, state.pose, *limits)
        if reason := refusal(stay, state.pose, self.settings):
            raise LimitError(f"the arm starts where it may not be: {reason}. Jog it at the pendant")

    def _latch(self, reason: str) -> None:
        """Latch a fault and raise it; meanwhile stop the arm by any method that is left.

        A dead link makes stopping slow, and nobody should learn of the fault so late. ``stop``
        waits for it.
        """
        with self._lock:
            if not self._fault:
                advice = "Look at the arm, clear the cause, then reset it."
                self._fault, self._unsafe = f"UR arm: {reason}. {advice}", True
                log.error("%s", self._fault)
                threading.Thread(target=self._make_safe, name="ur stop", daemon=True).start()
        raise RobotError(self._fault)

    def _make_safe(self) -> None:
        """After a fault: end the worker and stop the arm from outside, until that is confirmed."""
        with self._lock:
            if not self._unsafe:
                return
            if self._worker is not None:
                self._worker.wait(BRAKE_S)  # the worker brakes the arm itself
                self._worker.kill()
            method = stop_from_outside(self.settings.host, self.settings.stop_deceleration_m_s2)
            self._unsafe = method != CONFIRMED
            log.warning("UR arm after a fault: %s", method or "the controller can't be reached")

    def _as_pose(self, state: WorkerState) -> Pose:
        rotvec = nearest_rotvec(state.pose[3:], self._rotvec)
        return Pose(position_m=np.array(state.pose[:3]), rotvec_rad=np.array(rotvec))


def _command_text(command: CommandRecord, settings: UrSettings) -> str:
    """The command of the worker to the controller, for records."""
    if command.kind == ArmCommand.MOVE:
        pose = ", ".join(f"{value:.6f}" for value in command.pose)
        limits = f"{command.speed_m_s:g}, {command.acceleration_m_s2:g}"
        return f"moveL([{pose}], {limits}, asynchronous)"
    is_stop = command.kind == ArmCommand.STOP
    return f"stopL({settings.stop_deceleration_m_s2:g})" if is_stop else "end"
