"""The geometry of a contact, from which it is labelled: surface over the pad, where it touches.

With measures of masks on a grid, such as pieces, length and width, and of a gap over a mask. Rows
run downwards. Not here: the labels (``sim.tcl3d.shape_labels``, ``sim.tcl3d.labels``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, binary_fill_holes, label

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.objects.faces import Cell

Mask = NDArray[np.bool_]

_CRUMB = 0.12  # fraction of the largest piece up to which pieces don't count
_DEGREES = range(0, 90, 5)  # orientations of bounding rectangles


def covered_fraction(mask: Mask) -> float:
    """Fraction of the grid that a mask covers."""
    return int(np.count_nonzero(mask)) / mask.size


def count_pieces(mask: Mask) -> int:
    """Number of connected pieces of a mask (not empty), crumbs not counted."""
    parts, num = label(mask, structure=np.ones((3, 3)))
    if num == 1:
        return 1
    sizes = np.bincount(parts[mask])[1:]
    return int((sizes > _CRUMB * sizes.max()).sum())


def count_enclosed_points(mask: Mask) -> int:
    """Number of grid points in holes of a mask."""
    return int(np.count_nonzero(binary_fill_holes(mask) & ~mask))


def border_fraction(mask: Mask) -> float:
    """Fraction of a mask's outline that is the border of the grid."""
    count = np.count_nonzero
    border = count(mask[0]) + count(mask[-1]) + count(mask[:, 0]) + count(mask[:, -1])
    inner = count(mask[1:] != mask[:-1]) + count(mask[:, 1:] != mask[:, :-1])
    return border / max(border + 0.8 * inner, 1)  # a staircase is longer than its line


def circle_fraction(mask: Mask) -> float:
    """Fraction of a circle, fitted to a thin mask, that the mask covers."""
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
    """Smallest rectangle around a mask: sides [mm], direction of the longer one [rad]."""

    length: float
    width: float
    angle: float


_COS, _SIN = (
    np.array([[function(math.radians(degrees))] for degrees in _DEGREES])
    for function in (math.cos, math.sin)
)


def bounding_rectangle(mask: Mask, pitch_mm: float) -> BoundingRectangle:
    """Smallest rectangle around a mask (H, W), not empty, in steps of 5°."""
    # In any orientation it touches the mask at the first or the last point of a row.
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
    """Angle between two undirected lines [rad]."""
    difference = (first - second) % math.pi
    return min(difference, math.pi - difference)


def slopes(gap_mm: FloatArray, mask: Mask, pitch_mm: float) -> tuple[FloatArray, FloatArray]:
    """Slopes of a gap (H, W) at the points of a mask, (N,): down the rows, and along them."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    if not len(rows):
        return np.zeros(0), np.zeros(0)
    # A margin of one point is needed for the differences.
    high, wide = (
        slice(max(0, int(occupied[0]) - 1), int(occupied[-1]) + 2) for occupied in (rows, columns)
    )
    down, right = np.gradient(gap_mm[high, wide], pitch_mm)
    return np.asarray(down)[mask[high, wide]], np.asarray(right)[mask[high, wide]]


def curvatures(gap_mm: FloatArray, mask: Mask, pitch_mm: float) -> tuple[float, float]:
    """Principal curvatures [1/mm], smaller first, of a quadric fitted to a gap over a mask."""
    row, column = np.nonzero(mask)
    x, y = (column - column.mean()) * pitch_mm, (row.mean() - row) * pitch_mm
    terms = np.stack([x * x, x * y, y * y, x, y, np.ones_like(x)], axis=1)
    (a, b, c, p, q, _), *_ = np.linalg.lstsq(terms, gap_mm[mask], rcond=None)
    first = np.array([[1 + p * p, p * q], [p * q, 1 + q * q]])
    second = np.array([[2 * a, b], [b, 2 * c]]) / math.sqrt(1 + p * p + q * q)
    low, high = np.sort(np.linalg.eigvals(np.linalg.solve(first, second)).real)
    return float(low), float(high)


_NEARBY_MM = 0.3  # largest gap of surface that is about to touch


class ShapeLabel(NamedTuple):
    """A shape, and whether a careful person would give this label without doubt."""

    shape: Shape
    sure: bool

    def sure_if(self, condition: bool) -> ShapeLabel:
        """The same label, unsure unless ``condition`` holds as well."""
        return ShapeLabel(self.shape, self.sure and condition)


@dataclass(frozen=True, kw_only=True)
class ContactGeometry:
    """Surface over the pad, and where it touches.

    Attributes:
        gap_mm: Shape (H, W), distance of the bare surface behind its foremost point [mm].
        cells: Shape (H, W), index of the cell at each point, -1 where there is no surface.
        cell_table: Cells by index.
        touching: Shape (H, W), mask of points under pressure.
        closed: ``touching`` with fine gaps closed (``sim.tcl3d.labels.in_contact``).
        depth_mm: Largest indentation [mm].
        pitch_mm: Pitch of the grid [mm].
    """

    gap_mm: FloatArray
    cells: NDArray[np.int64]
    cell_table: Sequence[Cell]
    touching: Mask
    closed: Mask
    depth_mm: float
    pitch_mm: float

    @cached_property
    def counts(self) -> NDArray[np.int64]:
        """Number of touching grid points of each cell, shape (len(cell_table),)."""
        return self.count_cells(self.touching)

    def rectangle(self, mask: Mask) -> BoundingRectangle:
        """Smallest rectangle around a mask (H, W), not empty."""
        return bounding_rectangle(mask, self.pitch_mm)

    def count_cells(self, mask: Mask) -> NDArray[np.int64]:
        """Number of grid points of each cell in a mask (H, W), shape (len(cell_table),)."""
        return np.bincount(self.cells[mask] + 1, minlength=len(self.cell_table) + 1)[1:]


def with_nearby_surface(contact: ContactGeometry) -> ContactGeometry:
    """Add the surface just behind a contact that is no larger than the fillet of an edge."""
    nearby = binary_dilation(contact.touching, iterations=4)
    touching = contact.touching | (nearby & (contact.gap_mm < _NEARBY_MM))
    closed = contact.closed | touching
    depth_mm = max(contact.depth_mm, 1.5 * _NEARBY_MM)
    return replace(contact, touching=touching, closed=closed, depth_mm=depth_mm)
