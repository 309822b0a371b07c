"""A cloud averaged in equal cells of the sensing area, and what is computed on such a grid.

Contact test, direct measurement and registration all work on cells, so that any density and order
of points will do. Loads no torch.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from scipy import ndimage

from cltp.tactile.cloud import FloatArray, TactileCloud, grid_axes_mm
from cltp.tactile.sensors import SensorSpec

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
    sensor, points = cloud.sensor, cloud.points_mm.astype(np.float64)
    column = np.clip(((points[:, 0] / sensor.width_mm + 0.5) * n).astype(int), 0, n - 1)
    row = np.clip(((0.5 - points[:, 1] / sensor.height_mm) * n).astype(int), 0, n - 1)
    index = row * n + column
    count = np.bincount(index, minlength=n * n)
    total = np.bincount(index, weights=points[:, 2], minlength=n * n)
    with np.errstate(invalid="ignore"):
        return np.asarray((total / count).reshape(n, n))


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


def smoothed(cells_mm: FloatArray, sensor: SensorSpec, scale_mm: float) -> FloatArray:
    """Averages of the known cells with a Gaussian of width ``scale_mm``, shape (n, n) [mm]."""
    sigma = (
        scale_mm * cells_mm.shape[0] / sensor.height_mm,
        scale_mm * cells_mm.shape[1] / sensor.width_mm,
    )
    known = np.isfinite(cells_mm)
    if known.all():
        return np.asarray(ndimage.gaussian_filter(cells_mm, sigma, mode="nearest"))
    weight = ndimage.gaussian_filter(known.astype(np.float64), sigma, mode="nearest")
    total = ndimage.gaussian_filter(np.where(known, cells_mm, 0.0), sigma, mode="nearest")
    return np.asarray(total / np.maximum(weight, 1e-6))


@lru_cache(maxsize=8)
def quadratic_basis(n: int, sensor: SensorSpec) -> FloatArray:
    """1, x, y, x², xy, y² in the cells, (n², 6), of positions from -1 to 1 along the width."""
    x, y = (axis / (sensor.width_mm / 2) for axis in grid_axes_mm(sensor, n, n))
    x, y = np.meshgrid(x, y)
    functions = (np.ones_like(x), x, y, x * x, x * y, y * y)
    basis = np.stack([each.ravel() for each in functions], axis=1)
    basis.setflags(write=False)
    return basis
