"""Simulated strawberry episodes of the language model with a part of its input changed."""

from __future__ import annotations

from typing import Any, cast

from cltp.llm.generation import Talker
from policies.llm.policy import LlmPolicy
from sim.grasp.rig import build
from tacgrasp.benchmarks.loop.contestants import Contestant
from tacgrasp.benchmarks.loop.strawberry import EpisodeResult, run_entered, summary
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.runtime.verify import accelerations
from tacgrasp.training.ablation.ablated_talker import AblatedTalker

TASK = "strawberry"

FIRST_SEED = 500_000
"""First seed of the episodes; those of the strawberry benchmark are a million and more."""


def run_episode(policy: LlmPolicy, talker: AblatedTalker, seed: int) -> EpisodeResult:
    """One episode of a policy that talks through ``talker``."""
    config = load(TASK)[0].model_copy(update={"seed": seed, "on_failure": "hold"})
    rig = build(config.object, seed, sensor_name=config.sensor)
    entered = Contestant(
        rig=rig,
        policy=policy.through(cast(Talker, talker), says_readings=False),
        contract=contract_of(config),
        sense=GelSense(rig.sensor),
    )
    slip_minimum_n = rig.grasp.fingers.slip_minimum_n(accelerations(config.verify))
    return run_entered(config, entered, slip_minimum_n)


def figures(results: list[EpisodeResult]) -> dict[str, Any]:
    """Figures of some episodes, as of ``tacgrasp bench strawberry``."""
    kept = (
        *("episodes", "verified_success_rate", "verified_success_interval"),
        *("bruised_rate", "dropped_rate", "median_actions", "ends"),
    )
    whole = summary(results)
    return {name: whole[name] for name in kept}
