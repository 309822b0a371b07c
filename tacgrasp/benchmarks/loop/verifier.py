"""``tacgrasp bench verifier``: false alarms and missed slips of the verification by touch.

A grasped body of each task is read before and after the time of a lift: once unmoved, once slid by
2 mm in a drawn direction, with a grip that has relaxed or tightened by up to a tenth. Beside the
registration of ``cltp.tactile.shift`` stands the distance of the two centroids, for comparison.

A peg that slides along its own axis looks the same: such slips are missed, and counted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from rich.console import Console

from cltp.tactile.measure import contact_state
from primitives.contract import Band
from sim.grasp.bodies import OBJECTS, Range
from sim.grasp.rig import SimRig, build
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.loop.strawberry import wilson
from tacgrasp.benchmarks.results_file import SeedResults
from tacgrasp.benchmarks.settings import VerifierSettings
from tacgrasp.config.layers import load
from tacgrasp.config.schema import VerifyConfig
from tacgrasp.console import make_table_console
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.runtime.outcome import Verification
from tacgrasp.runtime.steps import Readings, read_observation
from tacgrasp.runtime.verify import compare

SLIP_MM = 2.0
PLACE_X_MM, PLACE_Y_MM = Range(low=-4.0, high=4.0), Range(low=-3.0, high=3.0)
"""Place of a declared grasp, as in the tasks."""

LIFT_S = 4.0
"""Time between both readings: lift, shakes and hold of the tasks."""

FORCE_OVER_BRUISE = Range(low=0.45, high=0.8)
"""Force of a grasp over the bruise force, of kinds whose needs are felt. Source: the final forces
of ``rules`` in ``bench strawberry``."""

FORCE_RATIO = Range(low=0.9, high=1.1)
"""Force after the lift over that before. Our choice: soft bodies relax."""


@dataclass(frozen=True, slots=True, kw_only=True)
class VerifierSample:
    """One body, verified.

    Attributes:
        alarm, centroid_alarm: Whether the unmoved body was called moved, by registration and by
            centroids.
        missed, centroid_missed: Whether the slid body was not called moved.
        error_mm, centroid_error_mm: Shift read from the unmoved body [mm].
    """

    alarm: bool
    missed: bool
    error_mm: float
    centroid_alarm: bool
    centroid_missed: bool
    centroid_error_mm: float


def run(settings: VerifierSettings) -> None:
    """Measure, print a table and write the figures.

    Raises:
        UsageError: The file of ``--json`` holds something that is not gone on with.
    """
    console, seeds = make_table_console(), settings.seeds
    about = {"benchmark": "verifier", "first_seed": settings.first_seed, "episodes": len(seeds)}
    store = SeedResults(path=settings.json, about=about)
    store.read(resume=settings.resume)
    figures: dict[str, Any] = {"first_seed": settings.first_seed, "objects": {}}
    for name in OBJECTS:
        config = load(name)[0]
        band = None if config.goal.needs else config.goal.goal().force_n
        sample = partial(verify_seed, name, config.verify, band)
        samples = store.map_seeds(console, name, VerifierSample, sample, seeds)
        figures["objects"][name] = _figures(samples)
    _print(console, figures)
    store.write(figures)


def verify_seed(name: str, verify: VerifyConfig, force_n: Band | None, seed: int) -> VerifierSample:
    """Verify one body of a kind, unmoved and slid.

    Args:
        name: Kind of body.
        verify: Thresholds.
        force_n: Band that the force of the grasp is drawn from [N]; None draws it below the force
            that bruises the body.
        seed: Random seed.
    """
    if force_n is None:
        bruise_n = build(name, seed).grasp.fingers.body.bruise_n
        force_n = Band(low=FORCE_OVER_BRUISE.low * bruise_n, high=FORCE_OVER_BRUISE.high * bruise_n)
    rng = np.random.default_rng([seed, 12])
    place = (PLACE_X_MM.quantile(rng.random()), PLACE_Y_MM.quantile(rng.random()))
    force, ratio = rng.uniform(force_n.low, force_n.high), FORCE_RATIO.quantile(rng.random())
    angle = rng.uniform(0, 2 * math.pi)
    slid = (place[0] + SLIP_MM * math.cos(angle), place[1] + SLIP_MM * math.sin(angle))
    results = [
        _compared(build(name, seed), verify, place, end, force, ratio) for end in (place, slid)
    ]
    (held, held_centroid_mm), (moved, moved_centroid_mm) = results
    limit_mm = verify.max_shift_mm
    return VerifierSample(
        alarm=not held.passed,
        missed=moved.passed,
        error_mm=held.shift_mm,
        centroid_alarm=held_centroid_mm > limit_mm,
        centroid_missed=moved_centroid_mm <= limit_mm,
        centroid_error_mm=held_centroid_mm,
    )


def _compared(
    rig: SimRig,
    verify: VerifyConfig,
    place_mm: tuple[float, float],
    end_mm: tuple[float, float],
    force_n: float,
    force_ratio: float,
) -> tuple[Verification, float]:
    """The verification, and the distance of the centroids [mm]."""
    grasp, sense = rig.grasp, GelSense(rig.sensor)
    sense.take_reference()
    grasp.patch = grasp.fingers.press(place_mm, force_n)
    grasp.contacts += 1
    before = read_observation(rig, sense)
    rig.clock.advance(LIFT_S)
    grasp.patch = grasp.fingers.press(end_mm, force_n * force_ratio)
    after = read_observation(rig, sense)
    return compare(before, after, verify, slip_mm=verify.max_shift_mm), _centroids_mm(before, after)


def _centroids_mm(before: Readings, after: Readings) -> float:
    one, other = (contact_state(each.cloud, in_contact=True) for each in (before, after))
    return math.hypot(other.x_mm - one.x_mm, other.y_mm - one.y_mm)


def _figures(samples: list[VerifierSample]) -> dict[str, Any]:
    count = len(samples)
    figures: dict[str, Any] = {"n": count}
    for name in ("alarm", "missed", "centroid_alarm", "centroid_missed"):
        hits = sum(getattr(each, name) for each in samples)
        key = name.replace("alarm", "false_alarm")
        figures |= {f"{key}_rate": hits / count, f"{key}_interval": wilson(hits, count)}
    for name in ("error_mm", "centroid_error_mm"):
        figures[f"{name}_p95"] = float(np.percentile([getattr(s, name) for s in samples], 95))
    return figures


def _print(console: Console, figures: dict[str, Any]) -> None:
    title = f"Verification by touch, unmoved and slid by {SLIP_MM:g} mm; 95 % Wilson intervals"
    columns = ["object", "n", "false alarms", "missed slips", "shift of unmoved, p95 mm"]
    columns += ["centroids: false alarms", "missed", "p95 mm"]
    table = number_table(title, columns, ("object",))
    for name, row in figures["objects"].items():

        def rate(key: str, row: dict[str, Any] = row) -> str:
            low, high = row[f"{key}_interval"]
            return f"{row[f'{key}_rate']:.1%} [{100 * low:.1f}, {100 * high:.1f}]"

        table.add_row(
            name,
            str(row["n"]),
            rate("false_alarm"),
            rate("missed"),
            f"{row['error_mm_p95']:.2f}",
            rate("centroid_false_alarm"),
            rate("centroid_missed"),
            f"{row['centroid_error_mm_p95']:.2f}",
        )
    console.print(table)
