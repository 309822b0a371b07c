"""Solids as signed distances, in torch: the building blocks of objects.

A solid gives the distance of a point from its surface (negative inside) and the nearest *cell* of
that surface: a face, a bar, a bump, a crest. The cell's ``Form`` labels a contact
(``sim.tcl3d.shape_labels``). Edges of a solid cut from faces are rounded by a fillet; where faces
meet at an angle other than 90° the distance is a lower bound. Where it may be too large,
``max_slope`` is the largest factor.

Points are tensors (..., 3) [mm], on any device. On the same kind of device the result for a point
does not depend on the other points.

Not here: the faces that solids are cut from (``sim.objects.faces``), solids of solids
(``sim.objects.compounds``), objects (``sim.objects.catalogue``), rays
(``sim.objects.ray_casting``), textures (``sim.objects.skins``).
"""

from __future__ import annotations

import math
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
        """Cells of the surface, in the order of the indices that ``cell`` returns."""

    @property
    def reach_mm(self) -> float:
        """Largest distance of the surface from the origin [mm]."""

    @property
    def max_slope(self) -> float:
        """Largest slope of ``distance``: 1 where it is exact."""

    def distance(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of ``points`` (..., 3), shape (...)."""

    def cell(self, points: Tensor) -> Tensor:
        """Index of the nearest cell for ``points`` (..., 3) near the surface, int64 (...)."""


def stacked_as(points: Tensor, *coordinates: Tensor) -> Tensor:
    """Stack coordinates (...) to points (..., 3) with the memory layout of ``points``.

    The last bit of a function of a coordinate may depend on the layout.
    """
    if points.stride(-1) == 1:
        return torch.stack(coordinates, dim=-1)
    return torch.stack(coordinates).movedim(0, -1)


_MOST_CRESTS = 64


@dataclass(frozen=True)
class Cut:
    """Intersection of the space behind its faces, with rounded edges.

    Attributes:
        faces: Its faces, at least one.
        fillet: Radius of its edges where faces meet at 90° [mm].
        reach_mm: See ``Solid``.
        leaning: Largest slope of the sum of squares that rounds the edges: 1 where faces meet at
            90°, more where they lean towards each other.
    """

    faces: tuple[Face, ...]
    fillet: float
    reach_mm: float
    leaning: float = 1.25

    @property
    def max_slope(self) -> float:
        return 1.0  # both bounds of ``distance`` are at most as steep as the exact one

    @property
    def cells(self) -> tuple[Cell, ...]:
        # One for each face; those of crests follow.
        crest = [face.cell for face in self.faces if isinstance(face, Ripple)]
        return (*(face.cell for face in self.faces), *crest * _MOST_CRESTS)

    @cached_property
    def _groups(self) -> tuple[Face | Flats, ...]:
        """Its faces in order, consecutive planes joined."""
        groups: list[Face | Flats] = []
        for _, alike in groupby(self.faces, key=lambda face: isinstance(face, Flat)):
            faces = list(alike)
            flats = [(*face.normal, face.offset) for face in faces if isinstance(face, Flat)]
            groups += [Flats(tuple(zip(*flats, strict=True)))] if flats else faces
        return tuple(groups)

    def _behind(self, points: Tensor) -> Tensor:
        """Signed distance to each face, (faces, ...)."""
        behind = [
            group.behind(points) if isinstance(group, Flats) else group.behind(points)[None]
            for group in self._groups
        ]
        return behind[0] if len(behind) == 1 else torch.cat(behind)

    def distance(self, points: Tensor) -> Tensor:
        behind = self._behind(points)
        rim = (behind + self.fillet).clamp_(min=0).square_().sum(0).sqrt_()
        foremost = behind.amax(0)
        rounded = foremost.clamp(max=-self.fillet) + rim
        return torch.maximum(foremost, rounded / self.leaning)

    def cell(self, points: Tensor) -> Tensor:
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

    Source: a first-order distance, |p/r| (|p/r| - 1) / |p/r²| (Quilez); too large beside a flat
    one.
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
        return (Cell(form=Form.CURVED),)

    @property
    def reach_mm(self) -> float:
        return max(self.x, self.y, self.z)

    def distance(self, points: Tensor) -> Tensor:
        radii = constant((self.x, self.y, self.z), points.dtype, points.device)
        once = (points / radii).square().sum(-1).sqrt()
        twice = (points / radii**2).square().sum(-1).sqrt()
        return once * (once - 1) / twice.clamp(min=1e-9)

    def cell(self, points: Tensor) -> Tensor:
        return torch.zeros(points.shape[:-1], dtype=torch.int64, device=points.device)


@dataclass(frozen=True, slots=True)
class Hoop:
    """Round tube bent to a ring about z, or to an arc that is symmetric about +x [mm]."""

    radius: float
    tube: float
    half_angle: float = math.pi
    form: Form = Form.LOOP
    max_slope: float = 1.0

    @property
    def cells(self) -> tuple[Cell, ...]:
        return (Cell(form=self.form),)

    @property
    def reach_mm(self) -> float:
        return self.radius + self.tube

    def distance(self, points: Tensor) -> Tensor:
        x, y, z = points.unbind(-1)
        across = torch.hypot(torch.hypot(x, y) - self.radius, z)
        if self.half_angle < math.pi:
            end_x = x - self.radius * math.cos(self.half_angle)
            end_y = y.abs() - self.radius * math.sin(self.half_angle)
            to_end = (end_x**2 + end_y**2 + z**2).sqrt()
            across = torch.where(torch.atan2(y, x).abs() <= self.half_angle, across, to_end)
        return across - self.tube

    def cell(self, points: Tensor) -> Tensor:
        return torch.zeros(points.shape[:-1], dtype=torch.int64, device=points.device)


@lru_cache(maxsize=1024)
def _rods(
    ends: tuple[tuple[Vector, Vector], ...], dtype: torch.dtype, device: torch.device, ndim: int
) -> tuple[tuple[Tensor, ...], tuple[Tensor, ...], Tensor, bool]:
    """Starts of rods and vectors to their ends (x, y, z), squared lengths, whether all are balls.

    Shape of each tensor: (rods, 1, ...) with ``ndim`` ones.
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
    """Round rods between pairs of points [mm], each a cell: bars, wires, or one thick rod."""

    ends: tuple[tuple[Vector, Vector], ...]
    radius: float
    form: Form = Form.BAR
    max_slope: float = 1.0

    @property
    def cells(self) -> tuple[Cell, ...]:
        return (Cell(form=self.form),) * len(self.ends)

    @property
    def reach_mm(self) -> float:
        return max(math.hypot(*end) for rod in self.ends for end in rod) + self.radius

    def _squared(self, points: Tensor) -> Tensor:
        """Squared distance to the axis of each rod, (rods, ...)."""
        x, y, z = points.unbind(-1)
        start, along, length, balls = _rods(self.ends, points.dtype, points.device, x.ndim)
        # Coordinate by coordinate: sums over an axis of three take several times as long.
        u, v, w = (at - of for at, of in zip((x, y, z), start, strict=True))
        if not balls:
            a, b, c = along
            fraction = ((u * a + v * b + w * c) / length).clamp_(0, 1)
            u, v, w = u - fraction * a, v - fraction * b, w - fraction * c
        return u * u + v * v + w * w

    def distance(self, points: Tensor) -> Tensor:
        return self._squared(points).amin(0).sqrt() - self.radius

    def cell(self, points: Tensor) -> Tensor:
        return self._squared(points).sqrt().argmin(0)
