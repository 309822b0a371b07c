"""Faces that solids are cut from, and what each part of a surface is called when it touches.

Not here: solids (``sim.solids``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

import torch
from torch import Tensor

from cltp.states import Shape

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


def behind_flats(flats: Sequence[Flat], points: Tensor) -> Tensor:
    """``behind`` of several planes at once, the planes first, to the last bit."""
    each = (-1, *[1] * (points.ndim - 1))
    x, y, z = (way.view(each) for way in points.new_tensor([flat.normal for flat in flats]).T)
    offset = points.new_tensor([flat.offset for flat in flats]).view(each)
    return points[..., 0] * x + points[..., 1] * y + points[..., 2] * z - offset


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
