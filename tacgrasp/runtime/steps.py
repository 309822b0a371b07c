"""Steps of an episode: observations and records, and the bounds on time, failures and repeats.

Not here: the order of a step's stages (``tacgrasp.loop``).
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from itertools import count
from typing import Protocol

from cltp import TouchError
from cltp.sensing.frames import Frame, jpeg_of
from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.measure import contact_state
from cltp.tactile.shear.field import ShearField
from policies import Decision, Observation, Policy, PolicyError, checked
from policies.contract_steps import TargetTracker, beyond, softened
from policies.observation import is_impossible
from primitives import Primitive
from primitives.contract import Contract
from primitives.devices import GripperState, Pose
from primitives.execution import Executed, Executor
from primitives.gain import GainEstimate
from primitives.sense import Interval
from tacgrasp.config.schema import LoopConfig
from tacgrasp.episodes.record import EpisodeEnd, Need, StepPhase, StepRecord
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import CameraSensor, Rig, ShearSensor
from tacgrasp.runtime.outcome import EndOfEpisode, EndReason, Observer
from tacgrasp.runtime.reflex_hold import ReflexHold
from tacgrasp.runtime.reflex_loop import ReflexLoop


class Recorder(Protocol):
    """Storage of an episode (``tacgrasp.episodes.EpisodeWriter``)."""

    def write_step(self, record: StepRecord) -> None:
        """Write one step durably."""

    def finish(self, end: EpisodeEnd) -> None:
        """Write the end of the episode."""


class NoRecorder:
    """Records nothing, for benchmarks that keep only their figures."""

    def write_step(self, record: StepRecord) -> None: ...

    def finish(self, end: EpisodeEnd) -> None: ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Readings:
    """Readings of all devices at the start of a step.

    Attributes:
        cloud: Tactile cloud [mm, gel frame].
        tcp_pose: Pose of the TCP, read after the cloud [m, rad, base frame].
        gripper: State of the gripper, read after the cloud.
        stamp: Start of the reading, on the rig's clocks.
        started_s: Start of the reading, on this computer's performance counter [s].
        in_contact: Whether something touches the gel, by test; None where none was possible.
        felt_force_n: Force that the contact suggests [N]; None without contact or test.
        frame: The camera's frame behind the cloud; None without a camera.
        shear: Shear field of the same frames as the cloud; None where the sensor gives none.
    """

    cloud: TactileCloud
    tcp_pose: Pose
    gripper: GripperState
    stamp: Stamp
    started_s: float
    in_contact: bool | None = None
    felt_force_n: Interval | None = None
    frame: Frame | None = None
    shear: ShearField | None = None

    def for_policy(self, t_s: float) -> Observation:
        """What a policy is given of it, ``t_s`` seconds after the start of the episode.

        A force that no gripper makes of the command is none.
        """
        felt, commanded_n = self.felt_force_n, self.gripper.force_n
        if felt is not None and is_impossible(felt.value, commanded_n):
            felt = None
        return Observation(
            cloud=self.cloud,
            in_contact=self.in_contact,
            width_m=self.gripper.width_m,
            commanded_force_n=commanded_n,
            felt_force_n=felt,
            shear=self.shear,
            t_s=t_s,
        )


NO_CONTACT_DECISION = Decision(
    text="Nothing touches the gel. Action: <reset>.",
    action=Primitive.RESET,
    success=False,
    reason="no contact by test: the policy is not asked",
)
"""The runtime's own decision without contact, in place of any policy's."""


def decide(policy: Policy, observation: Observation, contract: Contract) -> Decision:
    """A policy's decision, checked and held to the contract, live as in replays and servers.

    What goes beyond the contract becomes no action and no success, with the reason.

    Raises:
        PolicyError: The policy failed, or its reply is no decision that can be carried out.
        TouchError: It can't use the cloud.
    """
    decision = checked(policy.decide(observation, contract))
    if observation.in_contact is None:
        state = None
    else:
        state = contact_state(observation.cloud, in_contact=observation.in_contact)
    reason = beyond(
        contract,
        decision.action,
        success=decision.success,
        felt=observation.felt_force_n,
        state=state,
    )
    if not reason:
        return decision
    return replace(decision, action=None, success=False, reason=f"beyond the contract: {reason}")


def read_observation(rig: Rig, sense: GelSense | None = None) -> Readings:
    """Read sensor, arm and gripper, and test for contact.

    Raises:
        TouchError: The sensor gives no fresh cloud.
        RobotError: Pose or gripper can't be read.
    """
    stamp, started_s = rig.clock.stamp(), time.perf_counter()
    cloud = rig.sensor.read() if sense is None else sense.read()
    return Readings(
        cloud=cloud,
        tcp_pose=rig.arm.pose(),
        gripper=rig.gripper.state(),
        stamp=stamp,
        started_s=started_s,
        in_contact=None if sense is None else sense.in_contact(cloud),
        felt_force_n=None if sense is None else sense.felt_force(cloud),
        frame=rig.sensor.last_frame() if isinstance(rig.sensor, CameraSensor) else None,
        shear=rig.sensor.last_shear() if isinstance(rig.sensor, ShearSensor) else None,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """One step up to its decision.

    Attributes:
        observation: Readings at its start.
        decision: The policy's decision; None during verification, which asks no policy.
        phase: Part of the episode.
    """

    observation: Readings
    decision: Decision | None = None
    phase: StepPhase = StepPhase.LOOP

    @property
    def declared(self) -> bool:
        """Whether the policy declared success and asked for no further action."""
        return self.decision is not None and self.decision.success and self.decision.action is None


class Steps:
    """Counts, bounds and record of the steps of one episode.

    Attributes:
        num_steps: Steps recorded so far, verification included.
        num_actions: Actions executed so far.
        num_empty: Closings on nothing in a row, each followed by the runtime's own reset.
        peak_felt_n: Largest force felt at a step so far [N]; None before any was felt.
        force_mark: Mark of the sensor's forces; empty for a calibrated unit.
        force_residual: Relative residual of their calibration; None before any was felt.
        gain: The gripper's force gain over the grips so far; None before anything was felt.
        started_s: Start of the episode on the rig's monotonic clock [s].
        reflex: Keeps the contract between two decisions; None for none.
        may_hang: Whether the object may hang in the air: it was lifted, and is not back where it
            stood.
    """

    def __init__(
        self,
        rig: Rig,
        bounds: LoopConfig,
        recorder: Recorder,
        observers: Sequence[Observer],
        sense: GelSense | None = None,
        reflex: ReflexLoop | None = None,
    ) -> None:
        self.reflex = reflex
        self._rig, self._bounds, self._sense = rig, bounds, sense
        self._recorder, self._observers = recorder, observers
        self.num_steps = self.num_actions = self.num_empty = 0
        self.peak_felt_n: float | None = None
        self.force_mark = ""
        self.force_residual: float | None = None
        self.gain: GainEstimate | None = None
        self.may_hang = False
        self.started_s = rig.clock.monotonic()
        self._num_idle = 0
        self._last: Step | None = None
        self._notes: list[str] = []
        self._new_contract: Contract | None = None
        self._target = TargetTracker()
        self._need: Need | None = None

    @property
    def elapsed_s(self) -> float:
        """Time since the episode began [s]."""
        return self._rig.clock.monotonic() - self.started_s

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

    def soften_if_soft(
        self, executor: Executor, observation: Readings, contract: Contract
    ) -> Contract:
        """The contract after what is felt: a soft contact is held to the terms of soft ones."""
        is_soft = executor.feel(observation.felt_force_n)
        self.gain = executor.gain
        if not is_soft:
            return contract
        held = softened(contract)
        executor.keep(held)
        self._notes.append(held.assumed[-1])
        self._new_contract = held
        return held

    def with_target(self, executor: Executor, seen: Observation, contract: Contract) -> Contract:
        """The contract of this step: its force band is the target that this object needs."""
        aimed, words = self._target.contract_at(contract, seen, executor.reach_n)
        if words:
            executor.aim_at(aimed)
            self._need = Need(force_n=aimed.terms.force_n, felt=words)
        return aimed

    def retry_or_raise(self, error: TouchError | PolicyError, attempt: int) -> None:
        """Note a failed attempt to read or decide and wait; the caller then tries again.

        Args:
            error: Failure of the attempt.
            attempt: Number of the attempt, from 1.

        Raises:
            TouchError: The attempt was the last of ``max_faults``.
            PolicyError: Likewise.
        """
        if attempt >= self._bounds.max_faults:
            raise type(error)(f"{error} ({attempt} times in a row)") from error
        self._notes.append(f"{type(error).__name__}: {error}")
        self._rig.clock.sleep(self._bounds.wait_s)

    def observe(self, phase: StepPhase) -> Readings:
        """Read and record one observation of the verification, with the loop's retries.

        Raises:
            TouchError: The sensor failed ``max_faults`` times in a row.
            RobotError: Pose or gripper can't be read.
            EpisodeError: The observation can't be recorded.
        """
        for attempt in count(1):
            try:
                observation = read_observation(self._rig, self._sense)
                break
            except TouchError as error:
                self.retry_or_raise(error, attempt)
        self.record(Step(observation=observation, phase=phase))
        return observation

    def record(self, step: Step, executed: Executed | None = None, note: str = "") -> None:
        """Record a step with its executed action, then inform the observers.

        Raises:
            EpisodeError: It can't be recorded: the run must end.
        """
        if step.decision is not None:  # not an observation of the verification
            self._last = step
        if executed is not None and not executed.dry_run:
            self.num_actions += 1
        if step.observation.in_contact is not None and executed is not None:
            self.num_empty = 0 if step.observation.in_contact else self.num_empty + 1
        self._note_felt(step.observation)
        record = StepRecord(
            index=self.num_steps,
            phase=step.phase,
            cloud=step.observation.cloud,
            decision=step.decision,
            executed=executed,
            tcp_pose=step.observation.tcp_pose,
            gripper=step.observation.gripper,
            stamp=step.observation.stamp,
            step_ms=1000 * (time.perf_counter() - step.observation.started_s),
            note="; ".join([*self._notes, *([note] if note else [])]),
            commands=self._rig.commands(),
            in_contact=step.observation.in_contact,
            felt_force_n=step.observation.felt_force_n,
            contract=self._new_contract,
            need=self._need,
            camera_jpeg=None if step.observation.frame is None else jpeg_of(step.observation.frame),
            shear=step.observation.shear,
            reflex=None if self.reflex is None else self.reflex.take_trace(),
        )
        self._notes, self._new_contract, self._need = [], None, None
        self._recorder.write_step(record)
        self.num_steps += 1
        if executed is not None and not executed.sent_nothing:
            self._num_idle = 0
        for observer in self._observers:
            observer(record)

    def _note_felt(self, observation: Readings) -> None:
        if observation.felt_force_n is not None:
            self.peak_felt_n = max(self.peak_felt_n or 0.0, observation.felt_force_n.value)
            self.force_mark = observation.cloud.force_scale.mark
            self.force_residual = observation.cloud.force_scale.spread

    def deciding(self, contract: Contract, seen: Readings) -> AbstractContextManager[None]:
        """``ReflexLoop.deciding``, which raises as it does; without a reflex, nothing."""
        if self.reflex is None:
            return nullcontext()
        return self.reflex.deciding(contract, seen.felt_force_n, seen.shear)

    def keeping(
        self,
        contract: Contract,
        seen: Readings,
        *,
        standing: bool = False,
        floor_n: float = 0.0,
    ) -> AbstractContextManager[ReflexHold | None]:
        """``ReflexLoop.keeping``, which raises as it does; without a reflex, nothing."""
        if self.reflex is None:
            return nullcontext()
        return self.reflex.keeping(
            contract, seen.felt_force_n, seen.shear, standing=standing, floor_n=floor_n
        )

    def record_cut_short(self, step: Step | None, message: str) -> None:
        """Record a step that the end of the episode interrupted before its own record began.

        Raises:
            EpisodeError: It can't be recorded.
        """
        if step is not None and step is not self._last:
            self.record(step, note=f"cut short: {message}")

    def ask_again(self, decision: Decision) -> None:
        """Count a decision that moved nothing, and wait; the loop then asks again.

        Raises:
            EndOfEpisode: ``no_action``: it was the last of ``max_asks`` in a row.
        """
        self._num_idle += 1
        if self._num_idle >= self._bounds.max_asks:
            raise EndOfEpisode(
                EndReason.NO_ACTION,
                f"{self._num_idle} decisions in a row moved nothing ({decision.reason}); "
                f"the last text was: {decision.text!r}",
            )
        self._rig.clock.sleep(self._bounds.wait_s)
