"""Closes two pads on a mesh at many candidate places at once, by casting rays (open3d).

Not here: which places are candidates, and which is chosen (``sim.grasp.antipodal``).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cltp.tactile.cloud import FloatArray

CLEAR_MM = 2.0
"""Room that each finger needs beside the body before it closes [mm]. The pad stands out from the
finger by as much: our choice, less than the gel's thickness."""

INDENTATION_MM = 0.3
"""Indentation at which a patch is measured [mm], of the order of a firm grasp."""

MAX_OFF_PAD = 0.25
"""Largest distance of a patch's centroid from the pad's centre, in sides of the pad. Our choice:
one that stays farther out is a tilted face, whose contact follows the pad's edge."""

FINGER_MM = 25.0
"""Thickness of a finger [mm]. Our choice, of the order of a GelSight Mini's housing."""

_STEPS = 15  # rays along each side of a pad
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, slots=True)
class Candidates:
    """K candidates: centres (K, 3) [mm], closing directions (K, 3), half widths (K,) [mm]."""

    centre: FloatArray
    closing: FloatArray
    half: FloatArray

    def take(self, index: Any) -> Candidates:
        return Candidates(self.centre[index], self.closing[index], self.half[index])

    @property
    def right(self) -> FloatArray:
        """The pad's +x in the mesh's frame, (K, 3)."""
        return np.cross(_UP, self.closing)


@dataclass(frozen=True, slots=True)
class Touches:
    """What both pads touch, the camera's first; arrays of (2, K).

    Attributes:
        reach: Distance of the touching pad from the centre, along its side [mm].
        area: Area of the patch [mm²].
        x, y: Centroid of the patch on the pad, along the pad's +x of the camera's side [mm].
        is_off: Whether the centroid is too far from the pad's centre.
        is_free: Whether the finger has room.
    """

    reach: FloatArray
    area: FloatArray
    x: FloatArray
    y: FloatArray
    is_off: Any
    is_free: Any


class PadCaster:
    """Casts the pads of candidates against a mesh."""

    def __init__(self, scene: Any, tensor: Any, pad_mm: tuple[float, float], top_mm: float) -> None:
        self._scene, self._tensor, self._pad_mm, self._top_mm = scene, tensor, pad_mm, top_mm
        x, y = ((np.arange(_STEPS) + 0.5) / _STEPS - 0.5) * np.array(pad_mm)[:, None]
        self._x, self._y = (grid.ravel() for grid in np.meshgrid(x, y))
        self._cell_mm2 = pad_mm[0] * pad_mm[1] / _STEPS**2

    def touch(self, candidates: Candidates) -> Touches:
        """Close both pads of each candidate on the mesh."""
        sides = [self._touch_side(candidates, sign) for sign in (1.0, -1.0)]
        return Touches(*(np.stack(values) for values in zip(*sides, strict=True)))

    def _cast(self, origins: FloatArray, directions: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Distance to the first hit (infinite for none), and normal of the hit, per ray."""
        rays = np.concatenate(np.broadcast_arrays(origins, directions), axis=-1)
        hits = self._scene.cast_rays(self._tensor(rays.astype(np.float32)))
        return hits["t_hit"].numpy().astype(np.float64), hits["primitive_normals"].numpy()

    def _touch_side(self, candidates: Candidates, sign: float) -> tuple[Any, ...]:
        outward = sign * candidates.closing[:, None]
        start = candidates.half + CLEAR_MM
        points = (
            candidates.centre[:, None]
            + self._x[:, None] * candidates.right[:, None]
            + self._y[:, None] * _UP
        )
        distance, normal = self._cast(points + start[:, None, None] * outward, -outward)
        is_inside = (normal * outward).sum(axis=-1) < 0  # the first hit is seen from behind
        starts_inside = (np.isfinite(distance) & is_inside).any(axis=1)
        # a surface behind the middle belongs to the other side
        distance[distance > start[:, None] + candidates.half[:, None]] = np.inf
        nearest = distance.min(axis=1)
        nearest = np.where(np.isfinite(nearest), nearest, start)
        patch = distance < (nearest + INDENTATION_MM)[:, None]
        count = np.maximum(patch.sum(axis=1), 1)
        x, y = ((patch * grid).sum(axis=1) / count for grid in (self._x, self._y))
        reach = start - nearest
        limit_x, limit_y = (MAX_OFF_PAD * side for side in self._pad_mm)
        is_off = (np.abs(x) > limit_x) | (np.abs(y) > limit_y)
        is_free = ~starts_inside & self._has_room(candidates, outward, reach)
        return reach, patch.sum(axis=1) * self._cell_mm2, x, y, is_off, is_free

    def _has_room(self, candidates: Candidates, outward: FloatArray, reach: FloatArray) -> Any:
        """Whether nothing of the mesh stands where the finger is, from the pad's lower end up."""
        depth = np.linspace(CLEAR_MM, CLEAR_MM + FINGER_MM, 9)
        across = np.linspace(-0.5, 0.5, 7) * self._pad_mm[0]
        x, d = (grid.ravel() for grid in np.meshgrid(across, depth))
        points = (
            candidates.centre[:, None]
            + x[:, None] * candidates.right[:, None]
            + (reach[:, None] + d)[..., None] * outward
        )
        points[..., 2] = self._top_mm
        distance, _ = self._cast(points, np.array([0.0, 0.0, -1.0]))
        lower_end = candidates.centre[:, 2] - self._pad_mm[1] / 2
        return (self._top_mm - distance <= lower_end[:, None]).all(axis=1)
