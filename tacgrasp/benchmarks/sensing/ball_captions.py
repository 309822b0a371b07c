"""``tacgrasp bench ball-captions``: what the model says of real frames that show a known ball.

Every press goes the way of ``tacgrasp describe``: frame, heights, cloud, measured state and the
model's caption. What presses is known (a ball, so a sphere). How deep follows from the geometry in
two ways: from the radius of the circle that the ball shows in the colours, which needs no
calibration and is good to a pixel or two (0.05 to 0.1 mm); and from fitting the known ball to the
slopes, which is finer, but sees them through the same calibration as what it judges.

Not here: how right the heights are (``tacgrasp.benchmarks.sensing.balls``).
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table
from scipy import stats

from cltp.errors import TouchError
from cltp.sensing.ball_presses import find_press
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import Depth, Shape
from tacgrasp.benchmarks.sensing.ball_answers import Said, asker
from tacgrasp.benchmarks.sensing.balls import measure_held_out
from tacgrasp.bringup.ball_frames import frames_heights, read_ball_frames
from tacgrasp.bringup.ball_profiles import ball_profiles

ROUND = (Shape.SPHERE, Shape.ELLIPSOID)
"""One class on frames of an uncalibrated unit, whose gains of x and y differ (shared notes)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DepthOrder:
    """How alike two orders of presses are.

    Attributes:
        spearman: Rank correlation; NaN when all are tied.
        kendall: Tau b.
        concordant: Share of the pairs ordered alike, of those with different true depths.
        tied: Share of those pairs that are said to be equally deep.
        presses: How many were compared.
    """

    spearman: float
    kendall: float
    concordant: float
    tied: float
    presses: int


def depth_order(true_mm: Sequence[float], said: Sequence[float | None]) -> DepthOrder:
    """Compare the order that ``said`` gives with the true one; None is left out."""
    pairs = [(t, s) for t, s in zip(true_mm, said, strict=True) if s is not None]
    if len(pairs) < 2:
        return DepthOrder(
            spearman=np.nan, kendall=np.nan, concordant=np.nan, tied=np.nan, presses=len(pairs)
        )
    true, given = np.array(pairs, dtype=float).T
    upper = np.triu_indices(len(pairs), 1)
    sign = np.sign(true[:, None] - true[None])[upper]
    same = (sign * np.sign(given[:, None] - given[None])[upper])[sign != 0]
    constant = len(set(given)) == 1
    return DepthOrder(
        spearman=np.nan if constant else float(stats.spearmanr(true, given).statistic),
        kendall=np.nan if constant else float(stats.kendalltau(true, given).statistic),
        concordant=float((same > 0).mean()),
        tied=float((same == 0).mean()),
        presses=len(pairs),
    )


def run(
    folder: Path,
    *,
    weights: Path,
    diameter_mm: float,
    background: Path | None,
    calibration: Path | None,
    folds: int,
    json_path: Path | None,
) -> None:
    """Ask, print, write ``json_path`` if given.

    Args:
        folder: Frames of ball presses.
        weights: Folder of the model.
        diameter_mm: Of the ball [mm].
        background: The untouched gel; None is ``background.png`` in the folder.
        calibration: None is the one that ships; it has seen the project's own frames.
        folds: 0 takes ``calibration``; else so many are made, each for the presses it has not seen.
        json_path: For the figures.

    Raises:
        TouchError: Frames or weights can't be used, or no ball was found in any frame.
        OSError: The file can't be written.
    """
    sensor = sensor_named("gelsight_mini")
    heights = (
        _held_out(folder, sensor, background, diameter_mm, folds)
        if folds
        else frames_heights(folder, sensor=sensor, background=background, calibration=calibration)
    )
    ask = asker(weights, sensor, ball_profiles(sensor.name, diameter_mm))
    balls = read_ball_frames(folder, sensor, background)
    said, left_out = [], {}
    for (name, height_mm), frame in zip(heights, balls.frames, strict=True):
        try:
            press = find_press(frame, balls.background, sensor, diameter_mm)
        except TouchError as error:
            left_out[name] = str(error)
            continue
        said.append(ask(name, press, height_mm))
    if not said:
        raise TouchError(f"{folder}: no ball was found in any of {len(heights)} frames")
    how = "presses held out" if folds else f"calibration {calibration or 'that ships'}"
    figures = figures_of(said) | {
        "weights": str(weights),
        "heights": f"{how}{f', {folds} folds' if folds else ''}",
        "left_out": left_out,
    }
    _print(Console(), figures)
    if json_path is not None:
        report = figures | {"per_press": [asdict(one) for one in said]}
        json_path.write_text(json.dumps(_finite(report), indent=1) + "\n", encoding="utf-8")


def _held_out(
    folder: Path, sensor: SensorSpec, background: Path | None, diameter_mm: float, folds: int
) -> list[tuple[str, NDArray[np.float32]]]:
    balls = read_ball_frames(folder, sensor, background)
    held = measure_held_out(balls, sensor, diameter_mm, min(folds, len(balls.frames)))
    return [(one.name, one.height_mm) for one in held]


def figures_of(said: Sequence[Said]) -> dict[str, Any]:
    """Shares, shapes named and depth orders."""
    edge, slopes = [one.depth_mm for one in said], [one.fitted_mm for one in said]
    ranks = {word: rank for rank, word in enumerate(Depth)}
    by: dict[str, Sequence[float | None]] = {
        "measured, mm": [one.measured_mm for one in said],
        "heads, mm": [one.heads_mm for one in said],
        "caption, mm": [one.said_mm for one in said],
        "caption, class": [None if one.depth is None else float(ranks[one.depth]) for one in said],
    }
    off = [one.off_mm for one in said if one.off_mm is not None]
    named: dict[str, Sequence[Shape | None]] = {
        "caption": [one.shape for one in said],
        "heads": [one.heads_shape for one in said],
    }
    return {
        "presses": len(said),
        "depth_mm_from": min(edge),
        "depth_mm_to": max(edge),
        "sphere": {who: _share(shapes, (Shape.SPHERE,)) for who, shapes in named.items()},
        "sphere_or_ellipsoid": {who: _share(shapes, ROUND) for who, shapes in named.items()},
        "shapes": {
            who: dict(Counter(str(shape or "no caption") for shape in shapes).most_common())
            for who, shapes in named.items()
        },
        "depth_order": {who: asdict(depth_order(edge, values)) for who, values in by.items()}
        | {"slopes, mm": asdict(depth_order(edge, slopes))},
        "depth_order_by_slopes": {
            who: asdict(depth_order(slopes, values)) for who, values in by.items()
        },
        "position_off_mm_p50": float(np.median(off)) if off else None,
        "seen_as_contact": len(off),
    }


def _share(shapes: Sequence[Shape | None], wanted: tuple[Shape, ...]) -> float:
    return sum(shape in wanted for shape in shapes) / len(shapes)


def _finite(value: Any) -> Any:
    """None where there is no finite number, so that it is JSON."""
    if isinstance(value, dict):
        return {key: _finite(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_finite(part) for part in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def _print(to: Console, figures: dict[str, Any]) -> None:
    to.print(f"weights {figures['weights']}; heights: {figures['heights']}", soft_wrap=True)
    shapes = Table(
        "", "sphere", "sphere or ellipsoid", "shapes named", title="What a ball is called"
    )
    for who, counts in figures["shapes"].items():
        listed = ", ".join(f"{shape} {count}" for shape, count in counts.items())
        shares = (figures[key][who] for key in ("sphere", "sphere_or_ellipsoid"))
        shapes.add_row(who, *(f"{100 * share:.0f} %" for share in shares), listed)
    to.print(shapes)
    for key, truth in (("depth_order", "its circle"), ("depth_order_by_slopes", "its slopes")):
        to.print(_orders(figures[key], f"Order of depths against the ball's, by {truth}"))
    to.print(
        f"by its circle the {figures['presses']} presses are {figures['depth_mm_from']:.2f} to "
        f"{figures['depth_mm_to']:.2f} mm deep"
    )
    off = figures["position_off_mm_p50"]
    to.print(
        f"measured as a contact: {figures['seen_as_contact']} of {figures['presses']}; its place "
        + ("unknown" if off is None else f"{off:.2f} mm from the ball's, median")
    )
    for name, why in figures["left_out"].items():
        to.print(f"left out  {name}: {why}", soft_wrap=True)


def _orders(orders: dict[str, Any], title: str) -> Table:
    columns = ("depth by", "Spearman", "Kendall", "pairs right", "pairs tied", "presses")
    table = Table(*columns, title=title)
    for who, order in orders.items():
        table.add_row(
            who,
            f"{order['spearman']:.3f}",
            f"{order['kendall']:.3f}",
            f"{100 * order['concordant']:.1f} %",
            f"{100 * order['tied']:.1f} %",
            f"{order['presses']}",
        )
    return table
