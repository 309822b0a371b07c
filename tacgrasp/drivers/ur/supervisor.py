"""Rounds of supervision of a UR arm, and the orders in between: the inside of its worker.

The first thing wrong is raised; what becomes of the arm and of the process then is ``ur_worker``'s.
Sign of life and supervision share one thread on purpose: if that hangs, the controller's watchdog
stops the arm.
"""

from __future__ import annotations

import os
import select
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import NoReturn

from primitives.errors import RobotError
from tacgrasp.drivers.ur.motion_limits import distance_m, expected_duration_s, refusal
from tacgrasp.drivers.ur.rtde_link import STILL_M_S, UrLink
from tacgrasp.drivers.ur.settings import UrSettings
from tacgrasp.drivers.ur.shared_state import (
    COMMAND_BYTES,
    MOTION,
    PERIOD,
    ArmCommand,
    CommandOutcome,
    CommandRecord,
    SharedStateBlock,
    WorkerState,
)

OLD_S = 0.03
"""With data older than this the library's stop would only hang [s]."""

SETTLE_S = 0.3
"""After its end a move may take this long to be at rest on its target [s]."""

STOP_S = 0.6
LIBRARY_STOP_S = 0.06
"""Longest wait for the library's own stop before the arm is stopped from outside [s]."""

WHY_S = 0.02
"""Longest wait for the controller's data to explain a refusal [s]."""

NOTICE_S = 0.001
"""How often the data is looked at until a commanded motion shows [s]."""


class OwnerGoneError(Exception):
    """The process that gave the orders has vanished, or told this one to end."""


@dataclass(slots=True, kw_only=True)
class ActiveCommand:
    """The move or stop under way.

    Attributes:
        number: Of its order.
        target: Where a move ends; None for a stop.
        operation: The library's last operation before it.
        until_s: When it must have ended.
        ended_s: When the controller said that the operation was over.
        still: Samples in a row in which a stop was still.
        sent_s: When it was ordered; None once the motion was seen, or when there is none to see.
    """

    number: int
    target: tuple[float, ...] | None
    operation: int
    until_s: float
    ended_s: float | None = None
    still: int = 0
    sent_s: float | None = None


class Supervisor:
    """Supervision and orders around a link that is set up."""

    def __init__(
        self,
        settings: UrSettings,
        link: UrLink,
        block: SharedStateBlock,
        orders_fd: int,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._settings, self._link, self._block = settings, link, block
        self._orders_fd, self._clock = orders_fd, clock
        self.state = WorkerState()
        self._unread = b""
        self._sample = link.sample()
        self._data_s = clock()
        self._job: ActiveCommand | None = None

    def run(self) -> NoReturn:
        """Rounds and orders until something ends it.

        Raises:
            RobotError: The fault to latch.
            OwnerGoneError: No one is left to work for.
        """
        period_s = 1.0 / self._settings.supervision_hz
        due_s = self._clock()
        before_s: float | None = None
        while True:
            now_s = self._clock()
            if before_s is not None:
                self._block.count(PERIOD, now_s - before_s)
            before_s = now_s
            self._round(now_s)
            due_s = max(due_s + period_s, now_s)
            self._listen_until(due_s)

    def _round(self, now_s: float) -> None:
        if not self._link.connected:
            raise RobotError("the link to the controller dropped")
        self._look(now_s)
        stale_s = now_s - self._data_s
        if stale_s > self._settings.stale_ms / 1e3:
            raise RobotError(f"no new data from the controller for {1e3 * stale_s:.0f} ms")
        if wrong := self._sample.wrong():
            raise RobotError(wrong)
        force_n, most_n = self._sample.force_n, self._settings.max_contact_force_n
        if self._job is not None and force_n > most_n:
            raise RobotError(
                f"contact force {force_n:.1f} N is beyond max_contact_force_n {most_n:g} N in "
                "motion: free the tool before the arm is reset"
            )
        self._kick()
        if self._job is not None:
            self._follow(self._job, now_s)
        self.publish(now_s)

    def _kick(self) -> None:
        try:
            self._link.kick()
        except RobotError:
            # The library noticed before its data did; they will say why in a moment.
            until_s = self._clock() + WHY_S
            while self._clock() < until_s and self._link.connected:
                if wrong := self._link.sample().wrong():
                    raise RobotError(wrong) from None
                time.sleep(0.002)
            raise

    def publish(self, now_s: float) -> None:
        """Let the owner see the present state."""
        state, sample = self.state, self._sample
        state.beat_s, state.data_s = now_s, self._data_s
        state.pose, state.speed, state.force = sample.pose, sample.speed, sample.force
        state.speed_fraction = sample.speed_fraction
        self._block.write(state)

    def _look(self, now_s: float) -> None:
        sample = self._link.sample()
        if sample.stamp_s != self._sample.stamp_s:
            self._data_s = now_s
        self._sample = sample

    # -- orders ----------------------------------------------------------------------------------

    def _listen_until(self, due_s: float) -> None:
        while (left_s := due_s - self._clock()) > 0:
            noticing = self._job is not None and self._job.sent_s is not None
            ready, _, _ = select.select(
                [self._orders_fd], [], [], min(left_s, NOTICE_S) if noticing else left_s
            )
            if ready:
                self._read_orders()
            elif noticing and self._job is not None:
                self._notice(self._job)

    def _read_orders(self) -> None:
        data = os.read(self._orders_fd, 65536)
        if not data:
            raise OwnerGoneError("its owner has vanished")
        self._unread += data
        while len(self._unread) >= COMMAND_BYTES:
            order = CommandRecord.unpacked(self._unread[:COMMAND_BYTES])
            self._unread = self._unread[COMMAND_BYTES:]
            if order.order is ArmCommand.MOVE:
                self._move(order)
            elif order.order is ArmCommand.STOP:
                self._stop(order)
            else:
                raise OwnerGoneError("told to end")

    def _move(self, order: CommandRecord) -> None:
        self._look(self._clock())
        why = refusal(order, self._sample.pose, self._settings)
        if self._job is not None:
            why = "a move is under way: stop it first"
        if why:
            self._finish(order.number, CommandOutcome.REFUSED, why)
            return
        seconds = expected_duration_s(order, self._sample.pose) / max(
            0.01, self._sample.speed_fraction
        )
        far = distance_m(order.pose, self._sample.pose) > 1e-3
        self._job = ActiveCommand(
            number=order.number,
            target=order.pose,
            operation=self._link.operation()[0],
            until_s=self._clock() + seconds + self._settings.move_margin_s,
            sent_s=order.sent_s if far else None,
        )
        self._link.move(order.pose, order.speed_m_s, order.acceleration_m_s2)

    def _stop(self, order: CommandRecord) -> None:
        self._job = ActiveCommand(
            number=order.number,
            target=None,
            operation=self._link.operation()[0],
            until_s=self._clock() + STOP_S,
        )
        self._link.stop()

    def _notice(self, job: ActiveCommand) -> None:
        if job.sent_s is not None:
            now_s = self._clock()
            self._look(now_s)
            if self._sample.speed_m_s > STILL_M_S:
                self._block.count(MOTION, now_s - job.sent_s)
                job.sent_s = None

    def _follow(self, job: ActiveCommand, now_s: float) -> None:
        self._notice(job)
        operation, running = self._link.operation()
        if job.ended_s is None and operation != job.operation and not running:
            job.ended_s = now_s
        resting = self._sample.speed_m_s < STILL_M_S
        if job.target is None:
            job.still = job.still + 1 if resting else 0
            if job.still >= 3:
                self._finish(job.number, CommandOutcome.DONE)
                return
        elif job.ended_s is not None:
            off_mm = 1e3 * distance_m(job.target, self._sample.pose)
            if resting and off_mm <= self._settings.reach_tolerance_mm:
                self._finish(job.number, CommandOutcome.DONE)
                return
            if now_s - job.ended_s > SETTLE_S:
                raise RobotError(f"the move ended {off_mm:.2f} mm from its target")
        if now_s > job.until_s:
            what = "stop" if job.target is None else "move"
            raise RobotError(
                f"the {what} has not ended in time; the speed slider is at "
                f"{self._sample.speed_fraction:.0%}"
            )

    def _finish(self, number: int, outcome: CommandOutcome, text: str = "") -> None:
        self._job = None if outcome is not CommandOutcome.REFUSED else self._job
        self.state.done, self.state.outcome, self.state.text = number, outcome, text
        self.publish(self._clock())

    # -- ends ------------------------------------------------------------------------------------

    def brake(self) -> str:
        """Stop the arm by the library, if its link stands; what was done."""
        old_s = self._clock() - self._data_s
        if not self._link.connected or self._sample.wrong() or old_s > OLD_S:
            return ""
        if not within(LIBRARY_STOP_S, self._link.stop):  # it hangs: then the other ways must do
            return ""
        takes_s = self._sample.speed_m_s / self._settings.stop_deceleration_m_s2
        until_s = self._clock() + takes_s + LIBRARY_STOP_S
        while self._clock() < until_s and self._link.sample().speed_m_s > STILL_M_S:
            time.sleep(0.004)
        return "stopL"


def within(seconds: float, call: Callable[[], None]) -> bool:
    """Let a call of the library run that may hang; whether it returned in time."""
    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    thread.join(seconds)
    return not thread.is_alive()
