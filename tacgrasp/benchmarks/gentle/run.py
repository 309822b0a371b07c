"""``tacgrasp bench gentle``: the table and the file of figures (see docs/gentle.md)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from statistics import fmean, median
from typing import Any

from rich.console import Console

from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.gentle.arms import ARMS
from tacgrasp.benchmarks.gentle.episode import FruitFacts, GentleResult, draw_fruit, run_seed
from tacgrasp.benchmarks.loop.contestants import PolicyAndForce, language_model, swept_forces_n
from tacgrasp.benchmarks.loop.strawberry import ROUND, num_verified, still_running, wilson
from tacgrasp.benchmarks.results_file import SeedResults, shear_models_sum, weights_sum
from tacgrasp.benchmarks.settings import GentleSettings, names_in
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.console import make_table_console
from tacgrasp.policy_factory import default_weights
from tacgrasp.rig.factory import check_names

TASK = "fruit"

MEANS = ("commanded_mean_n", "measured_mean_n", "measured_max_n")
"""Forces of an episode whose mean over the episodes is a figure."""


def run(settings: GentleSettings) -> None:
    """Run the benchmark, print its table and write its figures.

    Raises:
        UsageError: An unknown arm, or a file with figures of something else.
        TouchError: An unknown sensor, or the language model's weights can't be used.
    """
    names = names_in(settings.arms) if settings.arms else list(ARMS)
    if unknown := [name for name in names if name not in ARMS]:
        raise UsageError(f"no arm is called {unknown[0]!r}; known: {', '.join(ARMS)}")
    changes = {"sensor": settings.sensor, "weights": settings.weights}
    config = load(TASK)[0].model_copy(update=changes)
    check_names(config)
    if any(ARMS[name].policy == "llm" for name in names):
        language_model(config.weights_folder, config.primitives.move_step_mm)  # an error shows here
    about = {
        "benchmark": "gentle",
        "task": TASK,
        "sensor": settings.sensor,
        "first_seed": settings.first_seed,
        "round": ROUND,
        "weights": weights_sum(config.weights_folder or default_weights()),
        "shear_models": shear_models_sum(),
    }
    console, store = make_table_console(), SeedResults(path=settings.json, about=about)
    store.read(resume=settings.resume)
    seeds = settings.seeds
    fruit = store.map_seeds(console, "fruit", FruitFacts, partial(draw_fruit, config), seeds)
    results: dict[str, list[GentleResult]] = {}
    sweeps: dict[str, dict[float, list[GentleResult]]] = {}
    for name in names:
        arm = ARMS[name]
        if arm.is_swept:
            sweeps[name] = run_sweep(store, console, config, name, seeds)
            results[name] = best_of(sweeps[name])
        else:
            function = partial(run_seed, config, arm, (None,))
            each = store.map_seeds(console, name, list[GentleResult], function, seeds)
            results[name] = [result for (result,) in each]
    report = summary(fruit, results) | {
        "task": TASK,
        "sensor": settings.sensor,
        "first_seed": settings.first_seed,
        "episodes": len(seeds),
        "sweeps": {name: _sweep_figures(sweep) for name, sweep in sweeps.items()},
    }
    _print(console, settings, report, results)
    store.write(report)


def run_sweep(
    store: SeedResults, console: Console, config: RunConfig, name: str, seeds: Sequence[int]
) -> dict[float, list[GentleResult]]:
    """Run a swept arm; results of each force. A force that is clearly worse than the best leaves.

    Later rounds follow from earlier ones alone, so that a run that goes on is the same run.
    """
    arm = ARMS[name]
    running: list[PolicyAndForce] = [(name, force_n) for force_n in swept_forces_n(config)]
    results: dict[PolicyAndForce, list[GentleResult]] = {each: [] for each in running}
    for first in range(0, len(seeds), ROUND):
        function = partial(run_seed, config, arm, [force_n for _, force_n in running])
        part = seeds[first : first + ROUND]
        by_seed = store.map_seeds(console, name, list[GentleResult], function, part)
        for i, each in enumerate(running):
            results[each] += [of_seed[i] for of_seed in by_seed]
        running = still_running(results, running)
    return {force_n: each for (_, force_n), each in results.items() if force_n is not None}


def best_of(sweep: Mapping[float, list[GentleResult]]) -> list[GentleResult]:
    """Results of the best force: one that has never left, with the most successes."""
    return max(sweep.values(), key=lambda each: (len(each), num_verified(each)))


def summary(
    fruit: Sequence[FruitFacts], results: Mapping[str, Sequence[GentleResult]]
) -> dict[str, Any]:
    """Figures of the benchmark: of every arm, of the draws, and of the paired prompts."""
    redrawn = sum(each.num_redrawn for each in fruit)
    return {
        "arms": {name: arm_figures(each) for name, each in results.items()},
        "redrawn_share": redrawn / (redrawn + len(fruit)),
        "firm_over_gentle": firm_over_gentle(results.get("gentle", []), results.get("firm", [])),
    }


def arm_figures(results: Sequence[GentleResult]) -> dict[str, Any]:
    """Figures of one arm: rates with their 95 % intervals, forces in N.

    A mean or median is None where no episode has such a force.
    """
    figures: dict[str, Any] = {"n": len(results)}
    counts = {
        "success": num_verified(results),
        "bruised": sum(each.bruised for each in results),
        "dropped": sum(each.dropped for each in results),
    }
    for event, count in counts.items():
        figures[f"{event}_rate"] = count / len(results)
        figures[f"{event}_interval"] = wilson(count, len(results))
    figures["peak_over_minimum_median"] = median(r.peak_n / r.slip_minimum_n for r in results)
    for name in MEANS:
        values = [value for r in results if (value := getattr(r, name)) is not None]
        figures[name] = fmean(values) if values else None
    return figures


def firm_over_gentle(gentle: Sequence[GentleResult], firm: Sequence[GentleResult]) -> float | None:
    """Median over the fruit of the mean measured force, firm over gentle; None without pairs."""
    soft_n = {each.seed: each.measured_mean_n for each in gentle}
    ratios = [
        each.measured_mean_n / soft
        for each in firm
        if each.measured_mean_n is not None and (soft := soft_n.get(each.seed))
    ]
    return median(ratios) if ratios else None


def _sweep_figures(sweep: Mapping[float, Sequence[GentleResult]]) -> dict[str, Any]:
    """The best force [N], and successes and episodes of each force."""
    best = max(sweep, key=lambda force_n: (len(sweep[force_n]), num_verified(sweep[force_n])))
    rates = {f"{f:g}": num_verified(each) / len(each) for f, each in sweep.items()}
    counts = {f"{f:g}": len(each) for f, each in sweep.items()}
    return {"best_n": best, "success_rate": rates, "n": counts}


def _print(
    console: Console,
    settings: GentleSettings,
    report: Mapping[str, Any],
    results: Mapping[str, Sequence[GentleResult]],
) -> None:
    title = (
        f"{report['episodes']} fruit with {settings.sensor}, seeds from {settings.first_seed:,}; "
        "95 % Wilson intervals; forces in N"
    )
    columns = ["arm", "success", "bruised", "dropped", "peak / minimum", "commanded", "measured"]
    columns += ["largest", "s an episode", "ends", "aim"]
    table = number_table(title, columns, ("arm", "ends", "aim"))
    for name, row in report["arms"].items():
        table.add_row(name, *_cells(row), *_ends(results[name]), ARMS[name].aim)
    console.print(table)
    for name, sweep in report["sweeps"].items():
        rates = ", ".join(
            f"{force} N {100 * rate:.0f} % of {sweep['n'][force]}"
            for force, rate in sweep["success_rate"].items()
        )
        line = f"{name} is the best of a sweep, {sweep['best_n']:g} N: {rates}"
        console.print(line, soft_wrap=True, highlight=False)
    line = f"drawn anew because they bruise too soon: {100 * report['redrawn_share']:.1f} %"
    console.print(line, highlight=False)
    if report["firm_over_gentle"] is not None:
        line = f"measured force, firm over gentle, median: {report['firm_over_gentle']:.2f}"
        console.print(line, highlight=False)


def _cells(row: Mapping[str, Any]) -> list[str]:
    low, high = row["success_interval"]
    rates = [f"{100 * row['success_rate']:.1f} % [{100 * low:.1f}, {100 * high:.1f}]"]
    rates += [f"{100 * row[f'{event}_rate']:.1f} %" for event in ("bruised", "dropped")]
    forces = ["-" if row[name] is None else f"{row[name]:.2f}" for name in MEANS]
    return [*rates, f"{row['peak_over_minimum_median']:.2f}", *forces]


def _ends(results: Sequence[GentleResult]) -> tuple[str, str]:
    """Median time of an episode on one core [s], and the named ends with their numbers."""
    reasons = [each.reason for each in results]
    ends = ", ".join(f"{end} {reasons.count(end)}" for end in sorted(set(reasons)))
    return f"{median(each.seconds for each in results):.1f}", ends
