"""Faces that solids are cut from, and what each part of a surface is called when it touches.

Not here: solids (``sim.objects.solids``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from typing import Protocol

import torch
from torch import Tensor

from cltp.tactile.states import Shape

Vector = tuple[float, float, float]


class Form(StrEnum):
    """What a cell of a surface is."""

    FLAT = "flat"
    CURVED = "curved"  # what it is called depends on its curvatures where it touches
    TAPER = "taper"  # a face, flat or conical, that runs to a tip
    BAR = "bar"
    LOOP = "loop"  # a ring or an arc of one
    DOT = "dot"
    CREST = "crest"


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """A part of a surface that has one name.

    Attributes:
        form: What it is.
        outline: What a flat cell is called when all of it touches; None: by its proportions.
    """

    form: Form
    outline: Shape | None = None


class Face(Protocol):
    """A surface without end that a solid lies behind."""

    @property
    def cell(self) -> Cell:
        """What it is."""
        ...

    def behind(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of ``points`` (..., 3): positive in front."""
        ...


@dataclass(frozen=True, slots=True)
class Flat:
    """Plane with an outward normal, ``offset`` from the origin [mm]."""

    normal: Vector
    offset: float
    cell: Cell = Cell(form=Form.FLAT)

    def behind(self, points: Tensor) -> Tensor:
        """See ``Face``."""
        x, y, z = self.normal
        return points[..., 0] * x + points[..., 1] * y + points[..., 2] * z - self.offset


@lru_cache(maxsize=4096)
def constant(
    values: tuple[float | tuple[float, ...] | tuple[Vector, ...], ...],
    dtype: torch.dtype,
    device: torch.device,
) -> Tensor:
    """Numbers of a shape as a tensor, made once: rays ask for them often. Not to be written."""
    with torch.inference_mode(mode=False):  # usable everywhere, wherever it is first made
        return torch.tensor(values, dtype=dtype, device=device)


@dataclass(frozen=True, slots=True)
class Flats:
    """Several planes at once, to the last bit as one by one.

    Attributes:
        normals: x of each normal, y of each, z of each.
        offsets: Of each plane [mm].
    """

    normals: tuple[tuple[float, ...], ...]
    offsets: tuple[float, ...]

    @staticmethod
    def of(flats: Sequence[Flat]) -> Flats:
        """Of planes, at least one."""
        normals = tuple(zip(*(flat.normal for flat in flats), strict=True))
        return Flats(normals, tuple(flat.offset for flat in flats))

    def behind(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of ``points`` (..., 3), the planes first."""
        each = (-1, *[1] * (points.ndim - 1))
        components = constant((*self.normals, self.offsets), points.dtype, points.device)
        a, b, c, offset = (component.view(each) for component in components.unbind(0))
        x, y, z = points.unbind(-1)
        return (x * a).add_(y * b).add_(z * c).sub_(offset)


@dataclass(frozen=True, slots=True)
class Barrel:
    """Cylinder or cone about z: ``radius`` at z = 0, wider by ``widening`` mm per mm of z."""

    radius: float
    widening: float = 0.0
    cell: Cell = Cell(form=Form.CURVED)

    def behind(self, points: Tensor) -> Tensor:
        """See ``Face``."""
        across = torch.hypot(points[..., 0], points[..., 1])
        level = self.radius + self.widening * points[..., 2]
        return (across - level) / math.hypot(1.0, self.widening)


@dataclass(frozen=True, slots=True)
class Bore:
    """Inside of a cylinder about z through (``x``, ``y``)."""

    radius: float
    x: float = 0.0
    y: float = 0.0
    cell: Cell = Cell(form=Form.CURVED)

    def behind(self, points: Tensor) -> Tensor:
        """See ``Face``."""
        return self.radius - torch.hypot(points[..., 0] - self.x, points[..., 1] - self.y)


@dataclass(frozen=True, slots=True)
class Dome:
    """Sphere about (0, 0, ``centre_z``)."""

    radius: float
    centre_z: float = 0.0
    cell: Cell = Cell(form=Form.CURVED)

    def behind(self, points: Tensor) -> Tensor:
        """See ``Face``."""
        height = points[..., 2] - self.centre_z
        across = points[..., 0] ** 2 + points[..., 1] ** 2
        return (across + height**2).sqrt() - self.radius


@dataclass(frozen=True, slots=True)
class Ripple:
    """Crests along y on a face towards +z at ``offset``, ``period`` apart [mm].

    Its cells are the crests (``Cut.cell``).
    """

    offset: float
    period: float
    amplitude: float
    cell: Cell = Cell(form=Form.CREST)

    def behind(self, points: Tensor) -> Tensor:
        """See ``Face``."""
        waves = 2 * math.pi / self.period
        below = self.amplitude * (1 - torch.cos(waves * points[..., 0]))
        return (points[..., 2] - self.offset + below) / math.hypot(1.0, waves * self.amplitude)
