"""Solids turned and moved to their pose.

Not here: the solids (``sim.objects.solids``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from torch import Tensor

from sim.objects.faces import Cell, Vector, constant
from sim.objects.solids import Solid, stacked_as


@dataclass(frozen=True, slots=True)
class Placed:
    """A solid turned by ``turn`` (its rows: the solid's axes in the new frame), then moved [mm]."""

    solid: Solid
    move: Vector = (0.0, 0.0, 0.0)
    turn: tuple[Vector, Vector, Vector] | None = None

    @property
    def cells(self) -> tuple[Cell, ...]:
        return self.solid.cells

    @property
    def reach_mm(self) -> float:
        return self.solid.reach_mm + math.hypot(*self.move)

    @property
    def max_slope(self) -> float:
        return self.solid.max_slope

    def _to_local(self, points: Tensor) -> Tensor:
        local = points - constant(self.move, points.dtype, points.device)
        if self.turn is None:
            return local
        x, y, z = local.unbind(-1)
        # Not a matrix product: its rounding may depend on the number of points.
        return stacked_as(points, *(x * a + y * b + z * c for a, b, c in self.turn))

    def distance(self, points: Tensor) -> Tensor:
        return self.solid.distance(self._to_local(points))

    def cell(self, points: Tensor) -> Tensor:
        return self.solid.cell(self._to_local(points))


_ALONG: dict[str, tuple[Vector, Vector, Vector]] = {
    "x": ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)),
    "y": ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
    "-z": ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)),
}


def moved(solid: Solid, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Placed:
    """Move a solid [mm]."""
    if isinstance(solid, Placed):
        a, b, c = solid.move
        return replace(solid, move=(a + x, b + y, c + z))
    return Placed(solid, (x, y, z))


def along(axis: str, solid: Solid) -> Placed:
    """Turn a solid so that its z axis lies along ``axis``: 'x', 'y' or '-z'."""
    return Placed(solid, turn=_ALONG[axis])
