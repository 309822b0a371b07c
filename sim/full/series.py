"""The series of the set ``full``: two labelled contacts of one object in one pose.

Every draw follows from the seed and the number of the series, which is drawn, solved and labelled
alone: its contacts depend neither on other series, nor on the number of workers or machines.

Not here: files and worker processes (``tacgrasp.datasets``), noise (``cltp.tactile.sensor_noise``).
"""

from __future__ import annotations

import math
from dataclasses import asdict, replace

import numpy as np
import torch

from cltp.data.contact import Contact, Gel
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import NO_CONTACT_STATE
from sim.full.drawn_scene import drawn_scene
from sim.full.held_scene import held_scene
from sim.full.objects import Origin
from sim.full.requests import LOADS, FullRequest, full_request
from sim.full.scene import PressScene
from sim.full.solid_scene import solid_scene
from sim.gel.bounded_press import press_no_deeper
from sim.gel.force_factor import force_factor
from sim.gel.layer import ElasticLayer, GelMaterial, Press
from sim.tcl3d.labelled_press import label_press
from sim.tcl3d.series import grid_over

CONTACTS = 120_000
"""Contacts of the set. Our choice, because FG-CLTP has 100,000."""

DEEPEST_BY_FORCE_MM = 2.4
"""Largest depth of a press by force; deeper ones are repeated with less force. A narrow part of a
peg at the pad's edge, bearing all of the force, would sink deeper than the gel is thick. Our
choice: two thirds of the thickness, beyond which linear elasticity does not hold."""

_TOLERANCE = 1e-3  # of the solver: heights within about 1 µm, as they are stored


def num_series(contacts: int) -> int:
    """Series of a set with so many contacts; the last one may have to be cut short."""
    return math.ceil(contacts / LOADS)


def make_series(seed: int, number: int, device: torch.device | str = "cpu") -> list[Contact]:
    """Make the ``LOADS`` contacts of series ``number`` of the data set of ``seed``, lightest first.

    Args:
        seed: Random seed of the data set.
        number: Number of the series, from 0.
        device: Torch device on which rays are cast and contacts are solved.
    """
    return _made(full_request(seed, number), device)


def press_on_gel(gel: GelMaterial, sensor: SensorSpec, *, seed: int, num: int) -> list[Contact]:
    """Press the objects of a seed's series on one gel; untouched frames are left out.

    What is pressed, where, and how deep or hard depends on seed and sensor alone, so that gels can
    be compared on the same presses.

    Args:
        gel: The gel of every contact.
        sensor: The sensor of every contact.
        seed: Random seed. From ``sim.grasp.rig.BENCHMARK_SEED`` on it is that of no data set.
        num: Number of contacts.
    """
    contacts: list[Contact] = []
    number = 0
    while len(contacts) < num:
        request = replace(full_request(seed, number), gel=gel, sensor=sensor)
        if request.choice.origin is not Origin.NOTHING:
            contacts += _made(request)
        number += 1
    return contacts[:num]


def _made(request: FullRequest, device: torch.device | str = "cpu") -> list[Contact]:
    rng = np.random.default_rng([request.seed, request.number, 1])
    origin = request.choice.origin
    if origin is Origin.NOTHING:
        return [_untouched(request) for _ in range(LOADS)]
    if origin is Origin.HELD:
        scene = held_scene(request, rng)
    elif origin is Origin.ASSEMBLED:
        scene = solid_scene(request, rng, device)
    else:
        scene = drawn_scene(request, rng)
    return label_press(
        _pressed(request, scene, device),
        scene.name,
        object_name=request.choice.name,
        sensor=request.sensor,
        gel=request.gel,
        split=request.split,
        seed=request.seed,
        series=request.number,
    )


@torch.inference_mode()
def _pressed(request: FullRequest, scene: PressScene, device: torch.device | str) -> Press:
    rows, columns = grid_over(request.sensor)
    layer = ElasticLayer(
        request.gel,
        rows=rows,
        columns=columns,
        pitch_mm=request.sensor.width_mm / columns,
        body_modulus_mpa=scene.modulus_mpa,
        device=device,
    )
    gaps = torch.from_numpy(scene.gap_mm.astype(np.float32)).expand(len(scene.loads), -1, -1)
    gaps, loads = gaps.to(device), torch.tensor(scene.loads, device=device)
    if not scene.by_force:
        return layer.press_to_depth(gaps, loads, tol=_TOLERANCE)
    return press_no_deeper(layer, gaps, loads, deepest_mm=DEEPEST_BY_FORCE_MM, tol=_TOLERANCE)


def _untouched(request: FullRequest) -> Contact:
    """A frame of the untouched gel."""
    return Contact(
        height_mm=np.zeros(grid_over(request.sensor), dtype=np.float32),
        sensor=request.sensor,
        state=NO_CONTACT_STATE,
        object=request.choice.name,
        series=request.number,
        split=request.split,
        gel=Gel(**asdict(request.gel)),
        seed=request.seed,
        unsure=frozenset(),
        force_factor=force_factor(request.gel, request.sensor.name),
    )
