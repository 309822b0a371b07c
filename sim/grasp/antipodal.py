"""Where two flat fingers can hold a mesh: a seeded search for opposite surfaces.

The mesh stands as its file says: +z is up, against gravity. The fingers come from above and close
horizontally; the search turns them about the vertical, and never tilts the mesh.

A grasp needs upright surface on both sides whose normals lie within the friction cone of the
closing direction, a width that the gripper opens to, a patch on either pad that is large enough and
not at the pad's edge, and room for both fingers. Of these, one near the centre of mass is chosen,
whose patch does not fill the pad.

Source: ray-cast antipodal sampling after Mahler et al., 'Dex-Net 2.0' (2017), section IV.

Not here: the body that is held (``sim.grasp.mesh_bodies``). Not modelled: support, palm.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from sim.grasp.devices import MAX_WIDTH_M
from sim.grasp.pad_casting import CLEAR_MM, Candidates, PadCaster, Touches
from sim.objects.meshes import IntArray, ray_scene, volume_and_centre

MAX_OPENING_MM = 1000 * MAX_WIDTH_M
MAX_GRASP_MM = MAX_OPENING_MM - 2 * CLEAR_MM

FRICTION = 0.3
"""Friction whose cone the normals must lie in: the least of any object of ``sim.grasp.bodies``."""

MIN_PATCH_MM2 = 8.0
"""Smallest patch [mm²]. Our choice: that of a ball of 4 mm radius."""

SAMPLES = 4000
YAWS_RAD = tuple(math.radians(d) for d in (-10.0, 0.0, 10.0))
"""Closing directions that are tried at each sample, about the normal's own, for tapering sides."""

_BATCH, _MAX_CANDIDATES = 500, 5000
_THINNEST_MM = 0.5  # of a wall
_CELL_MM, _CELL_RAD = 4.0, math.radians(20)  # candidates nearer than this are alike

_WIDTH_WEIGHT = 0.05
"""Distance from the centre of mass [mm] that outweighs a mm of width. Our choice."""

_PATCH_WEIGHT_MM3 = 100.0
"""Over the area of the smaller patch, a distance that it outweighs. Our choice: 0.3 mm for a full
pad, 12 mm for the smallest patch."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspPlace:
    """Where the fingers close on a mesh, in the mesh's own frame.

    Attributes:
        centre_mm: Point midway between the pads' centres [mm].
        closing: Unit vector from it towards the finger with the camera, horizontal.
        width_mm: Distance between the pads when both touch [mm].
        patch_mm2: Patch on the camera's pad, the smaller, and on the other [mm²].
        from_com_mm: Distance of the centre from the centre of mass [mm].
    """

    centre_mm: tuple[float, float, float]
    closing: tuple[float, float, float]
    width_mm: float
    patch_mm2: tuple[float, float]
    from_com_mm: float

    @property
    def yaw_deg(self) -> float:
        """Closing direction about the vertical, from the mesh's +x towards +y, -90 to 90 [°]."""
        return (math.degrees(math.atan2(self.closing[1], self.closing[0])) + 90.0) % 180.0 - 90.0

    @property
    def body_from_mesh(self) -> FloatArray:
        """Rotation from the mesh's axes to the pad's: x right, y up, z towards the camera."""
        z = np.array(self.closing)
        y = np.array([0.0, 0.0, 1.0])
        return np.stack([np.cross(y, z), y, z])


_FELT_FRACTION, _FLAT_WEIGHT_MM = 0.4, 40.0
"""Fraction of the pad above which a patch is felt badly, and the distance that outweighs a full pad
and more of it. A face that fills the pad moves all of the gel alike, which photometric sensors do
not measure (docs/world.md)."""


def find_grasp(
    vertices: FloatArray, faces: IntArray, pad_mm: tuple[float, float], *, seed: int = 0
) -> GraspPlace:
    """The best grasp with two sufficient patches and room for both fingers.

    Args:
        vertices: Shape (V, 3), of a closed mesh, +z up [mm].
        faces: Shape (F, 3), indices into them, counter-clockwise seen from outside.
        pad_mm: Width and height of a pad [mm].
        seed: Random seed of the surface samples.

    Raises:
        TouchError: There is none; the message says why.
    """
    scene, tensor = ray_scene(vertices, faces)
    _, com = volume_and_centre(vertices, faces)
    candidates = _opposites(vertices, faces, scene, tensor, np.random.default_rng(seed))
    distance = np.linalg.norm(candidates.centre - com, axis=1)
    candidates = candidates.take(np.argsort(distance + _WIDTH_WEIGHT * 2 * candidates.half))
    candidates = candidates.take(_distinct(candidates)[:_MAX_CANDIDATES])
    pads = PadCaster(scene, tensor, pad_mm, float(vertices[:, 2].max()) + 1.0)
    refused = _Refused()
    for first in range(0, len(candidates.half), _BATCH):
        batch = candidates.take(slice(first, first + _BATCH))
        # A finger touches the nearest surface, beside the sampled point: pads move to their patches
        batch = _recentred(batch, pads.touch(batch))
        place = _best(batch, pads.touch(batch), com, pad_mm[0] * pad_mm[1], refused)
        if place is not None:
            return place
    raise TouchError(refused.line())


def _opposites(
    vertices: FloatArray, faces: IntArray, scene: Any, tensor: Any, rng: np.random.Generator
) -> Candidates:
    """Pairs of opposite points of the surface, between which the mesh may also be hollow.

    Raises:
        TouchError: The mesh has no upright surface, none opposite, or is too wide.
    """
    cosine = math.cos(math.atan(FRICTION))
    corners = vertices[faces]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    double_area = np.linalg.norm(cross, axis=1)
    normals = cross / np.maximum(double_area, 1e-12)[:, None]
    upright = np.hypot(normals[:, 0], normals[:, 1]) >= cosine
    weight = double_area * upright
    if weight.sum() <= 1e-6 * double_area.sum():
        raise TouchError(
            "the mesh (+z up) has no upright surface for fingers that close horizontally; turn it"
        )
    face = rng.choice(len(faces), SAMPLES, p=weight / weight.sum())
    u, v = rng.random((2, SAMPLES, 1))
    root = np.sqrt(u)
    a, b, c = (corners[face, i] for i in range(3))
    points = (1 - root) * a + root * (1 - v) * b + root * v * c
    points, normal = np.tile(points, (len(YAWS_RAD), 1)), np.tile(normals[face], (len(YAWS_RAD), 1))
    yaw = np.arctan2(normal[:, 1], normal[:, 0]) + np.repeat(YAWS_RAD, SAMPLES)
    closing = np.stack([np.cos(yaw), np.sin(yaw), np.zeros_like(yaw)], axis=1)
    in_cone = (normal * closing).sum(axis=1) >= cosine
    points, closing = points[in_cone], closing[in_cone]
    rays = np.concatenate([points, -closing], axis=1).astype(np.float32)
    hits = {k: each.numpy() for k, each in scene.list_intersections(tensor(rays)).items()}
    ray, width, hit = hits["ray_ids"], hits["t_hit"].astype(np.float64), hits["primitive_ids"]
    opposite = -(normals[hit] * closing[ray]).sum(axis=1) >= cosine
    opposite &= width > _THINNEST_MM
    if not opposite.any():
        raise TouchError(
            "no two upright surfaces of the mesh (+z up) face away from each other within "
            f"{math.degrees(math.acos(cosine)):.0f}°, so that fingers would slide off it; turn it"
        )
    if width[opposite].min() > MAX_GRASP_MM:
        raise TouchError(
            f"the mesh (+z up) is too wide: {width[opposite].min():.0f} mm at its narrowest grasp, "
            f"and the gripper takes {MAX_GRASP_MM:.0f} mm; turn or scale it"
        )
    kept = opposite & (width <= MAX_GRASP_MM)
    ray, half = ray[kept], width[kept] / 2
    return Candidates(points[ray] - half[:, None] * closing[ray], closing[ray], half)


def _distinct(candidates: Candidates) -> IntArray:
    """Indices of candidates, the first of those that are alike, in their order."""
    yaw = np.arctan2(candidates.closing[:, 1], candidates.closing[:, 0])
    cells = np.column_stack(
        [candidates.centre / _CELL_MM, yaw / _CELL_RAD, candidates.half / _CELL_MM]
    )
    _, first = np.unique(np.round(cells).astype(np.int64), axis=0, return_index=True)
    return np.sort(first)


def _recentred(candidates: Candidates, touched: Touches) -> Candidates:
    """Candidates whose pads are centred between both patches."""
    x, y = touched.x.mean(axis=0), touched.y.mean(axis=0)
    by = x[:, None] * candidates.right + y[:, None] * np.array([0.0, 0.0, 1.0])
    return Candidates(candidates.centre + by, candidates.closing, candidates.half)


@dataclass(slots=True)
class _Refused:
    """Numbers of candidates that were refused, each by the first reason that holds."""

    no_room: int = 0
    small: int = 0
    off: int = 0
    wide: int = 0

    def line(self) -> str:
        counts = {
            "there is no room for a finger": self.no_room,
            f"a patch is below {MIN_PATCH_MM2:g} mm²": self.small,
            "a patch lies at the pad's edge": self.off,
            f"the pads are more than {MAX_GRASP_MM:g} mm apart": self.wide,
        }
        reasons = ", ".join(f"at {count} {words}" for words, count in counts.items() if count)
        return (
            f"none of {sum(counts.values())} pairs of opposite surfaces of the mesh (+z up) can be "
            f"grasped: {reasons}; turn or scale it"
        )


def _best(
    candidates: Candidates,
    touched: Touches,
    com: FloatArray,
    pad_mm2: float,
    refused: _Refused,
) -> GraspPlace | None:
    """The best candidate whose fingers have room and whose patches suffice, None for none."""
    width = touched.reach.sum(axis=0)
    usable = np.ones(len(width), dtype=bool)
    for reason, is_wrong in (
        ("no_room", ~touched.is_free.all(axis=0)),
        ("small", (touched.area < MIN_PATCH_MM2).any(axis=0)),
        ("off", touched.is_off.any(axis=0)),
        ("wide", width > MAX_GRASP_MM),
    ):
        setattr(refused, reason, getattr(refused, reason) + int((usable & is_wrong).sum()))
        usable &= ~is_wrong
    if not usable.any():
        return None
    # the camera looks at the smaller patch, which bruises first
    sign = np.where(touched.area[0] <= touched.area[1], 1.0, -1.0)
    centre = candidates.centre + (
        ((touched.reach[0] - touched.reach[1]) / 2)[:, None] * candidates.closing
    )
    distance = np.linalg.norm(centre - com, axis=1)
    patch = np.maximum(touched.area.min(axis=0), MIN_PATCH_MM2)
    cost = distance + _WIDTH_WEIGHT * width + _PATCH_WEIGHT_MM3 / patch
    cost += _FLAT_WEIGHT_MM * np.maximum(0.0, patch / pad_mm2 - _FELT_FRACTION)
    best = int(np.argmin(np.where(usable, cost, np.inf)))
    x, y, z = (float(each) for each in sign[best] * candidates.closing[best])
    low, high = sorted(float(each) for each in touched.area[:, best])
    return GraspPlace(
        centre_mm=(float(centre[best, 0]), float(centre[best, 1]), float(centre[best, 2])),
        closing=(x, y, z),
        width_mm=float(width[best]),
        patch_mm2=(low, high),
        from_com_mm=float(distance[best]),
    )
