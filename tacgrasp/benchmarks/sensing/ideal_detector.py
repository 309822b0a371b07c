"""What a matched filter could do with a sensor's noise: the least force of a berry it can detect.

The filter knows the heights of the contact and the noise's spectrum. With heights H(k) and the
noise's density P(k), its response to noise is normal and its mean with the contact is
d' = (∑ |H(k)|² / P(k))^½ standard deviations. No test of one frame with this noise misses fewer
contacts at the same rate of false alarms. The rate of misses is this closed form; the rate of false
alarms is simulated, since the places and frames of a closing are not independent.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
import torch
from numpy.typing import NDArray
from scipy import fft

from cltp.tactile.sensors import SensorSpec
from sim.gel.layer import ElasticLayer, gel_of
from tacgrasp.benchmarks.sensing.noise_spectrum import RadialSpectrum

FloatArray = NDArray[np.float64]

RADIUS_MM = 15.0
BERRY_MODULUS_MPA = 0.20 / (1 - 0.35**2)
"""A berry: radius [mm] and E* [MPa]. Source: GelSight-lab/TactileEstimateModulus, E 0.20 MPa;
nu 0.35 assumed, as for the simulated berries."""

FORCES_N = (0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.1, 0.15, 0.2, 0.3)
"""Forces of the contacts [N]."""

MAX_FALSE_PER_CLOSING = 0.005
MAX_MISSED = 0.01
FRAMES_PER_CLOSING = 50
CLOSINGS = 400
TAIL = 40
"""Simulated closings, and how many of the largest responses make up the tail of their spread."""

ROWS, COLUMNS = 60, 80
"""Grid of the filter: 0.254 mm on a GelSight Mini."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DetectorFigures:
    """What an ideal detector reaches.

    Attributes:
        false_per_closing: Fraction of simulated closings with a false alarm.
        missed_by_force: Fraction of contacts that are missed in one frame, by force [N].
        least_force_n: Lightest of the forces with at most ``MAX_MISSED``; None for none.
        d_prime_by_force: Mean response over its standard deviation, by force.
    """

    false_per_closing: float
    missed_by_force: dict[str, float]
    least_force_n: float | None
    d_prime_by_force: dict[str, float]


def berry_heights_mm(sensor: SensorSpec) -> FloatArray:
    """Heights of the gel under a berry at the pad's centre, (forces, ROWS, COLUMNS) [mm]."""
    pitch = sensor.width_mm / COLUMNS
    y = (np.arange(ROWS) - (ROWS - 1) / 2) * pitch
    x = (np.arange(COLUMNS) - (COLUMNS - 1) / 2) * pitch
    gap = (x[None, :] ** 2 + y[:, None] ** 2) / (2 * RADIUS_MM)
    gel = ElasticLayer(
        gel_of(sensor.name),
        rows=ROWS,
        columns=COLUMNS,
        pitch_mm=pitch,
        body_modulus_mpa=BERRY_MODULUS_MPA,
    )
    gaps = torch.as_tensor(gap - gap.min(), dtype=torch.float32).expand(len(FORCES_N), -1, -1)
    pressed = gel.press_to_force(gaps, torch.tensor(FORCES_N), tol=1e-3)
    return np.asarray(pressed.height_mm.double().numpy())


def detect(noise: RadialSpectrum, sensor: SensorSpec, rng: np.random.Generator) -> DetectorFigures:
    """Figures of the ideal detector of a berry.

    Args:
        noise: Spectrum of a frame less the reference; new in every frame of a closing, which is
            the most that drift can do.
        sensor: The sensor.
        rng: Source of the simulated noise.
    """
    heights = berry_heights_mm(sensor)
    pitch = sensor.width_mm / COLUMNS
    k = np.hypot(fft.fftfreq(ROWS, pitch)[:, None], fft.fftfreq(COLUMNS, pitch)[None, :])
    density = noise.at(k) / pitch**2 * ROWS * COLUMNS  # mean of |FFT of the noise|²
    density[0, 0] = np.inf  # a frame has no zero: its mean tells nothing
    waves = fft.fft2(heights)
    d_prime = np.sqrt((np.abs(waves) ** 2 / density).sum(axis=(1, 2)))
    limit = _limit(waves[len(FORCES_N) // 2] / density, density, rng)
    missed = {
        f"{force:g}": NormalDist().cdf(limit.threshold - float(d))
        for force, d in zip(FORCES_N, d_prime, strict=True)
    }
    found = [force for force in FORCES_N if missed[f"{force:g}"] <= MAX_MISSED]
    return DetectorFigures(
        false_per_closing=limit.false_per_closing,
        missed_by_force=missed,
        least_force_n=min(found, default=None),
        d_prime_by_force={f"{f:g}": float(d) for f, d in zip(FORCES_N, d_prime, strict=True)},
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Limit:
    threshold: float
    false_per_closing: float


def _limit(filter_waves: FloatArray, density: FloatArray, rng: np.random.Generator) -> _Limit:
    """Threshold [standard deviations] from simulated closings, and false alarms in as many others.

    A closing's largest response over all places of the pad and all its frames counts.
    """
    root = np.where(np.isfinite(density), np.sqrt(density), 0.0)
    gain = np.conj(filter_waves)
    sigma = math.sqrt(float((np.abs(gain) ** 2 * root**2).sum())) / density.size
    largest = np.empty((2, CLOSINGS))
    for closing in np.ndindex(largest.shape):
        white = fft.fft2(rng.standard_normal((FRAMES_PER_CLOSING, ROWS, COLUMNS), np.float32))
        response = fft.ifft2(white * (root * gain / math.sqrt(density.size))).real
        largest[closing] = response.max() / sigma
    tail = np.sort(largest[0])[-TAIL:]
    # Few closings lie beyond the limit: it is extrapolated along the exponential tail.
    excess = float((tail - tail[0]).mean())
    threshold = float(tail[0]) + excess * math.log(TAIL / CLOSINGS / MAX_FALSE_PER_CLOSING)
    return _Limit(threshold=threshold, false_per_closing=float((largest[1] > threshold).mean()))
