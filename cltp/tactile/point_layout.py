"""How the points lie that an encoder takes: the paper's 1024 even ones, or a grid of all heights.

Loads no torch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cltp.errors import TouchError
from cltp.tactile.cloud import NUM_POINTS


@dataclass(frozen=True, slots=True, kw_only=True)
class PointLayout:
    """Points of an encoder: one for each of rows × columns equal cells of the sensing area.

    Attributes:
        rows: Cells along y, from the top.
        columns: Cells along x, from the left.
        is_sampled: Whether a cell's point is one of the cloud's own, wherever it lies in the cell.
            Otherwise it is the cell's centre, and its height the mean of all heights measured
            there.
        pitch_mm: Edge of a cell [mm], the same on every pad that fits: a smaller pad takes fewer
            cells, in the middle, and a larger one has larger cells. None stretches the cells to
            the pad, whatever its proportions.

    Raises:
        TouchError: Fewer than 2 rows or columns.
    """

    rows: int
    columns: int
    is_sampled: bool = False
    pitch_mm: float | None = None

    def __post_init__(self) -> None:
        if min(self.rows, self.columns) < 2:
            raise TouchError(f"a layout needs at least 2 rows and columns, got {self}")

    @property
    def num_points(self) -> int:
        return self.rows * self.columns

    def cells_on(self, width_mm: float, height_mm: float) -> tuple[int, int]:
        """Rows and columns that a pad takes, the rest on all sides of it alike."""
        if self.pitch_mm is None:
            return self.rows, self.columns
        pitch_mm = max(self.pitch_mm, width_mm / self.columns, height_mm / self.rows)
        rows, columns = (
            most - 2 * round((most - side_mm / pitch_mm) / 2)
            for most, side_mm in ((self.rows, height_mm), (self.columns, width_mm))
        )
        return max(rows, 2 + self.rows % 2), max(columns, 2 + self.columns % 2)


LATTICE = math.isqrt(NUM_POINTS)
"""Cells of the even layout along either side of the sensing area."""

EVEN = PointLayout(rows=LATTICE, columns=LATTICE, is_sampled=True)
"""The paper's: 1024 points, uniformly."""

GRID = PointLayout(rows=75, columns=100, pitch_mm=0.2)
"""All that a sensor measures, in cells of 0.2 mm; a GelSight Mini fills it. Our choice: the pitch
of the simulated contacts; the textures in them have periods from 0.6 mm. Stretched to pads of other
proportions, an encoder took every pad for the one that it knew: places along the width were 16 to
76 % off."""
