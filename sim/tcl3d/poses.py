"""Random poses of an object on the pad: contact point, lean, rotation and position.

Large objects touch at a random point of their surface
(``sim.objects.ray_casting.random_surface_point``) and lean by up to 15° from there. Small objects
are mounted by their shank, touch at a random point as well, or take a uniformly random orientation
and are lowered until they touch. A flat face settles on the pad: the lean is limited to what keeps
the contact on the pad. A flat face is also shifted until its outline shows: a small face lies
mostly inside the sensing area, a large one has its end in it, because a pad that is pressed evenly
everywhere measures nothing.

Not here: loads and labels (``sim.tcl3d.series``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import torch
from scipy.spatial.transform import Rotation

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec
from sim.objects.object import Mount, SolidObject
from sim.objects.ray_casting import (
    Castable,
    SurfacePoint,
    frame_at,
    gradient,
    random_surface_point,
    support_point,
    unit_vector,
)
from sim.objects.skins import SMOOTH

CONE_DEG = 15.0
"""Largest angle between approach and normal. Source: the paper, section 3.1."""

RANDOM_POINT_FRACTION = 0.55
"""Fraction of the unmounted presses of small objects that touch at a random surface point; the
others take a random orientation."""

SHIFT_MM = 4.5
"""Largest distance by which a lean may move the contact over the pad."""

EVEN_FRACTION = 0.2
"""A flat face may lean until its ends differ by this fraction of its lightest depth."""

_PAD_MM = 20.0
_MOUNT_LEVEL_DEG = 2.0  # mounts that tilt no more than this press a level face
_FLAT_PER_MM = 1 / 150  # curvature below which a surface is flat
_SMALL_MM, _FURTHEST_MM = (18.0, 60.0)
_COVERED_FRACTION = (0.87, 0.97)  # of the sensing area, under a large face
_CENTRED, _CENTRED_MM = 0.3, 2.5  # fraction of series near the centre, and their spread


@dataclass(frozen=True, slots=True, kw_only=True)
class PressPose:
    """Pose of the pad relative to the object.

    Attributes:
        object_from_pad: Rotation (3, 3); the third column is z, into the gel.
        point: Point of the object over the pad's origin, object frame (3,) [mm].
        flat: The contact is a flat face.
    """

    object_from_pad: FloatArray
    point: FloatArray
    flat: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class _Face:
    """Flat face: its span, and its middle and nearest end relative to the contact point.

    The end is None where the face is smaller than the pad.
    """

    span_mm: float
    centre: FloatArray
    end: FloatArray | None

    @property
    def pad_span_mm(self) -> float:
        """Span of the part that a pad can feel."""
        return float(np.clip(self.span_mm, 2.0, _PAD_MM))


def draw_pose(
    obj: SolidObject,
    rng: np.random.Generator,
    sensor: SensorSpec,
    lightest_mm: float,
    *,
    mounted: bool = False,
) -> PressPose:
    """Draw the pose of an object on the pad of a sensor.

    Args:
        obj: The object.
        rng: Random generator.
        sensor: The sensor that is pressed.
        lightest_mm: Depth of the lightest press [mm]; a flat face leans by less than that.
        mounted: Use a mount of the object (it must have one) instead of drawing whether to.
    """
    if rng.random() < (1.0 if mounted else obj.mount_fraction):
        mount = obj.mounts[int(rng.integers(len(obj.mounts)))]
        return _mounted_pose(obj, mount, rng, sensor, lightest_mm)
    if obj.is_small and rng.random() >= RANDOM_POINT_FRACTION:
        return _pose_on_pad(support_point(obj, unit_vector(rng)), None, rng, sensor)
    textured = any(part.skin is not SMOOTH for part in obj.parts)
    point = random_surface_point(obj, rng)
    return surface_pose(obj, point, rng, sensor, lightest_mm, textured=textured)


def surface_pose(
    obj: Castable,
    contact: SurfacePoint,
    rng: np.random.Generator,
    sensor: SensorSpec,
    lightest_mm: float,
    *,
    textured: bool,
) -> PressPose:
    """Draw a pose about a surface point, with a lean that the curvatures there allow."""
    frame = frame_at(contact.normal)
    along = [_normal_curvature(obj, contact, frame[:, axis]) for axis in (0, 1)]
    diagonal = [
        _normal_curvature(obj, contact, (frame[:, 0] + sign * frame[:, 1]) / math.sqrt(2))
        for sign in (1, -1)
    ]
    flat = max(*along, *diagonal) < _FLAT_PER_MM
    lean = _random_lean(math.tan(math.radians(CONE_DEG)) * math.sqrt(rng.random()), rng)
    face = _measure_face(obj, contact, frame) if flat else None
    even = EVEN_FRACTION * lightest_mm / (_PAD_MM if face is None else face.pad_span_mm)
    # Limited to what keeps the contact on the pad.
    mixed = (diagonal[0] - diagonal[1]) / 2
    values, vectors = np.linalg.eigh(np.array([[along[0], mixed], [mixed, along[1]]]))
    limit = np.maximum(SHIFT_MM * values.clip(min=0), even)
    lean = np.asarray(vectors @ np.clip(vectors.T @ lean, -limit, limit))
    if face is not None and face.end is not None and textured and rng.random() < 0.4:
        # A texture shows without an end of the face in view.
        face = _Face(span_mm=4 * _PAD_MM, centre=face.centre, end=None)
    return _pose_on_pad(contact, face, rng, sensor, lean=lean, flat=flat)


def _random_lean(slope: float, rng: np.random.Generator) -> FloatArray:
    direction_rad = rng.uniform(0, 2 * math.pi)
    return slope * np.array([math.cos(direction_rad), math.sin(direction_rad)])


def _mounted_pose(
    obj: SolidObject, mount: Mount, rng: np.random.Generator, sensor: SensorSpec, lightest_mm: float
) -> PressPose:
    contact = SurfacePoint(point=np.array(mount.point), normal=np.array(mount.direction))
    limit = math.tan(math.radians(mount.most_tilt_deg))
    span_mm = _measure_face(obj, contact, frame_at(contact.normal)).pad_span_mm
    face = _Face(span_mm=span_mm, centre=np.zeros(2), end=None)
    level = mount.most_tilt_deg <= _MOUNT_LEVEL_DEG
    if level:
        limit = min(limit, EVEN_FRACTION * lightest_mm / span_mm)
    lean = _random_lean(limit * rng.random(), rng)
    return _pose_on_pad(contact, face, rng, sensor, lean=lean, flat=level)


def _measure_face(obj: Castable, contact: SurfacePoint, frame: FloatArray) -> _Face:
    """Extent of a flat face in 24 directions from the contact point."""
    angles = np.arange(24) * (2 * math.pi / 24)
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    steps = np.arange(0.25, _FURTHEST_MM, 0.5)
    offsets = (steps[:, None, None] * directions[None]) @ frame[:, :2].T
    positions = contact.point + offsets - 0.05 * contact.normal
    inside = ~(obj.distance(torch.from_numpy(positions)).numpy() > 0.35)
    # The last point inside counts: gaps between bars are no ends.
    last = np.where(inside.any(0), inside.shape[0] - 1 - inside[::-1].argmax(0), 0)
    reach = steps[last]
    ends = reach[:, None] * directions
    spans = reach + np.roll(reach, 12)
    span, narrow = float(spans.max()), float(spans.min())
    if span <= _SMALL_MM or narrow <= 0.5 * _SMALL_MM:
        return _Face(span_mm=min(span, _PAD_MM), centre=ends.mean(axis=0), end=None)
    return _Face(span_mm=span, centre=ends.mean(axis=0), end=ends[int(reach.argmin())])


def _normal_curvature(
    obj: Castable, contact: SurfacePoint, direction: FloatArray, step_mm: float = 0.8
) -> float:
    """Normal curvature along a direction [1/mm], at least 0."""
    front = gradient(obj, contact.point + step_mm * direction)
    back = gradient(obj, contact.point - step_mm * direction)
    return max(0.0, float((front - back) @ direction) / (2 * step_mm))


def _pose_on_pad(
    contact: SurfacePoint,
    face: _Face | None,
    rng: np.random.Generator,
    sensor: SensorSpec,
    *,
    lean: FloatArray | None = None,
    flat: bool = False,
) -> PressPose:
    """Lean the object, turn it about the normal, and draw its position on the pad."""
    frame = frame_at(contact.normal)
    point = contact.point
    spin = rng.uniform(0, 2 * math.pi)
    cos, sin = math.cos(spin), math.sin(spin)
    turned = frame @ np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    # Wide faces stay mostly inside.
    margin = max(0.36 * (0.0 if face is None else face.span_mm), 0.6)
    reach = np.array([sensor.width_mm, sensor.height_mm]) / 2 - margin
    position = position_within(rng, reach.clip(min=0.5))
    if face is not None and face.end is not None:
        fraction = rng.uniform(*_COVERED_FRACTION)  # of the sensing area, for a wide face
        x, y = face.end
        end = np.array([x * cos + y * sin, y * cos - x * sin])
        length = max(float(np.hypot(*end)), 1e-6)
        right, down = end / length
        steps = (np.arange(64) + 0.5) / 64 - 0.5
        along = steps[None] * sensor.width_mm * right + steps[:, None] * sensor.height_mm * down
        position = (float(np.quantile(along, fraction)) - length) * (end / length)
    elif face is not None:
        point = point + frame[:, :2] @ face.centre
    slope = 0.0 if lean is None else float(np.hypot(*lean))
    if lean is not None and slope >= 1e-9:
        axis = frame[:, :2] @ np.array([-lean[1], lean[0]]) / slope
        turned = Rotation.from_rotvec(math.atan(slope) * axis).as_matrix() @ turned
    return PressPose(object_from_pad=turned, point=point - turned[:, :2] @ position, flat=flat)


def position_within(rng: np.random.Generator, reach: FloatArray) -> FloatArray:
    """Draw a position (2,) [mm]: uniform within ± reach (2,), or sometimes near the centre."""
    if rng.random() < _CENTRED:
        return np.asarray(np.clip(rng.normal(0, _CENTRED_MM, 2), -reach, reach))
    return np.asarray(rng.uniform(-reach, reach))
