"""The geometry of a contact, from which it is labelled: surface over the pad, and where it touches.

Not here: the labels (``sim.tcl3d.shape_labels``, ``sim.tcl3d.texture_labels``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.objects.faces import Cell
from sim.tcl3d.masks import BoundingRectangle, Mask, bounding_rectangle

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
