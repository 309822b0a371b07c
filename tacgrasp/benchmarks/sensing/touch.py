"""``tacgrasp bench touch``: errors of the direct measurement of a contact.

It compares ``cltp.tactile.measure`` with the truth of simulated grasps under a real sensor's noise:
force, depth, position, area, and the rates of missed and of falsely detected contacts. As in the
loop, the gel with open fingers is the reference of each reading. Beside it stand readings without
a reference, whose drift has gone on for any time. Seeds lie below the benchmark's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import track

from cltp.tactile.measure import STIFFNESS_N_PER_MM3, contact_state
from cltp.tactile.sensor_noise import NoiseUnit
from cltp.tactile.states import ContactState
from sim.grasp.bodies import OBJECTS, Range
from sim.grasp.devices import SimClock, SimSensor
from sim.grasp.fingers import Patch
from sim.grasp.rig import OFFSET_X_MM, OFFSET_Y_MM, SimRig, build
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.settings import TouchSettings
from tacgrasp.rig.gel_sense import GelSense

FORCES_N = {
    "strawberry": Range(low=0.1, high=5, log=True),
    "cherry_tomato": Range(low=0.1, high=3, log=True),
    "egg": Range(low=0.3, high=8, log=True),
    "peg": Range(low=0.5, high=14, log=True),
}
"""Range of true forces by object."""

FIRM_N = 0.4
"""Smallest true force that counts for the force law [N]."""

GRASPS_PER_BODY = 4

UNTOUCHED_SEED = 5000
"""Random seed of the first nearly untouched frame."""

UNTOUCHED_N = Range(low=0.0, high=0.02)
"""True force of these frames [N]."""

SINCE_REFERENCE_S = Range(low=0.5, high=30.0, log=True)
"""Time between their reference and them [s]: a closing takes two seconds, a hold more."""

OPEN_FRAME_S = 0.5
"""Time between the frames that are read meanwhile, of open fingers [s]."""

MOST_FELT_N = 0.2
"""Target: at most this is felt in 95 % of them [N]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspSample:
    """Truth and measurement of one grasp.

    Attributes:
        force_n: True force [N].
        depth_mm: True largest indentation [mm].
        offset_mm: True position of the body's nearest point [mm].
        area_fraction: True fraction of the sensing area under pressure.
        state: The measurement against the open fingers.
        without_reference: The measurement of a frame whose drift nothing has taken away.
    """

    force_n: float
    depth_mm: float
    offset_mm: tuple[float, float]
    area_fraction: float
    state: ContactState
    without_reference: ContactState

    @property
    def is_inside(self) -> bool:
        """Whether the contact lies well inside the pad, so that its position can be measured.

        A peg is longer than the pad: the y of its middle does not show.
        """
        return abs(self.offset_mm[0]) < 7 and abs(self.offset_mm[1]) < 4.5


def run(settings: TouchSettings) -> None:
    """Measure some bodies of each kind; print and write the figures."""
    console, bodies = Console(), settings.bodies
    figures: dict[str, Any] = {"objects": {}}
    samples: list[GraspSample] = []
    for name in OBJECTS:
        seeds = track(range(bodies), name, console=console, disable=not console.is_terminal)
        of_object = [sample for seed in seeds for sample in grasp_samples(name, seed)]
        figures["objects"][name] = _figures(of_object)
        samples += of_object
    figures["stiffness_n_per_mm3"] = fitted_stiffness(samples)
    rigs = (build("cherry_tomato", seed) for seed in range(10 * bodies))
    imagined = [contact_state(rig.sensor.read()).in_contact for rig in rigs]
    figures["imagined_share"] = float(np.mean(imagined))
    figures |= felt_untouched(settings.untouched)
    figures["missed_share"] = {
        f"{low}-{high} N": _missed([s for s in samples if low <= s.force_n < high])
        for low, high in ((0.1, 0.15), (0.15, 0.22), (0.22, 0.33), (0.33, 0.5), (0.5, 0.8))
    }
    _print(console, figures)
    write_figures(settings.json, figures)


def grasp_samples(name: str, seed: int) -> list[GraspSample]:
    """Press one body at some positions, each with a force of its own."""
    rig = build(name, seed)
    rng = np.random.default_rng([seed, 9])
    offsets = [
        (OFFSET_X_MM.quantile(rng.random()), OFFSET_Y_MM.quantile(rng.random()))
        for _ in range(GRASPS_PER_BODY)
    ]
    forces = [FORCES_N[name].quantile(rng.random()) for _ in offsets]
    patches = [rig.grasp.fingers.press(*each) for each in zip(offsets, forces, strict=True)]
    twin = build(name, seed)
    return [_sample(rig, twin, number, patch) for number, patch in enumerate(patches)]


def _sample(rig: SimRig, twin: SimRig, number: int, patch: Patch) -> GraspSample:
    """Read a contact against the gel before it; the twin's sensor never takes a reference."""
    for grasp in (rig.grasp, twin.grasp):
        grasp.contacts = number  # a reconstruction error of its own
    rig.grasp.patch, twin.grasp.patch = None, patch
    sense = GelSense(rig.sensor)
    sense.take_reference()
    rig.grasp.patch = patch
    cloud = sense.read()
    return GraspSample(
        force_n=patch.force_n,
        depth_mm=float(patch.height_mm.max()),
        offset_mm=patch.offset_mm,
        area_fraction=float((patch.pressure_kpa > 0).mean()),
        state=contact_state(cloud, in_contact=sense.in_contact(cloud)),
        without_reference=contact_state(twin.sensor.read()),
    )


def fitted_stiffness(samples: Sequence[GraspSample]) -> float:
    """Force over locally displaced volume that these samples suggest [N/mm³], by their median."""
    ratios = [
        s.force_n / s.state.force_n for s in samples if s.force_n >= FIRM_N and s.state.force_n > 0
    ]
    return STIFFNESS_N_PER_MM3 * float(np.median(ratios))


def felt_untouched(num: int) -> dict[str, Any]:
    """What is felt on nearly untouched frames, each of its own unit and drift.

    ``felt_untouched`` is what the loop feels: tested against the open fingers, some time ago.
    ``felt_untouched_untested`` takes every such frame for a contact.
    """
    contacts = [_light_contact(UNTOUCHED_SEED + body) for body in range(20)]
    felt_n: list[float] = []
    untested_n: list[float] = []
    for seed in range(UNTOUCHED_SEED, UNTOUCHED_SEED + num):
        rng, (rig, patch) = np.random.default_rng([seed, 1]), contacts[seed % len(contacts)]
        clock = SimClock()
        clock.advance(rng.uniform(0, 600))
        sensor = SimSensor(rig.grasp, clock, rig.sensor.spec, NoiseUnit.draw(rng), seed)
        rig.grasp.patch = None
        sense = GelSense(sensor)
        sense.take_reference()
        for _ in range(round(SINCE_REFERENCE_S.quantile(rng.random()) / OPEN_FRAME_S)):
            clock.advance(OPEN_FRAME_S)
            sense.in_contact(sense.read())
        rig.grasp.patch = patch
        cloud = sense.read()
        felt = sense.felt_force(cloud)
        felt_n.append(0.0 if felt is None else felt.value)
        untested_n.append(contact_state(cloud, in_contact=True).force_n)
    return {
        "felt_untouched": _quantiles(felt_n),
        "felt_untouched_untested": _quantiles(untested_n),
    }


def _light_contact(seed: int) -> tuple[SimRig, Patch]:
    """A berry that touches the gel of its rig with a force of ``UNTOUCHED_N``."""
    rig, rng = build("strawberry", seed), np.random.default_rng([seed, 9])
    offset_mm = OFFSET_X_MM.quantile(rng.random()), OFFSET_Y_MM.quantile(rng.random())
    return rig, rig.grasp.fingers.press(offset_mm, UNTOUCHED_N.quantile(rng.random()))


def _quantiles(felt_n: Sequence[float]) -> dict[str, float]:
    return {
        "n": len(felt_n),
        "p50_n": float(np.median(felt_n)),
        "p95_n": float(np.percentile(felt_n, 95)),
        "within_0_2_n": float(np.mean(np.array(felt_n) <= MOST_FELT_N)),
    }


def _missed(samples: list[GraspSample]) -> float:
    return float(np.mean([not s.state.in_contact for s in samples])) if samples else float("nan")


def _figures(samples: list[GraspSample]) -> dict[str, float]:
    touching = [s for s in samples if s.state.in_contact]
    firm = [s for s in touching if s.force_n >= FIRM_N]
    force = log_errors(firm)
    light = log_errors([s for s in touching if s.force_n < FIRM_N])
    alone = [s.without_reference for s in samples if s.force_n >= FIRM_N]
    forces = [s.force_n for s in samples if s.force_n >= FIRM_N]
    felt = [(a.force_n, f) for a, f in zip(alone, forces, strict=True) if a.force_n > 0]
    without = np.array([np.log(felt_n / force_n) for felt_n, force_n in felt])
    depth = np.array([s.state.depth_mm - s.depth_mm for s in touching])
    area = np.array([np.log(s.state.area_fraction / s.area_fraction) for s in firm])
    inside = [s for s in firm if s.is_inside]
    x = np.array([abs(s.state.x_mm - s.offset_mm[0]) for s in inside])
    y = np.array([abs(s.state.y_mm - s.offset_mm[1]) for s in inside])
    return {
        "grasps": len(samples),
        "force_ln_bias": float(np.median(force)),
        "force_ln_spread": float(force.std()),
        "light_force_ln_bias": float(np.median(light)) if len(light) else float("nan"),
        "light_force_ln_spread": float(light.std()) if len(light) else float("nan"),
        "without_reference_ln_bias": float(np.median(without)),
        "without_reference_ln_spread": float(without.std()),
        "depth_error_mm": float(np.median(np.abs(depth))),
        "area_ln_bias": float(np.median(area)),
        "x_error_mm": float(np.median(x)),
        "y_error_mm": float(np.median(y)),
    }


def log_errors(samples: Sequence[GraspSample]) -> NDArray[np.float64]:
    """Errors ln of the measured over the true force, of the samples with a measured force."""
    return np.array([np.log(s.state.force_n / s.force_n) for s in samples if s.state.force_n > 0])


def _print(console: Console, figures: dict[str, Any]) -> None:
    title = "Direct measurement against the truth (medians; force from 0.4 N)"
    columns = (
        "object", "grasps", "ln force: bias", "spread", "below 0.4 N: bias", "spread",
        "no reference: bias", "spread", "depth mm", "ln area: bias",
    )  # fmt: skip
    table = number_table(title, (*columns, "x mm", "y mm"), ("object",))
    for name, row in figures["objects"].items():
        table.add_row(
            name,
            str(row["grasps"]),
            f"{row['force_ln_bias']:+.2f}",
            f"{row['force_ln_spread']:.2f}",
            f"{row['light_force_ln_bias']:+.2f}",
            f"{row['light_force_ln_spread']:.2f}",
            f"{row['without_reference_ln_bias']:+.2f}",
            f"{row['without_reference_ln_spread']:.2f}",
            f"{row['depth_error_mm']:.3f}",
            f"{row['area_ln_bias']:+.2f}",
            f"{row['x_error_mm']:.2f}",
            f"{row['y_error_mm']:.2f}",
        )
    console.print(table)
    console.print(
        f"contact imagined by depth alone, without reference: {figures['imagined_share']:.0%}"
    )
    missed = ", ".join(f"{band} {rate:.0%}" for band, rate in figures["missed_share"].items())
    console.print(f"contact missed at a true force of {missed}")
    console.print(
        f"force over local volume, fitted: {figures['stiffness_n_per_mm3']:.3f} N/mm³; in use "
        f"{STIFFNESS_N_PER_MM3:g} (cltp.tactile.measure.STIFFNESS_N_PER_MM3)"
    )
    for key, words in (("", "as in the loop"), ("_untested", "if each is taken for a contact")):
        felt = figures[f"felt_untouched{key}"]
        console.print(
            f"felt on {felt['n']} frames with 0 to {UNTOUCHED_N.high:g} N, {words}: median "
            f"{felt['p50_n']:.2f} N, 95 % {felt['p95_n']:.2f} N; at most {MOST_FELT_N:g} N in "
            f"{felt['within_0_2_n']:.1%}"
        )
