"""Presses of a ball into a gel: their position in a frame, and the slopes that they must have.

A frame alone does not give slopes, but the ball does: under it the gel follows the sphere. The gel
comes off the ball long before the geometric circle; the slopes around it are either left out
(``SphericalCap``) or interpolated from simulated profiles (``ProfileTable``).

Pixels are (column, row) of a frame, pixel centres at whole numbers; slopes are those of
``cltp.sensing.photometric``.

Not here: the network that learns from them (``cltp.train.photometric``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, optimize

from cltp.errors import TouchError
from cltp.sensing.frames import Frame
from cltp.tactile.sensors import SensorSpec

FloatArray = NDArray[np.float64]

MIN_LEVELS = 8.0
"""Change of colour of the 0.5 % most changed pixels (blurred) below which there is no press. Our
choice: untouched frames are at 2 to 3, the faintest press that we have at 30."""

_BLUR_PX = 2.0
_RAYS = 90
_FOLLOWS = 0.72  # of the geometric circle; the elastic layer follows a ball to 0.76 of it
_FLAT = 1.7  # of the geometric circle; slopes outside are below 0.1 mm per mm


@dataclass(frozen=True, slots=True, kw_only=True)
class BallPress:
    """One press.

    Attributes:
        column, row: Centre of the ball [px]; may lie off the frame.
        depth_mm: Depth of the ball's lowest point below the untouched gel [mm].
    """

    column: float
    row: float
    depth_mm: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SphericalCap:
    """Bare geometry: the sphere where the gel certainly follows it, flat far off, NaN between.

    Attributes:
        diameter_mm: Diameter of the ball [mm].
    """

    diameter_mm: float

    def inward_slope(self, r_mm: FloatArray, depth_mm: float) -> FloatArray:
        """Slope towards the centre, mm per mm: R / √(R² - r²) inside; NaN where unknown."""
        radius = self.diameter_mm / 2
        circle = np.sqrt(max(depth_mm * (2 * radius - depth_mm), 0.0))
        inside = r_mm < _FOLLOWS * circle
        root = np.sqrt(np.where(inside, radius**2 - r_mm**2, 1.0))
        return np.where(inside, r_mm / root, np.where(r_mm > _FLAT * circle, 0.0, np.nan))


@dataclass(frozen=True, slots=True, kw_only=True)
class ProfileTable:
    """Radial profiles of the gel at several depths, between which it interpolates.

    Attributes:
        depths_mm: (D,), ascending [mm].
        r_mm: (K,), from 0 in equal steps [mm]; beyond the last one the gel is flat.
        height_mm: (D, K), + = indentation [mm].

    Raises:
        ValueError: Shapes don't fit, or r doesn't start at 0 and step equally.
    """

    depths_mm: FloatArray
    r_mm: FloatArray
    height_mm: FloatArray

    def __post_init__(self) -> None:
        steps = np.diff(self.r_mm)
        if (
            self.height_mm.shape != (len(self.depths_mm), len(self.r_mm))
            or len(self.depths_mm) < 2
            or not (np.diff(self.depths_mm) > 0).all()
            or self.r_mm[0] != 0
            or not np.allclose(steps, steps[0])
        ):
            raise ValueError("a profile table needs (D, K) heights, depths ascending, r from 0")

    def inward_slope(self, r_mm: FloatArray, depth_mm: float) -> FloatArray:
        """Slope towards the centre, mm per mm: linear in depth (clamped to the table) and in r."""
        slopes = -np.gradient(self.height_mm, self.r_mm, axis=1)
        slopes[:, 0] = 0
        return self._interpolated(slopes, r_mm, depth_mm)

    def height(self, r_mm: FloatArray, depth_mm: float) -> FloatArray:
        """Indentation [mm]: linear in depth (clamped to the table) and in r."""
        return self._interpolated(self.height_mm, r_mm, depth_mm)

    def _interpolated(self, table: FloatArray, r_mm: FloatArray, depth_mm: float) -> FloatArray:
        index = np.interp(depth_mm, self.depths_mm, np.arange(len(self.depths_mm)))
        low = min(int(index), len(self.depths_mm) - 2)
        values = table[low] + (index - low) * (table[low + 1] - table[low])
        return np.interp(r_mm, self.r_mm, values, right=0.0)


PressShape = SphericalCap | ProfileTable
"""The gel around a ball of one diameter."""


def slopes_of(
    press: BallPress, shape: PressShape, column: FloatArray, row: FloatArray, mm_per_px: float
) -> FloatArray:
    """Slopes of a press in some pixels, (N, 2): dz/dx, dz/d(down); NaN where unknown."""
    x = (column - press.column) * mm_per_px
    down = (row - press.row) * mm_per_px
    r = np.hypot(x, down)
    inward = shape.inward_slope(r, press.depth_mm) / np.maximum(r, 1e-9)
    return np.stack([-inward * x, -inward * down], axis=-1)


def heights_of(
    press: BallPress, profiles: ProfileTable, column: FloatArray, row: FloatArray, mm_per_px: float
) -> FloatArray:
    """Indentation of a press in some pixels, (N,) [mm]."""
    r = np.hypot(column - press.column, row - press.row) * mm_per_px
    return profiles.height(r, press.depth_mm)


def find_press(
    frame: Frame, background: Frame, sensor: SensorSpec, diameter_mm: float
) -> BallPress:
    """Find a ball's circle from the change of colour alone.

    On each ray from the middle of the changed region, the last point where the change is still half
    of the ray's maximum lies near the geometric circle, whichever lamp lights that side. A circle
    is fitted to these points, robust to a few that dirt has moved, and the rays are drawn again
    from its centre. Accurate to a pixel or two: a start for ``fit_press``.

    Raises:
        TouchError: No press in the frame, or the object isn't round.
    """
    change = frame.astype(np.float32) - background.astype(np.float32)
    blurred = ndimage.gaussian_filter(change, (_BLUR_PX, _BLUR_PX, 0))
    size = np.linalg.norm(blurred, axis=2)
    size = np.clip(size - np.median(size), 0, None)
    strong = float(np.percentile(size, 99.5))
    if strong < MIN_LEVELS:
        raise TouchError(
            f"no ball in the frame: the strongest change is {strong:.1f} levels, expected more "
            f"than {MIN_LEVELS:.0f}; press harder, or leave the frame out"
        )
    region = _largest(size > 0.25 * strong)
    size = size * ndimage.binary_dilation(region, iterations=8)
    middle = ndimage.center_of_mass(region)
    largest = 0.6 * diameter_mm / sensor.mm_per_px
    circle = np.array([middle[1], middle[0], 0.5 * largest])
    for _ in range(8):
        edge = _edge_points(size, circle[0], circle[1], 2 * largest)
        if len(edge) < _RAYS / 4:
            raise TouchError(
                f"no ball in the frame: an edge was found on {len(edge)} of {_RAYS} rays, "
                f"expected {_RAYS // 4}; the ball must show with more than a quarter of its rim"
            )
        previous, circle = circle, _fit_circle(edge, circle, largest)
        if np.hypot(*(circle - previous)[:2]) < 0.2:
            break
    misfit = float(np.median(np.abs(_misfit(circle, edge))))
    if misfit > 0.15 * circle[2]:
        raise TouchError(
            f"the object isn't round (edge {misfit:.1f} px off a circle of {circle[2]:.1f} px); "
            "expected one ball; leave the frame out"
        )
    ball = diameter_mm / 2
    rim = min(circle[2] * sensor.mm_per_px, 0.75 * ball)
    depth = ball - np.sqrt(ball**2 - rim**2)
    return BallPress(column=float(circle[0]), row=float(circle[1]), depth_mm=float(depth))


def _largest(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The largest connected region, its holes and narrow gaps filled."""
    labels, _ = ndimage.label(mask)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    padded = np.pad(labels == int(sizes.argmax()), 8)
    closed = ndimage.binary_closing(padded, iterations=6)
    return ndimage.binary_fill_holes(closed)[8:-8, 8:-8]


def _edge_points(size: NDArray[np.float32], column: float, row: float, reach: float) -> FloatArray:
    """Points where the change has fallen to half on each ray, (N, 2).

    Rays that leave the frame before that give none.
    """
    rows, columns = size.shape
    r = np.arange(0, reach, 0.5)
    points = []
    for angle in np.linspace(0, 2 * np.pi, _RAYS, endpoint=False):
        x, y = column + r * np.cos(angle), row + r * np.sin(angle)
        inside = (x >= 0) & (x <= columns - 1) & (y >= 0) & (y <= rows - 1)
        if inside.sum() < 10:
            continue
        x, y = x[inside], y[inside]
        along = ndimage.map_coordinates(size, [y, x], order=1)
        if along.max() <= 0:
            continue
        last = int(np.flatnonzero(along > 0.5 * along.max())[-1])
        if last < len(along) - 2:
            points.append((x[last], y[last]))
    return np.array(points).reshape(-1, 2)


def _misfit(circle: FloatArray, points: FloatArray) -> FloatArray:
    return np.hypot(points[:, 0] - circle[0], points[:, 1] - circle[1]) - circle[2]


def _fit_circle(points: FloatArray, start: FloatArray, largest: float) -> FloatArray:
    low, high = points.min(axis=0) - largest, points.max(axis=0) + largest
    fitted = optimize.least_squares(
        _misfit,
        np.clip(start, [*low, 5.1], [*high, largest - 0.1]),
        args=(points,),
        loss="soft_l1",
        bounds=([*low, 5.0], [*high, largest]),
    )
    return fitted.x


def fit_press(
    start: BallPress,
    slope_x: NDArray[np.floating],
    slope_down: NDArray[np.floating],
    shape: PressShape,
    *,
    mm_per_px: float,
    max_depth_mm: float,
) -> BallPress:
    """Position and depth whose slopes are nearest to measured ones.

    Args:
        start: A guess, within a few pixels.
        slope_x: (H, W), mm per mm.
        slope_down: (H, W), mm per mm.
        shape: Gives the slopes everywhere (``ProfileTable``).
        mm_per_px: Pixel pitch [mm].
        max_depth_mm: Largest depth that ``shape`` covers [mm].
    """
    rows, columns = slope_x.shape
    row, column = (a.ravel().astype(float) for a in np.mgrid[0:rows:2, 0:columns:2])
    near = np.hypot(column - start.column, row - start.row) * mm_per_px < 3.5
    row, column = row[near], column[near]
    measured = np.stack([slope[::2, ::2].ravel()[near] for slope in (slope_x, slope_down)], axis=-1)

    def misfit(guess: FloatArray) -> FloatArray:
        press = BallPress(column=guess[0], row=guess[1], depth_mm=guess[2])
        return (slopes_of(press, shape, column, row, mm_per_px) - measured).ravel()

    low = [start.column - 15, start.row - 15, 0.02]
    high = [start.column + 15, start.row + 15, max_depth_mm]
    fitted = optimize.least_squares(
        misfit,
        np.clip([start.column, start.row, start.depth_mm], low, np.array(high) - 1e-6),
        loss="soft_l1",
        f_scale=0.1,
        x_scale=[1, 1, 0.05],
        diff_step=1e-3,
        bounds=(low, high),
    )
    return BallPress(column=fitted.x[0], row=fitted.x[1], depth_mm=fitted.x[2])
