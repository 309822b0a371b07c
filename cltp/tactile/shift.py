"""How far a contact has moved on the pad between two clouds: registration of their heights.

The heights after are those before, shifted and scaled, on a broad background that may have changed:
drift and tilt are quadratic over the pad. Shift, scale and background are fitted together, so that
neither broad drift nor a grip that relaxes counts as motion. A centroid of what lies above a
threshold, in comparison, moves with every change of the noise.

A motion along which the contact looks the same (a peg along its axis) does not show: there the
shift is 0.

Loads no torch. Source: image registration after Lucas and Kanade (1981), started from the best of a
grid of shifts; the choice of the background and of the prior is ours.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import map_coordinates

from cltp.errors import TouchError
from cltp.tactile.cells import cell_means, cells_of, quadratic_basis, smoothed
from cltp.tactile.cloud import FloatArray, TactileCloud
from cltp.tactile.sensors import SensorSpec

PRIOR_MM = 4.0
"""Standard deviation of a shift along either axis before anything is seen [mm]. Our choice: a body
that has moved further is mostly off the pad."""

SMOOTHING_MM = 0.6
"""Width of the Gaussian that heights are smoothed with before they are compared [mm]."""

_REACH_MM, _STEP_MM, _ROUNDS = 6.0, 1.0, 8


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactShift:
    """Motion of a contact.

    Attributes:
        x_mm, y_mm: Shift on the pad [mm, gel frame].
        spread_mm: Standard deviation of the shift, along the worse of the directions that show;
            ``PRIOR_MM`` where none does [mm].
        scale: Heights after over heights before.
    """

    x_mm: float
    y_mm: float
    spread_mm: float
    scale: float

    @property
    def length_mm(self) -> float:
        """Length of the shift [mm]."""
        return math.hypot(self.x_mm, self.y_mm)


def contact_shift(before: TactileCloud, after: TactileCloud) -> ContactShift:
    """Register two clouds of one sensor.

    Raises:
        TouchError: Clouds of different sensors.
    """
    if before.sensor.name != after.sensor.name:
        raise TouchError(
            f"expected clouds of one sensor, got {before.sensor.name} and {after.sensor.name}"
        )
    count = min(cells_of(before), cells_of(after))
    cells = [cell_means(cloud, count) for cloud in (before, after)]
    smooth_before, smooth_after = (smoothed(each, before.sensor, SMOOTHING_MM) for each in cells)
    fit = _Fit(smooth_before, smooth_after, before.sensor)
    return fit.refined(fit.coarse())


class _Fit:
    """Heights before and after, and the background between them."""

    def __init__(self, before: FloatArray, after: FloatArray, sensor: SensorSpec) -> None:
        rows, columns = before.shape
        self._background, _ = np.linalg.qr(quadratic_basis(rows, sensor))
        self._pitch_mm = sensor.width_mm / columns, sensor.height_mm / rows
        self._grid = np.mgrid[0:rows, 0:columns].astype(float)
        down, right = np.gradient(before, *self._pitch_mm[::-1])
        self._slope_x, self._slope_y = np.asarray(right), np.asarray(-down)  # rows run downwards
        self._before, self._after = before, self._without(after.ravel())

    def _without(self, heights: FloatArray) -> FloatArray:
        """Heights (N,) or (N, K) without their background."""
        return np.asarray(heights - self._background @ (self._background.T @ heights))

    def _shifted(self, field: FloatArray, x_mm: float, y_mm: float) -> FloatArray:
        """A field where the contact has moved by (x, y), without its background, (N,)."""
        rows = self._grid[0] + y_mm / self._pitch_mm[1]
        columns = self._grid[1] - x_mm / self._pitch_mm[0]
        moved = map_coordinates(field, [rows, columns], order=1, mode="nearest")
        return self._without(moved.ravel())

    def coarse(self) -> FloatArray:
        """The most probable shift of a grid, (2,) [mm]."""
        steps = np.arange(-_REACH_MM, _REACH_MM + _STEP_MM / 2, _STEP_MM)
        shifts = np.stack([each.ravel() for each in np.meshgrid(steps, steps)], axis=1)
        errors = np.array([float((self._rest(shift)[2] ** 2).sum()) for shift in shifts])
        variance = _CORRELATED * max(float(errors.min()) / len(self._after), 1e-12)
        improbable = errors / variance + (shifts**2).sum(axis=1) / PRIOR_MM**2
        return np.asarray(shifts[int(np.argmin(improbable))])

    def _rest(self, shift_mm: FloatArray) -> tuple[float, FloatArray, FloatArray]:
        """Under a shift: best scale, the contact moved, and what is left over, both (N,) [mm]."""
        moved = self._shifted(self._before, *shift_mm)
        scale = max(float(moved @ self._after) / max(float(moved @ moved), 1e-12), 0.0)
        return scale, moved, self._after - scale * moved

    def _seen(self, shift_mm: FloatArray) -> FloatArray:
        """Directions along which the contact has slopes of its own and not those of noise, (K, 2).

        Noise has slopes too. Half of those of what is left over are the noise of the heights
        before.
        """
        scale, _, rest = self._rest(shift_mm)
        slopes = scale * np.stack([self._slope_x.ravel(), self._slope_y.ravel()], axis=1)
        down, right = np.gradient(rest.reshape(self._before.shape), *self._pitch_mm[::-1])
        noise = np.stack([right.ravel(), -down.ravel()], axis=1)
        energies, directions = np.linalg.eigh(slopes.T @ slopes)
        noise_energies = np.einsum("ik,ij,jk->k", directions, noise.T @ noise / 2, directions)
        return np.asarray(directions.T[noise_energies < _MOST_NOISE * energies])

    def refined(self, shift_mm: FloatArray) -> ContactShift:
        """Gauss and Newton from a shift [mm], along what is seen; the spread is what remains."""
        seen = self._seen(shift_mm)
        shift = seen.T @ (seen @ shift_mm) if len(seen) else np.zeros(2)
        covariance = np.eye(1) * PRIOR_MM**2
        for _ in range(_ROUNDS if len(seen) else 0):
            scale, moved, rest = self._rest(shift)
            slopes = [self._shifted(slope, *shift) for slope in (self._slope_x, self._slope_y)]
            along = -scale * np.stack(slopes, axis=1) @ seen.T
            design = np.concatenate([along, moved[:, None]], axis=1)
            variance = _CORRELATED * max(float(rest.var()), 1e-12)
            prior = np.diag([1 / PRIOR_MM**2] * len(seen) + [1e-9])
            information = design.T @ design / variance + prior
            pull = design.T @ rest / variance - prior @ np.append(seen @ shift, 0.0)
            step = np.linalg.solve(information, pull)[: len(seen)]
            shift = shift + seen.T @ step * min(
                1.0, _STEP_MM / max(float(np.linalg.norm(step)), 1e-9)
            )
            covariance = np.linalg.inv(information)[: len(seen), : len(seen)]
        return ContactShift(
            x_mm=float(shift[0]),
            y_mm=float(shift[1]),
            spread_mm=math.sqrt(float(np.linalg.eigvalsh(covariance)[-1])),
            scale=self._rest(shift)[0],
        )


_MOST_NOISE = 0.5
"""Fraction of the energy of slopes along a direction from which on they are noise."""

_CORRELATED = 12.0
"""Cells over which what is left over is one error: smoothing and reconstruction errors are
correlated over one to two millimetres."""
