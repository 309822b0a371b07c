"""From a cloud to a contact state, computed directly: depth, position, area, force. No learning.

The ``rules`` policy decides from this, ``describe`` prints it, and learned models are compared with
it. Shape and texture are not computed here. Loads no torch.
"""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from cltp.tactile.cells import cell_means, filled
from cltp.tactile.cloud import FloatArray, TactileCloud, grid_axes_mm
from cltp.tactile.local_volume import UPPER_FRACTION, local_contact, without_drift
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import (
    NO_CONTACT_STATE,
    ContactState,
    Side,
    area_word,
    depth_word,
    position_word,
)

NO_CONTACT_MM = 0.10
"""A gel whose deepest points lie less than this deep is untouched.

Our choice: with a drift of 0.04 mm about two of five untouched frames seem to be touched at this
limit, and a tenth of the grasps with 0.15-0.3 N are missed (``tacgrasp bench touch`` prints both).
A missed contact costs a second grasp, an imagined one costs a step.
"""

FOOTPRINT_FRACTION = 0.25
"""A point counts as in contact from this fraction of the depth on. Fitted on noisy contacts of
berries, tomatoes, eggs and pegs: the area class is then right most often (69 %). Flat punches would
want 0.5 and soft textures less; a learned encoder can tell them apart, this computation can't."""

_REGION_FRACTION = 0.3  # a region of less than this fraction of the largest one is drift
_DEEPEST_CELLS = 3  # cells whose mean is the depth: one alone is at the mercy of the noise


def contact_state(cloud: TactileCloud, *, in_contact: bool | None = None) -> ContactState:
    """Measure a contact.

    Args:
        cloud: The cloud.
        in_contact: Whether something touches the gel, where a test has shown it
            (``cltp.tactile.contact.contact_test``); None decides by the depth, ``NO_CONTACT_MM``.

    The cloud's points are averaged in square-ish cells, so that any sampling density will do. Depth
    is the mean of the three deepest cells. Position is the centroid of what is deeper than half of
    that, weighted by the excess. Area is the fraction of cells deeper than a quarter. Force follows
    from the volume that is displaced locally [nominal N], so that tilt and broad drift are no
    force, times the factor of the unit's force calibration. Where a test has shown a contact, the
    other numbers are taken over the surface around it too: broad drift may have lowered the whole
    pad below its reference. What drift may have raised far from the contact is then no area.

    The last results are kept: within one step policy, contract, record and screen measure the
    same cloud.
    """
    for known, tested, state in tuple(_measured):
        if known is cloud and tested is in_contact:
            return state
    state = _measure(cloud, in_contact)
    _measured.append((cloud, in_contact, state))
    return state


_measured: deque[tuple[TactileCloud, bool | None, ContactState]] = deque(maxlen=4)


def _measure(cloud: TactileCloud, in_contact: bool | None) -> ContactState:
    if in_contact is False:
        return NO_CONTACT_STATE
    cells = filled(cell_means(cloud))
    if in_contact is None and _deepest_mm(cells) < NO_CONTACT_MM:
        return NO_CONTACT_STATE
    local = local_contact(cells, cloud.sensor)
    heights = local.heights_mm if in_contact else cells
    depth = _deepest_mm(heights)
    if depth <= 0:
        return NO_CONTACT_STATE
    x, y = grid_axes_mm(cloud.sensor, *heights.shape)
    x_mm, y_mm = _centroid_mm(heights, depth, x, y)
    footprint = heights > FOOTPRINT_FRACTION * depth
    if in_contact:
        footprint = without_drift(footprint, heights, depth, cloud.sensor)
    fraction = float(footprint.mean())
    return ContactState(
        depth_mm=depth,
        x_mm=x_mm,
        y_mm=y_mm,
        area_fraction=fraction,
        force_n=cloud.force_scale.factor * stiffness_of(cloud.sensor) * local.volume_mm3,
        depth=depth_word(depth),
        position=position_word(x_mm, y_mm, cloud.sensor),
        area=area_word(fraction),
        cut=cut_sides(heights > UPPER_FRACTION * depth, least=3, width=2),
    )


def _deepest_mm(heights_mm: FloatArray) -> float:
    """Depth of heights: the mean of the deepest cells [mm]."""
    return float(np.sort(heights_mm, axis=None)[-_DEEPEST_CELLS:].mean())


def _centroid_mm(
    depths: FloatArray, depth: float, x: FloatArray, y: FloatArray
) -> tuple[float, float]:
    """Centroid [mm] of what is deeper than half, without the stray regions that drift makes."""
    weight = np.clip(depths - UPPER_FRACTION * depth, 0, None)
    regions, count = ndimage.label(weight > 0, structure=np.ones((3, 3)))
    sums = ndimage.sum_labels(weight, regions, np.arange(1, count + 1))
    stray = np.flatnonzero(sums < _REGION_FRACTION * sums.max()) + 1
    weight[np.isin(regions, stray)] = 0
    total = weight.sum()
    return float((weight.sum(axis=0) @ x) / total), float((weight.sum(axis=1) @ y) / total)


def cut_sides(footprint: NDArray[np.bool_], *, least: int, width: int = 1) -> frozenset[Side]:
    """Sides of the pad that a contact runs over.

    Args:
        footprint: Shape (H, W), row 0 = top: where the gel is in contact.
        least: Cells of a border that must be in contact.
        width: Rows or columns that make up a border.
    """
    borders = {
        Side.TOP: footprint[:width],
        Side.BOTTOM: footprint[-width:],
        Side.LEFT: footprint[:, :width],
        Side.RIGHT: footprint[:, -width:],
    }
    return frozenset(side for side, border in borders.items() if border.sum() >= least)


STIFFNESS_N_PER_MM3 = 0.39
"""Force over locally displaced volume (``cltp.tactile.local_volume``) of a GelSight Mini's gel of
nominal stiffness. Source: fit to simulated berries, tomatoes, eggs and pegs with noise (seeds below
1000), by the median of F / V above 0.4 N. ``tacgrasp bench touch`` prints it fitted anew, and the
residual: copy it here when the gel's nominal modulus or thickness changes."""

_OTHER_STIFFNESS = {"gelstereo": 0.19}
"""The same of sensors with another gel [N/mm³]: a GelStereo's is softer and thicker. Source: the
same fit, 160 contacts."""


def stiffness_of(sensor: SensorSpec) -> float:
    """Force over locally displaced volume of a sensor's nominal gel [N/mm³]."""
    return _OTHER_STIFFNESS.get(sensor.name, STIFFNESS_N_PER_MM3)
