"""``tacgrasp bench latency``: duration of a decision, stage by stage.

The clouds are read from the simulated rig beforehand, so the figures hold no time of the simulator.
Recording is timed apart from the decision.
"""

from __future__ import annotations

import math
import tempfile
import time
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track

from cltp.tactile.cloud import TactileCloud
from policies import Observation, Policy
from primitives.contract import Contract
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.settings import LatencySettings
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.console import make_console
from tacgrasp.episodes import EpisodeHeader, EpisodeWriter, StepPhase, StepRecord
from tacgrasp.policy_factory import default_weights, make_policy
from tacgrasp.rig.factory import make_rig
from tacgrasp.rig.protocols import Rig

WARM_UP = 5
FORCES_N = (0.6, 1.2, 2.4)


def run(settings: LatencySettings) -> None:
    """Time decisions, print a table, write the figures.

    They are ``tick_ms.{p50, p99}`` and ``stages_ms.<stage>.{p50, p99}``; for ``llm`` also those of
    ``llm_latency.language_report``, and ``start_to_first_action_s``.

    Raises:
        UsageError: An unknown policy or task.
        TouchError: The weights can't be used.
    """
    policy_name, ticks = settings.policy, settings.ticks
    config = load(settings.task)[0].model_copy(update={"weights": settings.weights})
    policy = make_policy(policy_name, config)
    clouds = _clouds(config, settings.contacts)
    rig = make_rig(config)
    observations = [Observation(cloud=cloud, in_contact=True) for cloud in clouds]
    policy.start()
    contract = contract_of(config)
    durations, stages = [], defaultdict(list)
    for number in track(range(WARM_UP + ticks), description="decisions", transient=True):
        began = time.perf_counter()
        decision = policy.decide(observations[number % len(clouds)], contract)
        duration_ms = 1e3 * (time.perf_counter() - began)
        if number >= WARM_UP:
            durations.append(duration_ms)
            for stage, stage_ms in decision.stage_ms.items():
                stages[stage].append(stage_ms)
    stages["record"] = _record_ms(rig, clouds, ticks)
    rig.disconnect()
    report: dict[str, Any] = {
        "policy": policy_name,
        "ticks": ticks,
        "tick_ms": _quantiles(durations),
        "stages_ms": {stage: _quantiles(times) for stage, times in stages.items()},
    }
    if policy_name == "llm":
        report |= _language_model(policy, clouds, config, contract, report["stages_ms"])
    _print(report)
    write_figures(settings.json, report)


def _language_model(
    policy: Policy,
    clouds: list[TactileCloud],
    config: RunConfig,
    contract: Contract,
    stages_ms: dict[str, dict[str, float]],
) -> dict[str, Any]:
    from policies.llm.policy import LlmPolicy
    from tacgrasp.benchmarks.learning.llm_latency import language_report, start_to_first_action_s

    if not isinstance(policy, LlmPolicy):
        return {}
    lm_folder = (config.weights_folder or default_weights()) / "lm"
    figures = language_report(policy, lm_folder, clouds, contract, stages_ms)
    started_s = start_to_first_action_s(config.task, config.weights_folder)
    return figures | {"start_to_first_action_s": started_s}


def _clouds(config: RunConfig, count: int) -> list[TactileCloud]:
    """Clouds of drawn bodies, of which few lie in the middle, each body under every force."""
    clouds: list[TactileCloud] = []
    for seed in range(math.ceil(count / len(FORCES_N))):
        rig = make_rig(config.model_copy(update={"seed": seed}))
        for force_n in FORCES_N[: count - len(clouds)]:
            rig.gripper.grip(force_n)
            clouds.append(rig.sensor.read())
        rig.disconnect()
    return clouds


def _record_ms(rig: Rig, clouds: list[TactileCloud], ticks: int) -> list[float]:
    """Durations of one durable record each [ms]."""
    stamp = rig.clock.stamp()
    header = EpisodeHeader(
        task="latency",
        instruction="",
        policy="none",
        seed=None,
        sensor=rig.sensor.spec,
        config_yaml="",
        versions={},
        stamp=stamp,
    )
    pose, gripper, times = rig.arm.pose(), rig.gripper.state(), []
    with (
        tempfile.TemporaryDirectory() as folder,
        EpisodeWriter(Path(folder) / "latency.mcap", header) as writer,
    ):
        for index in range(min(ticks, 100)):
            record = StepRecord(
                index=index,
                phase=StepPhase.LOOP,
                cloud=clouds[index % len(clouds)],
                decision=None,
                executed=None,
                tcp_pose=pose,
                gripper=gripper,
                stamp=stamp,
                step_ms=0.0,
            )
            began = time.perf_counter()
            writer.write_step(record)
            times.append(1e3 * (time.perf_counter() - began))
    return times


def _quantiles(times_ms: list[float]) -> dict[str, float]:
    p50, p99 = np.percentile(times_ms, [50, 99])
    return {"p50": float(p50), "p99": float(p99)}


def _print(report: dict[str, Any]) -> None:
    floors = report.get("floors", {})
    columns = ["stage", "p50 ms", "p99 ms"]
    columns += ["million operations", "floor ms", "times the floor"] if floors else []
    table = number_table(f"{report['policy']}, {report['ticks']} steps", columns, ("stage",))
    for name, quantiles in {**report["stages_ms"], "whole step": report["tick_ms"]}.items():
        row = [name, f"{quantiles['p50']:.2f}", f"{quantiles['p99']:.2f}"]
        if name in floors:
            floor = floors[name]
            row += [f"{floor['million_operations']:.1f}", f"{floor['floor_ms']:.2f}"]
            row += [f"{floor['times_floor']:.1f}"]
        table.add_row(*row)
    console = make_console()
    console.print(table)
    if floors:
        _print_language(report, console)


def _print_language(report: dict[str, Any], console: Console) -> None:
    passes = report["passes"]
    console.print(
        f"tokens said: {report['tokens']['p50']} (median), {report['tokens']['max']} at most, in "
        f"{passes['p50']:.0f} passes (median), {passes['p90']:.0f} (90 %); "
        f"{report['same_without_draft']} of {report['contacts']} replies are the same without a "
        f"draft, {report['close_calls']} decisions were close; {report['threads']} thread(s)"
    )
    whole = report["tick_ms_in_32_bits"]
    console.print(
        f"long passes in {report['precision']}; in 32 bits {report['same_in_32_bits']} of "
        f"{report['contacts']} replies are the same, a whole step takes {whole['p50']:.2f} ms "
        f"(p50), {whole['p99']:.2f} ms (p99); "
        f"floors at the {report['product_gflops']:.1f} GFLOP/s of a matrix product in this run"
    )
    console.print(
        "transformers' generate with its cache, the same tokens: "
        f"{report['with_cache_ms']:.0f} ms, {report['speedup_cached']:.1f} times ours"
    )
    console.print(f"from start to first action: {report['start_to_first_action_s']:.1f} s")
