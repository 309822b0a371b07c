"""Measure a ball in a height map, to check the scale of a calibration.

Not here: presses that a calibration learns from (``cltp.sensing.ball_presses``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, optimize

from cltp.errors import TouchError

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedBall:
    """A sphere fitted to heights.

    Attributes:
        diameter_mm: Diameter [mm].
        depth_mm: Depth of the lowest point below the frame's median [mm].
        column, row: Centre [px].
        residual_mm: Misfit, root mean square [mm].
    """

    diameter_mm: float
    depth_mm: float
    column: float
    row: float
    residual_mm: float


def fit_ball(height_mm: NDArray[np.floating], mm_per_px: float) -> FittedBall:
    """Fit a sphere of unknown size to the deepest region of a height map (H, W) [mm].

    Only pixels deeper than half of the depth count: there the gel follows the ball. ``mm_per_px``
    is the pixel pitch [mm].

    Raises:
        TouchError: Fewer than 50 pixels are deeper than half.
    """
    smooth = ndimage.gaussian_filter(height_mm, 1.0)
    labels, _ = ndimage.label(smooth > 0.5 * smooth.max())
    region = labels == labels.flat[int(smooth.argmax())]
    row, column = np.nonzero(region)
    if len(row) < 50:
        raise TouchError(f"no ball to fit: only {len(row)} pixels are deeper than half")
    x, y, z = column * mm_per_px, row * mm_per_px, height_mm[region].astype(np.float64)

    def misfit(ball: FloatArray) -> FloatArray:
        inside = ball[3] ** 2 - (x - ball[0]) ** 2 - (y - ball[1]) ** 2
        return ball[2] - ball[3] + np.sqrt(np.maximum(inside, 1e-6)) - z

    start = [np.average(x, weights=z), np.average(y, weights=z), z.max(), 3 * np.ptp(x) / 4]
    fitted = optimize.least_squares(misfit, start, loss="soft_l1", f_scale=0.02)
    return FittedBall(
        diameter_mm=2 * abs(fitted.x[3]),
        depth_mm=fitted.x[2],
        column=fitted.x[0] / mm_per_px,
        row=fitted.x[1] / mm_per_px,
        residual_mm=float(np.sqrt(np.mean(misfit(fitted.x) ** 2))),
    )
