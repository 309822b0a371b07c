"""From a cloud to a contact state, computed directly: depth, position, area, force. No learning.

This is what ``rules`` decides from, what ``describe`` prints, and the direct computation that
learned models are compared with. Shape and texture are not computed here. Loads no torch.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.states import ContactState, Side, area_word, depth_word, position_word

FloatArray = NDArray[np.float64]

NO_CONTACT_MM = 0.10
"""A gel whose deepest points lie less than this deep is untouched.

Our choice: with a drift of 0.04 mm about two of five untouched frames seem to be touched at this
limit, and a tenth of the grasps with 0.15-0.3 N are missed (``tacgrasp bench touch`` prints both).
A touch missed costs a second grasp, one imagined a step.
"""

FOOTPRINT_SHARE = 0.25
"""A point counts as pressed from this share of the depth on. Fitted on noisy contacts of berries,
tomatoes, eggs and pegs: the area class is then right most often (69 %). Flat punches would want 0.5
and soft textures less; a learned encoder knows which is which, this does not."""

_BODY_SHARE = 0.5  # what lies above this share of the depth says where the contact is
_REGION_SHARE = 0.3  # a region of less than this share of the largest one is drift, not contact
_TOP = 3  # points whose mean is the depth: one alone is at the mercy of the noise
_MAX_CELLS = 64


def contact_state(cloud: TactileCloud) -> ContactState:
    """Measure a contact.

    The cloud's points are averaged in square-ish cells, so that any sampling density will do. Depth
    is the mean of the three deepest cells; position the centroid of what is deeper than half of
    that, weighted by how much; area the share of cells deeper than a quarter; force follows from
    the volume displaced.
    """
    depths, x, y = _cells(cloud)
    depth = float(np.sort(depths[np.isfinite(depths)])[-_TOP:].mean())
    if depth < NO_CONTACT_MM:
        return ContactState(
            depth_mm=0.0,
            x_mm=0.0,
            y_mm=0.0,
            area_fraction=0.0,
            force_n=0.0,
            depth=None,
            position=None,
            area=None,
        )
    filled = np.nan_to_num(depths, nan=0.0)
    at_x, at_y = _place(filled, depth, x, y)
    pressed = filled > FOOTPRINT_SHARE * depth
    share = float(pressed.sum() / np.isfinite(depths).sum())
    return ContactState(
        depth_mm=depth,
        x_mm=at_x,
        y_mm=at_y,
        area_fraction=share,
        force_n=force_from(filled, depth, cloud.sensor.area_mm2),
        depth=depth_word(depth),
        position=position_word(at_x, at_y, cloud.sensor),
        area=area_word(share),
        cut=_cut(filled, depth),
    )


def _cells(cloud: TactileCloud) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Mean indentation in n × n cells of the field, NaN where no point is, and their centres."""
    sensor, points = cloud.sensor, cloud.points_mm.astype(np.float64)
    n = min(_MAX_CELLS, math.isqrt(len(points)))
    column = np.clip(((points[:, 0] / sensor.width_mm + 0.5) * n).astype(int), 0, n - 1)
    row = np.clip(((0.5 - points[:, 1] / sensor.height_mm) * n).astype(int), 0, n - 1)
    index = row * n + column
    count = np.bincount(index, minlength=n * n)
    total = np.bincount(index, weights=points[:, 2], minlength=n * n)
    with np.errstate(invalid="ignore"):
        mean = (total / count).reshape(n, n)
    centres = (np.arange(n) + 0.5) / n - 0.5
    return mean, centres * sensor.width_mm, -centres * sensor.height_mm


def _place(depths: FloatArray, depth: float, x: FloatArray, y: FloatArray) -> tuple[float, float]:
    """Centroid [mm] of what is deeper than half, without the stray regions that drift makes."""
    weight = np.clip(depths - _BODY_SHARE * depth, 0, None)
    regions, count = ndimage.label(weight > 0, structure=np.ones((3, 3)))
    sums = ndimage.sum_labels(weight, regions, np.arange(1, count + 1))
    stray = np.flatnonzero(sums < _REGION_SHARE * sums.max()) + 1
    weight[np.isin(regions, stray)] = 0
    total = weight.sum()
    return float((weight.sum(axis=0) @ x) / total), float((weight.sum(axis=1) @ y) / total)


def _cut(depths: FloatArray, depth: float) -> frozenset[Side]:
    """Sides along whose border the gel is pressed to at least half of the depth."""
    borders = {
        Side.TOP: depths[:2],
        Side.BOTTOM: depths[-2:],
        Side.LEFT: depths[:, :2],
        Side.RIGHT: depths[:, -2:],
    }
    return frozenset(
        side for side, border in borders.items() if (border > _BODY_SHARE * depth).sum() >= 3
    )


STIFFNESS_N_PER_MM3 = 0.167
"""Force over displaced volume. Fitted; see ``force_from``."""


def force_from(depths: FloatArray, depth: float, field_mm2: float) -> float:
    """Normal force [N] that a displaced volume suggests, for a gel like a GelSight Mini's.

    F = k V, V [mm³] the volume above a fifth of the depth. Source: fit to simulated berries,
    tomatoes, eggs and pegs with noise (seeds below 1000): the best of seven power laws in volume,
    depth and area, none of which was better by more than a hundredth. The residual is 0.15-0.32
    (one standard deviation of ln F, firm to soft, above 0.4 N), most of it the sensor's drift;
    ``tacgrasp bench touch`` prints it anew.
    """
    mean = float(np.clip(depths - max(0.2 * depth, 0.02), 0, None).mean())
    return STIFFNESS_N_PER_MM3 * mean * field_mm2
