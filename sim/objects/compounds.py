"""Solids made of solids: turned and moved, blended into one, hollowed out, copied around an axis.

Not here: the basic solids (``sim.objects.solids``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import torch
from torch import Tensor

from sim.objects.faces import Cell, Form, Vector, constant
from sim.objects.solids import Solid, stacked_as


@dataclass(frozen=True, slots=True)
class Blend:
    """Union of several solids, their joints rounded by about ``radius`` [mm].

    Source: polynomial smooth minimum (Quilez); it is 1-Lipschitz where the parts are.
    """

    parts: tuple[Solid, ...]
    radius: float = 0.0

    @property
    def cells(self) -> tuple[Cell, ...]:
        return tuple(cell for part in self.parts for cell in part.cells)

    @property
    def reach_mm(self) -> float:
        return max(part.reach_mm for part in self.parts)

    @property
    def max_slope(self) -> float:
        return max(part.max_slope for part in self.parts)

    def distance(self, points: Tensor) -> Tensor:
        total = self.parts[0].distance(points)
        for part in self.parts[1:]:
            other = part.distance(points)
            lower = torch.minimum(total, other)
            if self.radius > 0:
                near = (1 - (total - other).abs() / (4 * self.radius)).clamp_(min=0)
                lower = lower - self.radius * near.square_()
            total = lower
        return total

    def cell(self, points: Tensor) -> Tensor:
        if len(self.parts) == 1:
            return self.parts[0].cell(points)
        distances = torch.stack([part.distance(points) for part in self.parts])
        cells = torch.stack([part.cell(points) for part in self.parts])
        counts = torch.tensor([0, *(len(part.cells) for part in self.parts[:-1])])
        first = counts.cumsum(0).to(points.device).view(-1, *[1] * (points.ndim - 1))
        return (cells + first).gather(0, distances.argmin(0)[None])[0]


@dataclass(frozen=True, slots=True)
class _OfOne:
    """A solid made of one, whose cells, reach and slope it has unless it says otherwise."""

    solid: Solid

    @property
    def cells(self) -> tuple[Cell, ...]:
        return self.solid.cells

    @property
    def reach_mm(self) -> float:
        return self.solid.reach_mm

    @property
    def max_slope(self) -> float:
        return self.solid.max_slope


@dataclass(frozen=True, slots=True)
class Hollow(_OfOne):
    """A solid less another one."""

    without: Solid

    @property
    def cells(self) -> tuple[Cell, ...]:
        return (*self.solid.cells, *(Cell(form=Form.CURVED) for _ in self.without.cells))

    @property
    def max_slope(self) -> float:
        return max(self.solid.max_slope, self.without.max_slope)

    def distance(self, points: Tensor) -> Tensor:
        return torch.maximum(self.solid.distance(points), -self.without.distance(points))

    def cell(self, points: Tensor) -> Tensor:
        cavity = -self.without.distance(points) > self.solid.distance(points)
        inner = self.without.cell(points) + len(self.solid.cells)
        return torch.where(cavity, inner, self.solid.cell(points))


@dataclass(frozen=True, slots=True)
class Around(_OfOne):
    """Copies of a solid that lies about +x, ``count`` of them spread evenly about z."""

    count: int

    @property
    def cells(self) -> tuple[Cell, ...]:
        return self.solid.cells * self.count

    def _fold(self, points: Tensor) -> tuple[Tensor, Tensor]:
        step = 2 * math.pi / self.count
        copy = torch.round(torch.atan2(points[..., 1], points[..., 0]) / step)
        cos, sin = torch.cos(copy * step), torch.sin(copy * step)
        x = points[..., 0] * cos + points[..., 1] * sin
        y = points[..., 1] * cos - points[..., 0] * sin
        return stacked_as(points, x, y, points[..., 2]), copy.long() % self.count

    def distance(self, points: Tensor) -> Tensor:
        return self.solid.distance(self._fold(points)[0])

    def cell(self, points: Tensor) -> Tensor:
        folded, copy = self._fold(points)
        return self.solid.cell(folded) + copy * len(self.solid.cells)


@dataclass(frozen=True, slots=True)
class Placed(_OfOne):
    """A solid turned by ``turn`` (its rows: the solid's axes in the new frame), then moved [mm]."""

    move: Vector = (0.0, 0.0, 0.0)
    turn: tuple[Vector, Vector, Vector] | None = None

    @property
    def reach_mm(self) -> float:
        return self.solid.reach_mm + math.hypot(*self.move)

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
