"""Solids as signed distances, in torch: what objects are built of, and which part of them touches.

A solid tells how far a point is from its surface (negative inside) and which *cell* of it is
nearest: a face, a bar, a bump, a crest. A cell's ``Form`` says what it is called when it touches
(``sim.tcl3d.shape_labels``). Edges of a solid cut from faces are rounded by a fillet; where faces
meet at an angle other than 90° the distance is a bound, too small rather than too large; where it
may be too large, ``steep`` says by how much.

Points are tensors (..., 3) [mm]. Works on any device; on the same kind of device the result for a
point does not depend on its company.

Not here: the faces that solids are cut from (``sim.objects.faces``), solids of solids
(``sim.objects.booleans``), turning and moving (``sim.objects.placing``), objects
(``sim.objects.catalogue``), rays (``sim.objects.ray_casting``), textures (``sim.objects.skins``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import groupby
from typing import Protocol

import torch
from torch import Tensor

from sim.objects.faces import Cell, Face, Flat, Flats, Form, Ripple, Vector, constant


class Solid(Protocol):
    """A body with a surface."""

    @property
    def cells(self) -> tuple[Cell, ...]:
        """By the numbers that ``cell`` gives."""
        ...

    @property
    def reach_mm(self) -> float:
        """All of it lies within this distance of the origin [mm]."""
        ...

    @property
    def max_slope(self) -> float:
        """Largest slope of ``distance``: 1 where it is exact."""
        ...

    def distance(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of ``points`` (..., 3), shape (...)."""
        ...

    def cell(self, points: Tensor) -> Tensor:
        """Number of the nearest cell for ``points`` (..., 3) near the surface, int64 (...)."""
        ...


def stacked_as(points: Tensor, *coordinates: Tensor) -> Tensor:
    """Coordinates (...) as points (..., 3), laid out in memory as ``points`` are.

    Functions of a coordinate may differ in the last bit between layouts.
    """
    if points.stride(-1) == 1:
        return torch.stack(coordinates, dim=-1)
    return torch.stack(coordinates).movedim(0, -1)


_MOST_CRESTS = 64


@dataclass(frozen=True)
class Cut:
    """What lies behind all of its faces, its edges rounded by ``fillet`` [mm].

    Attributes:
        faces: At least one.
        fillet: Radius of its edges where faces meet at 90° [mm].
        reach_mm: See ``Solid``.
        leaning: Slope of the sum of squares that rounds the edges, where its faces lean most
            towards each other: 1 where they meet at 90°.
    """

    faces: tuple[Face, ...]
    fillet: float
    reach_mm: float
    leaning: float = 1.25

    @property
    def max_slope(self) -> float:
        """See ``Solid``: both bounds below are at most as steep as the distance."""
        return 1.0

    @property
    def cells(self) -> tuple[Cell, ...]:
        """One for each face; crests follow, each a cell."""
        crest = [face.cell for face in self.faces if isinstance(face, Ripple)]
        return (*(face.cell for face in self.faces), *crest * _MOST_CRESTS)

    @cached_property
    def _groups(self) -> tuple[Face | Flats, ...]:
        """Its faces in order, planes that follow each other together."""
        groups: list[Face | Flats] = []
        for _, alike in groupby(self.faces, key=lambda face: isinstance(face, Flat)):
            faces = list(alike)
            flats = [face for face in faces if isinstance(face, Flat)]
            groups += [Flats.of(flats)] if flats else faces
        return tuple(groups)

    def _behind(self, points: Tensor) -> Tensor:
        """Distance to each face, the faces first."""
        behind = [
            group.behind(points) if isinstance(group, Flats) else group.behind(points)[None]
            for group in self._groups
        ]
        return behind[0] if len(behind) == 1 else torch.cat(behind)

    def distance(self, points: Tensor) -> Tensor:
        """See ``Solid``."""
        behind = self._behind(points)
        rim = (behind + self.fillet).clamp_(min=0).square_().sum(0).sqrt_()
        foremost = behind.amax(0)
        rounded = foremost.clamp(max=-self.fillet) + rim
        return torch.maximum(foremost, rounded / self.leaning)

    def cell(self, points: Tensor) -> Tensor:
        """See ``Solid``."""
        behind = self._behind(points)
        foremost, nearest = behind[0], torch.zeros_like(behind[0], dtype=torch.int64)
        for number, own in enumerate(behind[1:], start=1):  # argmax over few is slow
            nearest = torch.where(own > foremost, number, nearest)
            foremost = torch.maximum(foremost, own)
        for number, face in enumerate(self.faces):
            if isinstance(face, Ripple):
                crest = torch.round(points[..., 0] / face.period).long() + _MOST_CRESTS // 2
                crest = crest.clamp(0, _MOST_CRESTS - 1) + len(self.faces)
                nearest = torch.where(nearest == number, crest, nearest)
        return nearest


@dataclass(frozen=True, slots=True)
class Oval:
    """Ellipsoid about the origin with three half axes [mm].

    Source: a first-order distance, |p/r| (|p/r| - 1) / |p/r²| (Quilez); too large beside flat ones.
    """

    x: float
    y: float
    z: float

    @property
    def max_slope(self) -> float:
        """See ``Solid``; measured, over a range of proportions."""
        return max(1.25, 0.77 * max(self.x, self.y, self.z) / min(self.x, self.y, self.z))

    @property
    def cells(self) -> tuple[Cell, ...]:
        """One, curved."""
        return (Cell(form=Form.CURVED),)

    @property
    def reach_mm(self) -> float:
        """Its longest half axis."""
        return max(self.x, self.y, self.z)

    def distance(self, points: Tensor) -> Tensor:
        """See ``Solid``."""
        radii = constant((self.x, self.y, self.z), points.dtype, points.device)
        once = (points / radii).square().sum(-1).sqrt()
        twice = (points / radii**2).square().sum(-1).sqrt()
        return once * (once - 1) / twice.clamp(min=1e-9)

    def cell(self, points: Tensor) -> Tensor:
        """See ``Solid``."""
        return torch.zeros(points.shape[:-1], dtype=torch.int64, device=points.device)


@dataclass(frozen=True, slots=True)
class Hoop:
    """Round tube bent to a ring about z, or to an arc of it that is symmetric about +x [mm]."""

    radius: float
    tube: float
    half_angle: float = math.pi
    form: Form = Form.LOOP
    max_slope: float = 1.0

    @property
    def cells(self) -> tuple[Cell, ...]:
        """One."""
        return (Cell(form=self.form),)

    @property
    def reach_mm(self) -> float:
        """Its outer radius."""
        return self.radius + self.tube

    def distance(self, points: Tensor) -> Tensor:
        """See ``Solid``."""
        x, y, z = points.unbind(-1)
        across = torch.hypot(torch.hypot(x, y) - self.radius, z)
        if self.half_angle < math.pi:
            end_x = x - self.radius * math.cos(self.half_angle)
            end_y = y.abs() - self.radius * math.sin(self.half_angle)
            to_end = (end_x**2 + end_y**2 + z**2).sqrt()
            across = torch.where(torch.atan2(y, x).abs() <= self.half_angle, across, to_end)
        return across - self.tube

    def cell(self, points: Tensor) -> Tensor:
        """See ``Solid``."""
        return torch.zeros(points.shape[:-1], dtype=torch.int64, device=points.device)


@lru_cache(maxsize=1024)
def _rods(
    ends: tuple[tuple[Vector, Vector], ...], dtype: torch.dtype, device: torch.device, ndim: int
) -> tuple[tuple[Tensor, ...], tuple[Tensor, ...], Tensor, bool]:
    """First ends of rods and ways to the others, x, y, z; squared lengths; whether all are balls.

    Each with ``ndim`` axes of 1 behind that of the rods.
    """
    each = (-1, *[1] * ndim)
    first, last = (constant(tuple(rod[i] for rod in ends), dtype, device) for i in (0, 1))
    along = last - first
    length = along.square().sum(-1).clamp(min=1e-9).view(each)
    start, component = (
        tuple(v.view(each) for v in vectors.unbind(-1)) for vectors in (first, along)
    )
    return start, component, length, not bool(along.any())


@dataclass(frozen=True, slots=True)
class Rods:
    """Round rods between pairs of points, each a cell: bars, wires, or one thick rod."""

    ends: tuple[tuple[Vector, Vector], ...]
    radius: float
    form: Form = Form.BAR
    max_slope: float = 1.0

    @property
    def cells(self) -> tuple[Cell, ...]:
        """One for each rod."""
        return (Cell(form=self.form),) * len(self.ends)

    @property
    def reach_mm(self) -> float:
        """Of the furthest end."""
        return max(math.hypot(*end) for rod in self.ends for end in rod) + self.radius

    def _squared(self, points: Tensor) -> Tensor:
        """Squared distance to the middle of each rod, the rods first."""
        x, y, z = points.unbind(-1)
        start, along, length, balls = _rods(self.ends, points.dtype, points.device, x.ndim)
        # Coordinate by coordinate: sums over an axis of three take several times as long.
        u, v, w = (at - of for at, of in zip((x, y, z), start, strict=True))
        if not balls:
            a, b, c = along
            share = ((u * a + v * b + w * c) / length).clamp_(0, 1)
            u, v, w = u - share * a, v - share * b, w - share * c
        return u * u + v * v + w * w

    def distance(self, points: Tensor) -> Tensor:
        """See ``Solid``."""
        return self._squared(points).amin(0).sqrt() - self.radius

    def cell(self, points: Tensor) -> Tensor:
        """See ``Solid``."""
        return self._squared(points).sqrt().argmin(0)


def dots(at: Sequence[tuple[float, float]], z: float, radius: float) -> Rods:
    """Balls of one radius whose centres lie at ``z`` [mm], each a cell."""
    return Rods(tuple(((x, y, z), (x, y, z)) for x, y in at), radius, Form.DOT)
