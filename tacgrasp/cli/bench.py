"""``tacgrasp bench NAME``: measure, print figures, write JSON."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli import bench_encoders, bench_rigs
from tacgrasp.cli.flags import parse, subcommand, writable


@dataclass(frozen=True)
class Strawberry:
    """Grasp many drawn strawberries with every policy.

    Attributes:
        episodes: How many seeds.
        first_seed: The first one; from 1000000 on they belong to the benchmark.
        policies: Names, separated by commas.
        weights: Folder of llm's weights; without it TACGRASP_WEIGHTS, else those that come along.
        json: File for the figures.
    """

    episodes: int = 200
    first_seed: int = 1_000_000
    policies: str = "rules,fixed_force,random,oracle"
    weights: Path | None = None
    json: Path | None = None


@dataclass(frozen=True)
class Latency:
    """Time every stage of a tick, and the whole: cloud in, complete decision out.

    Attributes:
        ticks: How many.
        policy: Which policy; for llm also its floors and the naive way.
        task: Whose goal and instruction.
        weights: Folder of llm's weights; without it TACGRASP_WEIGHTS, else those that come along.
        json: File for the figures.
    """

    ticks: int = 200
    policy: Annotated[str, tyro.conf.arg(aliases=["--policies"])] = "rules"
    task: str = "strawberry"
    weights: Path | None = None
    json: Path | None = None


@dataclass(frozen=True)
class Gel:
    """Compare the gel with closed forms and real presses.

    Attributes:
        json: File for the figures.
    """

    json: Path | None = None


@dataclass(frozen=True)
class Tcl3d:
    """Time contacts of the data set at a sensor's own resolution, from object to caption.

    Attributes:
        series: How many series of four contacts.
        workers: Processes of one thread each.
        device: Where rays are cast and contacts are solved: cpu, cuda.
        tacto: A Python in which TACTO is installed, to time its renderer in the same run.
        json: File for the figures.
    """

    series: int = 60
    workers: int = 2
    device: str = "cpu"
    tacto: Path | None = None
    json: Path | None = None


@dataclass(frozen=True)
class Touch:
    """Compare the direct measurement of contacts with the truth of simulated grasps.

    Attributes:
        bodies: How many of every kind; four grasps each.
        json: File for the figures.
    """

    bodies: int = 60
    json: Path | None = None


@dataclass(frozen=True)
class Balls:
    """Measure the heights of real GelSight Mini frames on presses of a ball of known diameter.

    Attributes:
        dir: Folder with the frames.
        diameter_mm: Of the ball [mm].
        background: The untouched gel; background.png in the folder when not given.
        folds: How many calibrations, each without its share of the presses; 44 takes minutes.
        bare_sphere: Calibrate without profiles of the gel, for comparison.
        json: File for the figures.
    """

    dir: Path | None = None
    diameter_mm: float = 6.31
    background: Path | None = None
    folds: int = 11
    bare_sphere: bool = False
    json: Path | None = None


@dataclass(frozen=True)
class BallCaptions:
    """Print what the model says of real GelSight Mini frames that show a known ball.

    Attributes:
        dir: Folder with the frames.
        weights: Folder of weights; without it TACGRASP_WEIGHTS, else those that come along.
        diameter_mm: Of the ball [mm].
        background: The untouched gel; background.png in the folder when not given.
        calibration: Of the unit; without it the one that comes along, made from the default frames.
        folds: Calibrate so often, each time without its share of the presses; 0 does not.
        json: File for the figures.
    """

    dir: Path | None = None
    weights: Path | None = None
    diameter_mm: float = 6.31
    background: Path | None = None
    calibration: Path | None = None
    folds: int = 0
    json: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Dispatch to the benchmarks; 0 when what was measured is as it must be."""
    benches: dict[str, Callable[[Sequence[str]], bool | None]] = {
        "strawberry": _strawberry,
        "latency": _latency,
        "gel": _gel,
        "tcl3d": _tcl3d,
        "touch": _touch,
        "balls": _balls,
        "ball-captions": _ball_captions,
        "faults": bench_rigs.faults,
        "drivers": bench_rigs.drivers,
        "encoder": bench_encoders.encoder,
        "rigs": bench_rigs.rigs,
    }
    name, rest = subcommand("bench", argv, {n: b.__doc__ or "" for n, b in benches.items()})
    if name is not None:
        return 1 if benches[name](rest) is False else 0
    return 0


def _strawberry(argv: Sequence[str]) -> None:
    """Grasp many drawn strawberries with every policy."""
    flags = parse(Strawberry, argv, prog="tacgrasp bench strawberry")
    if flags.episodes < 1 or flags.first_seed < 0:
        raise UsageError("--episodes must be at least 1 and --first-seed at least 0")
    from tacgrasp.benchmarks.loop import strawberry as bench_strawberry
    from tacgrasp.config.layers import load

    config, _ = load("strawberry")
    bench_strawberry.run(
        config.model_copy(update={"weights": flags.weights}),
        episodes=flags.episodes,
        first_seed=flags.first_seed,
        policies=tuple(name.strip() for name in flags.policies.split(",")),
        json_path=writable(flags.json),
    )


def _latency(argv: Sequence[str]) -> None:
    """Time every stage of a tick, and the whole."""
    flags = parse(Latency, argv, prog="tacgrasp bench latency")
    from tacgrasp.benchmarks.learning import latency as bench_latency

    bench_latency.run(
        ticks=flags.ticks,
        policy_name=flags.policy,
        task=flags.task,
        weights=flags.weights,
        json_path=writable(flags.json),
    )


def _gel(argv: Sequence[str]) -> None:
    """Compare the gel with closed forms and real presses."""
    flags = parse(Gel, argv, prog="tacgrasp bench gel")
    from tacgrasp.benchmarks.sensing import gel as bench_gel

    bench_gel.run(writable(flags.json))


def _tcl3d(argv: Sequence[str]) -> bool:
    """Time contacts of the data set at a sensor's own resolution."""
    flags = parse(Tcl3d, argv, prog="tacgrasp bench tcl3d")
    if flags.workers < 1 or flags.series < 2 * flags.workers:
        raise UsageError("--workers must be at least 1 and --series at least twice as many")
    from tacgrasp.benchmarks.learning import tcl3d as bench_tcl3d

    return bench_tcl3d.run(
        series=flags.series,
        workers=flags.workers,
        device=flags.device,
        tacto=flags.tacto,
        json_path=writable(flags.json),
    )


def _touch(argv: Sequence[str]) -> None:
    """Compare the direct measurement of contacts with the truth of simulated grasps."""
    flags = parse(Touch, argv, prog="tacgrasp bench touch")
    if flags.bodies < 1:
        raise UsageError("--bodies must be at least 1")
    from tacgrasp.benchmarks.sensing import touch as bench_touch

    bench_touch.run(flags.bodies, writable(flags.json))


def _balls(argv: Sequence[str]) -> bool:
    """Measure the heights of real frames on presses of a ball."""
    flags = parse(Balls, argv, prog="tacgrasp bench balls")
    if not 1.0 <= flags.diameter_mm <= 100.0 or flags.folds < 2:
        raise UsageError("--diameter-mm must be 1 to 100 and --folds at least 2")
    from tacgrasp.benchmarks.sensing import balls as bench_balls

    return bench_balls.run(
        flags.dir or bench_balls.FOLDER,
        diameter_mm=flags.diameter_mm,
        background=flags.background,
        folds=flags.folds,
        bare_sphere=flags.bare_sphere,
        json_path=writable(flags.json),
    )


def _ball_captions(argv: Sequence[str]) -> None:
    """Print what the model says of real frames that show a ball."""
    flags = parse(BallCaptions, argv, prog="tacgrasp bench ball-captions")
    if not 1.0 <= flags.diameter_mm <= 100.0 or flags.folds < 0 or flags.folds == 1:
        raise UsageError("--diameter-mm must be 1 to 100 and --folds 0 or at least 2")
    if flags.folds and flags.calibration is not None:
        raise UsageError("--folds makes its own calibrations: give either it or --calibration")
    from tacgrasp.benchmarks.sensing import ball_captions as bench_ball_captions
    from tacgrasp.benchmarks.sensing import balls as bench_balls
    from tacgrasp.policy_factory import default_weights

    bench_ball_captions.run(
        flags.dir or bench_balls.FOLDER,
        weights=flags.weights or default_weights(),
        diameter_mm=flags.diameter_mm,
        background=flags.background,
        calibration=flags.calibration,
        folds=flags.folds,
        json_path=writable(flags.json),
    )
