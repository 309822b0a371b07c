"""``tacgrasp bench growth``: the force that a reflex feels in one frame, against the truth.

A body is gripped and felt at rest; then the force becomes another one, as of a gripper that has
changed, and one more frame is seen. What is felt in it is the force at rest times the growth of the
indentation (``cltp.tactile.shear.held_indentation``), while the gel has drifted on.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track

from cltp.tactile.cloud import FloatArray, heights_at
from cltp.tactile.measure import contact_state
from cltp.tactile.sensor_noise import NoiseUnit, SlowDrift
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.shear.contact_shape import grid_of
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.held_indentation import HeldIndentation, growth_power
from sim.grasp import fingers
from sim.grasp.bodies import Range
from sim.grasp.drawn.loads import BODIES
from sim.grasp.rig import build
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.settings import GrowthSettings
from tacgrasp.console import make_table_console
from tacgrasp.rig.gel_sense import CLEAR_N, GelSense

REST_N = Range(low=0.2, high=3.0, log=True)
CHANGE = Range(low=0.5, high=3.0, log=True)
"""True force at rest [N], and the factor by which it changes; one contact in five stays."""

STAYS = 0.2

OFFSET_MM = (9.0, 7.0)
"""Largest offsets of the body on the pad along x and y [mm]; the nearer ones are drawn as often."""

WAIT_S = Range(low=0.1, high=5.0, log=True)
"""Time for which the gel drifts between rest and the frame [s]."""

QUIET_FRAMES = 10
"""Frames at rest, as in ``tacgrasp.runtime.reflex_hold``."""

GREW = 1.3
"""Least true growth that counts as one; the power is fitted to these."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GrowthSample:
    """A contact whose force has changed.

    Attributes:
        body: Kind of the body.
        rest_n, now_n: True force at rest, and in the frame [N].
        felt_n: Force that is felt at rest [N].
        growth: Growth of the force as that frame has it.
        is_cut: Whether the pad's edge cuts the contact.
        read_ms: Time of a core that reading the frame took [ms].
    """

    body: str
    rest_n: float
    now_n: float
    felt_n: float
    growth: float
    is_cut: bool
    read_ms: float

    @property
    def true_growth(self) -> float:
        return self.now_n / self.rest_n

    @property
    def growth_error(self) -> float:
        """Logarithm of the growth over the true one."""
        return math.log(self.growth / self.true_growth)

    @property
    def felt_error(self) -> float:
        """Logarithm of the force that the reflex feels in the frame over the true one."""
        return math.log(self.felt_n * self.growth / self.now_n)


Chosen = Callable[[GrowthSample], bool]


def _of_body(name: str) -> Chosen:
    return lambda s: s.true_growth >= GREW and s.body == name


GROUPS: dict[str, Chosen] = {
    "all": lambda s: True,
    "weaker, below 0.8": lambda s: s.true_growth < 0.8,
    "the same": lambda s: s.rest_n == s.now_n,
    "1.3 to 2 times": lambda s: GREW <= s.true_growth < 2,
    "2 to 3 times": lambda s: s.true_growth >= 2,
    **{f"grown, {name}": _of_body(name) for name in BODIES},
    "grown, from below 0.8 N": lambda s: s.true_growth >= GREW and s.rest_n < 0.8,
    "grown, from 0.8 N on": lambda s: s.true_growth >= GREW and s.rest_n >= 0.8,
    "grown, cut by the edge": lambda s: s.true_growth >= GREW and s.is_cut,
    "grown, not cut": lambda s: s.true_growth >= GREW and not s.is_cut,
}
"""Groups of contacts in the table, by their names."""


def run(settings: GrowthSettings) -> None:
    """Draw contacts; print and write the figures.

    Raises:
        UsageError: The sensor measures no shear, or no contact was felt.
        TouchError: The sensor is unknown.
    """
    console, sensor = make_table_console(), sensor_named(settings.sensor)
    if sensor.shear_grid is None:
        raise UsageError(f"{sensor.name} measures no shear; take taxels or gelsight_mini_markers")
    seeds = range(settings.first_seed, settings.first_seed + settings.contacts)
    shown = track(seeds, "contacts", console=console, disable=not console.is_terminal)
    drawn = [growth_sample(seed, sensor.name) for seed in shown]
    samples = [each for each in drawn if each is not None]
    if not samples:
        raise UsageError(f"none of {len(drawn)} contacts was felt; take more --contacts")
    figures = figures_of(samples, sensor)
    _print(console, figures, sensor)
    write_figures(settings.json, figures)


def growth_sample(seed: int, sensor_name: str) -> GrowthSample | None:
    """Grip the body of a seed, change its force and see it; None where it is hardly felt."""
    rng = np.random.default_rng([seed, 83])
    name, off_centre = str(rng.choice(BODIES)), rng.random()
    offset_mm = (
        off_centre * OFFSET_MM[0] * rng.uniform(-1, 1),
        off_centre * OFFSET_MM[1] * rng.uniform(-1, 1),
    )
    rest_n = REST_N.quantile(rng.random())
    change = 1.0 if rng.random() < STAYS else CHANGE.quantile(rng.random())
    rig = build(
        name, seed, sensor_name=sensor_name, start_offset_mm=offset_mm, gripper_force_gain=1.0
    )
    sense = GelSense(rig.sensor)
    sense.take_reference()
    rig.gripper.grip(rest_n)
    cloud = sense.read()
    felt = sense.felt_force(cloud)
    quiet = [rig.sensor.newest_shear() for _ in range(QUIET_FRAMES)]
    if change != 1.0:
        rig.gripper.grip(rest_n * change)
    newest = rig.sensor.newest_shear()
    if felt is None or felt.value < CLEAR_N or newest is None or None in quiet:
        return None
    held = HeldIndentation([each for each in quiet if each is not None])
    drifted = _drifted(newest, rng)
    began_s = time.thread_time()
    held.see(drifted)
    growth = held.newest_growth
    read_ms = 1000 * (time.thread_time() - began_s)
    if not growth:
        return None
    return GrowthSample(
        body=name,
        rest_n=rest_n,
        now_n=rest_n * change,
        felt_n=felt.value,
        growth=growth,
        is_cut=bool(contact_state(cloud, in_contact=True).cut),
        read_ms=read_ms,
    )


def _drifted(field: ShearField, rng: np.random.Generator) -> ShearField:
    """A frame of a gel that has drifted on for a drawn time since it was seen at rest."""
    sensor = field.sensor
    drift = SlowDrift.draw(rng, fingers.grid_of(sensor), sensor, NoiseUnit.draw(rng))
    change_mm = (drift.at(WAIT_S.quantile(rng.random())) - drift.at(0.0)).astype(np.float64)
    grid = grid_of(sensor)
    cells = grid.cells_of(field.positions_mm)
    moved = np.array(field.displacement_mm)
    moved[:, 2] += heights_at(change_mm, grid.x[cells], grid.y[cells], sensor)
    return replace(field, displacement_mm=moved)


def fitted_power(samples: Sequence[GrowthSample], in_use: float) -> float | None:
    """Power of the volume's growth that these samples suggest, by their median; None for none."""
    powers = [
        math.log(s.true_growth) * in_use / math.log(s.growth)
        for s in samples
        if s.true_growth >= GREW and s.growth > 1
    ]
    return float(np.median(powers)) if powers else None


def figures_of(samples: Sequence[GrowthSample], sensor: SensorSpec) -> dict[str, Any]:
    """Errors of growth and felt force by group, the fitted power, and the time of a frame."""
    rows = {name: [s for s in samples if chosen(s)] for name, chosen in GROUPS.items()}
    return {
        "sensor": sensor.name,
        "groups": {name: _errors(group) for name, group in rows.items() if group},
        "power": fitted_power(samples, growth_power(sensor)),
        "read_ms_p99": float(np.percentile([s.read_ms for s in samples], 99)),
    }


def _errors(samples: Sequence[GrowthSample]) -> dict[str, Any]:
    return {
        "contacts": len(samples),
        "ln_growth": _quantiles(np.array([s.growth_error for s in samples])),
        "ln_felt": _quantiles(np.array([s.felt_error for s in samples])),
    }


def _quantiles(errors: FloatArray) -> dict[str, float]:
    low, middle, high = (float(each) for each in np.percentile(errors, (5, 50, 95)))
    return {"p5": low, "p50": middle, "p95": high, "spread": float(errors.std())}


def _print(console: Console, figures: dict[str, Any], sensor: SensorSpec) -> None:
    columns = ["contacts", "number"]
    columns += [f"ln {what}: {part}" for what in ("growth", "felt") for part in _PARTS]
    title = f"Force felt in one frame over the true one, {sensor.name}"
    table = number_table(title, columns, ("contacts",))
    for name, row in figures["groups"].items():
        numbers = [row[key][part] for key in ("ln_growth", "ln_felt") for part in _PARTS]
        table.add_row(name, str(row["contacts"]), *(f"{each:+.2f}" for each in numbers))
    console.print(table)
    power = "-" if figures["power"] is None else f"{figures['power']:.2f}"
    console.print(
        f"power of the volume's growth, fitted: {power}; in use {growth_power(sensor):g}; "
        f"a frame takes {figures['read_ms_p99']:.2f} ms (p99)"
    )


_PARTS = ("p5", "p50", "p95", "spread")
