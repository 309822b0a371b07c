"""Fruit that nothing was trained on: seven kinds of bodies of revolution, 8 to 50 g.

They share the closed forms of ripeness with the strawberry (``sim.grasp.ripeness``), so that size
and stiffness still tell what a fruit of its ripeness stands. Each single fruit, however, bruises at
0.6 to 1.4 times that, which nothing felt can tell; its stiffness stays that of the ripeness.

All ranges of shape are assumed, as plain looks at the fruit suggest them. Density near that of
water is what is measured of such fruit: 1.055 g/cm³ of golden apples (Spondias) of 27 g, whose
friction on rubber, 0.475, lies within the range assumed for gel. Source: Ooi Abdullah and Ch'ng
2022, ESTEEM Academic Journal 18, 81-91 (abstract).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from cltp.tactile.cloud import FloatArray
from sim.grasp.revolved import BodyShape, revolved

BRUISE_FACTOR = (0.6, 1.4)
"""Bruise force over that of its ripeness, drawn uniformly. Assumed: fruit of one stiffness differ
in skin and history; the specification of ``tacgrasp bench gentle`` asks for ± 40 %."""

FRUIT_RIPENESS = (1.1, 1.6)
"""Bruise force that ripeness tells, over the force that holds the fruit at the least friction.
Assumed: riper than the strawberries, so that no one force does for most of them."""

Relief = Callable[[FloatArray, FloatArray], FloatArray]
"""Added height [mm] at (fraction of the length, angle about the axis)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FruitKind:
    """One kind of fruit; every number is assumed (see the module).

    Attributes:
        mass_g: Smallest and largest mass [g].
        density: Density [g/cm³].
        elongation: Length over diameter.
        widest: Where it is widest, as a fraction of the length from the lower end.
        roll_deg: Standard deviation of its tilt [deg]: hanging fruit hang straighter than lying.
        tubercles_mm: Height of knobs 2.5 to 4 mm apart [mm].
        ribs_mm: Height of 10 to 18 ribs along the fruit [mm].
    """

    mass_g: tuple[float, float]
    density: float
    elongation: tuple[float, float]
    widest: tuple[float, float]
    roll_deg: float
    tubercles_mm: tuple[float, float] = (0.0, 0.0)
    ribs_mm: tuple[float, float] = (0.0, 0.0)


KINDS: Mapping[str, FruitKind] = {
    "grape": FruitKind(
        mass_g=(8, 14), density=1.07, elongation=(1.05, 1.5), widest=(0.45, 0.55), roll_deg=10
    ),
    "kumquat": FruitKind(
        mass_g=(8, 20),
        density=0.95,
        elongation=(1.0, 1.5),
        widest=(0.45, 0.55),
        roll_deg=15,
        tubercles_mm=(0.01, 0.03),
    ),
    "lychee": FruitKind(
        mass_g=(14, 30),
        density=0.98,
        elongation=(1.0, 1.15),
        widest=(0.48, 0.58),
        roll_deg=10,
        tubercles_mm=(0.08, 0.25),
    ),
    "plum": FruitKind(
        mass_g=(14, 50), density=1.04, elongation=(0.95, 1.25), widest=(0.45, 0.55), roll_deg=15
    ),
    "apricot": FruitKind(
        mass_g=(22, 50), density=1.02, elongation=(0.95, 1.1), widest=(0.46, 0.56), roll_deg=15
    ),
    "fig": FruitKind(
        mass_g=(18, 50),
        density=0.95,
        elongation=(1.1, 1.4),
        widest=(0.33, 0.42),
        roll_deg=8,
        ribs_mm=(0.03, 0.1),
    ),
    "kiwi": FruitKind(
        mass_g=(12, 50),
        density=1.04,
        elongation=(1.15, 1.4),
        widest=(0.47, 0.53),
        roll_deg=12,
        tubercles_mm=(0.01, 0.04),
    ),
}


def fruit_shape(mass_g: float, rng: np.random.Generator) -> BodyShape:
    """Shape of a fruit of one of the kinds that come in this mass, as ``BodyShape``."""
    kinds = [kind for kind in KINDS.values() if kind.mass_g[0] <= mass_g <= kind.mass_g[1]]
    return shape_of(kinds[int(rng.integers(len(kinds)))], mass_g, rng)


def shape_of(kind: FruitKind, mass_g: float, rng: np.random.Generator) -> BodyShape:
    """Shape of a fruit of a kind, its size from mass and density."""
    elongation, widest = rng.uniform(*kind.elongation), rng.uniform(*kind.widest)
    profile = _profile(widest)
    s = np.linspace(0.0, 1.0, 401)
    # volume = π/4 · diameter² · length · mean of the squared profile
    mean_square = float(np.mean(profile(s) ** 2))
    volume_mm3 = 1000 * mass_g / kind.density
    diameter = (volume_mm3 / (math.pi / 4 * elongation * mean_square)) ** (1 / 3)
    length = diameter * elongation
    roll = rng.normal(0, math.radians(kind.roll_deg))
    relief = _relief(kind, diameter, length, rng)
    return revolved(lambda s: diameter / 2 * profile(s), length, roll, relief)


def _profile(widest: float) -> Callable[[FloatArray], FloatArray]:
    """Radius over the largest one: an ellipsoid whose widest place has moved; ends are round."""

    def radius(s: FloatArray) -> FloatArray:
        inside = np.clip(s, 0.0, 1.0)
        half = np.where(inside < widest, widest, 1 - widest)
        return np.asarray(np.sqrt(np.clip(1 - ((inside - widest) / half) ** 2, 0.0, None)))

    return radius


def _relief(
    kind: FruitKind, diameter: float, length: float, rng: np.random.Generator
) -> Relief | None:
    """Knobs and ribs of a fruit; None of a smooth one."""
    knob, rib = rng.uniform(*kind.tubercles_mm), rng.uniform(*kind.ribs_mm)
    pitch, count = rng.uniform(2.5, 4.0), int(rng.integers(10, 19))
    along_0, around_0 = rng.uniform(0, 2 * math.pi, size=2)
    if knob == 0 and rib == 0:
        return None
    knobs_around = round(math.pi * diameter / pitch)

    def relief(s: FloatArray, angle: FloatArray) -> FloatArray:
        along = np.cos(2 * math.pi * s * length / pitch + along_0)
        knobs = np.clip(along, 0, None) * np.clip(np.cos(knobs_around * angle + around_0), 0, None)
        return np.asarray(knob * knobs + rib * np.cos(count * angle + around_0))

    return relief
