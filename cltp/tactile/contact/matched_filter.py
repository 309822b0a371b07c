"""A contact on an untouched gel, against fine noise and drift of unknown strength.

A contact is a bump of a few millimetres. Drift is smooth, and its strength differs from unit to
unit by a factor of a hundred. Fine noise is known. The test is a likelihood ratio: how much better
drift and a bump explain the heights than drift alone does. Each takes the strength of drift that
suits it best, and the bump its best place, width and height. The same covariance tells the drift
under a contact from what is seen around it (kriging).

Source of the method: S. M. Kay, Fundamentals of Statistical Signal Processing, volume 2, section 6
(generalised likelihood ratio); C. E. Rasmussen and C. K. I. Williams, Gaussian Processes for
Machine Learning, 2006, section 2.2.

Not here: the reference that heights are measured against (``contact_test``). Loads no torch.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, ndimage

from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.sensors import SensorSpec

BoolArray = NDArray[np.bool_]

WIDTHS_MM = (1.2, 2.0, 3.0)
"""Standard deviations of the bumps [mm]. Our choice: half the width of contacts of 0.02 to 0.5 N; a
fourth of 4.5 mm felt no more."""

BESIDE_MM, SPACING_MM = 3.0, 1.2
"""Bumps stand up to so far outside of the pad, and so far apart [mm]. Source: without those outside
one contact in twelve at the pad's edge was not felt up to 0.6 N."""

BROAD_MM, LOCAL_MM = (10.0, 14.0, 20.0), (2.5, 5.0, 8.0)
"""Correlation lengths of the broad and the local part of drift: at them it has fallen to 1/e [mm].
Source: ``cltp.tactile.sensor_noise.SlowDrift``."""

LOCAL_PARTS = (0.1, 0.4, 2.0)
"""Strengths of the local part over the broad one that are tried. Source: with one of them alone,
units of the other kinds had false alarms."""

ROUGH_PART = 0.01
"""Standard deviation of what is like neither part, over the broad one. Our choice: without it
smooth drift of a shape that nobody thought of counts as contact."""

STRENGTHS_MM = 0.0005 * 2.0 ** np.arange(10)
"""Standard deviations of drift that are tried, of all parts together [mm]."""

BROAD_MM_S, LOCAL_MM_S, ALWAYS_MM = 0.03, 0.004, 0.001
"""Most that the broad and the local part grow to in a second, and what they may have at once [mm].
Source: drift of 0.3 mm, and locally 0.04 mm, in a minute. Without a bound, drift explains every
deep contact too."""

MOST_S = 2.5
"""Time since the reference that counts for these bounds [s]. Our choice: an approach. A contact
that is held for longer is still one; with 4 s one in twelve of 0.4 to 2.5 N was none."""

LEAST_NOISE_MM = 1e-4
"""Least fine noise of a cell [mm]: a unit without any has no likelihood."""

SHAPE_WIDTHS_MM = (1.0, 2.0, 4.0)
"""Widths of the bumps that the shape of a contact is a sum of, beside the first and second
derivatives of the bump that was found [mm]. Source: with one bump alone, drift explained one
contact in six of 0.1 to 0.6 N as well: what a bump does not fit needs strong drift anyway."""

SHAPE_RIDGE = 1e-4
"""Ridge of that fit, over its diagonal. Our choice: widths differ little beside the pad."""

REGION_PART, RIM_MM = 0.15, 1.0
"""A contact reaches as far as it is higher than this part of its height, and a rim around it [mm].
Our choice: a bump's height at twice its width; the gel's surface decays within a rim."""

LEAST_OUTSIDE = 0.25
"""Least fraction of the pad outside a contact that tells the drift under it. Our choice."""

MOST_MISFIT = 15.0
"""Largest mean square of what is outside, over what drift would have. Source: round contacts of
0.05 to 2.5 N have 1 to 3 in the median and 20 in one of thirty, pegs across the pad 20 to 80."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bump:
    """What explains some heights best.

    Attributes:
        gain: Twice the logarithm of the likelihood of drift and bump over that of drift alone.
        raised_gain: The same of a bump that rises where a contact would press the gel in.
        contact_mm: Shape (n, n): the contact of the best shape at its place [mm].
    """

    gain: float
    raised_gain: float
    contact_mm: FloatArray


class MatchedFilter:
    """The test for n × n cells of one sensor, and one strength of the fine noise.

    Args:
        sensor: The sensor.
        n: Cells along either side of the sensing area.
        noise_mm: Standard deviation of the fine noise of a cell [mm].
    """

    def __init__(self, sensor: SensorSpec, n: int, noise_mm: float) -> None:
        self._sensor, self._n = sensor, n
        self._noise_mm = max(noise_mm, LEAST_NOISE_MM)
        self._kinds = [_Kind(part, sensor, n, self._noise_mm) for part in LOCAL_PARTS]

    def fit(self, heights_mm: FloatArray, elapsed_s: float = MOST_S) -> Bump:
        """The bump that explains heights (n, n) [mm] best; their mean and tilt tell nothing.

        Args:
            heights_mm: Heights less those of the reference.
            elapsed_s: Time since the reference [s].
        """
        flat, seconds = heights_mm.ravel(), min(elapsed_s, MOST_S)
        fits = [kind.fit(flat, seconds) for kind in self._kinds]
        without = max(fit.without for fit in fits)
        bump = max(fits, key=lambda fit: fit.pressed).bump
        shape = _shape(self._sensor, self._n, bump)
        shapes = [kind.fit_shape(flat, shape, seconds) for kind in self._kinds]
        best = max(shapes, key=lambda fit: fit.gain)
        pressed = max(fit.pressed for fit in fits)
        return Bump(
            gain=max(best.gain, pressed) - without,
            raised_gain=max(fit.raised for fit in fits) - without,
            contact_mm=best.contact_mm.reshape(heights_mm.shape),
        )

    def region(self, bump: Bump) -> BoolArray:
        """Cells (n, n) that a contact covers, with a rim."""
        region = bump.contact_mm > REGION_PART * bump.contact_mm.max()
        rim = max(1, round(RIM_MM * self._n / math.sqrt(self._sensor.area_mm2)))
        return np.asarray(ndimage.binary_dilation(region, iterations=rim))

    def drift_under(self, heights_mm: FloatArray, region: BoolArray) -> FloatArray:
        """The drift everywhere (n, n) [mm], as the cells outside a contact tell it.

        0 where too few cells are outside, or show what is no drift: a contact that is no bump.
        """
        outside = np.flatnonzero(~region)
        if outside.size < LEAST_OUTSIDE * region.size:
            return np.zeros_like(heights_mm)
        seen = heights_mm.ravel()[outside]
        mean = float(seen.mean())
        strength = max(float(seen.std()), float(STRENGTHS_MM[0]))
        covariance = _modes(self._sensor, self._n, LOCAL_PARTS[0]).covariance
        among = covariance[np.ix_(outside, outside)]
        among[np.diag_indices_from(among)] += (self._noise_mm / strength) ** 2 + ROUGH_PART**2
        weights = linalg.solve(among, seen - mean, assume_a="pos")
        if (seen - mean) @ weights > MOST_MISFIT * strength**2 * outside.size:
            return np.zeros_like(heights_mm)
        return np.asarray((mean + covariance[:, outside] @ weights).reshape(heights_mm.shape))


def filter_noise_mm(noise_mm: Sequence[FloatArray], sensor: SensorSpec) -> float:
    """Standard deviation of fine noise (n, n) of some frames, as the narrowest bump finds it [mm].

    At least that of a cell; more where neighbouring cells have noise in common.
    """
    frames = np.stack(noise_mm)
    n = frames.shape[-1]
    heights = _modes(sensor, n, LOCAL_PARTS[0]).heights
    bumps = heights[: len(heights) // len(WIDTHS_MM)]
    norms = np.linalg.norm(bumps, axis=1)
    inside = norms >= 0.5 * norms.max()
    products = frames.reshape(len(frames), -1) @ bumps[inside].T / norms[inside]
    return float(max(frames.std(), products.std()))


class _Fit(NamedTuple):
    """The best of one kind of drift: twice the log likelihoods, and the number of the bump."""

    without: float
    pressed: float
    raised: float
    bump: int


class _ShapeFit(NamedTuple):
    """The best of one kind of drift with a contact of any shape, and twice its log likelihood."""

    gain: float
    contact_mm: FloatArray


class _Kind:
    """One kind of drift, of a given local part and all strengths."""

    def __init__(self, local_part: float, sensor: SensorSpec, n: int, noise_mm: float) -> None:
        self._modes = modes = _modes(sensor, n, local_part)
        drift = STRENGTHS_MM**2 * modes.variances[:, None]
        self._variances = noise_mm**2 + (ROUGH_PART * STRENGTHS_MM) ** 2 + drift
        self._norms = modes.squared_bumps @ (1 / self._variances)
        self._log_volume = np.log(self._variances).sum(axis=0)
        broad_mm = STRENGTHS_MM / math.hypot(1, local_part)
        self._grown_s = np.maximum(
            (broad_mm - ALWAYS_MM) / BROAD_MM_S, (local_part * broad_mm - ALWAYS_MM) / LOCAL_MM_S
        )

    def _num_strengths(self, elapsed_s: float) -> int:
        """How many of ``STRENGTHS_MM``, which rise, drift may have reached."""
        return max(1, int((self._grown_s <= elapsed_s).sum()))

    def fit(self, heights_mm: FloatArray, elapsed_s: float) -> _Fit:
        """The best bump on heights (n²,) [mm]."""
        modes = self._modes
        count = self._num_strengths(elapsed_s)
        amplitudes = modes.shapes.T @ heights_mm
        whitened = amplitudes[:, None] / self._variances[:, :count]
        without = -(amplitudes @ whitened) - self._log_volume[:count]
        products = modes.bumps @ whitened
        gains = products**2 / self._norms[:, :count] + without
        pressed = np.where(products > 0, gains, without)
        return _Fit(
            without=float(without.max()),
            pressed=float(pressed.max()),
            raised=float(np.where(products < 0, gains, without).max()),
            bump=int(pressed.max(axis=1).argmax()),
        )

    def fit_shape(self, heights_mm: FloatArray, shape: FloatArray, elapsed_s: float) -> _ShapeFit:
        """The best contact of a shape (n², parts) on heights (n²,) [mm]."""
        modes = self._modes
        variances = self._variances[:, : self._num_strengths(elapsed_s)].T
        amplitudes, parts = modes.shapes.T @ heights_mm, modes.shapes.T @ shape
        whitened = (parts / variances[:, :, None]).transpose(0, 2, 1)
        normal = whitened @ parts
        scale = 1 / np.sqrt(np.diagonal(normal, axis1=1, axis2=2))
        normal *= scale[:, :, None] * scale[:, None, :]
        normal += SHAPE_RIDGE * np.eye(normal.shape[1])
        products = scale * (whitened @ amplitudes)
        sizes = np.linalg.solve(normal, products[:, :, None])[:, :, 0]
        without = -(amplitudes**2 / variances).sum(axis=1) - self._log_volume[: len(variances)]
        contacts = (scale * sizes) @ shape.T
        gains = np.where(
            contacts.max(axis=1) > -contacts.min(axis=1),
            without + (products * sizes).sum(axis=1),
            -math.inf,
        )
        best = int(gains.argmax())
        if gains[best] == -math.inf:
            return _ShapeFit(-math.inf, np.zeros_like(heights_mm))
        return _ShapeFit(float(gains[best]), contacts[best])


@dataclass(frozen=True, slots=True, kw_only=True)
class _Modes:
    """Drift of one kind in independent shapes, beside its mean and tilt.

    Attributes:
        covariance: Shape (n², n²): of drift of variance 1.
        shapes: Shape (n², n² - 3), orthonormal.
        variances: Shape (n² - 3,): of each shape.
        heights: Shape (bumps, n²): bumps of height 1 [mm].
        bumps: Shape (bumps, n² - 3): each as a sum of the shapes.
        squared_bumps: Shape (bumps, n² - 3): their squares.
        places_mm: Shape (bumps, 2): their middles [mm].
    """

    covariance: FloatArray
    shapes: FloatArray
    variances: FloatArray
    heights: FloatArray
    bumps: FloatArray
    squared_bumps: FloatArray
    places_mm: FloatArray


@lru_cache(maxsize=12)
def _modes(sensor: SensorSpec, n: int, local_part: float) -> _Modes:
    x, y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(sensor, n, n)))
    square_mm2 = (x[:, None] - x) ** 2 + (y[:, None] - y) ** 2

    def correlation(lengths_mm: tuple[float, ...]) -> FloatArray:
        return np.asarray(np.mean([np.exp(-square_mm2 / each**2) for each in lengths_mm], axis=0))

    covariance = correlation(BROAD_MM) + local_part**2 * correlation(LOCAL_MM)
    covariance /= 1 + local_part**2
    rest = linalg.null_space(np.stack([np.ones_like(x), x, y]))
    variances, turned = linalg.eigh(rest.T @ covariance @ rest)
    shapes = rest @ turned
    places = np.stack([axis.ravel() for axis in np.meshgrid(*_bump_axes_mm(sensor))], axis=1)
    from_bump = (places[:, :1] - x) ** 2 + (places[:, 1:] - y) ** 2
    heights = np.concatenate([np.exp(-0.5 * from_bump / width**2) for width in WIDTHS_MM])
    bumps = heights @ shapes
    return _Modes(
        covariance=covariance,
        shapes=shapes,
        variances=np.clip(variances, 0.0, None),
        heights=heights,
        bumps=bumps,
        squared_bumps=bumps**2,
        places_mm=np.tile(places, (len(WIDTHS_MM), 1)),
    )


@lru_cache(maxsize=1024)
def _shape(sensor: SensorSpec, n: int, bump: int) -> FloatArray:
    """Parts (n², parts) of the shape of a contact at the place of a bump."""
    modes = _modes(sensor, n, LOCAL_PARTS[0])
    x, y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(sensor, n, n)))
    x, y = x - modes.places_mm[bump, 0], y - modes.places_mm[bump, 1]
    widths = [np.exp(-0.5 * (x**2 + y**2) / width**2) for width in SHAPE_WIDTHS_MM]
    width_mm = WIDTHS_MM[bump // (len(modes.places_mm) // len(WIDTHS_MM))]
    u, v, height = x / width_mm, y / width_mm, modes.heights[bump]
    return np.stack([*widths, u * height, v * height, (u * u - v * v) * height, u * v * height], 1)


def _bump_axes_mm(sensor: SensorSpec) -> list[FloatArray]:
    """Middles of the bumps along x and along y [mm]."""
    halves = (side / 2 + BESIDE_MM for side in (sensor.width_mm, sensor.height_mm))
    return [np.linspace(-half, half, 1 + round(2 * half / SPACING_MM)) for half in halves]
