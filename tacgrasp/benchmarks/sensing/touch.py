"""``tacgrasp bench touch``: errors of the direct measurement of a contact.

It compares ``cltp.tactile.measure`` with the truth of simulated grasps under a real sensor's noise:
force, depth, position, area, and the rates of missed and of falsely detected contacts. Seeds lie
below the benchmark's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track

from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from sim.grasp.bodies import OBJECTS, Range
from sim.grasp.rig import OFFSET_X_MM, OFFSET_Y_MM, SimRig, build
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.settings import TouchSettings

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


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspSample:
    """Truth and measurement of one grasp.

    Attributes:
        force_n: True force [N].
        depth_mm: True largest indentation [mm].
        offset_mm: True position of the body's nearest point [mm].
        area_fraction: True fraction of the sensing area under pressure.
        state: The measurement.
    """

    force_n: float
    depth_mm: float
    offset_mm: tuple[float, float]
    area_fraction: float
    state: ContactState

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
        of_object = [sample for seed in seeds for sample in _samples(name, seed)]
        figures["objects"][name] = _figures(of_object)
        samples += of_object
    rigs = (build("cherry_tomato", seed) for seed in range(10 * bodies))
    imagined = [contact_state(rig.sensor.read()).in_contact for rig in rigs]
    figures["imagined_share"] = float(np.mean(imagined))
    figures["missed_share"] = {
        f"{low}-{high} N": _missed([s for s in samples if low <= s.force_n < high])
        for low, high in ((0.1, 0.15), (0.15, 0.22), (0.22, 0.33), (0.33, 0.5), (0.5, 0.8))
    }
    _print(console, figures)
    write_figures(settings.json, figures)


def _samples(name: str, seed: int) -> list[GraspSample]:
    rig = build(name, seed)
    rng = np.random.default_rng([seed, 9])
    offsets = [
        (OFFSET_X_MM.quantile(rng.random()), OFFSET_Y_MM.quantile(rng.random()))
        for _ in range(GRASPS_PER_BODY)
    ]
    forces = [FORCES_N[name].quantile(rng.random()) for _ in offsets]
    return [_sample(rig, i, offsets[i], forces[i]) for i in range(len(offsets))]


def _sample(
    rig: SimRig, number: int, offset_mm: tuple[float, float], force_n: float
) -> GraspSample:
    grasp = rig.grasp
    grasp.contacts = number  # a drift of its own
    grasp.patch = patch = grasp.fingers.press(offset_mm, force_n)
    return GraspSample(
        force_n=force_n,
        depth_mm=float(patch.height_mm.max()),
        offset_mm=offset_mm,
        area_fraction=float((patch.pressure_kpa > 0).mean()),
        state=contact_state(rig.sensor.read()),
    )


def _missed(samples: list[GraspSample]) -> float:
    return float(np.mean([not s.state.in_contact for s in samples])) if samples else float("nan")


def _figures(samples: list[GraspSample]) -> dict[str, float]:
    touching = [s for s in samples if s.state.in_contact]
    firm = [s for s in touching if s.force_n >= FIRM_N]
    force = np.array([np.log(s.state.force_n / s.force_n) for s in firm])
    depth = np.array([s.state.depth_mm - s.depth_mm for s in touching])
    area = np.array([np.log(s.state.area_fraction / s.area_fraction) for s in firm])
    inside = [s for s in firm if s.is_inside]
    x = np.array([abs(s.state.x_mm - s.offset_mm[0]) for s in inside])
    y = np.array([abs(s.state.y_mm - s.offset_mm[1]) for s in inside])
    return {
        "grasps": len(samples),
        "force_ln_bias": float(np.median(force)),
        "force_ln_spread": float(force.std()),
        "depth_error_mm": float(np.median(np.abs(depth))),
        "area_ln_bias": float(np.median(area)),
        "x_error_mm": float(np.median(x)),
        "y_error_mm": float(np.median(y)),
    }


def _print(console: Console, figures: dict[str, Any]) -> None:
    title = "Direct measurement against the truth (medians; force from 0.4 N)"
    columns = ("object", "grasps", "ln force: bias", "spread", "depth mm", "ln area: bias")
    table = number_table(title, (*columns, "x mm", "y mm"), ("object",))
    for name, row in figures["objects"].items():
        table.add_row(
            name,
            str(row["grasps"]),
            f"{row['force_ln_bias']:+.2f}",
            f"{row['force_ln_spread']:.2f}",
            f"{row['depth_error_mm']:.3f}",
            f"{row['area_ln_bias']:+.2f}",
            f"{row['x_error_mm']:.2f}",
            f"{row['y_error_mm']:.2f}",
        )
    console.print(table)
    console.print(f"contact falsely detected on an untouched gel: {figures['imagined_share']:.0%}")
    missed = ", ".join(f"{band} {rate:.0%}" for band, rate in figures["missed_share"].items())
    console.print(f"contact missed at a true force of {missed}")
