"""How an object comes to lie on the pad: where it is met, how it leans, turns and where it ends up.

Large objects are met along random lines (``sim.objects.ray_casting.meet``) and lean by up to 15°
from there. Small ones are held by their shank, met like large ones, or turned to a random
orientation of the unit sphere and brought down as they are. What is flat in a direction settles
there: a lean stays only as far as it keeps the contact on the pad. A flat face is shifted so that
it can be seen for what it is: a small one mostly inside the field, a large one with its end in it,
since a pad that is pressed evenly everywhere feels nothing.

Not here: loads and labels (``sim.tcl3d.series``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import torch

from cltp.tactile.sensors import SensorSpec
from sim.objects.object import Hold, Thing
from sim.objects.ray_casting import (
    Castable,
    FloatArray,
    Meeting,
    frame_at,
    gradient,
    meet,
    support,
    unit_vector,
)
from sim.objects.skins import SMOOTH

CONE_DEG = 15.0
"""Largest angle between approach and normal. Source: the paper, section 3.1."""

MET_SHARE = 0.55
"""Of the presses of small objects that aren't held on purpose; the others are turned at random."""

SHIFT_MM = 4.5
"""Furthest that leaning may carry a contact over the pad."""

EVEN_SHARE = 0.2
"""A flat face may lean until its ends differ by this share of its lightest depth."""

_PAD_MM = 20.0

_FLAT_PER_MM = 1 / 150  # curvature below which a surface is flat
_SMALL_MM, _FURTHEST_MM = (18.0, 60.0)
_COVERED = (0.87, 0.97)  # share of the field under a large face
_CENTRED, _CENTRED_MM = 0.3, 2.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """Where the pad is.

    Attributes:
        object_from_pad: Rotation (3, 3); the third column is z, into the gel.
        point: What of the object lies over the pad's origin, object frame (3,) [mm].
        flat: Whether it was met on a flat face.
        wide: Whether that face is larger than the pad.
    """

    object_from_pad: FloatArray
    point: FloatArray
    flat: bool
    wide: bool


def draw_pose(
    thing: Thing,
    rng: np.random.Generator,
    sensor: SensorSpec,
    lightest_mm: float,
    *,
    held: bool = False,
) -> Pose:
    """Draw how an object comes to lie on the pad of a sensor.

    Args:
        thing: The object.
        rng: Draws it.
        sensor: Whose pad.
        lightest_mm: Depth of the lightest press [mm]: a flat face leans less than that.
        held: Whether it is held on purpose, if it can be.
    """
    if rng.random() < (1.0 if held else thing.held):
        hold = thing.holds[int(rng.integers(len(thing.holds)))]
        return _held(thing, hold, rng, sensor, lightest_mm)
    if thing.small and rng.random() >= MET_SHARE:
        return _placed(thing, support(thing, unit_vector(rng)), None, rng, sensor)
    textured = any(part.skin is not SMOOTH for part in thing.parts)
    return felt_pose(thing, meet(thing, rng), rng, sensor, lightest_mm, textured=textured)


def felt_pose(
    thing: Castable,
    met: Meeting,
    rng: np.random.Generator,
    sensor: SensorSpec,
    lightest_mm: float,
    *,
    textured: bool,
) -> Pose:
    """A pose about a point of a surface, with a lean that its curvatures allow."""
    frame = frame_at(met.normal)
    bends = [_bend(thing, met, frame[:, axis]) for axis in (0, 1)]
    oblique = [_bend(thing, met, (frame[:, 0] + s * frame[:, 1]) / math.sqrt(2)) for s in (1, -1)]
    flat = max(*bends, *oblique) < _FLAT_PER_MM
    slope = math.tan(math.radians(CONE_DEG)) * math.sqrt(rng.random())
    towards = rng.uniform(0, 2 * math.pi)
    lean = slope * np.array([math.cos(towards), math.sin(towards)])
    face = _face(thing, met, frame) if flat else None
    even = EVEN_SHARE * lightest_mm / (_PAD_MM if face is None else face.felt_mm)
    lean = _settled(lean, np.array(bends), np.array(oblique), even)
    if face is not None and face.wide and textured and rng.random() < 0.4:
        # A texture is felt without an end in sight.
        face = _Face(span_mm=4 * _PAD_MM, centre=face.centre, end=None)
    return _placed(thing, met, face, rng, sensor, lean=lean, frame=frame, flat=flat)


def _held(
    thing: Thing, hold: Hold, rng: np.random.Generator, sensor: SensorSpec, lightest_mm: float
) -> Pose:
    met = Meeting(point=np.array(hold.at), normal=np.array(hold.towards))
    frame = frame_at(met.normal)
    most = math.tan(math.radians(hold.most_tilt_deg))
    face = _face(thing, met, frame)
    face = _Face(span_mm=face.felt_mm, centre=np.zeros(2), end=None)
    if hold.most_tilt_deg <= 2:
        most = min(most, EVEN_SHARE * lightest_mm / face.felt_mm)
    slope, towards = most * rng.random(), rng.uniform(0, 2 * math.pi)
    lean = slope * np.array([math.cos(towards), math.sin(towards)])
    level = hold.most_tilt_deg <= 2
    return _placed(thing, met, face, rng, sensor, lean=lean, frame=frame, flat=level)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Face:
    """A flat side: largest width, its middle from where it was met, and its nearest end if wide."""

    span_mm: float
    centre: FloatArray
    end: FloatArray | None

    @property
    def wide(self) -> bool:
        return self.end is not None

    @property
    def felt_mm(self) -> float:
        """Largest width on a pad."""
        return float(np.clip(self.span_mm, 2.0, _PAD_MM))


def _face(thing: Castable, met: Meeting, frame: FloatArray) -> _Face:
    """How far a flat side goes in 24 directions from where it was met."""
    angles = np.arange(24) * (2 * math.pi / 24)
    ways = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    steps = np.arange(0.25, _FURTHEST_MM, 0.5)
    at = met.point + (steps[:, None, None] * ways[None]) @ frame[:, :2].T - 0.05 * met.normal
    outside = thing.distance(torch.from_numpy(at)).numpy() > 0.35
    # Where it is outside and stays so within a pad's width: gaps between bars are no ends.
    inside = ~outside
    last = np.where(inside.any(0), inside.shape[0] - 1 - inside[::-1].argmax(0), 0)
    reach = steps[last]
    ends = reach[:, None] * ways
    span = float((reach + np.roll(reach, 12)).max())
    narrow = float((reach + np.roll(reach, 12)).min())
    if span <= _SMALL_MM or narrow <= 0.5 * _SMALL_MM:
        return _Face(span_mm=min(span, _PAD_MM), centre=ends.mean(axis=0), end=None)
    return _Face(span_mm=span, centre=ends.mean(axis=0), end=ends[int(reach.argmin())])


def _bend(thing: Castable, met: Meeting, way: FloatArray, step_mm: float = 0.8) -> float:
    """Normal curvature along a direction [1/mm], at least 0."""
    ahead = gradient(thing, met.point + step_mm * way)
    back = gradient(thing, met.point - step_mm * way)
    return max(0.0, float((ahead - back) @ way) / (2 * step_mm))


def _settled(lean: FloatArray, bends: FloatArray, oblique: FloatArray, even: float) -> FloatArray:
    """A lean (2,) as slope, less what would carry the contact off the pad."""
    mixed = (oblique[0] - oblique[1]) / 2
    bending = np.array([[bends[0], mixed], [mixed, bends[1]]])
    values, ways = np.linalg.eigh(bending)
    most = np.maximum(SHIFT_MM * values.clip(min=0), even)
    return np.asarray(ways @ np.clip(ways.T @ lean, -most, most))


def _placed(
    thing: Castable,
    met: Meeting,
    face: _Face | None,
    rng: np.random.Generator,
    sensor: SensorSpec,
    *,
    lean: FloatArray | None = None,
    frame: FloatArray | None = None,
    flat: bool = False,
) -> Pose:
    """Lean, turn, and choose where on the pad."""
    frame = frame_at(met.normal) if frame is None else frame
    point, wide = met.point, False
    spin = rng.uniform(0, 2 * math.pi)
    turned = frame @ _about_z(spin)
    at = _place(rng, sensor, 0.0 if face is None else face.span_mm)
    if face is not None and face.end is not None:
        wide = True
        at = _covering(face.end, spin, sensor, rng.uniform(*_COVERED))
    elif face is not None:
        point = point + frame[:, :2] @ face.centre
    if lean is not None:
        turned = _leaning(frame, lean) @ turned
    return Pose(object_from_pad=turned, point=point - turned[:, :2] @ at, flat=flat, wide=wide)


def _covering(end: FloatArray, spin: float, sensor: SensorSpec, share: float) -> FloatArray:
    """Where a wide face must be met so that its end leaves ``share`` of the field under it (2,)."""
    cos, sin = math.cos(spin), math.sin(spin)
    towards = np.array([end[0] * cos + end[1] * sin, end[1] * cos - end[0] * sin])
    length = max(float(np.hypot(*towards)), 1e-6)
    way = towards / length
    x = (np.arange(64) + 0.5) / 64 - 0.5
    along = x[None] * sensor.width_mm * way[0] + x[:, None] * sensor.height_mm * way[1]
    return np.asarray((float(np.quantile(along, share)) - length) * way)


def _place(rng: np.random.Generator, sensor: SensorSpec, span_mm: float) -> FloatArray:
    """A place on the pad (2,) [mm]; wide things stay mostly inside."""
    reach = np.array([sensor.width_mm, sensor.height_mm]) / 2 - max(0.36 * span_mm, 0.6)
    reach = reach.clip(min=0.5)
    if rng.random() < _CENTRED:
        return np.asarray(np.clip(rng.normal(0, _CENTRED_MM, 2), -reach, reach))
    return np.asarray(rng.uniform(-reach, reach))


def _about_z(angle: float) -> FloatArray:
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])


def _leaning(frame: FloatArray, lean: FloatArray) -> FloatArray:
    """Rotation (3, 3), object frame, that leans a frame's normal by a slope (2,)."""
    slope = float(np.hypot(*lean))
    if slope < 1e-9:
        return np.eye(3)
    axis = frame[:, :2] @ np.array([-lean[1], lean[0]]) / slope
    angle = math.atan(slope)
    cross = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    return np.asarray(np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross)
