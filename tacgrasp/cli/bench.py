"""``tacgrasp bench NAME``: measure, print figures, write them as JSON."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from functools import partial
from typing import Any

from tacgrasp.benchmarks import settings
from tacgrasp.cli.flags import run_subcommand, writable

BENCHMARKS: dict[str, tuple[type[settings.BenchmarkSettings], str]] = {
    "strawberry": (settings.StrawberrySettings, "loop.strawberry"),
    "missed": (settings.MissedSettings, "loop.missed"),
    "robustness": (settings.RobustnessSettings, "robustness.run"),
    "verifier": (settings.VerifierSettings, "loop.verifier"),
    "draws": (settings.DrawsSettings, "loop.draws"),
    "reflex": (settings.ReflexSettings, "reflex.run"),
    "limits": (settings.LimitsSettings, "limits.run"),
    "gentle": (settings.GentleSettings, "gentle.run"),
    "gain": (settings.GainSettings, "loop.gain"),
    "meshes": (settings.MeshesSettings, "loop.meshes"),
    "other-sim": (settings.OtherSimSettings, "transfer.other_sim"),
    "soak": (settings.SoakSettings, "loop.soak"),
    "latency": (settings.LatencySettings, "learning.latency"),
    "serve": (settings.ServeSettings, "loop.serving"),
    "rigs": (settings.RigsSettings, "loop.rigs"),
    "drivers": (settings.DriversSettings, "loop.drivers"),
    "faults": (settings.FaultsSettings, "faults.run"),
    "gel": (settings.GelSettings, "sensing.gel"),
    "contact": (settings.ContactSettings, "sensing.contact"),
    "touch": (settings.TouchSettings, "sensing.touch"),
    "growth": (settings.GrowthSettings, "sensing.growth"),
    "noise": (settings.NoiseSettings, "sensing.noise"),
    "balls": (settings.BallsSettings, "balls.heights"),
    "ball-curve": (settings.BallCurveSettings, "balls.curve"),
    "ball-gains": (settings.BallGainsSettings, "balls.gains"),
    "ball-captions": (settings.BallCaptionsSettings, "balls.captions"),
    "encoder": (settings.EncoderSettings, "learning.encoder"),
    "tcl3d": (settings.Tcl3dSettings, "learning.tcl3d"),
}
"""Settings and module of each benchmark; its ``run`` returns False when a limit is not kept."""


def main(argv: Sequence[str]) -> int:
    """Run one benchmark; 0 when what it measured keeps its limits."""
    commands = {name: (kind, partial(_run, module)) for name, (kind, module) in BENCHMARKS.items()}
    return 1 if run_subcommand("bench", argv, commands) is False else 0


def _run(module: str, values: settings.BenchmarkSettings) -> Any:
    writable(values.json)
    for name, ending in {"markdown": ".md", "plot": ".png", "sheet": ".png"}.items():
        writable(getattr(values, name, None), ending, flag=f"--{name}")
    from tacgrasp.console import working

    with working("loading the benchmark"):
        benchmark = importlib.import_module(f"tacgrasp.benchmarks.{module}")
    return benchmark.run(values)
