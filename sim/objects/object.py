"""Things to be touched: parts with a shape, a skin and a name for what each of their cells is.

Not here: which there are (``sim.objects.catalogue``), meshes (``sim.objects.mesh_objects``).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import torch
from torch import Tensor

from sim.objects.faces import Cell, Vector
from sim.objects.ray_casting import march
from sim.objects.ray_tubes import march_over
from sim.objects.skins import SMOOTH, Skin
from sim.objects.solids import Solid

MANY_RAYS = 20_000
"""From here on rays go in tubes first: more than any grid of the data set has, whose contacts have
to stay the same to the last bit."""


class Family(StrEnum):
    """Where an object comes from."""

    PEG = "peg"
    INDENTER = "indenter"
    HOUSEHOLD = "household"
    INDUSTRIAL = "industrial"


@dataclass(frozen=True, slots=True)
class Part:
    """A solid and what its surface is like."""

    solid: Solid
    skin: Skin = SMOOTH


@dataclass(frozen=True, slots=True)
class Mount:
    """A way in which an object is held on purpose, such as a probe by its shank.

    Attributes:
        direction: Unit vector in the object frame that points into the gel.
        point: Point of the object over the chosen position on the pad, object frame [mm].
        most_tilt_deg: How far it may lean from there [°].
    """

    direction: Vector = (0.0, 0.0, 1.0)
    point: Vector = (0.0, 0.0, 0.0)
    most_tilt_deg: float = 2.0


@dataclass(frozen=True)
class SolidObject:
    """An object.

    Attributes:
        name: Of a file name's letters.
        family: Where it comes from.
        features: What a person would say of its shape, in a few words.
        parts: What it is made of [mm].
        holds: How it is held on purpose; none for most large objects.
        held: Share of its presses that are held so.
        modulus_mpa: E / (1 - nu²) of a soft one [MPa]; None for a rigid one.
    """

    name: str
    family: Family
    features: str
    parts: tuple[Part, ...]
    mounts: tuple[Mount, ...] = ()
    mount_fraction: float = 0.0
    modulus_mpa: float | None = None

    @property
    def is_small(self) -> bool:
        """Whether it is turned in space and pressed down, instead of felt along its surface."""
        return self.family in (Family.PEG, Family.INDENTER)

    @cached_property
    def cells(self) -> tuple[Cell, ...]:
        """Of all parts, in order."""
        return tuple(cell for part in self.parts for cell in part.solid.cells)

    @cached_property
    def part_of_cell(self) -> tuple[int, ...]:
        """Which part each cell belongs to."""
        return tuple(i for i, part in enumerate(self.parts) for _ in part.solid.cells)

    @cached_property
    def reach_mm(self) -> float:
        """All of it lies within this distance of its origin [mm]."""
        return max(part.solid.reach_mm for part in self.parts)

    @cached_property
    def max_slope(self) -> float:
        """Of its steepest part."""
        return max(part.solid.max_slope for part in self.parts)

    def distance(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of points (..., 3)."""
        total = self.parts[0].solid.distance(points)
        for part in self.parts[1:]:
            total = torch.minimum(total, part.solid.distance(points))
        return total

    def cell(self, points: Tensor) -> Tensor:
        """Number of the nearest cell for points (..., 3) near its surface, int64 (...)."""
        number = self.parts[0].solid.cell(points)
        if len(self.parts) == 1:
            return number
        best = self.parts[0].solid.distance(points)
        first = len(self.parts[0].solid.cells)
        for part in self.parts[1:]:
            distance = part.solid.distance(points)
            number = torch.where(distance < best, part.solid.cell(points) + first, number)
            best = torch.minimum(best, distance)
            first += len(part.solid.cells)
        return number

    def surface(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        """See ``sim.objects.ray_casting.Castable``."""
        return march(self, origins, along, far_mm)

    def surface_over(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        """See ``sim.objects.ray_casting.Castable``."""
        rows, columns = origins.shape[:2]
        if rows * columns > MANY_RAYS and origins.device.type == "cpu":
            return march_over(self, origins, along, far_mm)
        return self.surface(origins.view(-1, 3), along, far_mm).view(rows, columns)
