"""``tacgrasp bench ball-gains``: x and y gains of a calibration, found from a few real presses.

A calibration that was made without these presses is given artificial gains, as another unit's has.
Subsets of the presses find them. The ball's diameter is compared before and after the correction.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from statistics import median

import numpy as np
from numpy.typing import NDArray
from rich.console import Console

from cltp.errors import TouchError
from cltp.sensing.ball_fit import fit_ball
from cltp.sensing.ball_gains import PressGains, gains_of, press_gains
from cltp.sensing.ball_presses import BallPress, find_press
from cltp.sensing.photometric import integrate
from cltp.tactile.sensors import sensor_named
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.balls.curve import calibrated_on
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.settings import BallGainsSettings
from tacgrasp.bringup.ball_frames import read_ball_frames
from tacgrasp.console import make_table_console

GAINS = ((1.0, 1.0), (1.1, 1.0), (1.25, 1.0), (1.0, 1.25), (0.8, 1.1))
"""Artificial gains of x and y; the third and fourth are the largest that another unit had."""

RATIO_LIMIT_PERCENT = 5.0
"""Largest median error of the ratio of the gains. Our choice: a ball of 6.3 mm is then 0.3 mm wider
in one direction than in the other, as it is in presses without any gain."""


@dataclass(frozen=True, slots=True)
class HeldPress:
    """A press that the calibration was made without, and the slopes that it reads there."""

    start: BallPress
    slope_x: NDArray[np.float32]
    slope_down: NDArray[np.float32]


@dataclass(frozen=True, slots=True, kw_only=True)
class GainsRow:
    """Gains found from presses of one number, over the subsets.

    Attributes:
        x, y: Artificial gains.
        presses: Number of presses that they are found from.
        ratio: Ratio of the gains as it is found, median; x / y is right.
        ratio_error_percent: Size of its error, median [%].
        ratio_error_p95_percent: The same, exceeded by a twentieth of the subsets [%].
        flagged: Fraction of the subsets that say that a gain differs from 1.
        diameter_error_before_percent: Size of the error of the diameter in all held-out presses,
            median, with the gains [%].
        diameter_error_after_percent: The same after a correction with the median gains [%].
    """

    x: float
    y: float
    presses: int
    ratio: float
    ratio_error_percent: float
    ratio_error_p95_percent: float
    flagged: float
    diameter_error_before_percent: float
    diameter_error_after_percent: float


def run(settings: BallGainsSettings) -> bool:
    """Measure, print, write the figures; returns whether the ratios are found.

    Raises:
        UsageError: A number of presses is more than half of the frames.
        TouchError: The folder can't be used, or too few of its frames show a ball.
        OSError: The file can't be written.
    """
    held, mm_per_px = held_presses(settings)
    if max(settings.presses) > len(held):
        raise UsageError(f"--presses can be {len(held)} at most, those that are held out")
    rows = []
    for x, y in GAINS:
        rows += _rows(settings, held, mm_per_px, x, y)
    _print(make_table_console(), rows)
    write_figures(settings.json, {"rows": [asdict(row) for row in rows]})
    return all(row.ratio_error_percent <= RATIO_LIMIT_PERCENT for row in rows)


def held_presses(settings: BallGainsSettings) -> tuple[list[HeldPress], float]:
    """Calibrate on half of the presses; the others, and the pitch of the pixels [mm]."""
    sensor = sensor_named("gelsight_mini")
    balls = read_ball_frames(settings.data, sensor, settings.background)
    order = np.random.default_rng(settings.seed).permutation(len(balls.frames)).tolist()
    chosen, others = sorted(order[: len(order) // 2]), sorted(order[len(order) // 2 :])
    photometer = calibrated_on(balls, chosen, sensor, settings.diameter_mm, settings.seed)
    held = []
    for index in others:
        frame = balls.frames[index]
        start = find_press(frame, balls.background, sensor, settings.diameter_mm)
        held.append(HeldPress(start, *photometer.gradients(frame)))
    return held, sensor.mm_per_px


def _rows(
    settings: BallGainsSettings, held: Sequence[HeldPress], mm_per_px: float, x: float, y: float
) -> list[GainsRow]:
    found: list[PressGains] = []
    for press in held:
        slopes = x * press.slope_x, y * press.slope_down
        found.append(press_gains(press.start, *slopes, settings.diameter_mm, mm_per_px))
    whole, rows = gains_of(found), []
    errors = [
        _diameter_error(held, settings.diameter_mm, mm_per_px, *factors)
        for factors in ((x, y), (x / whole.x, y / whole.y))
    ]
    for count in settings.presses:
        rng = np.random.default_rng([settings.seed, count])
        drawn = [rng.permutation(len(found))[:count] for _ in range(settings.subsets)]
        subsets = [gains_of([found[index] for index in subset]) for subset in drawn]
        off = [100 * abs(each.ratio / (x / y) - 1) for each in subsets]
        rows.append(
            GainsRow(
                x=x,
                y=y,
                presses=count,
                ratio=median(each.ratio for each in subsets),
                ratio_error_percent=median(off),
                ratio_error_p95_percent=float(np.percentile(off, 95)),
                flagged=float(np.mean([each.are_off() for each in subsets])),
                diameter_error_before_percent=errors[0],
                diameter_error_after_percent=errors[1],
            )
        )
    return rows


def _diameter_error(
    held: Sequence[HeldPress], diameter_mm: float, mm_per_px: float, x: float, y: float
) -> float:
    """Median size of the error of the fitted diameter, with slopes times x and y [%]."""
    errors = []
    for press in held:
        height = integrate(x * press.slope_x, y * press.slope_down, mm_per_px)
        try:
            ball = fit_ball(height - np.median(height), mm_per_px)
        except TouchError:
            errors.append(100.0)
            continue
        errors.append(100 * abs(ball.diameter_mm / diameter_mm - 1))
    return median(errors)


def _print(console: Console, rows: Sequence[GainsRow]) -> None:
    table = number_table(
        "Gains of a calibration, found from presses of a ball",
        [
            "gain x",
            "gain y",
            "presses",
            "x / y",
            "found",
            "error, median %",
            "5 % exceed",
            "said to be off, %",
            "diameter error before, %",
            "after, %",
        ],
    )
    for row in rows:
        table.add_row(
            f"{row.x:g}",
            f"{row.y:g}",
            str(row.presses),
            f"{row.x / row.y:.3f}",
            f"{row.ratio:.3f}",
            f"{row.ratio_error_percent:.1f}",
            f"{row.ratio_error_p95_percent:.1f}",
            f"{100 * row.flagged:.0f}",
            f"{row.diameter_error_before_percent:.1f}",
            f"{row.diameter_error_after_percent:.1f}",
        )
    console.print(table)
    console.print(f"limit: {RATIO_LIMIT_PERCENT:g} % in the median")
