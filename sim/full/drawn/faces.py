"""Flat faces: cuboids, triangles, hexagons, discs and planes.

Sizes are our choice, so that contacts of every area occur on every sensor.

Not here: rings, crescents and faces with a hole (``sim.full.drawn.bands``).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.full.drawn.outlines import polygon, rounded_power
from sim.full.drawn.surface import Draws, Height, Surface, face, radians

Draw = Callable[[Draws], Surface]

LARGEST_MM = 7.0
"""Largest reach of a polygon on a GelSight Mini, about half of the pad."""


def _extent(corners: FloatArray) -> float:
    return float(np.hypot(corners[:, 0], corners[:, 1]).max())


def _cut_out(shape: Shape, corners: FloatArray, draws: Draws, rounding: float = 0.0) -> Surface:
    """A face within a polygon, its corners rounded [mm]; larger ones are made to fit the pad."""
    middle = corners - corners.mean(axis=0)
    middle = middle * min(1.0, LARGEST_MM * draws.scale / _extent(middle))
    inner = float(-polygon(np.zeros(1), np.zeros(1), middle)[0])
    rounding = min(rounding, 0.5 * inner)
    shrunk = middle * (1 - rounding / inner)

    def outline(u: FloatArray, v: FloatArray) -> FloatArray:
        return polygon(u, v, shrunk) - rounding

    return face(shape, outline, draws, half_width_mm=inner, extent_mm=_extent(middle))


def _rectangle(draws: Draws) -> FloatArray:
    area = draws.log(2, 8) if draws.small else draws.log(8, 90) * draws.scale**2
    aspect = draws.uniform(1, 2.25)
    half = np.array([math.sqrt(area * aspect), math.sqrt(area / aspect)]) / 2
    return np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * half


def _cuboid(draws: Draws) -> Surface:
    return _cut_out(Shape.CUBOID, _rectangle(draws), draws)


def _cuboid_rounded(draws: Draws) -> Surface:
    corners = _rectangle(draws)
    return _cut_out(Shape.CUBOID, corners, draws, draws.uniform(0.1, 0.35) * corners[2].min())


def _cuboid_power(draws: Draws) -> Surface:
    half_u, half_v = _rectangle(draws)[2]
    power = draws.uniform(5.5, 16)
    return face(
        Shape.CUBOID,
        lambda u, v: rounded_power(u, v, half_u, half_v, power),
        draws,
        half_width_mm=min(half_u, half_v),
        extent_mm=math.hypot(half_u, half_v),
    )


def _cuboid_askew(draws: Draws) -> Surface:
    """A trapezium or parallelogram, its angles off by up to about 8°."""
    corners = _rectangle(draws)
    short = float(corners[2].min())
    corners = corners + draws.rng.uniform(-0.12, 0.12, corners.shape) * short
    return _cut_out(Shape.CUBOID, corners, draws, draws.uniform(0, 0.1) * short)


def triangle(degrees: tuple[float, float], area_mm2: float) -> FloatArray:
    """Corners (3, 2) of a triangle by two angles [°] and its area [mm²], about its centre [mm]."""
    first, second = radians(*degrees)
    tall = 1 / (1 / math.tan(first) + 1 / math.tan(second))
    corners = np.array([(0.0, 0.0), (1.0, 0.0), (tall / math.tan(first), tall)])
    return np.asarray((corners - corners.mean(axis=0)) * math.sqrt(area_mm2 / (0.5 * tall)))


TRIANGLES: Mapping[str, Callable[[Draws], tuple[float, float]]] = {
    "even": lambda draws: (draws.uniform(50, 70), draws.uniform(50, 65)),
    "right": lambda draws: (draws.uniform(86, 94), draws.uniform(30, 58)),
    "obtuse": lambda draws: (
        first := draws.uniform(98, 142),
        draws.uniform(0.3, 0.7) * (180 - first),
    ),
    "slender": lambda draws: (draws.uniform(14, 30), draws.uniform(62, 100)),
    "scalene": lambda draws: (draws.uniform(35, 55), draws.uniform(60, 88)),
}
"""Two angles of each kind of triangle [°]."""


def _triangle(kind: str) -> Draw:
    def draw(draws: Draws) -> Surface:
        area = draws.log(2.5, 8) if draws.small else draws.log(7, 70) * draws.scale**2
        corners = triangle(TRIANGLES[kind](draws), area)
        rounding = draws.uniform(0.05, 0.4) if draws.chance(0.4) and not draws.small else 0.0
        return _cut_out(Shape.TRIANGLE, corners, draws, rounding)

    return draw


def regular(num: int, radius: float, turn: float = 0.0) -> FloatArray:
    """Corners (num, 2) of a regular polygon by its circumscribed radius [mm]."""
    angles = turn + np.arange(num) * 2 * math.pi / num
    return np.stack([radius * np.cos(angles), radius * np.sin(angles)], axis=1)


def _hexagon_radius(draws: Draws) -> float:
    return draws.size(1.9, 6.3, (1.1, 2.0))


def _hexagon(draws: Draws) -> Surface:
    return _cut_out(Shape.HEXAGON, regular(6, _hexagon_radius(draws)), draws)


def _hexagon_uneven(draws: Draws) -> Surface:
    radius = _hexagon_radius(draws)
    angles = np.arange(6) * math.pi / 3 + draws.rng.uniform(-0.07, 0.07, 6)
    reach = radius * (1 + draws.rng.uniform(-0.07, 0.07, 6))
    corners = np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=1)
    return _cut_out(Shape.HEXAGON, corners * [1.0, draws.uniform(0.85, 1)], draws)


def _hexagon_rounded(draws: Draws) -> Surface:
    radius = _hexagon_radius(draws)
    return _cut_out(Shape.HEXAGON, regular(6, radius), draws, draws.uniform(0.05, 0.18) * radius)


def _hexagon_stretched(draws: Draws) -> Surface:
    corners = regular(6, _hexagon_radius(draws)) * [draws.uniform(1.05, 1.3), 1.0]
    return _cut_out(Shape.HEXAGON, corners, draws, draws.uniform(0, 0.1))


def _disc_of(power: tuple[float, float], oval: float) -> Draw:
    def draw(draws: Draws) -> Surface:
        radius, ratio = draws.size(1.3, 5.8, (0.8, 1.6)), draws.uniform(oval, 1)
        exponent = draws.uniform(*power)
        return face(
            Shape.DISC,
            lambda u, v: rounded_power(u, v, radius, ratio * radius, exponent),
            draws,
            half_width_mm=ratio * radius,
            extent_mm=radius,
        )

    return draw


def _disc_faceted(draws: Draws) -> Surface:
    return _cut_out(
        Shape.DISC, regular(draws.count(14, 24), draws.size(1.3, 5.8, (0.8, 1.6))), draws
    )


def _disc_nicked(draws: Draws) -> Surface:
    """A disc with one or two notches, as of a worn coin."""
    radius = draws.size(1.8, 5.8, (1.0, 1.7))
    notches = [(draws.uniform(0, 6.28), draws.uniform(0.1, 0.2)) for _ in range(draws.count(1, 2))]

    def outline(u: FloatArray, v: FloatArray) -> FloatArray:
        distance = np.hypot(u, v) - radius
        for angle, size in notches:
            away = np.hypot(u - radius * math.cos(angle), v - radius * math.sin(angle))
            distance = np.maximum(distance, size * radius - away)
        return np.asarray(distance)

    return face(Shape.DISC, outline, draws, half_width_mm=0.8 * radius, extent_mm=radius)


def _plane(outline_of: Callable[[Draws], Height]) -> Draw:
    """A face that runs past the pad but for one end, at u = 0; it lies on the side of -u."""

    def draw(draws: Draws) -> Surface:
        outline = outline_of(draws)
        return face(Shape.PLANE, outline, draws, half_width_mm=3, extent_mm=14, is_compact=False)

    return draw


def _plane_corner(draws: Draws) -> Height:
    bend = draws.uniform(0.15, 0.8)
    return lambda u, v: (u + bend * np.abs(v)) / math.hypot(1, bend)


def _plane_round(draws: Draws) -> Height:
    radius = draws.uniform(14, 40)
    return lambda u, v: np.hypot(u + radius, v) - radius


def _plane_wavy(draws: Draws) -> Height:
    waves, height = draws.uniform(0.5, 1.5), draws.uniform(0.05, 0.4)
    return lambda u, v: u + height * np.sin(waves * v)


def _plane_notched(draws: Draws) -> Height:
    half, deep = draws.uniform(0.5, 1.5), draws.uniform(0.5, 2)
    return lambda u, v: np.maximum(u, np.minimum(half - np.abs(v), u + deep))


FACES: Mapping[Shape, Mapping[str, Draw]] = {
    Shape.CUBOID: {
        "cuboid": _cuboid,
        "cuboid_rounded": _cuboid_rounded,
        "cuboid_power": _cuboid_power,
        "cuboid_askew": _cuboid_askew,
    },
    Shape.TRIANGLE: {f"triangle_{kind}": _triangle(kind) for kind in TRIANGLES},
    Shape.HEXAGON: {
        "hexagon": _hexagon,
        "hexagon_uneven": _hexagon_uneven,
        "hexagon_rounded": _hexagon_rounded,
        "hexagon_stretched": _hexagon_stretched,
    },
    Shape.DISC: {
        "disc": _disc_of((2, 2), 1.0),
        "disc_oval": _disc_of((1.9, 2.2), 0.88),
        "disc_faceted": _disc_faceted,
        "disc_nicked": _disc_nicked,
    },
    Shape.PLANE: {
        "plane": _plane(lambda _: lambda u, v: u + 0.0 * v),
        "plane_corner": _plane(_plane_corner),
        "plane_round": _plane(_plane_round),
        "plane_wavy": _plane(_plane_wavy),
        "plane_notched": _plane(_plane_notched),
    },
}
"""Of each shape: its objects by name."""
