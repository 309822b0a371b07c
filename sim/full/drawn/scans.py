"""Scanned-like objects: a surface as an irregular mesh of triangles, worn and a little wavy.

A scan has points where the scanner put them, dense where the surface bends, sparse on flats. Walls
become steep flanks, edges wear off, and its registration leaves slow waves. Rays of the pad are
parallel to the scan's axis, so that a ray's hit is the interpolation within its triangle; no ray
library is needed.

Not here: the surfaces that are scanned (``sim.full.drawn.faces`` and its neighbours), users' meshes
(``sim.objects.mesh_objects``).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.ndimage import gaussian_filter, map_coordinates

from cltp.processor import one_blas_thread
from cltp.tactile.cloud import FloatArray
from sim.full.drawn.surface import Draws, Surface
from sim.gel.gap import NO_BODY_MM

FLOOR_MM, NARROW_FLOOR_MM = 3.0, 1.7
"""Depth behind the foremost point below which a scan has no surface; of what is narrow less, since
its walls wear with it."""

_FINE_MM = 0.12  # grid on which a surface is sampled before points are chosen
_MOST_POINTS = 6000
_MARGIN_MM = 1.0

Window = tuple[float, float, float, float]
"""Least and largest u, least and largest v [mm]."""


def scanned(surface: Surface, draws: Draws, window: Window) -> Surface:
    """The scan of a surface within a window; its elements and its label stay the surface's."""
    u = np.arange(window[0] - _MARGIN_MM, window[1] + _MARGIN_MM + _FINE_MM, _FINE_MM)
    v = np.arange(window[2] - _MARGIN_MM, window[3] + _MARGIN_MM + _FINE_MM, _FINE_MM)
    # What is narrow wears less and is scanned finer: bars, dots and small faces would be lost.
    is_narrow = surface.needed > 1 or not surface.can_be_textured
    wear_mm = draws.uniform(0.04, 0.10 if is_narrow else 0.22)
    floor_mm = NARROW_FLOOR_MM if is_narrow else FLOOR_MM
    worn = gaussian_filter(
        surface.behind_mm(*np.meshgrid(u, v)).clip(max=floor_mm), wear_mm / _FINE_MM, mode="nearest"
    )
    spacing = draws.uniform(0.25, 0.45) if is_narrow else draws.uniform(0.45, 0.95)
    density = draws.uniform(0.3, 0.7) if is_narrow else draws.uniform(0.15, 0.4)
    points = _points(worn, (u, v), spacing, density, draws)
    height = _sampled(worn, (u[0], v[0]), points) + _waves(points, draws)
    mesh = LinearNDInterpolator(points, height, fill_value=NO_BODY_MM)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        with one_blas_thread():
            hit = mesh(u, v)
        return np.where(hit < 0.95 * floor_mm, hit, NO_BODY_MM)

    return replace(surface, behind_mm=behind)


def window_of(surface: Surface, u: FloatArray, v: FloatArray) -> Window:
    """The part of the positions u and v that a surface can lie in."""
    reach = surface.extent_mm + _MARGIN_MM if surface.is_compact and surface.needed else math.inf
    return (
        max(float(u.min()), -reach),
        min(float(u.max()), reach),
        max(float(v.min()), -reach),
        min(float(v.max()), reach),
    )


def _points(
    worn: FloatArray,
    axes: tuple[FloatArray, FloatArray],
    spacing: float,
    density: float,
    draws: Draws,
) -> FloatArray:
    """Vertices (N, 2): astray from a coarse lattice, and more of them where the surface bends."""
    u, v = axes
    coarse = np.meshgrid(np.arange(u[0], u[-1], spacing), np.arange(v[0], v[-1], spacing))
    lattice = np.stack(coarse, axis=-1).reshape(-1, 2)
    lattice = lattice + spacing * draws.rng.uniform(-0.35, 0.35, lattice.shape)
    down, right = np.gradient(worn, _FINE_MM)
    bend = np.abs(np.gradient(down, _FINE_MM, axis=0)) + np.abs(
        np.gradient(right, _FINE_MM, axis=1)
    )
    weight = np.where(worn < 1.5, bend.clip(max=4.0), 0.0)
    row, column = np.nonzero(draws.rng.random(worn.shape) < density * weight)
    fine = np.stack([u[column], v[row]], axis=1)
    if len(fine) > _MOST_POINTS:
        fine = fine[draws.rng.permutation(len(fine))[:_MOST_POINTS]]
    fine = fine + 0.3 * _FINE_MM * draws.rng.uniform(-1, 1, fine.shape)
    ends = np.array([(u[0], v[0]), (u[0], v[-1]), (u[-1], v[0]), (u[-1], v[-1])])
    return np.concatenate([ends, lattice, fine]).clip(ends[0], ends[-1])


def _sampled(worn: FloatArray, origin: tuple[float, float], points: FloatArray) -> FloatArray:
    at = (points - origin) / _FINE_MM
    return np.asarray(map_coordinates(worn, [at[:, 1], at[:, 0]], order=1, mode="nearest"))


def _waves(points: FloatArray, draws: Draws) -> FloatArray:
    """Slow waves of up to 25 µm, 6-20 mm long, and fine noise of up to 4 µm at the vertices."""
    total = draws.uniform(0, 0.004) * draws.rng.standard_normal(len(points)).clip(-2.5, 2.5)
    height = min(draws.uniform(0, 0.025), 0.12 * draws.lightest_mm)
    for _ in range(3):
        angle, length = draws.uniform(0, math.pi), draws.uniform(6, 20)
        along = points[:, 0] * math.cos(angle) + points[:, 1] * math.sin(angle)
        total = total + height / 3 * np.sin(2 * math.pi * along / length + draws.uniform(0, 6.3))
    return np.asarray(total)
