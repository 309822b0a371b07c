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

    Raises:
        TouchError: Fewer than 2 rows or columns.
    """

    rows: int
    columns: int
    is_sampled: bool = False

    def __post_init__(self) -> None:
        if min(self.rows, self.columns) < 2:
            raise TouchError(f"a layout needs at least 2 rows and columns, got {self}")

    @property
    def num_points(self) -> int:
        return self.rows * self.columns


LATTICE = math.isqrt(NUM_POINTS)
"""Cells of the even layout along either side of the sensing area."""

EVEN = PointLayout(rows=LATTICE, columns=LATTICE, is_sampled=True)
"""The paper's: 1024 points, uniformly."""

GRID = PointLayout(rows=75, columns=100)
"""All that a sensor measures, in cells of 0.2 mm on a GelSight Mini. Our choice: the pitch of the
simulated contacts; the textures in them have periods from 0.6 mm."""
