"""Contacts of the robustness benchmark under a condition, and what reads them.

Every contact has the same draws of noise under every condition, times other levels, so that
conditions are compared on pairs; an error of level 0 draws nothing, and what is drawn after it then
differs.

Contacts of another gel are pressed anew: the same objects at the same forces or depths, from a seed
that no data set can have. What is read from their heights is multiplied by the factor of the gel's
force calibration, without the scatter that a real one has.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cltp.checkpoints.tac3d_llm import load_encoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.data.placement import Placement, move
from cltp.data.sampler import Augmentation, Batch, Sampler
from cltp.errors import TouchError
from cltp.evaluation.exact_observer import observed_state
from cltp.tactile.point_layout import EVEN, PointLayout
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import ContactState
from sim.full.series import press_on_gel
from sim.gel.layer import GelMaterial, gel_of
from sim.grasp.force_calibration import drawn_force_calibration
from sim.grasp.rig import BENCHMARK_SEED
from tacgrasp.benchmarks.robustness.conditions import GEL_NUISANCES, SENSOR, Condition

SEED = 0
"""Seed of the choice of contacts and of their noise."""

PRESSED_SEED = BENCHMARK_SEED + 1
"""Seed of the contacts that are pressed for the gels; no data set can have it."""

QUARTER_TURN = Placement(turn_rad=np.pi / 2)

LEAST_LEFT = 0.5
"""Least fraction of a contact that a quarter turn may leave on the pad, which is not square."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sampled:
    """Contacts under a condition.

    Attributes:
        batch: Their clouds and true states.
        exact: Their states as an observer with exact heights reads them.
        factor: Newtons per nominal newton of their gel.
    """

    batch: Batch
    exact: list[ContactState]
    factor: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSource:
    """Contacts under conditions. Sent to worker processes.

    Attributes:
        data: Data set whose test split is taken; None takes contacts that are pressed.
        pressed: Folder for pressed contacts.
        count: Largest number of contacts.
        weights: Weights of what reads them.
        layout: How the points lie that these take.
    """

    data: Path | None
    pressed: Path
    count: int
    weights: Path
    layout: PointLayout = EVEN

    def press(self, jobs: Sequence[tuple[str, Condition]]) -> None:
        """Press all contacts that some nuisances and conditions need."""
        for nuisance, condition in jobs:
            target = self._folder(nuisance, condition)
            if target != self.data and not (target / "dataset.json").exists():
                _press(target, condition.gel or gel_of(SENSOR), self.count)

    def sampled(self, nuisance: str, condition: Condition, rows: slice = slice(None)) -> Sampled:
        """Some of the contacts of a nuisance under a condition."""
        folder = self._folder(nuisance, condition)
        data = ContactDataset(folder, split=Split.TEST if folder == self.data else None)
        chosen = np.random.default_rng(SEED).permutation(len(data))[: self.count]
        return sample(data, np.sort(chosen)[rows].tolist(), condition, layout=self.layout)

    def _folder(self, nuisance: str, condition: Condition) -> Path:
        if self.data is not None and nuisance not in GEL_NUISANCES:
            return self.data
        gel = condition.gel or gel_of(SENSOR)
        return self.pressed / f"young-{gel.young_mpa:g}-thickness-{gel.thickness_mm:g}"


def _press(target: Path, gel: GelMaterial, count: int) -> None:
    """Press ``count`` contacts."""
    with DatasetWriter(target) as writer:
        for contact in press_on_gel(gel, sensor_named(SENSOR), seed=PRESSED_SEED, num=count):
            writer.add(contact)


def layout_of(weights: Path) -> PointLayout:
    """How the points lie that the encoder of some weights takes."""
    return load_encoder(weights / "encoder")[0].config.variant.layout


def sample(
    data: ContactDataset,
    indices: list[int],
    condition: Condition,
    seed: int = SEED,
    layout: PointLayout = EVEN,
) -> Sampled:
    """Draw the clouds of contacts under a condition; some can't be turned and are left out."""
    noise = Augmentation(noise_level=condition.levels, uncalibrated=0.0, mirror=False)
    sampler = Sampler(data, noise, seed=seed, layout=layout)
    kept, points, heights, sensors, states, exact = [], [], [], [], [], []
    for index in indices:
        sensor = sensor_named(data.column("sensor")[index])
        height_mm = data.height_mm(index)
        state = data.nominal_state(index) if condition.gel is None else data.state(index)
        if condition.turn_deg is not None:
            try:
                moved = move(height_mm, state, sensor, QUARTER_TURN)
            except TouchError:
                continue  # unknown gel would come in
            if moved.state.area_fraction < LEAST_LEFT * state.area_fraction:
                continue
            if condition.turn_deg:
                height_mm, state = moved.height_mm, moved.state
        points.append(sampler.cloud(height_mm, sensor, np.random.default_rng([seed, index])))
        rng = np.random.default_rng([seed, index])
        rng.random()  # as the sampler draws whether a unit is calibrated
        unit = NoiseUnit.draw(rng, condition.levels, spread=spread_of(sensor))
        exact.append(observed_state(height_mm, state, sensor, unit, rng))
        kept.append(index)
        heights.append(height_mm)
        sensors.append(sensor)
        states.append(state)
    batch = Batch(
        index=np.array(kept, dtype=np.int64),
        points=np.array(points, dtype=np.float32).reshape(len(kept), layout.num_points, 3),
        height_mm=heights,
        sensors=sensors,
        states=states,
        mirror=np.zeros((len(kept), 2), dtype=np.bool_),
        moved=np.zeros(len(kept), dtype=np.bool_),
        layout=layout,
    )
    return Sampled(batch=batch, exact=exact, factor=force_factor(condition))


def force_factor(condition: Condition) -> float:
    """Newtons per nominal newton of a condition's gel, by its force calibration without scatter."""
    if condition.gel is None:
        return 1.0
    return drawn_force_calibration(SENSOR, 0, gel=condition.gel, scatter=0.0).scale.factor


def part(sampled: Sampled, rows: slice) -> Batch:
    """Some of the contacts."""
    batch = sampled.batch
    columns = (each.name for each in dataclasses.fields(batch) if each.name != "layout")
    return Batch(layout=batch.layout, **{name: getattr(batch, name)[rows] for name in columns})
