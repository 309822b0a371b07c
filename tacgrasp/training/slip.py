"""Train the slip models of all sensors on simulated loads: cues of noisy frames to odds of a slide.

Each load is followed without any correction, with the noise of several drawn units. A frame in
which all of the contact slides is a slip; one in which more than ``STUCK`` sticks is none; what
lies between is left out. Seeds from ``FIRST_SEED`` on are for this alone; benchmarks begin at
1,000,000.

Not here: the loads (``sim.grasp.drawn_loads``), the cues (``cltp.tactile.shear.contact_shear``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import torch
from rich.console import Console

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import sensor_named
from cltp.tactile.shear.contact_shear import NUM_VALUES, ShearWatch
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import ShearUnit
from cltp.tactile.shear.slip import SlipJudge, SlipModel, write_model
from sim.grasp.drawn_loads import STEP_S, LoadFrame, draw_load, follow
from tacgrasp.base.worker_pool import worker_pool
from tacgrasp.console import count_progress

FIRST_SEED = 100
STUCK = 0.2
QUIET = {"taxels": 8, "gelsight_mini_markers": 4}
"""Frames at rest before a load, by sensor."""

HIDDEN, EPOCHS, BATCH, RATE, DECAY, JITTER = 24, 30, 256, 3e-3, 3e-3, 0.03
"""Width of both hidden layers, epochs, batch, learning rate (cosine), weight decay, noise on the
standardised cues. Our choice: wider nets remember the loads."""

FALSE_ALARMS = 0.005
"""Fraction of the held-out loads that may be called a slip without one; sets the threshold."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipRequest:
    """What is trained.

    Attributes:
        loads: Number of loads, one seed each.
        units: Noisy units that each is seen with.
        out: Folder of the models.
        seed: Random seed of the weights.
    """

    loads: int
    units: int
    out: Path
    seed: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class SeenLoad:
    """A load as one unit saw it: cues (T, NUM_VALUES), sticking (T,), slide (T,) [mm]."""

    sensor: str
    seed: int
    cues: FloatArray
    stick: FloatArray
    slipped_mm: FloatArray

    @property
    def slips(self) -> FloatArray:
        """Whether all of the contact slides, frame by frame."""
        return np.asarray((self.stick <= 0.02) & (self.slipped_mm > 0))


def see_load(units: int, seed: int) -> list[SeenLoad]:
    """One load, seen by some drawn units of each sensor; none where nothing is held."""
    rng, loads = np.random.default_rng([seed, 26]), []
    drawn = draw_load(seed, next(iter(QUIET)))  # all have the same gel
    try:
        steps = list(follow(drawn, quiet=max(QUIET.values())))
    except ValueError:
        return []
    num_quiet = max(QUIET.values())
    for name, quiet in QUIET.items():
        sensor = sensor_named(name)
        every = round(1.0 / (sensor.frame_hz * STEP_S))
        first = num_quiet + int(rng.integers(every))
        frames = [*steps[num_quiet - quiet : num_quiet], *steps[first::every]]
        fields = [frame.field_of(sensor) for frame in frames]
        for _ in range(units):
            loads.append(_seen_by(ShearUnit.draw(rng, sensor), seed, frames, fields, rng))
    return loads


def _seen_by(
    unit: ShearUnit,
    seed: int,
    frames: Sequence[LoadFrame],
    fields: Sequence[ShearField],
    rng: np.random.Generator,
) -> SeenLoad:
    watch = ShearWatch(fields[0].sensor, unit.along_mm, unit.depth_mm)
    cues = []
    for field in fields:
        seen = watch.see(unit.apply(field, rng))
        cues.append(np.zeros(NUM_VALUES) if seen is None else seen.values)
    return SeenLoad(
        sensor=fields[0].sensor.name,
        seed=seed,
        cues=np.array(cues),
        stick=np.array([frame.stick_fraction for frame in frames]),
        slipped_mm=np.array([frame.slipped_mm for frame in frames]),
    )


def train(request: SlipRequest, console: Console) -> dict[str, SlipModel]:
    """Simulate, train, choose thresholds on a quarter of the loads, write the models by sensor.

    Raises:
        TouchError: No load slips, or all do.
        OSError: A file can't be written.
    """
    function = partial(see_load, request.units)
    seeds = range(FIRST_SEED, FIRST_SEED + request.loads)
    with worker_pool() as pool, count_progress(console) as progress:
        results = progress.track(pool.map(function, seeds), len(seeds), description="loads")
        seen = [each for some in results for each in some]
    models = {}
    for name in QUIET:
        models[name] = fit([each for each in seen if each.sensor == name], request.seed)
        write_model(request.out / f"slip_{name}.npz", models[name])
    return models


def fit(loads: Sequence[SeenLoad], seed: int) -> SlipModel:
    """Train on three quarters of the loads; the others set the threshold.

    Raises:
        TouchError: No load slips, or none holds.
    """
    kept = [each for each in loads if each.seed % 4]
    held_out = [each for each in loads if each.seed % 4 == 0]
    cues = np.concatenate([each.cues for each in kept])
    slips = np.concatenate([each.slips for each in kept])
    known = slips | (np.concatenate([each.stick for each in kept]) > STUCK)
    if not slips.any() or slips[known].all() or not held_out:
        raise TouchError("training needs loads that slip, loads that hold, and some held out")
    mean, spread = cues.mean(axis=0), cues.std(axis=0) + 1e-6
    layers = _layers((cues[known] - mean) / spread, slips[known], seed)
    model = SlipModel(mean=mean, spread=spread, layers=layers, threshold=0.0)
    return SlipModel(mean=mean, spread=spread, layers=layers, threshold=_threshold(model, held_out))


def _layers(
    cues: FloatArray, slips: FloatArray, seed: int
) -> tuple[tuple[FloatArray, FloatArray], ...]:
    """Weights of a network that tells the slips by cross-entropy."""
    torch.manual_seed(seed)
    linear = [torch.nn.Linear(NUM_VALUES, HIDDEN), torch.nn.Linear(HIDDEN, HIDDEN)]
    linear.append(torch.nn.Linear(HIDDEN, 1))
    tanh = torch.nn.Tanh()
    network = torch.nn.Sequential(linear[0], tanh, linear[1], tanh, linear[2])
    x, y = torch.from_numpy(cues).float(), torch.from_numpy(slips).float()
    optimiser = torch.optim.AdamW(network.parameters(), RATE, weight_decay=DECAY)
    loss = torch.nn.BCEWithLogitsLoss()
    for epoch in range(EPOCHS):
        for group in optimiser.param_groups:
            group["lr"] = RATE * 0.5 * (1 + math.cos(math.pi * epoch / EPOCHS)) + 1e-5
        for rows in torch.randperm(len(x)).split(BATCH):
            optimiser.zero_grad()
            drawn = x[rows] + JITTER * torch.randn(len(rows), NUM_VALUES)
            loss(network(drawn)[:, 0], y[rows]).backward()
            optimiser.step()
    return tuple(
        (each.weight.detach().double().numpy(), each.bias.detach().double().numpy())
        for each in linear
    )


def _threshold(model: SlipModel, held_out: Sequence[SeenLoad]) -> float:
    """Largest score of all but ``FALSE_ALARMS`` of the loads, before or without a slip."""
    scores = []
    for load in held_out:
        stuck = np.minimum.accumulate(load.stick) > STUCK
        if stuck.any():
            judge = SlipJudge(model, sensor_named(load.sensor).frame_hz)
            scores.append(max(judge.see(each) for each in load.cues[stuck]))
    return float(np.quantile(scores, 1 - FALSE_ALARMS))
