"""Contacts for data sets: draw series, press them into gels, label them from the truth.

A group of series shares a gel and is solved together; which group a series is in, and all that is
drawn, follows from the seed and its number alone, so that any number of workers makes the same
contacts. What is made is stored by ``cltp.data.dataset``; heights are clean.

Not here: files and processes (``tacgrasp.datasets.generate``), noise
(``cltp.tactile.sensor_noise``).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor

from cltp.data.contact import Contact, Gel, Split
from cltp.tactile.sensors import SensorSpec
from sim.gel.layer import ElasticLayer, GelMaterial, Press
from sim.grasp.rig import BENCHMARK_SEED
from sim.starter.series import COLUMNS, ROWS, Series, draw_series, num_loads
from sim.tcl3d.labels import in_contact, label

GELS = (
    GelMaterial(thickness_mm=3.6, young_mpa=0.145, poisson=0.495),
    GelMaterial(thickness_mm=3.4, young_mpa=0.145, poisson=0.480),
    GelMaterial(thickness_mm=3.6, young_mpa=0.145, poisson=0.490),
    GelMaterial(thickness_mm=3.9, young_mpa=0.145, poisson=0.470),
    GelMaterial(thickness_mm=4.2, young_mpa=0.145, poisson=0.490),
    GelMaterial(thickness_mm=4.6, young_mpa=0.145, poisson=0.480),
)
"""Gels that contacts are made under; the first is the GelSight Mini's.

Source: h 3.4-4.6 mm and nu 0.47-0.49 transferred to real touch in the notes' trial; a handful
instead of a continuum because each has a kernel that is expensive to make.
"""

GROUP_SERIES = 16
"""Series in a group. Two to three contacts each, half of them soft and half rigid: batches of about
eight, which fit the cache (twice as many take a quarter longer)."""

GROUP_CONTACTS = 40

VALIDATION_SHARE, TEST_SHARE = 0.04, 0.06
"""Shares of series, our choice; the rest is for training."""

_TOLERANCE = 1e-3  # of the solver: heights within about 1 µm, as they are stored

DEEPEST_MM = 2.4
"""Presses that would go deeper are made lighter: the sliver of a peg at the pad's edge, bearing all
of the force, would sink deeper than the gel is thick. Our choice: two thirds of the thickness, from
where linear elasticity says little."""

_LIGHTER_TRIES = 4


def make_group(seed: int, group: int, sensor: SensorSpec) -> list[Contact]:
    """Make the contacts of one group, in the order of their series.

    Args:
        seed: Of the data set, below ``BENCHMARK_SEED``.
        group: Its number; it holds series ``GROUP_SERIES * group`` and on.
        sensor: Whose field is pressed.

    Returns:
        ``GROUP_CONTACTS`` contacts.

    Raises:
        ValueError: A seed that belongs to the benchmark, or a negative number.
    """
    if not 0 <= seed < BENCHMARK_SEED or group < 0:
        raise ValueError(
            f"data are made from seeds 0 to {BENCHMARK_SEED - 1} (larger ones are for benchmarks) "
            f"and groups from 0, got seed {seed}, group {group}"
        )
    gel = GELS[int(np.random.default_rng([seed, group, 2]).integers(len(GELS)))]
    first = GROUP_SERIES * group
    series = [draw_series(seed, first + i, sensor) for i in range(GROUP_SERIES)]
    made: dict[int, list[Contact]] = {}
    for soft in (True, False):
        members = [each for each in series if (each.modulus_mpa is not None) == soft]
        if members:
            made |= _pressed(seed, members, gel, sensor)
    return [contact for each in series for contact in made[each.number]]


class _Pressed(NamedTuple):
    """A solved batch: pressure (B, H, W) [kPa], surface (B, H, W) [mm], force (B,) [N]."""

    pressure_kpa: Tensor
    height_mm: Tensor
    force_n: Tensor

    @classmethod
    def of(cls, press: Press) -> _Pressed:
        return cls(press.pressure_kpa, press.height_mm, press.force_n)

    def replaced_where(self, chosen: Tensor, other: _Pressed) -> _Pressed:
        """These contacts, but those of ``other`` where ``chosen`` (B,)."""
        grid = chosen[:, None, None]
        return _Pressed(
            torch.where(grid, other.pressure_kpa, self.pressure_kpa),
            torch.where(grid, other.height_mm, self.height_mm),
            torch.where(chosen, other.force_n, self.force_n),
        )


def _pressed(
    seed: int, members: list[Series], gel: GelMaterial, sensor: SensorSpec
) -> dict[int, list[Contact]]:
    """Press series of one kind, soft or rigid, load by load."""
    made: dict[int, list[Contact]] = {each.number: [] for each in members}
    pressure: Tensor | None = None
    for step in range(max(len(each.loads) for each in members)):
        going = [i for i, each in enumerate(members) if len(each.loads) > step]
        if pressure is not None:
            pressure = pressure[going]
        members = [members[i] for i in going]
        with torch.inference_mode():
            press = _press(members, step, gel, sensor, pressure)
        pressure = press.pressure_kpa
        touching = in_contact(pressure, sensor.width_mm / COLUMNS)
        for i, each in enumerate(members):
            height_mm = press.height_mm[i].numpy()
            state = label(
                height_mm=height_mm,
                pressure_kpa=pressure[i].numpy(),
                touching=touching[i],
                force_n=float(press.force_n[i]),
                sensor=sensor,
                shape=each.shape,
                texture=each.texture,
            )
            made[each.number].append(
                Contact(
                    height_mm=height_mm,
                    sensor=sensor,
                    state=state,
                    object=each.object,
                    series=each.number,
                    split=split_of(seed, each.number),
                    gel=Gel(
                        thickness_mm=gel.thickness_mm,
                        young_mpa=gel.young_mpa,
                        poisson=gel.poisson,
                    ),
                    seed=seed,
                )
            )
    return made


def _press(
    members: list[Series],
    step: int,
    gel: GelMaterial,
    sensor: SensorSpec,
    start: Tensor | None,
) -> _Pressed:
    gaps = torch.from_numpy(np.stack([each.gap_mm for each in members]).astype(np.float32))
    loads = torch.tensor([each.loads[step] for each in members], dtype=torch.float32)
    moduli = [each.modulus_mpa for each in members if each.modulus_mpa is not None]
    layer = ElasticLayer(
        gel,
        rows=ROWS,
        columns=COLUMNS,
        pitch_mm=sensor.width_mm / COLUMNS,
        body_modulus_mpa=torch.tensor(moduli) if moduli else None,
    )
    press = layer.press_to_force if moduli else layer.press_to_depth
    pressed = _Pressed.of(press(gaps, loads, start=start, tol=_TOLERANCE))
    for _ in range(_LIGHTER_TRIES if moduli else 0):
        excess = pressed.height_mm.amax((1, 2)) / DEEPEST_MM
        if not bool((excess > 1).any()):
            break
        loads = torch.where(excess > 1, loads * excess**-1.5, loads)  # Hertz
        lighter = press(gaps, loads, start=pressed.pressure_kpa, tol=_TOLERANCE)
        pressed = pressed.replaced_where(excess > 1, _Pressed.of(lighter))
    return pressed


def split_of(seed: int, number: int) -> Split:
    """What a series may be used for."""
    u = float(np.random.default_rng([seed, number, 3]).random())
    if u < TEST_SHARE:
        return Split.TEST
    return Split.VALIDATION if u < TEST_SHARE + VALIDATION_SHARE else Split.TRAIN


if sum(num_loads(number) for number in range(GROUP_SERIES)) != GROUP_CONTACTS:
    raise RuntimeError("GROUP_CONTACTS must count the contacts of GROUP_SERIES series")
