"""Noise of a sensor that is not ours: white, bands of rows, drift by a polynomial, blind spots.

None of it is drawn as in ``cltp.tactile.sensor_noise``. All amplitudes are our choice, about those
of real units in size.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, uniform_filter1d

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec

WHITE_MM = (0.004, 0.025)
BANDS_MM = (0.002, 0.012)
DRIFT_MM = (0.01, 0.06)
SPOTS = (2, 8)
SPOT_RADIUS_MM = (0.3, 0.9)


def disturbed(
    height_mm: NDArray[np.floating], sensor: SensorSpec, rng: np.random.Generator
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Heights (H, W) [mm] as such a sensor reports them, with median 0, and a mask of blind points.

    A blind point has the height of the nearest other one.
    """
    rows, columns = height_mm.shape
    x, y = np.meshgrid(np.linspace(-1, 1, columns), np.linspace(1, -1, rows))
    noisy = np.asarray(height_mm, dtype=np.float64)
    noisy = noisy + _log_uniform(rng, WHITE_MM) * rng.standard_normal((rows, columns))
    along_rows, spread_mm = rng.random() < 0.5, _log_uniform(rng, BANDS_MM)
    bands = uniform_filter1d(rng.standard_normal(rows if along_rows else columns), 3)
    bands *= spread_mm / bands.std()
    noisy += bands[:, None] if along_rows else bands[None, :]
    noisy += _polynomial(x, y, _log_uniform(rng, DRIFT_MM), rng)
    blind = np.zeros((rows, columns), dtype=np.bool_)
    for _ in range(int(rng.integers(*SPOTS, endpoint=True))):
        centre_x, centre_y = rng.uniform(-1, 1, 2)
        off_x, off_y = (x - centre_x) * sensor.width_mm / 2, (y - centre_y) * sensor.height_mm / 2
        blind |= np.hypot(off_x, off_y) < rng.uniform(*SPOT_RADIUS_MM)
    noisy -= np.median(noisy[~blind])
    nearest = distance_transform_edt(blind, return_distances=False, return_indices=True)
    noisy = noisy[tuple(nearest)]
    return noisy.astype(np.float32), blind


def _polynomial(
    x: FloatArray, y: FloatArray, spread_mm: float, rng: np.random.Generator
) -> FloatArray:
    """A cubic in x and y without a constant, of a given standard deviation over the pad."""
    field = np.zeros_like(x)
    for power_x in range(4):
        for power_y in range(4 - power_x):
            field += rng.standard_normal() * x**power_x * y**power_y
    field -= field.mean()
    return np.asarray(field * (spread_mm / field.std()))


def _log_uniform(rng: np.random.Generator, limits: tuple[float, float]) -> float:
    low, high = limits
    return float(low * (high / low) ** rng.random())
