"""Whether anything touches the gel: tests of a cloud against the untouched gel.

A contact is local: it has edges and slopes within millimetres. Drift, tilt and the loss of the zero
are broad: over 5 to 10 mm and more. So a cloud is averaged in cells and passed through band filters
(differences of Gaussians) of a few millimetres, which keep contacts and remove what is broad. A
contact shows as a response that is far above the noise of the untouched gel somewhere on the pad.

``UntouchedGel`` tests against frames of the open fingers of the same closing, which is the test of
the loop: it measures the noise of those frames, and drift gets into it only as far as the gel
creeps during a closing.
``touches_alone`` tests a single cloud, whose drift is unknown, and so needs a deeper contact.

Loads no torch. Not here: depth, position, area and force of a contact (``cltp.tactile.measure``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray, TactileCloud
from cltp.tactile.measure import cell_means, cells_of
from cltp.tactile.sensor_noise import spread_of
from cltp.tactile.sensors import SensorSpec

SCALES_MM = (0.6, 1.0, 1.6)
"""Widths of the inner Gaussians of the filters; the outer ones are twice as wide [mm]. Our choice:
from the cells of 1024 points to half the width of a light contact of a berry."""

NUM_FRAMES = 5
"""Frames of the untouched gel that a test is made from."""

THRESHOLD = 8.5
"""Noise's part of the least response of a contact, over the standard deviation of the noise.

It is large because 1024 cells at three scales are looked at 50 times in a closing (two seconds in
air at 25 Hz). ``tacgrasp bench contact``: with ``CREEP_MM``, 1 of 1200 closings has a false alarm;
the largest response is 0.53 of the least of a contact in the median, and 1.14 at most.
"""

CREEP_MM = (0.0005, 0.0035, 0.0105)
"""Drift's part of the least response of a contact, by scale [mm]: what the gel creeps during a
closing. Source: without it the slow drift of the simulated sensor is a contact in 12 % of 1200
closings at nine standard deviations; responses of these closings reach 0.011, 0.012 and 0.020 mm,
noise included."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactEvidence:
    """Result of a test.

    Attributes:
        in_contact: Whether something touches the gel.
        ratio: Largest response over the least response of a contact; 1 and more is a contact.
        is_inverted: Whether the gel seems to rise where a contact would press it in: z has the
            wrong sign.
    """

    in_contact: bool
    ratio: float
    is_inverted: bool = False


class UntouchedGel:
    """The untouched gel of one closing, as the sensor sees it now."""

    def __init__(self, frames: Sequence[TactileCloud]) -> None:
        """Learn the mean and the noise of the untouched gel.

        Args:
            frames: At least two clouds of one sensor while nothing touches.

        Raises:
            TouchError: Fewer than two frames, or frames of different sensors.
        """
        if len(frames) < 2 or len({frame.sensor.name for frame in frames}) > 1:
            raise TouchError(
                f"the untouched gel needs at least 2 frames of one sensor, got {len(frames)}"
            )
        self._sensor = frames[0].sensor
        self._cells = min(cells_of(frame) for frame in frames)  # frames can miss points
        cells = [cell_means(frame, self._cells) for frame in frames]
        self._mean = _mean(cells)
        count = len(frames)
        noise = [_responses(frame - self._mean, self._sensor) for frame in cells]
        # A frame of the mean differs less from it than a new frame does.
        factor = math.sqrt((1 + 1 / count) / (1 - 1 / count))
        self._least_mm = THRESHOLD * factor * np.std(noise, axis=(0, 2, 3)) + np.array(CREEP_MM)

    def test(self, cloud: TactileCloud) -> ContactEvidence:
        """Test whether something touches the gel now.

        Raises:
            TouchError: A cloud of another sensor.
        """
        if cloud.sensor.name != self._sensor.name:
            raise TouchError(
                f"expected a cloud of {self._sensor.name}, got one of {cloud.sensor.name}"
            )
        responses = _responses(cell_means(cloud, self._cells) - self._mean, self._sensor)
        return _evidence(responses, self._least_mm)


def _mean(cells_mm: Sequence[FloatArray]) -> FloatArray:
    """Mean of cells over frames; NaN where no frame has a point."""
    count = np.isfinite(cells_mm).sum(axis=0)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.nansum(cells_mm, axis=0) / count)


def touches_alone(cloud: TactileCloud) -> ContactEvidence:
    """Test a single cloud, without frames of the untouched gel.

    The least response of a contact is what the sensor's drift and fine noise reach
    (``cltp.tactile.sensor_noise``): light contacts can't be told from drift in one frame.
    """
    spread, sensor = spread_of(cloud.sensor), cloud.sensor
    cells = cell_means(cloud)
    cell_mm = math.sqrt(sensor.area_mm2 / cells.size)
    least_mm = []
    for scale_mm in SCALES_MM:
        drift = spread.drift_mm * _drift_gain(scale_mm, spread.drift_length_mm[0])
        # White noise of one point a cell, through the difference of Gaussians.
        fine = spread.fine_mm * cell_mm / (2 * math.sqrt(math.pi) * scale_mm) * math.sqrt(0.45)
        least_mm.append(SINGLE_THRESHOLD * math.hypot(drift, fine))
    return _evidence(_responses(cells, sensor), np.array(least_mm))


def _evidence(responses: FloatArray, least_mm: FloatArray) -> ContactEvidence:
    """Compare responses (scales, n, n) with the least ones of a contact (scales,)."""
    pressed = float((responses.max(axis=(1, 2)) / least_mm).max())
    raised = float((-responses.min(axis=(1, 2)) / least_mm).max())
    is_inverted = raised >= 1 and pressed < MIN_PRESSED * raised
    return ContactEvidence(
        in_contact=pressed >= 1 and not is_inverted, ratio=pressed, is_inverted=is_inverted
    )


MIN_PRESSED = 0.5
"""Least response of what is pressed in over that of what rises, of a contact. A bump of the wrong
sign has 0.1 to 0.3; noise-free contacts of all shapes have 0.62 (a plane) and more."""

SINGLE_THRESHOLD = 4.0
"""As ``THRESHOLD``, of a single frame: drift has few independent places on a pad."""


def _drift_gain(scale_mm: float, length_mm: float) -> float:
    """Standard deviation that a filter leaves of a field of variance 1 and a Gaussian correlation.

    Args:
        scale_mm: Width of the inner Gaussian [mm].
        length_mm: Distance at which the correlation has fallen to 1/e [mm].
    """

    def covariance(one_mm: float, other_mm: float) -> float:
        return 1 / (1 + 2 * (one_mm**2 + other_mm**2) / length_mm**2)

    inner, outer = scale_mm, 2 * scale_mm
    variance = covariance(inner, inner) - 2 * covariance(inner, outer) + covariance(outer, outer)
    return math.sqrt(max(variance, 0.0))


def _responses(cells_mm: FloatArray, sensor: SensorSpec) -> FloatArray:
    """Responses of the filters, shape (scales, n, n) [mm]; cells without points count nothing."""
    known = np.isfinite(cells_mm).astype(np.float64)
    filled = np.nan_to_num(cells_mm, nan=0.0)
    pitch = sensor.height_mm / cells_mm.shape[0], sensor.width_mm / cells_mm.shape[1]

    def smooth(scale_mm: float) -> FloatArray:
        sigma = [scale_mm / each for each in pitch]
        weight = gaussian_filter(known, sigma, mode="nearest")
        return gaussian_filter(filled, sigma, mode="nearest") / np.maximum(weight, 1e-6)

    return np.stack([smooth(scale) - smooth(2 * scale) for scale in SCALES_MM])
