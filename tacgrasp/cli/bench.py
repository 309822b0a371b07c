"""``tacgrasp bench NAME``: measure, print figures, write them as JSON."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from tacgrasp.cli import bench_learning, bench_loop, bench_sensing
from tacgrasp.cli.flags import run_subcommand

BENCHMARKS: dict[str, tuple[type[Any], Callable[[Any], bool | None]]] = {
    "strawberry": (bench_loop.StrawberryBenchFlags, bench_loop.strawberry),
    "missed": (bench_loop.MissedBenchFlags, bench_loop.missed),
    "latency": (bench_loop.LatencyBenchFlags, bench_loop.latency),
    "rigs": (bench_loop.RigsBenchFlags, bench_loop.rigs),
    "drivers": (bench_loop.DriversBenchFlags, bench_loop.drivers),
    "faults": (bench_loop.FaultsBenchFlags, bench_loop.faults),
    "gel": (bench_sensing.GelBenchFlags, bench_sensing.gel),
    "contact": (bench_sensing.ContactBenchFlags, bench_sensing.contact),
    "touch": (bench_sensing.TouchBenchFlags, bench_sensing.touch),
    "balls": (bench_sensing.BallsBenchFlags, bench_sensing.balls),
    "ball-captions": (bench_sensing.BallCaptionsBenchFlags, bench_sensing.ball_captions),
    "encoder": (bench_learning.EncoderBenchFlags, bench_learning.encoder),
    "tcl3d": (bench_learning.Tcl3dBenchFlags, bench_learning.tcl3d),
}
"""Flags and function of each benchmark; the function returns False when a limit is not kept."""


def main(argv: Sequence[str]) -> int:
    """Run one benchmark; 0 when what it measured keeps its limits."""
    return 1 if run_subcommand("bench", argv, BENCHMARKS) is False else 0
