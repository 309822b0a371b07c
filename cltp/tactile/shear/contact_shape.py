"""The shape of an indentation on a sensor's points: middle, rings, ellipse, slopes, motion.

Not here: what is dragged along in it (``cltp.tactile.shear.contact_shear``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.sensors import SensorSpec

RINGS = (0.0, 0.6, 1.1, 1.6, 2.2, 3.2)
"""Edges of the rings about a contact's centre, over its radius. Our choice: two in the contact."""

SMALL = 1e-6
"""Least divisor."""

SPOT_PITCHES, LEAST_AXIS_MM2 = 0.6, 0.3
"""Width of a spot in pitches of the points, and the least squared half axis of the ellipse that
spots are spread over [mm²]. Our choice."""

BODY_LEVEL = 0.3
"""Fraction of the depth above which the volume counts. Our choice: above the rim and the noise."""


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
        grid = values.reshape(self.rows, self.columns)
        by_row, by_column = _differences(grid), _differences(grid.T).T
        return (by_column / self.pitch_x).ravel(), (-by_row / self.pitch_y).ravel()


def above_level(height_mm: FloatArray) -> tuple[FloatArray, float]:
    """Heights (N,) above their median, where that is below 0, and the mean of the largest three."""
    ordered = np.sort(height_mm)
    level = min(0.0, float(ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2)
    return height_mm - level, float((ordered[-3:] - level).mean())


def _differences(grid: FloatArray) -> FloatArray:
    """Central differences along the rows' axis, one-sided at its ends."""
    change = np.empty_like(grid)
    change[1:-1] = (grid[2:] - grid[:-2]) / 2
    change[0], change[-1] = grid[1] - grid[0], grid[-1] - grid[-2]
    return change


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
class ContactShape:
    """Shape of an indentation: its middle, rings about it, its ellipse, its slopes.

    ``reach`` is the distance of a point from the middle, in the ellipse; a sphere's contact ends at
    1.2.
    """

    grid: PointGrid
    depth_mm: float
    volume_mm3: float
    height_mm: FloatArray
    middle: FloatArray
    middle_noise: float
    reach: FloatArray  # (N,)
    rings: FloatArray  # (rings, N)
    angle: FloatArray
    centre: tuple[float, float]
    radius_mm: float
    slopes: tuple[FloatArray, FloatArray]  # of the heights, along x and y
    axes: tuple[float, float]  # (difference of the second moments over their sum) × (cos, sin) 2θ

    @classmethod
    def of(cls, height_mm: FloatArray, grid: PointGrid) -> ContactShape | None:
        """The shape of mean heights; None where nothing is indented."""
        height, depth = above_level(height_mm)
        if depth <= SMALL:
            return None
        body = np.clip(height - BODY_LEVEL * depth, 0.0, None)
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
        rings = np.array([(reach >= low) & (reach < high) for low, high in edges], dtype=float)
        middle = np.exp(-((reach / 0.8) ** 2))
        middle /= middle.sum()
        return cls(
            grid=grid,
            depth_mm=depth,
            volume_mm3=total * grid.pitch_x * grid.pitch_y,
            height_mm=height,
            middle=middle,
            middle_noise=float(np.sqrt((middle**2).sum() / 2)),
            reach=reach,
            rings=rings,
            angle=np.arctan2(dy, dx),
            centre=(x0, y0),
            radius_mm=radius,
            slopes=grid.slopes(height),
            axes=((xx - yy) / trace, 2 * xy / trace),
        )

    def twofold(self, to: FloatArray) -> FloatArray:
        """Cosine of twice the angle to a direction, shape (N,)."""
        return np.cos(2 * (self.angle - math.atan2(to[1], to[0])))

    def weights_at(self, spots: FloatArray, to: FloatArray) -> FloatArray:
        """Weights (S, N) of the points about some spots of the contact, 0 for one beside the pad.

        Args:
            spots: Shape (S, 2), along and across a direction, in the ellipse of the contact.
            to: Shape (2,), the direction.
        """
        grid, half_trace = self.grid, self.radius_mm**2 / 4
        xx, yy, xy = 1 + self.axes[0], 1 - self.axes[0], self.axes[1]
        sizes, ways = np.linalg.eigh(2 * half_trace * np.array([[xx, xy], [xy, yy]]))
        root = (ways * np.sqrt(np.maximum(sizes, LEAST_AXIS_MM2))) @ ways.T
        turned = np.array([[to[0], to[1]], [-to[1], to[0]]])
        at = spots @ turned @ root.T + np.array(self.centre)
        off_x = (at[:, :1] - grid.x) / grid.pitch_x
        off_y = (at[:, 1:] - grid.y) / grid.pitch_y
        weights = np.exp(-(off_x**2 + off_y**2) / (2 * SPOT_PITCHES**2))
        weights /= np.maximum(weights.sum(axis=1, keepdims=True), SMALL)
        is_on_pad = (np.abs(at) <= np.array(grid.half)).all(axis=1)
        return np.asarray(weights * is_on_pad[:, None])

    def numbers(self, to: FloatArray) -> list[float]:
        """Size, elongation along a direction, nearness of the pad's edge, fall-off of heights."""
        heading = 2 * math.atan2(to[1], to[0])
        elongation = self.axes[0] * math.cos(heading) + self.axes[1] * math.sin(heading)
        gap = min(half - abs(at) for half, at in zip(self.grid.half, self.centre, strict=True))
        counts = np.maximum(self.rings.sum(axis=1), SMALL)
        falls = (self.rings @ self.height_mm)[1:] / counts[1:] / self.depth_mm
        bend = math.hypot(*self.axes)
        return [self.radius_mm / 5, elongation, bend, gap / (3 * self.radius_mm), *falls]

    def changes(
        self, changes_mm: FloatArray, found: FloatArray, to: FloatArray, noise_mm: float
    ) -> list[ContactChange]:
        """How far the indentation moved and how much it grew, by least squares.

        Args:
            changes_mm: Shape (K, N), changes of the heights [mm].
            found: Shape (N,), 1 at the points that have one.
            to: Shape (2,), a direction.
            noise_mm: Standard deviation of a change [mm].
        """
        slope_x, slope_y = self.slopes
        along = -(slope_x * to[0] + slope_y * to[1])
        across = slope_x * to[1] - slope_y * to[0]
        parts = np.stack([along, across, self.height_mm]) * found
        square = parts @ parts.T
        square[np.diag_indices(3)] = 1e-12 + (1 + 1e-6) * np.diag(square)
        inverse = np.linalg.inv(square)
        errors = noise_mm * np.sqrt(np.diag(inverse))
        return [
            ContactChange(*(float(each) for each in (*moved, *errors)))
            for moved in changes_mm @ parts.T @ inverse
        ]


class ContactChange(NamedTuple):
    """Motion of an indentation along and across a direction [mm], its relative growth, errors."""

    along_mm: float
    across_mm: float
    growth: float
    along_error_mm: float
    across_error_mm: float
    growth_error: float

    @property
    def over_errors(self) -> tuple[float, float, float]:
        """Motions and growth over their errors, of order 1."""
        along, across, growth = (
            max(-10.0, min(10.0, value / max(error, SMALL))) / 5
            for value, error in zip(self[:3], self[3:], strict=True)
        )
        return along, across, growth
