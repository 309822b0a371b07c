"""Time encoders beside the reference design of the same size, in one run on one machine.

Training: samples a second of forward, backward and step, in 32 bits and in bfloat16 where the
processor computes it. Encoding: milliseconds at batch 1 and 64, and of a sensor's frame to points.
Scaling: with the number of points and of groups, where an encoder takes any number.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
import torch
from rich.console import Console
from torch import Tensor, nn

from cltp.encoder.encoder import PRESETS, EncoderConfig, TactileEncoder
from cltp.errors import TouchError
from cltp.processor import torch_threads
from cltp.tactile.cloud import cloud_of_pixels
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.point_layout import EVEN, PointLayout
from cltp.tactile.sensors import SENSORS
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table, times_ms, write_figures
from tacgrasp.benchmarks.learning.plain_pointbert import PlainPointBert
from tacgrasp.benchmarks.settings import EncoderSettings

WARM_UP = 3
SENSOR = SENSORS["gelsight_mini"]
SCALES = ((256, 64), (1024, 64), (4096, 64), (1024, 32), (1024, 128), (1024, 256))
"""Points and groups of one cloud, one of them varied at a time."""

Figures = Mapping[str, float]


def run(
    settings: EncoderSettings,
    *,
    scales: Sequence[tuple[int, int]] = SCALES,
    clock: Callable[[], float] = time.perf_counter,
) -> None:
    """Measure and print.

    The preset's own tokenizer, ours with groups, and the reference design of the same size.

    Args:
        settings: Preset and number of encodings at batch 1; a tenth of it at batch 64.
        scales: Numbers of points and groups to time as well.
        clock: Time source [s].

    Raises:
        UsageError: An unknown preset, or one that takes images.
    """
    preset, repeats = settings.preset, settings.repeats
    if preset not in PRESETS:
        raise UsageError(f"unknown preset {preset!r}; known: {', '.join(PRESETS)}")
    config = PRESETS[preset]
    if config.variant.takes_images:
        raise UsageError(f"preset {preset!r} takes images; the reference design takes points")
    of_grids = {"bearing": 0, "grades": 0, "pressure": 0, "curves": 0}
    groups = dataclasses.replace(config, tokenizer="fps", num_groups=64, **of_grids)
    models: dict[str, nn.Module] = {f"ours, {config.tokenizer}": TactileEncoder(config)}
    models["ours, fps"] = TactileEncoder(groups)
    models["plain PointBERT"] = PlainPointBert(groups)
    few = max(3, repeats // 10)
    with torch_threads(settings.threads):
        figures = {
            name: {
                "parameters": float(sum(p.numel() for p in model.parameters())),
                **_latency(model, 1, repeats, clock),
                **_latency(model, 64, few, clock),
                "train_samples_per_s": _training(model, few, clock),
                "train_bf16_samples_per_s": _training(model, few, clock, autocast=True),
                "input_p50_ms": _input_ms(_layout_of(model), few, clock),
            }
            for name, model in models.items()
        }
        scaling = {
            f"{points} points, {num} groups": _scaling(groups, points, num, few, clock)
            for points, num in scales
        }
    _show(settings, figures, scaling)
    report = {"preset": preset, "threads": settings.threads}
    write_figures(settings.json, report | {"encoders": figures, "scaling": scaling})


def clouds(count: int, layout: PointLayout = EVEN) -> Tensor:
    """Scaled points of smooth bumps in the order of a layout, shape (count, N, 3)."""
    aspect = SENSOR.height_mm / SENSOR.width_mm
    rng = torch.Generator().manual_seed(0)
    across = (torch.arange(layout.columns) + 0.5) / layout.columns * 2 - 1
    down = (torch.arange(layout.rows) + 0.5) / layout.rows * 2 - 1
    x, y = across.repeat(layout.rows), -aspect * down.repeat_interleave(layout.columns)
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
    points = clouds(batch, _layout_of(model))
    times = times_ms(lambda: model(points), repeats, warm_up=WARM_UP, clock=clock)
    p50, p99 = np.percentile(times, [50, 99])
    return {f"batch_{batch}_p50_ms": float(p50), f"batch_{batch}_p99_ms": float(p99)}


def _layout_of(model: nn.Module) -> PointLayout:
    return model.config.variant.layout if isinstance(model, TactileEncoder) else EVEN


def _input_ms(layout: PointLayout, repeats: int, clock: Callable[[], float]) -> float:
    """Median time from a frame of the sensor to an encoder's points [ms]."""
    heights = np.zeros((SENSOR.rows, SENSOR.columns), np.float32)
    cloud = cloud_of_pixels(heights, SENSOR)
    times = times_ms(lambda: encoder_input(cloud, layout), repeats, warm_up=WARM_UP, clock=clock)
    return float(np.median(times))


def _training(
    model: nn.Module,
    steps: int,
    clock: Callable[[], float],
    batch: int = 32,
    *,
    autocast: bool = False,
) -> float:
    model.train()
    points = clouds(batch, _layout_of(model))
    optimiser = torch.optim.AdamW(model.parameters(), lr=1e-4)
    began = clock()
    for number in range(1 + steps):
        if number == 1:
            began = clock()
        with torch.autocast("cpu", torch.bfloat16, enabled=autocast):
            out = model(points)
        feature = (out if isinstance(out, Tensor) else out.feature).float()
        optimiser.zero_grad()
        feature.square().mean().backward()
        optimiser.step()
    return steps * batch / (clock() - began)


@torch.inference_mode()
def _scaling(
    config: EncoderConfig, points: int, groups: int, repeats: int, clock: Callable[[], float]
) -> dict[str, float]:
    sized = dataclasses.replace(config, num_groups=groups)
    side = round(points**0.5)
    if side * side != points:
        raise TouchError(f"clouds to time need a square number of points, got {points}")
    figures, cloud = {}, clouds(1, PointLayout(rows=side, columns=side, is_sampled=True))
    for name, model in (("ours", TactileEncoder(sized)), ("plain", PlainPointBert(sized))):
        encode = partial(model.eval(), cloud)
        times = times_ms(encode, repeats, warm_up=WARM_UP, clock=clock)
        figures[f"{name}_ms"] = float(np.median(times))
    return figures


def _show(
    settings: EncoderSettings, encoders: Mapping[str, Figures], scaling: Mapping[str, Figures]
) -> None:
    console = Console()
    console = console if console.is_terminal else Console(width=140)
    title = f"encoders at the size of {settings.preset}, {settings.threads} threads"
    columns = list(next(iter(encoders.values())))
    table = number_table(title, ["", *(column.replace("_", " ") for column in columns)])
    for name, figures in encoders.items():
        values = [figures[column] for column in columns]
        table.add_row(name, *(f"{v:,.0f}" if v >= 1000 else f"{v:.3g}" for v in values))
    console.print(table)
    table = number_table("one cloud, fps: median ms", ("", "ours ms", "plain ms"))
    for name, figures in scaling.items():
        table.add_row(name, *(f"{value:.2f}" for value in figures.values()))
    console.print(table)
