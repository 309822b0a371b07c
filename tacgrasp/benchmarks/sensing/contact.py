"""``tacgrasp bench contact``: how often contact is imagined in air, and how light it may be.

False alarms are counted by closing, two seconds in air against the gel of its open fingers, for the
simulated sensor with its slow drift and fine noise of levels 1, 2 and 3. Missed contacts are
counted by true force, in one frame each, at the positions that episodes start from. Beside them
stands an ideal detector, which knows the shape of each contact: no test of one frame misses fewer.

Not here: the test itself (``cltp.tactile.contact.contact_test``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from statistics import NormalDist, median
from typing import Any

import numpy as np
from rich.console import Console

from cltp.tactile.contact.contact_test import NUM_FRAMES, UntouchedGel
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from sim.grasp.bodies import OBJECTS
from sim.grasp.devices import SimClock, SimSensor
from sim.grasp.fingers import Patch
from sim.grasp.rig import OFFSET_X_MM, OFFSET_Y_MM, SimRig, build
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.loop.strawberry import wilson
from tacgrasp.benchmarks.results_file import SeedResults
from tacgrasp.benchmarks.settings import ContactSettings
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tacgrasp.console import make_table_console
from tacgrasp.rig.factory import make_executor
from tacgrasp.rig.gel_sense import FRAMES_PER_READING, GelSense

NOISE_LEVELS = (1.0, 2.0, 3.0)
"""Levels of the fine noise that closings in air take in turn; 1 is the measured sensor."""

READINGS_PER_CLOSING = math.ceil(50 / FRAMES_PER_READING)
"""Readings of a closing in air: two seconds at 25 frames a second."""

MAX_FALSE_PER_CLOSING = 0.005
MAX_MISSED = 0.01
"""Target rates; the least force is the lightest with at most ``MAX_MISSED`` from it on."""

FORCES_N = (0.005, 0.01, 0.015, 0.02, 0.03, 0.04, 0.06, 0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6)
"""True forces of the contacts [N]."""

GRASPS_PER_BODY = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSample:
    """One position of one body, pressed with each of ``FORCES_N``.

    Attributes:
        missed: By force: whether the test found no contact.
        ideal_missed: By force: probability that an ideal detector finds none.
    """

    missed: tuple[bool, ...]
    ideal_missed: tuple[float, ...]


def run(settings: ContactSettings) -> bool:
    """Measure, print and write the figures.

    Returns:
        Whether at most ``MAX_FALSE_PER_CLOSING`` of the closings had a false alarm.

    Raises:
        UsageError: The file of ``--json`` holds something that is not gone on with.
    """
    closings, bodies, first = settings.num_closings, settings.num_bodies, settings.first_seed
    about = {"benchmark": "contact", "closings": closings, "first_seed": first, "bodies": bodies}
    store = SeedResults(path=settings.json, about=about)
    store.read(resume=settings.resume)
    console = make_table_console()
    air_seeds = range(first, first + closings)
    ratios = store.map_seeds(console, "closings in air", float, largest_ratio, air_seeds)
    figures = false_alarms(ratios, first)
    figures |= {key: {} for key in ("missed_by_force", "least_force_n")}
    figures |= {key: {} for key in ("ideal_missed_by_force", "ideal_least_force_n")}
    figures["approach_peak_n"] = {}
    for name in OBJECTS:
        of_bodies = store.map_seeds(
            console, name, list[ContactSample], partial(grasp_samples, name), range(bodies)
        )
        samples = [sample for of_body in of_bodies for sample in of_body]
        for prefix in ("", "ideal_"):
            missed = np.mean([getattr(s, f"{prefix}missed") for s in samples], axis=0).tolist()
            by_force = {f"{f:g}": rate for f, rate in zip(FORCES_N, missed, strict=True)}
            figures[f"{prefix}missed_by_force"][name] = by_force
            figures[f"{prefix}least_force_n"][name] = least_force_n(missed)
        peaks = store.map_seeds(
            console,
            f"{name}, approach",
            float | None,
            partial(approach_peak_n, name),
            range(bodies),
        )
        forces_n = [peak_n for peak_n in peaks if peak_n is not None]
        p50, p99 = np.percentile(forces_n, [50, 99]) if forces_n else (math.nan, math.nan)
        figures["approach_peak_n"][name] = {
            "p50": float(p50), "p99": float(p99), "max": max(forces_n, default=math.nan),
            "not_found": len(peaks) - len(forces_n),
        }  # fmt: skip
    _print(console, figures, bodies)
    store.write({"contact": figures})
    return bool(figures["false_per_closing"] <= MAX_FALSE_PER_CLOSING)


def largest_ratio(seed: int) -> float:
    """Largest response of a closing in air, over the least response of a contact.

    Each seed has a unit and a drift of its own; levels of the fine noise follow the seeds in turn.
    """
    rig = _open_rig()
    rng, level = np.random.default_rng([seed, 1]), NOISE_LEVELS[seed % len(NOISE_LEVELS)]
    unit = NoiseUnit.draw(rng, spread=spread_of(rig.sensor.spec))
    unit = replace(unit, fine_mm=level * unit.fine_mm)
    sensor = SimSensor(rig.grasp, SimClock(), rig.sensor.spec, unit, seed)
    gel = _untouched(sensor)
    return max(gel.test(sensor.read(FRAMES_PER_READING)).ratio for _ in range(READINGS_PER_CLOSING))


@lru_cache
def _open_rig() -> SimRig:
    return build("strawberry", 0)


def _untouched(sensor: SimSensor) -> UntouchedGel:
    sensor.take_reference()
    return UntouchedGel([sensor.read() for _ in range(NUM_FRAMES)], averaged=FRAMES_PER_READING)


def false_alarms(ratios: Sequence[float], first_seed: int) -> dict[str, Any]:
    """Rates of closings with a false alarm, from the largest ratio of each closing.

    Args:
        ratios: By seed.
        first_seed: Seed of the first one.
    """
    alarms = [ratio >= 1 for ratio in ratios]
    of_level = {
        f"{level:g}": alarms[(i - first_seed) % len(NOISE_LEVELS) :: len(NOISE_LEVELS)]
        for i, level in enumerate(NOISE_LEVELS)
    }
    return {
        "closings": len(alarms),
        "false_per_closing": float(np.mean(alarms)),
        "false_per_closing_interval": wilson(sum(alarms), len(alarms)),
        "false_per_closing_by_noise_level": {
            level: float(np.mean(values)) for level, values in of_level.items() if values
        },
        "median_ratio": median(ratios),
        "largest_ratio": max(ratios),
    }


def grasp_samples(name: str, seed: int) -> list[ContactSample]:
    """Press one body at some positions of the pad with each of ``FORCES_N``."""
    rig = build(name, seed)
    gel = _untouched(rig.sensor)
    rng = np.random.default_rng([seed, 9])
    samples = []
    for _ in range(GRASPS_PER_BODY):
        offset_mm = OFFSET_X_MM.quantile(rng.random()), OFFSET_Y_MM.quantile(rng.random())
        patches = rig.grasp.fingers.press_many([offset_mm] * len(FORCES_N), list(FORCES_N))
        samples.append(
            ContactSample(
                missed=tuple(not _is_felt(rig, gel, patch) for patch in patches),
                ideal_missed=tuple(ideal_missed(rig, patch) for patch in patches),
            )
        )
    return samples


def approach_peak_n(name: str, seed: int) -> float | None:
    """Largest true force of one approach [N], at the episode's own position and gripper force gain.

    None when nothing was felt.
    """
    rig = build(name, seed)
    config, _ = load(name)
    sense = GelSense(rig.sensor)
    make_executor(rig, config, contract_of(config), sense).grasp()
    return rig.truth().peak_force_n if sense.read_contact() else None


def _is_felt(rig: SimRig, gel: UntouchedGel, patch: Patch) -> bool:
    rig.grasp.contacts += 1  # a reconstruction error of its own
    rig.grasp.patch = patch
    return gel.test(rig.sensor.read(FRAMES_PER_READING)).in_contact


def ideal_missed(rig: SimRig, patch: Patch) -> float:
    """Probability that a matched filter misses a contact in one reading.

    It knows the heights of the contact and the fine noise, and meets no drift. Its response to
    noise is normal; with the heights h of the pixels the mean is z = ||h|| / sigma. ``sigma`` is
    the noise of a pixel in a reading of ``FRAMES_PER_READING`` frames less the mean of
    ``NUM_FRAMES`` frames. The false alarms of a closing are ``MAX_FALSE_PER_CLOSING``, divided
    among its readings (Bonferroni).
    """
    fine_mm = spread_of(rig.sensor.spec).fine_mm
    sigma_mm = fine_mm * math.sqrt(1 / FRAMES_PER_READING + 1 / NUM_FRAMES)
    z = float(np.linalg.norm(patch.height_mm)) / sigma_mm
    limit = NormalDist().inv_cdf(1 - MAX_FALSE_PER_CLOSING / READINGS_PER_CLOSING)
    return NormalDist().cdf(limit - z)


def least_force_n(missed: Sequence[float]) -> float | None:
    """Lightest of ``FORCES_N`` from which on at most ``MAX_MISSED`` are missed [N]; None: none."""
    least = None
    for force_n, rate in zip(reversed(FORCES_N), reversed(missed), strict=True):
        if rate > MAX_MISSED:
            break
        least = force_n
    return least


def _print(console: Console, figures: dict[str, Any], bodies: int) -> None:
    low, high = figures["false_per_closing_interval"]
    levels = ", ".join(
        f"{100 * rate:.2f} % at level {level}"
        for level, rate in figures["false_per_closing_by_noise_level"].items()
    )
    console.print(
        f"false alarm in {100 * figures['false_per_closing']:.2f} % of {figures['closings']} "
        f"closings of two seconds in air [{100 * low:.2f}, {100 * high:.2f}], target at most "
        f"{100 * MAX_FALSE_PER_CLOSING:g} %: {levels}"
    )
    console.print(
        "largest response of a closing over the least of a contact: "
        f"{figures['median_ratio']:.2f} in the median, {figures['largest_ratio']:.2f} at most"
    )
    table = number_table(
        f"Contacts missed in one frame, by true force; {GRASPS_PER_BODY * bodies} positions",
        ("object", *(f"{force_n:g} N" for force_n in FORCES_N), "least force"),
        text=("object",),
    )
    for name in figures["least_force_n"]:
        for prefix, words in (("", name), ("ideal_", "  ideal detector")):
            rates = figures[f"{prefix}missed_by_force"][name].values()
            least = figures[f"{prefix}least_force_n"][name]
            cells = [f"{100 * rate:.0f} %" for rate in rates]
            table.add_row(words, *cells, "none" if least is None else f"{least:g} N")
    console.print(table)
    for name, peak in figures["approach_peak_n"].items():
        console.print(
            f"approach to a {name}: true force at first touch {peak['p50']:.2f} N in the median, "
            f"{peak['max']:.2f} N at most; {peak['not_found']} of {bodies} not found"
        )
    console.print(f"least force: at most {100 * MAX_MISSED:g} % are missed at it and above")
