"""``tacgrasp bench gain``: how well the gripper's force gain is known after some grips.

Each seed draws a body, a gripper's gain and a sensor unit. The fingers close again and again, at
another place of the pad and with another force. After each grip the estimate is compared with the
ratio of the sensor's own force to the command, the mean of many further grips, and with the true
gain; between those two lies what the sensor's calibration leaves.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from rich.console import Console

from primitives.force_guard import GuardedGripper
from primitives.gain import GainEstimate
from sim.grasp.bodies import Range
from sim.grasp.rig import SimRig, build
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.results_file import SeedResults
from tacgrasp.benchmarks.settings import GainSettings
from tacgrasp.config.layers import load
from tacgrasp.console import make_table_console
from tacgrasp.rig.gel_sense import GelSense

GRIPS = (1, 2, 5)
REFERENCE_GRIPS = 15
"""Further grips whose mean is what the sensor feels in the long run."""

PLACE_MM = Range(low=-6.0, high=6.0)
FORCE_OVER_BRUISE = Range(low=0.4, high=0.8)
"""True force of a grip over the bruise force. Our choice: that of a declared grasp, and less."""

CLEAR_M = 0.01

LIMITS = {2: 0.10, 5: 0.05}
"""Largest error relative to the sensor's force after as many grips, of nine in ten rigs."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GainSample:
    """One gripper and one sensor unit.

    Attributes:
        gain: True ratio of force to command.
        of_sensor: Error of the estimate after each number of ``GRIPS``, relative to the sensor's
            own ratio in the long run, as ln.
        of_truth: The same relative to the true ratio.
        held: Whether the sensor's own ratio lay in the interval after each.
        residual: Residual of the sensor's calibration.
    """

    gain: float
    of_sensor: tuple[float, ...]
    of_truth: tuple[float, ...]
    held: tuple[bool, ...]
    residual: float


def run(settings: GainSettings) -> bool:
    """Measure, print a table and write the figures.

    Returns:
        Whether the limits are kept.

    Raises:
        UsageError: The file of ``--json`` holds something that is not gone on with.
    """
    console, seeds = make_table_console(), settings.seeds
    about = {
        "benchmark": "gain",
        "task": settings.task,
        "sensor": settings.sensor,
        "first_seed": settings.first_seed,
    }
    store = SeedResults(path=settings.json, about=about)
    store.read(resume=settings.resume)
    found = store.map_seeds(
        console, "gains", GainSample, partial(measure, settings.task, settings.sensor), seeds
    )
    figures = summary(found)
    _print(console, settings, figures)
    store.write(figures)
    return bool(figures["keeps_limits"])


def measure(task: str, sensor_name: str, seed: int) -> GainSample:
    """Grip a body again and again; the estimator knows commands and felt forces alone."""
    config, _ = load(task)
    rig = build(config.object, seed, sensor_name=sensor_name)
    rng, sense = np.random.default_rng([seed, 31]), GelSense(rig.sensor)
    estimates = {}
    guard = _guard(rig, config.gripper.max_force_gain)
    for k in range(max(GRIPS)):
        _grip(rig, guard, sense, rng)
        if k + 1 in GRIPS:
            estimates[k + 1] = guard.gain_estimate
    reference = _guard(rig, config.gripper.max_force_gain)
    for _ in range(REFERENCE_GRIPS):
        _grip(rig, reference, sense, rng)
    long_run, true = reference.gain_estimate, rig.gripper.force_gain
    assert long_run is not None  # fifteen clear grips
    return GainSample(
        gain=true,
        of_sensor=tuple(_error(estimates[n], long_run.value) for n in GRIPS),
        of_truth=tuple(_error(estimates[n], true) for n in GRIPS),
        held=tuple(_holds(estimates[n], long_run.value) for n in GRIPS),
        residual=rig.force_calibration.spread,
    )


def _guard(rig: SimRig, max_gain: float) -> GuardedGripper:
    return GuardedGripper(rig.gripper, limit_n=math.inf, max_gain=max_gain)


def _grip(rig: SimRig, guard: GuardedGripper, sense: GelSense, rng: np.random.Generator) -> None:
    """Close at a drawn place with a drawn true force, and feel."""
    grasp, bruise_n = rig.grasp, rig.grasp.fingers.body.bruise_n
    guard.open_by(CLEAR_M)
    x_mm, y_mm = (PLACE_MM.quantile(rng.random()) for _ in range(2))
    at, pad = grasp.body_xy_mm, grasp.pad_xy_mm
    grasp.displace((at[0] - x_mm - pad[0], at[1] - y_mm - pad[1]))
    sense.take_reference()
    force_n = FORCE_OVER_BRUISE.quantile(rng.random()) * bruise_n
    guard.grip(force_n / rig.gripper.force_gain)
    guard.feel(sense.felt_force(sense.read()))


def _error(estimate: GainEstimate | None, gain: float) -> float:
    return math.inf if estimate is None else math.log(estimate.value / gain)


def _holds(estimate: GainEstimate | None, gain: float) -> bool:
    return estimate is not None and estimate.low <= gain <= estimate.high


def summary(samples: Sequence[GainSample]) -> dict[str, Any]:
    """Median and nine in ten of the errors' sizes, by number of grips."""
    rows: dict[str, Any] = {}
    for i, grips in enumerate(GRIPS):
        of_sensor, of_truth = (
            np.abs(np.expm1([getattr(each, name)[i] for each in samples]))
            for name in ("of_sensor", "of_truth")
        )
        rows[str(grips)] = {
            "of_sensor": {"p50": float(np.median(of_sensor)), "p90": _p90(of_sensor)},
            "of_truth": {"p50": float(np.median(of_truth)), "p90": _p90(of_truth)},
            "interval_holds": float(np.mean([each.held[i] for each in samples])),
        }
    kept = all(rows[str(n)]["of_sensor"]["p90"] <= limit for n, limit in LIMITS.items())
    return {
        "rigs": len(samples),
        "after_grips": rows,
        "calibration_residual": float(np.median([each.residual for each in samples])),
        "keeps_limits": kept,
    }


def _p90(errors: np.ndarray[Any, np.dtype[np.float64]]) -> float:
    return float(np.sort(errors)[math.ceil(0.9 * len(errors)) - 1])


def _print(console: Console, settings: GainSettings, figures: dict[str, Any]) -> None:
    table = number_table(
        f"{figures['rigs']} rigs, {settings.task}, {settings.sensor}, seeds from "
        f"{settings.first_seed:,}: error of the gripper's gain, %",
        ("grips", "of sensor p50", "p90", "limit", "of truth p50", "p90", "interval holds"),
        text=("grips",),
    )
    for grips, row in figures["after_grips"].items():
        of_sensor, of_truth = row["of_sensor"], row["of_truth"]
        limit = LIMITS.get(int(grips))
        numbers = [f"{100 * each:.1f}" for each in of_sensor.values()]
        numbers.append("" if limit is None else f"{100 * limit:g}")
        numbers += [f"{100 * each:.1f}" for each in of_truth.values()]
        table.add_row(grips, *numbers, f"{100 * row['interval_holds']:.0f}")
    console.print(table)
    console.print(
        "of sensor: relative to the calibrated sensor's own force; of truth: with what its "
        f"calibration leaves (median residual {figures['calibration_residual']:.1%})"
    )
