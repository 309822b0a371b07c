"""``tacgrasp bench rigs``: does the emulated rig come to the same ends as the simulated one?

Every seed is run twice with the same policy: simulated, and on emulators through the real drivers,
several rigs side by side. Compared are the end's reason and the truth.
"""

from __future__ import annotations

import json
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from rich.progress import Progress

from primitives import RobotError
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.console import console
from tacgrasp.loop import run_episode
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.factory import make_executor, make_rig
from tacgrasp.runtime.tick import NoRecorder
from tacgrasp.runtime.verify import verify_by_lifting

COMPARED = ("held", "slipped", "dropped", "bruised", "bruised_at_start")
"""Facts of the truth that must agree beside the end's reason."""


@dataclass(frozen=True, slots=True, kw_only=True)
class End:
    """What one episode came to.

    Attributes:
        reason: The named end; 'not started' when the rig could not be had.
        facts: The facts of ``COMPARED`` that are true.
        steps: Actions carried out.
        message: For people.
    """

    reason: str
    facts: tuple[str, ...]
    steps: int
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """The ends of one seed on both rigs."""

    seed: int
    simulated: End
    emulated: End

    @property
    def agree(self) -> bool:
        """Same reason, same truth."""
        one, other = self.simulated, self.emulated
        return (one.reason, one.facts) == (other.reason, other.facts)


def run(
    *,
    seeds: int,
    first_seed: int,
    policy: str,
    parallel: int,
    weights: Path | None,
    json_path: Path | None,
) -> list[Pair]:
    """Run every seed on both rigs, print where they differ and how many agree.

    Raises:
        UsageError: An unknown policy, or weights that can't be used.
    """
    configs = [
        load("strawberry", rig)[0].model_copy(update={"policy": policy, "weights": weights})
        for rig in ("sim", "emulated")
    ]
    make_policy(policy, configs[0])  # refused here, not in a worker
    out, pairs = console(), []
    with (
        ProcessPoolExecutor(parallel, get_context("spawn"), initializer=_one_thread) as pool,
        Progress(console=out, transient=True) as progress,
    ):
        task = progress.add_task("episodes", total=seeds)
        numbers = range(first_seed, first_seed + seeds)
        for pair in pool.map(partial(run_seed, configs[0], configs[1]), numbers):
            pairs.append(pair)
            progress.advance(task)
            if not pair.agree:
                out.print(f"seed {pair.seed}: {_words(pair.simulated)} simulated")
                out.print(f"{'':5}{'':{len(str(pair.seed))}}  {_words(pair.emulated)} emulated")
    agree = sum(pair.agree for pair in pairs)
    out.print(f"{agree} of {len(pairs)} seeds agree in end and truth ({policy})")
    if json_path is not None:
        report = {
            "policy": policy,
            "first_seed": first_seed,
            "seeds": seeds,
            "agree": agree,
            "episodes": [asdict(pair) | {"agree": pair.agree} for pair in pairs],
        }
        json_path.write_text(json.dumps(report, indent=1), encoding="utf-8")
    return pairs


def run_seed(simulated: RunConfig, emulated: RunConfig, seed: int) -> Pair:
    """One seed on both rigs, without records."""
    ends = [_end(c.model_copy(update={"seed": seed})) for c in (simulated, emulated)]
    return Pair(seed=seed, simulated=ends[0], emulated=ends[1])


def _end(config: RunConfig) -> End:
    policy = make_policy(config.policy, config)
    try:
        rig = make_rig(config)
    except RobotError as error:
        return End(reason="not started", facts=(), steps=0, message=str(error))
    try:
        outcome = run_episode(
            rig,
            make_executor(rig, config),
            policy,
            config,
            verify=verify_by_lifting,
            recorder=NoRecorder(),
        )
    finally:
        rig.disconnect()
    truth = outcome.truth or {}
    return End(
        reason=outcome.reason.value,
        facts=tuple(name for name in COMPARED if truth.get(name)),
        steps=outcome.steps,
        message=outcome.message,
    )


def _words(end: End) -> str:
    return f"{end.reason}, {', '.join(end.facts) or 'nothing true'}, {end.steps} actions"


def _one_thread() -> None:
    import torch

    torch.set_num_threads(1)
    os.environ["OMP_NUM_THREADS"] = "1"
