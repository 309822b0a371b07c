"""``tacgrasp bench touch``: what measuring a contact directly from a cloud is worth.

Compares ``cltp.tactile.measure`` with the truth of simulated grasps, with the noise of a real
sensor: the force law, depth, place, area, and how often contact is missed or imagined. Seeds below
the benchmark's.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from sim.grasp.bodies import OBJECTS, Range
from sim.grasp.rig import OFFSET_X_MM, OFFSET_Y_MM, SimRig, build

FORCES_N = {
    "strawberry": Range(low=0.1, high=5, log=True),
    "cherry_tomato": Range(low=0.1, high=3, log=True),
    "egg": Range(low=0.3, high=8, log=True),
    "peg": Range(low=0.5, high=14, log=True),
}
"""Range of true forces by object."""

FIRM_N = 0.4
"""Forces from here on count for the force law."""

GRASPS_PER_BODY = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class Felt:
    """One grasp: truth and measurement.

    Attributes:
        force_n: True force.
        depth_mm: True largest indentation.
        offset_mm: True place of the body's nearest point.
        area_share: True share of the field under pressure.
        state: What was measured.
    """

    force_n: float
    depth_mm: float
    offset_mm: tuple[float, float]
    area_share: float
    state: ContactState

    @property
    def whole(self) -> bool:
        """Whether the contact lies well inside the pad, so that its place can be known.

        A peg is longer than the pad: the y of its middle can't be felt, and is not meant to be.
        """
        return abs(self.offset_mm[0]) < 7 and abs(self.offset_mm[1]) < 4.5


def run(bodies: int, json_path: Path | None) -> dict[str, Any]:
    """Measure ``bodies`` bodies of every kind, print the table, return (and write) the figures."""
    console = Console()
    figures: dict[str, Any] = {"objects": {}}
    felt: list[Felt] = []
    for name in OBJECTS:
        of_object: list[Felt] = []
        hidden = not console.is_terminal
        for seed in track(range(bodies), name, console=console, disable=hidden):
            of_object += _feel(name, seed)
        figures["objects"][name] = _figures(of_object)
        felt += of_object
    untouched = [_untouched(seed) for seed in range(10 * bodies)]
    figures["imagined_share"] = float(np.mean([state.in_contact for state in untouched]))
    figures["missed_share"] = {
        f"{low}-{high} N": _missed([f for f in felt if low <= f.force_n < high])
        for low, high in ((0.1, 0.15), (0.15, 0.22), (0.22, 0.33), (0.33, 0.5), (0.5, 0.8))
    }
    _print(console, figures)
    if json_path is not None:
        json_path.write_text(json.dumps(figures, indent=1), encoding="utf-8")
    return figures


def _feel(name: str, seed: int) -> list[Felt]:
    rig = build(name, seed)
    rng = np.random.default_rng([seed, 9])
    offsets = [
        (OFFSET_X_MM.quantile(rng.random()), OFFSET_Y_MM.quantile(rng.random()))
        for _ in range(GRASPS_PER_BODY)
    ]
    forces = [FORCES_N[name].quantile(rng.random()) for _ in offsets]
    return [_felt(rig, i, offsets[i], forces[i]) for i in range(len(offsets))]


def _felt(rig: SimRig, number: int, offset_mm: tuple[float, float], force_n: float) -> Felt:
    grasp = rig.grasp
    grasp.contacts = number  # a drift of its own
    grasp.patch = patch = grasp.fingers.press(offset_mm, force_n)
    return Felt(
        force_n=force_n,
        depth_mm=float(patch.height_mm.max()),
        offset_mm=offset_mm,
        area_share=float((patch.pressure_kpa > 0).mean()),
        state=contact_state(rig.sensor.read()),
    )


def _untouched(seed: int) -> ContactState:
    return contact_state(build("cherry_tomato", seed).sensor.read())


def _missed(felt: list[Felt]) -> float:
    return float(np.mean([not one.state.in_contact for one in felt])) if felt else float("nan")


def _figures(felt: list[Felt]) -> dict[str, float]:
    seen = [one for one in felt if one.state.in_contact]
    firm = [one for one in seen if one.force_n >= FIRM_N]
    force = np.array([np.log(one.state.force_n / one.force_n) for one in firm])
    depth = np.array([one.state.depth_mm - one.depth_mm for one in seen])
    area = np.array([np.log(one.state.area_fraction / one.area_share) for one in firm])
    inside = [one for one in firm if one.whole]
    x, y = (
        np.array([abs(place(one) - one.offset_mm[axis]) for one in inside])
        for axis, place in ((0, lambda one: one.state.x_mm), (1, lambda one: one.state.y_mm))
    )
    return {
        "grasps": len(felt),
        "force_ln_bias": float(np.median(force)),
        "force_ln_spread": float(force.std()),
        "depth_error_mm": float(np.median(np.abs(depth))),
        "area_ln_bias": float(np.median(area)),
        "x_error_mm": float(np.median(x)),
        "y_error_mm": float(np.median(y)),
    }


def _print(console: Console, figures: dict[str, Any]) -> None:
    table = Table(title="Direct measurement against the truth (medians; force from 0.4 N)")
    table.add_column("object")
    for column in (
        "grasps",
        "ln force: bias",
        "spread",
        "depth mm",
        "ln area: bias",
        "x mm",
        "y mm",
    ):
        table.add_column(column, justify="right")
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
    console.print(f"contact imagined on an untouched gel: {figures['imagined_share']:.0%}")
    missed = ", ".join(f"{band} {share:.0%}" for band, share in figures["missed_share"].items())
    console.print(f"contact missed at a true force of {missed}")
