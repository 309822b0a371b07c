"""From clouds to what an encoder is given: points in its layout, scaled by constants.

Absolute x, y and z are kept: a cloud is never centred or scaled by its own extent, which would
destroy position, depth and area. Loads no torch.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from cltp.tactile.cells import height_grid
from cltp.tactile.cloud import NUM_POINTS, TactileCloud, cloud_of_pixels, heights_at
from cltp.tactile.point_layout import EVEN, LATTICE, PointLayout
from cltp.tactile.sensors import SensorSpec

GRID_UNIT_MM = 10.0
"""Length that becomes 1 in x and y of a grid: half the width of a GelSight Mini. The same for every
sensor, so that an encoder knows how large what it sees is."""

OUTSIDE = -8.0
"""Scaled height of a cell of a grid that lies beyond the pad; no gel bulges so far."""


def encoder_input(cloud: TactileCloud, layout: PointLayout = EVEN) -> NDArray[np.float32]:
    """Points of any cloud as an encoder takes them: shape (N, 3), scaled, row by row."""
    if layout.is_sampled:
        return scaled(lattice_points(cloud), cloud.sensor)
    return grid_points(height_grid(cloud, layout), cloud.sensor, layout)


def grid_points(
    height_mm: NDArray[np.float32], sensor: SensorSpec, layout: PointLayout
) -> NDArray[np.float32]:
    """Heights in the cells that a pad takes of a layout [mm], as scaled points (N, 3).

    The layout's other cells are ``OUTSIDE``, at the positions that they would have.
    """
    rows, columns = height_mm.shape
    top, left = (layout.rows - rows) // 2, (layout.columns - columns) // 2
    points = np.empty((layout.rows, layout.columns, 3), np.float32)
    x = (np.arange(layout.columns) - left + 0.5) / columns - 0.5
    y = 0.5 - (np.arange(layout.rows) - top + 0.5) / rows
    points[..., 0] = x[None, :] * (sensor.width_mm / GRID_UNIT_MM)
    points[..., 1] = y[:, None] * (sensor.height_mm / GRID_UNIT_MM)
    points[..., 2] = OUTSIDE
    inside = points[top : top + rows, left : left + columns]
    inside[..., 2] = height_mm / np.float32(sensor.max_depth_mm)
    return points.reshape(-1, 3)


def scaled(points_mm: NDArray[np.floating], sensor: SensorSpec) -> NDArray[np.float32]:
    """Scale points [mm, gel frame], shape (..., 3), by constants of the sensor.

    x and y are divided by half the width of the sensing area, so that x fills -1 .. 1 and shapes
    keep their proportions; z is divided by the sensor's ``max_depth_mm``.
    """
    unit_mm = _unit_mm(sensor, EVEN)
    factors = np.array([1 / unit_mm, 1 / unit_mm, 1 / sensor.max_depth_mm], dtype=np.float32)
    return np.asarray(points_mm, dtype=np.float32) * factors


def unscaled(
    points: NDArray[np.float32], sensor: SensorSpec, layout: PointLayout = EVEN
) -> TactileCloud:
    """The cloud of scaled points (N, 3) in a layout."""
    points = points[points[:, 2] > OUTSIDE / 2]
    unit_mm = _unit_mm(sensor, layout)
    factors = np.array([unit_mm, unit_mm, sensor.max_depth_mm], np.float32)
    return TactileCloud(points_mm=points * factors, sensor=sensor)


def _unit_mm(sensor: SensorSpec, layout: PointLayout) -> float:
    """Length that becomes 1 in x and y [mm]."""
    return sensor.width_mm / 2 if layout.is_sampled else GRID_UNIT_MM


def lattice_points(cloud: TactileCloud) -> NDArray[np.float32]:
    """The points of a cloud as ``in_lattice`` orders them; a coarser grid is interpolated."""
    if cloud.grid is None:
        return in_lattice(cloud.points_mm, cloud.sensor)
    if min(cloud.grid) >= LATTICE:
        return cloud.points_mm[_pixels(cloud.grid, cloud.sensor)]
    x, y = cell_centres(cloud.sensor).T.astype(np.float64)
    heights = cloud.points_mm[:, 2].astype(np.float64).reshape(cloud.grid)
    z = heights_at(heights, x, y, cloud.sensor)
    return np.stack([x, y, z], axis=1).astype(np.float32)


@lru_cache(maxsize=8)
def _pixels(grid: tuple[int, int], sensor: SensorSpec) -> NDArray[np.intp]:
    """Index (1024,) of the pixel that ``in_lattice`` takes for each cell, of a grid of pixels."""
    points = cloud_of_pixels(np.zeros(grid), sensor).points_mm.copy()
    points[:, 2] = np.arange(len(points))  # exact in float32 up to 16 million
    return in_lattice(points, sensor)[:, 2].astype(np.intp)


def in_lattice(points: NDArray[np.float32], sensor: SensorSpec) -> NDArray[np.float32]:
    """One point in each of 32 × 32 cells of the sensing area, from the top left row by row.

    Points that are stratified already are returned as they are. Otherwise each cell takes the own
    point nearest to its centre, whatever the order of the points. A cell without a point takes, at
    its centre, the mean of the four nearest points weighted by inverse distance.

    Args:
        points: Shape (N, 3), those of a ``TactileCloud`` [mm].
        sensor: Its sensor.

    Returns:
        Shape (1024, 3), float32 [mm].
    """
    column = np.floor((points[:, 0] / sensor.width_mm + 0.5) * LATTICE)
    row = np.floor((0.5 - points[:, 1] / sensor.height_mm) * LATTICE)
    cell = (np.clip(row, 0, LATTICE - 1) * LATTICE + np.clip(column, 0, LATTICE - 1)).astype(int)
    if len(points) == NUM_POINTS and np.array_equal(cell, np.arange(NUM_POINTS)):
        return points
    centres = cell_centres(sensor)
    squared_distance = ((points[:, :2] - centres[cell]) ** 2).sum(axis=1)
    order = np.lexsort((squared_distance, cell))
    filled, first = np.unique(cell[order], return_index=True)
    result = np.concatenate([centres, np.zeros((NUM_POINTS, 1), np.float32)], axis=1)
    result[filled] = points[order[first]]
    empty = np.setdiff1d(np.arange(NUM_POINTS), filled)
    if len(empty):
        distance, nearest = cKDTree(points[:, :2]).query(centres[empty], k=4)
        weights = 1 / np.maximum(distance, 1e-6)
        result[empty, 2] = (points[nearest, 2] * weights).sum(axis=1) / weights.sum(axis=1)
    return result


def cell_centres(sensor: SensorSpec) -> NDArray[np.float32]:
    """Centres of the 32 × 32 cells, shape (1024, 2) [mm], from the top left row by row."""
    steps = (np.arange(LATTICE, dtype=np.float32) + 0.5) / LATTICE - 0.5
    x, y = np.meshgrid(steps * sensor.width_mm, -steps * sensor.height_mm)
    return np.stack([x.ravel(), y.ravel()], axis=1).astype(np.float32)
