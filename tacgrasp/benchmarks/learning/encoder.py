"""Time encoders beside the reference design of the same size, in one run on one machine.

Training: samples a second of forward, backward and step. Encoding: milliseconds at batch 1 and 64.
Scaling: with the number of points and of groups, where an encoder takes any number.
"""

from __future__ import annotations

import dataclasses
import json
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from rich.table import Table
from torch import Tensor, nn

from cltp.encoder.encoder import PRESETS, EncoderConfig, TactileEncoder
from cltp.errors import TouchError
from cltp.tactile.point_layout import EVEN
from cltp.tactile.sensors import SENSORS
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.learning.plain_pointbert import PlainPointBert

WARM_UP = 3
SCALES = ((256, 64), (1024, 64), (4096, 64), (1024, 32), (1024, 128), (1024, 256))
"""Points and groups of one cloud, one of them varied at a time."""

Figures = Mapping[str, float]


def run(
    preset: str,
    *,
    repeats: int = 100,
    scales: Sequence[tuple[int, int]] = SCALES,
    json_path: Path | None = None,
    clock: Callable[[], float] = time.perf_counter,
) -> None:
    """Measure and print.

    Args:
        preset: Whose sizes; its own encoder, ours with groups, and the reference are timed.
        repeats: Of batch 1; a tenth of it for batch 64 and for steps of training.
        scales: Points and groups to time besides.
        json_path: File for the figures.
        clock: Of what is timed [s].

    Raises:
        UsageError: No such preset, or it is for images.
    """
    if preset not in PRESETS:
        raise UsageError(f"unknown preset {preset!r}; known: {', '.join(PRESETS)}")
    config = PRESETS[preset]
    if config.tokenizer == "image":
        raise UsageError(f"preset {preset!r} takes images; the reference design takes points")
    groups = dataclasses.replace(config, tokenizer="fps", bearing=0, grades=0)
    models: dict[str, nn.Module] = {f"ours, {config.tokenizer}": TactileEncoder(config)}
    models["ours, fps"] = TactileEncoder(groups)
    models["plain PointBERT"] = PlainPointBert(groups)
    found: dict[str, dict[str, float]] = {}
    for name, model in models.items():
        found[name] = {
            "parameters": float(sum(p.numel() for p in model.parameters())),
            **_latency(model, 1, repeats, clock),
            **_latency(model, 64, max(3, repeats // 10), clock),
            "train_samples_per_s": _training(model, max(3, repeats // 10), clock),
        }
    scaling = {
        f"{points} points, {num} groups": _scaling(groups, points, num, repeats, clock)
        for points, num in scales
    }
    _show(preset, found, scaling)
    if json_path is not None:
        threads = torch.get_num_threads()
        whole = {"preset": preset, "threads": threads, "encoders": found, "scaling": scaling}
        json_path.write_text(json.dumps(whole, indent=1) + "\n", encoding="utf-8")


def clouds(count: int, num_points: int = 1024) -> Tensor:
    """Scaled points of gentle bumps in lattice order, shape (count, num_points, 3)."""
    side = round(num_points**0.5)
    if side * side != num_points:
        raise TouchError(f"clouds to time need a square number of points, got {num_points}")
    sensor = SENSORS["gelsight_mini"]
    aspect = sensor.height_mm / sensor.width_mm
    rng = torch.Generator().manual_seed(0)
    steps = (torch.arange(side) + 0.5) / side * 2 - 1
    x, y = steps.repeat(side), -aspect * steps.repeat_interleave(side)
    at = torch.rand(count, 2, generator=rng) - 0.5
    away = (x - at[:, :1]) ** 2 + (y - at[:, 1:]) ** 2
    return torch.stack([x.expand(count, -1), y.expand(count, -1), 0.4 * (-8 * away).exp()], dim=-1)


@torch.inference_mode()
def _latency(
    model: nn.Module, batch: int, repeats: int, clock: Callable[[], float]
) -> dict[str, float]:
    model.eval()
    points = clouds(batch, _points_of(model))
    taken = []
    for number in range(WARM_UP + repeats):
        began = clock()
        model(points)
        if number >= WARM_UP:
            taken.append(1e3 * (clock() - began))
    return {
        f"batch_{batch}_p50_ms": float(np.percentile(taken, 50)),
        f"batch_{batch}_p99_ms": float(np.percentile(taken, 99)),
    }


def _points_of(model: nn.Module) -> int:
    sampling = model.config.sampling if isinstance(model, TactileEncoder) else EVEN
    return int(sampling.side**2)


def _training(model: nn.Module, steps: int, clock: Callable[[], float], batch: int = 32) -> float:
    model.train()
    points = clouds(batch, _points_of(model))
    optimiser = torch.optim.AdamW(model.parameters(), lr=1e-4)
    began = clock()
    for number in range(1 + steps):
        if number == 1:
            began = clock()
        out = model(points)
        feature = out if isinstance(out, Tensor) else out.feature
        optimiser.zero_grad()
        feature.square().mean().backward()
        optimiser.step()
    return steps * batch / (clock() - began)


@torch.inference_mode()
def _scaling(
    config: EncoderConfig, points: int, groups: int, repeats: int, clock: Callable[[], float]
) -> dict[str, float]:
    sized = dataclasses.replace(config, num_groups=groups)
    found = {}
    for name, model in (("ours", TactileEncoder(sized)), ("plain", PlainPointBert(sized))):
        model.eval()
        cloud, taken = clouds(1, points), []
        for number in range(WARM_UP + max(3, repeats // 10)):
            began = clock()
            model(cloud)
            if number >= WARM_UP:
                taken.append(1e3 * (clock() - began))
        found[f"{name}_ms"] = float(np.median(taken))
    return found


def _show(preset: str, found: Mapping[str, Figures], scaling: Mapping[str, Figures]) -> None:
    to = Console()
    to = to if to.is_terminal else Console(width=140)
    shown = Table(title=f"encoders at the size of {preset}, {torch.get_num_threads()} threads")
    columns = list(next(iter(found.values())))
    for column in ("", *columns):
        shown.add_column(column.replace("_", " "), justify="right" if column else "left")
    for name, figures in found.items():
        shown.add_row(name, *(_number(figures[column]) for column in columns))
    to.print(shown)
    grown = Table(title="one cloud, fps: median ms")
    for column in ("", "ours ms", "plain ms"):
        grown.add_column(column, justify="right" if column else "left")
    for name, figures in scaling.items():
        grown.add_row(name, *(f"{value:.2f}" for value in figures.values()))
    to.print(grown)


def _number(value: float) -> str:
    return f"{value:,.0f}" if value >= 1000 else f"{value:.3g}"
