"""Rays against solids: points where a finger meets an object, and the surface it then feels.

A finger is met where a ball of ``FINGER_MM`` that comes along a random line touches the object:
faces in proportion to their area, edges and corners in proportion to how far they stick out, and
never the bottom of a crack.

A contact's frame has its origin on the pad, z into the gel: the object comes from -z.

Not here: which object and pose (``sim.tcl3d.poses``), what it is called
(``sim.tcl3d.shape_labels``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from sim.gel.gap import NO_BODY_MM

FloatArray = NDArray[np.float64]

FINGER_MM = 10.0
"""Radius of the ball that finds where an object is touched. Our choice: about half a pad."""

BACK_MM = 25.0
"""Rays start this far before the point where they are expected to hit."""

BEYOND_MM = 4.0
"""What lies further behind the foremost point is out of the gel's reach."""

STEPS, NEAR_MM, ALONGSIDE_MM = 64, 2e-4, 0.01
"""Of sphere tracing: most steps, what is as good as there, and what is still on its way along a
steep wall and counts as there."""


class Castable(Protocol):
    """What rays can be cast against: an object of the catalogue, or a mesh."""

    @property
    def reach_mm(self) -> float:
        """All of it lies within this distance of its origin [mm]."""
        ...

    def surface(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        """How far rays from ``origins`` (N, 3) go along a unit vector (3,); inf if they miss [mm].

        NaN where a ray starts inside.
        """
        ...

    def surface_over(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        """The same for a grid of rays, origins (H, W, 3), as (H, W).

        What lies more than ``BEYOND_MM`` behind the foremost may count as missed.
        """
        ...

    def distance(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of points (..., 3)."""
        ...


class Marchable(Protocol):
    """What sphere tracing needs of a solid (``sim.objects.solids.Solid``)."""

    @property
    def max_slope(self) -> float:
        """Largest slope of ``distance``."""
        ...

    def distance(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of points (..., 3)."""
        ...


def march(solid: Marchable, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
    """Sphere tracing: see ``Castable.surface``."""
    travelled = torch.zeros(origins.shape[0], dtype=origins.dtype, device=origins.device)
    hit = torch.full_like(travelled, torch.inf)
    index = torch.arange(origins.shape[0], device=origins.device)
    distance, active = travelled, travelled < far_mm
    for step in range(STEPS):
        distance = solid.distance(origins + travelled[:, None] * along)
        arrived = distance < NEAR_MM
        hit_mm = travelled + distance
        if step == 0:
            hit_mm = torch.where(distance < -NEAR_MM, torch.nan, hit_mm)
        hit[index[arrived]] = hit_mm[arrived]
        travelled = travelled + distance / solid.max_slope
        if step % 8 == 7:  # what lies behind the gel's reach needs no more steps
            nearest = float(hit.nan_to_num(nan=torch.inf).amin())
            far_mm = min(far_mm, nearest + 1.2 * BEYOND_MM)
        active = ~arrived & (travelled < far_mm)
        if not bool(active.any()):
            return hit
        origins, travelled, index = origins[active], travelled[active], index[active]
    # Still on their way: along a steep wall. They have arrived there, or end far behind the rim.
    hit[index] = torch.where(distance[active] < ALONGSIDE_MM, travelled, torch.inf)
    return hit


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfacePoint:
    """Where a finger meets an object.

    Attributes:
        point: On the surface, object frame, (3,) [mm].
        normal: Outward there: towards the pad; unit, (3,).
    """

    point: FloatArray
    normal: FloatArray


def random_surface_point(obj: Castable, rng: np.random.Generator) -> SurfacePoint:
    """Meet an object along a random line.

    Raises:
        ValueError: It was missed a thousand times.
    """
    radius = obj.reach_mm + FINGER_MM
    for _ in range(1000):
        direction = unit_vector(rng)
        first, second = _tangents(direction)
        angle, radial_mm = rng.uniform(0, 2 * math.pi), radius * math.sqrt(rng.random())
        start = (
            radial_mm * (math.cos(angle) * first + math.sin(angle) * second)
            - 1.01 * radius * direction
        )
        centre = _first_point_within(obj, start, direction, FINGER_MM, 2.1 * radius)
        if centre is not None:
            normal = gradient(obj, centre)
            return SurfacePoint(point=_project_to_surface(obj, centre, -normal), normal=normal)
    raise ValueError("a thousand random lines missed an object; is it where its reach says?")


def support_point(obj: Castable, direction: FloatArray) -> SurfacePoint:
    """Where an object that comes in a direction, held as it is, first meets a large flat pad."""
    first, second = _tangents(direction)
    reach = obj.reach_mm
    centre, span = np.zeros(2), reach
    point = np.zeros(3)
    for _ in range(3):
        axis = np.linspace(-span, span, 41)
        u, v = np.meshgrid(centre[0] + axis, centre[1] + axis)
        start = u[..., None] * first + v[..., None] * second + 1.01 * reach * direction
        rays = torch.from_numpy(start.reshape(-1, 3))
        distance_mm = obj.surface(rays, torch.from_numpy(-direction), 2.1 * reach).numpy()
        best = int(np.nanargmin(distance_mm))
        centre = np.array([u.ravel()[best], v.ravel()[best]])
        point = start.reshape(-1, 3)[best] - distance_mm[best] * direction
        span /= 12
    return SurfacePoint(point=point, normal=direction)


def gradient(obj: Castable, point: FloatArray, step_mm: float = 1e-3) -> FloatArray:
    """Outward unit normal of the level surface through a point, (3,)."""
    offsets = np.concatenate([np.eye(3), -np.eye(3)]) * step_mm
    distance = obj.distance(torch.from_numpy(point + offsets)).numpy()
    slope = distance[:3] - distance[3:]
    return np.asarray(slope / max(float(np.linalg.norm(slope)), 1e-12))


def _first_point_within(
    obj: Castable, start: FloatArray, direction: FloatArray, level_mm: float, far_mm: float
) -> FloatArray | None:
    """Where a line first comes within ``level_mm`` of an object."""
    travelled = 0.0
    for _ in range(200):
        point = start + travelled * direction
        distance = float(obj.distance(torch.from_numpy(point[None]))[0]) - level_mm
        if distance < 1e-3:
            return np.asarray(point)
        travelled += 0.8 * distance
        if travelled > far_mm:
            return None
    return None


def _project_to_surface(obj: Castable, point: FloatArray, direction: FloatArray) -> FloatArray:
    hit_mm = _first_point_within(obj, point, direction, 0.0, 4 * FINGER_MM)
    return point + FINGER_MM * direction if hit_mm is None else hit_mm


def unit_vector(rng: np.random.Generator) -> FloatArray:
    """Uniform on the unit sphere, (3,)."""
    vector = rng.normal(size=3)
    return np.asarray(vector / np.linalg.norm(vector))


def _tangents(direction: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors that make a right-handed frame with a third."""
    least = np.eye(3)[int(np.argmin(np.abs(direction)))]
    first = np.cross(least, direction)
    first /= np.linalg.norm(first)
    return first, np.cross(direction, first)


def frame_at(normal: FloatArray) -> FloatArray:
    """Rotation whose columns are pad x, pad y and pad z (into the gel, along ``normal``), (3, 3).

    Its turn about the normal is arbitrary.
    """
    first, second = _tangents(normal)
    return np.stack([first, second, normal], axis=1)


@dataclass(frozen=True, slots=True, kw_only=True)
class PadView:
    """What lies over the pad.

    Attributes:
        gap_mm: Shape (H, W), how far the bare surface lies behind its foremost point [mm];
            ``NO_BODY_MM`` where nothing is within ``BEYOND_MM``.
        points: Shape (H, W, 3), where on the object, object frame [mm]; 0 where nothing is.
    """

    gap_mm: FloatArray
    points: FloatArray


def cast_pad_rays(
    obj: Castable,
    object_from_pad: FloatArray,
    point: FloatArray,
    x_mm: FloatArray,
    y_mm: FloatArray,
    device: torch.device | str = "cpu",
) -> PadView | None:
    """Cast the pad's rays against an object.

    Args:
        obj: The object.
        object_from_pad: Rotation (3, 3); its third column is z, into the gel.
        point: Of the object, where it lies over the pad's origin [mm].
        x_mm: Shape (H, W), over the pad [mm].
        y_mm: Same shape [mm].
        device: Where to compute.

    Returns:
        None where the pad can't come there: a part of the object is in its way, or nothing is over
        it.
    """
    direction = object_from_pad[:, 2]
    origins = np.stack([x_mm.ravel(), y_mm.ravel()], axis=1) @ object_from_pad[:, :2].T
    for component, start in zip(origins.T, point + BACK_MM * direction, strict=True):
        component += start  # one coordinate after the other: numpy is slow over an axis of three
    rays = torch.from_numpy(origins.astype(np.float32)).view(*x_mm.shape, 3).to(device)
    along = torch.from_numpy((-direction).astype(np.float32)).to(device)
    over = obj.surface_over(rays, along, BACK_MM + 2 * BEYOND_MM).flatten()
    distance_mm = over.cpu().numpy().astype(np.float64)
    if np.isnan(distance_mm).any() or not np.isfinite(distance_mm).any():
        return None
    gap = distance_mm - distance_mm.min()
    covered = gap < BEYOND_MM
    reached, points = np.where(covered, distance_mm, 0.0), np.empty_like(origins)
    for axis, component in enumerate(direction):
        points[:, axis] = np.where(covered, origins[:, axis] - reached * component, 0.0)
    return PadView(
        gap_mm=np.where(covered, gap, NO_BODY_MM).reshape(x_mm.shape),
        points=points.reshape(*x_mm.shape, 3),
    )
