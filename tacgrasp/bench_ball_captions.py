"""``tacgrasp bench ball-captions``: what the model says of real frames that show a known ball.

Every press goes the way of ``tacgrasp describe``: frame, heights, cloud, measured state and the
model's caption. What presses is known (a ball, so a sphere), and how deep follows from the geometry
of its circle, which is found in the colours without any calibration.

Not here: how right the heights are (``tacgrasp.bench_balls``).
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table
from scipy import stats

from cltp.ball_presses import BallPress, find_press
from cltp.captions import parse_caption
from cltp.cloud import TactileCloud, cloud_from_heights
from cltp.errors import TouchError
from cltp.heads import restored
from cltp.inputs import encoder_input
from cltp.measure import contact_state
from cltp.samples import CLASSES
from cltp.sensors import SensorSpec, sensor_named
from cltp.states import Depth, Shape
from cltp.weights import load_encoder
from policies import PolicyError
from tacgrasp.ball_frames import frames_heights, read_ball_frames
from tacgrasp.bench_balls import measure_held_out
from tacgrasp.describe import CAPTION_REQUEST
from tacgrasp.judging import numbers_said
from tacgrasp.policy_factory import load_llm

ROUND = (Shape.SPHERE, Shape.ELLIPSOID)
"""One class on frames of an uncalibrated unit, whose gains of x and y differ (shared notes)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Said:
    """What was said of one press, and what is known of it.

    Attributes:
        name: Of the frame.
        depth_mm: Of the ball, from the geometry of its circle [mm].
        x_mm, y_mm: Of the ball's centre [mm, gel frame].
        measured_mm: Depth that the direct measurement gives; 0 without contact [mm].
        off_mm: Distance of the measured place from the ball's [mm]; None without contact.
        text: The model's reply.
        shape: Named in its caption; None when it named none.
        depth: Named in its caption.
        said_mm: Depth in numbers beside the caption; None when it gave none [mm].
        heads_shape: What the encoder's heads call it.
        heads_mm: Depth of the encoder's heads [mm].
    """

    name: str
    depth_mm: float
    x_mm: float
    y_mm: float
    measured_mm: float
    off_mm: float | None
    text: str
    shape: Shape | None
    depth: Depth | None
    said_mm: float | None
    heads_shape: Shape
    heads_mm: float


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
    ask = _asker(weights)
    balls = read_ball_frames(folder, sensor, background)
    said, left_out = [], {}
    for (name, height_mm), frame in zip(heights, balls.frames, strict=True):
        try:
            press = find_press(frame, balls.background, sensor, diameter_mm)
        except TouchError as error:
            left_out[name] = str(error)
            continue
        said.append(ask(name, press, cloud_from_heights(height_mm, sensor)))
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


def _asker(weights: Path) -> Callable[[str, BallPress, TactileCloud], Said]:
    """What asks a model and its encoder's heads about one press."""
    model = load_llm(weights)
    encoder, heads = load_encoder(weights / "encoder")
    encoder.eval(), heads.eval()

    @torch.inference_mode()
    def ask(name: str, press: BallPress, cloud: TactileCloud) -> Said:
        sensor, state = cloud.sensor, contact_state(cloud)
        x_mm = (press.column - (sensor.columns - 1) / 2) * sensor.mm_per_px
        y_mm = ((sensor.rows - 1) / 2 - press.row) * sensor.mm_per_px
        try:
            text = model.ask(cloud, CAPTION_REQUEST)
        except PolicyError as error:
            text = f"nothing: {error}"
        shape, depth = _named(text)
        numbers = numbers_said(text)
        logits, values, _, _ = heads(encoder(torch.from_numpy(encoder_input(cloud))[None]).pooled)
        return Said(
            name=name,
            depth_mm=press.depth_mm,
            x_mm=x_mm,
            y_mm=y_mm,
            measured_mm=state.depth_mm,
            off_mm=(
                float(np.hypot(state.x_mm - x_mm, state.y_mm - y_mm)) if state.in_contact else None
            ),
            text=text,
            shape=shape,
            depth=depth,
            said_mm=None if numbers is None else numbers[0],
            heads_shape=Shape(CLASSES["shape"][int(logits[0].argmax())]),
            heads_mm=float(restored(values)[0, 0]),
        )

    return ask


def _named(text: str) -> tuple[Shape | None, Depth | None]:
    try:
        slots = parse_caption(text.split(".")[0])
    except TouchError:
        return None, None
    return slots.shape, slots.depth


def figures_of(said: Sequence[Said]) -> dict[str, Any]:
    """Shares, shapes named and depth orders."""
    true = [one.depth_mm for one in said]
    ranks = {word: rank for rank, word in enumerate(Depth)}
    classes = [None if one.depth is None else float(ranks[one.depth]) for one in said]
    orders = {
        "measured, mm": depth_order(true, [one.measured_mm for one in said]),
        "heads, mm": depth_order(true, [one.heads_mm for one in said]),
        "caption, mm": depth_order(true, [one.said_mm for one in said]),
        "caption, class": depth_order(true, classes),
    }
    off = [one.off_mm for one in said if one.off_mm is not None]
    named: dict[str, Sequence[Shape | None]] = {
        "caption": [one.shape for one in said],
        "heads": [one.heads_shape for one in said],
    }
    return {
        "presses": len(said),
        "depth_mm_from": min(true),
        "depth_mm_to": max(true),
        "sphere": {who: _share(shapes, (Shape.SPHERE,)) for who, shapes in named.items()},
        "sphere_or_ellipsoid": {who: _share(shapes, ROUND) for who, shapes in named.items()},
        "shapes": {
            who: dict(Counter(str(shape or "no caption") for shape in shapes).most_common())
            for who, shapes in named.items()
        },
        "depth_order": {who: asdict(order) for who, order in orders.items()},
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
    orders = Table(
        "depth by", "Spearman", "Kendall", "pairs right", "pairs tied", "presses",
        title=f"Order of {figures['presses']} presses, "
        f"{figures['depth_mm_from']:.2f} to {figures['depth_mm_to']:.2f} mm deep by geometry",
    )  # fmt: skip
    for who, order in figures["depth_order"].items():
        orders.add_row(
            who,
            f"{order['spearman']:.3f}",
            f"{order['kendall']:.3f}",
            f"{100 * order['concordant']:.1f} %",
            f"{100 * order['tied']:.1f} %",
            f"{order['presses']}",
        )
    to.print(orders)
    off = figures["position_off_mm_p50"]
    to.print(
        f"measured as a contact: {figures['seen_as_contact']} of {figures['presses']}; its place "
        + ("unknown" if off is None else f"{off:.2f} mm from the ball's, median")
    )
    for name, why in figures["left_out"].items():
        to.print(f"left out  {name}: {why}", soft_wrap=True)
