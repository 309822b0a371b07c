"""A UR arm as a ``primitives.devices.Arm``: orders to its worker, faults latched.

``connect_arm`` looks at the controller (``ur_preflight``), starts a worker (``ur_worker``) and
gives it orders. A fault is latched: after it every call but ``stop`` and ``disconnect`` raises with
the same explanation, until an operator calls ``reset``, which starts a new worker. Nothing here
reconnects by itself, and no answer is older than the worker's last round.
"""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from primitives.devices import Pose
from primitives.errors import LimitError, RobotError
from tacgrasp.drivers.ur.dashboard import CONFIRMED, Dashboard, stop_from_outside
from tacgrasp.drivers.ur.motion_limits import expected_duration_s, nearest_rotvec, refusal
from tacgrasp.drivers.ur.preflight import check, preflight
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
from tacgrasp.drivers.ur.worker_process import LOOK_S, WorkerProcess

__all__ = ["ArmTiming", "UrArm", "check", "connect_arm"]

log = logging.getLogger(__name__)

HUNG_S = 0.25
"""A worker whose rounds have stopped for so long hangs [s]; the watchdog has stopped the arm."""

STOP_S = 1.0
END_S = 2.0
REACT_S = 2.0
"""Longest time that a move may take beyond what the worker itself allows [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmTiming:
    """How regularly the arm is supervised, and how soon it moves, since the last (re)start.

    Attributes:
        period: Time between two rounds of supervision; 8 ms is meant at 125 Hz.
        command_to_motion: From an order to the first data that show a speed above 1 mm/s.
    """

    period: Distribution
    command_to_motion: Distribution


def connect_arm(settings: UrSettings) -> UrArm:
    """Check the controller, start the worker, and wait until the arm is under supervision.

    Raises:
        RobotError: The arm is not ready; what was found and what to do. Nothing has moved.
    """
    arm = UrArm(settings)
    arm.start()
    return arm


class UrArm:
    """A UR arm; see ``primitives.devices.Arm`` for the contract of each method.

    Attributes:
        sent: What the last command put on the wire, in the controller's words; '' for nothing.
    """

    def __init__(
        self,
        settings: UrSettings,
        *,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        """Start nothing yet; see ``connect_arm``. The clock must be that of the worker."""
        self.settings = settings
        self._clock, self._sleep = clock, sleep
        self._lock = threading.RLock()
        self._worker: WorkerProcess | None = None
        self._fault = "the UR arm is not connected"
        self._unsafe = False
        self._number = 0
        self._rotvec: tuple[float, ...] = (math.pi, 0.0, 0.0)
        self.sent = ""

    @property
    def fault(self) -> str:
        """The latched fault, '' while all is well."""
        return self._fault

    # -- Arm -------------------------------------------------------------------------------------

    def pose(self) -> Pose:
        """The measured pose of the TCP, not older than a round of supervision."""
        return self._as_pose(self._state())

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move on a straight line; returns the pose reached, at rest and within tolerance."""
        self.sent, state = "", self._state()
        order = self._order(
            ArmCommand.MOVE,
            (*pose.position_m.tolist(), *pose.rotvec_rad.tolist()),
            float(speed_m_s),
            float(acceleration_m_s2),
        )
        if why := refusal(order, state.pose, self.settings):
            raise LimitError(why)
        self._send(order)
        takes_s = expected_duration_s(order, state.pose) / max(0.01, state.speed_fraction)
        longest_s = takes_s + self.settings.move_margin_s + REACT_S
        state = self._await(order.number, longest_s)
        if state.done != order.number:
            raise RobotError("the move was cut short by a stop")
        if state.outcome == CommandOutcome.REFUSED:
            raise LimitError(state.text)
        self._rotvec = tuple(pose.rotvec_rad.tolist())
        return self._as_pose(state)

    def stop(self) -> None:
        """Bring the arm to rest; from outside where the worker can't. Never raises."""
        self.sent = ""
        try:
            if self._fault:
                self._make_safe()
                return
            order = self._order(ArmCommand.STOP)
            self._send(order)
            self._await(order.number, STOP_S)
        except Exception as error:
            # whatever it is: stopping the arm by another way matters more
            log.warning("UR stop: %s", error)
            self._make_safe()

    def disconnect(self) -> None:
        """Stop, end the program and the worker. Idempotent, never raises."""
        with self._lock:
            owner = self._worker
            if owner is None:
                return
            try:
                if not self._fault:
                    self._send(self._order(ArmCommand.END))
                    owner.wait(END_S)
            except Exception as error:
                log.warning("UR disconnect: %s", error)
            if not owner.ended_well:
                self._unsafe = self._unsafe or not self._fault
                self._make_safe()
            owner.close()
            self._worker = None
            self._fault = self._fault or "the UR arm is disconnected"

    # -- operator --------------------------------------------------------------------------------

    def reset(self, *, unlock_protective_stop: bool = False) -> None:
        """Start anew after a fault. Only on an operator's word, who has looked at the arm.

        Args:
            unlock_protective_stop: Also release a protective stop (the controller wants at least
                five seconds between the stop and this).

        Raises:
            RobotError: The arm is not ready.
        """
        self.disconnect()
        if unlock_protective_stop:
            with Dashboard(self.settings.host) as dashboard:
                log.info("UR: %s", dashboard.ask("unlock protective stop"))
        self.start()

    def start(self) -> None:
        """Check the controller and start the worker; once, or after ``disconnect``.

        Raises:
            RobotError: The arm is not ready, or connected already.
        """
        with self._lock:
            if self._worker is not None:
                raise RobotError("the UR arm is connected already: disconnect or reset it")
            preflight(self.settings)
            self._unsafe = True  # whatever program is found on the controller from here on is ours
            self._number, self._worker = 0, WorkerProcess(self.settings)
            try:
                self._worker.await_ready(self._clock, self._sleep)
                self._fault, self._unsafe = "", False
                self._check_place()
            except BaseException:
                self.disconnect()
                raise

    def timing(self) -> ArmTiming:
        """How regular the supervision was, and how soon motion followed a command.

        Raises:
            RobotError: The arm is not connected.
        """
        with self._lock:
            if self._worker is None:
                raise RobotError("the UR arm is not connected")
            return ArmTiming(
                period=self._worker.distribution(PERIOD),
                command_to_motion=self._worker.distribution(MOTION),
            )

    # -- orders and state ------------------------------------------------------------------------

    def _order(
        self,
        order: ArmCommand,
        pose: tuple[float, ...] = (0.0,) * 6,
        speed_m_s: float = 0.0,
        acceleration_m_s2: float = 0.0,
    ) -> CommandRecord:
        with self._lock:
            self._number += 1
            return CommandRecord(
                order=order, number=self._number, sent_s=self._clock(), pose=pose,
                speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2,
            )  # fmt: skip

    def _send(self, order: CommandRecord) -> None:
        owner = self._connected()
        try:
            owner.send(order)
            self.sent = _in_words(order, self.settings)
        except OSError as error:
            self._state()  # says why, if the worker could
            self._latch(f"the UR arm's worker takes no orders any more ({error})")

    def _await(self, number: int, longest_s: float) -> WorkerState:
        """Wait until an order (or a later one) has ended."""
        until_s = self._clock() + longest_s
        while True:
            state = self._state()
            if state.done >= number:
                return state
            if self._clock() > until_s:
                self._latch(
                    f"the UR arm's worker has not carried out an order in {longest_s:.1f} s"
                )
            self._sleep(LOOK_S)

    def _connected(self) -> WorkerProcess:
        owner = self._worker
        if owner is None or self._fault:
            raise RobotError(self._fault or "the UR arm is not connected")
        return owner

    def _state(self) -> WorkerState:
        """The worker's state, if it lives and all is well; latches what is not."""
        owner = self._connected()
        # Asked first: what an ended worker left is complete; a pause of ours is none of its.
        ended, now_s = owner.has_ended, self._clock()
        state = owner.read()
        if state.phase != WorkerPhase.READY:
            owner.wait(HUNG_S)  # it brakes the arm now, and will say how
            self._latch(owner.read().text)
        if ended:
            self._latch(owner.last_said(state))
        silent_s = now_s - state.beat_s
        if silent_s > HUNG_S:
            self._latch(f"supervision of the UR arm has hung for {1e3 * silent_s:.0f} ms")
        return state

    def _check_place(self) -> None:
        """The TCP must start inside the workspace, or every move back in would begin outside."""
        state = self._connected().read()
        here = CommandRecord(order=ArmCommand.MOVE, number=0, sent_s=0.0, pose=state.pose,
                           speed_m_s=self.settings.max_speed_m_s,
                           acceleration_m_s2=self.settings.max_acceleration_m_s2)  # fmt: skip
        if why := refusal(here, state.pose, self.settings):
            raise LimitError(f"the arm starts where it may not be: {why}. Jog it at the pendant")

    def _latch(self, why: str) -> None:
        """Latch a fault, stop the arm by whatever way is left, and raise it."""
        with self._lock:
            if not self._fault:
                advice = "Look at the arm, clear the cause, then reset it."
                self._fault, self._unsafe = f"UR arm: {why}. {advice}", True
                log.error("%s", self._fault)
        self._make_safe()
        raise RobotError(self._fault)

    def _make_safe(self) -> None:
        """After a fault: end the worker, and tell the controller to stop, until that was heard."""
        with self._lock:
            if not self._unsafe:
                return
            if self._worker is not None:
                self._worker.wait(HUNG_S)  # it brakes the arm itself
                self._worker.kill()
            how = stop_from_outside(self.settings.host, self.settings.stop_deceleration_m_s2)
            self._unsafe = how != CONFIRMED
            log.warning("UR arm after a fault: %s", how or "no way to reach the controller is left")

    def _as_pose(self, state: WorkerState) -> Pose:
        rotvec = nearest_rotvec(state.pose[3:], self._rotvec)
        return Pose(position_m=np.array(state.pose[:3]), rotvec_rad=np.array(rotvec))


def _in_words(order: CommandRecord, settings: UrSettings) -> str:
    """What the worker tells the controller for an order."""
    if order.order == ArmCommand.MOVE:
        pose = ", ".join(f"{value:.6f}" for value in order.pose)
        return f"moveL([{pose}], {order.speed_m_s:g}, {order.acceleration_m_s2:g}, asynchronous)"
    return (
        f"stopL({settings.stop_deceleration_m_s2:g})" if order.order == ArmCommand.STOP else "end"
    )
