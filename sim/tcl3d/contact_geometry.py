"""A contact as it is named: what lies over the pad, and where it touches.

Not here: its name (``sim.tcl3d.shape_labels``, ``sim.tcl3d.texture_labels``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.states import Shape
from sim.objects.faces import Cell
from sim.tcl3d.masks import FloatArray, Mask, dilate

_NEARBY_MM = 0.3  # what counts as about to touch


class ShapeLabel(NamedTuple):
    """A shape, and whether a careful person would call it so without doubt."""

    shape: Shape
    sure: bool


@dataclass(frozen=True, kw_only=True)
class ContactGeometry:
    """What lies over the pad, and where it touches.

    Attributes:
        gap_mm: Shape (H, W), the bare surface behind its foremost point [mm].
        cells: Shape (H, W), number of the cell there, -1 where nothing is.
        table: Cells by number.
        touching: Shape (H, W), where pressure acts.
        closed: Same, fine gaps closed (``sim.tcl3d.labels.in_contact``).
        depth_mm: Largest indentation [mm].
        pitch_mm: Of the grid [mm].
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
        """Shape (len(table),): with how many grid points each cell touches."""
        return self.count_cells(self.touching)

    def count_cells(self, mask: Mask) -> NDArray[np.int64]:
        """Shape (len(table),): how many grid points of each cell lie in a mask (H, W)."""
        return np.bincount(self.cells[mask] + 1, minlength=len(self.cell_table) + 1)[1:]


def with_nearby_surface(contact: ContactGeometry) -> ContactGeometry:
    """A contact no larger than the fillet of an edge, with what lies just behind it."""
    nearby = dilate(contact.touching, 4)
    touching = contact.touching | (nearby & (contact.gap_mm < _NEARBY_MM))
    closed = contact.closed | touching
    depth_mm = max(contact.depth_mm, 1.5 * _NEARBY_MM)
    return replace(contact, touching=touching, closed=closed, depth_mm=depth_mm)
