"""One turn of the loop: feel, ask, record; and the bounds on turns that come to nothing.

Not here: what is done about a decision (``tacgrasp.loop``).
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from cltp import TouchError
from cltp.tactile.cloud import Stamp, TactileCloud
from policies import Decision, Policy, PolicyError
from primitives.devices import GripperState, Pose
from primitives.execution import Executed
from tacgrasp.config.schema import LoopConfig
from tacgrasp.episodes.record import EpisodeEnd, Phase, TickRecord
from tacgrasp.rig.factory import commands_of
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import EndOfEpisode, EndReason, Observer


class Recorder(Protocol):
    """Where an episode is recorded (``tacgrasp.episodes.EpisodeWriter``)."""

    def write_tick(self, record: TickRecord) -> None:
        """Write one turn durably."""
        ...

    def finish(self, end: EpisodeEnd) -> None:
        """Write how it ended."""
        ...


class NoRecorder:
    """Records nothing: benchmarks that keep only their figures."""

    def write_tick(self, record: TickRecord) -> None:
        """Nothing."""

    def finish(self, end: EpisodeEnd) -> None:
        """Nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Touch:
    cloud: TactileCloud
    tcp_pose: Pose
    gripper: GripperState
    stamp: Stamp
    began_s: float
    phase: Phase
    decision: Decision | None = None


class Turns:
    """The turns of one episode.

    Attributes:
        count: Turns recorded so far.
        began_s: Monotonic time at which the episode began [s].
    """

    def __init__(
        self, rig: Rig, bounds: LoopConfig, recorder: Recorder, observers: Sequence[Observer]
    ) -> None:
        self._rig, self._bounds = rig, bounds
        self._recorder, self._observers = recorder, observers
        self.count = 0
        self.began_s = rig.clock.monotonic()
        self._blanks = 0
        self._touch: _Touch | None = None
        self._notes: list[str] = []

    @property
    def elapsed_s(self) -> float:
        """Time since the episode began [s]."""
        return self._rig.clock.monotonic() - self.began_s

    def check_time(self) -> None:
        """End the episode when its time is over.

        Raises:
            EndOfEpisode: ``timeout``.
        """
        if self.elapsed_s > self._bounds.timeout_s:
            raise EndOfEpisode(
                EndReason.TIMEOUT,
                f"{self.elapsed_s:.0f} s without a good grasp (loop.timeout_s is "
                f"{self._bounds.timeout_s:g})",
            )

    def feel_and_ask(self, policy: Policy, instruction: str) -> Decision:
        """Read the gel and ask the policy; after an error hold still and try again, boundedly.

        Raises:
            TouchError: The sensor failed ``max_faults`` times in a row.
            PolicyError: The policy did.
            RobotError: Pose or gripper can't be read.
        """
        for attempt in range(1, self._bounds.max_faults + 1):
            try:
                touch = self._read(Phase.TICK)
                decision = policy.decide(touch.cloud, instruction)
            except (TouchError, PolicyError) as error:
                self._survive(error, attempt)
                continue
            self._touch = replace(touch, decision=decision)
            return decision
        raise RuntimeError("max_faults must be at least 1")

    def feel(self, phase: Phase) -> TactileCloud:
        """Read and record a touch of the verification, with the same patience.

        Raises:
            TouchError: The sensor failed ``max_faults`` times in a row.
            RobotError: Pose or gripper can't be read.
            EpisodeError: It can't be recorded.
        """
        for attempt in range(1, self._bounds.max_faults + 1):
            try:
                self._touch = self._read(phase)
            except TouchError as error:
                self._survive(error, attempt)
                continue
            cloud = self._touch.cloud
            self.record(executed=None)
            return cloud
        raise RuntimeError("max_faults must be at least 1")

    def record(self, executed: Executed | None, note: str = "") -> None:
        """Record the touch in hand with what was done about it, then tell the observers.

        Raises:
            EpisodeError: It can't be recorded: the run must end.
        """
        touch, self._touch = self._touch, None
        if touch is None:
            return
        record = TickRecord(
            index=self.count,
            phase=touch.phase,
            cloud=touch.cloud,
            decision=touch.decision,
            executed=executed,
            tcp_pose=touch.tcp_pose,
            gripper=touch.gripper,
            stamp=touch.stamp,
            tick_ms=1000 * (time.perf_counter() - touch.began_s),
            note="; ".join([*self._notes, *([note] if note else [])]),
            commands=commands_of(self._rig),
        )
        self._notes = []
        self._recorder.write_tick(record)
        self.count += 1
        if touch.decision is not None and touch.decision.action is not None:
            self._blanks = 0
        for observer in self._observers:
            observer(record)

    def count_blank(self, decision: Decision) -> None:
        """Hold still after a text without one clear action; the caller asks again.

        Raises:
            EndOfEpisode: ``no_action``: it was the last of ``max_asks`` in a row.
        """
        self._blanks += 1
        if self._blanks >= self._bounds.max_asks:
            raise EndOfEpisode(
                EndReason.NO_ACTION,
                f"{self._blanks} texts in a row named no single action ({decision.reason}); "
                f"the last was: {decision.text!r}",
            )
        self._rig.clock.sleep(self._bounds.wait_s)

    def _read(self, phase: Phase) -> _Touch:
        stamp, began_s = self._rig.clock.stamp(), time.perf_counter()
        return _Touch(
            cloud=self._rig.sensor.read(),
            tcp_pose=self._rig.arm.pose(),
            gripper=self._rig.gripper.state(),
            stamp=stamp,
            began_s=began_s,
            phase=phase,
        )

    def _survive(self, error: TouchError | PolicyError, attempt: int) -> None:
        """Note an error and wait, or pass it on when it was one too many."""
        if attempt >= self._bounds.max_faults:
            raise type(error)(f"{error} ({attempt} times in a row)") from error
        self._notes.append(f"{type(error).__name__}: {error}")
        self._rig.clock.sleep(self._bounds.wait_s)
