"""``tacgrasp bench strawberry``: each policy in the same simulated episodes, against the truth.

docs/results.md has the rules, ``contestants`` the policies. Rates have Wilson intervals.
"""

from __future__ import annotations

import math
import time
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from statistics import median
from typing import Any, Protocol

from rich.console import Console

from sim.grasp.bodies import OBJECTS
from sim.grasp.rig import SimRig, Truth, build
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.loop.contestants import (
    NAMES,
    SWEPT,
    Contestant,
    PolicyAndForce,
    enter,
    language_model,
    swept_forces_n,
)
from tacgrasp.benchmarks.results_file import SeedResults, weights_sum
from tacgrasp.benchmarks.settings import StrawberrySettings, names_in
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.console import make_table_console
from tacgrasp.episodes.record import StepRecord
from tacgrasp.policy_factory import default_weights
from tacgrasp.run import run_unrecorded
from tacgrasp.runtime.verify import accelerations

ROUND = 40
"""Seeds between two looks at a sweep: a force that is clearly worse than the best one leaves it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EpisodeResult:
    """End of one episode, with the truth.

    Attributes:
        seed: Random seed of the episode.
        reason: The named end.
        declared: Whether the policy declared success.
        verified_by_touch: Result of the lift; None when nothing was lifted.
        actions: Number of actions after the first grasp.
        truth: The simulator's truth.
        slip_minimum_n: Smallest force that would have held the centred body [N].
        objected: Whether what was felt objected to the contract.
        seconds: Time that the episode took of one core [s].
    """

    seed: int
    reason: str
    declared: bool
    verified_by_touch: bool | None
    actions: int
    truth: Truth
    slip_minimum_n: float
    objected: bool = False
    seconds: float = 0.0

    @property
    def bruised(self) -> bool:
        """Bruised at any time, from the first touch on."""
        return self.truth.bruised or self.truth.bruised_at_start

    @property
    def verified(self) -> bool:
        """Declared, truly held through lift and wait, and not bruised by the policy."""
        return self.declared and self.truth.held and not self.bruised


def run_seed(
    config: RunConfig,
    contestants: Sequence[PolicyAndForce],
    seed: int,
    make: Callable[..., SimRig] = build,
) -> list[EpisodeResult]:
    """Run each contestant in the same episode, without records, on a rig that ``make`` builds."""
    config = config.model_copy(update={"seed": seed, "on_failure": "hold"})  # a release is no drop
    rig = make(config.object, seed, sensor_name=config.sensor)
    slip_minimum = rig.grasp.fingers.slip_minimum_n(accelerations(config.verify))
    return [_run_one(config, contestant, slip_minimum, make) for contestant in contestants]


def _run_one(
    config: RunConfig,
    policy_and_force: PolicyAndForce,
    slip_minimum_n: float,
    make: Callable[..., SimRig],
) -> EpisodeResult:
    entered = enter(config, policy_and_force, slip_minimum_n, make)
    return run_entered(config, entered, slip_minimum_n)


def run_entered(config: RunConfig, entered: Contestant, slip_minimum_n: float) -> EpisodeResult:
    """Run a policy in the episode that it has entered."""
    began_s = time.process_time()
    objections: list[str] = []

    def hear(record: StepRecord) -> None:
        if record.contract is not None:
            objections.append(record.contract.assumed[-1])

    outcome = run_unrecorded(
        entered.rig,
        entered.policy,
        config,
        entered.contract,
        [hear],
        sense=entered.sense,
        bounded=entered.bounded,
        feels=entered.feels,
    )
    return EpisodeResult(
        seed=config.seed,
        reason=outcome.reason.value,
        declared=outcome.declared,
        verified_by_touch=outcome.verified,
        actions=outcome.num_actions,
        truth=entered.rig.truth(),
        slip_minimum_n=slip_minimum_n,
        objected=bool(objections),
        seconds=time.process_time() - began_s,
    )


def wilson(successes: int, trials: int, z: float = 1.96) -> tuple[float, float]:
    """95 % Wilson score interval of a rate (Wilson 1927)."""
    if trials == 0:
        return (0.0, 1.0)
    rate = successes / trials
    centre = (rate + z * z / (2 * trials)) / (1 + z * z / trials)
    half = z * math.sqrt(rate * (1 - rate) / trials + z * z / (4 * trials**2))
    half /= 1 + z * z / trials
    return (max(0.0, centre - half), min(1.0, centre + half))


def summary(results: Sequence[EpisodeResult]) -> dict[str, Any]:
    """Figures of one policy, rates with their 95 % intervals."""
    figures: dict[str, Any] = {"episodes": len(results)}
    events: dict[str, Callable[[EpisodeResult], bool]] = {
        "verified_success": lambda r: r.verified,
        "bruised": lambda r: r.bruised,
        "bruised_at_start": lambda r: r.truth.bruised_at_start,
        "dropped": lambda r: r.truth.dropped,
        "declared": lambda r: r.declared,
        "objected": lambda r: r.objected,
    }
    for name, event in events.items():
        count = sum(event(r) for r in results)
        figures[f"{name}_rate"] = count / len(results)
        figures[f"{name}_interval"] = wilson(count, len(results))
    figures["median_actions"] = median(r.actions for r in results)
    figures["median_peak_force_over_slip_minimum"] = median(
        r.truth.peak_force_n / r.slip_minimum_n for r in results
    )
    figures["median_final_force_over_slip_minimum"] = median(
        r.truth.force_n / r.slip_minimum_n for r in results
    )
    figures["seconds_per_episode"] = median(r.seconds for r in results)
    ends = sorted({r.reason for r in results})
    figures["ends"] = {end: sum(r.reason == end for r in results) for end in ends}
    return figures


class Verified(Protocol):
    """A result that counts as a success or does not."""

    @property
    def verified(self) -> bool:
        """Whether it is one."""


def num_verified(results: Sequence[Verified]) -> int:
    """Number of verified episodes."""
    return sum(result.verified for result in results)


def still_running(
    results: Mapping[PolicyAndForce, Sequence[Verified]], running: Sequence[PolicyAndForce]
) -> list[PolicyAndForce]:
    """Contestants without the forces whose interval ends below that of their sweep's best one.

    Args:
        results: Episodes of each contestant; those in ``running`` have equally many.
        running: Contestants that have come so far.
    """
    bounds = {each: wilson(num_verified(results[each]), len(results[each])) for each in running}
    best_low: dict[str, float] = defaultdict(float)
    for (name, _), (low, _) in bounds.items():
        best_low[name] = max(best_low[name], low)
    return [each for each in running if bounds[each][1] >= best_low[each[0]]]


def run(settings: StrawberrySettings) -> None:
    """Run the benchmark, print its table and write its figures.

    Raises:
        UsageError: An unknown policy, or a file with figures of something else.
    """
    config = _config(settings)
    policies = names_in(settings.policies)
    if any(name not in NAMES for name in policies):
        raise UsageError(
            f"bench needs policies out of {', '.join(NAMES)}; got {', '.join(policies)}"
        )
    if "llm" in policies:
        language_model(config.weights_folder, config.primitives.move_step_mm)  # an error shows here
    contestants: list[PolicyAndForce] = []
    for name in policies:
        forces = swept_forces_n(config) if name in SWEPT else (None,)
        contestants += [(name, force_n) for force_n in forces]
    console, store = make_table_console(), _store(settings, config, policies)
    results: dict[PolicyAndForce, list[EpisodeResult]] = {each: [] for each in contestants}
    running = contestants
    for first in range(0, len(settings.seeds), ROUND):
        function, seeds = partial(run_seed, config, running), settings.seeds[first : first + ROUND]
        by_seed = store.map_seeds(console, "episodes", list[EpisodeResult], function, seeds)
        for i, contestant in enumerate(running):
            results[contestant] += [each[i] for each in by_seed]
        running = still_running(results, running)
    figures: dict[str, Any] = {}
    details: dict[str, list[dict[str, Any]]] = {}
    sweeps: dict[str, dict[str, float]] = {}
    for name in policies:
        by_force = {force_n: each for (n, force_n), each in results.items() if n == name}
        # the best of a sweep has never left it, so that the longest list is among its equals
        best = max(by_force.values(), key=lambda each: (len(each), num_verified(each)))
        figures[name], details[name] = summary(best), [_flat(result) for result in best]
        if name in SWEPT:
            sweeps[name] = {
                f"{f:g}": num_verified(each) / len(each) for f, each in by_force.items()
            }
            figures[name]["sweep_episodes"] = {f"{f:g}": len(each) for f, each in by_force.items()}
    report = {
        "task": config.task,
        "object": config.object,
        "instruction": config.instruction,
        "first_seed": settings.first_seed,
        "episodes": len(settings.seeds),
        "policies": figures,
        "sweeps_n": sweeps,
        "episodes_by_policy": details,
    }
    _print(console, figures, sweeps, len(settings.seeds), settings.first_seed)
    store.write(report)


def _store(settings: StrawberrySettings, config: RunConfig, policies: list[str]) -> SeedResults:
    """The results so far.

    Raises:
        UsageError: The file of ``--json`` holds something that is not gone on with.
    """
    about = {
        "benchmark": "strawberry",
        "task": config.task,
        "object": config.object,
        "instruction": config.instruction,
        "first_seed": settings.first_seed,
        "episodes": len(settings.seeds),
        "policies": policies,
        "round": ROUND,
        "weights": weights_sum(config.weights_folder or default_weights())
        if "llm" in policies
        else None,
    }
    store = SeedResults(path=settings.json, about=about)
    store.read(resume=settings.resume)
    return store


def _config(settings: StrawberrySettings) -> RunConfig:
    """The run that every episode is of.

    Raises:
        UsageError: An unknown task or object, or an instruction that is refused.
    """
    changes = {"weights": settings.weights}
    changes |= {n: v for n in ("object", "instruction") if (v := getattr(settings, n)) is not None}
    config = load(settings.task)[0].model_copy(update=changes)
    if config.object not in OBJECTS:
        raise UsageError(f"--object must be one of {', '.join(OBJECTS)}, got {config.object!r}")
    if reason := contract_of(config).refused:
        raise UsageError(f"--instruction is refused: {reason}")
    return config


def _flat(result: EpisodeResult) -> dict[str, Any]:
    return asdict(result) | {"verified": result.verified, "bruised": result.bruised}


def _print(
    console: Console,
    figures: dict[str, Any],
    sweeps: dict[str, dict[str, float]],
    episodes: int,
    first_seed: int,
) -> None:
    title = f"{episodes} episodes, seeds from {first_seed:,}; 95 % Wilson intervals"
    columns = [
        "policy",
        "verified",
        "bruised",
        "bruised at start",
        "dropped",
        "objected",
        "actions",
    ]
    columns += ["final / slip minimum", "peak / slip minimum", "ends"]
    table = number_table(title, columns, ("policy", "ends"))
    times = ", ".join(f"{name} {row['seconds_per_episode']:.2f} s" for name, row in figures.items())
    table.caption = f"median time of an episode on one core: {times}"
    for name, row in figures.items():

        def rate(event: str, row: dict[str, Any] = row) -> str:
            low, high = row[f"{event}_interval"]
            return f"{100 * row[f'{event}_rate']:.1f} % [{100 * low:.1f}, {100 * high:.1f}]"

        table.add_row(
            name,
            rate("verified_success"),
            rate("bruised"),
            f"{100 * row['bruised_at_start_rate']:.1f} %",
            f"{100 * row['dropped_rate']:.1f} %",
            f"{100 * row['objected_rate']:.1f} %",
            f"{row['median_actions']:g}",
            f"{row['median_final_force_over_slip_minimum']:.1f}",
            f"{row['median_peak_force_over_slip_minimum']:.1f}",
            ", ".join(f"{end} {count}" for end, count in row["ends"].items()),
        )
    console.print(table)
    for name, sweep in sweeps.items():
        counts = figures[name]["sweep_episodes"]
        rates = ", ".join(
            f"{force} N {100 * rate:.0f} %"
            + (f" of {counts[force]}" if counts[force] < episodes else "")
            for force, rate in sweep.items()
        )
        console.print(f"{name} is the best of a sweep (verified): {rates}")
