"""Supervision rounds of a UR arm, and the commands in between: the inside of its worker.

The first fault is raised; ``worker`` brakes the arm and ends the process. The watchdog signal and
the supervision share one thread on purpose: if it hangs, the controller's watchdog stops the arm.
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
from tacgrasp.drivers.ur.rtde_link import DROPPED, REST_M_S, RtdeSample, UrLink
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

MAX_DATA_AGE_S = 0.03
"""With older data the library's stop would only hang [s]."""

UNREAD_S = 0.2
"""Largest age of data while newer ones wait to be read by the library's thread [s]."""

SETTLE_S = 0.3
"""Longest time from the end of a move to rest on its target [s]."""

STOP_S = 0.6
LIBRARY_STOP_S = 0.06
"""Longest wait for the library's own stop before the arm is stopped from outside [s]."""

REASON_WAIT_S = 0.02
"""Longest wait for data of the controller that explain a refused signal [s]."""

PAUSE_PART = 0.5
"""Part of the watchdog's time from which a pause of this computer is named as a possible cause of a
program that has ended. Our choice: the signal takes its way, and the controller its turn."""

PAUSE_REMEMBERED_S = 0.5
"""Time for which a pause is remembered [s]. The first signal after it still goes out, and the data
that tell of the ended program come later. Our choice: several rounds and the data's own delay."""

MOTION_POLL_S = 0.001
"""Interval between looks at the data until a commanded motion starts [s]."""


class OwnerGoneError(Exception):
    """The owner's process has vanished, or has sent the command to end."""


@dataclass(slots=True)
class ActiveCommand:
    """The running move or stop.

    Attributes:
        number: Number of its command.
        target: Target of a move; None for a stop.
        operation: The library's last operation before it.
        until_s: Latest end.
        ended_s: Time at which the controller reported the end of the operation.
        num_still: Samples in a row in which a stop was at rest.
        sent_s: Time of the command; None once the motion has started, or without any motion.
    """

    number: int
    target: tuple[float, ...] | None
    operation: int
    until_s: float
    ended_s: float | None = None
    num_still: int = 0
    sent_s: float | None = None


class Supervisor:
    """Supervision and commands on a link that is set up."""

    def __init__(
        self, settings: UrSettings, link: UrLink, block: SharedStateBlock, commands_fd: int
    ) -> None:
        self._settings, self._link, self._block = settings, link, block
        self._commands_fd = commands_fd
        self.state = WorkerState()
        self._unread = b""
        self._sample = link.sample()
        self._data_s = self._kicked_s = time.monotonic()
        self._pause_s, self._paused_s = 0.0, self._kicked_s  # the longest of late, and its end
        self._active: ActiveCommand | None = None

    def run(self) -> NoReturn:
        """Supervise and carry out commands until a fault or the end.

        Raises:
            RobotError: The fault to latch.
            OwnerGoneError: The owner has vanished, or has sent the command to end.
        """
        period_s = 1.0 / self._settings.supervision_hz
        due_s = time.monotonic()
        previous_s: float | None = None
        while True:
            now_s = time.monotonic()
            if previous_s is not None:
                self._block.count(PERIOD, now_s - previous_s)
            if now_s - due_s > period_s:  # this process was paused: nobody looked for data
                self._data_s += now_s - due_s
            previous_s = now_s
            self._round(now_s)
            due_s = max(due_s + period_s, now_s)
            self._wait_until_due(due_s)

    def _round(self, now_s: float) -> None:
        if not self._link.connected:
            raise RobotError(DROPPED)
        self._read_sample(now_s)
        stale_s, limit_s = now_s - self._data_s, self._settings.stale_ms / 1e3
        if stale_s > UNREAD_S or (stale_s > limit_s and not self._link.has_unread()):
            raise RobotError(f"no new data from the controller for {1e3 * stale_s:.0f} ms")
        if problem := self._sample.problem():
            raise RobotError(f"{problem}{self._own_pause(self._sample, now_s)}")
        force_n, limit_n = self._sample.force_n, self._settings.max_contact_force_n
        if self._active is not None and force_n > limit_n:
            raise RobotError(
                f"contact force {force_n:.1f} N is beyond max_contact_force_n {limit_n:g} N in "
                "motion: free the tool before the arm is reset"
            )
        self._kick()
        if self._active is not None:
            self._track(self._active, now_s)
        self.publish(now_s)

    def _own_pause(self, sample: RtdeSample, now_s: float) -> str:
        """Remark on a pause of this computer that may have ended the program by its watchdog."""
        self._note_pause(now_s)
        pause_ms, limit_ms = 1e3 * self._pause_s, 1e3 / self._settings.watchdog_hz
        if not sample.has_ended or pause_ms < PAUSE_PART * limit_ms:
            return ""
        return (
            f"; this computer paused for {pause_ms:.0f} ms, and the watchdog allows "
            f"{limit_ms:.0f}: end other work, and see tacgrasp doctor"
        )

    def _note_pause(self, now_s: float) -> None:
        """Remember the time since the last signal, if it is the longest of late."""
        pause_s = now_s - self._kicked_s
        if pause_s >= self._pause_s or now_s - self._paused_s > PAUSE_REMEMBERED_S:
            self._pause_s, self._paused_s = pause_s, now_s

    def _kick(self) -> None:
        try:
            self._link.kick()
            now_s = time.monotonic()
            self._note_pause(now_s)
            self._kicked_s = now_s
        except RobotError:
            # The library has the fault before its data: wait a moment for their explanation.
            until_s = time.monotonic() + REASON_WAIT_S
            while time.monotonic() < until_s and self._link.connected:
                sample = self._link.sample()
                if problem := sample.problem():
                    remark = self._own_pause(sample, time.monotonic())
                    raise RobotError(f"{problem}{remark}") from None
                time.sleep(0.002)
            if not self._link.connected:
                raise RobotError(DROPPED) from None
            raise

    def publish(self, now_s: float) -> None:
        state, sample = self.state, self._sample
        state.beat_s, state.data_s = now_s, self._data_s
        state.pose, state.speed, state.force = sample.pose, sample.speed, sample.force
        state.speed_fraction = sample.speed_fraction
        self._block.write(state)

    def _read_sample(self, now_s: float) -> None:
        sample = self._link.sample()
        if sample.stamp_s != self._sample.stamp_s:
            self._data_s = now_s
        self._sample = sample

    def _wait_until_due(self, due_s: float) -> None:
        """Carry out commands, and watch for the start of a motion, until the next round."""
        while (remaining_s := due_s - time.monotonic()) > 0:
            active = self._active
            starting = active is not None and active.sent_s is not None
            timeout_s = min(remaining_s, MOTION_POLL_S) if starting else remaining_s
            ready, _, _ = select.select([self._commands_fd], [], [], timeout_s)
            if ready:
                self._read_commands()
            elif starting and active is not None:
                self._count_motion_start(active)

    def _read_commands(self) -> None:
        data = os.read(self._commands_fd, 65536)
        if not data:
            raise OwnerGoneError("its owner has vanished")
        self._unread += data
        while len(self._unread) >= COMMAND_BYTES:
            command = CommandRecord.unpacked(self._unread[:COMMAND_BYTES])
            self._unread = self._unread[COMMAND_BYTES:]
            if command.kind is ArmCommand.MOVE:
                self._move(command)
            elif command.kind is ArmCommand.STOP:
                self._stop(command)
            else:
                raise OwnerGoneError("ended by a command")

    def _move(self, command: CommandRecord) -> None:
        self._read_sample(time.monotonic())
        reason = refusal(command, self._sample.pose, self._settings)
        if self._active is not None:
            reason = "a move is under way: stop it first"
        if reason:
            self._finish(command.number, CommandOutcome.REFUSED, reason)
            return
        duration_s = expected_duration_s(command, self._sample.pose)
        duration_s /= max(0.01, self._sample.speed_fraction)
        has_motion = distance_m(command.pose, self._sample.pose) > 1e-3
        operation = self._link.operation()[0]
        until_s = time.monotonic() + duration_s + self._settings.move_margin_s
        self._active = ActiveCommand(command.number, command.pose, operation, until_s)
        self._active.sent_s = command.sent_s if has_motion else None
        self._link.move(command.pose, command.speed_m_s, command.acceleration_m_s2)

    def _stop(self, command: CommandRecord) -> None:
        operation = self._link.operation()[0]
        self._active = ActiveCommand(command.number, None, operation, time.monotonic() + STOP_S)
        self._link.stop()

    def _count_motion_start(self, active: ActiveCommand) -> None:
        if active.sent_s is not None:
            now_s = time.monotonic()
            self._read_sample(now_s)
            if self._sample.speed_m_s > REST_M_S:
                self._block.count(MOTION, now_s - active.sent_s)
                active.sent_s = None

    def _track(self, active: ActiveCommand, now_s: float) -> None:
        self._count_motion_start(active)
        operation, running = self._link.operation()
        if active.ended_s is None and operation != active.operation and not running:
            active.ended_s = now_s
        at_rest = self._sample.speed_m_s < REST_M_S
        if active.target is None:
            active.num_still = active.num_still + 1 if at_rest else 0
            if active.num_still >= 3:
                self._finish(active.number, CommandOutcome.DONE)
                return
        elif active.ended_s is not None:
            offset_mm = 1e3 * distance_m(active.target, self._sample.pose)
            if at_rest and offset_mm <= self._settings.reach_tolerance_mm:
                self._finish(active.number, CommandOutcome.DONE)
                return
            if now_s - active.ended_s > SETTLE_S:
                raise RobotError(f"the move ended {offset_mm:.2f} mm from its target")
        if now_s > active.until_s:
            name = "stop" if active.target is None else "move"
            raise RobotError(
                f"the {name} has not ended in time; the speed slider is at "
                f"{self._sample.speed_fraction:.0%}"
            )

    def _finish(self, number: int, outcome: CommandOutcome, text: str = "") -> None:
        self._active = None if outcome is not CommandOutcome.REFUSED else self._active
        self.state.done, self.state.outcome, self.state.text = number, outcome, text
        self.publish(time.monotonic())

    def brake(self) -> str:
        """Stop the arm by the library, if its link stands; returns the method, empty for none."""
        data_age_s = time.monotonic() - self._data_s
        if not self._link.connected or self._sample.problem() or data_age_s > MAX_DATA_AGE_S:
            return ""
        if not returned_within(LIBRARY_STOP_S, self._link.stop):  # it hangs: stop from outside
            return ""
        braking_s = self._sample.speed_m_s / self._settings.stop_deceleration_m_s2
        until_s = time.monotonic() + braking_s + LIBRARY_STOP_S
        while time.monotonic() < until_s and not self._is_at_rest():
            time.sleep(0.004)
        return "stopL"

    def _is_at_rest(self) -> bool:
        try:
            return self._link.sample().speed_m_s <= REST_M_S
        except RobotError:  # not finite: nobody knows
            return False


def returned_within(seconds: float, call: Callable[[], None]) -> bool:
    """Run a call of the library that may hang; returns whether it returned in time."""
    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    thread.join(seconds)
    return not thread.is_alive()
