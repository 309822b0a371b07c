"""Bodies that a gripper can hold: their surface towards a finger, and their physical properties.

A body is a height field (depth of its surface behind the point that is nearest to the finger) with
a mass, a stiffness, a friction and a bruise limit, drawn from stated ranges by a seed. Both fingers
touch the same surface (mirrored): our simplification, exact for bodies that are symmetric about the
plane between the fingers.

Body frame: the pad's axes (x right, y up), origin at the point nearest to the finger.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import map_coordinates

from cltp.tactile.cloud import FloatArray
from sim.gel.gap import NO_BODY_MM
from sim.grasp.fruit import BRUISE_FACTOR, FRUIT_RIPENESS, fruit_shape
from sim.grasp.revolved import GRID_MM as GRID_MM  # plugins take these from here
from sim.grasp.revolved import PITCH_MM as PITCH_MM
from sim.grasp.revolved import BodyShape as BodyShape
from sim.grasp.revolved import oval, revolved
from sim.grasp.ripeness import BRUISE_OVER_SLIP, PRESSURE_SCATTER, BerrySize


@dataclass(frozen=True, slots=True)
class Range:
    """Interval that a quantity is drawn from, uniformly or log-uniformly."""

    low: float
    high: float
    log: bool = False

    def quantile(self, u: float) -> float:
        """The ``u`` quantile, u in [0, 1]."""
        if self.log:
            return float(self.low * (self.high / self.low) ** u)
        return float(self.low + (self.high - self.low) * u)


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """One drawn body.

    Attributes:
        name: Name of its kind.
        gap_mm: Shape (N, N), height field on a square grid of ``PITCH_MM`` centred on the origin,
            row 0 at the top; 0 at the point nearest to the finger, ``NO_BODY_MM`` outside the body.
            A mesh may bulge towards the finger beside the pad; the field is negative there.
        com_mm: Centre of mass (x, y) relative to that point [mm].
        gyration_mm: Radius of gyration about the closing axis [mm].
        thickness_mm: Extent along the closing direction [mm].
        mass_kg: Mass [kg].
        young_mpa: Young's modulus [MPa]; infinite for a rigid body.
        poisson: Poisson's ratio.
        friction: Coulomb coefficient against the gel.
        bruise_n: Force of flat gelled fingers that just bruises (or cracks) it [N]; the resulting
            pressure is the limit for every grip (``sim.grasp.world``).
    """

    name: str
    gap_mm: FloatArray
    com_mm: tuple[float, float]
    gyration_mm: float
    thickness_mm: float
    mass_kg: float
    young_mpa: float
    poisson: float
    friction: float
    bruise_n: float

    @property
    def modulus_mpa(self) -> float:
        """Plane-strain modulus E / (1 - ν²) [MPa]."""
        return self.young_mpa / (1 - self.poisson**2)

    def gap_on(self, x_mm: FloatArray, y_mm: FloatArray) -> FloatArray:
        """Gap at body-frame coordinates.

        Args:
            x_mm: Shape (W,), ascending [mm].
            y_mm: Shape (H,), descending [mm].

        Returns:
            Shape (H, W) [mm].
        """
        centre = (self.gap_mm.shape[0] - 1) / 2
        rows = centre - y_mm / PITCH_MM
        columns = centre + x_mm / PITCH_MM
        grid = np.meshgrid(rows, columns, indexing="ij")
        return np.asarray(
            map_coordinates(self.gap_mm, grid, order=1, mode="constant", cval=NO_BODY_MM),
            dtype=np.float64,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class PropertyRanges:
    """Ranges of an object's properties. Sources stand above the presets.

    Attributes:
        mass_g, young_mpa, poisson, friction, bruise_n: The properties; of a body with a ripeness,
            stiffness and bruise force follow from size and ripeness and stay within these ranges.
        ripeness: Bruise force over the force that holds the body at the least friction
            (``sim.grasp.ripeness``); None of what does not ripen.
        bruise_factor: Drawn factor on the bruise force that ripeness tells; None for none.
        bruise_over_own_slip: Least bruise force over the force that holds the body at its own
            friction; a body below it is drawn anew (``sim.grasp.rig``). 0 lets all pass.
    """

    mass_g: Range
    young_mpa: Range
    poisson: float
    friction: Range
    bruise_n: Range
    ripeness: Range | None = None
    bruise_factor: Range | None = None
    bruise_over_own_slip: float = 0.0


Limits = tuple[float, float]


def _ranges(
    mass_g: Limits, young_mpa: Limits, poisson: float, friction: Limits, bruise_n: Limits
) -> PropertyRanges:
    return PropertyRanges(
        mass_g=Range(*mass_g),
        young_mpa=Range(*young_mpa, log=True),
        poisson=poisson,
        friction=Range(*friction),
        bruise_n=Range(*bruise_n),
    )


# Strawberry. Mass 5-60 g, log-uniform: classes from 7 g and cultivars of 11-40 g (weak web
# sources), with the smallest and the largest fruit of a punnet on either side (assumed). Friction
# with silicone was found nowhere: an assumption. Stiffness and bruise force: ``ripeness``; they
# come to the order of the 0.20 MPa of GelSight-lab/TactileEstimateModulus (citing a paper) and of
# the 1.1-2.7 N that punctures fruit of 10-40 g (by cultivar).
# Tomato, egg, peg: assumptions of the same kind, chosen to need rising force.
# Columns: mass [g], Young's modulus [MPa], Poisson's ratio, friction, bruise force [N]; moduli are
# drawn log-uniformly.
OBJECTS: dict[str, PropertyRanges] = {
    "strawberry": replace(
        _ranges((5, 60), (0.05, 0.6), 0.35, (0.3, 0.8), (0.2, 4.5)),
        mass_g=Range(5, 60, log=True),
        ripeness=Range(*BRUISE_OVER_SLIP),
    ),
    "cherry_tomato": _ranges((8, 18), (0.25, 0.6), 0.45, (0.4, 0.9), (1.4, 2.4)),
    "egg": _ranges((45, 65), (50, 100), 0.3, (0.3, 0.6), (7, 12)),
    # mass and friction: the range in which one grip must be found by slip; see ``sim.grasp.fruit``
    "fruit": replace(
        _ranges((8, 50), (0.05, 0.6), 0.35, (0.3, 0.8), (0.2, 5.0)),
        mass_g=Range(8, 50, log=True),
        ripeness=Range(*FRUIT_RIPENESS),
        bruise_factor=Range(*BRUISE_FACTOR),
        bruise_over_own_slip=1.6,
    ),
    "peg": _ranges((60, 140), (2e4, 2e5), 0.3, (0.4, 0.8), (200, 400)),
}


def draw_body(name: str, rng: np.random.Generator, tails: float = 0.0) -> Body:
    """Draw a body of a known kind.

    Args:
        name: A key of ``OBJECTS``.
        rng: Random generator.
        tails: Fraction of each range left out at either end: 0 draws from all of it, 0.1 from the
            10-90 % quantiles.

    Raises:
        ValueError: Unknown kind; the message lists the known ones.
    """
    if name not in OBJECTS:
        raise ValueError(f"unknown object {name!r}; known: {', '.join(OBJECTS)}")
    ranges = OBJECTS[name]

    def draw(quantity: Range) -> float:
        return quantity.quantile(tails + (1 - 2 * tails) * rng.random())

    mass_g = draw(ranges.mass_g)
    young, friction, bruise = draw(ranges.young_mpa), draw(ranges.friction), draw(ranges.bruise_n)
    gap, com, gyration, thickness = _SHAPES[name](mass_g, rng)
    if ranges.ripeness is not None:
        ripeness, scatter = draw(ranges.ripeness), draw(_SCATTER)
        size = BerrySize(mass_g=mass_g, size_mm=thickness, com_mm=com)
        flesh = size.flesh(ripeness, scatter)
        young, bruise = flesh.young_mpa, flesh.bruise_n
    if ranges.bruise_factor is not None:
        bruise *= draw(ranges.bruise_factor)
    return Body(
        name=name,
        gap_mm=gap,
        com_mm=com,
        gyration_mm=gyration,
        thickness_mm=thickness,
        mass_kg=mass_g / 1000,
        young_mpa=young,
        poisson=ranges.poisson,
        friction=friction,
        bruise_n=bruise,
    )


_SCATTER = Range(-PRESSURE_SCATTER, PRESSURE_SCATTER)


def _strawberry(mass_g: float, rng: np.random.Generator) -> BodyShape:
    """Berry hanging tip down: revolved profile, tilted a little, with achenes.

    Volume from the mass at a constant density through (7 g, 25 mm) of a berry 1.2 times as long as
    wide; the diameter is within 4 % of the four mass classes of the notes there. Length 1.05-1.35
    diameters, and ± 2 % of the diameter for hollow and dense fruit: assumed, since berries of one
    cultivar differ so by eye.
    """
    elongation = rng.uniform(1.05, 1.35)
    diameter = 25.0 * (1.2 * mass_g / 7.0 / elongation) ** (1 / 3) * rng.uniform(0.98, 1.02)
    length = diameter * elongation
    shoulder = rng.uniform(0.55, 0.65)  # where it is widest, from the tip

    def radius(s: FloatArray) -> FloatArray:
        """Radius [mm] at the fraction s of the length from the tip; ends are round (∝ √)."""
        inside = np.clip(s, 0.0, 1.0)
        # s^a (1-s)^b is widest at a / (a + b); a = 1/2 keeps the tip round
        a, b = 0.5, 0.5 * (1 - shoulder) / shoulder
        widest = shoulder**a * (1 - shoulder) ** b
        return diameter / 2 * inside**a * (1 - inside) ** b / widest

    roll = rng.normal(0, math.radians(8))  # hangs nearly straight
    return revolved(radius, length, roll, _achenes(rng, length))


def _egg(mass_g: float, rng: np.random.Generator) -> BodyShape:
    """Egg standing on its blunt end; a 60 g egg is about 43 mm wide and 56 mm long."""
    diameter = 43.0 * (mass_g / 60.0) ** (1 / 3)
    length = diameter * rng.uniform(1.22, 1.38)

    # a little wider below
    return revolved(oval(diameter, taper=0.1), length, rng.normal(0, math.radians(4)))


def _tomato(mass_g: float, rng: np.random.Generator) -> BodyShape:
    """Cherry tomato: a slightly oval ball, density 1 g/cm³."""
    elongation = rng.uniform(0.95, 1.25)
    diameter = (6 * mass_g * 1000 / (math.pi * elongation)) ** (1 / 3)
    return revolved(oval(diameter), diameter * elongation, rng.normal(0, math.radians(20)))


def _peg(mass_g: float, rng: np.random.Generator) -> BodyShape:
    """Upright steel peg, 12-20 mm across, its length (from the mass at 7.8 g/cm³) 25-80 mm."""
    diameter = rng.uniform(12, 20)
    length = float(np.clip(mass_g * 1000 / 7.8 / (math.pi * diameter**2 / 4), 25, 80))
    return revolved(
        lambda s: np.where((s >= 0) & (s <= 1), diameter / 2, 0.0),
        length,
        rng.normal(0, math.radians(2)),
    )


_SHAPES: dict[str, Callable[[float, np.random.Generator], BodyShape]] = {
    "strawberry": _strawberry,
    "cherry_tomato": _tomato,
    "egg": _egg,
    "peg": _peg,
    "fruit": fruit_shape,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ObjectKind:
    """A kind of object from outside of this package.

    Attributes:
        ranges: Ranges that its properties are drawn from.
        shape: Height field on ``GRID_MM`` (as ``Body.gap_mm``), centre of mass, radius of gyration
            and thickness [mm], of a mass [g] and a random generator.
    """

    ranges: PropertyRanges
    shape: Callable[[float, np.random.Generator], BodyShape]


def add_object(name: str, kind: ObjectKind) -> None:
    """Let the simulator draw bodies of another kind, in this process."""
    OBJECTS[name], _SHAPES[name] = kind.ranges, kind.shape


def _achenes(
    rng: np.random.Generator, length: float
) -> Callable[[FloatArray, FloatArray], FloatArray]:
    """Relief of 120-280 achenes, 2 mm long, on a golden-angle spiral.

    Count within the 20-500 and length within the 1.5-2.5 mm of the notes. Height 0.05-0.12 mm: our
    choice, since they sit in pits.
    """
    count = int(rng.integers(120, 280))
    height = rng.uniform(0.05, 0.12)
    start = rng.uniform(0, 2 * math.pi)
    index = np.arange(count)
    seeds_s = 0.06 + 0.88 * (index + 0.5) / count
    seeds_angle = (start + index * math.pi * (3 - math.sqrt(5))) % (2 * math.pi) - math.pi
    half_long, half_wide, mean_radius = 1.0, 0.6, 0.42 * length

    def relief(s: FloatArray, angle: FloatArray) -> FloatArray:
        bumps = np.zeros_like(s)
        for seed_s, seed_angle in zip(seeds_s, seeds_angle, strict=True):
            if abs(seed_angle) > 1.3:  # on the side away from this finger
                continue
            along = (s - seed_s) * length / half_long
            across = (angle - seed_angle) * mean_radius / half_wide
            bumps = np.maximum(bumps, np.clip(1 - along**2 - across**2, 0, None))
        return height * bumps

    return relief
