"""Points that stand alone: far above or below all points around, as no surface of a gel does.

A bad pixel or a lost marker gives such a point, and one of 1024 would move depth, place and area.
``cltp.tactile.cloud`` asks here for every cloud that is made. Loads no torch.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

STEEP, STEEPEST = 0.8, 3.0
"""Slopes from a point to each of its neighbours [mm per mm]: from the first on it stands alone
where the gel around it is not raised, from the second on anyhow. Source: the catalogue's objects,
tips, edges and wires of 0.5 mm among them, pressed 0.4 and 1.2 mm into every sensor: of 12,700
clouds with and without noise, 12 lost a point, all of them wide contacts or needles at 1.5 mm."""

HALO = 0.06
"""Height of the points next to one above those beyond them, over its own above these, from which a
needle raises them. Source: a punch of radius a displaces a gel at distance r by 2/π asin(a/r) of
its depth (Boussinesq), so that one of 0.5 mm comes to 0.14 among 1024 points of a GelSight Mini."""

LEAST_MM = 0.25
"""Height over all neighbours from which a point may stand alone [mm]: beyond the noise of training,
and beyond the simulated gel at its corners. Our choice: less hardly moves a contact."""

MANY = 0.01
"""Part of the points that may be replaced. More are left as they are. Our choice."""

_NEAR, _BEYOND = 8, 16  # points around one, and around these
_CELL_POINTS = 4  # points in a cell of the first look at loose points

_OFFSETS = np.array([(i, j) for i in range(-2, 3) for j in range(-2, 3) if (i, j) != (0, 0)])
_OFFSETS = _OFFSETS[np.argsort(np.abs(_OFFSETS).max(axis=1), kind="stable")]


def without_isolated(
    points_mm: NDArray[np.float32], size_mm: tuple[float, float], grid: tuple[int, int] | None
) -> tuple[NDArray[np.float32], int]:
    """Points whose isolated ones have the median height of their neighbours.

    Args:
        points_mm: Shape (N, 3), float32 [mm].
        size_mm: Width and height of the sensing area [mm].
        grid: (rows, columns) where the points are a regular grid, row by row.

    Returns:
        The points, and the number of isolated ones that were left, being too ``MANY``.
    """
    found, medians = _of_grid(points_mm, size_mm, grid) if grid else _of_loose(points_mm, size_mm)
    if not len(found):
        return points_mm, 0
    if len(found) > max(1, MANY * len(points_mm)):
        return points_mm, len(found)
    points_mm = points_mm.copy()
    points_mm[found, 2] = medians
    return points_mm, 0


def _of_grid(
    points_mm: NDArray[np.float32], size_mm: tuple[float, float], grid: tuple[int, int]
) -> tuple[NDArray[np.intp], NDArray[np.float32]]:
    """Indices of the isolated points of a grid, and the medians of the points around each."""
    (rows, columns), (width_mm, height_mm) = grid, size_mm
    pitch_mm = max(width_mm / columns, height_mm / rows)
    padded = np.full((rows + 4, columns + 4), np.nan, np.float32)
    padded[2:-2, 2:-2] = points_mm[:, 2].reshape(grid)
    near = padded[1:-1, 1:-1]
    beside = np.fmax(near[:, :-2], near[:, 2:])
    across = np.fmax(beside, near[:, 1:-1])
    above = near[1:-1, 1:-1] - np.fmax(beside[1:-1], np.fmax(across[:-2], across[2:]))
    beside = np.fmin(near[:, :-2], near[:, 2:])
    across = np.fmin(beside, near[:, 1:-1])
    below = np.fmin(beside[1:-1], np.fmin(across[:-2], across[2:])) - near[1:-1, 1:-1]
    found = np.flatnonzero(np.fmax(above, below) > max(LEAST_MM, STEEP * pitch_mm))
    if not len(found):
        return found, _NO_HEIGHTS
    row, column = np.divmod(found, columns)
    around = padded[row[:, None] + 2 + _OFFSETS[:, 0], column[:, None] + 2 + _OFFSETS[:, 1]]
    alone = _is_alone(points_mm[found, 2], around, np.float64(pitch_mm))
    return found[alone], np.nanmedian(around[alone, :_NEAR], axis=1)


def _of_loose(
    points_mm: NDArray[np.float32], size_mm: tuple[float, float]
) -> tuple[NDArray[np.intp], NDArray[np.float32]]:
    """The same of points in any order, of which only those far from the mean around are looked at.

    The first look takes the mean of 3 × 3 cells, the rest the nearest points.
    """
    spacing_mm = math.sqrt(size_mm[0] * size_mm[1] / len(points_mm))
    off_mm = np.abs(points_mm[:, 2] - _means_around(points_mm, size_mm))
    found = np.flatnonzero(off_mm > 0.5 * max(LEAST_MM, STEEP * spacing_mm))
    if not len(found):
        return found, _NO_HEIGHTS
    tree = cKDTree(points_mm[:, :2], compact_nodes=False, balanced_tree=False)
    distance, nearest = tree.query(points_mm[found, :2], k=1 + _NEAR + _BEYOND)
    around = np.where(nearest == found[:, None], np.nan, points_mm[nearest, 2])[:, 1:]
    reach_mm = np.clip(distance[:, 1 : 1 + _NEAR], spacing_mm, 1.5 * spacing_mm)
    alone = _is_alone(points_mm[found, 2], around, reach_mm)
    return found[alone], np.nanmedian(around[alone, :_NEAR], axis=1)


_NO_HEIGHTS = np.empty(0, np.float32)


def _is_alone(
    z: NDArray[np.float32], around: NDArray[np.float32], reach_mm: NDArray[np.float64] | np.float64
) -> NDArray[np.bool_]:
    """Which points (M,) no gel can show, by the heights around them, nearest first.

    Args:
        z: Their heights, shape (M,) [mm].
        around: Those of the points near and beyond, shape (M, 24), NaN where there is none [mm].
        reach_mm: Distance of the near ones, shape (M, 8) or one for all [mm].
    """
    near, beyond = around[:, :_NEAR], np.nanmedian(around[:, _NEAR:], axis=1)
    sign = np.sign(z - beyond)
    steps = sign[:, None] * (z[:, None] - near)

    def stands(slope: float) -> NDArray[np.bool_]:
        least_mm = np.maximum(LEAST_MM, slope * reach_mm)
        return np.asarray(((steps > least_mm) | np.isnan(steps)).all(axis=1))

    raised = sign * (np.nanmedian(near, axis=1) - beyond)
    return stands(STEEPEST) | (stands(STEEP) & (raised < HALO * np.abs(z - beyond)))


def _means_around(
    points_mm: NDArray[np.float32], size_mm: tuple[float, float]
) -> NDArray[np.float64]:
    """Mean height of the 3 × 3 cells around each point (N, 3), shape (N,) [mm]."""
    n = max(1, math.isqrt(len(points_mm) // _CELL_POINTS))
    column = np.clip((points_mm[:, 0] / size_mm[0] + 0.5) * n, 0, n - 1).astype(np.intp)
    row = np.clip((points_mm[:, 1] / size_mm[1] + 0.5) * n, 0, n - 1).astype(np.intp)
    cell = (row + 1) * (n + 2) + column + 1
    sums = [
        np.bincount(cell, weights, minlength=(n + 2) ** 2).reshape(n + 2, n + 2)
        for weights in (None, points_mm[:, 2])
    ]
    count, total = (
        (a := each[:-2] + each[1:-1] + each[2:])[:, :-2] + a[:, 1:-1] + a[:, 2:] for each in sums
    )
    return np.asarray((total / np.maximum(count, 1))[row, column])
