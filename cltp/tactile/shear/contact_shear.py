"""What a shear field tells of a held contact in a few arithmetic passes: force, shear, slip cues.

``ShearWatch`` follows one grip frame by frame. It keeps a mean of the heights, which change only
with the grip's force, and the last displacements along the gel. The cues of slip are the shape of
the displacement (a stuck contact is carried along alike, a sliding one most in its middle), the
ratio of displacement to indentation, how it changed, and how far the indentation moved.

Not here: the judgement (``cltp.tactile.shear.slip``), what follows from it (``policies.reflex``).
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField

RINGS = (0.0, 0.6, 1.1, 1.6, 2.2, 3.2)
"""Edges of the rings about a contact's centre, over its radius. Our choice: two in the contact."""

HEIGHT_MEMORY = 0.1
"""Least weight of a new frame in the mean of heights, which is that of all frames at first. Our
choice: ten frames, a tenth of a second."""

LAG = 3
"""Frames between two displacements whose difference is a change."""

_SMALL = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearCues:
    """A contact as one frame, with those before it, shows it.

    Attributes:
        along_mm: Displacement of the gel in the middle of the contact, (x, y) [mm].
        depth_mm: Largest mean indentation [mm].
        volume_mm3: Mean indentation times area [mm³], which grows with the normal force.
        values: Shape (NUM_VALUES,): the cues of slip, of order 1.
    """

    along_mm: tuple[float, float]
    depth_mm: float
    volume_mm3: float
    values: FloatArray


class ShearWatch:
    """Follows the shear field of one grip.

    Args:
        sensor: A sensor that measures shear.
        along_mm, depth_mm: Standard deviations of a point's displacement along the gel and into it,
            from frame to frame [mm].
    """

    def __init__(self, sensor: SensorSpec, along_mm: float, depth_mm: float) -> None:
        self._sensor, self._noise_mm = sensor, (along_mm, depth_mm)
        self._grid = grid_of(sensor)
        self._height_mm: FloatArray | None = None
        self._counts = np.zeros(self._grid.count)
        self._along: deque[FloatArray] = deque(maxlen=2 * LAG + 1)
        self._found: deque[FloatArray] = deque(maxlen=2 * LAG + 1)

    @property
    def num_frames(self) -> int:
        """Frames kept so far, at most ``2 LAG + 1``."""
        return len(self._along)

    def renew(self) -> None:
        """Begin the mean of heights anew: the force is about to change, or the body has slid."""
        self._counts = np.zeros(self._grid.count)

    def see(self, field: ShearField) -> ShearCues | None:
        """Take a frame; the cues, or None where it shows no contact yet."""
        grid = self._grid
        cells = grid.cells_of(field.positions_mm)
        moved, found = np.zeros((grid.count, 3)), np.zeros(grid.count)
        moved[cells], found[cells] = field.displacement_mm, 1.0
        self._keep(moved, found)
        height = self._height_mm
        assert height is not None  # kept just now
        shape = _Shape.of(height, grid)
        if shape is None:
            return None
        return self._cues(shape, moved[:, 2], found)

    def _keep(self, moved: FloatArray, found: FloatArray) -> None:
        if self._height_mm is None:
            self._height_mm = np.zeros(self._grid.count)
        self._counts += found
        weight = found * np.maximum(HEIGHT_MEMORY, 1.0 / np.maximum(self._counts, 1.0))
        self._height_mm += weight * (moved[:, 2] - self._height_mm)
        self._along.append(moved[:, :2])
        self._found.append(found)

    def _middle(self, shape: _Shape, first: int, last: int) -> FloatArray:
        """Mean displacement in the middle of the contact over some kept frames, (2,) [mm]."""
        along, found = list(self._along)[first:last], list(self._found)[first:last]
        if not along:
            return np.zeros(2)
        weight = shape.middle * np.array(found)
        total = np.einsum("fn,fnk->k", weight, np.array(along))
        return np.asarray(total / max(float(weight.sum()), _SMALL))

    def _cues(self, shape: _Shape, height_mm: FloatArray, found: FloatArray) -> ShearCues:
        along_noise, depth_noise = self._noise_mm
        count = len(self._along)
        now = self._middle(shape, max(0, count - 2), count)
        size = float(np.linalg.norm(now))
        to = now / max(size, _SMALL)
        earlier = self._middle(shape, max(0, count - 2 - LAG), max(1, count - LAG)) @ to
        earliest = self._middle(shape, 0, max(1, count - 2 * LAG)) @ to
        noise = along_noise * shape.middle_noise
        scale = max(size, 3 * noise, _SMALL)
        ratio = size / max(shape.depth_mm, _SMALL)
        weight = np.array(list(self._found)[-2:])
        drawn = np.array(list(self._along)[-2:]) @ to
        seen = weight.sum(axis=0)
        profile = (weight * drawn).sum(axis=0) / np.maximum(seen, _SMALL)
        has = seen > 0
        rings = [_mean(profile, ring * has) / scale for ring in shape.rings]
        twofold = shape.twofold(to)
        quadrupole = [_mean(profile * twofold, ring * has) / scale for ring in shape.rings[1:4]]
        shift_mm, shift_noise = shape.shift(height_mm, self._height_mm, found, to)
        values = [
            math.log1p(size / max(noise, _SMALL)) / 3,
            ratio / 3,
            (size - earlier) / scale,
            (earlier - earliest) / scale,
            noise / scale,
            *rings[1:],
            *quadrupole,
            *shape.numbers(to),
            float(np.clip(shift_mm, -2, 2)),
            math.log1p(10 * shift_noise * depth_noise) / 2,
            float(np.clip(shift_mm / max(shift_noise * depth_noise, _SMALL), -10, 10)) / 5,
        ]
        return ShearCues(
            along_mm=(float(now[0]), float(now[1])),
            depth_mm=shape.depth_mm,
            volume_mm3=shape.volume_mm3,
            values=np.array(values),
        )


def _mean(values: FloatArray, weight: FloatArray) -> float:
    return float((weight * values).sum() / max(float(weight.sum()), _SMALL))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PointGrid:
    """Points of a sensor: rows × columns, positions (N,) [mm], from the top left row by row."""

    rows: int
    columns: int
    x: FloatArray
    y: FloatArray
    pitch_x: float
    pitch_y: float
    half: tuple[float, float]

    @property
    def count(self) -> int:
        return self.rows * self.columns

    def cells_of(self, positions_mm: NDArray[np.float32]) -> NDArray[np.intp]:
        """Numbers of the points at some positions, (N, 2) [mm]."""
        column = np.rint((positions_mm[:, 0] - self.x[0]) / self.pitch_x)
        row = np.rint((self.y[0] - positions_mm[:, 1]) / self.pitch_y)
        column = np.clip(column, 0, self.columns - 1).astype(np.intp)
        return np.clip(row, 0, self.rows - 1).astype(np.intp) * self.columns + column

    def slopes(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Derivatives along x and y."""
        by_row, by_column = np.gradient(values.reshape(self.rows, self.columns))
        return (by_column / self.pitch_x).ravel(), (-by_row / self.pitch_y).ravel()


@lru_cache
def grid_of(sensor: SensorSpec) -> PointGrid:
    """The points of a sensor that measures shear."""
    rows, columns = sensor.shear_grid or (0, 0)
    x, y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(sensor, rows, columns)))
    return PointGrid(
        rows=rows,
        columns=columns,
        x=x,
        y=y,
        pitch_x=sensor.width_mm / columns,
        pitch_y=sensor.height_mm / rows,
        half=(sensor.width_mm / 2, sensor.height_mm / 2),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Shape:
    """Shape of an indentation: its middle, rings about it, its ellipse, its slopes."""

    grid: PointGrid
    depth_mm: float
    volume_mm3: float
    height_mm: FloatArray
    middle: FloatArray
    middle_noise: float
    rings: tuple[FloatArray, ...]
    angle: FloatArray
    centre: tuple[float, float]
    radius_mm: float
    axes: tuple[float, float]  # (difference of the second moments over their sum) × (cos, sin) 2θ

    @classmethod
    def of(cls, height_mm: FloatArray, grid: PointGrid) -> _Shape | None:
        """The shape of mean heights; None where nothing is indented."""
        level = float(np.median(height_mm))
        height = height_mm - min(level, 0.0)
        depth = float(np.sort(height)[-3:].mean())
        if depth <= _SMALL:
            return None
        body = np.clip(height - 0.3 * depth, 0.0, None)
        total = float(body.sum())
        if total <= 0:
            return None
        x0, y0 = float(body @ grid.x) / total, float(body @ grid.y) / total
        dx, dy = grid.x - x0, grid.y - y0
        xx, yy, xy = (float(body @ each) / total for each in (dx * dx, dy * dy, dx * dy))
        cell = (grid.pitch_x**2 + grid.pitch_y**2) / 24  # of the points' own spacing
        xx, yy = xx + cell / 2, yy + cell / 2
        radius = math.sqrt(max(2 * (xx + yy), 1.0))
        trace, det = xx + yy, max(xx * yy - xy * xy, 0.05)
        reach = np.sqrt(np.maximum((yy * dx * dx + xx * dy * dy - 2 * xy * dx * dy) / det, 0.0) / 2)
        edges = pairwise(RINGS)
        rings = tuple(((reach >= low) & (reach < high)).astype(float) for low, high in edges)
        middle = np.exp(-((reach / 0.8) ** 2))
        middle /= middle.sum()
        return cls(
            grid=grid,
            depth_mm=depth,
            volume_mm3=total * grid.pitch_x * grid.pitch_y,
            height_mm=height,
            middle=middle,
            middle_noise=float(np.sqrt((middle**2).sum() / 2)),
            rings=rings,
            angle=np.arctan2(dy, dx),
            centre=(x0, y0),
            radius_mm=radius,
            axes=((xx - yy) / trace, 2 * xy / trace),
        )

    def twofold(self, to: FloatArray) -> FloatArray:
        """Cosine of twice the angle to a direction, shape (N,)."""
        return np.cos(2 * (self.angle - math.atan2(to[1], to[0])))

    def numbers(self, to: FloatArray) -> list[float]:
        """Size, elongation along a direction, nearness of the pad's edge, fall-off of heights."""
        heading = 2 * math.atan2(to[1], to[0])
        elongation = self.axes[0] * math.cos(heading) + self.axes[1] * math.sin(heading)
        gap = min(half - abs(at) for half, at in zip(self.grid.half, self.centre, strict=True))
        falls = [_mean(self.height_mm, ring) / self.depth_mm for ring in self.rings[1:]]
        bend = math.hypot(*self.axes)
        return [self.radius_mm / 5, elongation, bend, gap / (3 * self.radius_mm), *falls]

    def shift(
        self, height_mm: FloatArray, mean_mm: FloatArray | None, found: FloatArray, to: FloatArray
    ) -> tuple[float, float]:
        """How far the indentation moved along a direction, and the noise of that.

        Returns:
            Shift by least squares beside a change of depth [mm]; its standard deviation over that
            of a height.
        """
        slope_x, slope_y = self.grid.slopes(self.height_mm)
        slope = -(slope_x * to[0] + slope_y * to[1]) * found
        scaled = self.height_mm * found
        change = (height_mm - (self.height_mm if mean_mm is None else mean_mm)) * found
        ss, sh, hh = float(slope @ slope), float(slope @ scaled), float(scaled @ scaled)
        det = ss * hh - sh * sh
        if det <= 1e-9 * max(ss * hh, _SMALL):
            return 0.0, 1e3
        shift = (hh * float(slope @ change) - sh * float(scaled @ change)) / det
        return shift, math.sqrt(hh / det)


NUM_VALUES = 5 + 4 + 3 + 4 + 4 + 3
"""Number of cues."""
