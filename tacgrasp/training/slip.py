"""Train the slip models of all sensors on simulated loads: cues of noisy frames to odds of a slide.

Each load is seen by several drawn units. A frame in which less than ``STUCK`` of the contact
sticks, or did since the frame before, is a slip; one before which more has always stuck is none;
what comes after a slide is left out.

Not here: the loads (``tacgrasp.training.slip_loads``), the cues
(``cltp.tactile.shear.contact_shear``), the network (``cltp.tactile.shear.slip``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rich.console import Console

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.shear.contact_shape import grid_of
from cltp.tactile.shear.contact_shear import (
    MIRROR_ORDER,
    MIRROR_SIGNS,
    NUM_VALUES,
    ShearWatch,
)
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import ShearUnit
from cltp.tactile.shear.slip import SlipJudge, SlipModel, noise_of, write_model
from sim.grasp.drawn.loads import STEP_S
from sim.grasp.pad_shear import SLIDING_STICK
from tacgrasp.base.worker_pool import worker_pool
from tacgrasp.console import count_progress
from tacgrasp.training.slip_loads import (
    FIRST_SEED,
    SENSORS,
    Course,
    TrueLoad,
    read_block,
    simulate,
)
from tacgrasp.training.slip_network import Lesson, learn, standardised

STUCK = 0.2
"""Stick fraction below which a load counts as no longer held, as in ``tacgrasp bench reflex``."""

QUIET = 10
"""Frames at rest from which the noise of a unit is told, as in the reflex."""

LONG_QUIET = 40
"""Most frames at rest before a load that a unit sees; mostly there are up to 15."""

EARLY, PARTIAL, NEARLY = 2.0, 0.5, 2.0
"""Weights in the loss: the first frames of a slide, frames in which a little sticks, loads that
hold with less than ``NEARLY_SLID`` of the contact. Our choice."""

NEARLY_SLID = 0.5

PRECISION = 0.993
"""Fraction of the calls on held-out loads that shall be slips; sets the threshold. Our choice: the
last half percent costs the most. Of 1,512 slips of taxels that were held out, 93.8, 91.4 and 86.2 %
are called within 30 ms at 99, 99.3 and 99.5 %, and the latest hundredth after 72, 90 and 110 ms."""

SLIP_MM = 0.1
"""Slide from which a load counts as one that slips, as in ``tacgrasp bench reflex`` [mm]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipRequest:
    """What is trained.

    Attributes:
        seeds: Number of seeds of loads.
        units: Noisy units that each load is seen with.
        out: Folder of the models.
        loads: Folder of the simulated loads, which are kept there.
        seed: Random seed of the weights.
        sensors: Names of the sensors whose models are trained.
    """

    seeds: int
    units: int
    out: Path
    loads: Path
    seed: int = 0
    sensors: tuple[str, ...] = SENSORS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeenLoad:
    """A load as one unit saw it, frame by frame from the last that told the noise on.

    Attributes:
        sensor: Name of the sensor.
        seed: Seed of the load.
        course: What happens.
        cues: Shape (T, NUM_VALUES).
        steps: Shape (T,), the simulated step of each frame, 0 at rest.
        stick: Shape (S,), fraction that sticks, of all steps.
        slipped_mm: Shape (S,), slide of all steps [mm].
    """

    sensor: str
    seed: int
    course: Course
    cues: FloatArray
    steps: NDArray[np.int64]
    stick: FloatArray
    slipped_mm: FloatArray

    @property
    def slips(self) -> bool:
        """Whether the load is one that slips."""
        return bool(self.slipped_mm[-1] >= SLIP_MM)

    @property
    def holds(self) -> bool:
        """Whether enough of the contact stuck all the time."""
        return bool(self.stick.min() >= STUCK)

    @property
    def held(self) -> NDArray[np.bool_]:
        """Whether enough had always stuck, shape (T,)."""
        return np.asarray(np.minimum.accumulate(self.stick)[self.steps] >= STUCK)

    def lesson(self, mean: FloatArray, spread: FloatArray) -> Lesson:
        """What the network is taught of it, with mean and spread of all cues (NUM_VALUES,)."""
        every = _steps_of(sensor_named(self.sensor))
        span = max(2, every)  # of a slide between two frames the later one tells
        least = np.array([self.stick[max(0, k - span + 1) : k + 1].min() for k in self.steps])
        held, slips, slides = self.held, least < STUCK, least <= SLIDING_STICK
        weight = np.where(slips, np.where(slides, 1.0, PARTIAL), np.where(held, 1.0, 0.0))
        due = np.zeros(len(held))
        begun = np.flatnonzero((self.stick <= SLIDING_STICK) & (self.slipped_mm > 0))
        if len(begun):
            weight[slides & (self.steps <= begun[0] + 2 + every)] = EARLY
            due[~held & (self.steps <= begun[0] + 2 * every)] = float(self.slips)
        if self.holds and self.stick.min() < NEARLY_SLID:
            weight *= NEARLY
        if self.course is Course.CHANGED:  # a firmer grip has caught it
            weight[~slips & ~held] = PARTIAL
        return Lesson(
            cues=standardised(self.cues, mean, spread),
            slips=slips.astype(np.float64),
            weight=weight,
            held=held.astype(np.float64),
            due=due,
        )


def see_loads(units: int, sensors: Sequence[str], path: Path) -> list[SeenLoad]:
    """The loads of a block, seen by some drawn units of each of some sensors."""
    return [
        _seen(load, name, rng)
        for load in read_block(path)
        for k, name in enumerate(SENSORS)
        if name in sensors
        for rng in [np.random.default_rng([load.seed, 31, list(Course).index(load.course), k])]
        for _ in range(units)
    ]


def _seen(load: TrueLoad, name: str, rng: np.random.Generator) -> SeenLoad:
    sensor = sensor_named(name)
    grid, every = grid_of(sensor), _steps_of(sensor)
    positions_mm = np.stack([grid.x, grid.y], axis=1).astype(np.float32)
    unit = ShearUnit.draw(rng, sensor)
    quiet = int(rng.integers(QUIET + 1, LONG_QUIET if rng.random() < 0.3 else QUIET + 6))
    first = 1 + int(rng.integers(every))
    steps = [0] * quiet + list(range(first, len(load.stick), every))
    fields = [
        unit.apply(
            ShearField(
                positions_mm=positions_mm, displacement_mm=load.moved_mm[name][k], sensor=sensor
            ),
            rng,
        )
        for k in steps
    ]
    watch = ShearWatch(sensor, *noise_of(fields[:QUIET]))
    cues, is_renewed = [], load.commanded < 0
    for k, field in zip(steps, fields, strict=True):
        seen = watch.see(field)
        cues.append(np.zeros(NUM_VALUES) if seen is None else seen.values)
        if not is_renewed and k > 0 and k >= load.commanded:
            watch.renew()
            is_renewed = True
    return SeenLoad(
        sensor=name,
        seed=load.seed,
        course=load.course,
        cues=np.array(cues[QUIET - 1 :]),
        steps=np.array(steps[QUIET - 1 :]),
        stick=load.stick,
        slipped_mm=load.slipped_mm,
    )


def _steps_of(sensor: SensorSpec) -> int:
    """Simulated steps between two frames of a sensor."""
    return round(1.0 / (sensor.frame_hz * STEP_S))


def train(request: SlipRequest, console: Console) -> dict[str, SlipModel]:
    """Simulate, train, choose thresholds on a quarter of the loads, write the models by sensor.

    Raises:
        TouchError: No load slips, or all do, or a file of loads is damaged.
        OSError: A file can't be written.
    """
    paths = simulate(request.loads, range(FIRST_SEED, FIRST_SEED + request.seeds), console)
    with worker_pool() as pool, count_progress(console) as progress:
        results = progress.track(
            pool.map(partial(see_loads, request.units, request.sensors), paths),
            len(paths),
            description="frames",
        )
        seen = [each for some in results for each in some]
    models = {}
    for name in request.sensors:
        models[name] = fit([each for each in seen if each.sensor == name], request.seed)
        write_model(request.out / f"slip_{name}.npz", models[name])
    return models


def fit(loads: Sequence[SeenLoad], seed: int) -> SlipModel:
    """Train on three quarters of the loads; the others set the threshold.

    Raises:
        TouchError: No load slips, or none holds.
    """
    kept = [each for each in loads if each.seed % 4]
    held_out = [each for each in loads if each.seed % 4 == 0 and each.course is Course.LOAD]
    for some in (kept, held_out):
        if not any(each.slips for each in some) or not any(each.holds for each in some):
            raise TouchError("training needs loads that slip, loads that hold, and some held out")
    frame_hz = sensor_named(loads[0].sensor).frame_hz
    cues = np.concatenate([each.cues for each in kept])
    mean, spread = cues.mean(axis=0), cues.std(axis=0) + 1e-6
    mean = (mean + mean[MIRROR_ORDER] * MIRROR_SIGNS) / 2
    spread = np.maximum(spread, spread[MIRROR_ORDER])
    lessons = [each.lesson(mean, spread) for each in kept]
    layers = learn(lessons, seed)
    model = SlipModel(mean=mean, spread=spread, **layers, frame_hz=frame_hz, threshold=0.0)
    return replace(model, threshold=_threshold(model, held_out))


def _threshold(model: SlipModel, held_out: Sequence[SeenLoad]) -> float:
    """The least threshold with the wanted precision: a call is wrong on what holds, or before.

    Raises:
        TouchError: No threshold has it.
    """
    scored = []
    for load in held_out:
        judge = SlipJudge(model, model.frame_hz)
        scores = np.maximum.accumulate([judge.see(each) for each in load.cues])
        held = load.held
        early = float(scores[held][-1]) if held.any() else -math.inf
        scored.append((float(scores[-1]), early, load))
    for threshold in sorted(early for _, early, _ in scored):
        called = [each for each in scored if each[0] > threshold]
        wrong = sum(early > threshold for _, early, _ in called)
        right = sum(load.slips and early <= threshold for _, early, load in called)
        if right and right >= PRECISION * (right + wrong):
            return threshold
    raise TouchError(f"no threshold has a precision of {PRECISION:g} on the loads held out")
