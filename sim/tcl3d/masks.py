"""Measures of masks on a grid, such as pieces, length and width, and of a gap over one.

Rows run downwards. Not here: what a mask is called (``sim.tcl3d.shape_labels``).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

_CRUMB = 0.12  # of the largest piece: smaller ones don't count
_DEGREES = range(0, 90, 5)  # in which a rectangle is laid about a mask


def covered_fraction(mask: Mask) -> float:
    """Share of the grid that a mask covers."""
    return int(np.count_nonzero(mask)) / mask.size


def dilate(mask: Mask, times: int = 1) -> Mask:
    """A mask with the neighbours of its points above, below and beside, so many times over."""
    for _ in range(times):
        more = mask.copy()
        more[1:] |= mask[:-1]
        more[:-1] |= mask[1:]
        more[:, 1:] |= mask[:, :-1]
        more[:, :-1] |= mask[:, 1:]
        mask = more
    return mask


def count_pieces(mask: Mask) -> int:
    """Parts of a mask (not empty) that are more than crumbs of the largest one."""
    parts, num = label(mask, structure=np.ones((3, 3)))
    if num == 1:
        return 1
    sizes = np.bincount(parts[mask])[1:]
    return int((sizes > _CRUMB * sizes.max()).sum())


def count_enclosed_points(mask: Mask) -> int:
    """Grid points that a mask surrounds."""
    parts, num = label(~mask)
    at_border = np.unique(np.concatenate([parts[0], parts[-1], parts[:, 0], parts[:, -1]]))
    inside = ~np.isin(np.arange(num + 1), np.append(at_border, 0))
    return int(np.count_nonzero(inside[parts]))


def border_fraction(mask: Mask) -> float:
    """Share of a mask's outline that is the border of the grid."""
    count = np.count_nonzero
    border = count(mask[0]) + count(mask[-1]) + count(mask[:, 0]) + count(mask[:, -1])
    inner = count(mask[1:] != mask[:-1]) + count(mask[:, 1:] != mask[:, :-1])
    return border / max(border + 0.8 * inner, 1)  # stairs are longer than what they stand for


def circle_fraction(mask: Mask) -> float:
    """Share of a circle, fitted to a thin mask, along which the mask goes."""
    row, column = np.nonzero(mask)
    if len(row) < 8:
        return 0.0
    terms = np.stack([column, row, np.ones_like(row)], axis=1).astype(np.float64)
    square = (column**2 + row**2).astype(np.float64)
    fit, *_ = np.linalg.lstsq(terms, square, rcond=None)
    angle = np.arctan2(row - fit[1] / 2, column - fit[0] / 2)
    bins = np.unique(np.floor((angle + math.pi) / (2 * math.pi) * 36).astype(int) % 36)
    return len(bins) / 36


class BoundingRectangle(NamedTuple):
    """Smallest rectangle about a mask: sides [mm], direction of the longer [rad]."""

    length: float
    width: float
    angle: float


_COS, _SIN = (
    np.array([[function(math.radians(degrees))] for degrees in _DEGREES])
    for function in (math.cos, math.sin)
)


def bounding_rectangle(mask: Mask, pitch_mm: float) -> BoundingRectangle:
    """Smallest rectangle about a mask (not empty), to 5°.

    Args:
        mask: Shape (H, W).
        pitch_mm: Of the grid [mm].
    """
    # Whichever way it lies, it touches the mask at the first or the last point of a row.
    rows = np.flatnonzero(mask.any(axis=1))
    first = mask[rows].argmax(axis=1)
    last = mask.shape[1] - 1 - mask[rows, ::-1].argmax(axis=1)
    row, column = np.concatenate([rows, rows]), np.concatenate([first, last])
    u, v = column * _COS - row * _SIN, column * _SIN + row * _COS
    along, across = (np.ptp(u, axis=1) + 1) * pitch_mm, (np.ptp(v, axis=1) + 1) * pitch_mm
    best = int((along * across).argmin())
    sides = float(along[best]), float(across[best])
    angle = math.radians(_DEGREES[best] + (0 if sides[0] >= sides[1] else 90))
    return BoundingRectangle(max(sides), min(sides), angle)


def angle_between(first: float, second: float) -> float:
    """Angle between two directions without a sense [rad]."""
    difference = (first - second) % math.pi
    return min(difference, math.pi - difference)


def slopes(gap_mm: FloatArray, mask: Mask, pitch_mm: float) -> tuple[FloatArray, FloatArray]:
    """Slopes of a gap (H, W) at the points of a mask, (N,): down the rows, and along them."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    if not len(rows):
        return np.zeros(0), np.zeros(0)
    # With the neighbours that differences are taken to.
    high, wide = (
        slice(max(0, int(occupied[0]) - 1), int(occupied[-1]) + 2) for occupied in (rows, columns)
    )
    down, right = np.gradient(gap_mm[high, wide], pitch_mm)
    return np.asarray(down)[mask[high, wide]], np.asarray(right)[mask[high, wide]]


def curvatures(gap_mm: FloatArray, mask: Mask, pitch_mm: float) -> tuple[float, float]:
    """Principal curvatures [1/mm], smaller first, of a quadric fitted to part of a gap."""
    row, column = np.nonzero(mask)
    x, y = (column - column.mean()) * pitch_mm, (row.mean() - row) * pitch_mm
    terms = np.stack([x * x, x * y, y * y, x, y, np.ones_like(x)], axis=1)
    (a, b, c, p, q, _), *_ = np.linalg.lstsq(terms, gap_mm[mask], rcond=None)
    first = np.array([[1 + p * p, p * q], [p * q, 1 + q * q]])
    second = np.array([[2 * a, b], [b, 2 * c]]) / math.sqrt(1 + p * p + q * q)
    low, high = np.sort(np.linalg.eigvals(np.linalg.solve(first, second)).real)
    return float(low), float(high)
