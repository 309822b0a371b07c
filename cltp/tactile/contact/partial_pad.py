"""Whether part of the pad is not measured: no points, dead or many bad ones, or cut off heights.

What touches there is not seen, and what touches beside it is measured wrong: half of a contact has
half of the force, and a hole over it leaves nothing. Every sensor here measures all of its pad, so
that such a cloud was cut, is of another sensor, or comes from a broken one.

Loads no torch.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import ndimage

from cltp.tactile.cloud import TactileCloud

LEAST_COVERED = 0.98
"""Part of the pad that has to have points near. Our choice: a hole of 6 mm² in a GelSight
Mini's."""

LEAST_DEAD = 0.03
"""Part of the points that are exactly alike from which they are dead. Our choice: the corners
between the dead borders of a DIGIT come to 3 % at most."""

LEAST_CUT_OFF = 0.003
"""Part of the points at the largest height from which it is cut off. Our choice: 23 of 7,500."""

_LEAST_CUT_OFF = 20  # points: of a few, one is always the highest
_LEAST_RISE_MM = 0.02
_LEAST_UNLIKE = 0.5  # of the other points, of which no two are alike unless they are counted
_LEAST_NOISE_MM = 5e-4  # median; what bends without noise has less between three points
_POINTS_PER_CELL = 10  # with so many on average, even random points leave one of 20,000 cells empty
_MOST_CELLS = 32  # along either side
_LEAST_GAP = 0.1  # of a side, between its end and the first point
_LEAST_COUNT = 8  # of dead points
_LEAST_JUMP_MM = 0.003  # of the points beside dead ones; a coarse count steps by less
_DEAD_NEIGHBOURS = 0.6  # of those around a dead point, 5 of 8, are dead too
_MOST_FREQUENT = 5.0  # a dead value's frequency over the next one's


def is_partial(cloud: TactileCloud) -> bool:
    """Whether part of the pad is not measured."""
    return bool(_reason(cloud))


def partial_text(cloud: TactileCloud) -> str:
    """A pad that is measured in part in words, without a full stop."""
    return f"{_reason(cloud)}: what touches the rest is not seen"


def _reason(cloud: TactileCloud) -> str:
    """Why part of the pad is not measured; '' where all of it is."""
    covered = covered_part(cloud)
    if covered < LEAST_COVERED:
        return f"points cover {covered:.0%} of the pad"
    if cloud.num_isolated:
        return f"{cloud.num_isolated} of {len(cloud.points_mm)} points stand far from all others"
    if dead := dead_part(cloud):
        return f"{dead:.0%} of the points are exactly alike, as dead ones are"
    if cut_off := cut_off_part(cloud):
        return f"the highest {cut_off:.0%} of the points are exactly alike, as if cut off there"
    return ""


def covered_part(cloud: TactileCloud) -> float:
    """Part of the pad with points near, by cells that even points would leave none of empty."""
    if cloud.grid is not None:
        return 1.0
    size_mm = np.array([cloud.sensor.width_mm, cloud.sensor.height_mm])
    place = cloud.points_mm[:, :2] / size_mm + 0.5
    n = min(_MOST_CELLS, math.isqrt(len(place) // _POINTS_PER_CELL))
    column, row = np.clip(place * n, 0, n - 1).astype(np.intp).T
    covered = float(np.count_nonzero(np.bincount(row * n + column)) / n**2)
    gap = max(_LEAST_GAP, _POINTS_PER_CELL / len(place), 1 / math.sqrt(len(place)))
    low, high = place.min(axis=0), place.max(axis=0)
    if max(low.max(), 1 - high.min()) > gap:  # few points, whose cells are large
        covered = min(covered, float(np.prod(high - low)))
    return covered


def cut_off_part(cloud: TactileCloud) -> float:
    """Part of the points of a noisy grid at its very largest height: where it is cut off; else 0.

    A flat body is as flat, but for the noise that all other points have. Of heights that are
    counted in steps, and of clouds without noise, nothing is said.
    """
    if cloud.grid is None:
        return 0.0
    z = cloud.points_mm[:, 2].reshape(cloud.grid)
    is_highest = z == z.max()
    count = np.count_nonzero(is_highest)
    part = count / z.size
    if count < _LEAST_CUT_OFF or part < LEAST_CUT_OFF or count == z.size:
        return 0.0
    heights = z.astype(np.float64)
    others = heights[~is_highest]
    if heights.max() - np.median(heights) < _LEAST_RISE_MM:  # it is what nothing touches
        return 0.0
    if len(np.unique(others)) < _LEAST_UNLIKE * len(others):
        return 0.0
    bends = np.diff(np.diff(heights, 2, axis=0), 2, axis=1) / 6  # no curve along either axis
    is_away = ~ndimage.binary_dilation(is_highest, iterations=2)[1:-1, 1:-1]
    noise_mm = float(np.median(np.abs(bends[is_away]))) if is_away.any() else 0.0
    return float(part) if noise_mm > _LEAST_NOISE_MM else 0.0


def dead_part(cloud: TactileCloud) -> float:
    """Part of the points that are dead: alike to the last bit, and unlike all around; 0 for few.

    The lowest and the highest value are none: a sensor may cut off there, and a flat body is flat
    (``cut_off_part``).
    """
    z = cloud.points_mm[:, 2]
    if cloud.grid is not None:  # a look that is quicker than sorting
        heights = z.reshape(cloud.grid)
        if np.count_nonzero(heights[:, 1:] == heights[:, :-1]) < LEAST_DEAD * len(z) / 3:
            return 0.0
    values, counts = np.unique(z, return_counts=True)
    most = int(counts.argmax())
    part = counts[most] / len(z)
    is_cut_off = most in (0, len(values) - 1)
    if part < LEAST_DEAD or counts[most] < _LEAST_COUNT or is_cut_off:
        return 0.0
    if counts[most] < _MOST_FREQUENT * np.delete(counts, most).max():
        return 0.0
    dead, beside = z == values[most], z != values[most]
    if cloud.grid is not None:
        alike = dead.reshape(cloud.grid).astype(np.float64)
        around = ndimage.uniform_filter(alike, 3, mode="nearest") * 9 - alike
        in_block = (alike > 0) & (around >= _DEAD_NEIGHBOURS * 8)
        part = np.count_nonzero(in_block) / len(z)
        beside = ~(alike > 0).ravel() & ndimage.binary_dilation(in_block).ravel()
    if part < LEAST_DEAD or not beside.any():
        return 0.0
    jump_mm = float(np.median(np.abs(z[beside] - values[most])))
    return float(part) if jump_mm > _LEAST_JUMP_MM else 0.0
