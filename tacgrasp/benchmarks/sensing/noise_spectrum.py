"""Power and correlation of height errors that are known on a part of a frame only.

Not here: which part is known (``tacgrasp.benchmarks.sensing.untouched_parts``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft, ndimage

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

TAPER_MM = 2.0
"""Width of the edge over which a known part fades to nothing, against spectral leakage [mm]."""

BAND_EDGES_MM = (20.0, 10.0, 5.0, 2.5, 1.25, 0.6, 0.3, 0.127)
"""Edges of the printed bands of wavelengths, longest first [mm]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RadialSpectrum:
    """Power spectral density of a field of errors, the same in all directions.

    Attributes:
        per_mm: Shape (K,), wavenumbers, ascending [1/mm].
        power: Shape (K,), density [mm² per (1/mm)²]: its integral over the plane of wavenumbers is
            the variance.
    """

    per_mm: FloatArray
    power: FloatArray

    def at(self, per_mm: FloatArray) -> FloatArray:
        """Density at some wavenumbers, interpolated in logarithms; constant beyond the ends."""
        logs = np.interp(np.log(np.maximum(per_mm, 1e-9)), np.log(self.per_mm), np.log(self.power))
        return np.exp(logs)

    def band_mm(self, longest_mm: float, shortest_mm: float) -> float:
        """Standard deviation of the part between two wavelengths [mm]."""
        k = np.geomspace(1 / longest_mm, 1 / shortest_mm, 200)
        return float(np.sqrt(np.trapezoid(2 * np.pi * k * self.at(k), k)))


@dataclass(frozen=True, slots=True, kw_only=True)
class NoiseCurves:
    """Curves of errors of one kind: their spectrum, and their correlation by distance."""

    spectrum: RadialSpectrum
    distance_mm: FloatArray
    correlation: FloatArray


def radial_spectrum(
    fields: Sequence[tuple[FloatArray, BoolArray]], mm_per_px: float
) -> RadialSpectrum:
    """Mean spectrum of fields (H, W) [mm] on their known parts, which fade out over ``TAPER_MM``.

    Wavelengths shorter than two pixels' diagonal and longer than the frame are not measured.
    """
    rows, columns = fields[0][0].shape
    k = np.hypot(fft.fftfreq(rows, mm_per_px)[:, None], fft.fftfreq(columns, mm_per_px)[None, :])
    total = np.zeros((rows, columns))
    for field, known in fields:
        taper = _taper(known, mm_per_px)
        mean = (taper * field)[known].sum() / taper.sum()
        waves = fft.fft2(taper * np.where(known, field - mean, 0.0))
        total += np.abs(waves) ** 2 * mm_per_px**2 / (taper**2).sum()
    edges = np.geomspace(1 / (columns * mm_per_px), 0.5 / mm_per_px, 29)
    bins = np.digitize(k, edges)
    counts = np.bincount(bins.ravel(), minlength=len(edges) + 1)[1:-1]
    sums = np.bincount(bins.ravel(), weights=total.ravel(), minlength=len(edges) + 1)[1:-1]
    full = counts > 0
    centres = np.sqrt(edges[1:] * edges[:-1])
    return RadialSpectrum(
        per_mm=centres[full], power=np.maximum(sums[full] / counts[full] / len(fields), 1e-30)
    )


def _taper(known: BoolArray, mm_per_px: float) -> FloatArray:
    """1 well inside the known part, 0 at its edge and at the frame's, a cosine between."""
    padded = np.pad(known, 1)
    inwards = ndimage.distance_transform_edt(padded)[1:-1, 1:-1] * mm_per_px
    return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.clip(inwards / TAPER_MM, 0, 1)))


def autocorrelation(
    fields: Sequence[tuple[FloatArray, BoolArray]], mm_per_px: float, reach_mm: float = 10.0
) -> tuple[FloatArray, FloatArray]:
    """Mean autocorrelation over all pairs of known pixels at each distance.

    Returns:
        Distances (K,) [mm] in steps of two pixels, and the correlation there (K,); 1 at 0.
    """
    shape = [2 * n for n in fields[0][0].shape]
    products, pairs = np.zeros(shape), np.zeros(shape)
    for field, known in fields:
        inside = np.where(known, field - field[known].mean(), 0.0)
        for total, values in ((products, inside), (pairs, known.astype(np.float64))):
            total += fft.irfft2(np.abs(fft.rfft2(values, shape)) ** 2, shape)
    row, column = (np.minimum(i, n - i) for i, n in zip(np.indices(shape), shape, strict=True))
    r = np.rint(np.hypot(row, column) / 2).astype(int)
    num = int(reach_mm / (2 * mm_per_px))
    near = (r < num) & (pairs > 0.5)
    sums = np.bincount(r[near], weights=products[near], minlength=num)
    counts = np.bincount(r[near], weights=pairs[near], minlength=num)
    variance = products[0, 0] / pairs[0, 0]
    correlation = np.asarray(sums / np.maximum(counts, 1) / variance, dtype=np.float64)
    distance_mm = np.asarray(2 * mm_per_px * np.arange(num), dtype=np.float64)
    return distance_mm, correlation


def length_mm(distance_mm: FloatArray, correlation: FloatArray) -> float:
    """Distance at which a correlation first falls to 1/e [mm]; the last one if it never does."""
    below = np.flatnonzero(correlation < np.exp(-1))
    if len(below) == 0:
        return float(distance_mm[-1])
    i = int(below[0])
    part = (correlation[i - 1] - np.exp(-1)) / (correlation[i - 1] - correlation[i])
    return float(distance_mm[i - 1] + part * (distance_mm[i] - distance_mm[i - 1]))


def white_mm(field: FloatArray, known: BoolArray) -> float:
    """Standard deviation of the part that differs from pixel to pixel at random [mm].

    From each pixel less the mean of its four neighbours, which removes what is smooth.
    """
    cross = np.array([[0, 0.25, 0], [0.25, 0, 0.25], [0, 0.25, 0]])
    rough = field - ndimage.convolve(field, cross)
    inner = ndimage.binary_erosion(known)
    return float(rough[inner].std() / np.sqrt(1.25))
