"""Some presses of a ball to calibrate on, spread over the gel, and what is measured in the others.

Not here: calibrating (``cltp.train.photometric``), random subsets of presses
(``tacgrasp.benchmarks.balls.curve``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from statistics import median

import numpy as np

from cltp.errors import TouchError
from cltp.sensing.ball_fit import fit_ball
from cltp.sensing.photometric import Photometer
from cltp.tactile.sensors import SensorSpec
from cltp.train.photometric.calibrate import find_presses
from tacgrasp.bringup.ball_frames import BallFrames


def spread_presses(
    balls: BallFrames, sensor: SensorSpec, diameter_mm: float, count: int
) -> tuple[BallFrames, BallFrames]:
    """Choose the presses that lie farthest from each other, and give the others beside them.

    The first is the one nearest the middle; each next one is the farthest from those before. Frames
    without a ball are in neither part.

    Raises:
        TouchError: Fewer than ``MIN_PRESSES`` frames show a ball, as without a choice; or there are
            not ``count`` of them, and one more.
    """
    found, presses, _ = find_presses(balls.frames, balls.background, sensor, diameter_mm)
    places = [(press.column, press.row) for press in presses]
    if not 1 <= count < len(found):
        raise TouchError(
            f"a ball shows in {len(found)} of {len(balls.frames)} frames: --presses must be 1 to "
            f"{len(found) - 1}, since the others are measured; got {count}"
        )
    at = np.array(places)
    middle = np.array([sensor.columns - 1, sensor.rows - 1]) / 2
    chosen = [int(np.hypot(*(at - middle).T).argmin())]
    while len(chosen) < count:
        nearest = np.min([np.hypot(*(at - at[one]).T) for one in chosen], axis=0)
        chosen.append(int(nearest.argmax()))
    kept = sorted(found[one] for one in chosen)
    return _part(balls, kept), _part(balls, sorted(set(found) - set(kept)))


def _part(balls: BallFrames, indices: Sequence[int]) -> BallFrames:
    return replace(
        balls,
        names=tuple(balls.names[index] for index in indices),
        frames=tuple(balls.frames[index] for index in indices),
    )


def held_out_line(balls: BallFrames, photometer: Photometer, diameter_mm: float) -> str:
    """What is printed of presses that a calibration was made without."""
    diameters, failed = [], 0
    for frame in balls.frames:
        try:
            ball = fit_ball(photometer.heights(frame), photometer.sensor.mm_per_px)
        except TouchError:
            failed += 1
            continue
        diameters.append(ball.diameter_mm)
    if not diameters:
        return f"held out  no ball could be fitted in any of {failed} presses"
    off = median(100 * abs(diameter / diameter_mm - 1) for diameter in diameters)
    without = f", none in {failed}" if failed else ""
    return (
        f"held out  {len(diameters)} presses{without}: diameter {median(diameters):.2f} mm in the "
        f"median, {off:.1f} % off in the median"
    )
