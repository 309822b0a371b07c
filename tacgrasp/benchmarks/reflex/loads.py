"""One drawn load under the reflex: what it says while nothing is corrected, then what it changes.

Part of ``tacgrasp bench reflex``. Sensor and gripper have their periods and delays in simulated
time.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import ShearUnit
from cltp.tactile.shear.slip import SlipJudge, slip_model
from policies.reflex import Act, Correction, ReflexReading, correct
from primitives.contract import Band, ForceTerms
from primitives.sense import Interval
from sim.grasp.devices import ADJUST_S
from sim.grasp.drawn.loads import STEP_S, DrawnLoad, LoadFrame, draw_load, follow
from sim.grasp.pad_shear import SLIDING_STICK
from tacgrasp.runtime.reflex_hold import QUIET_FRAMES, ReflexHold

SLIP_MM = 0.1
"""Slide from which a load counts as one that slips [mm]. Our choice."""

HELD_STICK = 0.2
"""Stick fraction that a load must leave to count as held; between the two any answer is right."""

LIMIT_FACTOR = 3.0
"""Limit of the contract over the force of the grip. Our choice."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadResult:
    """One load.

    Attributes:
        seed: Its random seed.
        kind, object: What happened, to what.
        noise_mm: Noise of the unit along the gel [mm].
        slips: It slid by ``SLIP_MM`` or more where nothing was corrected.
        holds: At least ``HELD_STICK`` of its contact stuck all the time.
        called: The reflex raised the force.
        early: It did so while ``HELD_STICK`` stuck and had stuck.
        delay_ms: From the begin of the slide to the raise [ms]; negative before; None without both.
        slid_mm, slid_kept_mm: Slide at the end without and with the reflex [mm].
        gone, gone_kept: The body left the grip, without and with the reflex.
        force_factor: Largest force with the reflex over the grip's.
        largest_ratio: Largest displacement over indentation, which a threshold of force alone sees.
        compute_ms: Durations of the reflex's computation in this process: median and largest [ms].
    """

    seed: int
    kind: str
    object: str
    noise_mm: float
    slips: bool
    holds: bool
    called: bool
    early: bool
    delay_ms: float | None
    slid_mm: float
    slid_kept_mm: float
    gone: bool
    gone_kept: bool
    force_factor: float
    largest_ratio: float
    compute_ms: tuple[float, float]


class Keeper:
    """The reflex over the frames of one hold, as the runtime drives it, with its gripper's delay.

    Attributes:
        raised_s: Time of the first raise [s]; None before.
        ratios: Displacement over indentation of each frame.
        times_ms: Durations of the computation of each frame [ms].
    """

    def __init__(self, sensor: SensorSpec, force_n: float) -> None:
        self._period_s = 1.0 / sensor.frame_hz
        terms = ForceTerms(
            force_n=Band(low=force_n / 2, high=2 * force_n), limit_n=LIMIT_FACTOR * force_n
        )
        felt = Interval(value=force_n, low=force_n, high=force_n)
        judge = SlipJudge(slip_model(sensor.name), sensor.frame_hz)
        self._hold = ReflexHold(terms, felt, judge)
        self._hold.hanging = True
        self._changes: list[tuple[float, float]] = [(-math.inf, force_n)]
        self.raised_s: float | None = None
        self.ratios: list[float] = []
        self.times_ms: list[float] = []

    def force_at(self, t_s: float) -> float:
        """True force at a time [s]: commands come into force ``ADJUST_S`` later."""
        return [force for at_s, force in self._changes if at_s <= t_s + 1e-9][-1]

    @property
    def largest_n(self) -> float:
        """Largest command so far [N]."""
        return max(force for _, force in self._changes)

    def see(self, frame: ShearField, t_s: float) -> Correction | None:
        """Take a noisy frame; the correction, None while the hold is quiet."""
        began_s, hold = time.perf_counter(), self._hold
        commanded_n = self._changes[-1][1]
        felt_n, slip = hold.felt_and_slip(frame, t_s, commanded_n)
        if math.isinf(hold.seen_s):
            return None
        if hold.cues is not None:
            self.ratios.append(math.hypot(*hold.cues.along_mm) / max(hold.cues.depth_mm, 1e-6))
        reading = ReflexReading(
            t_s=t_s,
            captured_s=t_s,
            felt_n=felt_n,
            slip=slip,
            commanded_n=commanded_n,
            most_felt_n=2 * commanded_n,
        )
        correction, hold.memory = correct(reading, hold.terms, hold.memory, self._period_s)
        self.times_ms.append(1e3 * (time.perf_counter() - began_s))
        if correction.act in (Act.RAISE, Act.LOWER):
            self._changes.append((t_s + ADJUST_S, correction.force_n))
            hold.renew()
        if correction.act is Act.RAISE and self.raised_s is None:
            self.raised_s = t_s
        return correction


@dataclass(slots=True)
class _Run:
    """What one pass over a load left behind."""

    keeper: Keeper
    frames: list[LoadFrame] = field(default_factory=list)


def run_seed(sensor_name: str, seed: int) -> LoadResult | None:
    """One load without and with corrections; None where the pads don't reach the body."""
    drawn = draw_load(seed, sensor_name)
    try:
        alone = _pass(drawn, seed, acts=False)
    except ValueError:
        return None
    keeper = alone.keeper
    slid_mm = alone.frames[-1].slipped_mm
    kept = _pass(drawn, seed, acts=True) if keeper.raised_s is not None else alone
    until = [
        each for each in alone.frames if keeper.raised_s is None or each.t_s <= keeper.raised_s
    ]
    least_stick = min(each.stick_fraction for each in alone.frames)
    begun_s = onset_s(alone.frames)
    called = keeper.raised_s is not None
    return LoadResult(
        seed=seed,
        kind=drawn.kind.value,
        object=drawn.object_name,
        noise_mm=unit_of(drawn, seed).along_mm,
        slips=slid_mm >= SLIP_MM,
        holds=least_stick >= HELD_STICK,
        called=called,
        early=called and min(each.stick_fraction for each in until) >= HELD_STICK,
        delay_ms=None
        if begun_s is None or keeper.raised_s is None
        else 1e3 * (keeper.raised_s - begun_s),
        slid_mm=slid_mm,
        slid_kept_mm=kept.frames[-1].slipped_mm,
        gone=alone.frames[-1].state.dropped,
        gone_kept=kept.frames[-1].state.dropped,
        force_factor=kept.keeper.largest_n / drawn.force_n,
        largest_ratio=max(keeper.ratios, default=0.0),
        compute_ms=(float(np.median(keeper.times_ms)), max(keeper.times_ms)),
    )


def onset_s(frames: Sequence[LoadFrame]) -> float | None:
    """Time at which the contact began to slide [s], between two steps by the stick fraction."""
    for before, after in pairwise(frames):
        if after.slides:
            fall = before.stick_fraction - after.stick_fraction
            left = before.stick_fraction - SLIDING_STICK
            part = left / fall if fall > 0 and left > 0 else 0.0
            return before.t_s + min(1.0, part) * (after.t_s - before.t_s)
    return None


def noisy_frames(drawn: DrawnLoad, seed: int) -> Iterator[ShearField]:
    """Steps of a load without any correction, with the noise of the seed's unit."""
    rng = np.random.default_rng([seed, 28])
    unit, sensor = unit_of(drawn, seed), drawn.fingers.sensor
    for frame in follow(drawn, quiet=QUIET_FRAMES + 3):
        yield unit.apply(frame.field_of(sensor), rng)


def unit_of(drawn: DrawnLoad, seed: int) -> ShearUnit:
    """The unit of the sensor that a seed draws."""
    return ShearUnit.draw(np.random.default_rng([seed, 27]), drawn.fingers.sensor)


def _pass(drawn: DrawnLoad, seed: int, *, acts: bool) -> _Run:
    """Follow a load at every step of the dynamics; the reflex sees the sensor's frames alone."""
    rng, sensor = np.random.default_rng([seed, 28]), drawn.fingers.sensor
    unit, period_s = unit_of(drawn, seed), 1.0 / sensor.frame_hz
    every = round(period_s / STEP_S)
    first = int(rng.integers(every))
    run = _Run(Keeper(sensor, drawn.force_n))
    force = run.keeper.force_at if acts else None
    quiet = QUIET_FRAMES + 3
    for k, frame in enumerate(follow(drawn, quiet=quiet, force_n=force)):
        run.frames.append(frame)
        if k < quiet or k % every == first:
            t_s = (k - quiet) * period_s if k < quiet else frame.t_s
            run.keeper.see(unit.apply(frame.field_of(sensor), rng), t_s)
    return run
