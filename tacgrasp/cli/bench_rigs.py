"""``tacgrasp bench faults|drivers|rigs``: the drivers, measured on the emulated rig."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, writable


@dataclass(frozen=True)
class Faults:
    """Inject every fault into the emulated rig; 1 when one is not dealt with as it must be.

    Attributes:
        repeats: How often each.
        only: Part of the names of those to inject; all when not given.
        json: File for the figures.
        markdown: File for the table, like docs/faults.md.
    """

    repeats: int = 20
    only: str = ""
    json: Path | None = None
    markdown: Path | None = None


def faults(argv: Sequence[str]) -> bool:
    """Inject every fault and see what comes of it."""
    flags = parse(Faults, argv, prog="tacgrasp bench faults")
    from tacgrasp.benchmarks.faults.cases import CASES

    chosen = [case for case in CASES if flags.only.lower() in case.name.lower()]
    if flags.repeats < 1 or not chosen:
        raise UsageError(
            f"--repeats must be at least 1 and --only a part of a fault's name "
            f"({'; '.join(case.name for case in CASES)}), got {flags.repeats} and {flags.only!r}"
        )
    from tacgrasp.benchmarks.faults import run as run_faults

    return run_faults.run(
        chosen,
        repeats=flags.repeats,
        json_path=writable(flags.json),
        markdown_path=writable(flags.markdown),
    )


@dataclass(frozen=True)
class Drivers:
    """Measure supervision and commands on the emulated rig.

    Attributes:
        minutes: How long.
        json: File for the figures.
    """

    minutes: float = 10.0
    json: Path | None = None


def drivers(argv: Sequence[str]) -> None:
    """Measure how regular supervision is, and how soon commands take effect."""
    flags = parse(Drivers, argv, prog="tacgrasp bench drivers")
    if not 0.01 <= flags.minutes <= 600:
        raise UsageError(f"--minutes must be 0.01 to 600, got {flags.minutes:g}")
    from tacgrasp.benchmarks.loop import drivers as bench_drivers

    bench_drivers.run(minutes=flags.minutes, json_path=writable(flags.json))


@dataclass(frozen=True)
class Rigs:
    """Run the same seeds on the simulated and on the emulated rig; 1 when too few agree.

    Attributes:
        seeds: How many.
        first_seed: The first one.
        policy: Who decides: rules or llm.
        parallel: Emulated rigs side by side.
        weights: Folder of llm's weights; without it TACGRASP_WEIGHTS, else those that come along.
        json: File for the ends.
    """

    seeds: int = 50
    first_seed: int = 0
    policy: str = "rules"
    parallel: int = 2
    weights: Path | None = None
    json: Path | None = None


AGREE_SHARE = 0.96
"""Share of the seeds that must come to the same end and truth on both rigs."""


def rigs(argv: Sequence[str]) -> bool:
    """Compare the emulated rig with the simulated one, seed by seed."""
    flags = parse(Rigs, argv, prog="tacgrasp bench rigs")
    if min(flags.seeds, flags.parallel) < 1 or flags.first_seed < 0:
        raise UsageError("--seeds and --parallel must be at least 1 and --first-seed at least 0")
    from tacgrasp.benchmarks.loop import rigs as bench_rigs

    pairs = bench_rigs.run(
        seeds=flags.seeds,
        first_seed=flags.first_seed,
        policy=flags.policy,
        parallel=flags.parallel,
        weights=flags.weights,
        json_path=writable(flags.json),
    )
    return sum(pair.agree for pair in pairs) >= AGREE_SHARE * len(pairs)
