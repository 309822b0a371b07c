"""The untouched parts of frames of ball presses: heights without what the ball does to them.

The ball is found by its colours, and the slopes within its rim and a margin are taken as zero
before the integration. So no error under the ball spreads over the frame, as it would by cutting
the ball out of integrated heights.

Not here: spectra and correlations (``tacgrasp.benchmarks.sensing.noise_spectrum``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.sensing.ball_presses import BallPress, find_press
from cltp.sensing.photometric import Photometer, integrate
from cltp.tactile.sensors import SensorSpec
from tacgrasp.bringup.ball_frames import BallFrames

MARGIN_MM = 3.0
"""Width of the ring around the ball's rim that counts as touched [mm]. Source: real frames show the
rise of the gel 2 to 3 mm from the edge of a contact; 2 to 5 mm give drifts within a fifth."""

UNDER_BALL = 0.6
"""Part of the rim's radius in which the gel certainly follows the ball."""

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class UntouchedPart:
    """One frame outside its contact.

    Attributes:
        name: Name of the frame.
        height_mm: Shape (rows, columns), heights with flat slopes under the ball [mm]; their mean
            outside is 0.
        outside: Same shape: whether a pixel is untouched.
        gain_x, gain_y: Measured slope under the ball over the slope that the ball has there.
    """

    name: str
    height_mm: FloatArray
    outside: NDArray[np.bool_]
    gain_x: float
    gain_y: float


def untouched_parts(
    balls: BallFrames, photometer: Photometer, diameter_mm: float
) -> list[UntouchedPart]:
    """The untouched part of every frame that shows a ball.

    Raises:
        TouchError: No frame shows a ball of this diameter, or one does not fit the background.
    """
    parts, reason = [], ""
    for name, frame in zip(balls.names, balls.frames, strict=True):
        try:
            press = find_press(frame, balls.background, photometer.sensor, diameter_mm)
        except TouchError as error:
            reason = f"{name}: {error}"
            continue
        parts.append(
            _part(name, press, photometer.gradients(frame), photometer.sensor, diameter_mm)
        )
    if len(parts) < 2:
        raise TouchError(f"expected at least 2 frames of a ball, found {len(parts)}; {reason}")
    return parts


def _part(
    name: str,
    press: BallPress,
    slopes: tuple[NDArray[np.float32], NDArray[np.float32]],
    sensor: SensorSpec,
    diameter_mm: float,
) -> UntouchedPart:
    row, column = np.mgrid[0 : sensor.rows, 0 : sensor.columns]
    x = (column - press.column) * sensor.mm_per_px
    down = (row - press.row) * sensor.mm_per_px
    r = np.hypot(x, down)
    rim = math.sqrt(press.depth_mm * (diameter_mm - press.depth_mm))
    outside = r > rim + MARGIN_MM
    flat = [np.where(outside, slope, np.float32(0)) for slope in slopes]
    heights = integrate(flat[0], flat[1], sensor.mm_per_px).astype(np.float64)
    under = r < UNDER_BALL * rim
    root = np.sqrt((diameter_mm / 2) ** 2 - r[under] ** 2)
    gains = [
        float(np.polyfit(-along[under] / root, slope[under], 1)[0])
        for along, slope in ((x, slopes[0]), (down, slopes[1]))
    ]
    return UntouchedPart(
        name=name,
        height_mm=heights - heights[outside].mean(),
        outside=outside,
        gain_x=gains[0],
        gain_y=gains[1],
    )


def without_plane(height_mm: FloatArray, known: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
    """Heights less the plane that fits their known part best, and its slopes by pixel (x, down)."""
    row, column = np.mgrid[0 : height_mm.shape[0], 0 : height_mm.shape[1]]
    basis = np.stack([column, row, np.ones_like(row)], axis=-1).astype(np.float64)
    plane = np.linalg.lstsq(basis[known], height_mm[known], rcond=None)[0]
    return height_mm - basis @ plane, np.asarray(plane[:2], dtype=np.float64)
