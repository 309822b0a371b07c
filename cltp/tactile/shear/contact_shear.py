"""What a shear field tells of a held contact in a few arithmetic passes: force, shear, slip cues.

``ShearWatch`` follows one grip frame by frame. It keeps means of heights and displacements at rest,
which change only with the grip's force, and the last displacements along the gel. The cues of slip
are the shape of the displacement (a stuck contact is carried along alike, a sliding one most where
it is pressed most), the ratio of displacement to indentation, how both changed since the hold
began, and how far the indentation moved since then and of late.

Not here: the shape of the indentation (``cltp.tactile.shear.contact_shape``), the judgement
(``cltp.tactile.shear.slip``), what follows from it (``policies.reflex``).
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.contact_shape import (
    SMALL,
    ContactShape,
    grid_of,
)
from cltp.tactile.shear.field import ShearField

HEIGHT_MEMORY = 0.1
"""Least weight of a new frame in the mean of heights, which is that of all frames at first. Our
choice: ten frames, a tenth of a second."""

REST_MEMORY = 0.01
"""The same of the means at rest, which a slow slide must not carry along, and the gel's drift must.
Our choice: a second with taxels."""

LAG = 3
"""Frames between two displacements whose difference is a change."""

POWERS = (0.0, 0.5, 2.0, 3.0)
"""Powers of the height that weigh the displacement, beside the height itself."""

OUTSIDE = 0.1
"""Fraction of the depth up to which a point is not of the contact there. Our choice."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearCues:
    """A contact as one frame, with those before it, shows it.

    Attributes:
        along_mm: Displacement of the gel in the middle of the contact, (x, y) [mm].
        depth_mm: Largest mean indentation [mm].
        volume_mm3: Mean indentation times area [mm³], which grows with the normal force.
        values: Shape (NUM_VALUES,): the cues of slip, of order 1.
    """

    along_mm: tuple[float, float]
    depth_mm: float
    volume_mm3: float
    values: FloatArray


class ShearWatch:
    """Follows the shear field of one grip.

    Args:
        sensor: A sensor that measures shear.
        along_mm, depth_mm: Standard deviations of a point's displacement along the gel and into it,
            from frame to frame [mm].
    """

    def __init__(self, sensor: SensorSpec, along_mm: float, depth_mm: float) -> None:
        self._sensor, self._noise_mm = sensor, (along_mm, depth_mm)
        self._grid = grid_of(sensor)
        self._counts = np.zeros(self._grid.count)
        self._height_mm = np.zeros(self._grid.count)
        self._rest_mm = np.zeros((self._grid.count, 3))
        self._moved: deque[FloatArray] = deque(maxlen=2 * LAG + 1)
        self._found: deque[FloatArray] = deque(maxlen=2 * LAG + 1)

    @property
    def num_frames(self) -> int:
        """Frames kept so far, at most ``2 LAG + 1``."""
        return len(self._moved)

    def renew(self) -> None:
        """Begin the means anew: the force is about to change, or the body has slid."""
        self._counts = np.zeros(self._grid.count)

    def see(self, field: ShearField) -> ShearCues | None:
        """Take a frame; the cues, or None where it shows no contact yet."""
        if (shape := self._shape_with(field)) is None:
            return None
        drag = self._drag(shape)
        changes, others = self._common(shape, drag)
        return ShearCues(
            along_mm=(float(drag.now[0]), float(drag.now[1])),
            depth_mm=shape.depth_mm,
            volume_mm3=shape.volume_mm3,
            values=np.array([*changes, *others, *_samples(shape, drag)]),
        )

    def see_reserve(self, field: ShearField) -> FloatArray | None:
        """Take a frame; the cues of the reserve (NUM_OF_RESERVE,), or None as ``see``."""
        if (shape := self._shape_with(field)) is None:
            return None
        drag = self._drag(shape)
        changes, others = self._common(shape, drag)
        return np.array([*changes, *_profile(shape, drag), *others])

    def _shape_with(self, field: ShearField) -> ContactShape | None:
        """The shape of the contact once a frame is taken; None where it shows none."""
        grid = self._grid
        cells = grid.cells_of(field.positions_mm)
        moved, found = np.zeros((grid.count, 3)), np.zeros(grid.count)
        moved[cells], found[cells] = field.displacement_mm, 1.0
        self._keep(moved, found)
        return ContactShape.of(self._height_mm, grid)

    def _keep(self, moved: FloatArray, found: FloatArray) -> None:
        self._counts += found
        first = 1.0 / np.maximum(self._counts, 1.0)
        weight = found * np.maximum(HEIGHT_MEMORY, first)
        self._height_mm += weight * (moved[:, 2] - self._height_mm)
        weight = found * np.maximum(REST_MEMORY, first)
        self._rest_mm += weight[:, None] * (moved - self._rest_mm)
        self._moved.append(moved)
        self._found.append(found)

    def _drag(self, shape: ContactShape) -> _Drag:
        moved, found = np.array(self._moved), np.array(self._found)
        middles = _Middles(
            np.tensordot(moved[:, :, :2], shape.middle, (1, 0)), found @ shape.middle
        )
        now = middles.mean(-2, None)
        size = math.hypot(*now)
        noise = self._noise_mm[0] * shape.middle_noise
        seen = found[-2:].sum(axis=0)
        return _Drag(
            middles=middles,
            now=now,
            size=size,
            to=now / max(size, SMALL),
            noise=noise,
            scale=max(size, 3 * noise, SMALL),
            mean=(found[-2:, :, None] * moved[-2:, :, :2]).sum(axis=0)
            / np.maximum(seen, SMALL)[:, None],
            is_seen=seen > 0,
        )

    def _common(self, shape: ContactShape, drag: _Drag) -> tuple[list[float], list[float]]:
        """Cues that slip and reserve share: of the drag and its changes, and of the indentation."""
        rest = shape.middle @ self._rest_mm[:, :2]
        changes = [
            math.log1p(drag.size / max(drag.noise, SMALL)) / 3,
            drag.size / max(shape.depth_mm, SMALL) / 3,
            drag.noise / drag.scale,
            *(each / drag.scale for each in _changes(drag.middles, rest, drag.to)),
        ]
        others = [
            *shape.numbers(drag.to),
            math.log(max(shape.depth_mm, 1e-3) / 0.1),
            *self._moves(shape, drag.to),
        ]
        return changes, others

    def _moves(self, shape: ContactShape, to: FloatArray) -> list[float]:
        """How the indentation moved and grew since rest, since the frame before, and of late."""
        noise = max(self._noise_mm[1], SMALL)
        height, found = self._moved[-1][:, 2], self._found[-1]
        before = self._moved[max(-2, -len(self._moved))][:, 2]
        both = found * self._found[max(-2, -len(self._found))]
        since_rest, late = shape.changes(
            np.stack([height - self._rest_mm[:, 2], height - self._height_mm]), found, to, noise
        )
        (step,) = shape.changes((height - before)[None], both, to, noise * math.sqrt(2))
        return [
            float(np.clip(since_rest.along_mm, -2, 2)),
            float(np.clip(since_rest.growth, -1, 1)),
            *since_rest.over_errors,
            *step.over_errors,
            float(np.clip(late.along_mm, -2, 2)),
            math.log1p(10 * late.along_error_mm) / 2,
            late.over_errors[0],
        ]


class _Middles:
    """Displacements in the middle of the contact: sums (F, 2) and weights (F,) of kept frames."""

    def __init__(self, sums: FloatArray, weights: FloatArray) -> None:
        self._sums, self._weights = sums, weights

    def mean(self, first: int | None, last: int | None) -> FloatArray:
        """Mean over some frames, (2,) [mm]; the oldest frame where there are none."""
        part = slice(first, last)
        if not len(self._weights[part]):
            part = slice(0, 1)
        return np.asarray(self._sums[part].sum(axis=0) / max(self._weights[part].sum(), SMALL))


class _Drag(NamedTuple):
    """How far the gel is dragged in the middle of a contact, over the last two frames.

    Attributes:
        middles: Displacements in the middle, of all kept frames.
        now, size: That of the last two, (2,), and its size [mm].
        to: Its direction, (2,).
        noise, scale: What noise makes of it, and what displacements are divided by [mm].
        mean: Shape (N, 2), displacement of each point [mm].
        is_seen: Shape (N,), whether a point has one.
    """

    middles: _Middles
    now: FloatArray
    size: float
    to: FloatArray
    noise: float
    scale: float
    mean: FloatArray
    is_seen: NDArray[np.bool_]


def _changes(middles: _Middles, rest: FloatArray, to: FloatArray) -> list[float]:
    """The displacement in the middle against earlier ones, and against that at rest [mm]."""
    aside = np.array([-to[1], to[0]])
    now, before = middles.mean(-1, None), middles.mean(-2, -1)
    lately, earlier = middles.mean(-2, None), middles.mean(-2 - LAG, -LAG)
    earliest = middles.mean(None, -2 * LAG)
    pairs = [(lately - earlier, to), (earlier - earliest, to)]
    pairs += [(now, to), (now, aside), (now - before, to), (now - rest, to), (now - rest, aside)]
    return [float(each @ direction) for each, direction in pairs]


def _profile(shape: ContactShape, drag: _Drag) -> FloatArray:
    """Displacement over its scale by ring and harmonic, weighed by height, (NUM_PROFILE,)."""
    to, has = drag.to, drag.is_seen
    profile, aside = drag.mean @ to, drag.mean @ np.array([-to[1], to[0]])
    rings = shape.rings * has
    counts = np.maximum(rings.sum(axis=1), SMALL)
    means = (rings @ profile) / counts
    quadrupole = (rings[1:4] @ (profile * shape.twofold(to))) / counts[1:4]
    angle = shape.angle - math.atan2(to[1], to[0])
    discs = np.stack([rings[0] + rings[1], rings[2] + rings[3]])
    onefold = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    parts = [(discs * part) @ onefold for part in (profile, aside)]
    harmonics = np.concatenate(parts, axis=1) / np.maximum(discs.sum(axis=1), SMALL)[:, None]
    level = np.maximum(shape.height_mm / shape.depth_mm, 0.0)
    inside = has * (level > OUTSIDE)
    powers = np.stack([inside * level**power for power in (*POWERS, 1.0)])
    ratios = (powers @ profile) / np.maximum(powers @ level, SMALL)
    bends = ratios[:-1] - ratios[-1]
    parts = [*means[1:], *quadrupole, ratios[-1], *bends, *harmonics.ravel()]
    return np.array(parts) / drag.scale


def _samples(shape: ContactShape, drag: _Drag) -> FloatArray:
    """Displacement over its scale, along and across the drag, and height over depth, at ``SPOTS``.

    Returns:
        Shape (3 len(SPOTS),).
    """
    to = drag.to
    weights = shape.weights_at(SPOTS, to)
    known = weights * drag.is_seen
    known /= np.maximum(known.sum(axis=1, keepdims=True), SMALL)
    is_on_pad = weights.any(axis=1)
    turned = drag.mean @ np.array([[to[0], -to[1]], [to[1], to[0]]])
    along, across = (known @ turned).T * is_on_pad / drag.scale
    return np.concatenate([along, across, weights @ shape.height_mm / shape.depth_mm])


_RADII, _ANGLES = (0.5, 1.0, 1.5, 2.2), 8
SPOTS = np.array(
    [(0.0, 0.0)]
    + [
        (radius * math.cos(math.tau * k / _ANGLES), radius * math.sin(math.tau * k / _ANGLES))
        for radius in _RADII
        for k in range(_ANGLES)
    ]
)
"""Where the field about a contact is looked at: along and across the drag, in the contact's own
ellipse, whose edge a sphere's contact has at 1.2. Our choice: from inside it to the free gel."""

_MIRRORED = (6, 9, 22, 25)
"""Cues that change their sign in a mirror along the drag, beside the displacement across it."""

_NUM_COMMON, NUM_PROFILE = 3 + 7 + (4 + 4) + 1 + (2 + 3 + 3 + 3), 4 + 3 + 1 + len(POWERS) + 8
NUM_VALUES, NUM_OF_RESERVE = _NUM_COMMON + 3 * len(SPOTS), _NUM_COMMON + NUM_PROFILE
"""Numbers of the cues of slip, and of the reserve."""


def _mirror() -> tuple[NDArray[np.intp], FloatArray]:
    order, signs = np.arange(NUM_VALUES), np.ones(NUM_VALUES)
    signs[list(_MIRRORED)] = -1.0
    count = len(SPOTS)
    twins = [0] + [
        1 + ring * _ANGLES + -k % _ANGLES for ring in range(len(_RADII)) for k in range(_ANGLES)
    ]
    first = NUM_VALUES - 3 * count
    for part in range(3):
        order[first + part * count :][:count] = first + part * count + np.array(twins)
    signs[first + count :][:count] = -1.0
    return order, signs


MIRROR_ORDER, MIRROR_SIGNS = _mirror()
"""A mirror along the drag makes cues ``cues[..., MIRROR_ORDER] * MIRROR_SIGNS``."""
