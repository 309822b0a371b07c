"""What learning sees of a data set: noisy clouds with their targets, drawn anew at every pass.

Not here: models and losses. Loads no torch.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.data.dataset import ContactDataset
from cltp.data.placement import draw_placement, move
from cltp.tactile.encoder_input import scaled
from cltp.tactile.markers import densified, marker_cloud
from cltp.tactile.point_layout import EVEN, Sampling
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import ContactState, Side, position_word

MIRROR = {
    Side.LEFT: Side.RIGHT,
    Side.RIGHT: Side.LEFT,
    Side.TOP: Side.BOTTOM,
    Side.BOTTOM: Side.TOP,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """Samples for one step of learning.

    Attributes:
        index: Shape (B,), the contacts in their data set.
        points: Shape (B, 1024, 3), float32, scaled, in the order of ``cltp.tactile.encoder_input``;
            as many as the sampler's ``sampling`` has.
        height_mm: The clean heights behind each cloud, mirrored alike; for rendering.
        states: Their labels, mirrored alike.
        mirror: Shape (B, 2), bool: mirrored along x, along y.
        moved: Shape (B,), bool: shifted or turned after that.
    """

    index: NDArray[np.int64]
    points: NDArray[np.float32]
    height_mm: list[NDArray[np.float32]]
    states: list[ContactState]
    mirror: NDArray[np.bool_]
    moved: NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class Augmentation:
    """How contacts are varied.

    Attributes:
        noise_level: Of ``NoiseUnit.draw``; 0 leaves the heights clean.
        uncalibrated: Share of samples whose unit also has unequal gradient gains.
        mirror: Whether contacts are mirrored along x, along y and along both.
        clean: Share of samples that stay without noise, so that a perfect sensor is known too.
    """

    noise_level: float = 1.0
    uncalibrated: float = 0.25
    mirror: bool = True
    clean: float = 0.0


CLEAN = Augmentation(noise_level=0.0, uncalibrated=0.0, mirror=False)
NOISY = Augmentation(uncalibrated=0.0, mirror=False)
"""Noise of a calibrated unit, as the simulated sensor has it: for validation and evaluation."""


class Sampler:
    """Draws batches from a data set; the same seed gives the same batches.

    Args:
        dataset: Where contacts come from.
        augmentation: How they are varied.
        seed: Of everything that is drawn.
        sampling: Where the points lie.
        moved: Share of contacts that are shifted and turned on the pad (``cltp.data.placement``).
        shuffle_labels: Gives each contact the label of another: a control that must not learn.
    """

    def __init__(
        self,
        dataset: ContactDataset,
        augmentation: Augmentation | None = None,
        *,
        seed: int = 0,
        sampling: Sampling = EVEN,
        moved: float = 0.0,
        shuffle_labels: bool = False,
    ) -> None:
        self.dataset, self.sampling, self.moved = dataset, sampling, moved
        self._label = np.arange(len(dataset))
        if shuffle_labels:
            self._label = np.random.default_rng([seed, 99]).permutation(len(dataset))
        self.augmentation = augmentation or Augmentation()
        self.seed = seed
        self._orders: dict[int, NDArray[np.int64]] = {}

    def batch(self, indices: NDArray[np.int64], step: int) -> Batch:
        """The samples of the given contacts, varied as step ``step`` of this seed varies them."""
        rng = np.random.default_rng([self.seed, step])
        points, heights, states = [], [], []
        mirror = rng.random((len(indices), 2)) < (0.5 if self.augmentation.mirror else 0.0)
        moved = np.zeros(len(indices), dtype=np.bool_)
        if self.moved > 0:  # no draw where none is: what is drawn after it must stay what it was
            moved = rng.random(len(indices)) < self.moved
        for index, (along_x, along_y), is_moved in zip(indices, mirror, moved, strict=True):
            sensor = sensor_named(self.dataset.column("sensor")[index])
            height_mm = self.dataset.height_mm(int(index))
            height_mm = height_mm[:: -1 if along_y else 1, :: -1 if along_x else 1]
            state = self.dataset.state(int(self._label[index]))
            state = mirrored(state, sensor, along_x=bool(along_x), along_y=bool(along_y))
            if is_moved:
                to = draw_placement(height_mm, state, sensor, rng)
                there = move(height_mm, state, sensor, to)
                height_mm, state = there.height_mm, there.state
            points.append(self.cloud(height_mm, sensor, rng))
            heights.append(height_mm)
            states.append(state)
        return Batch(
            index=np.asarray(indices),
            points=np.stack(points),
            height_mm=heights,
            states=states,
            mirror=mirror,
            moved=moved,
        )

    def training(self, batch_size: int, first_step: int = 0) -> Iterator[Batch]:
        """Batches without end: every contact once in an order of its own, then again.

        Args:
            batch_size: Contacts in a batch.
            first_step: Where to go on; step ``n`` is the same wherever one starts.
        """
        step = first_step
        while True:
            yield self.numbered(batch_size, step)
            step += 1

    def numbered(self, batch_size: int, step: int) -> Batch:
        """The batch of one step of ``training``."""
        size = len(self.dataset)
        places = range(step * batch_size, (step + 1) * batch_size)
        indices = np.array([self._order(place // size)[place % size] for place in places])
        return self.batch(indices, step)

    def _order(self, epoch: int) -> NDArray[np.int64]:
        if epoch not in self._orders:
            rng = np.random.default_rng([self.seed, 1_000_003, epoch])
            self._orders = {epoch: rng.permutation(len(self.dataset))}
        return self._orders[epoch]

    def evaluation(self, batch_size: int, limit: int | None = None) -> Iterator[Batch]:
        """Every contact once, in order; the last batch may be smaller."""
        size = len(self.dataset) if limit is None else min(limit, len(self.dataset))
        for step, start in enumerate(range(0, size, batch_size)):
            yield self.batch(np.arange(start, min(start + batch_size, size)), step)

    def cloud(
        self, height_mm: NDArray[np.float32], sensor: SensorSpec, rng: np.random.Generator
    ) -> NDArray[np.float32]:
        """One cloud of clean heights: shape (side², 3), scaled, in lattice order.

        Noise takes the zero of heights away, as photometric sensors lose it; a cloud without noise
        is a perfect sensor's, whose heights count from the untouched gel.
        """
        how = self.augmentation
        spread = spread_of(sensor)
        gain = spread.gain_log_ratio if rng.random() < how.uncalibrated else 0.0
        unit = None
        if how.noise_level > 0 and not (how.clean > 0 and rng.random() < how.clean):
            unit = NoiseUnit.draw(rng, how.noise_level, gain_log_ratio=gain, spread=spread)
        if sensor.markers is not None:
            sparse = marker_cloud(height_mm, sensor, unit=unit, rng=rng)
            dense = densified(sparse, rng=rng, num_points=self.sampling.side**2)
            return scaled(dense.points_mm, sensor)
        if unit is not None:
            height_mm = unit.apply(height_mm, sensor, rng)
        return scaled(sampled(height_mm, sensor, self.sampling, rng), sensor)


def mirrored(
    state: ContactState, sensor: SensorSpec, *, along_x: bool, along_y: bool
) -> ContactState:
    """The state of the mirror image of a contact; no shape or texture has a handedness."""
    if not state.in_contact or not (along_x or along_y):
        return state
    x_mm = -state.x_mm if along_x else state.x_mm
    y_mm = -state.y_mm if along_y else state.y_mm
    flipped = set()
    for side in state.cut:
        turns = along_x if side in (Side.LEFT, Side.RIGHT) else along_y
        flipped.add(MIRROR[side] if turns else side)
    return dataclasses.replace(
        state,
        x_mm=x_mm,
        y_mm=y_mm,
        position=position_word(x_mm, y_mm, sensor),
        cut=frozenset(flipped),
    )


def sampled(
    height_mm: NDArray[np.float32],
    sensor: SensorSpec,
    sampling: Sampling,
    rng: np.random.Generator,
) -> NDArray[np.float32]:
    """Points of a height map over the whole field, shape (side², 3) [mm], in lattice order.

    ``cltp.tactile.cloud.cloud_from_heights`` without its checks, in float32: it runs at every pass.
    """
    rows, columns = height_mm.shape
    u, v = sampling.places(height_mm, rng)
    row = np.clip(v * rows - 0.5, 0, rows - 1)
    column = np.clip(u * columns - 0.5, 0, columns - 1)
    r0 = np.minimum(row.astype(np.int32), rows - 2)
    c0 = np.minimum(column.astype(np.int32), columns - 2)
    fr, fc = row - r0, column - c0
    flat = np.ascontiguousarray(height_mm).ravel()
    at = r0 * columns + c0
    top = flat[at] * (1 - fc) + flat[at + 1] * fc
    bottom = flat[at + columns] * (1 - fc) + flat[at + columns + 1] * fc
    z = top + (bottom - top) * fr
    return np.stack([(u - 0.5) * sensor.width_mm, (0.5 - v) * sensor.height_mm, z], axis=1)
