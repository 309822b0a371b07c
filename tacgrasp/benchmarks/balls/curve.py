"""``tacgrasp bench ball-curve``: how many presses of a ball a calibration needs.

For each number of presses, several random subsets of that size are calibrated on. Each calibration
measures the ball in all other presses. The error of a press is that of the diameter of the sphere
fitted to its heights.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache, partial
from pathlib import Path
from statistics import median

import numpy as np
from matplotlib.figure import Figure
from rich.console import Console

from cltp.sensing.photometric import Photometer
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.train.photometric.calibrate import MIN_PRESSES, train_gradients
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.balls.heights import HeldOutPress, measured_press
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.plot_file import write_png
from tacgrasp.benchmarks.pool import each_result
from tacgrasp.benchmarks.settings import BallCurveSettings
from tacgrasp.bringup.ball_frames import BallFrames, read_ball_frames
from tacgrasp.bringup.ball_profiles import ball_profiles
from tacgrasp.console import make_table_console

LIMIT_PERCENT, LIMIT_PRESSES = 3.0, 20
"""The median error that a calibration on so many presses is to keep."""

INSIDE_MM = 2.5
"""Distance from the border of the sensing area from which on a press lies whole in the frame: the
circle of a ball of 6.31 mm, 1 mm deep, has a radius of 2.3 mm."""

NO_BALL_PERCENT = 100.0
"""Error of a press in whose heights no ball is found."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Subset:
    """What a calibration on some of the presses measures in the others.

    Attributes:
        presses: Number of presses that were calibrated on.
        errors_percent: Error of the diameter in each other press [%], signed.
        inside: Whether each of these lies whole in the frame.
    """

    presses: int
    errors_percent: tuple[float, ...]
    inside: tuple[bool, ...]

    @property
    def median_error_percent(self) -> float:
        """Median of the sizes of the errors [%]."""
        return median(map(abs, self.errors_percent))


@dataclass(frozen=True, slots=True, kw_only=True)
class CurvePoint:
    """One number of presses, over its subsets.

    Attributes:
        presses: Number of presses that were calibrated on.
        subsets: Number of subsets.
        held_out: Number of presses measured, of all subsets together.
        median_error_percent: Median of the sizes of all errors [%].
        by_subset_percent: The same of each subset [%].
        inside_error_percent: Median of those of presses that lie whole in the frame [%].
        p75_error_percent: Size of error that a quarter of the presses exceed [%].
        diameter_error_percent: Error of the median diameter [%], signed.
    """

    presses: int
    subsets: int
    held_out: int
    median_error_percent: float
    by_subset_percent: tuple[float, ...]
    inside_error_percent: float
    p75_error_percent: float
    diameter_error_percent: float


def run(settings: BallCurveSettings) -> bool:
    """Measure, print, draw, write the figures; returns whether the limit is kept.

    Raises:
        UsageError: A number of presses leaves none to measure.
        TouchError: The folder can't be used, or too few of its frames show a ball.
        OSError: The file can't be written.
    """
    sensor = sensor_named("gelsight_mini")
    balls = read_ball_frames(settings.data, sensor, settings.background)
    for count in settings.presses:
        if not MIN_PRESSES <= count < len(balls.frames):
            raise UsageError(
                f"--presses must be {MIN_PRESSES} to {len(balls.frames) - 1}, since the others of "
                f"{len(balls.frames)} are measured; got {count}"
            )
    jobs = [(count, number) for count in settings.presses for number in range(settings.subsets)]
    console = make_table_console()
    measure = partial(_measure, settings, tuple(jobs))
    subsets = list(each_result(console, "calibrating", measure, range(len(jobs))))
    points = [curve_point([s for s in subsets if s.presses == n]) for n in settings.presses]
    _print(console, points)
    if settings.plot is not None:
        write_png(settings.plot, draw(points, settings.diameter_mm))
    write_figures(settings.json, figures_of(points))
    return all(
        point.median_error_percent <= LIMIT_PERCENT
        for point in points
        if point.presses == LIMIT_PRESSES
    )


@cache
def _frames(folder: Path, background: Path | None) -> BallFrames:
    return read_ball_frames(folder, sensor_named("gelsight_mini"), background)


def calibrated_on(
    balls: BallFrames, chosen: Sequence[int], sensor: SensorSpec, diameter_mm: float, seed: int
) -> Photometer:
    """A sensor that is calibrated on some of the presses."""
    trained = train_gradients(
        [balls.frames[index] for index in chosen],
        balls.background,
        sensor,
        diameter_mm,
        profiles=ball_profiles(sensor.name, diameter_mm),
        seed=seed,
    )
    return Photometer(trained.net, balls.background, sensor)


def _measure(settings: BallCurveSettings, jobs: Sequence[tuple[int, int]], job: int) -> Subset:
    """Calibrate on one random subset, and measure the other presses."""
    count, number = jobs[job]
    sensor, balls = sensor_named("gelsight_mini"), _frames(settings.data, settings.background)
    order = np.random.default_rng([settings.seed, count, number]).permutation(len(balls.frames))
    chosen, others = sorted(order[:count].tolist()), sorted(order[count:].tolist())
    photometer = calibrated_on(balls, chosen, sensor, settings.diameter_mm, settings.seed)
    held = [measured_press(balls, index, photometer) for index in others]
    return Subset(
        presses=count,
        errors_percent=tuple(_error_percent(press, settings.diameter_mm) for press in held),
        inside=tuple(_is_inside(press, photometer) for press in held),
    )


def _error_percent(press: HeldOutPress, diameter_mm: float) -> float:
    if press.ball is None:
        return NO_BALL_PERCENT
    return 100 * (press.ball.diameter_mm / diameter_mm - 1)


def _is_inside(press: HeldOutPress, photometer: Photometer) -> bool:
    if press.ball is None:
        return False
    sensor, ball = photometer.sensor, press.ball
    border_px = min(
        ball.column, sensor.columns - 1 - ball.column, ball.row, sensor.rows - 1 - ball.row
    )
    return border_px * sensor.mm_per_px >= INSIDE_MM


def curve_point(subsets: Sequence[Subset]) -> CurvePoint:
    """The figures of subsets of one size."""
    errors = np.array([error for subset in subsets for error in subset.errors_percent])
    inside = np.array([flag for subset in subsets for flag in subset.inside])
    sizes = np.abs(errors)
    return CurvePoint(
        presses=subsets[0].presses,
        subsets=len(subsets),
        held_out=len(errors),
        median_error_percent=float(np.median(sizes)),
        by_subset_percent=tuple(subset.median_error_percent for subset in subsets),
        inside_error_percent=float(np.median(sizes[inside])) if inside.any() else float("nan"),
        p75_error_percent=float(np.percentile(sizes, 75)),
        diameter_error_percent=float(np.median(errors)),
    )


def draw(points: Sequence[CurvePoint], diameter_mm: float) -> Figure:
    """The curve: median error over the number of presses, with each subset as a dot."""
    figure = Figure(figsize=(7.5, 4.8), layout="constrained")
    axes = figure.subplots()
    counts = [point.presses for point in points]
    for point in points:
        subsets = point.by_subset_percent
        axes.plot([point.presses] * len(subsets), subsets, "o", color="C0", alpha=0.35)
    axes.plot(counts, [p.median_error_percent for p in points], "-o", color="C0", label="all")
    inside = [p.inside_error_percent for p in points]
    axes.plot(counts, inside, "--s", color="C2", label="those whole in the frame")
    axes.axhline(LIMIT_PERCENT, color="grey", lw=0.8)
    axes.text(counts[-1], LIMIT_PERCENT, f"{LIMIT_PERCENT:g} %", ha="right", va="bottom")
    axes.set_xticks(counts)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("presses in the calibration")
    axes.set_ylabel("median error of the diameter, %")
    axes.set_title(f"Held-out presses of a ball of {diameter_mm:g} mm; dots: one subset each")
    axes.grid(visible=True, alpha=0.3)
    axes.legend()
    return figure


def figures_of(points: Sequence[CurvePoint]) -> Mapping[str, object]:
    """The figures of the JSON file."""
    return {"limit_percent": LIMIT_PERCENT, "points": [asdict(point) for point in points]}


def _print(console: Console, points: Sequence[CurvePoint]) -> None:
    table = number_table(
        "Error of the ball's diameter in presses that were left out, %",
        [
            "presses",
            "median",
            "subsets, least",
            "subsets, most",
            "whole in the frame",
            "a quarter exceeds",
            "of the median diameter",
            "measured",
        ],
    )
    for p in points:
        table.add_row(
            str(p.presses),
            f"{p.median_error_percent:.1f}",
            f"{min(p.by_subset_percent):.1f}",
            f"{max(p.by_subset_percent):.1f}",
            f"{p.inside_error_percent:.1f}",
            f"{p.p75_error_percent:.1f}",
            f"{p.diameter_error_percent:+.1f}",
            f"{p.held_out} in {p.subsets} subsets",
        )
    console.print(table)
    console.print(f"limit: {LIMIT_PERCENT:g} % in the median at {LIMIT_PRESSES} presses")
