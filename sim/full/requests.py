"""What each series of the set is: object, sensor, gel, split, kind and loads, from seed and number.

Not here: the scene that is pressed (``sim.full.drawn_scene``, ``sim.full.solid_scene``,
``sim.full.held_scene``).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from cltp.data.contact import Split
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import DEPTH_LIMITS_MM
from sim.full.objects import Choice, Origin, is_held_out, object_of
from sim.gel.layer import GelMaterial, gel_of
from sim.tcl3d.series import OTHER_GELS

LOADS = 2
"""Contacts of a series, of rising depth or force."""

SENSORS = {"gelsight_mini": 0.70, "gelsight_r15": 0.10, "digit": 0.10, "gelstereo": 0.10}
"""Fractions of the series on each sensor. Our choice: the Mini is what the rigs have."""


MINI_GELS = (
    gel_of("gelsight_mini"),
    GelMaterial(thickness_mm=3.2, young_mpa=0.59, poisson=0.480),
    GelMaterial(thickness_mm=3.4, young_mpa=0.254, poisson=0.490),
    GelMaterial(thickness_mm=3.6, young_mpa=0.50, poisson=0.495),
    GelMaterial(thickness_mm=3.8, young_mpa=0.34, poisson=0.470),
    GelMaterial(thickness_mm=4.0, young_mpa=0.423, poisson=0.490),
    GelMaterial(thickness_mm=4.2, young_mpa=0.30, poisson=0.480),
    GelMaterial(thickness_mm=2.3, young_mpa=0.45, poisson=0.485),
    GelMaterial(thickness_mm=4.9, young_mpa=0.38, poisson=0.490),
    GelMaterial(thickness_mm=6.2, young_mpa=0.53, poisson=0.475),
)
"""Gels of a GelSight Mini's units, which differ: Young's modulus over 0.6-1.4 of nominal, thickness
over 3.2-4.2 mm, nu 0.47-0.495 (assumed ranges); and three that are far thinner or thicker, as pads
of one's own are cast. Heights tell a gel's thickness only in part, and an encoder that has seen one
thickness reads forces of others up to a quarter wrong, without a doubt."""


def _units(name: str) -> tuple[GelMaterial, ...]:
    """Gels of three units of a sensor: nominal, thinner and stiffer, thicker and softer."""
    gel = gel_of(name)
    factors = ((1.0, 1.0, gel.poisson), (0.92, 1.3, 0.48), (1.1, 0.75, 0.49))
    return tuple(
        GelMaterial(
            thickness_mm=round(gel.thickness_mm * thick, 3),
            young_mpa=round(gel.young_mpa * stiff, 4),
            poisson=poisson,
        )
        for thick, stiff, poisson in factors
    )


GELS = {name: MINI_GELS if name == "gelsight_mini" else _units(name) for name in SENSORS}
"""Gels of each sensor's units. A few, since the kernel of each takes long to compute."""

VALIDATION_FRACTION, TEST_FRACTION, PHYSICS_FRACTION = 0.03, 0.04, 0.03
"""Fractions of the series of seen objects; the rest is for training. Our choice."""


class PressKind(StrEnum):
    """How a drawn object is pressed."""

    ORDINARY = "ordinary"
    SMALL = "small"
    SHALLOW = "shallow"
    CUT = "cut"


KINDS = {
    PressKind.ORDINARY: 0.52,
    PressKind.SMALL: 0.15,
    PressKind.SHALLOW: 0.16,
    PressKind.CUT: 0.17,
}
"""Fractions of the series of drawn objects. Small: an object a few mm² large. Shallow: below 0.15
mm. Cut: over the pad's border. Solids are ordinary or shallow; their poses cut many contacts."""

SHALLOW_MM = (0.05, 0.15)
DEEPEST_MM, LEAST_MM = 1.3, 0.1
_CLASS_CHANCE = (0.32, 0.28, 0.22, 0.18)  # of the depth classes: real presses are light


@dataclass(frozen=True, slots=True, kw_only=True)
class FullRequest:
    """Settings of one series.

    Attributes:
        seed: Random seed of the data set.
        number: Number of the series, from 0.
        choice: The pressed object.
        sensor: The sensor.
        gel: Its gel.
        split: Use of its contacts.
        kind: How it is pressed.
        depths_mm: Rising depths of the presses of a rigid object [mm].
    """

    seed: int
    number: int
    choice: Choice
    sensor: SensorSpec
    gel: GelMaterial
    split: Split
    kind: PressKind
    depths_mm: tuple[float, ...]

    @property
    def scale(self) -> float:
        """Size of the sensing area over that of a GelSight Mini."""
        return self.sensor.height_mm / sensor_named("gelsight_mini").height_mm


def full_request(seed: int, number: int) -> FullRequest:
    """Settings of series ``number`` of the data set of ``seed``; they depend on nothing else."""
    rng = np.random.default_rng([seed, number, 3])
    choice = object_of(number)
    split = _split(choice, float(rng.random()))
    name = str(rng.choice(list(SENSORS), p=list(SENSORS.values())))
    if split is Split.PHYSICS:
        name = "gelsight_mini"
    gels = OTHER_GELS if split is Split.PHYSICS else GELS[name]
    gel = gels[int(rng.integers(len(gels)))]
    kind = list(KINDS)[int(rng.choice(len(KINDS), p=list(KINDS.values())))]
    if choice.origin not in (Origin.PARAMETRIC, Origin.SCANNED) and kind is not PressKind.SHALLOW:
        kind = PressKind.ORDINARY
    return FullRequest(
        seed=seed,
        number=number,
        choice=choice,
        sensor=sensor_named(name),
        gel=gel,
        split=split,
        kind=kind,
        depths_mm=_depths(kind, rng),
    )


def _split(choice: Choice, u: float) -> Split:
    if is_held_out(choice):
        return Split.OBJECT
    if u < TEST_FRACTION:
        return Split.TEST
    if u < TEST_FRACTION + VALIDATION_FRACTION:
        return Split.VALIDATION
    return Split.PHYSICS if u > 1 - PHYSICS_FRACTION else Split.TRAIN


def _depths(kind: PressKind, rng: np.random.Generator) -> tuple[float, ...]:
    """Rising depths [mm]: of two classes, or both shallow."""
    u = np.sort(rng.random(LOADS))
    if kind is PressKind.SHALLOW:
        low, high = SHALLOW_MM
        return tuple(float(low * (high / low) ** each) for each in u)
    limits = [LEAST_MM, *DEPTH_LIMITS_MM, DEEPEST_MM]
    classes = np.sort(rng.choice(4, size=LOADS, replace=False, p=_CLASS_CHANCE))
    fractions = rng.random(LOADS)
    return tuple(
        float(limits[i] + f * (limits[i + 1] - limits[i]))
        for i, f in zip(classes, fractions, strict=True)
    )
