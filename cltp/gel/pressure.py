"""The force that explains the heights of a contact, by the compliance of the gel.

Under a contact the heights are known and all pressure lies there. A linear system gives the
pressure, whose sum is the force. Where a contact ends is not known in noise, and the zero of the
heights is not either, so that the force is computed for several outlines, with and without the
height of the surroundings taken away. How thick the gel is shows in its surface around a
contact. A network weighs all of it (``cltp.encoder.force_head``).

Not here: the simulation of a contact, where outline and pressure follow from the body
(``sim.gel.contact_solver``).

Source: Johnson, Contact Mechanics, 1985, chapter 5: numerical solution for a given contact area.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import torch
from numpy.typing import NDArray
from scipy import ndimage
from torch import Tensor

from cltp.gel.compliance import GelMaterial, layer_kernel
from cltp.tactile.cells import blurred
from cltp.tactile.encoder_input import GRID_UNIT_MM, OUTSIDE
from cltp.tactile.point_layout import GRID
from cltp.tactile.quantiles import median, quantile, spread_about
from cltp.tactile.sensors import SENSORS

NOMINAL_GEL = GelMaterial(
    thickness_mm=SENSORS["gelsight_mini"].gel_mm, young_mpa=0.423, poisson=0.47
)
"""The gel that forces are computed for: that of a GelSight Mini. Source: ``sim.gel.layer``."""

UNIT_MM = SENSORS["gelsight_mini"].max_depth_mm
"""Height that is 1 in scaled points, the same for all sensors [mm]."""

BLOCK = 3
"""Cells of the grid along either side of an element with one pressure. Our choice: 0.6 mm, a fifth
of the gel's thickness; with smaller ones noise grows, and time with the sixth power."""

MOST_ELEMENTS = 400
"""Most elements under a contact, the deepest ones. Our choice: 140 mm² of a GelSight Mini."""

LEVELS = (0.1, 0.2, 0.35, 0.5)
"""Outlines, as fractions of the depth."""

RIDGE = 0.05
"""What is added to the compliance of an element by itself, as a fraction of it: an outline has a
pressure without bound on its edge, which noise would multiply."""

SMOOTHING = 0.7
"""Width of the Gaussian before an outline is drawn [elements]."""

RIM = 2
"""Elements around a contact that do not count as its surroundings."""

RINGS = (1, 2, 4, 7, 12)
"""Outer ends of the rings around a contact [elements along rows and columns]. Our choice: the last
one ends 7 mm away, twice the gel's thickness, beyond which its surface hardly moves."""

OF_RINGS = 0.2
"""The outline that they lie around, one of ``LEVELS``."""

LEAST_SURROUNDINGS = 20
"""Fewest elements whose median is the height of the surroundings."""

LEAST_DEPTH_MM = 1e-3
LEAST_FORCE_N = 1e-3

_NEIGHBOURS = ndimage.generate_binary_structure(2, 1)

_OF_CONTACT = 7 + len(RINGS)
_OF_LEVEL = 4
NUM_FEATURES = _OF_CONTACT + _OF_LEVEL * len(LEVELS)


def pressure_features(points: NDArray[np.float32]) -> NDArray[np.float32]:
    """What pressure tells of a cloud: shape (``NUM_FEATURES``,).

    Of the whole: depth [mm], height of the surroundings and its spread over the depth, fraction of
    the pad that they are, logarithm of an element's edge over ``BLOCK`` cells of 0.2 mm, sides of
    the pad [cm]. For each of ``RINGS`` the mean height above the surroundings over the depth; a
    ring beyond the pad has 0. For each of ``LEVELS`` logarithms of the force [N], of the
    force that 1 mm of height has over the outline [N/mm], of the outline's area [mm²], and of
    the force with the surroundings as zero [N]. The newtons are those of ``NOMINAL_GEL``.

    Args:
        points: Shape (N, 3), scaled, in the layout ``GRID``. Where a height is not finite, all
            features are NaN.
    """
    heights, pitch_mm = _elements(points)
    if not np.isfinite(heights).all():
        return np.full(NUM_FEATURES, np.nan, np.float32)
    rows, columns = heights.shape
    smooth = blurred(heights, (SMOOTHING, SMOOTHING))
    depth = max(float(np.sort(smooth, axis=None)[-3:].mean()), LEAST_DEPTH_MM)
    zero, spread, free = _surroundings(heights, smooth > LEVELS[0] * depth)
    features = [depth, zero / depth, spread / depth, free, np.log(pitch_mm / (0.2 * BLOCK))]
    features += [rows * pitch_mm / GRID_UNIT_MM, columns * pitch_mm / GRID_UNIT_MM]
    chosen, counts = _outlines(smooth, depth)
    inner = chosen[: counts[LEVELS.index(OF_RINGS)]]
    features += [(mean - zero) / depth for mean in _ring_means(heights, inner, zero)]
    forces, stiffness = _forces(heights, chosen, counts, pitch_mm)
    for force, stiff, count in zip(forces, stiffness, counts, strict=True):
        area = count * pitch_mm**2
        features += [np.log(max(force, LEAST_FORCE_N)), np.log(stiff), np.log(area)]
        features.append(np.log(max(force - zero * stiff, LEAST_FORCE_N)))
    return np.array(features, np.float32)


def _elements(points: NDArray[np.float32]) -> tuple[NDArray[np.float64], float]:
    """Mean heights in the pad's elements (rows, columns) [mm], and the edge of one [mm]."""
    grid = points.reshape(GRID.rows, GRID.columns, 3)
    inside = ~(grid[..., 2] <= OUTSIDE / 2)  # so that NaN is inside
    rows, columns = np.flatnonzero(inside.any(1)), np.flatnonzero(inside.any(0))
    heights = grid[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1, 2].astype(np.float64)
    edge_mm = GRID_UNIT_MM * float(grid[0, 1, 0] - grid[0, 0, 0])
    size = [max(1, side // BLOCK) for side in heights.shape]
    top, left = (max(0, side - n * BLOCK) // 2 for side, n in zip(heights.shape, size, strict=True))
    heights = heights[top : top + size[0] * BLOCK, left : left + size[1] * BLOCK]
    blocks = heights.reshape(size[0], -1, size[1], heights.shape[1] // size[1])
    return UNIT_MM * blocks.mean((1, 3)), BLOCK * edge_mm


def _surroundings(
    heights: NDArray[np.float64], contact: NDArray[np.bool_]
) -> tuple[float, float, float]:
    """Median height outside of a contact and its rim, its spread, and the fraction of the pad."""
    outside = heights[~ndimage.binary_dilation(contact, _NEIGHBOURS, iterations=RIM)]
    if len(outside) < LEAST_SURROUNDINGS:
        return quantile(heights, 0.1), 0.0, len(outside) / heights.size
    zero = median(outside)
    return zero, spread_about(outside, zero), len(outside) / heights.size


def _ring_means(
    heights: NDArray[np.float64], inner: NDArray[np.intp], beyond: float
) -> list[float]:
    """Mean height in each of ``RINGS`` around elements; ``beyond`` where a ring is empty."""
    outside = np.ones(heights.size, dtype=np.bool_)
    outside[inner] = False
    distance = ndimage.distance_transform_cdt(outside.reshape(heights.shape), "taxicab")
    number = np.searchsorted(RINGS, distance) + 1
    number[distance == 0] = 0
    counts = np.bincount(number.ravel(), minlength=len(RINGS) + 2)[1:-1]
    sums = np.bincount(number.ravel(), heights.ravel(), minlength=len(RINGS) + 2)[1:-1]
    means: list[float] = np.where(counts > 0, sums / np.maximum(counts, 1), beyond).tolist()
    return means


def _outlines(smooth: NDArray[np.float64], depth: float) -> tuple[NDArray[np.intp], list[int]]:
    """Elements under a contact, and how many of them, from the first, each outline has.

    An outline is the region around the deepest element that is deeper than a fraction of the depth:
    one lies inside the next.
    """
    peak = np.unravel_index(int(smooth.argmax()), smooth.shape)
    rank = np.full(smooth.shape, len(LEVELS))
    for number, level in enumerate(sorted(LEVELS)):
        regions, _ = ndimage.label(smooth > level * depth, _NEIGHBOURS)
        rank[(regions == regions[peak]) & (regions > 0)] = len(LEVELS) - 1 - number
    rank[peak] = 0
    order = np.lexsort((-smooth.ravel(), rank.ravel()))
    ends = np.searchsorted(rank.ravel()[order], np.arange(len(LEVELS)), side="right")
    counts = np.minimum(ends, MOST_ELEMENTS)[::-1]
    return order[: counts[0]], counts.tolist()


def _forces(
    heights: NDArray[np.float64], chosen: NDArray[np.intp], counts: list[int], pitch_mm: float
) -> tuple[list[float], list[float]]:
    """Force of the heights in each outline [N], and of a height of 1 mm [N/mm].

    With C = L Lᵀ the force 1ᵀ C⁻¹ h is (L⁻¹ 1)ᵀ (L⁻¹ h), and a leading part of C has the leading
    parts of both, so that all outlines come of one factor.
    """
    rows, columns = heights.shape
    every = _compliance(rows, columns, round(pitch_mm, 2))
    loads = np.stack([np.ones(len(chosen)), heights.ravel()[chosen]], axis=1).astype(np.float32)
    # torch keeps to the threads that it was given; numpy's linear algebra takes all
    index = torch.from_numpy(chosen)
    lower = torch.linalg.cholesky_ex(every.index_select(0, index).index_select(1, index)).L
    halves = torch.linalg.solve_triangular(lower, torch.from_numpy(loads), upper=False)
    ones, solved = halves.numpy().T.astype(np.float64)
    sums = np.cumsum([ones * solved, ones * ones], axis=1) * pitch_mm**2
    forces, stiffness = sums[:, np.array(counts) - 1].tolist()
    return forces, stiffness


@lru_cache(maxsize=8)
def _compliance(rows: int, columns: int, pitch_mm: float) -> Tensor:
    """Compliance of each of a pad's elements under pressure on each, with the ridge [mm/MPa].

    32 bits suffice: its largest eigenvalue is six times its least.
    """
    kernel: NDArray[np.float64] = layer_kernel(rows, columns, pitch_mm, NOMINAL_GEL).numpy()
    row, column = np.divmod(np.arange(rows * columns), columns)
    every = kernel[np.abs(row[:, None] - row), np.abs(column[:, None] - column)]
    every[np.diag_indices(len(every))] *= 1 + RIDGE
    return torch.from_numpy(every.astype(np.float32))
