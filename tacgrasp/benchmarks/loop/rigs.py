"""``tacgrasp bench rigs``: compare the ends of episodes on the emulated and the simulated rig.

Each seed is run twice with the same policy: simulated, and on emulators through the real drivers,
several rigs side by side. The reason of the end and the truth are compared.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from functools import partial

from rich.progress import Progress

from primitives import RobotError
from tacgrasp.base.worker_pool import worker_pool
from tacgrasp.benchmarks.figures import write_figures
from tacgrasp.benchmarks.settings import RigsSettings
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.console import make_console
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.factory import make_rig
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.run import run_unrecorded

MIN_AGREEMENT = 0.96
"""Fraction of the seeds that must come to the same end and truth on both rigs."""

COMPARED = ("held", "slipped", "dropped", "bruised", "bruised_at_start")
"""Facts of the truth that must agree, beside the reason of the end."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RigEnd:
    """End of one episode on one rig.

    Attributes:
        reason: The named end; 'not started' when the rig could not be built.
        facts: The facts of ``COMPARED`` that are true.
        steps: Number of actions carried out.
        message: The end in words.
    """

    reason: str
    facts: tuple[str, ...]
    steps: int
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RigPair:
    """The ends of one seed on both rigs."""

    seed: int
    simulated: RigEnd
    emulated: RigEnd

    @property
    def agree(self) -> bool:
        """Whether both rigs came to the same reason and truth."""
        simulated, emulated = self.simulated, self.emulated
        return (simulated.reason, simulated.facts) == (emulated.reason, emulated.facts)


def run(settings: RigsSettings) -> bool:
    """Run each seed on both rigs; print the seeds that differ, and how many agree.

    Returns:
        Whether enough agree.

    Raises:
        UsageError: An unknown policy, or weights that can't be used.
    """
    policy, seeds, first_seed = settings.policy, settings.seeds, settings.first_seed
    changes = {"policy": policy, "weights": settings.weights}
    configs = [load("strawberry", rig)[0].model_copy(update=changes) for rig in ("sim", "emulated")]
    make_policy(policy, configs[0])  # an error shows here, not in a worker
    console, pairs = make_console(), []
    with (
        worker_pool(settings.parallel) as pool,
        Progress(console=console, transient=True) as progress,
    ):
        task = progress.add_task("episodes", total=seeds)
        numbers = range(first_seed, first_seed + seeds)
        for pair in pool.map(partial(run_seed, configs[0], configs[1]), numbers):
            pairs.append(pair)
            progress.advance(task)
            if not pair.agree:
                console.print(f"seed {pair.seed}: {_words(pair.simulated)} simulated")
                console.print(f"{'':5}{'':{len(str(pair.seed))}}  {_words(pair.emulated)} emulated")
    agree = sum(pair.agree for pair in pairs)
    console.print(f"{agree} of {len(pairs)} seeds agree in end and truth ({policy})")
    report = {
        "policy": policy,
        "first_seed": first_seed,
        "seeds": seeds,
        "agree": agree,
        "episodes": [asdict(pair) | {"agree": pair.agree} for pair in pairs],
    }
    write_figures(settings.json, report)
    return agree >= MIN_AGREEMENT * len(pairs)


def run_seed(simulated: RunConfig, emulated: RunConfig, seed: int) -> RigPair:
    """Run one seed on both rigs, without records."""
    ends = [_end(c.model_copy(update={"seed": seed})) for c in (simulated, emulated)]
    return RigPair(seed=seed, simulated=ends[0], emulated=ends[1])


def _end(config: RunConfig) -> RigEnd:
    policy = make_policy(config.policy, config)
    try:
        rig = make_rig(config)
    except RobotError as error:
        return RigEnd(reason="not started", facts=(), steps=0, message=str(error))
    try:
        sense = GelSense(rig.sensor)
        outcome = run_unrecorded(rig, policy, config, contract_of(config), sense=sense)
    finally:
        rig.disconnect()
    truth = outcome.truth or {}
    return RigEnd(
        reason=outcome.reason.value,
        facts=tuple(name for name in COMPARED if truth.get(name)),
        steps=outcome.num_actions,
        message=outcome.message,
    )


def _words(end: RigEnd) -> str:
    return f"{end.reason}, {', '.join(end.facts) or 'nothing true'}, {end.steps} actions"
