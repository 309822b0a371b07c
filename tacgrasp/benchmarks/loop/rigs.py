"""``tacgrasp bench rigs``: compare the ends of episodes on the emulated and the simulated rig.

Each seed is run twice with the same policy: simulated, and on emulators through the real drivers,
several rigs side by side. The reason of the end and the truth are compared.
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
from tacgrasp.console import make_console
from tacgrasp.loop import run_episode
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.factory import make_executor, make_rig
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.runtime.steps import NoRecorder
from tacgrasp.runtime.verify import verify_by_lifting

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


def run(
    *,
    seeds: int,
    first_seed: int,
    policy: str,
    parallel: int,
    weights: Path | None,
    json_path: Path | None,
) -> list[RigPair]:
    """Run each seed on both rigs; print the seeds that differ, and how many agree.

    Raises:
        UsageError: An unknown policy, or weights that can't be used.
    """
    configs = [
        load("strawberry", rig)[0].model_copy(update={"policy": policy, "weights": weights})
        for rig in ("sim", "emulated")
    ]
    make_policy(policy, configs[0])  # an error shows here, not in a worker
    console, pairs = make_console(), []
    with (
        ProcessPoolExecutor(parallel, get_context("spawn"), initializer=_one_thread) as pool,
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
        outcome = run_episode(
            rig,
            make_executor(rig, config, sense),
            policy,
            config,
            verify=verify_by_lifting,
            recorder=NoRecorder(),
            sense=sense,
        )
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


def _one_thread() -> None:
    import torch

    torch.set_num_threads(1)
    os.environ["OMP_NUM_THREADS"] = "1"
