"""Episodes of the robustness benchmark: those of ``bench strawberry`` under a condition."""

from __future__ import annotations

from functools import partial

from sim.grasp.rig import build
from sim.grasp.turned_pad import TURNED_PAD_X_IN_TCP, TURNED_PAD_Y_IN_TCP
from tacgrasp.benchmarks.loop.strawberry import EpisodeResult, run_seed
from tacgrasp.benchmarks.robustness.conditions import Condition
from tacgrasp.config.schema import PadConfig, RunConfig


def run_episode_under(
    config: RunConfig, condition: Condition, policy: str, force_n: float | None, seed: int
) -> EpisodeResult:
    """One episode.

    Args:
        config: The run.
        condition: State of the sensor.
        policy: Name of the policy.
        force_n: Force [N] of ``fixed_force``; None for policies that feel.
        seed: Random seed of the episode.
    """
    is_turned = condition.turn_deg == 90
    if is_turned:
        pad = PadConfig(x_axis=TURNED_PAD_X_IN_TCP, y_axis=TURNED_PAD_Y_IN_TCP)
        config = config.model_copy(update={"pad": pad})
    make = partial(build, noise_level=condition.levels, gel=condition.gel, is_turned=is_turned)
    (result,) = run_seed(config, [(policy, force_n)], seed, make)
    return result
