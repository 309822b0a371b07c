"""Gains of a calibration in x and y, from presses of a ball of known diameter.

The lamps of another unit are stronger on one side, so that its calibration reads slopes that are
too steep or too flat in x and in y: a ball becomes an ellipsoid. Under a ball the true slope of the
gel is known in every pixel, whatever the depth of the press, so that a few presses give both gains.

Not here: calibrating anew (``cltp.train.photometric``), which also learns what gains can't mend.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from cltp.errors import TouchError
from cltp.sensing.ball_presses import BallPress, SphericalCap, find_press, slopes_of
from cltp.sensing.frames import Frame
from cltp.sensing.photometric import GradientNet, Photometer
from cltp.tactile.quantiles import median, spread_about

FloatArray = NDArray[np.float64]

MIN_PRESSES = 3
"""Fewer presses don't show how far each of them is off; our choice."""

LARGEST_MISFIT = 0.35
"""Misfit of the slopes under the ball, over their root mean square, above which gains don't explain
a calibration."""

LEAST_SPREAD = 0.06
"""Least spread of a gain among presses, relative. Real presses scatter so (``tacgrasp bench
ball-gains``); the spread of three of them is often smaller by chance."""

_SHIFT_PX = 8.0  # the circle in the colours is right within a pixel or two
_LEAST_PIXELS = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class PressGains:
    """What one press says.

    Attributes:
        x, y: Slope that is read over the true slope, in x and in y.
        misfit: Root mean square of the slopes that these gains don't explain, over that of the true
            slopes.
    """

    x: float
    y: float
    misfit: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Gains:
    """Gains of a calibration: medians over presses.

    Attributes:
        x, y: Slope that is read over the true slope.
        error_x, error_y: Standard errors, relative.
        misfit: Median misfit of the presses.
        presses: What each press says.
        rejected: Index of each frame without a usable press, with the reason.
    """

    x: float
    y: float
    error_x: float
    error_y: float
    misfit: float
    presses: tuple[PressGains, ...]
    rejected: dict[int, str]

    @property
    def ratio(self) -> float:
        """Gain of x over that of y; 1 for a ball that is read as round."""
        return self.x / self.y

    @property
    def explain(self) -> bool:
        """Whether the gains explain how the calibration reads the presses."""
        return self.misfit <= LARGEST_MISFIT

    def are_off(self, tolerance: float = 0.03) -> bool:
        """Whether a gain differs from 1 by more than ``tolerance`` and two standard errors."""
        gains = ((self.x, self.error_x), (self.y, self.error_y))
        return any(abs(math.log(gain)) > max(tolerance, 2 * error) for gain, error in gains)


def measure_gains(
    photometer: Photometer, frames: Sequence[Frame], background: Frame, diameter_mm: float
) -> Gains:
    """Compare the slopes that a calibration reads under a ball with the ball's own.

    Args:
        photometer: The calibration on the background.
        frames: One press each, (rows, columns, 3) uint8.
        background: The untouched gel.
        diameter_mm: Diameter of the ball [mm].

    Raises:
        TouchError: Fewer than ``MIN_PRESSES`` frames show a ball.
    """
    presses, rejected = [], {}
    for index, frame in enumerate(frames):
        try:
            start = find_press(frame, background, photometer.sensor, diameter_mm)
            slopes, pitch = photometer.gradients(frame), photometer.sensor.mm_per_px
            presses.append(press_gains(start, *slopes, diameter_mm, pitch))
        except TouchError as error:
            rejected[index] = str(error)
    if len(presses) < MIN_PRESSES:
        reason = f"; the first left out: {next(iter(rejected.values()))}" if rejected else ""
        raise TouchError(
            f"a ball was found in {len(presses)} of {len(frames)} frames, expected at least "
            f"{MIN_PRESSES}{reason}"
        )
    return gains_of(presses, rejected)


def gains_of(presses: Sequence[PressGains], rejected: dict[int, str] | None = None) -> Gains:
    """What several presses say together; ``rejected`` as in ``Gains``."""
    return Gains(
        x=float(np.median([press.x for press in presses])),
        y=float(np.median([press.y for press in presses])),
        error_x=_standard_error([press.x for press in presses]),
        error_y=_standard_error([press.y for press in presses]),
        misfit=float(np.median([press.misfit for press in presses])),
        presses=tuple(presses),
        rejected=rejected or {},
    )


def press_gains(
    start: BallPress,
    slope_x: NDArray[np.floating],
    slope_down: NDArray[np.floating],
    diameter_mm: float,
    mm_per_px: float,
) -> PressGains:
    """Gains of one press: the ball's centre is fitted with them.

    Args:
        start: Position and depth within a few pixels.
        slope_x: (H, W), slopes as they are read, mm per mm.
        slope_down: (H, W), mm per mm.
        diameter_mm: Diameter of the ball [mm].
        mm_per_px: Pixel pitch [mm].

    Raises:
        TouchError: Too little of the ball lies in the frame.
    """
    ball = SphericalCap(diameter_mm=diameter_mm)
    row, column = (a.ravel().astype(float) for a in np.indices(slope_x.shape))
    under = slopes_of(start, ball, column, row, mm_per_px)
    r_px = np.hypot(column - start.column, row - start.row)
    radius_px = math.sqrt(start.depth_mm * (diameter_mm - start.depth_mm)) / mm_per_px
    chosen = np.isfinite(under).all(axis=1) & (r_px < radius_px)
    if chosen.sum() < _LEAST_PIXELS:
        raise TouchError(f"only {chosen.sum()} pixels lie under the ball; press nearer the middle")
    row, column = row[chosen], column[chosen]
    read = np.stack([slope_x.ravel()[chosen], slope_down.ravel()[chosen]], axis=-1).astype(float)
    everywhere = BallPress(column=0, row=0, depth_mm=diameter_mm / 2)  # the sphere, not its rim

    def true_slopes(centre: FloatArray) -> FloatArray:
        return slopes_of(everywhere, ball, column - centre[0], row - centre[1], mm_per_px)

    def misfit(guess: FloatArray) -> FloatArray:
        return (true_slopes(guess) * guess[2:] - read).ravel()

    low = [start.column - _SHIFT_PX, start.row - _SHIFT_PX, 0.2, 0.2]
    high = [start.column + _SHIFT_PX, start.row + _SHIFT_PX, 5.0, 5.0]
    fitted = optimize.least_squares(
        misfit,
        [start.column, start.row, 1.0, 1.0],
        loss="soft_l1",
        f_scale=0.1,
        x_scale=[1, 1, 0.1, 0.1],
        bounds=(low, high),
    )
    true = true_slopes(fitted.x)
    left = misfit(fitted.x) / np.tile(fitted.x[2:], len(true))
    return PressGains(
        x=float(fitted.x[2]),
        y=float(fitted.x[3]),
        misfit=float(np.sqrt(np.mean(left**2) / np.mean(true**2))),
    )


def _standard_error(gains: Sequence[float]) -> float:
    """Relative standard error of the median, from the median absolute deviation."""
    logs = np.log(gains)
    spread = spread_about(logs, median(logs))
    return 1.2533 * max(spread, LEAST_SPREAD) / math.sqrt(len(gains))


def corrected(net: GradientNet, gains: Gains) -> GradientNet:
    """The network of a calibration without its gains: its slopes are divided by them."""
    factors = np.repeat([1 / gains.x, 1 / gains.y], 3).astype(np.float32)
    return dataclasses.replace(net, w3=net.w3 * factors, b3=net.b3 * factors)
