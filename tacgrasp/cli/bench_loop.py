"""``tacgrasp bench strawberry|missed|latency|rigs|drivers|faults``: the loop, and the rigs under it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import writable


@dataclass(frozen=True)
class StrawberryBenchFlags:
    """Grasp many simulated strawberries with each policy, and count how the grasps end.

    Attributes:
        episodes: Number of strawberries, one random seed each.
        first_seed: First seed. Seeds from 1000000 on are kept for this benchmark.
        policies: Names of the policies, separated by commas.
        weights: Folder of llm's weights. Default: TACGRASP_WEIGHTS, else the shipped weights.
        json: File to write the figures to.
    """

    episodes: int = 200
    first_seed: int = 1_000_000
    policies: str = "rules,fixed_force,random,oracle"
    weights: Path | None = None
    json: Path | None = None


def strawberry(flags: StrawberryBenchFlags) -> None:
    """Run the strawberry benchmark."""
    if flags.episodes < 1 or flags.first_seed < 0:
        raise UsageError("--episodes must be at least 1 and --first-seed at least 0")
    from tacgrasp.benchmarks.loop import strawberry as benchmark
    from tacgrasp.config.layers import load

    config, _ = load("strawberry")
    benchmark.run(
        config.model_copy(update={"weights": flags.weights}),
        episodes=flags.episodes,
        first_seed=flags.first_seed,
        policies=tuple(name.strip() for name in flags.policies.split(",")),
        json_path=writable(flags.json),
    )


@dataclass(frozen=True)
class MissedBenchFlags:
    """Close the fingers beside the berry, and count what follows; exit code 1 off the targets.

    As many ordinary episodes of the same seeds show how often a berry that is touched is reset.

    Attributes:
        episodes: Number of missed and of ordinary episodes, one random seed each.
        first_seed: First seed. Seeds from 1000000 on are kept for benchmarks.
        policies: Names of the policies, separated by commas.
        weights: Folder of llm's weights. Default: TACGRASP_WEIGHTS, else the shipped weights.
        json: File to write the figures to.
    """

    episodes: int = 200
    first_seed: int = 1_000_000
    policies: str = "llm,rules"
    weights: Path | None = None
    json: Path | None = None


def missed(flags: MissedBenchFlags) -> bool:
    """Run the benchmark of missed grasps."""
    if flags.episodes < 1 or flags.first_seed < 0:
        raise UsageError("--episodes must be at least 1 and --first-seed at least 0")
    from tacgrasp.benchmarks.loop import missed as benchmark

    return benchmark.run(
        flags.weights,
        episodes=flags.episodes,
        first_seed=flags.first_seed,
        policies=tuple(name.strip() for name in flags.policies.split(",")),
        json_path=writable(flags.json),
    )


@dataclass(frozen=True)
class LatencyBenchFlags:
    """Time one step of a policy, stage by stage: from the cloud to the complete decision.

    Attributes:
        ticks: Number of steps to time.
        policy: Policy to time. For llm, the arithmetic floor and plain decoding are timed too.
        task: Task whose goal and instruction the policy is given.
        weights: Folder of llm's weights. Default: TACGRASP_WEIGHTS, else the shipped weights.
        json: File to write the figures to.
    """

    ticks: int = 200
    policy: Annotated[str, tyro.conf.arg(aliases=["--policies"])] = "rules"
    task: str = "strawberry"
    weights: Path | None = None
    json: Path | None = None


def latency(flags: LatencyBenchFlags) -> None:
    """Run the latency benchmark."""
    from tacgrasp.benchmarks.learning import latency as benchmark

    benchmark.run(
        ticks=flags.ticks,
        policy_name=flags.policy,
        task=flags.task,
        weights=flags.weights,
        json_path=writable(flags.json),
    )


MIN_AGREEMENT = 0.96
"""Fraction of the seeds that must come to the same end and truth on both rigs."""


@dataclass(frozen=True)
class RigsBenchFlags:
    """Run the same seeds on the simulated and the emulated rig; exit code 1 if too few agree.

    Attributes:
        seeds: Number of seeds.
        first_seed: First seed.
        policy: Policy that decides: rules or llm.
        parallel: Number of emulated rigs that run side by side.
        weights: Folder of llm's weights. Default: TACGRASP_WEIGHTS, else the shipped weights.
        json: File to write the ends of all episodes to.
    """

    seeds: int = 50
    first_seed: int = 0
    policy: str = "rules"
    parallel: int = 2
    weights: Path | None = None
    json: Path | None = None


def rigs(flags: RigsBenchFlags) -> bool:
    """Run the comparison of rigs."""
    if min(flags.seeds, flags.parallel) < 1 or flags.first_seed < 0:
        raise UsageError("--seeds and --parallel must be at least 1 and --first-seed at least 0")
    from tacgrasp.benchmarks.loop import rigs as benchmark

    pairs = benchmark.run(
        seeds=flags.seeds,
        first_seed=flags.first_seed,
        policy=flags.policy,
        parallel=flags.parallel,
        weights=flags.weights,
        json_path=writable(flags.json),
    )
    return sum(pair.agree for pair in pairs) >= MIN_AGREEMENT * len(pairs)


@dataclass(frozen=True)
class DriversBenchFlags:
    """Time the drivers on the emulated rig: period of supervision, delay of commands and readings.

    Attributes:
        minutes: Duration of the measurement [min].
        json: File to write the figures to.
    """

    minutes: float = 10.0
    json: Path | None = None


def drivers(flags: DriversBenchFlags) -> None:
    """Run the benchmark of the drivers."""
    if not 0.01 <= flags.minutes <= 600:
        raise UsageError(f"--minutes must be 0.01 to 600, got {flags.minutes:g}")
    from tacgrasp.benchmarks.loop import drivers as benchmark

    benchmark.run(minutes=flags.minutes, json_path=writable(flags.json))


@dataclass(frozen=True)
class FaultsBenchFlags:
    """Inject each fault into the emulated rig; exit code 1 if one is not dealt with as it must be.

    Attributes:
        repeats: Number of injections of each fault.
        only: Part of the names of the faults to inject. Default: all faults.
        json: File to write the figures to.
        markdown: File to write the table to, in the form of docs/faults.md.
    """

    repeats: int = 20
    only: str = ""
    json: Path | None = None
    markdown: Path | None = None


def faults(flags: FaultsBenchFlags) -> bool:
    """Run the injection of faults."""
    from tacgrasp.benchmarks.faults.cases import CASES

    cases = [case for case in CASES if flags.only.lower() in case.name.lower()]
    if flags.repeats < 1 or not cases:
        raise UsageError(
            f"--repeats must be at least 1 and --only a part of a fault's name "
            f"({'; '.join(case.name for case in CASES)}), got {flags.repeats} and {flags.only!r}"
        )
    from tacgrasp.benchmarks.faults import run as benchmark

    return benchmark.run(
        cases,
        repeats=flags.repeats,
        json_path=writable(flags.json),
        markdown_path=writable(flags.markdown),
    )
