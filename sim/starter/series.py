"""Series of the starter set, drawn from a seed: a body or an indenter, its position and its loads.

A series is one object in one pose, pressed two or three times with rising load. About half of all
series are bodies that grippers hold, at the forces of a grasp; the others are indenters, with
depths of all four classes.

Not here: solving and labels (``sim.starter.contacts``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import DEPTH_LIMITS_MM, Shape, Texture
from sim.grasp.bodies import Body, Range, draw_body
from sim.grasp.turned_pad import turned
from sim.starter.shapes import IndenterPose, draw_indenter, gap_mm, relief_mm
from sim.tcl3d.poses import position_within

ROWS, COLUMNS = 75, 100
"""Grid over the sensing area: 0.2 mm on a GelSight Mini."""

TAILS = 0.1
"""Fraction left out at either end of every range of a body: the ends are for benchmarks."""

BODY_FRACTION = 0.55
BODY_FORCE_N: dict[str, Range] = {
    "strawberry": Range(low=0.05, high=7.0, log=True),
    "cherry_tomato": Range(low=0.05, high=4.0, log=True),
    "egg": Range(low=0.1, high=12.0, log=True),
    "peg": Range(low=0.15, high=18.0, log=True),
}
"""True forces: from a first touch, which is felt at about 0.1 N, to several times the goal."""

_BODY_CHANCE = {"strawberry": 0.5, "cherry_tomato": 0.17, "egg": 0.16, "peg": 0.17}
TURNED_FRACTION = 0.3
"""Fraction of the bodies that a sensor mounted a quarter turn presses; indenters have any turn."""

_BODY_TEXTURE = {"strawberry": Texture.BUMPY}  # achenes; the others are smooth
_BODY_REACH_MM = np.array([12.0, 9.5])

_TEXTURE_CHANCE = {
    Texture.SMOOTH: 0.16,
    Texture.ROUGH: 0.23,
    Texture.RIDGED: 0.23,
    Texture.BUMPY: 0.15,
    Texture.WOVEN: 0.23,
}
_SHAPE_WEIGHT = {Shape.SPHERE: 0.8, Shape.ELLIPSOID: 0.5, Shape.CYLINDER: 0.5}  # bodies add more
_SHALLOWEST_MM, _DEEPEST_MM = 0.1, 1.3
_SHALLOWEST_FINE_MM = 0.18  # a tip, or a few tops of a texture, needs as much
_PLANE_FRACTION = (0.83, 0.97)

ELLIPSOID_RATIO = 1.4
"""Ratio of curvatures from which a cap is an ellipsoid (``cltp.tactile.states.Shape``)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Series:
    """One object in one pose, and its loads.

    Attributes:
        number: Number of the series in the data set.
        object: Name of the object.
        gap_mm: Shape (ROWS, COLUMNS), distance of the surface behind its nearest point [mm].
        modulus_mpa: Plane-strain modulus of a soft body [MPa]; None for a rigid one.
        loads: Rising forces [N] of a soft body, depths [mm] of a rigid one.
        shape, texture: Labels.
    """

    number: int
    object: str
    gap_mm: FloatArray
    modulus_mpa: float | None
    loads: tuple[float, ...]
    shape: Shape
    texture: Texture


def draw_series(seed: int, number: int, sensor: SensorSpec) -> Series:
    """Draw series ``number`` of the data set of ``seed``; it depends on nothing else."""
    rng = np.random.default_rng([seed, number, 1])
    if rng.random() < BODY_FRACTION:
        return _body_series(number, rng, sensor)
    return _indenter_series(number, rng, sensor)


def num_loads(number: int) -> int:
    """Contacts in series ``number``: two and three in turn."""
    return 2 + number % 2


def _body_series(number: int, rng: np.random.Generator, sensor: SensorSpec) -> Series:
    name = str(rng.choice(list(_BODY_CHANCE), p=list(_BODY_CHANCE.values())))
    body = draw_body(name, rng, TAILS)
    if rng.random() < TURNED_FRACTION:
        body = turned(body)
    x, y = grid_axes_mm(sensor, ROWS, COLUMNS)
    while True:
        x_mm, y_mm = position_within(rng, _BODY_REACH_MM).tolist()
        gap = body.gap_on(x - x_mm, y - y_mm)
        if gap.min() < body.thickness_mm / 2:  # else the fingers miss it
            break
    fractions = np.sort(rng.random(num_loads(number)))
    shape = Shape.ELLIPSOID if curvature_ratio(body) >= ELLIPSOID_RATIO else Shape.SPHERE
    if name == "peg":
        shape = Shape.CYLINDER
    return Series(
        number=number,
        object=name,
        gap_mm=gap - gap.min(),
        modulus_mpa=body.modulus_mpa,
        loads=tuple(BODY_FORCE_N[name].quantile(u) for u in fractions),
        shape=shape,
        texture=_BODY_TEXTURE.get(name, Texture.SMOOTH),
    )


def curvature_ratio(body: Body, radius_mm: float = 4.0) -> float:
    """Larger over smaller principal curvature of a body, from a quadric fitted about its origin.

    A radius of 4 mm averages over achenes and stays within the contact.
    """
    axis = np.linspace(-radius_mm, radius_mm, 17)
    gap = body.gap_on(axis, -axis)
    x, y = np.meshgrid(axis, -axis)
    mask = (np.hypot(x, y) <= radius_mm) & (gap < body.thickness_mm / 2)
    x, y, z = x[mask], y[mask], gap[mask]
    terms = np.stack([x * x, x * y, y * y, x, y, np.ones_like(x)], axis=1)
    a, b, c, *_ = np.linalg.lstsq(terms, z, rcond=None)[0]
    low, high = np.linalg.eigvalsh([[2 * a, b], [b, 2 * c]])
    return math.inf if low <= 0 else float(high / low)


def _indenter_series(number: int, rng: np.random.Generator, sensor: SensorSpec) -> Series:
    weights = np.array([_SHAPE_WEIGHT.get(shape, 1.0) for shape in Shape])
    shape = list(Shape)[int(rng.choice(len(weights), p=weights / weights.sum()))]
    indenter = draw_indenter(shape, rng)
    texture = Texture.SMOOTH
    if indenter.textured:
        chances = np.array(list(_TEXTURE_CHANCE.values()))
        texture = list(_TEXTURE_CHANCE)[int(rng.choice(len(chances), p=chances))]
    sharp = shape in (Shape.PEAK, Shape.CORNER)
    shallowest_mm = (
        _SHALLOWEST_FINE_MM if sharp or texture is not Texture.SMOOTH else _SHALLOWEST_MM
    )
    depths = _depths(rng, num_loads(number), shallowest_mm, gentle=shape is Shape.PLANE)
    x, y = np.meshgrid(*grid_axes_mm(sensor, ROWS, COLUMNS))
    relief = relief_mm(texture, rng, x, y, sensor)
    turn = rng.uniform(0, 2 * math.pi)
    if shape is Shape.PLANE:
        # Over 80 % of the sensing area, not all: a smooth plane over the whole area could not be
        # told from no contact, since the sensor does not measure a constant.
        cos, sin = math.cos(turn), math.sin(turn)
        end = float(np.quantile(x * cos + y * sin, rng.uniform(*_PLANE_FRACTION)))
        x_mm, y_mm = end * cos, end * sin
    else:
        x_mm, y_mm = position_within(
            rng, np.array([sensor.width_mm, sensor.height_mm]) / 2
        ).tolist()
    # A tilt must leave the whole face in reach of the lightest press, or the contact is an edge.
    slope = math.tan(indenter.max_tilt_rad * rng.random())
    if indenter.max_tilt_rad < math.radians(10):
        slope = min(slope, depths[0] / 12)
    direction_rad = rng.uniform(0, 2 * math.pi)
    pose = IndenterPose(
        x_mm=x_mm,
        y_mm=y_mm,
        turn_rad=turn,
        slope_x=slope * math.cos(direction_rad),
        slope_y=slope * math.sin(direction_rad),
    )
    return Series(
        number=number,
        object=shape.value,
        gap_mm=gap_mm(indenter, pose, x, y, relief),
        modulus_mpa=None,
        loads=depths,
        shape=shape,
        texture=texture,
    )


def _depths(
    rng: np.random.Generator, count: int, shallowest_mm: float, *, gentle: bool
) -> tuple[float, ...]:
    """Rising depths [mm] of different classes; ``gentle`` leaves out the deeper two."""
    limits = [shallowest_mm, *DEPTH_LIMITS_MM, _DEEPEST_MM]
    if gentle:
        limits = np.linspace(shallowest_mm, DEPTH_LIMITS_MM[1], 5).tolist()
    chosen = np.sort(rng.choice(4, size=count, replace=False))
    return tuple(float(rng.uniform(limits[i], limits[i + 1])) for i in chosen)
