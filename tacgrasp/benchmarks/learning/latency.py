"""How long a tick takes, stage by stage: cloud in, complete Decision out.

The clouds are real touches of the simulated rig, recorded beforehand, so that the simulator's own
time is not in the figures; reading and recording are timed apart from the decision.
"""

from __future__ import annotations

import json
import tempfile
import time
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

from cltp.tactile.cloud import TactileCloud
from policies import Policy
from tacgrasp.base.errors import UsageError
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.console import console
from tacgrasp.episodes import EpisodeHeader, EpisodeWriter, Phase, TickRecord
from tacgrasp.policy_factory import default_weights, make_policy
from tacgrasp.rig.factory import make_rig
from tacgrasp.rig.protocols import Rig

NUM_TOUCHES = 8
WARM_UP = 5
FORCES_N = (0.6, 1.2, 2.4)


def run(
    *,
    ticks: int,
    policy_name: str,
    task: str,
    json_path: Path | None,
    weights: Path | None = None,
) -> dict[str, Any]:
    """Time ``ticks`` decisions, print a table, write the figures.

    Returns:
        ``tick_ms.{p50, p99}``, ``stages_ms.<stage>.{p50, p99}`` and what was measured; for ``llm``
        also what ``bench_language.language_report`` gives, and ``start_to_first_action_s``.

    Raises:
        UsageError: Unknown policy or task, or fewer than one tick.
        TouchError: The weights can't be used.
    """
    if ticks < 1:
        raise UsageError(f"--ticks must be at least 1, got {ticks}")
    config = load(task)[0].model_copy(update={"weights": weights})
    policy = make_policy(policy_name, config)
    rig = make_rig(config)
    touches = _touches(rig)
    policy.start()
    whole, stages = [], defaultdict(list)
    for number in track(range(WARM_UP + ticks), description="deciding", transient=True):
        began = time.perf_counter()
        decision = policy.decide(touches[number % len(touches)], config.instruction)
        took = 1e3 * (time.perf_counter() - began)
        if number >= WARM_UP:
            whole.append(took)
            for stage, stage_ms in decision.stage_ms.items():
                stages[stage].append(stage_ms)
    stages["record"] = _record_ms(rig, touches, ticks)
    rig.disconnect()
    report: dict[str, Any] = {
        "policy": policy_name,
        "ticks": ticks,
        "tick_ms": _quantiles(whole),
        "stages_ms": {stage: _quantiles(times) for stage, times in stages.items()},
    }
    if policy_name == "llm":
        report |= _of_the_language_model(policy, touches, config, report["stages_ms"])
    _print(report)
    if json_path is not None:
        json_path.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    return report


def _of_the_language_model(
    policy: Policy,
    touches: list[TactileCloud],
    config: RunConfig,
    stages_ms: dict[str, dict[str, float]],
) -> dict[str, Any]:
    from policies.llm import LlmPolicy
    from tacgrasp.benchmarks.learning.llm_latency import language_report, start_to_first_action_s

    if not isinstance(policy, LlmPolicy):
        return {}
    lm_folder = (config.weights or default_weights()) / "lm"
    found = language_report(policy.talker, lm_folder, touches, config.instruction, stages_ms)
    started_s = start_to_first_action_s(config.task, config.weights)
    return found | {"start_to_first_action_s": started_s}


def _touches(rig: Rig) -> list[TactileCloud]:
    """Touches of different forces, each frame with its own noise."""
    touches = []
    for number in range(NUM_TOUCHES):
        rig.gripper.grip(FORCES_N[number % len(FORCES_N)])
        touches.append(rig.sensor.read())
    return touches


def _record_ms(rig: Rig, touches: list[TactileCloud], ticks: int) -> list[float]:
    """Time of one durable record each [ms]; not part of the tick, which ends with the decision."""
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
            record = TickRecord(
                index=index,
                phase=Phase.TICK,
                cloud=touches[index % len(touches)],
                decision=None,
                executed=None,
                tcp_pose=pose,
                gripper=gripper,
                stamp=stamp,
                tick_ms=0.0,
            )
            began = time.perf_counter()
            writer.write_tick(record)
            times.append(1e3 * (time.perf_counter() - began))
    return times


def _quantiles(times_ms: list[float]) -> dict[str, float]:
    p50, p99 = np.percentile(times_ms, [50, 99])
    return {"p50": float(p50), "p99": float(p99)}


def _print(report: dict[str, Any]) -> None:
    floors = report.get("floors", {})
    table = Table(title=f"{report['policy']}, {report['ticks']} ticks")
    columns = ["stage", "p50 ms", "p99 ms"]
    columns += ["million operations", "floor ms", "times the floor"] if floors else []
    for column in columns:
        table.add_column(column, justify="left" if column == "stage" else "right")
    for name, quantiles in {**report["stages_ms"], "whole tick": report["tick_ms"]}.items():
        row = [name, f"{quantiles['p50']:.2f}", f"{quantiles['p99']:.2f}"]
        if name in floors:
            floor = floors[name]
            row += [f"{floor['million_operations']:.1f}", f"{floor['floor_ms']:.2f}"]
            row += [f"{floor['times_floor']:.1f}"]
        table.add_row(*row)
    to = console()
    to.print(table)
    if floors:
        _print_language(report, to)


def _print_language(report: dict[str, Any], to: Console) -> None:
    to.print(
        f"tokens generated: {report['tokens']['p50']} (median), {report['tokens']['max']} at most; "
        f"{report['threads']} thread(s); floors at the {report['product_gflops']:.1f} GFLOP/s of a "
        "matrix product in this run"
    )
    ways = {
        "no_cache": "transformers, all computed anew for every token (naive)",
        "with_cache": "transformers' generate with its cache",
    }
    for name, words in ways.items():
        way = report["naive"][name]
        same = "the same text" if way["same_text"] else "another text"
        to.print(f"{words}: {way['ms']:.0f} ms, {way['ratio']:.1f} times ours, {same}")
    to.print(f"from start to first action: {report['start_to_first_action_s']:.1f} s")
