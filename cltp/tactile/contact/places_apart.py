"""Whether what touches stands out in places that lie apart, as two contacts do.

What is read of a cloud is read of one contact: of two its place lies between them, and its force is
that of neither. Some bodies stand out in several places by their shape, and a tilted one at both of
its ends, so that this is no proof of two.

Loads no torch.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
from scipy import ndimage

from cltp.tactile.cells import height_grid
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.point_layout import GRID
from cltp.tactile.states import Shape

SPREAD_SHAPES = frozenset((Shape.STRIPES, Shape.WAVE, Shape.DOTS, Shape.PLANE))
"""Shapes whose contacts stand out in several places."""

LEAST_GAP_MM = 2.0
"""Least gap between places that lie apart. Our choice, as the next three are: of 959 contacts of
one body of other shapes 9 are called apart without noise, 26 with it; from 4 mm on 8 and 23."""

_LEAST_HEIGHT_MM = 0.15  # of the highest place
_LEVEL, _PEAK = 0.5, 0.6  # of it: the outline of a place, and how high it has to be
_LEAST_PLACE_MM2 = 1.0


def gap_mm(cloud: TactileCloud) -> float:
    """Gap between the places that stand out and lie farthest apart [mm]; 0 of one place."""
    heights = height_grid(cloud, GRID)
    cell_mm = cloud.sensor.width_mm / heights.shape[1]
    smooth = ndimage.uniform_filter(heights, 3, mode="nearest")
    smooth = smooth - np.median(smooth)
    highest = float(smooth.max())
    if highest < _LEAST_HEIGHT_MM:
        return 0.0
    places, count = ndimage.label(smooth > _LEVEL * highest, structure=np.ones((3, 3)))
    numbers = np.arange(1, count + 1)
    peaks = ndimage.maximum(smooth, places, numbers)
    areas_mm2 = np.bincount(places.ravel(), minlength=count + 1)[1:] * cell_mm**2
    kept = numbers[(peaks >= _PEAK * highest) & (areas_mm2 >= _LEAST_PLACE_MM2)]
    gaps = [
        cell_mm * float(ndimage.distance_transform_edt(places != one)[places == other].min())
        for one, other in combinations(kept.tolist(), 2)
    ]
    widest = max(gaps, default=0.0)
    return widest if widest >= LEAST_GAP_MM else 0.0


def apart_text(cloud: TactileCloud, shape: str | None) -> str:
    """Places that lie apart in words, without a full stop; '' of one place.

    Args:
        cloud: The cloud.
        shape: The shape that is read of it; None for none.
    """
    gap = 0.0 if shape in SPREAD_SHAPES else gap_mm(cloud)
    if not gap:
        return ""
    return f"it stands out in places {gap:.1f} mm apart; of two contacts one between them is read"
