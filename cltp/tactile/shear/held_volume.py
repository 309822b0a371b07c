"""How much a held contact has grown since it was at rest, without the gel's slow drift.

Heights drift within a hold: by as much as a light contact is deep, in four seconds. Drift is broad,
a contact is not, so that a smooth surface through the change of the points around the contact is
taken from all of them. What a sensor feels in one frame is then the force before, times the growth.

Not here: the force of a contact at rest (``cltp.tactile.measure``), the cues of slip
(``cltp.tactile.shear.contact_shear``).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.shear.contact_shape import grid_of
from cltp.tactile.shear.contact_shear import HEIGHT_MEMORY
from cltp.tactile.shear.field import ShearField

LEVEL = 0.3
"""Fraction of the depth above which the volume counts, as ``contact_shear`` has it."""

CONTACT = 0.1
"""Fraction of the depth from which a point belongs to the contact or its rim. Our choice."""

MIN_AROUND = 36
"""Fewest points around a contact that tell the drift: six for each of the surface's numbers."""


class HeldVolume:
    """Follows the indentation of one hold.

    Args:
        quiet: Frames of the contact at rest, of one sensor, one at least.
    """

    def __init__(self, quiet: Sequence[ShearField]) -> None:
        self._grid = grid_of(quiet[0].sensor)
        x, y = self._grid.x / self._grid.half[0], self._grid.y / self._grid.half[1]
        self._surface = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)
        total, counts = np.zeros(self._grid.count), np.zeros(self._grid.count)
        for each in quiet:
            cells = self._grid.cells_of(each.positions_mm)
            total[cells] += each.displacement_mm[:, 2]
            counts[cells] += 1.0
        self._rest_mm = total / np.maximum(counts, 1.0)
        self._height_mm, self._count = self._rest_mm.copy(), float(len(quiet))
        self._around = self._rest_mm < CONTACT * _depth(self._rest_mm)
        self._rest_volume = _volume(self._rest_mm)

    def renew(self) -> None:
        """Begin the mean of heights anew: the force is about to change."""
        self._count = 0.0

    def growth(self, field: ShearField) -> float | None:
        """Volume over that at rest after another frame; None where nothing was indented at rest."""
        self._count += 1.0
        cells = self._grid.cells_of(field.positions_mm)
        weight = max(HEIGHT_MEMORY, 1.0 / self._count)
        self._height_mm[cells] += weight * (field.displacement_mm[:, 2] - self._height_mm[cells])
        if self._rest_volume <= 0:
            return None
        change = self._height_mm - self._rest_mm
        return _volume(self._rest_mm + change - self._drift(change)) / self._rest_volume

    def _drift(self, change: FloatArray) -> FloatArray:
        """The smooth surface through the change around the contact; 0 with too little around it."""
        if int(self._around.sum()) < MIN_AROUND:
            return np.zeros_like(change)
        fit, *_ = np.linalg.lstsq(self._surface[self._around], change[self._around], rcond=None)
        return np.asarray(self._surface @ fit)


def _depth(height_mm: FloatArray) -> float:
    return float(np.sort(height_mm)[-3:].mean())


def _volume(height_mm: FloatArray) -> float:
    """Sum of the heights above a fraction of the depth [mm]; 0 where nothing is indented."""
    height = height_mm - min(float(np.median(height_mm)), 0.0)
    depth = _depth(height)
    return float(np.clip(height - LEVEL * depth, 0.0, None).sum()) if depth > 0 else 0.0
