"""``tacgrasp bench ball-captions``: score captions of real frames of a pressed ball.

Each press takes the path of ``tacgrasp describe``: frame, heights, cloud, measured state, caption.
The object is known, so the shape is a sphere. The depth follows from the geometry in two ways: from
the radius of the circle that the ball shows in the colours, which needs no calibration and is good
to a pixel or two (0.05 to 0.1 mm); and from fitting the ball to the slopes, which is finer but uses
the calibration that it judges.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table
from scipy import stats

from cltp.errors import TouchError
from cltp.sensing.ball_presses import find_press
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import Depth, Shape
from tacgrasp.benchmarks.balls.answers import BallReading, make_reader
from tacgrasp.benchmarks.balls.heights import measure_held_out
from tacgrasp.benchmarks.figures import write_figures
from tacgrasp.benchmarks.settings import BallCaptionsSettings
from tacgrasp.bringup.ball_frames import frames_heights, read_ball_frames
from tacgrasp.bringup.ball_profiles import ball_profiles
from tacgrasp.policy_factory import default_weights

ROUND = (Shape.SPHERE, Shape.ELLIPSOID)
"""One class on frames of an uncalibrated unit, whose gains of x and y differ."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DepthOrder:
    """Agreement of two orders of presses.

    Attributes:
        spearman: Spearman's rank correlation; NaN when all are tied.
        kendall: Kendall's tau b.
        concordant: Fraction of the pairs in the same order, of those with different true depths.
        tied: Fraction of those pairs that are read as equally deep.
        presses: Number of presses compared.
    """

    spearman: float
    kendall: float
    concordant: float
    tied: float
    presses: int


def depth_order(true_mm: Sequence[float], readings: Sequence[float | None]) -> DepthOrder:
    """Compare the order of readings with the true order; None is left out."""
    pairs = [(t, r) for t, r in zip(true_mm, readings, strict=True) if r is not None]
    if len(pairs) < 2:
        return DepthOrder(
            spearman=np.nan, kendall=np.nan, concordant=np.nan, tied=np.nan, presses=len(pairs)
        )
    true, read = np.array(pairs, dtype=float).T
    upper = np.triu_indices(len(pairs), 1)
    sign = np.sign(true[:, None] - true[None])[upper]
    same = (sign * np.sign(read[:, None] - read[None])[upper])[sign != 0]
    constant = len(set(read)) == 1
    return DepthOrder(
        spearman=np.nan if constant else float(stats.spearmanr(true, read).statistic),
        kendall=np.nan if constant else float(stats.kendalltau(true, read).statistic),
        concordant=float((same > 0).mean()),
        tied=float((same == 0).mean()),
        presses=len(pairs),
    )


def run(settings: BallCaptionsSettings) -> None:
    """Read every press, print the scores and write them.

    Raises:
        TouchError: Frames or weights can't be used, or no ball was found in any frame.
        OSError: The file can't be written.
    """
    sensor = sensor_named("gelsight_mini")
    folder, background, folds = settings.data, settings.background, settings.folds
    weights, diameter_mm = settings.weights or default_weights(), settings.diameter_mm
    balls = read_ball_frames(folder, sensor, background)
    if folds:
        presses = measure_held_out(balls, sensor, diameter_mm, min(folds, len(balls.frames)))
        heights = [(press.name, press.height_mm) for press in presses]
    else:
        heights = frames_heights(
            folder, sensor=sensor, background=background, calibration=settings.calibration
        )
    read = make_reader(weights, sensor, ball_profiles(sensor.name, diameter_mm))
    readings, left_out = [], {}
    for (name, height_mm), frame in zip(heights, balls.frames, strict=True):
        try:
            press = find_press(frame, balls.background, sensor, diameter_mm)
        except TouchError as error:
            left_out[name] = str(error)
            continue
        readings.append(read(name, press, height_mm))
    if not readings:
        raise TouchError(f"{folder}: no ball was found in any of {len(heights)} frames")
    source = "presses held out" if folds else f"calibration {settings.calibration or 'as shipped'}"
    figures = figures_of(readings) | {
        "weights": str(weights),
        "heights": f"{source}{f', {folds} folds' if folds else ''}",
        "left_out": left_out,
    }
    _print(Console(), figures)
    report = figures | {"per_press": [asdict(reading) for reading in readings]}
    write_figures(settings.json, _finite(report))


def figures_of(readings: Sequence[BallReading]) -> dict[str, Any]:
    """Fractions of right shapes, shapes named, and depth orders."""
    circles, slopes = [r.depth_mm for r in readings], [r.fitted_mm for r in readings]
    ranks = {word: rank for rank, word in enumerate(Depth)}
    depths: dict[str, Sequence[float | None]] = {
        "measured, mm": [r.measured_mm for r in readings],
        "heads, mm": [r.heads_mm for r in readings],
        "caption, mm": [r.caption_mm for r in readings],
        "caption, class": [None if r.depth is None else float(ranks[r.depth]) for r in readings],
    }
    errors = [r.position_error_mm for r in readings if r.position_error_mm is not None]
    shapes: dict[str, Sequence[Shape | None]] = {
        "caption": [r.shape for r in readings],
        "heads": [r.heads_shape for r in readings],
    }
    return {
        "presses": len(readings),
        "depth_mm_from": min(circles),
        "depth_mm_to": max(circles),
        "sphere": {name: _fraction(words, (Shape.SPHERE,)) for name, words in shapes.items()},
        "sphere_or_ellipsoid": {name: _fraction(words, ROUND) for name, words in shapes.items()},
        "shapes": {
            name: dict(Counter(str(shape or "no caption") for shape in words).most_common())
            for name, words in shapes.items()
        },
        "depth_order": {
            name: asdict(depth_order(circles, values)) for name, values in depths.items()
        }
        | {"slopes, mm": asdict(depth_order(circles, slopes))},
        "depth_order_by_slopes": {
            name: asdict(depth_order(slopes, values)) for name, values in depths.items()
        },
        "position_off_mm_p50": float(np.median(errors)) if errors else None,
        "seen_as_contact": len(errors),
    }


def _fraction(shapes: Sequence[Shape | None], right: tuple[Shape, ...]) -> float:
    return sum(shape in right for shape in shapes) / len(shapes)


def _finite(value: Any) -> Any:
    """A value for JSON: None in place of a number that is not finite."""
    if isinstance(value, dict):
        return {key: _finite(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_finite(part) for part in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def _print(console: Console, figures: dict[str, Any]) -> None:
    console.print(f"weights {figures['weights']}; heights: {figures['heights']}", soft_wrap=True)
    shapes = Table("", "sphere", "sphere or ellipsoid", "shapes named", title="Shape of the ball")
    for name, counts in figures["shapes"].items():
        words = ", ".join(f"{shape} {count}" for shape, count in counts.items())
        fractions = (figures[key][name] for key in ("sphere", "sphere_or_ellipsoid"))
        shapes.add_row(name, *(f"{100 * fraction:.0f} %" for fraction in fractions), words)
    console.print(shapes)
    for key, truth in (("depth_order", "its circle"), ("depth_order_by_slopes", "its slopes")):
        console.print(_orders(figures[key], f"Order of depths against the ball's, by {truth}"))
    console.print(
        f"by its circle the {figures['presses']} presses are {figures['depth_mm_from']:.2f} to "
        f"{figures['depth_mm_to']:.2f} mm deep"
    )
    error = figures["position_off_mm_p50"]
    console.print(
        f"measured as a contact: {figures['seen_as_contact']} of {figures['presses']}; median "
        + ("position error unknown" if error is None else f"position error {error:.2f} mm")
    )
    for name, reason in figures["left_out"].items():
        console.print(f"left out  {name}: {reason}", soft_wrap=True)


def _orders(orders: dict[str, Any], title: str) -> Table:
    columns = ("depth by", "Spearman", "Kendall", "pairs right", "pairs tied", "presses")
    table = Table(*columns, title=title)
    for name, order in orders.items():
        table.add_row(
            name,
            f"{order['spearman']:.3f}",
            f"{order['kendall']:.3f}",
            f"{100 * order['concordant']:.1f} %",
            f"{100 * order['tied']:.1f} %",
            f"{order['presses']}",
        )
    return table
