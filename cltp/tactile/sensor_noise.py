"""Errors of a real sensor on the height map of a gel: of the unit, drift, fine noise, a lost zero.

They are drawn whenever a contact is read and never stored in data. The simulated sensor and
training use the same model. It is applied to clean heights, before a cloud is sampled. Loads no
torch.

Not here: the gel itself (``sim``), the sampling of points (``cltp.tactile.cloud``).

Source: measured on GelSight Minis. Of one calibrated unit, 44 frames outside their contacts
(``tacgrasp bench noise``): drift 0.006 mm with a correlation length of 2.5 mm (3.7 mm with tilt),
0.003 mm from frame to frame, tilt 0.0015 mm per mm, white part 0.0002 mm per pixel, gains of the x
and y gradients that differ by e^0.09. Of a few others, read by another unit's calibration (shared
notes): drift 0.04 mm over 3-8 mm, slow broad drift to 0.3 mm, tilt 0.003 mm per mm, depth scale
±15 %, gains that differ by up to e^0.6. The larger ones stand below, since a unit need not be well
calibrated. Fine noise is assumed: 0.010 mm, the residual of a fitted ball, since other cameras and
reconstructions are noisier than the one measured.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dctn, idctn

from cltp.errors import TouchError
from cltp.tactile.noise_levels import NoiseLevels
from cltp.tactile.quantiles import median, spread_about
from cltp.tactile.sensors import SensorSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class NoiseSpread:
    """Spread of errors among the units of one model of sensor, and among their frames.

    Attributes:
        depth_scale: Half width of the uniform distribution of the factor on heights, about 1.
        tilt: Standard deviation of the slope along either axis, normal [mm per mm].
        drift_mm: Standard deviation of the low-frequency error in a frame [mm].
        drift_length_mm: Range of its correlation length, uniform [mm].
        fine_mm: Standard deviation of the error of one pixel, or of one marker's depth [mm].
        gain_log_ratio: Largest |ln| of the ratio of the gradients' gains, uniform, of an
            uncalibrated unit; 0 where heights are not integrated from gradients.
        border_mm: Largest width of the dead border, uniform from 0; its gradients are lost [mm].
        marker_mm: Standard deviation of a marker's position along x and along y [mm].
        marker_loss: Probability that a marker is not detected in a frame.
    """

    depth_scale: float
    tilt: float
    drift_mm: float
    drift_length_mm: tuple[float, float]
    fine_mm: float
    gain_log_ratio: float
    border_mm: float = 0.0
    marker_mm: float = 0.0
    marker_loss: float = 0.0


# See the module's source; the length from the calibrated unit's to the others'.
MINI_SPREAD = NoiseSpread(
    depth_scale=0.15,
    tilt=0.003,
    drift_mm=0.04,
    drift_length_mm=(2.5, 8.0),
    fine_mm=0.010,
    gain_log_ratio=0.6,
)
SPREADS: dict[str, NoiseSpread] = {
    "gelsight_mini": MINI_SPREAD,
    # Not measured; the same maker and the same reconstruction.
    "gelsight_mini_markers": MINI_SPREAD,
    "gelsight_r15": MINI_SPREAD,
    # Not measured. Our assumption: like the GelSight Mini, which is photometric too, but less well
    # calibrated, and its curved gel is out of sight within up to 1 mm of the border.
    "digit": dataclasses.replace(
        MINI_SPREAD, depth_scale=0.20, tilt=0.005, drift_mm=0.05, border_mm=1.0
    ),
    # Stereo: 0.1 px of error in either view at f = 651 px, base 6.5 mm and 28.7 mm distance (as in
    # TacFlex) is 0.027 mm in depth and 0.004 mm along the surface. Loss: 93.9 % of the markers in
    # contact are detected (Marknet, arXiv 2211.13428), nearly all elsewhere; 3 % is our mean.
    # Scale, tilt and drift are assumed: what a calibration through refracting layers leaves.
    "gelstereo": NoiseSpread(
        depth_scale=0.05,
        tilt=0.001,
        drift_mm=0.02,
        drift_length_mm=(5.0, 12.0),
        fine_mm=0.027,
        gain_log_ratio=0.0,
        marker_mm=0.004,
        marker_loss=0.03,
    ),
    # Assumed, of no array in particular: scale and tilt as of a calibrated camera, noise of some
    # counts [µm], and no gradients that would have gains.
    "taxels": NoiseSpread(
        depth_scale=0.15,
        tilt=0.001,
        drift_mm=0.02,
        drift_length_mm=(5.0, 12.0),
        fine_mm=0.010,
        gain_log_ratio=0.0,
    ),
}
"""By the names of ``cltp.tactile.sensors.SENSORS``."""


def spread_of(sensor: SensorSpec) -> NoiseSpread:
    """Measured or assumed noise of a sensor.

    Raises:
        TouchError: No noise is known for it; the message lists the sensors with known noise.
    """
    try:
        return SPREADS[sensor.name]
    except KeyError:
        names = ", ".join(sorted(SPREADS))
        raise TouchError(f"no noise known for sensor {sensor.name!r}; known: {names}") from None


def drift_in(cells_mm: NDArray[np.floating], spread: NoiseSpread) -> float:
    """Drift that one frame may have, standard deviation [mm].

    That of its sensor, or less where half of the pad lies within far less, as in a simulated cloud
    without noise.

    Args:
        cells_mm: Heights in equal cells of the sensing area, none of them empty [mm].
        spread: Noise of the sensor.
    """
    seen_mm = spread_about(cells_mm, median(cells_mm))
    return min(spread.drift_mm, max(SEEN_FACTOR * seen_mm, LEAST_DRIFT * spread.drift_mm))


SEEN_FACTOR, LEAST_DRIFT = 8.0, 1 / 8
"""Drift that a single frame may have over the spread of its heights, and the least one over that of
its sensor: 0.005 mm of a GelSight Mini. Our choice: a pad holds few independent places of drift, so
that its spread is a poor estimate; that of a calibrated unit changes nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NoiseUnit:
    """The errors of one sensor unit, which stay the same for an episode.

    Attributes:
        depth_scale: Factor on every height: the error of its calibration.
        tilt_x, tilt_y: Slope that the unit adds [mm per mm].
        gain_x, gain_y: Factors on the gradients along x and y before they are integrated.
        drift_mm: Standard deviation of the low-frequency error, new in every frame [mm].
        fine_mm: Standard deviation of the error of a single pixel, new in every frame [mm].
        drift_length_mm: Range of the correlation length of the low-frequency error [mm].
        border_mm: Width of the dead border: heights there are those at its inner edge [mm].
        marker_mm: Standard deviation of a marker's position, new in every frame [mm].
        marker_loss: Probability that a marker is not detected in a frame.
        point_loss: Probability that a point of a cloud is missing in a frame.
        shuffled: Whether the points of a frame come in a random order.
    """

    depth_scale: float = 1.0
    tilt_x: float = 0.0
    tilt_y: float = 0.0
    gain_x: float = 1.0
    gain_y: float = 1.0
    drift_mm: float = 0.0
    fine_mm: float = 0.0
    drift_length_mm: tuple[float, float] = MINI_SPREAD.drift_length_mm
    border_mm: float = 0.0
    marker_mm: float = 0.0
    marker_loss: float = 0.0
    point_loss: float = 0.0
    shuffled: bool = False

    @classmethod
    def draw(
        cls,
        rng: np.random.Generator,
        level: float | NoiseLevels = 1.0,
        *,
        gain_log_ratio: float = 0.0,
        spread: NoiseSpread = MINI_SPREAD,
    ) -> NoiseUnit:
        """Draw a unit.

        Args:
            rng: Source of the draws.
            level: Factor on every spread, or one for each kind: 1 is the measured sensor, 0 a
                perfect one. The same generator gives the same draws times other factors.
            gain_log_ratio: Largest |ln(gain_x / gain_y)|; ``spread.gain_log_ratio`` for
                uncalibrated units. The product of both gains is 1.
            spread: Spread of the model of sensor, from ``spread_of``.

        Raises:
            TouchError: ``level`` or ``gain_log_ratio`` is negative or not finite.
        """
        if not 0 <= gain_log_ratio < math.inf:
            raise TouchError(f"noise needs a gain ratio of 0 or more, got {gain_log_ratio}")
        levels = NoiseLevels.of(level)
        half_ratio = 0.5 * rng.uniform(-gain_log_ratio, gain_log_ratio)
        return cls(
            # Uniform: the notes give a range, not a distribution.
            depth_scale=max(
                0.05, 1.0 + levels.scale * rng.uniform(-spread.depth_scale, spread.depth_scale)
            ),
            tilt_x=levels.tilt * rng.normal(0.0, spread.tilt),
            tilt_y=levels.tilt * rng.normal(0.0, spread.tilt),
            gain_x=math.exp(half_ratio),
            gain_y=math.exp(-half_ratio),
            drift_mm=levels.drift * spread.drift_mm,
            fine_mm=levels.fine * spread.fine_mm,
            drift_length_mm=spread.drift_length_mm,
            # Without a border nothing is drawn: draws after the unit must stay reproducible.
            border_mm=levels.drift * rng.uniform(0, spread.border_mm)
            if spread.border_mm > 0
            else 0.0,
            marker_mm=levels.fine * spread.marker_mm,
            marker_loss=max(levels.missing, min(1.0, levels.fine * spread.marker_loss)),
            point_loss=levels.missing,
            shuffled=levels.shuffled,
        )

    def apply(
        self, height_mm: NDArray[np.floating], sensor: SensorSpec, rng: np.random.Generator
    ) -> NDArray[np.float32]:
        """True heights (H, W) [mm] of the sensing area as this unit would report them in one frame.

        The median of the result is 0, since photometric sensors lose the constant.
        """
        heights = np.asarray(height_mm, dtype=np.float32)
        if self.gain_x != 1.0 or self.gain_y != 1.0:
            heights = integrated_with_gains(heights, sensor, self.gain_x, self.gain_y)
        rows, columns = heights.shape
        noisy = heights * np.float32(self.depth_scale)
        if self.drift_mm > 0:
            noisy += np.float32(self.drift_mm) * smooth_field(
                (rows, columns), sensor, rng.uniform(*self.drift_length_mm), rng
            )
        if self.tilt_x or self.tilt_y:
            noisy += _plane(rows, columns, sensor, self.tilt_x, self.tilt_y)
        if self.fine_mm > 0:
            noisy += np.float32(self.fine_mm) * rng.standard_normal((rows, columns), np.float32)
        if self.border_mm > 0:
            noisy = _without_border(noisy, sensor, self.border_mm)
        noisy -= np.median(noisy)
        return noisy

    def received(
        self, points: NDArray[np.float32], rng: np.random.Generator
    ) -> NDArray[np.float32]:
        """The points (N, 3) of one frame that arrive, in the order in which they arrive."""
        if self.point_loss > 0:  # else nothing is drawn: later draws must stay reproducible
            points = points[rng.random(len(points)) >= self.point_loss]
        return rng.permutation(points) if self.shuffled else points


@dataclass(frozen=True, slots=True, kw_only=True)
class SlowDrift:
    """Slow change of the untouched gel of one unit: a smooth random process in time and space.

    It goes on whether the gel is touched or not, and nothing that the fingers do draws it anew.

    Attributes:
        fields: Shape (K, H, W): amplitudes of the process' components [mm].
        rates: Shape (K,): their angular frequencies [rad/s].
        phases: Shape (K,): their phases [rad].

    Source: amplitudes are drawn from those of a calibrated unit to those of units read by another's
    calibration (see the module). Calibrated: 0.006 mm, of that 0.005 mm at wavelengths from 10 mm
    on. Others: ``NoiseSpread``'s drift, and a broad part of up to 0.3 mm on a unit that was left
    nearly alone for minutes (two to three grey levels). The broad length of 10 to 20 mm and the
    times of one to several minutes are our reading of the same observation.
    """

    fields: NDArray[np.float32]
    rates: NDArray[np.float64]
    phases: NDArray[np.float64]

    @classmethod
    def draw(
        cls,
        rng: np.random.Generator,
        shape: tuple[int, int],
        sensor: SensorSpec,
        unit: NoiseUnit,
        level: float = 1.0,
    ) -> SlowDrift:
        """Draw the drift of an episode.

        Args:
            rng: Source of the draws.
            shape: (H, W) of the height maps over the whole sensing area.
            sensor: The model of the unit.
            unit: The unit, whose ``drift_mm``, as the most, and ``drift_length_mm`` are used.
            level: Factor on the broad part, as in ``NoiseUnit.draw``.
        """
        broad_mm = level * math.exp(rng.uniform(math.log(BROAD_MM[0]), math.log(BROAD_MM[1])))
        part = math.exp(rng.uniform(math.log(CALIBRATED_PART), 0.0))
        parts = (
            (part * unit.drift_mm, rng.uniform(*unit.drift_length_mm)),
            (broad_mm, rng.uniform(*BROAD_LENGTH_MM)),
        )
        period_s = math.exp(rng.uniform(math.log(PERIOD_S[0]), math.log(PERIOD_S[1])))
        fields = [
            amplitude_mm / math.sqrt(COMPONENTS / 2) * smooth_field(shape, sensor, length_mm, rng)
            for amplitude_mm, length_mm in parts
            for _ in range(COMPONENTS)
        ]
        count = len(fields)
        return cls(
            fields=np.stack(fields).astype(np.float32),
            rates=2 * math.pi / period_s * rng.standard_normal(count),
            phases=rng.uniform(0, 2 * math.pi, count),
        )

    def at(self, t_s: float) -> NDArray[np.float32]:
        """The drift at a time of the episode [s], shape (H, W) [mm]."""
        weights = np.cos(self.rates * t_s + self.phases).astype(np.float32)
        return np.asarray(np.tensordot(weights, self.fields, axes=1), dtype=np.float32)


CALIBRATED_PART = 0.15
"""Drift of a calibrated unit over that of ``NoiseSpread``: 0.006 of 0.04 mm."""

BROAD_MM = (0.005, 0.3)
BROAD_LENGTH_MM = (10.0, 20.0)
PERIOD_S = (60.0, 600.0)
COMPONENTS = 4
"""Cosines in time that make up each part of a drift."""


def _without_border(
    height_mm: NDArray[np.float32], sensor: SensorSpec, border_mm: float
) -> NDArray[np.float32]:
    """Heights without gradient within ``border_mm`` of the border: those of its inner edge."""
    rows, columns = height_mm.shape
    dead_rows = min(round(border_mm / sensor.height_mm * rows), (rows - 1) // 2)
    dead_columns = min(round(border_mm / sensor.width_mm * columns), (columns - 1) // 2)
    inner = height_mm[dead_rows : rows - dead_rows, dead_columns : columns - dead_columns]
    return np.pad(inner, ((dead_rows, dead_rows), (dead_columns, dead_columns)), mode="edge")


def smooth_field(
    shape: tuple[int, int], sensor: SensorSpec, length_mm: float, rng: np.random.Generator
) -> NDArray[np.float32]:
    """A random field of mean 0 and variance 1 with a Gaussian correlation.

    White noise on nodes half a correlation length apart, spread by a Gaussian of the same width
    along either axis: two small matrix products, whatever the ``shape`` (H, W) of the map over the
    whole sensing area. At ``length_mm`` the correlation has fallen to 1/e.
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
    """Heights that Poisson integration yields when the gradients are off by two gains.

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
    """kx² / (kx² + ky²) of every cosine mode, 0 for the mean."""
    ky = np.arange(shape[0])[:, None] / height_mm
    kx = np.arange(shape[1])[None, :] / width_mm
    total = kx**2 + ky**2
    total[0, 0] = 1.0
    return (kx**2 / total).astype(np.float32)
