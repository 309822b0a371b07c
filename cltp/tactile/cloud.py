"""The tactile cloud: points on the deformed surface of a gel, and how a height map is sampled.

Not here: reading clouds from files (``cltp.sensing.touch_files``), what a cloud means
(``cltp.tactile.states``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from cltp.errors import TouchError
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.isolated_points import without_isolated
from cltp.tactile.sensors import SensorSpec

FloatArray = NDArray[np.float64]

NUM_POINTS = 1024
"""Points of a cloud given to an encoder. Source: paper, section 5, 'Implementations'."""

MIN_POINTS = 64
"""Fewest points that can carry a contact state. Our choice: one for each token of the encoder."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stamp:
    """Time of a measurement on both clocks [s].

    Attributes:
        monotonic_s: For durations and ordering; arbitrary origin, never jumps.
        wall_s: Seconds since the Unix epoch; metadata only.
    """

    monotonic_s: float
    wall_s: float


@dataclass(frozen=True, slots=True, kw_only=True)
class TactileCloud:
    """Points on the deformed gel.

    Attributes:
        points_mm: Shape (N, 3), float32, read-only, gel frame [mm]; z is the indentation, positive
            into the gel, with the undeformed gel near 0 (bulges around a contact are negative).
        sensor: The sensor that measured it.
        stamp: Time of capture; None for a cloud without a clock (a file).
        force_scale: How forces read from it become newtons; that of the unit that measured it.
        grid: (rows, columns) where the points are those of a regular grid over the whole sensing
            area, row by row from the top left; None for any other points.
        num_isolated: Points that stand far from all others around, where they are too many to be
            replaced by the median around each (``cltp.tactile.isolated_points``); else 0.

    Raises:
        TouchError: Empty, wrong shape, not finite, fewer than ``MIN_POINTS`` points, outside the
            sensing area, deeper than the gel, or apparently in metres.
    """

    points_mm: NDArray[np.float32]
    sensor: SensorSpec
    stamp: Stamp | None = None
    force_scale: ForceScale = UNCALIBRATED
    grid: tuple[int, int] | None = field(init=False)
    num_isolated: int = field(init=False)

    def __post_init__(self) -> None:
        points = np.array(self.points_mm, dtype=np.float32)  # a copy: nobody else can change it
        _check(points, self.sensor)
        grid = _grid(points, self.sensor)
        size_mm = self.sensor.width_mm, self.sensor.height_mm
        points, num_isolated = without_isolated(points, size_mm, grid)
        points.setflags(write=False)
        object.__setattr__(self, "points_mm", points)
        object.__setattr__(self, "grid", grid)
        object.__setattr__(self, "num_isolated", num_isolated)


def _grid(points: NDArray[np.float32], sensor: SensorSpec) -> tuple[int, int] | None:
    """Rows and columns of points (N, 3) that are a regular grid; see ``TactileCloud.grid``."""
    columns = int((points[:, 1] != points[0, 1]).argmax())  # 0 where all are alike
    if columns < 2 or len(points) % columns:
        return None
    x, y = points[:, 0].reshape(-1, columns), points[:, 1].reshape(-1, columns)
    expected_x, expected_y = grid_axes_mm(sensor, *x.shape)
    nearness_mm = 1e-3
    if np.abs(x[0] - expected_x).max() > nearness_mm or np.abs(y[:, 0] - expected_y).max() > (
        nearness_mm
    ):
        return None
    return x.shape if (x == x[0]).all() and (y == y[:, :1]).all() else None


def _check(points: NDArray[np.float32], sensor: SensorSpec) -> None:
    if points.ndim != 2 or points.shape[1] != 3:
        raise TouchError(f"a cloud needs shape (N, 3), got {points.shape}")
    if len(points) == 0:
        raise TouchError("the cloud is empty; expected points on the gel's surface")
    finite = np.isfinite(points).all(axis=1)
    if not finite.all():
        raise TouchError(
            f"{int((~finite).sum())} of {len(points)} points are NaN or infinite; drop "
            "them where they are few and scattered: a cloud with a hole is not read"
        )
    if len(points) < MIN_POINTS:
        number = "1 point" if len(points) == 1 else f"{len(points)} points"
        raise TouchError(f"the cloud has {number}; at least {MIN_POINTS} are needed")
    half = np.array([sensor.width_mm / 2, sensor.height_mm / 2])
    extents = np.ptp(points[:, :2], axis=0)
    extent = float(extents.max())
    if extent == 0:
        raise TouchError(f"all {len(points)} points of the cloud lie at one place on the pad")
    if extent < 0.02 * max(sensor.width_mm, sensor.height_mm):
        raise TouchError(
            f"the cloud spans only {extent:.3g} in x and y where {sensor.name} sees "
            f"{sensor.width_mm:.1f}×{sensor.height_mm:.1f} mm; is it in metres? Multiply by 1000"
        )
    if (extents < 1.05 * half / 5).all() and (extents > 0.85 * half / 5).all():
        x, y = extents
        raise TouchError(
            f"the cloud spans {x:.3g} × {y:.3g}, a tenth of the {sensor.width_mm:.1f}×"
            f"{sensor.height_mm:.1f} mm of {sensor.name}; is it in centimetres? Multiply by 10"
        )
    if (np.abs(points[:, :2]) > half + 0.05 * half).any():
        x, y = np.abs(points[:, :2]).max(axis=0)
        is_finer = extent > _FINER * max(sensor.width_mm, sensor.height_mm)
        raise TouchError(
            f"the cloud reaches |x| {x:.1f}, |y| {y:.1f} mm, beyond the sensing area of "
            f"{sensor.name} (±{half[0]:.1f}, ±{half[1]:.1f} mm around its centre); "
            + (_IN_MICRONS if is_finer else "wrong sensor or frame?")
        )
    if extents.min() < 0.02 * min(sensor.width_mm, sensor.height_mm):
        x, y = extents
        raise TouchError(
            f"the points lie on a line: the cloud spans {x:.3g} mm in x and {y:.3g} mm in y where "
            f"{sensor.name} sees {sensor.width_mm:.1f}×{sensor.height_mm:.1f} mm"
        )
    deepest = float(np.abs(points[:, 2]).max())
    if deepest > sensor.gel_mm:
        hint = f"; {_IN_MICRONS}" if deepest > _FINER * sensor.gel_mm else ""
        raise TouchError(
            f"indentation of {deepest:.2f} mm exceeds the {sensor.gel_mm} mm gel of "
            f"{sensor.name}{hint}"
        )


_FINER = 10.0
"""Size over what a sensor can show from which a cloud seems to be in a finer unit. Our choice."""

_IN_MICRONS = "is it in µm? Divide by 1000"


METRES_MM, ROUNDING_MM = 2e-3, 1e-5
"""Relief, between which a gel in mm shows none, and one in metres any press of 0.01 to 2 mm. Our
choice: an untouched gel's noise is 0.001 mm and more, of each of 64 points or more, and one without
noise is flat but for rounding. Centimetres can't be told from a gel with little noise."""


def check_relief(heights_mm: NDArray[np.floating], *, name: str = "cloud") -> None:
    """Refuse finite heights that seem to be in metres, of a file or from elsewhere.

    Not for a live sensor: what it counts may be as coarse as 0.001 mm, and nearly without noise.

    Args:
        heights_mm: Heights of any shape, at least one [mm].
        name: What they are, for the message.

    Raises:
        TouchError: Their whole relief is below a gel's noise, but for rounding.
    """
    relief = float(np.ptp(heights_mm))
    if ROUNDING_MM < relief < METRES_MM:
        raise TouchError(
            f"the {name}'s whole relief is {relief:.2g}, below a gel's noise in mm; "
            "is it in metres? Multiply by 1000. In mm it is too little to be felt"
        )


def checked_heights(height_mm: NDArray[np.floating]) -> FloatArray:
    """A height map as float64, in the same unit.

    Raises:
        TouchError: Not of shape (H, W) with both at least 8, or not finite.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    if heights.ndim != 2 or min(heights.shape) < 8:
        raise TouchError(f"a height map needs shape (H, W), both at least 8; got {heights.shape}")
    if not np.isfinite(heights).all():
        raise TouchError("the height map has NaN or infinite values")
    return heights


def grid_axes_mm(sensor: SensorSpec, rows: int, columns: int) -> tuple[FloatArray, FloatArray]:
    """Centres of ``rows`` × ``columns`` equal cells of the sensing area.

    Returns:
        x (columns,) ascending and y (rows,) descending [mm, gel frame]: row 0 is the top.
    """
    x = ((np.arange(columns) + 0.5) / columns - 0.5) * sensor.width_mm
    y = (0.5 - (np.arange(rows) + 0.5) / rows) * sensor.height_mm
    return x, y


def heights_at(
    height_mm: FloatArray, x_mm: FloatArray, y_mm: FloatArray, sensor: SensorSpec
) -> FloatArray:
    """Bilinear heights [mm] of a map of the whole sensing area at some positions [mm, gel frame].

    Linear, since cubic splines overshoot at the edges of punches, which would deepen a contact.
    """
    rows, columns = height_mm.shape
    row = (0.5 - y_mm / sensor.height_mm) * rows - 0.5
    column = (x_mm / sensor.width_mm + 0.5) * columns - 0.5
    return np.asarray(map_coordinates(height_mm, [row, column], order=1, mode="nearest"))


def cloud_from_heights(
    height_mm: NDArray[np.floating],
    sensor: SensorSpec,
    *,
    rng: np.random.Generator | None = None,
    num_points: int = NUM_POINTS,
    stamp: Stamp | None = None,
    force_scale: ForceScale = UNCALIBRATED,
) -> TactileCloud:
    """Sample a height map at one point in each cell of a regular grid (stratified, uniform).

    What a sensor measures is not sampled: see ``cloud_of_pixels``.

    Args:
        height_mm: Shape (H, W), indentation [mm], row 0 = top, over the whole sensing area.
        sensor: The sensor that measured it.
        rng: Jitters each point inside its cell; None puts it at the cell's centre.
        num_points: Number of points; the cells are as square as a grid of that many allows (1024
            is 32 × 32), and points are ordered row by row from the top left.
        stamp: Time of capture.
        force_scale: Force scale of the unit.

    Raises:
        TouchError: The map is not 2-D, too small, or not finite.
    """
    heights = checked_heights(height_mm)
    u, v = stratified(num_points, rng)
    pixels = [v * heights.shape[0] - 0.5, u * heights.shape[1] - 0.5]
    z = map_coordinates(heights, pixels, order=1, mode="nearest")
    points = np.stack([(u - 0.5) * sensor.width_mm, (0.5 - v) * sensor.height_mm, z], axis=1)
    return TactileCloud(
        points_mm=points.astype(np.float32), sensor=sensor, stamp=stamp, force_scale=force_scale
    )


def cloud_of_pixels(
    height_mm: NDArray[np.floating],
    sensor: SensorSpec,
    *,
    stamp: Stamp | None = None,
    force_scale: ForceScale = UNCALIBRATED,
) -> TactileCloud:
    """Every pixel of a height map as a point.

    Args:
        height_mm: Shape (H, W), indentation [mm], row 0 = top, over the whole sensing area.
        sensor: The sensor that measured it.
        stamp: Time of capture.
        force_scale: Force scale of the unit.

    Raises:
        TouchError: The map is not 2-D, too small, or not finite.
    """
    heights = checked_heights(height_mm)
    x, y = grid_axes_mm(sensor, *heights.shape)
    points = np.empty((*heights.shape, 3), np.float32)
    points[..., 0], points[..., 1], points[..., 2] = x[None, :], y[:, None], heights
    return TactileCloud(
        points_mm=points.reshape(-1, 3), sensor=sensor, stamp=stamp, force_scale=force_scale
    )


def stratified(num_points: int, rng: np.random.Generator | None) -> tuple[FloatArray, FloatArray]:
    """One point in each cell of a regular grid, as fractions of the sensing area from its top left.

    The grid has the rows and columns, nearest to square, whose product is ``num_points``.

    Returns:
        u (num_points,) to the right and v (num_points,) downwards, row by row.
    """
    rows = next(d for d in range(math.isqrt(num_points), 0, -1) if num_points % d == 0)
    columns = num_points // rows
    row, column = (a.ravel() for a in np.mgrid[0:rows, 0:columns])
    jitter = np.full((2, num_points), 0.5) if rng is None else rng.random((2, num_points))
    return (column + jitter[0]) / columns, (row + jitter[1]) / rows
