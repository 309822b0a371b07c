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
        preset: Name of the encoder. Its own tokenizer, ours with groups, and the reference design
            of the same size are timed.
        repeats: Number of encodings at batch 1; a tenth of it at batch 64 and for training.
        scales: Numbers of points and groups to time as well.
        json_path: File for the figures.
        clock: Time source [s].

    Raises:
        UsageError: An unknown preset, or one that takes images.
    """
    if preset not in PRESETS:
        raise UsageError(f"unknown preset {preset!r}; known: {', '.join(PRESETS)}")
    config = PRESETS[preset]
    if config.takes_images:
        raise UsageError(f"preset {preset!r} takes images; the reference design takes points")
    groups = dataclasses.replace(config, tokenizer="fps", bearing=0, grades=0)
    models: dict[str, nn.Module] = {f"ours, {config.tokenizer}": TactileEncoder(config)}
    models["ours, fps"] = TactileEncoder(groups)
    models["plain PointBERT"] = PlainPointBert(groups)
    figures: dict[str, dict[str, float]] = {}
    for name, model in models.items():
        figures[name] = {
            "parameters": float(sum(p.numel() for p in model.parameters())),
            **_latency(model, 1, repeats, clock),
            **_latency(model, 64, max(3, repeats // 10), clock),
            "train_samples_per_s": _training(model, max(3, repeats // 10), clock),
        }
    scaling = {
        f"{points} points, {num} groups": _scaling(groups, points, num, repeats, clock)
        for points, num in scales
    }
    _show(preset, figures, scaling)
    if json_path is not None:
        threads = torch.get_num_threads()
        report = {"preset": preset, "threads": threads, "encoders": figures, "scaling": scaling}
        json_path.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")


def clouds(count: int, num_points: int = 1024) -> Tensor:
    """Scaled points of smooth bumps in lattice order, shape (count, num_points, 3)."""
    side = round(num_points**0.5)
    if side * side != num_points:
        raise TouchError(f"clouds to time need a square number of points, got {num_points}")
    sensor = SENSORS["gelsight_mini"]
    aspect = sensor.height_mm / sensor.width_mm
    rng = torch.Generator().manual_seed(0)
    steps = (torch.arange(side) + 0.5) / side * 2 - 1
    x, y = steps.repeat(side), -aspect * steps.repeat_interleave(side)
    centre = torch.rand(count, 2, generator=rng) - 0.5
    squared = (x - centre[:, :1]) ** 2 + (y - centre[:, 1:]) ** 2
    return torch.stack(
        [x.expand(count, -1), y.expand(count, -1), 0.4 * (-8 * squared).exp()], dim=-1
    )


@torch.inference_mode()
def _latency(
    model: nn.Module, batch: int, repeats: int, clock: Callable[[], float]
) -> dict[str, float]:
    model.eval()
    points = clouds(batch, _points_of(model))
    p50, p99 = np.percentile(_times_ms(model, points, repeats, clock), [50, 99])
    return {f"batch_{batch}_p50_ms": float(p50), f"batch_{batch}_p99_ms": float(p99)}


def _times_ms(
    model: nn.Module, points: Tensor, repeats: int, clock: Callable[[], float]
) -> list[float]:
    times = []
    for number in range(WARM_UP + repeats):
        began = clock()
        model(points)
        if number >= WARM_UP:
            times.append(1e3 * (clock() - began))
    return times


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
    figures = {}
    for name, model in (("ours", TactileEncoder(sized)), ("plain", PlainPointBert(sized))):
        model.eval()
        times = _times_ms(model, clouds(1, points), max(3, repeats // 10), clock)
        figures[f"{name}_ms"] = float(np.median(times))
    return figures


def _show(preset: str, encoders: Mapping[str, Figures], scaling: Mapping[str, Figures]) -> None:
    console = Console()
    console = console if console.is_terminal else Console(width=140)
    table = Table(title=f"encoders at the size of {preset}, {torch.get_num_threads()} threads")
    columns = list(next(iter(encoders.values())))
    for column in ("", *columns):
        table.add_column(column.replace("_", " "), justify="right" if column else "left")
    for name, figures in encoders.items():
        table.add_row(name, *(_number(figures[column]) for column in columns))
    console.print(table)
    table = Table(title="one cloud, fps: median ms")
    for column in ("", "ours ms", "plain ms"):
        table.add_column(column, justify="right" if column else "left")
    for name, figures in scaling.items():
        table.add_row(name, *(f"{value:.2f}" for value in figures.values()))
    console.print(table)


def _number(value: float) -> str:
    return f"{value:,.0f}" if value >= 1000 else f"{value:.3g}"
