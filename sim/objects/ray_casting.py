"""Rays against solids: random surface points of an object, and its surface over the pad.

A random surface point is where a ball of ``FINGER_RADIUS_MM``, moved along a random line, first
touches the object. Faces are hit in proportion to their area, edges and corners in proportion to
how far they stick out, and the bottom of a crack never.

A contact's frame has its origin on the pad, z into the gel: the object comes from -z.

Not here: choice of object and pose (``sim.tcl3d.poses``), the label of a contact's shape
(``sim.tcl3d.shape_labels``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import torch
from torch import Tensor

from cltp.tactile.cloud import FloatArray
from sim.gel.gap import NO_BODY_MM
from sim.objects.solids import Solid

FINGER_RADIUS_MM = 10.0
"""Radius of the ball that finds random surface points. Our choice: about half a pad."""

BACK_MM = 25.0
"""Distance from the start of a ray to the expected hit."""

BEYOND_MM = 4.0
"""Surface further than this behind the foremost point is out of the gel's reach."""

STEPS, NEAR_MM, ALONGSIDE_MM = 64, 2e-4, 0.01
"""Sphere tracing: largest number of steps; distance at which a ray has hit; distance at which a ray
that is still under way, along a steep wall, counts as a hit."""


class Castable(Protocol):
    """An object that rays can be cast against: one of the catalogue, or a mesh."""

    @property
    def reach_mm(self) -> float:
        """Largest distance of the surface from the object's origin [mm]."""

    def surface(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        """Length of rays from ``origins`` (N, 3) along a unit vector (3,) to the surface [mm].

        inf where a ray misses, NaN where it starts inside.
        """

    def surface_over(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        """``surface`` for a grid of rays, origins (H, W, 3), as (H, W).

        Surface more than ``BEYOND_MM`` behind the foremost point may count as missed.
        """

    def distance(self, points: Tensor) -> Tensor:
        """Signed distance [mm] of points (..., 3)."""


def march(solid: Solid, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
    """Trace rays against a solid; arguments and result as ``Castable.surface``."""
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
        if step % 8 == 7:  # rays out of the gel's reach need no more steps
            nearest = float(hit.nan_to_num(nan=torch.inf).amin())
            far_mm = min(far_mm, nearest + 1.2 * BEYOND_MM)
        active = ~arrived & (travelled < far_mm)
        if not bool(active.any()):
            return hit
        origins, travelled, index = origins[active], travelled[active], index[active]
    # The rest runs along a steep wall: it has hit the wall, or ends far behind the rim.
    hit[index] = torch.where(distance[active] < ALONGSIDE_MM, travelled, torch.inf)
    return hit


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfacePoint:
    """Point of an object's surface.

    Attributes:
        point: Position, object frame, (3,) [mm].
        normal: Outward unit normal, towards the pad, (3,).
    """

    point: FloatArray
    normal: FloatArray


def random_surface_point(obj: Castable, rng: np.random.Generator) -> SurfacePoint:
    """Draw the point where a ball on a random line first touches an object.

    Raises:
        ValueError: A thousand lines missed the object.
    """
    radius = obj.reach_mm + FINGER_RADIUS_MM
    for _ in range(1000):
        direction = unit_vector(rng)
        first, second = _tangents(direction)
        angle, radial_mm = rng.uniform(0, 2 * math.pi), radius * math.sqrt(rng.random())
        aside = radial_mm * (math.cos(angle) * first + math.sin(angle) * second)
        start = aside - 1.01 * radius * direction
        centre = _first_point_within(obj, start, direction, FINGER_RADIUS_MM, 2.1 * radius)
        if centre is not None:
            normal = gradient(obj, centre)
            hit = _first_point_within(obj, centre, -normal, 0.0, 4 * FINGER_RADIUS_MM)
            point = centre - FINGER_RADIUS_MM * normal if hit is None else hit
            return SurfacePoint(point=point, normal=normal)
    raise ValueError("a thousand random lines missed an object; is it where its reach says?")


def support_point(obj: Castable, direction: FloatArray) -> SurfacePoint:
    """Point of an object, moved in a direction without turning, that first touches a flat pad."""
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
    """First point of a line within ``level_mm`` of an object; None if there is none."""
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


def unit_vector(rng: np.random.Generator) -> FloatArray:
    """Draw uniformly from the unit sphere, (3,)."""
    vector = rng.normal(size=3)
    return np.asarray(vector / np.linalg.norm(vector))


def _tangents(direction: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors that complete a direction to a right-handed frame."""
    least = np.eye(3)[int(np.argmin(np.abs(direction)))]
    first = np.cross(least, direction)
    first /= np.linalg.norm(first)
    return first, np.cross(direction, first)


def frame_at(normal: FloatArray) -> FloatArray:
    """Rotation whose columns are pad x, pad y and pad z (into the gel, along ``normal``), (3, 3).

    The angle about the normal is arbitrary.
    """
    first, second = _tangents(normal)
    return np.stack([first, second, normal], axis=1)


@dataclass(frozen=True, slots=True, kw_only=True)
class PadView:
    """Surface of an object over the pad, skin not included.

    Attributes:
        gap_mm: Shape (H, W), distance behind the foremost point [mm]; ``NO_BODY_MM`` where no
            surface is within ``BEYOND_MM``.
        points: Shape (H, W, 3), surface points, object frame [mm]; 0 where there is none.
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
        point: Point of the object over the pad's origin, object frame [mm].
        x_mm: Shape (H, W), pad positions [mm].
        y_mm: Same shape [mm].
        device: Torch device of the computation.

    Returns:
        None where the pad cannot take this pose: a part of the object is in its way, or no surface
        lies over it.
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
