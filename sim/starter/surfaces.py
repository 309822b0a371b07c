"""Surfaces of the 19 shapes of the vocabulary, with parameters drawn from ranges.

A surface is the depth of a shape behind its foremost point, in its own frame (u, v) [mm];
``NO_BODY_MM`` where there is none. Limits between shapes are those of
``cltp.tactile.states.Shape``; sizes are our choice, so that contacts of every area occur.

Not here: pose on the pad (``sim.starter.shapes``).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.gel.gap import NO_BODY_MM
from sim.starter.outlines import arc, circle, convex, rectangle, segment

Surface = Callable[[FloatArray, FloatArray], FloatArray]


def _cap(squared: FloatArray, height: float) -> FloatArray:
    """Round surface, ``height`` behind its tip where ``squared`` reaches 1."""
    return np.where(squared < 1, height * (1 - np.sqrt((1 - squared).clip(min=0))), NO_BODY_MM)


def _punch(distance: FloatArray, fillet: float) -> FloatArray:
    """Flat face within an outline, its rim rounded by ``fillet`` [mm]."""
    return np.where(
        distance < 0, _cap(((distance / fillet + 1).clip(min=0)) ** 2, fillet), NO_BODY_MM
    )


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(low * (high / low) ** rng.random())


def _fillet(rng: np.random.Generator) -> float:
    return float(rng.uniform(0.15, 0.4))


def _sphere(rng: np.random.Generator) -> Surface:
    radius, oval = _log(rng, 2, 60), math.sqrt(rng.uniform(1, 1.25))
    return lambda u, v: _cap((u**2 * oval + v**2 / oval) / radius**2, radius)


def _ellipsoid(rng: np.random.Generator) -> Surface:
    """Radii of curvature r and ratio · r at the tip."""
    r, ratio = _log(rng, 2, 15), _log(rng, 1.55, 4)
    height = r * rng.uniform(0.7, 1.5)
    return lambda u, v: _cap(u**2 / (r * ratio * height) + v**2 / (r * height), height)


def _cylinder(rng: np.random.Generator) -> Surface:
    radius, half = _log(rng, 1.5, 15), _log(rng, 5, 30)
    return lambda u, v: np.where(np.abs(u) < half, _cap((v / radius) ** 2, radius), NO_BODY_MM)


def _cuboid(rng: np.random.Generator) -> Surface:
    half = _log(rng, 1.2, 6)
    other, fillet = half / rng.uniform(1, 2.2), _fillet(rng)
    return lambda u, v: _punch(rectangle(u, v, half, other), fillet)


def _polygon(angles: FloatArray, radius: float, fillet: float) -> Surface:
    corners = [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]
    return lambda u, v: _punch(convex(u, v, corners), fillet)


def _triangle(rng: np.random.Generator) -> Surface:
    """From equilateral to scalene; no corner sharper than 30°."""
    angles = np.array([0.0, 120.0, 240.0]) + rng.uniform(-28, 28, 3) * rng.integers(0, 2)
    return _polygon(np.radians(angles), _log(rng, 2.2, 7), _fillet(rng))


def _hexagon(rng: np.random.Generator) -> Surface:
    return _polygon(np.radians(np.arange(6) * 60.0), _log(rng, 2, 6.5), _fillet(rng))


def _disc(rng: np.random.Generator) -> Surface:
    radius, fillet = _log(rng, 1.2, 6.5), _fillet(rng)
    return lambda u, v: _punch(circle(u, v, radius), fillet)


def _peak(rng: np.random.Generator) -> Surface:
    """Cone or pyramid of four or six faces, half-angle 20-60°, its tip a little blunt."""
    steep, blunt = 1 / math.tan(math.radians(rng.uniform(20, 60))), rng.uniform(0.05, 0.25)
    faces = int(rng.choice([0, 4, 6]))

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        r = np.hypot(u, v)
        if faces:
            step = 2 * math.pi / faces
            off = (np.arctan2(v, u) + step / 2) % step - step / 2
            r = r * np.cos(off)
        return np.asarray(np.hypot(r * steep, blunt) - blunt)

    return behind


def _corner(rng: np.random.Generator) -> Surface:
    """Three faces, at different slopes: about the corner of a box, tip first."""
    steep = 1 / math.tan(math.radians(54.7)) * rng.uniform(0.75, 1.3, 3)
    angles = np.radians(np.array([0.0, 120.0, 240.0]) + rng.uniform(-12, 12, 3))
    return lambda u, v: np.maximum.reduce(
        [k * (u * math.cos(a) + v * math.sin(a)) for k, a in zip(steep, angles, strict=True)]
    )


def _edge(rng: np.random.Generator) -> Surface:
    """Dihedral of 60-120°, a little blunt, long or ending within the sensing area."""
    steep = 1 / np.tan(np.radians(rng.uniform(30, 60) + rng.uniform(-8, 8) * np.array([1, -1])))
    blunt, half = rng.uniform(0.05, 0.25), _log(rng, 4, 25)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        roof = np.hypot(np.where(v > 0, steep[0], steep[1]) * v, blunt) - blunt
        return np.where(np.abs(u) < half, roof, NO_BODY_MM)

    return behind


def _plane(rng: np.random.Generator) -> Surface:
    """A face that ends at one straight edge, at u = 0, with the face on the side of -u."""
    fillet = _fillet(rng)
    return lambda u, v: _punch(u, fillet)


def _bar(rng: np.random.Generator) -> tuple[Callable[[FloatArray], FloatArray], float]:
    """Profile of a bar over the distance from its middle, round or flat, and its half width."""
    half = float(rng.uniform(0.25, 0.75))
    if rng.random() < 0.5:
        return (lambda distance: _cap((distance / half) ** 2, half)), half
    return (lambda distance: _punch(distance - half, 0.5 * half)), half


def _line(rng: np.random.Generator) -> Surface:
    (profile, _), half = _bar(rng), _log(rng, 2.5, 14)
    return lambda u, v: profile(segment(u, v, (-half, 0), (half, 0)))


def _cross(rng: np.random.Generator) -> Surface:
    (profile, _), angle = _bar(rng), math.radians(rng.uniform(55, 90))
    first, second = rng.uniform(2.5, 8), rng.uniform(2.5, 8)
    end = (second * math.cos(angle), second * math.sin(angle))
    return lambda u, v: profile(
        np.minimum(segment(u, v, (-first, 0), (first, 0)), segment(u, v, (-end[0], -end[1]), end))
    )


def _stripes(rng: np.random.Generator) -> Surface:
    """Two to five parallel bars, whole or in segments."""
    profile, half_width = _bar(rng)
    pitch = 2 * half_width + rng.uniform(1.0, 2.2)
    half, count = _log(rng, 2.5, 12), int(rng.integers(2, 6))
    lines = (np.arange(count) - (count - 1) / 2) * pitch
    cuts = rng.uniform(-0.3, 0.3, count) * half if rng.random() < 0.25 else None

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        distance = np.full(np.shape(u), np.inf)
        for i, y_mm in enumerate(lines):
            middle = half if cuts is None else cuts[i]
            parts = [(-half, middle)] if cuts is None else [(-half, middle), (middle + 2.2, half)]
            for start, end in parts:
                if end > start:
                    distance = np.minimum(distance, segment(u, v, (start, y_mm), (end, y_mm)))
        return profile(distance)

    return behind


def _ring(rng: np.random.Generator) -> Surface:
    (profile, _), radius = _bar(rng), rng.uniform(1.8, 6)
    return lambda u, v: profile(arc(u, v, radius, math.pi))


def _crescent(rng: np.random.Generator) -> Surface:
    (profile, _), radius = _bar(rng), rng.uniform(2.2, 7)
    half_angle = math.radians(rng.uniform(50, 125))
    # About its own middle, so that its origin is on it.
    return lambda u, v: profile(arc(u + radius, v, radius, half_angle))


_DOT_BASE_MM = 1.6
"""Depth of the base behind the tops of dots, out of reach of the deepest press."""


def _dots(rng: np.random.Generator) -> Surface:
    """Three to twelve round bumps on a square or hexagonal lattice, on a flat or curved base."""
    pitch = rng.uniform(2, 5)
    radius = rng.uniform(0.5, 0.9)
    count, skew = int(rng.integers(3, 13)), rng.choice([0.0, 0.5])
    i, j = (a.ravel().astype(np.float64) for a in np.mgrid[-3:4, -3:4])
    centres_u, centres_v = (i + skew * j) * pitch, j * pitch * math.sqrt(1 - skew**2)
    nearest = np.argsort(np.hypot(centres_u - 0.3 * pitch, centres_v - 0.2 * pitch))[:count]
    centres_u, centres_v = (
        centres_u[nearest] - centres_u[nearest].mean(),
        centres_v[nearest] - centres_v[nearest].mean(),
    )
    curved = 1 / rng.uniform(25, 60) if rng.random() < 0.3 else 0.0

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        base = np.full(np.shape(u), _DOT_BASE_MM)
        for centre_u, centre_v in zip(centres_u, centres_v, strict=True):
            squared = ((u - centre_u) ** 2 + (v - centre_v) ** 2) / radius**2
            base = np.minimum(base, _cap(squared, radius))
        return base + 0.5 * curved * (u**2 + v**2)

    return behind


def _wave(rng: np.random.Generator) -> Surface:
    """Sinusoid of wavelength 3-6 mm, over a rectangle that may exceed the sensing area."""
    length, amplitude = rng.uniform(3, 6), rng.uniform(0.15, 0.45)
    half_u, half_v, phase = _log(rng, 4, 14), _log(rng, 3, 12), rng.uniform(0, 2 * math.pi)
    return lambda u, v: np.where(
        rectangle(u, v, half_u, half_v) < 0,
        amplitude * (1 - np.cos(2 * math.pi * u / length + phase)),
        NO_BODY_MM,
    )


def _hole(rng: np.random.Generator) -> Surface:
    """Disc or rectangle with a round cavity."""
    half, fillet = rng.uniform(3, 6), _fillet(rng)
    other, cavity = half * rng.uniform(0.75, 1), half * rng.uniform(0.3, 0.6)
    is_round = rng.random() < 0.5

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        outer = circle(u, v, half) if is_round else rectangle(u, v, half, other)
        return _punch(np.maximum(outer, -circle(u, v, cavity)), fillet)

    return behind


SURFACES: dict[Shape, tuple[Callable[[np.random.Generator], Surface], float, bool]] = {
    Shape.SPHERE: (_sphere, 0, True),  # a tilted ball is a ball elsewhere
    Shape.ELLIPSOID: (_ellipsoid, 0, True),
    Shape.CUBOID: (_cuboid, 2, True),
    Shape.TRIANGLE: (_triangle, 2, True),
    Shape.HEXAGON: (_hexagon, 2, True),
    Shape.DISC: (_disc, 2, True),
    Shape.PEAK: (_peak, 15, False),
    Shape.PLANE: (_plane, 0.25, True),
    Shape.CYLINDER: (_cylinder, 2, True),
    Shape.RING: (_ring, 2, False),
    Shape.CRESCENT: (_crescent, 2, False),
    Shape.EDGE: (_edge, 3, False),
    Shape.CORNER: (_corner, 15, False),
    Shape.LINE: (_line, 2, False),
    Shape.CROSS: (_cross, 2, False),
    Shape.STRIPES: (_stripes, 2, False),
    Shape.DOTS: (_dots, 1, False),
    Shape.WAVE: (_wave, 1, True),
    Shape.HOLE: (_hole, 1.5, True),
}
"""Of each shape: what draws its surface, the largest tilt [°], and whether it can carry a texture.

A flat face tilted by more than a few degrees touches as an edge; a plane must still touch with 80 %
of the sensing area.
"""
