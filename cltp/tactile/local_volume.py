"""The volume that a contact displaces, without what is only tilted, broad or elsewhere.

A contact is local: a plane and a quadratic surface, fitted to the cells around it, take away tilt
and broad drift, and only the region around the strongest local response counts. Drift that is as
high as the foot of a contact adjoins it there, and is left out (``without_drift``).

Not here: the force that follows from it (``cltp.tactile.measure``), the test whether there is a
contact at all (``cltp.tactile.contact.contact_test``). Loads no torch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from cltp.tactile.cells import quadratic_basis, smoothed
from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.quantiles import median, quantile, spread_about
from cltp.tactile.sensor_noise import MINI_SPREAD, SPREADS, drift_in
from cltp.tactile.sensors import SensorSpec

BoolArray = NDArray[np.bool_]

FRACTION = 0.2
"""Only what is deeper than this fraction of the depth counts. Source: fit, as
``cltp.tactile.measure.STIFFNESS_N_PER_MM3``; 0.15 and 0.3 were no better."""

LEAST_MM = 0.005
"""Least height that counts [mm]. Our choice: without noise the law then holds from 0.1 N on."""

NOISE_FACTOR = 1.25
"""Heights below so many standard deviations of the cells' own noise do not count. Our choice: with
1, 5 % of 1000 untouched frames read more than 0.2 N if taken for contacts, with 1.5, 2 %; but
contacts of 0.1 to 0.2 N then read 4 % lower than with 1."""

SCALE_MM = 1.0
"""Width of the inner Gaussian of the response that a contact is found by [mm]. Source: of 133
simulated light presses (below 0.5 N) with the noise of a GelSight Mini, drift is taken for the
contact in 3; with 1.6 mm in 16."""

WIDE_SCALE_MM = 1.6
"""The same for ``WIDE_RESPONSE_MM`` [mm]."""

UPPER_FRACTION = 0.5
"""The upper part of a contact is deeper than this fraction of the depth. Our choice."""

FAR_MM, FAR_PART = 1.0, 0.6
"""Distance from the upper part of a contact, at least [mm] and over the radius of a disc of that
size, beyond which what drift can reach is drift. Our choice: a rigid ball ends at 0.41 of it."""

REACHED_DRIFTS = 3.0
"""Standard deviations of drift that it can reach. Our choice."""

SLOPE_SCALE_MM = 0.6
"""Width of the Gaussian that heights are smoothed with before their slope is taken [mm]."""

REACH_MM = 2.0
"""The deepest cells within this distance of the strongest response give the depth [mm]."""

RIM_MM = 1.0
"""Width of the ring around a contact that the background is not fitted to [mm]."""

LEAST_OUTSIDE = 0.15
"""Least fraction of cells outside a contact that a background is fitted to; with fewer, 0 is it."""

LOW_PART, ZERO_DRIFTS, LEAST_ZERO_MM = 0.02, 2.0, 0.08
"""Where the median lies further above zero than drift does, and this part of the pad does not, a
contact covers the most of the pad: the median is on it, and the cloud's own zero is the background.
Drift as of a pad that is raised (``cltp.tactile.contact.raised_pad``), which has no such part. A
sensor that loses the zero has the median at 0, and shows too little of such a contact."""

WIDE_RESPONSE_MM = 0.07
"""Least local response of such a contact [mm]; a ball of 100 mm has it. Source: 99 of 100 fields of
drift of 0.3 mm over 15 mm, the broadest of a unit that was left nearly alone, respond with less."""

WIDE_SLOPE = 0.035
"""Least slope of its edge, where it leaves the drift [mm per mm]; a ball of 130 mm has it. Our
choice: a light contact on a pad that is tilted or broadly raised has the slope of these around it,
0.028 along either axis in the same drift."""

BULGE = 0.4
"""Height of the gel that bulges around a wide contact over the contact's own. Source: 0.36 around
flat punches of 13 to 21 mm, 0.3 mm deep."""

_DEEPEST_CELLS = 3
_BESIDE = ndimage.generate_binary_structure(2, 1)


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalContact:
    """A contact without what is tilted, broad or elsewhere.

    Attributes:
        heights_mm: Shape (n, n), heights over the surface that surrounds the contact [mm].
        volume_mm3: Volume between the gel and that surface; 0 where nothing stands out.
    """

    heights_mm: FloatArray
    volume_mm3: float


def local_contact(cells_mm: FloatArray, sensor: SensorSpec) -> LocalContact:
    """Find the contact and its surroundings.

    Args:
        cells_mm: Shape (n, n), mean indentation in equal cells of the sensing area [mm].
        sensor: The sensor.
    """
    is_raised = _is_mostly_raised(cells_mm, sensor)
    response_mm = _responses(cells_mm, sensor, WIDE_SCALE_MM).max() if is_raised else 0.0
    local = _local_contact(cells_mm, sensor, is_wide=response_mm >= WIDE_RESPONSE_MM)
    if local.volume_mm3 == 0 and is_raised:  # the median is on its flat top
        return _local_contact(cells_mm, sensor, is_wide=True)
    return local


def _local_contact(cells_mm: FloatArray, sensor: SensorSpec, *, is_wide: bool) -> LocalContact:
    """The contact over its surroundings, or over the cloud's own zero where it is wide."""
    near = _near_strongest(cells_mm, sensor)
    noise_mm = NOISE_FACTOR * white_noise_mm(cells_mm)
    if is_wide:  # near the strongest response of a flat top is any of its places
        near = np.ones_like(near)
    background: FloatArray | float = 0.0 if is_wide else median(cells_mm)
    for is_last in (False, True):
        local = cells_mm - background
        depth = float(np.sort(local[near])[-_DEEPEST_CELLS:].mean())
        level = max(FRACTION * depth, LEAST_MM, noise_mm)
        deepest = int(np.where(near, local, -np.inf).argmax())
        contact = _region_of(deepest, local > level)
        if not contact.any():
            return LocalContact(heights_mm=local, volume_mm3=0.0)
        if not is_wide:
            contact = _region_of(deepest, without_drift(contact, local, depth, sensor))
        if not is_last and not is_wide:
            background = _background(cells_mm, contact, sensor)
    cell_mm2 = sensor.area_mm2 / cells_mm.size
    volume_mm3 = float((local[contact] - level).sum() * cell_mm2)
    return LocalContact(heights_mm=local, volume_mm3=volume_mm3)


def without_drift(
    contact: BoolArray, heights_mm: FloatArray, depth_mm: float, sensor: SensorSpec
) -> BoolArray:
    """The cells of a contact without those that are far from its upper part and may be drift.

    Args:
        contact: Shape (n, n), cells that are deeper than the foot of the contact.
        heights_mm: Shape (n, n), heights over the surface that surrounds the contact [mm].
        depth_mm: Depth of the contact [mm].
        sensor: The sensor.
    """
    drift_mm = REACHED_DRIFTS * drift_in(heights_mm, SPREADS.get(sensor.name, MINI_SPREAD))
    may_be_drift = contact & (heights_mm < drift_mm)
    if not may_be_drift.any():
        return contact
    upper = contact & (heights_mm > UPPER_FRACTION * depth_mm)
    rows, columns = contact.shape
    pitch_mm = (sensor.height_mm / rows, sensor.width_mm / columns)
    radius_mm = math.sqrt(np.count_nonzero(upper) * math.prod(pitch_mm) / math.pi)
    distance_mm = ndimage.distance_transform_edt(~upper, sampling=pitch_mm)
    is_far = distance_mm > max(FAR_MM, FAR_PART * radius_mm)
    return np.asarray(contact & ~(is_far & may_be_drift))


def _region_of(cell: int, mask: BoolArray) -> BoolArray:
    """The connected cells of a mask that hold one cell; none where that is not in the mask."""
    regions, _ = ndimage.label(mask, _BESIDE)
    return np.asarray(mask & (regions == regions.flat[cell]))


def _is_mostly_raised(cells_mm: FloatArray, sensor: SensorSpec) -> bool:
    """Whether the most of the pad stands out of the cloud's own zero, with an edge."""
    if not _keeps_zero(cells_mm, sensor):
        return False
    most_mm = _most_zero_mm(sensor)
    smooth = smoothed(cells_mm, sensor, SLOPE_SCALE_MM)
    rows, columns = cells_mm.shape
    down, across = np.gradient(smooth, sensor.height_mm / rows, sensor.width_mm / columns)
    stands = smooth > most_mm
    edge = stands & ~ndimage.binary_erosion(stands, border_value=1)
    return bool(edge.any() and median(np.hypot(down, across)[edge]) >= WIDE_SLOPE)


def _keeps_zero(cells_mm: FloatArray, sensor: SensorSpec) -> bool:
    """Whether the median lies further above zero than drift, and a part of the pad does not."""
    low_mm, median_mm = quantile(cells_mm, LOW_PART), median(cells_mm)
    most_mm = _most_zero_mm(sensor)
    least_mm = -max(most_mm, BULGE * median_mm)
    return median_mm > most_mm and least_mm <= low_mm <= most_mm


def _most_zero_mm(sensor: SensorSpec) -> float:
    """How far drift may take the zero [mm]."""
    drift_mm = SPREADS.get(sensor.name, MINI_SPREAD).drift_mm
    return max(ZERO_DRIFTS * drift_mm, LEAST_ZERO_MM)


def white_noise_mm(heights_mm: FloatArray) -> float:
    """Standard deviation of what differs from cell to cell at random [mm].

    From each cell less the mean of its four neighbours; the median ignores edges of a contact.
    """
    inner = heights_mm[1:-1, 1:-1]
    around = heights_mm[:-2, 1:-1] + heights_mm[2:, 1:-1]
    around = around + heights_mm[1:-1, :-2] + heights_mm[1:-1, 2:]
    return spread_about(inner - around / 4, 0.0) / math.sqrt(1.25)


def _near_strongest(heights_mm: FloatArray, sensor: SensorSpec) -> BoolArray:
    """Cells near the strongest response of the band filter that a contact is found by."""
    responses = _responses(heights_mm, sensor, SCALE_MM)
    row, column = np.unravel_index(int(responses.argmax()), heights_mm.shape)
    x, y = grid_axes_mm(sensor, *heights_mm.shape)
    return np.asarray(np.hypot(x[None, :] - x[column], y[:, None] - y[row]) < REACH_MM)


def _responses(heights_mm: FloatArray, sensor: SensorSpec, scale_mm: float) -> FloatArray:
    """Responses (n, n) of a band filter to heights less a plane [mm]."""
    above = heights_mm - _fitted_plane(heights_mm, sensor)
    inner, outer = (smoothed(above, sensor, scale) for scale in (scale_mm, 2 * scale_mm))
    return inner - outer


def _fitted_plane(heights_mm: FloatArray, sensor: SensorSpec) -> FloatArray:
    """The plane nearest to heights (n, n), shape (n, n) [mm]."""
    basis = quadratic_basis(len(heights_mm), sensor)[:, :3]
    weights = _plane_weights(len(heights_mm), sensor) @ heights_mm.ravel()
    return np.asarray((basis @ weights).reshape(heights_mm.shape))


@lru_cache(maxsize=8)
def _plane_weights(n: int, sensor: SensorSpec) -> FloatArray:
    """What each of n × n heights adds to the weights of the nearest plane, (3, n²)."""
    weights: FloatArray = np.linalg.pinv(quadratic_basis(n, sensor)[:, :3]).astype(np.float64)
    weights.setflags(write=False)
    return weights


def _background(
    heights_mm: FloatArray, contact: BoolArray, sensor: SensorSpec
) -> FloatArray | float:
    """The quadratic surface that fits the cells around a contact best, shape (n, n) [mm]."""
    pitch = math.sqrt(sensor.area_mm2 / heights_mm.size)
    rim = max(1, round(RIM_MM / pitch))
    outside = ~ndimage.binary_dilation(contact, iterations=rim)
    if outside.sum() < max(LEAST_OUTSIDE * heights_mm.size, 12):
        return 0.0
    return _fitted(quadratic_basis(len(heights_mm), sensor), heights_mm, outside)


def _fitted(basis: FloatArray, heights_mm: FloatArray, chosen: BoolArray) -> FloatArray:
    """The combination of basis functions (n², K) nearest to the chosen heights, everywhere."""
    rows = basis[chosen.ravel()]
    normal = rows.T @ rows + 1e-9 * np.eye(basis.shape[1])
    weights = np.linalg.solve(normal, rows.T @ heights_mm[chosen])
    return np.asarray((basis @ weights).reshape(heights_mm.shape))
