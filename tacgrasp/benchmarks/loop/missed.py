"""``tacgrasp bench missed``: fingers that close beside the berry, under a real sensor's noise.

In each missed episode the berry stands out of the fingers' reach. Nothing may then add force: the
runtime's own reset comes first, and the second closing on nothing ends the episode with
``contact_lost``. As many ordinary episodes show what that costs: how often the runtime says that
nothing touches while the berry is touched.

Two constant answers stand beside the figures: always to reset is perfect in all but the false
resets, and never to reset in nothing but them.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console

from cltp.tactile.cloud import TactileCloud
from policies import Policy
from primitives import Primitive
from sim.grasp.rig import SimRig, build
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.loop.strawberry import wilson
from tacgrasp.benchmarks.results_file import SeedResults, weights_sum
from tacgrasp.benchmarks.settings import MissedSettings, names_in
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.console import make_table_console
from tacgrasp.episodes import StepRecord
from tacgrasp.policy_factory import default_weights, make_policy
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.run import run_unrecorded
from tacgrasp.runtime.outcome import EndReason, Outcome
from tacgrasp.runtime.steps import NO_CONTACT_DECISION

POLICIES = ("llm", "rules")
"""Policies that feel; the others do not decide by touch."""

DISTANCE_MM = (45.0, 60.0)
"""Distance of the berry from the pad's centre, uniform [mm]. From 45 mm on no berry is reached."""

TARGETS = {
    "reset_first_rate": (0.99, 1.0),
    "contact_lost_rate": (0.99, 1.0),
    "force_added_rate": (0.0, 0.0),
    "false_reset_rate": (0.0, 0.01),
}
"""Lowest and highest value of each rate that keeps the limit."""

CONSTANT_POLICIES: dict[str, dict[str, float | None]] = {
    "always resets": dict(zip(TARGETS, (1.0, 1.0, 0.0, 1.0), strict=True)),
    "never resets": dict(zip(TARGETS, (0.0, 0.0, None, 0.0), strict=True)),
}
"""Rates that loops reach which answer the same whatever is felt, by definition."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MissedResult:
    """One policy and seed: a missed and an ordinary episode.

    Attributes:
        seed: Random seed of both episodes.
        offset_mm: Position of the berry on the pad in the missed episode [mm].
        reset_first: The first action of the missed episode was a reset.
        contact_lost: The missed episode ended with ``contact_lost``.
        force_added: A command of it raised the force, or exceeded the limit of the approach, while
            nothing touched.
        false_reset: In the ordinary episode the runtime reset a berry that was touched.
        end: End of the missed episode.
        ordinary_end: End of the ordinary episode.
    """

    seed: int
    offset_mm: tuple[float, float]
    reset_first: bool
    contact_lost: bool
    force_added: bool
    false_reset: bool
    end: str
    ordinary_end: str


class TrueSense(GelSense):
    """Contact by test, with the truth at the time of each test beside it."""

    def __init__(self, rig: SimRig) -> None:
        super().__init__(rig.sensor)
        self._rig = rig
        self._tests: list[tuple[TactileCloud, bool]] = []

    def read(self) -> TactileCloud:
        cloud, patch = super().read(), self._rig.grasp.patch
        self._tests.append((cloud, patch is not None and patch.force_n > 0))
        return cloud

    def was_touched(self, cloud: TactileCloud) -> bool:
        """Whether the body touched the gel when a cloud was first tested."""
        return next(touched for tested, touched in self._tests if tested is cloud)


class Watch:
    """Observer of an episode's steps, with the truth.

    Attributes:
        actions: Executed actions, in order.
        force_added: A command raised the force, or exceeded the limit of the approach, while
            nothing touched.
        false_reset: The runtime said that nothing touches while the body was touched.
    """

    def __init__(self, sense: TrueSense, first_force_n: float) -> None:
        self._sense, self._first_force_n = sense, first_force_n
        self.actions: list[Primitive] = []
        self.force_added = self.false_reset = False

    def __call__(self, record: StepRecord) -> None:
        if record.decision is None:  # verification
            return
        touched = self._sense.was_touched(record.cloud)
        self.false_reset |= record.decision is NO_CONTACT_DECISION and touched
        force_n = record.gripper.force_n  # commanded at the observation: by the first grasp, too
        executed = record.executed
        if executed is not None and executed.primitive is not None:
            self.actions.append(executed.primitive)
            if executed.primitive is not Primitive.RESET:  # which approaches from almost nothing
                self.force_added |= not touched and executed.force_n > force_n + 1e-9
            force_n = max(force_n, executed.force_n)
        self.force_added |= not touched and force_n > self._first_force_n + 1e-9


def missed_offset_mm(seed: int) -> tuple[float, float]:
    """Position of the berry on the pad, out of reach in any direction [mm]."""
    rng = np.random.default_rng([seed, 8])
    angle, distance_mm = rng.uniform(0, 2 * math.pi), rng.uniform(*DISTANCE_MM)
    return distance_mm * math.cos(angle), distance_mm * math.sin(angle)


def run_seed(weights: Path | None, policies: Sequence[str], seed: int) -> list[MissedResult]:
    """Run a missed and an ordinary episode with each policy, without records."""
    config = _config(weights).model_copy(update={"seed": seed})
    results = []
    for name in policies:
        policy = _policy(name, weights)
        offset_mm = missed_offset_mm(seed)
        missed, watch = _run_one(config, policy, offset_mm)
        ordinary, ordinary_watch = _run_one(config, policy, None)
        results.append(
            MissedResult(
                seed=seed,
                offset_mm=offset_mm,
                reset_first=watch.actions[:1] == [Primitive.RESET],
                contact_lost=missed.reason is EndReason.CONTACT_LOST,
                force_added=watch.force_added,
                false_reset=ordinary_watch.false_reset,
                end=missed.reason.value,
                ordinary_end=ordinary.reason.value,
            )
        )
    return results


@lru_cache
def _config(weights: Path | None) -> RunConfig:
    config, _ = load("strawberry")
    return config.model_copy(update={"weights": weights})


@lru_cache
def _policy(name: str, weights: Path | None) -> Policy:
    """A policy, read once a process: those that feel have no memory, so episodes can share them."""
    return make_policy(name, _config(weights))


def _run_one(
    config: RunConfig, policy: Policy, offset_mm: tuple[float, float] | None
) -> tuple[Outcome, Watch]:
    rig = build(config.object, config.seed, sensor_name=config.sensor, start_offset_mm=offset_mm)
    sense, contract = TrueSense(rig), contract_of(config)
    watch = Watch(sense, rig.first_force_n)
    return run_unrecorded(rig, policy, config, contract, [watch], sense=sense), watch


def summary(results: Sequence[MissedResult]) -> dict[str, Any]:
    """Figures of one policy: rates with their 95 % intervals, and the ends of its episodes."""
    events: dict[str, Callable[[MissedResult], bool]] = {
        "reset_first": lambda r: r.reset_first,
        "contact_lost": lambda r: r.contact_lost,
        "force_added": lambda r: r.force_added,
        "false_reset": lambda r: r.false_reset,
    }
    figures: dict[str, Any] = {"episodes": len(results)}
    for name, event in events.items():
        count = sum(event(r) for r in results)
        figures[f"{name}_rate"] = count / len(results)
        figures[f"{name}_interval"] = wilson(count, len(results))
    figures["ends"] = Counter(r.end for r in results)
    figures["ordinary_ends"] = Counter(r.ordinary_end for r in results)
    return figures


def keeps_targets(figures: dict[str, Any]) -> bool:
    """Whether all rates of one policy lie within ``TARGETS``."""
    return all(low <= figures[name] <= high for name, (low, high) in TARGETS.items())


def run(settings: MissedSettings) -> bool:
    """Run the benchmark, print its table and write its figures.

    Returns:
        Whether each policy keeps ``TARGETS``.

    Raises:
        UsageError: A policy that does not feel, or a file with figures of something else.
    """
    weights, seeds, first_seed = settings.weights, settings.seeds, settings.first_seed
    episodes = len(seeds)
    policies = tuple(names_in(settings.policies))
    if not set(policies) <= set(POLICIES):
        raise UsageError(
            f"bench missed needs policies out of {', '.join(POLICIES)}, got {settings.policies!r}"
        )
    for name in policies:
        _policy(name, weights)  # an error shows here, not in a process
    about = {
        "benchmark": "missed",
        "first_seed": first_seed,
        "episodes": episodes,
        "policies": list(policies),
        "weights": weights_sum(weights or default_weights()) if "llm" in policies else None,
    }
    console, store = make_table_console(), SeedResults(path=settings.json, about=about)
    store.read(resume=settings.resume)
    function = partial(run_seed, weights, policies)
    by_seed = store.map_seeds(console, "episodes", list[MissedResult], function, seeds)
    by_policy = {name: [each[i] for each in by_seed] for i, name in enumerate(policies)}
    figures = {name: summary(results) for name, results in by_policy.items()}
    report = {
        "first_seed": first_seed,
        "episodes": episodes,
        "policies": figures,
        "constant_policies": CONSTANT_POLICIES,
        "episodes_by_policy": {n: [asdict(r) for r in rs] for n, rs in by_policy.items()},
    }
    _print(console, figures, episodes, first_seed)
    store.write(report)
    return all(map(keeps_targets, figures.values()))


def _print(
    console: Console, figures: dict[str, dict[str, Any]], episodes: int, first_seed: int
) -> None:
    columns = ("policy", "reset first", "contact lost", "force added", "false reset")
    table = number_table(
        f"{episodes} missed and {episodes} ordinary episodes, seeds from {first_seed:,}; "
        "95 % Wilson intervals",
        (*columns, "ends of the missed"),
        text=("policy", "ends of the missed"),
    )
    for name, row in figures.items():
        cells = []
        for rate in TARGETS:
            low, high = row[rate.replace("_rate", "_interval")]
            cells.append(f"{100 * row[rate]:.1f} % [{100 * low:.1f}, {100 * high:.1f}]")
        ends = ", ".join(f"{end} {count}" for end, count in row["ends"].most_common())
        table.add_row(name, *cells, ends)
    table.add_section()
    for name, rates in CONSTANT_POLICIES.items():
        cells = ["-" if rate is None else f"{100 * rate:g} %" for rate in rates.values()]
        table.add_row(name, *cells, "by definition")
    targets = [
        f"{'>=' if high == 1 else '<='} {100 * (low if high == 1 else high):g} %"
        for low, high in TARGETS.values()
    ]
    table.add_row("target", *targets, "")
    console.print(table)
