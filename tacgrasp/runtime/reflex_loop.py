"""Drives the reflex between two decisions: newest frame in, corrected force out.

In a simulated world the clock calls it in the middle of motions and waits, once a frame of the
sensor; time of this computer does not count there. On a rig in real time it runs in a thread beside
the motion (``tacgrasp.runtime.reflex_thread``).

Not here: what it decides (``policies.reflex``), when the loop lets it run (``tacgrasp.runtime``).
"""

from __future__ import annotations

import datetime
import math
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.slip import SlipJudge, slip_model
from cltp.tactile.shear.slip_calibration import load_unit_slip
from policies.reflex import IMPOSSIBLE, RESPONSE_S, Act, Correction, ReflexReading, correct
from policies.reflex_trace import NO_SLIP, ForceCorrection, ReflexTrace, absent_trace
from primitives.contract import Contract
from primitives.execution import Executor
from primitives.sense import Interval
from tacgrasp.config.schema import RunConfig
from tacgrasp.rig.protocols import (
    CallingClock,
    Rig,
    StreamingShearSensor,
    TactileSensor,
    WatchedSensor,
)
from tacgrasp.runtime.reflex_hold import QUIET_FRAMES, ReflexHold
from tacgrasp.runtime.reflex_thread import beside_motion

DECISION_S = 0.3
"""Time that a decision takes in a simulated world, where the reflex runs meanwhile [s]. Our choice:
about that of the language model on a core or two."""


class ReflexLoop:
    """The reflex of one episode.

    Args:
        rig: Its devices.
        executor: Commands the gripper within all limits, and knows what is felt of it.
        threshold: Log odds from which a contact counts as slipping, of a calibrated unit; None:
            that of the sensor's model.
    """

    def __init__(self, rig: Rig, executor: Executor, threshold: float | None = None) -> None:
        self._rig, self._executor, self._threshold = rig, executor, threshold
        self.absent = _absence(rig)
        self._began_s = 0.0
        self._period_s = 1.0 / rig.sensor.spec.frame_hz
        self._forget()

    def _forget(self) -> None:
        self._samples: list[tuple[float, float, float, float]] = []
        self._corrections: list[ForceCorrection] = []
        self._num_blind, self._blind, self._ran = 0, "", False

    @contextmanager
    def deciding(
        self, contract: Contract, felt: Interval | None, rested: ShearField | None = None
    ) -> Iterator[None]:
        """Keep the contract while the block lets a policy decide; nothing else is commanded.

        A decision takes ``DECISION_S`` in a simulated world. Without contact, and where there is no
        reflex, the block runs as it is.

        Args:
            contract: The contract.
            felt: Force that is felt now; None without contact.
            rested: Shear field in which it is felt; None where that is not known.

        Raises:
            TouchError: The reflex had no reading for too long.
            RobotError: The gripper failed.
        """
        if felt is None or self._executor.force_n <= 0 or self._is_absent():
            yield
            return
        try:
            with self._beating(self._hold(contract, felt, rested)):
                yield
                if isinstance(self._rig.clock, CallingClock):
                    self._rig.clock.sleep(DECISION_S)
        finally:
            self._ran = self._ran or bool(self._samples or self._num_blind)

    @contextmanager
    def keeping(
        self,
        contract: Contract,
        felt: Interval | None,
        rested: ShearField | None = None,
        *,
        standing: bool = False,
        floor_n: float = 0.0,
    ) -> Iterator[ReflexHold | None]:
        """Keep the contract while the block moves the arm or waits; the object is held at rest.

        The block is given the hold, by which it asks for what its next motion needs; None where
        there is no reflex.

        Args:
            contract: The contract.
            felt: Force that is felt now; None where that is not known.
            rested: Shear field in which it is felt; None likewise.
            standing: Whether a support still catches the object.
            floor_n: Command that a hold before has asked for; it is not lowered below [N].

        Raises:
            TouchError: The reflex had no reading for too long, out of the motion or wait.
            RobotError: The gripper failed, likewise.
        """
        self._ran = True
        if self._is_absent():
            yield None
            return
        hold = self._hold(contract, felt, rested, floor_n)
        with self._beating(hold):
            self._rig.clock.sleep((QUIET_FRAMES + 0.5) * self._period_s)
            hold.standing, hold.hanging = standing, not standing
            yield hold

    def _is_absent(self) -> bool:
        self.absent = self.absent or _unit_absence(self._rig)
        return bool(self.absent)

    def _hold(
        self,
        contract: Contract,
        felt: Interval | None,
        rested: ShearField | None,
        floor_n: float = 0.0,
    ) -> ReflexHold:
        spec = self._rig.sensor.spec
        most_n = IMPOSSIBLE * self._executor.most_felt_n(self._executor.force_n)
        if felt is not None and felt.value > most_n:
            felt = None  # what no command makes says nothing of the force; a slip is told without
        judge = SlipJudge(slip_model(spec.name), spec.frame_hz, self._threshold)
        return ReflexHold(contract.terms, felt, judge, floor_n, rested)

    @contextmanager
    def _beating(self, hold: ReflexHold) -> Iterator[None]:
        """Run the reflex of a hold for each frame while the block moves the arm or waits."""
        clock, sensor = self._rig.clock, self._rig.sensor
        assert isinstance(sensor, StreamingShearSensor)
        if not isinstance(clock, CallingClock):
            beat = partial(self._beat_now, hold)
            with beside_motion(sensor, self._period_s, beat, self._rig.arm.stop):
                yield
            return
        self._began_s = clock.monotonic() - clock.simulated_s
        clock.call_every(self._period_s, lambda: self._beat_simulated(hold, clock, sensor))
        try:
            yield
        finally:
            clock.call_every(self._period_s, None)

    def take_trace(self) -> ReflexTrace | None:
        """What happened since the last call; None where the reflex did not run in between."""
        if not self._ran:
            return None
        if self.absent:
            self._forget()
            return absent_trace(self.absent)
        t_s, felt_n, commanded_n, slip = np.array(self._samples, dtype=np.float64).reshape(-1, 4).T
        trace = ReflexTrace(
            t_s=t_s,
            felt_n=felt_n,
            commanded_n=commanded_n,
            slip=slip,
            corrections=tuple(self._corrections),
            num_blind=self._num_blind,
            blind=self._blind,
        )
        self._forget()
        return trace

    def _beat_now(
        self, hold: ReflexHold, field: ShearField | None, captured_s: float | None
    ) -> None:
        self._beat(hold, self._reading(hold, field, self._rig.clock.monotonic(), captured_s))

    def _beat_simulated(
        self, hold: ReflexHold, clock: CallingClock, sensor: StreamingShearSensor
    ) -> None:
        began_s, now_s = self._rig.clock.monotonic(), clock.simulated_s
        _ = self._executor.gripper_state  # raises where the gripper has failed
        captured_s = None
        try:
            field = sensor.newest_shear()
        except TouchError:
            field = None
        if field is not None:
            captured_s = now_s
            if field.stamp is not None:  # the time that the simulator computes is no age
                captured_s = now_s - max(0.0, began_s - field.stamp.monotonic_s)
        self._beat(hold, self._reading(hold, field, now_s, captured_s))

    def _beat(self, hold: ReflexHold, reading: ReflexReading) -> None:
        """One frame: decide, command.

        Raises:
            TouchError: There was no reading for too long.
        """
        since_s = reading.t_s - max(hold.memory.raised_s, hold.memory.lowered_s)
        if reading.newest_n is not None and since_s > RESPONSE_S + self._period_s:
            self._executor.feel_growth(reading.may_feel_n)
        correction, hold.memory = correct(reading, hold.terms, hold.memory, self._period_s)
        if hold.memory.blind_s is not None:
            self._num_blind, self._blind = self._num_blind + 1, correction.reason
        else:
            slip = NO_SLIP if reading.slip is None else reading.slip
            felt_n = 0.0 if reading.felt_n is None else reading.felt_n
            at_s = self._began_s + reading.t_s
            self._samples.append((at_s, felt_n, reading.commanded_n, slip))
        if correction.act is Act.END:
            reasons = f"the reflex was blind: {correction.reason}", _silence(self._rig.sensor)
            raise TouchError("; ".join(filter(None, reasons)))
        if correction.act in (Act.RAISE, Act.LOWER):
            self._command(hold, correction, reading)

    def _command(self, hold: ReflexHold, correction: Correction, reading: ReflexReading) -> None:
        state = self._executor.correct_force(correction.force_n)
        if math.isclose(state.force_n, reading.commanded_n, rel_tol=1e-6):
            if hold.ahead_n == reading.ahead_n:
                hold.ahead_n = state.force_n  # all that is let through
            return
        hold.renew()
        reason = ", ".join(filter(None, [correction.reason, state.clamped]))
        self._corrections.append(
            ForceCorrection(
                t_s=self._now_s(),
                before_n=reading.commanded_n,
                after_n=state.force_n,
                reason=reason,
            )
        )

    def _now_s(self) -> float:
        """Time of the hold's readings [s]: in a simulated world of that, from its begin on."""
        clock = self._rig.clock
        if isinstance(clock, CallingClock):
            return self._began_s + clock.simulated_s
        return clock.monotonic()

    def _reading(
        self, hold: ReflexHold, field: ShearField | None, now_s: float, captured_s: float | None
    ) -> ReflexReading:
        commanded_n = self._executor.force_n
        felt_n, slip = hold.felt_and_slip(field, now_s, commanded_n)
        return ReflexReading(
            t_s=now_s,
            captured_s=captured_s,
            felt_n=felt_n,
            slip=slip,
            commanded_n=commanded_n,
            most_felt_n=self._executor.most_felt_n(commanded_n),
            newest_n=hold.newest_n,
            standing=hold.standing,
            is_found=hold.is_found,
            ahead_n=hold.ahead_n,
        )


def make_reflex(rig: Rig, executor: Executor, config: RunConfig) -> ReflexLoop | None:
    """The reflex of a run, with its unit's slip calibration; None where it is switched off.

    Raises:
        TouchError: The calibration is missing, damaged, too old, or that of another unit.
    """
    return ReflexLoop(rig, executor, slip_threshold(rig, config)) if config.reflex else None


def slip_threshold(rig: Rig, config: RunConfig) -> float | None:
    """Threshold of the unit's slip calibration; None: that of all units, or no reflex.

    Raises:
        TouchError: The calibration is missing, damaged, too old, or that of another unit.
    """
    if not config.reflex or config.slip_calibration is None:
        return None
    return load_unit_slip(
        config.slip_calibration,
        sensor=rig.sensor.spec.name,
        unit=config.sensor_unit,
        today=datetime.date.today(),
    ).threshold


def unfelt_slips(rig: Rig, config: RunConfig) -> str:
    """Warning of a task that lifts off by feeling slips, on a rig that feels none; '' otherwise."""
    reason = _absence(rig) if config.reflex else "the reflex is switched off"
    if not config.verify.lift_off_mm or not reason:
        return ""
    others = "; --sensor taxels feels them" if config.reflex and config.devices == "sim" else ""
    return f"slips of the lift-off are not felt, the grip stays as it is: {reason}{others}"


def _silence(sensor: TactileSensor) -> str:
    """What a sensor of a rig in real time says of why it gives no reading, with its remedy."""
    if not isinstance(sensor, WatchedSensor):
        return ""
    try:
        return sensor.check_alive()
    except TouchError as error:
        return str(error)


def _absence(rig: Rig) -> str:
    """Why there can be no reflex on a rig; '' where there can."""
    spec = rig.sensor.spec
    if spec.shear_grid is None:
        return f"{spec.name} measures no shear"
    if not isinstance(rig.sensor, StreamingShearSensor):
        return "the sensor gives no newest frame of shear"
    return ""


def _unit_absence(rig: Rig) -> str:
    """Why there can be none on this unit, on a rig in real time; '' where there can."""
    if isinstance(rig.clock, CallingClock) or not isinstance(rig.sensor, StreamingShearSensor):
        return ""
    with suppress(TouchError):  # a sensor that has failed is one that the reflex is blind with
        if rig.sensor.newest_shear() is None:
            return "the unit sends no displacements along its gel"
    return ""
