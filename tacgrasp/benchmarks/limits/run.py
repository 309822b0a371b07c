"""``tacgrasp bench limits``: the table and the file of figures (see docs/contract.md)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from typing import Any

from rich.console import Console

from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.limits.draw import FaultKind
from tacgrasp.benchmarks.limits.episode import LimitsResult, Subject, config_of, run_seed
from tacgrasp.benchmarks.loop.contestants import language_model
from tacgrasp.benchmarks.loop.strawberry import wilson
from tacgrasp.benchmarks.results_file import SeedResults, shear_models_sum, weights_sum
from tacgrasp.benchmarks.settings import LimitsSettings
from tacgrasp.console import make_table_console
from tacgrasp.policy_factory import default_weights
from tacgrasp.rig.factory import check_names

POLICIES = ("rules", "llm")
"""Policies that feel, and have no memory from one episode to the next."""

LEAST_VERIFIED = 0.9
"""Least part of the survivable faults that must end verified."""


def run(settings: LimitsSettings) -> bool:
    """Run the benchmark, print its table and write its figures.

    Returns:
        Whether no limit was exceeded, none hung or broke, and enough ended verified.

    Raises:
        UsageError: An unknown policy or task, or a file with figures of something else.
        TouchError: An unknown sensor, or the language model's weights can't be used.
    """
    if settings.policy not in POLICIES:
        raise UsageError(
            f"bench limits needs a policy out of {', '.join(POLICIES)}, got {settings.policy!r}"
        )
    subject = Subject(
        task=settings.task,
        sensor=settings.sensor,
        policy=settings.policy,
        weights=settings.weights,
        keep=settings.failing_folder,
    )
    config = config_of(subject, settings.first_seed)
    check_names(config)
    weights = None
    if settings.policy == "llm":
        language_model(config.weights_folder, config.primitives.move_step_mm)  # an error shows here
        weights = weights_sum(config.weights_folder or default_weights())
    about = {
        "benchmark": "limits",
        "task": settings.task,
        "sensor": settings.sensor,
        "policy": settings.policy,
        "first_seed": settings.first_seed,
        "weights": weights,
        "shear_models": shear_models_sum(),
    }
    console, store = make_table_console(), SeedResults(path=settings.json, about=about)
    store.read(resume=settings.resume)
    results = store.map_seeds(
        console, "episodes", LimitsResult, partial(run_seed, subject), settings.seeds
    )
    figures = summary(results)
    by_kind = {
        kind.value: summary([each for each in results if each.kind == kind])
        for kind in FaultKind
        if any(each.kind == kind for each in results)
    }
    report = {
        **{name: about[name] for name in ("task", "sensor", "policy", "first_seed")},
        **figures,
        "failing_seeds": [each.seed for each in results if each.failed],
        "failing_episodes": {str(each.seed): each.path for each in results if each.failed},
        "by_kind": by_kind,
        "results_by_seed": [asdict(each) for each in results],
    }
    _print(console, settings, figures, by_kind)
    for each in results:
        if each.failed:
            console.print(_failure(each), markup=False, highlight=False, soft_wrap=True)
    store.write(report)
    return keeps_limits(figures)


def summary(results: Sequence[LimitsResult]) -> dict[str, Any]:
    """Figures of some episodes; rates with their 95 % intervals, None without a survivable fault.

    ``rival_exceeded`` counts the same episodes without contract and reflex.
    """
    survivable = [each for each in results if each.survivable]
    num_verified = sum(each.verified for each in survivable)
    num_exceeded = sum(bool(each.exceeded) for each in results)
    ends = [each.end or "broken off" for each in results]
    return {
        "episodes": len(results),
        "faults_that_came": sum(each.came for each in results),
        "exceeded": num_exceeded,
        "exceeded_interval": wilson(num_exceeded, len(results)),
        "hung": sum(bool(each.hung) for each in results),
        "broke": sum(bool(each.broke) for each in results),
        "survivable": len(survivable),
        "verified_rate": num_verified / len(survivable) if survivable else None,
        "verified_interval": wilson(num_verified, len(survivable)),
        "longest_over_ms": max((each.over_ms for each in results), default=0.0),
        "longest_simulated_s": max((each.simulated_s for each in results), default=0.0),
        "most_calls": max((each.calls for each in results), default=0),
        "ends": {end: ends.count(end) for end in sorted(set(ends))},
        "rival_exceeded": sum(bool(each.rival_exceeded) for each in results),
        "rival_verified_rate": sum(each.rival_verified for each in survivable) / len(survivable)
        if survivable
        else None,
    }


def keeps_limits(figures: dict[str, Any]) -> bool:
    """Whether figures show no exceeded limit, no hang, and enough verified grasps."""
    rate = figures["verified_rate"]
    is_clean = not (figures["exceeded"] or figures["hung"] or figures["broke"])
    return is_clean and (rate is None or rate >= LEAST_VERIFIED)


def _failure(result: LimitsResult) -> str:
    """A failing episode in one line, with the file that it is kept in."""
    what = result.exceeded or result.hung or result.broke
    what = what or f"survivable, but not verified: {result.end}, {result.message}"
    kept = result.path or "no file: it broke before its record began"
    return f"seed {result.seed}: {result.fault}; {what}; {kept}"


def _print(
    console: Console,
    settings: LimitsSettings,
    figures: dict[str, Any],
    by_kind: dict[str, dict[str, Any]],
) -> None:
    title = (
        f"{figures['episodes']} episodes of {settings.policy} with {settings.sensor}, seeds from "
        f"{settings.first_seed:,}; 95 % Wilson intervals"
    )
    columns = ["fault", "episodes", "came", "exceeded", "hung or broke", "survivable"]
    columns += ["of these verified", "exceeded unguarded", "ends"]
    table = number_table(title, columns, ("fault", "ends"))
    for name, row in by_kind.items():
        table.add_row(name, *_cells(row))
    table.add_section()
    table.add_row("all", *_cells(figures))
    table.caption = (
        f"longest episode {figures['longest_simulated_s']:.0f} s of simulated time, "
        f"{figures['most_calls']} readings and decisions; longest time above a limit "
        f"{figures['longest_over_ms']:.0f} ms"
    )
    console.print(table)


def _cells(row: dict[str, Any]) -> list[str]:
    low, high = row["verified_interval"]
    rate = row["verified_rate"]
    verified = "-" if rate is None else f"{100 * rate:.1f} % [{100 * low:.1f}, {100 * high:.1f}]"
    numbers = [row["episodes"], row["faults_that_came"], row["exceeded"]]
    numbers += [row["hung"] + row["broke"], row["survivable"]]
    ends = ", ".join(f"{end} {count}" for end, count in row["ends"].items())
    return [*map(str, numbers), verified, str(row["rival_exceeded"]), ends]
