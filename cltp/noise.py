"""What a real sensor adds to the height map of a gel: unit errors, drift, fine noise, a lost zero.

Drawn whenever a contact is read and never baked into data. The simulated sensor and training use
the same model. It is applied to the clean heights, before a cloud is sampled. Loads no torch.

Not here: the gel itself (``sim``), the sampling of points (``cltp.cloud``).

Source: figures measured on one GelSight Mini, project's notes: low-frequency drift of standard
deviation 0.04 mm with a correlation length of 3-8 mm, linear tilt 0.003 mm per mm, depth scale
±15 % from unit to unit, residual of a fitted ball about 10 µm, and gains of the x and y gradients
that differ by up to e^0.6 on an uncalibrated unit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dctn, idctn

from cltp.errors import TouchError
from cltp.sensors import SensorSpec

DRIFT_MM = 0.04
DRIFT_LENGTH_MM = (3.0, 8.0)
TILT = 0.003
DEPTH_SCALE = 0.15
FINE_MM = 0.010
GAIN_LOG_RATIO = 0.6


@dataclass(frozen=True, slots=True, kw_only=True)
class NoiseUnit:
    """The errors of one sensor unit, which stay the same for an episode.

    Attributes:
        depth_scale: Factor on every height; its calibration is off by that much.
        tilt_x, tilt_y: Slope that the unit adds [mm per mm of the field].
        gain_x, gain_y: Factors on the gradients along x and y before they are integrated.
        drift_mm: Standard deviation of the low-frequency error, new in every frame [mm].
        fine_mm: Standard deviation of the error of a single pixel, new in every frame [mm].
    """

    depth_scale: float = 1.0
    tilt_x: float = 0.0
    tilt_y: float = 0.0
    gain_x: float = 1.0
    gain_y: float = 1.0
    drift_mm: float = 0.0
    fine_mm: float = 0.0

    @classmethod
    def draw(
        cls, rng: np.random.Generator, level: float = 1.0, *, gain_log_ratio: float = 0.0
    ) -> NoiseUnit:
        """Draw a unit.

        Args:
            rng: Where the draws come from.
            level: 1 is the sensor that was measured, 0 a perfect one; scales every spread.
            gain_log_ratio: Largest |ln(gain_x / gain_y)|; ``GAIN_LOG_RATIO`` for units that nobody
                calibrated. The product of both gains is 1.

        Raises:
            TouchError: ``level`` or ``gain_log_ratio`` is negative or not finite.
        """
        if not (0 <= level < math.inf and 0 <= gain_log_ratio < math.inf):
            raise TouchError(f"noise needs levels of 0 or more, got {level} and {gain_log_ratio}")
        half_ratio = 0.5 * rng.uniform(-gain_log_ratio, gain_log_ratio)
        return cls(
            # Uniform: the notes give a range, not a distribution.
            depth_scale=max(0.05, 1.0 + level * rng.uniform(-DEPTH_SCALE, DEPTH_SCALE)),
            tilt_x=level * rng.normal(0.0, TILT),
            tilt_y=level * rng.normal(0.0, TILT),
            gain_x=math.exp(half_ratio),
            gain_y=math.exp(-half_ratio),
            drift_mm=level * DRIFT_MM,
            fine_mm=level * FINE_MM,
        )

    def apply(
        self, height_mm: NDArray[np.floating], sensor: SensorSpec, rng: np.random.Generator
    ) -> NDArray[np.float32]:
        """Heights as this unit would report them in one frame.

        Args:
            height_mm: Shape (H, W), true indentation over the sensor's whole field [mm].
            sensor: Whose field it is.
            rng: Draws this frame's drift and fine noise.

        Returns:
            Shape (H, W) [mm]; its median is 0, since photometric sensors lose the constant.
        """
        heights = np.asarray(height_mm, dtype=np.float32)
        if self.gain_x != 1.0 or self.gain_y != 1.0:
            heights = integrated_with_gains(heights, sensor, self.gain_x, self.gain_y)
        rows, columns = heights.shape
        noisy = heights * np.float32(self.depth_scale)
        if self.drift_mm > 0:
            noisy += np.float32(self.drift_mm) * smooth_field(
                (rows, columns), sensor, rng.uniform(*DRIFT_LENGTH_MM), rng
            )
        if self.tilt_x or self.tilt_y:
            noisy += _plane(rows, columns, sensor, self.tilt_x, self.tilt_y)
        if self.fine_mm > 0:
            noisy += np.float32(self.fine_mm) * rng.standard_normal((rows, columns), np.float32)
        noisy -= np.median(noisy)
        return noisy


def smooth_field(
    shape: tuple[int, int], sensor: SensorSpec, length_mm: float, rng: np.random.Generator
) -> NDArray[np.float32]:
    """A random field of mean 0 and variance 1 with a Gaussian correlation.

    White noise on nodes half a correlation length apart, spread by a Gaussian of the same width
    along either axis: two small matrix products, whatever the size of the map.

    Args:
        shape: (H, W) of the map over the whole field.
        sensor: Whose field it is.
        length_mm: Distance at which the correlation has fallen to 1/e [mm].
        rng: Draws the nodes.
    """
    along_y = _spread(shape[0], sensor.height_mm, length_mm)
    along_x = _spread(shape[1], sensor.width_mm, length_mm)
    nodes = rng.standard_normal((along_y.shape[1], along_x.shape[1]), np.float32)
    return np.asarray(along_y @ nodes @ along_x.T, dtype=np.float32)


def _spread(num: int, extent_mm: float, length_mm: float) -> NDArray[np.float32]:
    """Weights (num, nodes) of a row of nodes at ``num`` pixel centres; each row has norm 1."""
    sigma = 0.5 * length_mm
    centres = (np.arange(num) + 0.5) * (extent_mm / num)
    nodes = np.arange(-3.0, math.ceil(extent_mm / sigma) + 4.0) * sigma
    weights = np.exp(-0.5 * ((centres[:, None] - nodes) / sigma) ** 2)
    weights /= np.sqrt((weights**2).sum(axis=1, keepdims=True))
    return weights.astype(np.float32)


def _plane(
    rows: int, columns: int, sensor: SensorSpec, slope_x: float, slope_y: float
) -> NDArray[np.float32]:
    x = (np.arange(columns, dtype=np.float32) + 0.5) / columns - 0.5
    y = 0.5 - (np.arange(rows, dtype=np.float32) + 0.5) / rows
    tilted = (y * np.float32(slope_y * sensor.height_mm))[:, None]
    return np.asarray(tilted + x * np.float32(slope_x * sensor.width_mm), dtype=np.float32)


def integrated_with_gains(
    height_mm: NDArray[np.floating], sensor: SensorSpec, gain_x: float, gain_y: float
) -> NDArray[np.float32]:
    """Heights that Poisson integration finds when the gradients are off by two gains.

    With free (Neumann) edges each cosine mode of wavenumbers (kx, ky) is multiplied by
    (gain_x kx² + gain_y ky²) / (kx² + ky²); the mean is kept.
    """
    factor = _gain_factor(height_mm.shape, sensor.width_mm, sensor.height_mm)
    modes = dctn(np.asarray(height_mm, dtype=np.float32), norm="ortho")
    modes *= np.float32(gain_y) + np.float32(gain_x - gain_y) * factor
    modes[0, 0] *= 1.0 / (gain_y + (gain_x - gain_y) * factor[0, 0])
    return np.asarray(idctn(modes, norm="ortho"), dtype=np.float32)


@lru_cache(maxsize=8)
def _gain_factor(shape: tuple[int, int], width_mm: float, height_mm: float) -> NDArray[np.float32]:
    """Share kx² / (kx² + ky²) of every cosine mode, 0 for the mean."""
    ky = np.arange(shape[0])[:, None] / height_mm
    kx = np.arange(shape[1])[None, :] / width_mm
    total = kx**2 + ky**2
    total[0, 0] = 1.0
    return (kx**2 / total).astype(np.float32)
