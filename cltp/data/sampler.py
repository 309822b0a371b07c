"""Batches of noisy clouds with their labels, drawn from a data set anew at every pass.

Loads no torch.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from cltp.data.dataset import ContactDataset
from cltp.data.placement import draw_placement, move
from cltp.data.windows import crop, draw_window
from cltp.errors import TouchError
from cltp.tactile.cells import height_grid, resampled
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import grid_points, in_lattice, scaled, unscaled
from cltp.tactile.markers import densified, marker_cloud
from cltp.tactile.noise_levels import NoiseLevels, NoiseRange
from cltp.tactile.point_layout import EVEN, PointLayout
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import ContactState, Side, position_word

MOST_COARSE = 1.7
"""Largest factor on the edge of a cell that windows are drawn with: that of a pad of 34 × 25 mm."""

COARSE_PITCH_MM = (0.4, 2.2)
"""Range of the edges of a coarse sensor's taxels [mm], log-uniform. Our choice: arrays of pressure
sensors have 1 to 2 mm."""

LEAST_COARSE = 13
"""Fewest taxels along either side of a coarse sensor: a cloud has at least 64 points, and up to
three in ten are lost."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """Samples for one step of learning.

    Attributes:
        index: Shape (B,), indices of the contacts in their data set.
        points: Shape (B, N, 3), float32, scaled, row by row in the sampler's layout.
        height_mm: Clean heights behind each cloud, mirrored and moved alike; for rendering.
        sensors: Their sensors.
        states: Labels, mirrored and moved alike; forces are those of the sensor's nominal gel.
        mirror: Shape (B, 2), bool: mirrored along x, along y.
        moved: Shape (B,), bool: shifted, turned or seen by a smaller pad after that.
        layout: Layout of the points.
    """

    index: NDArray[np.int64]
    points: NDArray[np.float32]
    height_mm: list[NDArray[np.float32]]
    sensors: list[SensorSpec]
    states: list[ContactState]
    mirror: NDArray[np.bool_]
    moved: NDArray[np.bool_]
    layout: PointLayout = EVEN

    def cloud(self, row: int) -> TactileCloud:
        """The cloud that one row of the points is of."""
        return unscaled(self.points[row], self.sensors[row], self.layout)


@dataclass(frozen=True, slots=True, kw_only=True)
class Augmentation:
    """Random variation of contacts.

    Attributes:
        noise_level: ``level`` of ``NoiseUnit.draw``, one for all errors or one for each; 0 leaves
            the heights clean. A range draws the level of each error anew for each sample.
        uncalibrated: Fraction of samples whose unit also has unequal gradient gains.
        mirror: Whether contacts are mirrored along x, along y and along both.
        clean: Fraction of samples without noise, as of a perfect sensor.
        loose: Fraction of samples of which a grid is given 1024 points alone, as clouds in files
            have them; an even layout always has so many.
        windows: Fraction of samples that a smaller pad sees (``cltp.data.windows``), half of
            these in larger cells.
        coarse: Fraction of samples whose grid is felt by a few taxels instead of pixels
            (``COARSE_PITCH_MM``): half by means over areas, half in points alone.

    Raises:
        TouchError: A fraction is not between 0 and 1.
    """

    noise_level: float | NoiseLevels | NoiseRange = 1.0
    uncalibrated: float = 0.25
    mirror: bool = True
    clean: float = 0.0
    loose: float = field(default=0.0, repr=False)  # see ``identity``
    windows: float = field(default=0.0, repr=False)
    coarse: float = field(default=0.0, repr=False)

    def __post_init__(self) -> None:
        for name in ("uncalibrated", "clean", "loose", "windows", "coarse"):
            if not 0 <= (value := getattr(self, name)) <= 1:
                raise TouchError(f"{name} must be a fraction from 0 to 1, got {value}")

    @property
    def identity(self) -> str:
        """All values in one line; unchanged for those that are older than the last three."""
        last = {"loose": self.loose, "windows": self.windows, "coarse": self.coarse}
        return str(self) + "".join(f" {name} {value}" for name, value in last.items() if value)

    @property
    def is_noisy(self) -> bool:
        """Whether samples have any noise, but for the ``clean`` ones."""
        return self.noise_level != 0

    def draw_levels(self, rng: np.random.Generator) -> float | NoiseLevels:
        """The level of one sample's noise."""
        level = self.noise_level
        return level.draw(rng) if isinstance(level, NoiseRange) else level


CLEAN = Augmentation(noise_level=0.0, uncalibrated=0.0, mirror=False)
NOISY = Augmentation(uncalibrated=0.0, mirror=False)
"""Noise of a calibrated unit, as of the simulated sensor: for validation and evaluation."""


class Sampler:
    """Draws batches from a data set; the same seed gives the same batches.

    Args:
        dataset: Source of the contacts.
        augmentation: Variation of the contacts.
        seed: Random seed of order, variation, noise and points.
        layout: Layout of the points.
        moved: Fraction of contacts that are shifted and turned on the pad
            (``cltp.data.placement``).
        also_fraction: Fraction of each numbered batch that comes from the further folders of the
            data set; None draws every contact equally often.

    Raises:
        TouchError: The fraction is not between 0 and 1, or one of the two parts has no contacts.
    """

    def __init__(
        self,
        dataset: ContactDataset,
        augmentation: Augmentation | None = None,
        *,
        seed: int = 0,
        layout: PointLayout = EVEN,
        moved: float = 0.0,
        also_fraction: float | None = None,
    ) -> None:
        self.dataset, self.layout, self.moved = dataset, layout, moved
        self.augmentation = augmentation or Augmentation()
        self.seed = seed
        self._also_fraction = also_fraction
        self._orders: dict[int, tuple[int, NDArray[np.int64]]] = {}
        if also_fraction is not None:
            _check_fraction(also_fraction, dataset)

    def batch(self, indices: NDArray[np.int64], step: int) -> Batch:
        """The samples of some contacts; their variation depends on the seed and ``step``."""
        rng = np.random.default_rng([self.seed, step])
        points, heights, sensors, states = [], [], [], []
        mirror = rng.random((len(indices), 2)) < (0.5 if self.augmentation.mirror else 0.0)
        moved = np.zeros(len(indices), dtype=np.bool_)
        if self.moved > 0:  # else nothing is drawn: later draws must stay reproducible
            moved = rng.random(len(indices)) < self.moved
        for row, (index, (along_x, along_y)) in enumerate(zip(indices, mirror, strict=True)):
            sensor = sensor_named(self.dataset.column("sensor")[index])
            height_mm = self.dataset.height_mm(int(index))
            height_mm = height_mm[:: -1 if along_y else 1, :: -1 if along_x else 1]
            state = self.dataset.nominal_state(int(index))
            state = mirrored(state, sensor, along_x=bool(along_x), along_y=bool(along_y))
            if moved[row]:
                placement = draw_placement(height_mm, state, sensor, rng)
                result = move(height_mm, state, sensor, placement)
                height_mm, state = result.height_mm, result.state
            layout = self.layout
            if self.augmentation.windows > 0 and rng.random() < self.augmentation.windows:
                window = draw_window(height_mm, state, sensor, rng)
                seen = crop(height_mm, state, sensor, window)
                height_mm, state, sensor = seen.height_mm, seen.state, seen.sensor
                layout = coarser(layout, rng)
                moved[row] = True
            points.append(self.cloud(height_mm, sensor, rng, layout))
            heights.append(height_mm)
            sensors.append(sensor)
            states.append(state)
        return Batch(
            index=np.asarray(indices),
            points=np.stack(points),
            height_mm=heights,
            sensors=sensors,
            states=states,
            mirror=mirror,
            moved=moved,
            layout=self.layout,
        )

    def numbered(self, batch_size: int, step: int) -> Batch:
        """The batch of step ``step`` of a training: each epoch is every contact once, shuffled.

        With a fraction of further contacts, these and the others have epochs of their own.
        """
        if self._also_fraction is None:
            return self.batch(self._drawn(batch_size, step, 0, len(self.dataset)), step)
        num_also = self.dataset.num_also
        num_first = len(self.dataset) - num_also
        if batch_size < 2:
            raise TouchError(
                "a batch of one contact can't be mixed: choose more than one contact for each "
                "process, or leave --also-fraction out"
            )
        # Neither is left out, however small its fraction.
        drawn_also = min(max(1, round(self._also_fraction * batch_size)), batch_size - 1)
        first = self._drawn(batch_size - drawn_also, step, 0, num_first)
        also = self._drawn(drawn_also, step, num_first, num_also)
        return self.batch(np.concatenate([first, also]), step)

    def _drawn(self, count: int, step: int, offset: int, size: int) -> NDArray[np.int64]:
        """``count`` of the ``size`` contacts from ``offset`` on, of their own endless order."""
        positions = range(step * count, (step + 1) * count)
        order = (self._order(each // size, offset, size)[each % size] for each in positions)
        return np.fromiter(order, dtype=np.int64, count=count)

    def _order(self, epoch: int, offset: int, size: int) -> NDArray[np.int64]:
        if self._orders.get(offset, (None,))[0] != epoch:
            rng = np.random.default_rng(
                [self.seed, 1_000_003, epoch, *([offset] if offset else [])]
            )
            self._orders[offset] = (epoch, offset + rng.permutation(size))
        return self._orders[offset][1]

    def cloud(
        self,
        height_mm: NDArray[np.float32],
        sensor: SensorSpec,
        rng: np.random.Generator,
        layout: PointLayout | None = None,
    ) -> NDArray[np.float32]:
        """One cloud of clean heights: shape (N, 3), scaled, row by row in a layout.

        With noise the median height is 0, since photometric sensors lose the constant. A cloud
        without noise is that of a perfect sensor, whose heights count from the untouched gel.
        """
        unit = self._unit(sensor, rng)
        if self.layout.is_sampled:
            return self._sampled(height_mm, sensor, unit, rng)
        layout = layout or self.layout
        return grid_points(self._grid(height_mm, sensor, unit, rng, layout), sensor, layout)

    def _unit(self, sensor: SensorSpec, rng: np.random.Generator) -> NoiseUnit | None:
        """The errors of one sample; None for a perfect sensor."""
        varied, spread = self.augmentation, spread_of(sensor)
        gain = spread.gain_log_ratio if rng.random() < varied.uncalibrated else 0.0
        if not varied.is_noisy or (varied.clean > 0 and rng.random() < varied.clean):
            return None
        return NoiseUnit.draw(rng, varied.draw_levels(rng), gain_log_ratio=gain, spread=spread)

    def _grid(
        self,
        height_mm: NDArray[np.float32],
        sensor: SensorSpec,
        unit: NoiseUnit | None,
        rng: np.random.Generator,
        layout: PointLayout,
    ) -> NDArray[np.float32]:
        """Heights in the cells that the pad takes of the layout [mm], of all that it gives."""
        if self.augmentation.coarse > 0 and rng.random() < self.augmentation.coarse:
            taxels = _taxels(sensor, rng)
            if rng.random() < 0.5:
                sensor = dataclasses.replace(sensor, markers=taxels)
            else:
                height_mm = resampled(height_mm, *taxels)
        if sensor.markers is not None:
            return height_grid(marker_cloud(height_mm, sensor, unit=unit, rng=rng), layout)
        if unit is not None:
            height_mm = unit.apply(height_mm, sensor, rng)
        if self.augmentation.loose > 0 and rng.random() < self.augmentation.loose:
            points = sampled(height_mm, sensor, EVEN, rng).astype(np.float32)
            if unit is not None:
                points = unit.received(points, rng)
            return height_grid(TactileCloud(points_mm=points, sensor=sensor), layout)
        known = None
        if unit is not None and unit.point_loss > 0:
            known = rng.random(height_mm.shape, np.float32) >= unit.point_loss
        rows, columns = layout.cells_on(sensor.width_mm, sensor.height_mm)
        return resampled(height_mm, rows, columns, known)

    def _sampled(
        self,
        height_mm: NDArray[np.float32],
        sensor: SensorSpec,
        unit: NoiseUnit | None,
        rng: np.random.Generator,
    ) -> NDArray[np.float32]:
        """One point in each cell of the layout, scaled."""
        if sensor.markers is not None:
            sparse = marker_cloud(height_mm, sensor, unit=unit, rng=rng)
            dense = densified(sparse, rng=rng, num_points=self.layout.num_points)
            return scaled(dense.points_mm, sensor)
        if unit is not None:
            height_mm = unit.apply(height_mm, sensor, rng)
        points = sampled(height_mm, sensor, self.layout, rng)
        if unit is not None and (unit.point_loss > 0 or unit.shuffled):
            points = in_lattice(unit.received(points.astype(np.float32), rng), sensor)
        return scaled(points, sensor)


def _taxels(sensor: SensorSpec, rng: np.random.Generator) -> tuple[int, int]:
    """Rows and columns of a coarse sensor of the same pad."""
    pitch_mm = math.exp(rng.uniform(*np.log(COARSE_PITCH_MM)))
    rows, columns = sensor.height_mm / pitch_mm, sensor.width_mm / pitch_mm
    return max(LEAST_COARSE, round(rows)), max(LEAST_COARSE, round(columns))


def coarser(layout: PointLayout, rng: np.random.Generator) -> PointLayout:
    """A layout with larger cells, as on a larger pad; half of the time, and one of cells alone."""
    if layout.pitch_mm is None or rng.random() < 0.5:
        return layout
    factor = math.exp(rng.uniform(0.0, math.log(MOST_COARSE)))
    return dataclasses.replace(layout, pitch_mm=factor * layout.pitch_mm)


def _check_fraction(also_fraction: float, dataset: ContactDataset) -> None:
    if not 0 < also_fraction < 1:
        raise TouchError(f"also_fraction must lie between 0 and 1, got {also_fraction:g}")
    if not 0 < dataset.num_also < len(dataset):
        raise TouchError(
            f"{dataset.num_also} of {len(dataset)} contacts to learn from are of the further data "
            "set; a fraction of each needs both: name one with --also whose contacts are of the "
            "split train"
        )


def mirrored(
    state: ContactState, sensor: SensorSpec, *, along_x: bool, along_y: bool
) -> ContactState:
    """The state of the mirror image of a contact; no shape or texture has a handedness."""
    if not state.in_contact or not (along_x or along_y):
        return state
    x_mm = -state.x_mm if along_x else state.x_mm
    y_mm = -state.y_mm if along_y else state.y_mm
    swapped = (Side.LEFT, Side.RIGHT) * along_x + (Side.TOP, Side.BOTTOM) * along_y
    return dataclasses.replace(
        state,
        x_mm=x_mm,
        y_mm=y_mm,
        position=position_word(x_mm, y_mm, sensor),
        cut=frozenset(side.opposite if side in swapped else side for side in state.cut),
    )


def sampled(
    height_mm: NDArray[np.float32],
    sensor: SensorSpec,
    layout: PointLayout,
    rng: np.random.Generator,
) -> NDArray[np.float32]:
    """Points of a height map of the whole sensing area, one at random in each cell of a layout.

    Shape (N, 3) [mm], row by row. ``cltp.tactile.cloud.cloud_from_heights`` without its checks, in
    float32: it runs at every pass.
    """
    rows, columns = height_mm.shape
    down, across = np.divmod(np.arange(layout.num_points), layout.columns)
    jitter = rng.random((2, layout.num_points), np.float32)
    u = (across.astype(np.float32) + jitter[0]) / layout.columns
    v = (down.astype(np.float32) + jitter[1]) / layout.rows
    row = np.clip(v * rows - 0.5, 0, rows - 1)
    column = np.clip(u * columns - 0.5, 0, columns - 1)
    r0 = np.minimum(row.astype(np.int32), rows - 2)
    c0 = np.minimum(column.astype(np.int32), columns - 2)
    fr, fc = row - r0, column - c0
    flat = np.ascontiguousarray(height_mm).ravel()
    corner = r0 * columns + c0
    top = flat[corner] * (1 - fc) + flat[corner + 1] * fc
    bottom = flat[corner + columns] * (1 - fc) + flat[corner + columns + 1] * fc
    z = top + (bottom - top) * fr
    return np.stack([(u - 0.5) * sensor.width_mm, (0.5 - v) * sensor.height_mm, z], axis=1)
