"""Bodies of the 19 shapes as height functions, parametrised otherwise than ``sim.full``.

Not here: what of a body touches, and whether its label then holds (``sim.independent.contacts``).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.gel.gap import NO_BODY_MM
from sim.independent.faces import FACES
from sim.independent.patterns import PATTERNS
from sim.independent.recipe import HeightBody, PressRecipe, log_uniform


def draw_body(shape: Shape, recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """Draw a body of a shape."""
    return DRAWS[shape](recipe, rng)


def _dome(squared: FloatArray, radius: float, opening: float) -> FloatArray:
    """Hyperboloid: curvature 1 / radius at its tip, towards a cone far away."""
    return (np.sqrt(1 + opening * squared / radius**2) - 1) * (radius / opening)


def _sphere(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    radius = log_uniform(rng, 1.5, 4) if recipe.small else log_uniform(rng, 2.5, 40)
    oval, opening = math.sqrt(rng.uniform(1, 1.2)), rng.uniform(0.1, 1.2)
    return HeightBody(
        variant="dome",
        behind_mm=lambda u, v: _dome(oval * u**2 + v**2 / oval, radius, opening),
        textured=not recipe.small,
    )


def _ellipsoid(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """An egg: the two ends of its long axis differ."""
    radius = log_uniform(rng, 1.2, 2.5) if recipe.small else log_uniform(rng, 2, 12)
    ratio, opening, egg = rng.uniform(1.75, 3.4), rng.uniform(0.1, 1.0), rng.uniform(0, 0.2)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        along = ratio * (1 + egg * np.sign(u))
        return _dome(u**2 / along + v**2, radius, opening)

    return HeightBody(variant="egg", behind_mm=behind, textured=not recipe.small)


def _cylinder(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """The side of a rod, straight, tapered, or a little barrelled."""
    radius = log_uniform(rng, 2, 3.5) if recipe.small else log_uniform(rng, 2.2, 13)
    half = log_uniform(rng, 2.5, 4) if recipe.small else log_uniform(rng, 6, 30)
    opening, taper = rng.uniform(0.1, 0.8), rng.uniform(-0.012, 0.012)
    barrel = 1 / rng.uniform(12 * radius, 60 * radius) if rng.random() < 0.3 else 0.0

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        side = _dome(v**2, radius, opening) * (1 + taper * u) + 0.5 * barrel * u**2
        return np.where(np.abs(u) < half, side, NO_BODY_MM)

    return HeightBody(variant="rod", behind_mm=behind, textured=not recipe.small, is_compact=False)


def _peak(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """Cone, or pyramid of four, five or eight faces, or one with rounded faces; its tip blunt."""
    steep = 1 / math.tan(math.radians(rng.uniform(22, 58)))
    blunt, faces = rng.uniform(0.03, 0.2), int(rng.choice([0, 1, 4, 5, 8]))
    angles = np.arange(faces) * 2 * math.pi / max(faces, 1)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        if faces == 0:
            r = np.hypot(u, v)
        elif faces == 1:
            r = (u**4 + v**4) ** 0.25
        else:
            r = np.maximum.reduce([u * math.cos(a) + v * math.sin(a) for a in angles])
        return np.asarray(np.hypot(steep * r, blunt) - blunt)

    return HeightBody(variant="cone" if faces == 0 else "pyramid", behind_mm=behind, max_tilt=0.2)


def _edge(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """Dihedral of 60-120° that leans to one side, its crest blunt, its line sagging or straight."""
    opening, lean = math.radians(rng.uniform(62, 118)), math.radians(rng.uniform(-10, 10))
    slopes = (1 / math.tan(opening / 2 + lean), 1 / math.tan(opening / 2 - lean))
    half = log_uniform(rng, 1.5, 2.5) if recipe.small else log_uniform(rng, 4, 25)
    soft = rng.uniform(0.02, 0.15)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        roof = soft * np.logaddexp(slopes[0] * v / soft, -slopes[1] * v / soft)
        return np.where(np.abs(u) < half, roof, NO_BODY_MM)

    return HeightBody(variant="edge", behind_mm=behind, is_compact=False, max_tilt=0.01)


def _corner(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """Three faces, outer; or one of them folded inwards."""
    steep = 1 / math.tan(math.radians(rng.uniform(48, 60))) * rng.uniform(0.8, 1.25, 4)
    folded = rng.random() < 0.35
    apart = math.radians(rng.uniform(12, 22)) if folded else 0.0
    angles = np.radians([0.0, 120.0, 240.0, 240.0]) + np.array([0, 0, -apart, apart])
    angles[:3] += np.radians(rng.uniform(-10, 10, 3)) * (not folded)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        faces = [
            k * (u * math.cos(a) + v * math.sin(a)) for k, a in zip(steep, angles, strict=True)
        ]
        third = np.minimum(faces[2], faces[3]) if folded else faces[2]
        return np.maximum.reduce([faces[0], faces[1], third])

    return HeightBody(
        variant="inner corner" if folded else "outer corner", behind_mm=behind, max_tilt=0.1
    )


ROUNDS: dict[Shape, Callable[[PressRecipe, np.random.Generator], HeightBody]] = {
    Shape.SPHERE: _sphere,
    Shape.ELLIPSOID: _ellipsoid,
    Shape.CYLINDER: _cylinder,
    Shape.PEAK: _peak,
    Shape.EDGE: _edge,
    Shape.CORNER: _corner,
}

DRAWS = ROUNDS | FACES | PATTERNS
"""What draws a body of each shape."""
