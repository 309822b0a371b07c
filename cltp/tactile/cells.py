"""A cloud averaged in equal cells of the sensing area, and what is computed on such a grid.

Contact test, direct measurement, registration and encoders all work on cells, so that any density
and order of points will do. For encoders no cell stays empty (``height_grid``): data sets, files
and the loop all come through that one function. Loads no torch.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.interpolate import CloughTocher2DInterpolator, LinearNDInterpolator

from cltp.tactile.cloud import FloatArray, TactileCloud, grid_axes_mm, heights_at
from cltp.tactile.markers import interpolated
from cltp.tactile.point_layout import PointLayout
from cltp.tactile.sensors import SensorSpec

Grid = NDArray[np.float32]
"""Heights in cells of the sensing area [mm], row 0 = top."""

LEAST_FILLED = 0.5
"""Fraction of the cells of a ``height_grid`` that must hold a point of their own. Our choice: a
sensor that loses 30 % of its pixels stays above it, a cloud of 1024 loose points below."""

MAX_CELLS = 32
"""Most cells along either side. Constants of the measurement are fitted with so many: more would
resolve finer contacts and average less noise."""

PICTURE_CELLS = 64
"""Cells along either side of a picture of a grid of pixels."""


def cells_of(cloud: TactileCloud) -> int:
    """Cells along either side of the sensing area, of which each holds at least about one point."""
    return min(MAX_CELLS, math.isqrt(len(cloud.points_mm)))


def cell_means(cloud: TactileCloud, n: int | None = None) -> FloatArray:
    """Mean indentation in n × n cells over the sensing area [mm], NaN where there is no point.

    By default n is ``cells_of`` the cloud. Pixels of a grid count by their area in each cell.
    """
    n = cells_of(cloud) if n is None else n
    if cloud.grid is not None:
        rows, columns = cloud.grid
        heights = cloud.points_mm[:, 2].reshape(rows, columns)
        return np.asarray(_overlaps(rows, n) @ heights @ _overlaps(columns, n).T)
    count, total = _sums(cloud, n, n)
    with np.errstate(invalid="ignore"):
        return np.asarray(total / count)


def _sums(cloud: TactileCloud, rows: int, columns: int) -> tuple[NDArray[np.intp], FloatArray]:
    """Number of points in each cell and the sum of their heights, (rows, columns) each."""
    sensor, points = cloud.sensor, cloud.points_mm.astype(np.float64)
    column = ((points[:, 0] / sensor.width_mm + 0.5) * columns).astype(int)
    row = ((0.5 - points[:, 1] / sensor.height_mm) * rows).astype(int)
    index = np.clip(row, 0, rows - 1) * columns + np.clip(column, 0, columns - 1)
    count = np.bincount(index, minlength=rows * columns)
    total = np.bincount(index, weights=points[:, 2], minlength=rows * columns).astype(np.float64)
    return count.reshape(rows, columns), total.reshape(rows, columns)


@lru_cache(maxsize=16)
def _overlaps(pixels: int, n: int) -> FloatArray:
    """Fraction of each of n equal cells that each of some equal pixels covers, (n, pixels)."""
    cells, edges = np.arange(n)[:, None] / n, np.arange(pixels)[None, :] / pixels
    common = np.minimum(cells + 1 / n, edges + 1 / pixels) - np.maximum(cells, edges)
    weights = n * np.clip(common, 0.0, None)
    weights.setflags(write=False)
    return weights


def filled(cells_mm: FloatArray) -> FloatArray:
    """Cells (n, n) [mm] where each one without a point has the value of the nearest with one."""
    empty = ~np.isfinite(cells_mm)
    if not empty.any():
        return cells_mm
    nearest = ndimage.distance_transform_edt(empty, return_distances=False, return_indices=True)
    return np.asarray(cells_mm[tuple(nearest)])


def pictured_heights(cloud: TactileCloud) -> FloatArray:
    """Heights for pictures [mm], row 0 = top, none of them empty: finer where pixels allow it."""
    n = cells_of(cloud) if cloud.grid is None else PICTURE_CELLS
    return filled(cell_means(cloud, n))


def less_heights(cloud: TactileCloud, cells_mm: FloatArray) -> TactileCloud:
    """The cloud less the heights of n × n cells of the sensing area [mm], linear between them."""
    points = cloud.points_mm.copy()
    if cloud.grid is None:
        x_mm, y_mm = points[:, 0].astype(np.float64), points[:, 1].astype(np.float64)
        points[:, 2] -= heights_at(cells_mm, x_mm, y_mm, cloud.sensor)
    else:
        rows, columns = (_between(len(cells_mm), pixels) for pixels in cloud.grid)
        points[:, 2] -= (rows @ cells_mm @ columns.T).ravel().astype(np.float32)
    return replace(cloud, points_mm=points)


@lru_cache(maxsize=16)
def _between(n: int, pixels: int) -> FloatArray:
    """Weights (pixels, n) of n equal cells in the middles of pixels, linear between the cells."""
    place = np.clip((np.arange(pixels) + 0.5) * n / pixels - 0.5, 0, n - 1)
    weights = np.clip(1 - np.abs(place[:, None] - np.arange(n)), 0.0, None)
    weights.setflags(write=False)
    return weights


def smoothed(cells_mm: FloatArray, sensor: SensorSpec, scale_mm: float) -> FloatArray:
    """Averages of the known cells with a Gaussian of width ``scale_mm``, shape (n, n) [mm]."""
    sigma = (
        scale_mm * cells_mm.shape[0] / sensor.height_mm,
        scale_mm * cells_mm.shape[1] / sensor.width_mm,
    )
    known = np.isfinite(cells_mm)
    if known.all():
        return blurred(cells_mm, sigma)
    weight = blurred(known.astype(np.float64), sigma)
    return np.asarray(blurred(np.where(known, cells_mm, 0.0), sigma) / np.maximum(weight, 1e-6))


def blurred(cells: FloatArray, sigma: tuple[float, float]) -> FloatArray:
    """Cells (H, W) after a Gaussian of so many rows and columns, the edges going on as they are.

    Two products of matrices; a filter that goes along each row takes ten times as long.
    """
    rows, columns = (_gaussian(size, each) for size, each in zip(cells.shape, sigma, strict=True))
    return np.asarray(rows @ cells @ columns.T)


@lru_cache(maxsize=64)
def _gaussian(size: int, sigma: float) -> FloatArray:
    """What a Gaussian takes of each of a row of cells, (size, size)."""
    weights = ndimage.gaussian_filter1d(np.eye(size), sigma, axis=0, mode="nearest")
    weights.setflags(write=False)
    return weights


@lru_cache(maxsize=8)
def quadratic_basis(n: int, sensor: SensorSpec) -> FloatArray:
    """1, x, y, x², xy, y² in the cells, (n², 6), of positions from -1 to 1 along the width."""
    x, y = (axis / (sensor.width_mm / 2) for axis in grid_axes_mm(sensor, n, n))
    x, y = np.meshgrid(x, y)
    functions = (np.ones_like(x), x, y, x * x, x * y, y * y)
    basis = np.stack([each.ravel() for each in functions], axis=1)
    basis.setflags(write=False)
    return basis


def height_grid(cloud: TactileCloud, layout: PointLayout) -> Grid:
    """Heights of any cloud in the cells that its pad takes of a layout: (rows, columns) [mm]."""
    rows, columns = layout.cells_on(cloud.sensor.width_mm, cloud.sensor.height_mm)
    if cloud.grid is not None:
        return resampled(cloud.points_mm[:, 2].reshape(cloud.grid), rows, columns)
    count, total = _sums(cloud, rows, columns)
    if np.count_nonzero(count) >= LEAST_FILLED * count.size:
        return without_holes(total / np.maximum(count, 1), count > 0)
    smooth = cloud.sensor.markers is not None  # a surface seen at its markers is smooth between
    x, y = np.meshgrid(*grid_axes_mm(cloud.sensor, rows, columns))
    surface = CloughTocher2DInterpolator if smooth else LinearNDInterpolator
    return interpolated(cloud, x, y, surface).astype(np.float32)


def resampled(
    height_mm: NDArray[np.floating],
    rows: int,
    columns: int,
    known: NDArray[np.bool_] | None = None,
) -> Grid:
    """A map of the whole sensing area, shape (H, W) [mm], in other cells.

    Args:
        height_mm: The map, row 0 = top.
        rows: Number of the cells along y.
        columns: Number of the cells along x.
        known: Shape (H, W), the pixels that were measured; all when not given. Cells without one
            have the mean of their neighbours.
    """
    heights = np.asarray(height_mm, dtype=np.float32)
    down, across = _weights(heights.shape[0], rows), _weights(heights.shape[1], columns)
    if known is None:
        return _product(down, heights, across)
    weight = _product(down, known.astype(np.float32), across)
    total = _product(down, np.where(known, heights, np.float32(0)), across)
    return without_holes(total / np.maximum(weight, 1e-6), weight > 1e-3)


def without_holes(heights: NDArray[np.floating], known: NDArray[np.bool_]) -> Grid:
    """A grid whose unknown cells are the means of the known ones around, from the edges inwards.

    Args:
        heights: Shape (rows, columns); any finite value where it is not known.
        known: Shape (rows, columns), at least one True.
    """
    heights = np.where(known, heights, 0).astype(np.float32)
    while not known.all():
        total, count = sums_around(heights), sums_around(known.astype(np.float32))
        reached = ~known & (count > 0)
        heights[reached] = total[reached] / count[reached]
        known = known | reached
    return heights


def sums_around(cells: Grid) -> Grid:
    """Sums over 3 × 3 cells."""
    padded = np.pad(cells, 1)
    rows = padded[:-2] + padded[1:-1] + padded[2:]
    return np.asarray(rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:], dtype=np.float32)


def _product(down: Grid | None, heights: Grid, across: Grid | None) -> Grid:
    if down is not None:
        heights = down @ heights
    return heights if across is None else heights @ across.T


@lru_cache(maxsize=32)
def _weights(pixels: int, cells: int) -> Grid | None:
    """Weights (cells, pixels) of a row of pixels in a row of cells; None where they are the same.

    Overlaps where pixels are smaller than cells, else linear interpolation between pixel centres.
    """
    if pixels == cells:
        return None
    if pixels > cells:
        weights = _overlaps(pixels, cells).astype(np.float32)
    else:
        at = np.clip((np.arange(cells)[:, None] + 0.5) * pixels / cells - 0.5, 0, pixels - 1)
        between = 1 - np.abs(at - np.arange(pixels)[None, :])
        weights = np.clip(between, 0, None).astype(np.float32)
    weights.setflags(write=False)
    return weights
