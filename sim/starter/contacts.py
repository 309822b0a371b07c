"""Contacts of the starter set: draws series, presses them into gels, labels them from the truth.

A group of series shares a gel and is solved together. The group of a series and every draw follow
from the seed and its number alone, so that any number of workers makes the same contacts. Contacts
are stored by ``cltp.data.dataset``; heights are clean.

Not here: files and processes (``tacgrasp.datasets.generate``), noise
(``cltp.tactile.sensor_noise``).
"""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import torch
from torch import Tensor

from cltp.data.contact import Contact, Gel, Split
from cltp.tactile.sensors import SensorSpec
from sim.gel.bounded_press import press_no_deeper
from sim.gel.force_factor import force_factor
from sim.gel.layer import ElasticLayer, GelMaterial, Press, gel_of
from sim.grasp.rig import BENCHMARK_SEED
from sim.starter.series import COLUMNS, ROWS, Series, draw_series, num_loads
from sim.tcl3d.labels import in_contact, label

GELS = (
    gel_of("gelsight_mini"),
    GelMaterial(thickness_mm=3.2, young_mpa=0.59, poisson=0.480),
    GelMaterial(thickness_mm=3.4, young_mpa=0.254, poisson=0.490),
    GelMaterial(thickness_mm=3.6, young_mpa=0.50, poisson=0.495),
    GelMaterial(thickness_mm=3.8, young_mpa=0.34, poisson=0.470),
    GelMaterial(thickness_mm=4.0, young_mpa=0.423, poisson=0.490),
    GelMaterial(thickness_mm=4.2, young_mpa=0.30, poisson=0.480),
)
"""Gels of the contacts.

Units differ: Young's modulus over 0.6-1.4 of nominal, thickness over 3.2-4.2 mm, nu 0.47-0.495 (the
notes; assumed ranges). A few instead of a continuum because the kernel of each takes long to
compute.
"""

GROUP_SERIES = 16
"""Series in a group. Each has two or three contacts; half of them are soft and half rigid. Batches
of about eight fit the cache (twice as many take a quarter longer)."""

GROUP_CONTACTS = sum(num_loads(number) for number in range(GROUP_SERIES))

VALIDATION_FRACTION, TEST_FRACTION = 0.04, 0.06
"""Fractions of series, our choice; the rest is for training."""

_TOLERANCE = 1e-3  # of the solver: heights within about 1 µm, as they are stored

DEEPEST_MM = 2.4
"""Largest depth of a press by force; deeper ones are repeated with less force. A narrow part of a
peg at the pad's edge, bearing all of the force, would sink deeper than the gel is thick. Our
choice: two thirds of the thickness, beyond which linear elasticity does not hold."""


def make_group(
    seed: int, group: int, sensor: SensorSpec, gel: GelMaterial | None = None
) -> list[Contact]:
    """Make the contacts of one group, in the order of their series.

    Args:
        seed: Random seed of the data set, below ``BENCHMARK_SEED``.
        group: Number of the group; its first series is ``GROUP_SERIES * group``.
        sensor: The sensor.
        gel: Gel to press; None for the group's own.

    Returns:
        ``GROUP_CONTACTS`` contacts.

    Raises:
        ValueError: The seed belongs to the benchmark, or a number is negative.
    """
    if not 0 <= seed < BENCHMARK_SEED or group < 0:
        raise ValueError(
            f"data are made from seeds 0 to {BENCHMARK_SEED - 1} (larger ones are for benchmarks) "
            f"and groups from 0, got seed {seed}, group {group}"
        )
    gel = gel or GELS[int(np.random.default_rng([seed, group, 2]).integers(len(GELS)))]
    first = GROUP_SERIES * group
    series = [draw_series(seed, first + i, sensor) for i in range(GROUP_SERIES)]
    contacts: dict[int, list[Contact]] = {}
    for soft in (True, False):
        members = [member for member in series if (member.modulus_mpa is not None) == soft]
        if members:
            contacts |= _press_members(seed, members, gel, sensor)
    return [contact for member in series for contact in contacts[member.number]]


def _press_members(
    seed: int, members: list[Series], gel: GelMaterial, sensor: SensorSpec
) -> dict[int, list[Contact]]:
    """Press series of one kind, soft or rigid, load by load."""
    contacts: dict[int, list[Contact]] = {member.number: [] for member in members}
    pressure: Tensor | None = None
    for step in range(max(len(member.loads) for member in members)):
        active = [i for i, member in enumerate(members) if len(member.loads) > step]
        if pressure is not None:
            pressure = pressure[active]
        members = [members[i] for i in active]
        with torch.inference_mode():
            press = _press(members, step, gel, sensor, pressure)
        pressure = press.pressure_kpa
        touching = in_contact(pressure, sensor.width_mm / COLUMNS)
        for i, member in enumerate(members):
            height_mm = press.height_mm[i].numpy()
            state = label(
                height_mm=height_mm,
                pressure_kpa=pressure[i].numpy(),
                touching=touching[i],
                force_n=float(press.force_n[i]),
                sensor=sensor,
                shape=member.shape,
                texture=member.texture,
            )
            contacts[member.number].append(
                Contact(
                    height_mm=height_mm,
                    sensor=sensor,
                    state=state,
                    object=member.object,
                    series=member.number,
                    split=split_of(seed, member.number),
                    gel=Gel(**asdict(gel)),
                    force_factor=force_factor(gel, sensor.name),
                    seed=seed,
                )
            )
    return contacts


def _press(
    members: list[Series], step: int, gel: GelMaterial, sensor: SensorSpec, start: Tensor | None
) -> Press:
    gaps = torch.from_numpy(np.stack([member.gap_mm for member in members]).astype(np.float32))
    loads = torch.tensor([member.loads[step] for member in members], dtype=torch.float32)
    moduli = [member.modulus_mpa for member in members if member.modulus_mpa is not None]
    layer = ElasticLayer(
        gel,
        rows=ROWS,
        columns=COLUMNS,
        pitch_mm=sensor.width_mm / COLUMNS,
        body_modulus_mpa=torch.tensor(moduli) if moduli else None,
    )
    if not moduli:
        return layer.press_to_depth(gaps, loads, start=start, tol=_TOLERANCE)
    return press_no_deeper(layer, gaps, loads, deepest_mm=DEEPEST_MM, start=start, tol=_TOLERANCE)


def split_of(seed: int, number: int) -> Split:
    """Split of a series."""
    u = float(np.random.default_rng([seed, number, 3]).random())
    if u < TEST_FRACTION:
        return Split.TEST
    return Split.VALIDATION if u < TEST_FRACTION + VALIDATION_FRACTION else Split.TRAIN
