"""Flat bodies with an outline: cuboid, triangle, hexagon, disc, plane, ring, crescent, hole."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.independent.outlines import bow, moon, polygon, polyline, superellipse
from sim.independent.recipe import HeightBody, PressRecipe, bevelled, log_uniform

Outline = Callable[[FloatArray, FloatArray], FloatArray]


def _face(
    variant: str,
    outline: Outline,
    recipe: PressRecipe,
    rng: np.random.Generator,
    *,
    extent_mm: float,
    half_width_mm: float = math.inf,
    textured: bool = True,
    is_compact: bool = True,
) -> HeightBody:
    """A flat face within an outline; ``half_width_mm`` is that of a narrow one."""
    bevel = rng.uniform(0.05, 0.15) if recipe.small else rng.uniform(0.08, 0.35)
    bevel = min(bevel, 0.4 * half_width_mm)
    steep = rng.uniform(0.7, 1.6)
    return HeightBody(
        variant=variant,
        behind_mm=lambda u, v: bevelled(outline(u, v), bevel, steep),
        parts=lambda u, v: np.where(outline(u, v) < -bevel, 0, -1),
        textured=textured and not recipe.small,
        is_compact=is_compact,
        extent_mm=extent_mm,
    )


def _area_mm2(recipe: PressRecipe, rng: np.random.Generator) -> float:
    """Area of a face: the small ones are below 3 % of a GelSight Mini's sensing area."""
    return log_uniform(rng, 3.5, 8) if recipe.small else log_uniform(rng, 10, 90)


def _cuboid(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    area, aspect = _area_mm2(recipe, rng), rng.uniform(1, 2.2)
    half_u, half_v = 0.5 * math.sqrt(area * aspect), 0.5 * math.sqrt(area / aspect)
    if rng.random() < 0.4:
        power = rng.uniform(7, 14)
        return _face(
            "superellipse",
            lambda u, v: superellipse(u, v, half_u, half_v, power),
            recipe,
            rng,
            extent_mm=2 * half_u,
        )
    corners = np.array([(-half_u, -half_v), (half_u, -half_v), (half_u, half_v), (-half_u, half_v)])
    corners *= 1 + rng.uniform(-0.03, 0.03, corners.shape)
    return _face(
        "rectangle", lambda u, v: polygon(u, v, corners), recipe, rng, extent_mm=2 * half_u
    )


TRIANGLES = ("even", "right", "obtuse", "slender")


def triangle_angles(kind: str, rng: np.random.Generator) -> tuple[float, float]:
    """Two angles of a triangle of a kind out of ``TRIANGLES`` [rad]; the third follows."""
    degrees = {
        "even": (rng.uniform(52, 68), rng.uniform(52, 68)),
        "right": (90.0, rng.uniform(32, 58)),
        "obtuse": (float(first := rng.uniform(103, 135)), rng.uniform(0.35, 0.65) * (180 - first)),
        "slender": (rng.uniform(18, 28), rng.uniform(68, 88)),
    }[kind]
    return math.radians(degrees[0]), math.radians(degrees[1])


def _triangle(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    kind = TRIANGLES[int(rng.integers(len(TRIANGLES)))]
    first, second = triangle_angles(kind, rng)
    # A base of length 1 with both angles at its ends.
    high = math.tan(first) * math.tan(second) / (math.tan(first) + math.tan(second))
    corners = np.array([(0.0, 0.0), (1.0, 0.0), (high / math.tan(first), high)])
    corners = (corners - corners.mean(axis=0)) * math.sqrt(_area_mm2(recipe, rng) / (0.5 * high))
    extent = float(np.ptp(corners, axis=0).max())
    return _face(kind, lambda u, v: polygon(u, v, corners), recipe, rng, extent_mm=extent)


def _hexagon(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    area = _area_mm2(recipe, rng) * (1.5 if recipe.small else 1)
    radius = math.sqrt(area / 2.6) * (1 + rng.uniform(-0.04, 0.04, 6))
    angles = np.arange(6) * math.pi / 3
    stretch = np.array([1.0, rng.uniform(0.87, 1.0)])
    corners = np.stack([radius * np.cos(angles), radius * np.sin(angles)], axis=1) * stretch
    return _face(
        "hexagon", lambda u, v: polygon(u, v, corners), recipe, rng, extent_mm=2 * radius.max()
    )


def _disc(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    radius, oval = math.sqrt(_area_mm2(recipe, rng) / math.pi), rng.uniform(0.94, 1)
    return _face(
        "disc",
        lambda u, v: superellipse(u, v, radius, oval * radius, 2),
        recipe,
        rng,
        extent_mm=2 * radius,
    )


def _plane(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """A face that leaves the pad free at one side or at one corner."""
    bend = rng.uniform(0, 0.5) if rng.random() < 0.5 else 0.0
    return _face(
        "corner of a face" if bend else "side of a face",
        lambda u, v: u + bend * np.abs(v),
        recipe,
        rng,
        extent_mm=25,
        is_compact=False,
    )


def _ring(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    radius = rng.uniform(1.5, 2.1) if recipe.small else rng.uniform(2, 6)
    half_width, oval = rng.uniform(0.25, min(1.0, 0.22 * radius)), rng.uniform(1, 1.2)
    return _face(
        "oval ring" if oval > 1.08 else "ring",
        lambda u, v: np.abs(np.hypot(u, oval * v) - radius) - half_width,
        recipe,
        rng,
        half_width_mm=half_width,
        extent_mm=2 * radius,
        textured=False,
    )


def _bite(radius: float, rng: np.random.Generator) -> tuple[float, float]:
    """Radius and shift of the circle that is taken from another, whose horns stay well apart."""
    while True:
        bite, thick = radius * rng.uniform(0.75, 1.1), radius * rng.uniform(0.3, 0.6)
        shift = bite - radius + thick
        horn = (radius**2 + shift**2 - bite**2) / (2 * radius * shift)
        if -0.3 < horn < 0.6:  # 53 to 107 degrees from the middle of the opening
            return bite, shift


def _crescent(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    radius = rng.uniform(1.8, 2.5) if recipe.small else rng.uniform(2.5, 6.5)
    if rng.random() < 0.6:
        bite, shift = _bite(radius, rng)
        return _face(
            "moon",
            lambda u, v: moon(u, v, radius, bite, shift),
            recipe,
            rng,
            extent_mm=2 * radius,
            textured=False,
        )
    turn, half_width = math.radians(rng.uniform(95, 230)), rng.uniform(0.3, 0.2 * radius)
    points = bow(0.5 * turn * radius, turn)
    points = points - points.mean(axis=0)
    return _face(
        "arc",
        lambda u, v: polyline(u, v, points) - half_width,
        recipe,
        rng,
        half_width_mm=half_width,
        extent_mm=2 * radius,
        textured=False,
    )


def _hole(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """A round, rectangular or hexagonal face with a round hole, a slot or a square one."""
    half = rng.uniform(1.9, 2.3) if recipe.small else rng.uniform(2.8, 6)
    power, aspect = float(rng.choice([2.0, 9.0])), rng.uniform(0.8, 1)
    inner, inner_power = half * rng.uniform(0.35, 0.5), float(rng.choice([2.0, 4.0]))
    slot, off = rng.uniform(0.7, 1), rng.uniform(-0.12, 0.12, 2) * half

    def outline(u: FloatArray, v: FloatArray) -> FloatArray:
        face = superellipse(u, v, half, aspect * half, power)
        cavity = superellipse(u - off[0], v - off[1], inner, slot * inner, inner_power)
        return np.maximum(face, -cavity)

    return _face("hole", outline, recipe, rng, extent_mm=2 * half)


FACES: dict[Shape, Callable[[PressRecipe, np.random.Generator], HeightBody]] = {
    Shape.CUBOID: _cuboid,
    Shape.TRIANGLE: _triangle,
    Shape.HEXAGON: _hexagon,
    Shape.DISC: _disc,
    Shape.PLANE: _plane,
    Shape.RING: _ring,
    Shape.CRESCENT: _crescent,
    Shape.HOLE: _hole,
}
