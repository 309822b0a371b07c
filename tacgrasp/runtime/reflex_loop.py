"""Drives the reflex between two decisions: newest frame in, corrected force out.

In a simulated world the clock calls it in the middle of motions and waits, once a frame of the
sensor; time of this computer does not count there.

Not here: what it decides (``policies.reflex``), when the loop lets it run (``tacgrasp.runtime``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.shear.contact_shear import ShearCues, ShearWatch
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.slip import SlipJudge, noise_of, slip_model
from cltp.tactile.shear.slip_calibration import load_slip_calibration
from policies.reflex import Act, Correction, ReflexMemory, ReflexReading, correct
from policies.reflex_trace import NO_SLIP, ForceCorrection, ReflexTrace, absent_trace
from primitives.contract import Contract
from primitives.execution import Executor
from primitives.sense import Interval
from tacgrasp.config.schema import RunConfig
from tacgrasp.rig.protocols import CallingClock, Rig, StreamingShearSensor

QUIET_FRAMES = 10
"""Frames of the hold at rest before anything moves, which tell the unit's noise. Our choice: a
tenth of a second with taxels."""


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
        self._judge: SlipJudge | None = None
        self._began_s = 0.0
        self._period_s = 1.0 / rig.sensor.spec.frame_hz
        self._forget()

    def _forget(self) -> None:
        self._samples: list[tuple[float, float, float, float]] = []
        self._corrections: list[ForceCorrection] = []
        self._num_blind, self._blind, self._ran = 0, "", False

    @contextmanager
    def keeping(self, contract: Contract, felt: Interval | None) -> Iterator[None]:
        """Keep the contract while the block moves the arm or waits; the object is held at rest.

        Args:
            contract: The contract.
            felt: Force that is felt now; None where that is not known.

        Raises:
            TouchError: The reflex had no reading for too long, out of the motion or wait.
            RobotError: The gripper failed, likewise.
        """
        clock = self._rig.clock
        self._ran = True
        if self.absent or not isinstance(clock, CallingClock):
            yield
            return
        spec = self._rig.sensor.spec
        self._judge = SlipJudge(slip_model(spec.name), spec.frame_hz, self._threshold)
        self._began_s = self._rig.clock.monotonic() - clock.simulated_s
        hold = _Hold(contract, felt)
        clock.call_every(self._period_s, lambda: self._beat(hold))
        try:
            self._rig.clock.sleep((QUIET_FRAMES + 0.5) * self._period_s)
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

    def _beat(self, hold: _Hold) -> None:
        """One frame: read, decide, command.

        Raises:
            TouchError: There was no reading for too long.
        """
        reading = self._reading(hold)
        correction, hold.memory = correct(reading, hold.contract.terms, hold.memory, self._period_s)
        if hold.memory.blind_s is not None:
            self._num_blind, self._blind = self._num_blind + 1, correction.reason
        else:
            slip = NO_SLIP if reading.slip is None else reading.slip
            felt_n = 0.0 if reading.felt_n is None else reading.felt_n
            self._samples.append((self._now_s(), felt_n, reading.commanded_n, slip))
        if correction.act is Act.END:
            raise TouchError(f"the reflex was blind: {correction.reason}; the grip was kept")
        if correction.act in (Act.RAISE, Act.LOWER):
            self._command(hold, correction, reading)

    def _command(self, hold: _Hold, correction: Correction, reading: ReflexReading) -> None:
        state = self._executor.correct_force(correction.force_n)
        hold.renew()
        if not math.isclose(state.force_n, reading.commanded_n, rel_tol=1e-6):
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
        """Time of the hold's readings [s]: of the world, from the hold's begin on."""
        clock = self._rig.clock
        assert isinstance(clock, CallingClock)
        return self._began_s + clock.simulated_s

    def _reading(self, hold: _Hold) -> ReflexReading:
        clock, sensor = self._rig.clock, self._rig.sensor
        assert isinstance(clock, CallingClock) and isinstance(sensor, StreamingShearSensor)
        began_s, now_s = clock.monotonic(), clock.simulated_s
        commanded_n = self._executor.gripper_state.force_n
        try:
            field = sensor.newest_shear()
        except TouchError:
            field = None
        captured_s, felt_n, slip = None, None, None
        if field is not None:
            captured_s = now_s
            if field.stamp is not None:  # the time that the simulator computes is no age
                captured_s = now_s - max(0.0, began_s - field.stamp.monotonic_s)
            cues = hold.see(field)
            if cues is not None:
                felt_n = hold.force_of(cues)
                slip = None if self._judge is None else self._judge.see(cues.values)
        return ReflexReading(
            t_s=now_s,
            captured_s=captured_s,
            felt_n=felt_n,
            slip=slip,
            commanded_n=commanded_n,
            most_felt_n=self._executor.most_felt_n(commanded_n),
        )


def make_reflex(rig: Rig, executor: Executor, config: RunConfig) -> ReflexLoop | None:
    """The reflex of a run, with its unit's slip calibration; None where it is switched off.

    Raises:
        TouchError: The calibration is damaged, or that of another sensor.
    """
    if not config.reflex:
        return None
    threshold = None
    if config.slip_calibration is not None:
        name = rig.sensor.spec.name
        threshold = load_slip_calibration(config.slip_calibration, name).threshold
    return ReflexLoop(rig, executor, threshold)


class _Hold:
    """One hold: its contract, what the frames tell of it, and the reflex's memory."""

    def __init__(self, contract: Contract, felt: Interval | None) -> None:
        self.contract, self.memory = contract, ReflexMemory()
        self._felt_n = None if felt is None else felt.value
        self._quiet: list[ShearField] = []
        self._watch: ShearWatch | None = None
        self._volume_mm3 = 0.0

    def see(self, field: ShearField) -> ShearCues | None:
        """Cues of a frame; None while the hold is quiet and its noise is measured."""
        if self._watch is not None:
            return self._watch.see(field)
        self._quiet.append(field)
        if len(self._quiet) < QUIET_FRAMES:
            return None
        self._watch = ShearWatch(field.sensor, *noise_of(self._quiet))
        for each in self._quiet:
            cues = self._watch.see(each)
        if cues is not None:
            self._volume_mm3 = cues.volume_mm3
        return cues

    def renew(self) -> None:
        """A correction was commanded: the contact will change."""
        if self._watch is not None:
            self._watch.renew()

    def force_of(self, cues: ShearCues) -> float | None:
        """Force felt in a frame [N]: that felt before the hold, times the indentation's growth."""
        if self._felt_n is None or self._volume_mm3 <= 0:
            return None
        return self._felt_n * cues.volume_mm3 / self._volume_mm3


def _absence(rig: Rig) -> str:
    """Why there can be no reflex on a rig; '' where there can."""
    spec = rig.sensor.spec
    if spec.shear_grid is None:
        return f"{spec.name} measures no shear"
    if not isinstance(rig.sensor, StreamingShearSensor):
        return "the sensor gives no newest frame of shear"
    if not isinstance(rig.clock, CallingClock):
        return "it runs in simulated worlds alone so far"
    return ""
