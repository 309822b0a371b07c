"""Faces that solids are cut from, and the cells of a surface, which label a contact's shape.

Not here: solids (``sim.objects.solids``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from typing import Protocol

import torch
from torch import Tensor

from cltp.tactile.states import Shape

Vector = tuple[float, float, float]


class Form(StrEnum):
    """Kind of a cell of a surface."""

    FLAT = "flat"
    CURVED = "curved"  # labelled by its curvatures at the contact
    TAPER = "taper"  # a face, flat or conical, that runs to a tip
    BAR = "bar"
    LOOP = "loop"  # a ring or an arc of one
    DOT = "dot"
    CREST = "crest"


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """A part of a surface that labels a contact.

    Attributes:
        form: Its kind.
        outline: Shape of a contact with the whole of a flat cell; None: by its proportions.
    """

    form: Form
    outline: Shape | None = None


class Face(Protocol):
    """An unbounded surface with a solid behind it."""

    @property
    def cell(self) -> Cell:
        """The cell of a solid's surface that this face makes."""

    def behind(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of ``points`` (..., 3): positive in front."""


@dataclass(frozen=True, slots=True)
class Flat:
    """Plane with an outward unit normal, ``offset`` from the origin [mm]."""

    normal: Vector
    offset: float
    cell: Cell = Cell(form=Form.FLAT)

    def behind(self, points: Tensor) -> Tensor:
        x, y, z = self.normal
        return points[..., 0] * x + points[..., 1] * y + points[..., 2] * z - self.offset


@lru_cache(maxsize=4096)
def constant(
    values: tuple[float | tuple[float, ...] | tuple[Vector, ...], ...],
    dtype: torch.dtype,
    device: torch.device,
) -> Tensor:
    """Numbers as a tensor, cached because every ray needs them. Do not write to it."""
    with torch.inference_mode(mode=False):  # usable in and out of inference mode
        return torch.tensor(values, dtype=dtype, device=device)


@dataclass(frozen=True, slots=True)
class Flats:
    """Several planes at once; results are those of ``Flat`` to the last bit.

    Attributes:
        components: x of all normals, y of all, z of all, and the offset of each plane [mm].
    """

    components: tuple[tuple[float, ...], ...]

    def behind(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of ``points`` (..., 3) to each plane, (planes, ...)."""
        each = (-1, *[1] * (points.ndim - 1))
        components = constant(self.components, points.dtype, points.device)
        a, b, c, offset = (component.view(each) for component in components.unbind(0))
        x, y, z = points.unbind(-1)
        return (x * a).add_(y * b).add_(z * c).sub_(offset)


@dataclass(frozen=True, slots=True)
class Barrel:
    """Cylinder or cone about z: ``radius`` [mm] at z = 0, ``widening`` mm more per mm of z."""

    radius: float
    widening: float = 0.0
    cell: Cell = Cell(form=Form.CURVED)

    def behind(self, points: Tensor) -> Tensor:
        across = torch.hypot(points[..., 0], points[..., 1])
        level = self.radius + self.widening * points[..., 2]
        return (across - level) / math.hypot(1.0, self.widening)


@dataclass(frozen=True, slots=True)
class Bore:
    """Inside of a cylinder parallel to z through (``x``, ``y``) [mm]."""

    radius: float
    x: float = 0.0
    y: float = 0.0
    cell: Cell = Cell(form=Form.CURVED)

    def behind(self, points: Tensor) -> Tensor:
        return self.radius - torch.hypot(points[..., 0] - self.x, points[..., 1] - self.y)


@dataclass(frozen=True, slots=True)
class Dome:
    """Sphere about (0, 0, ``centre_z``) [mm]."""

    radius: float
    centre_z: float = 0.0
    cell: Cell = Cell(form=Form.CURVED)

    def behind(self, points: Tensor) -> Tensor:
        height = points[..., 2] - self.centre_z
        across = points[..., 0] ** 2 + points[..., 1] ** 2
        return (across + height**2).sqrt() - self.radius


@dataclass(frozen=True, slots=True)
class Ripple:
    """Crests along y, ``period`` apart, on a face towards +z at ``offset`` [mm].

    Each crest is a cell (``sim.objects.solids.Cut.cell``).
    """

    offset: float
    period: float
    amplitude: float
    cell: Cell = Cell(form=Form.CREST)

    def behind(self, points: Tensor) -> Tensor:
        waves = 2 * math.pi / self.period
        below = self.amplitude * (1 - torch.cos(waves * points[..., 0]))
        return (points[..., 2] - self.offset + below) / math.hypot(1.0, waves * self.amplitude)
