"""Objects to be touched: parts with a shape and a skin, and a cell for each piece of their surface.

Not here: the list of objects (``sim.objects.catalogue``), meshes (``sim.objects.mesh_objects``).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

from torch import Tensor

from sim.objects.compounds import Blend
from sim.objects.faces import Cell, Vector
from sim.objects.ray_casting import march
from sim.objects.ray_tubes import march_over
from sim.objects.skins import SMOOTH, Skin
from sim.objects.solids import Solid

MANY_RAYS = 20_000
"""Number of rays from which they are cast in tubes first. It is above the size of any grid of the
data set, whose contacts have to stay the same to the last bit."""


class Family(StrEnum):
    """Origin of an object."""

    PEG = "peg"
    INDENTER = "indenter"
    HOUSEHOLD = "household"
    INDUSTRIAL = "industrial"


@dataclass(frozen=True, slots=True)
class Part:
    """A solid and its skin."""

    solid: Solid
    skin: Skin = SMOOTH


@dataclass(frozen=True, slots=True)
class Mount:
    """A deliberate way to present an object to the pad, such as a probe by its shank.

    Attributes:
        direction: Unit vector in the object frame that points into the gel.
        point: Point of the object over the chosen position on the pad, object frame [mm].
        most_tilt_deg: Largest tilt from there [°].
    """

    direction: Vector = (0.0, 0.0, 1.0)
    point: Vector = (0.0, 0.0, 0.0)
    most_tilt_deg: float = 2.0


@dataclass(frozen=True)
class SolidObject:
    """An object made of solids; rays can be cast against it (``sim.objects.ray_casting.Castable``).

    Attributes:
        name: Name in data sets and on the command line: letters, digits and underscores.
        family: Its origin.
        features: Description of its shape in a few words.
        parts: Its solids, in one frame [mm].
        mounts: Its mounts; none for most large objects.
        mount_fraction: Fraction of its presses that use a mount.
        modulus_mpa: E / (1 - nu²) of a soft object [MPa]; None for a rigid one.
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
        """Small objects are turned in space and lowered; large ones touch along their surface."""
        return self.family in (Family.PEG, Family.INDENTER)

    @cached_property
    def _whole(self) -> Blend:
        return Blend(tuple(part.solid for part in self.parts))

    @cached_property
    def cells(self) -> tuple[Cell, ...]:
        return self._whole.cells

    @cached_property
    def part_of_cell(self) -> tuple[int, ...]:
        return tuple(i for i, part in enumerate(self.parts) for _ in part.solid.cells)

    @cached_property
    def reach_mm(self) -> float:
        return self._whole.reach_mm

    @cached_property
    def max_slope(self) -> float:
        return self._whole.max_slope

    def distance(self, points: Tensor) -> Tensor:
        return self._whole.distance(points)

    def cell(self, points: Tensor) -> Tensor:
        """Index of the nearest cell for points (..., 3) near the surface, int64 (...)."""
        return self._whole.cell(points)

    def surface(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        return march(self, origins, along, far_mm)

    def surface_over(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        rows, columns = origins.shape[:2]
        if rows * columns > MANY_RAYS and origins.device.type == "cpu":
            return march_over(self, origins, along, far_mm)
        return self.surface(origins.view(-1, 3), along, far_mm).view(rows, columns)
