"""``tacgrasp bench balls``: error and cost of the heights of real frames.

The frames show presses of a ball of known diameter. A calibration that was made without a press (in
folds) measures it, and a sphere of free diameter is fitted to its heights.
"""

from __future__ import annotations

import sys
from dataclasses import asdict, dataclass
from itertools import cycle
from pathlib import Path
from statistics import median

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from cltp.errors import TouchError
from cltp.sensing.ball_fit import FittedBall, fit_ball
from cltp.sensing.calibration import default_calibration, load_calibration
from cltp.sensing.photometric import Photometer
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.train.photometric.calibrate import train_gradients
from cltp.train.progress import Bar
from tacgrasp.benchmarks.figures import times_ms, write_figures
from tacgrasp.benchmarks.settings import BallsSettings
from tacgrasp.bringup.ball_frames import BallFrames, read_ball_frames
from tacgrasp.bringup.ball_profiles import ball_profiles

PROFILE = "profile_6.31mm.csv"
DIAMETER_LIMIT_PERCENT = 4.0
TIME_LIMIT_MS = 25.0

_FLAT_MM = 5.0  # beyond this distance from a ball, the gel rises or sinks by less than 0.03 mm
_CENTRED = 20  # number of presses whose profile is averaged: those farthest from the border


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldOutPress:
    """A press measured by a calibration that was made without it.

    Attributes:
        name: Name of the frame.
        ball: The fitted ball; None where the fit failed.
        height_mm: Shape (rows, columns), heights [mm].
    """

    name: str
    ball: FittedBall | None
    height_mm: NDArray[np.float32]


def measure_held_out(
    balls: BallFrames,
    sensor: SensorSpec,
    diameter_mm: float,
    folds: int,
    *,
    bare_sphere: bool = False,
) -> list[HeldOutPress]:
    """Calibrate ``folds`` times, each time without every ``folds``-th press, and measure those.

    ``bare_sphere`` leaves out what the gel does around the contact.

    Raises:
        TouchError: Too few presses are left to calibrate on.
    """
    profiles = None if bare_sphere else ball_profiles(sensor.name, diameter_mm)
    presses: dict[int, HeldOutPress] = {}
    with Bar(sys.stderr) as bar:
        for fold in range(folds):
            frames = [f for i, f in enumerate(balls.frames) if i % folds != fold]
            trained = train_gradients(
                frames, balls.background, sensor, diameter_mm, profiles=profiles
            )
            photometer = Photometer(trained.net, balls.background, sensor)
            for index in range(fold, len(balls.frames), folds):
                presses[index] = measured_press(balls, index, photometer)
            bar("calibrating without", fold + 1, folds, {})
    return [presses[index] for index in sorted(presses)]


def measured_press(balls: BallFrames, index: int, photometer: Photometer) -> HeldOutPress:
    """The heights of one press, and the ball in them."""
    height_mm = photometer.heights(balls.frames[index])
    ball = _fit(height_mm, photometer.sensor)
    return HeldOutPress(name=balls.names[index], ball=ball, height_mm=height_mm)


def _fit(height_mm: NDArray[np.float32], sensor: SensorSpec) -> FittedBall | None:
    try:
        return fit_ball(height_mm, sensor.mm_per_px)
    except TouchError:
        return None


def profile_rmse(
    presses: list[HeldOutPress], sensor: SensorSpec, file: Path
) -> tuple[float, float] | None:
    """Compare the median radial profile of the centred presses with a stored one.

    Returns:
        Root mean square difference [mm], plain and after the best scaling; None without file.
    """
    if not file.is_file():
        return None
    r_mm, stored = np.loadtxt(file, delimiter=",", comments=("#", "r_mm")).T
    row, column = np.mgrid[0 : sensor.rows, 0 : sensor.columns]
    fits = [(p.ball, p.height_mm) for p in presses if p.ball is not None]
    fits.sort(key=lambda fit: _to_border_px(fit[0], sensor), reverse=True)
    profiles = []
    for ball, height_mm in fits[:_CENTRED]:
        r = np.hypot(column - ball.column, row - ball.row) * sensor.mm_per_px
        profiles.append([np.median(height_mm[np.abs(r - at) <= 0.1]) for at in r_mm])
    ours = np.median(profiles, axis=0)
    scale = float(ours @ stored / (ours @ ours))
    errors = [float(np.sqrt(np.mean((s * ours - stored) ** 2))) for s in (1.0, scale)]
    return errors[0], errors[1]


def drift_mm(presses: list[HeldOutPress], sensor: SensorSpec) -> float:
    """Standard deviation of the heights where the gel is nearly flat, median over presses [mm]."""
    row, column = np.mgrid[0 : sensor.rows, 0 : sensor.columns]
    spreads = []
    for press in presses:
        if (ball := press.ball) is not None:
            r = np.hypot(column - ball.column, row - ball.row) * sensor.mm_per_px
            spreads.append(float(press.height_mm[r > _FLAT_MM].std()))
    return median(spreads)


def _to_border_px(ball: FittedBall, sensor: SensorSpec) -> float:
    across = min(ball.column, sensor.columns - 1 - ball.column)
    return min(across, ball.row, sensor.rows - 1 - ball.row)


def run(settings: BallsSettings) -> bool:
    """Measure, print, write the figures; returns whether both limits are kept.

    Raises:
        TouchError: The folder can't be used, or no ball was found in any press.
        OSError: The file can't be written.
    """
    sensor = sensor_named("gelsight_mini")
    folder, diameter_mm = settings.data, settings.diameter_mm
    balls = read_ball_frames(folder, sensor, settings.background)
    folds = min(settings.folds, len(balls.frames))
    presses = measure_held_out(balls, sensor, diameter_mm, folds, bare_sphere=settings.bare_sphere)
    fitted = [press.ball for press in presses if press.ball is not None]
    if not fitted:
        raise TouchError(f"{folder}: no ball could be fitted in any of {len(presses)} presses")
    net = load_calibration(default_calibration(sensor), sensor).net
    photometer, frames = Photometer(net, balls.background, sensor), cycle(balls.frames)
    times = times_ms(lambda: photometer.heights(next(frames)), 100)
    diameters = sorted(ball.diameter_mm for ball in fitted)
    profile = profile_rmse(presses, sensor, folder / PROFILE)
    error = 100 * (median(diameters) / diameter_mm - 1)
    figures = {
        "presses": len(presses),
        "fitted": len(fitted),
        "folds": folds,
        "diameter_mm": diameter_mm,
        "diameter_mm_p10": float(np.percentile(diameters, 10)),
        "diameter_mm_p50": median(diameters),
        "diameter_mm_p90": float(np.percentile(diameters, 90)),
        "diameter_error_percent": error,
        "fit_residual_mm_p50": median(ball.residual_mm for ball in fitted),
        "drift_mm_p50": drift_mm(presses, sensor),
        "profile_rmse_mm": None if profile is None else profile[0],
        "profile_rmse_scaled_mm": None if profile is None else profile[1],
        "reconstruction_ms_p50": median(times),
        "reconstruction_ms_p95": float(np.percentile(times, 95)),
    }
    _print(Console(), presses, figures)
    per_press = [
        {"name": press.name, **(asdict(press.ball) if press.ball else {"diameter_mm": None})}
        for press in presses
    ]
    write_figures(settings.json, {**figures, "per_press": per_press})
    return abs(error) <= DIAMETER_LIMIT_PERCENT and median(times) <= TIME_LIMIT_MS


def _print(console: Console, presses: list[HeldOutPress], figures: dict[str, float | None]) -> None:
    table = Table("press", "diameter mm", "depth mm", "x px", "y px", "residual µm")
    for press in presses:
        if press.ball is None:
            table.add_row(press.name, "no ball", "", "", "", "")
            continue
        ball = press.ball
        table.add_row(
            press.name,
            f"{ball.diameter_mm:.2f}",
            f"{ball.depth_mm:.3f}",
            f"{ball.column:.0f}",
            f"{ball.row:.0f}",
            f"{1e3 * ball.residual_mm:.0f}",
        )
    console.print(table)
    table = Table("figure", "value", "note", title="Real frames to heights, presses held out")
    f = {key: float("nan") if value is None else value for key, value in figures.items()}
    table.add_row(
        "fitted diameter, median",
        f"{f['diameter_mm_p50']:.3f} mm ({f['diameter_error_percent']:+.1f} %)",
        f"{f['diameter_mm']:g} mm; limit {DIAMETER_LIMIT_PERCENT:g} %; {f['folds']:.0f} folds",
    )
    table.add_row(
        "fitted diameter, 10 to 90 %",
        f"{f['diameter_mm_p10']:.2f} to {f['diameter_mm_p90']:.2f} mm",
        f"{f['fitted']:.0f} of {f['presses']:.0f} presses",
    )
    table.add_row("fit residual, median", f"{1e3 * f['fit_residual_mm_p50']:.0f} µm", "")
    table.add_row(
        "drift, median",
        f"{1e3 * f['drift_mm_p50']:.0f} µm",
        f"standard deviation farther than {_FLAT_MM:g} mm from the ball",
    )
    if figures["profile_rmse_mm"] is None:
        table.add_row("profile RMSE", "not measured", f"no {PROFILE} in the folder")
    else:
        table.add_row(
            "profile RMSE",
            f"{f['profile_rmse_mm']:.4f} mm",
            f"scaled to the same depth {f['profile_rmse_scaled_mm']:.4f} mm; the profile is "
            "photometric too",
        )
    table.add_row(
        "one frame to heights",
        f"p50 {f['reconstruction_ms_p50']:.1f}, p95 {f['reconstruction_ms_p95']:.1f} ms",
        f"limit {TIME_LIMIT_MS:g} ms for p50",
    )
    console.print(table)
