"""Round and sharp bodies: balls, ellipsoids, rods, tips, edges and corners, outer and inner."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.full.drawn.surface import Draws, Height, Surface, dome, no_elements
from sim.gel.gap import NO_BODY_MM

Draw = Callable[[Draws], Surface]


def _round(shape: Shape, behind: Height, draws: Draws, extent_mm: float) -> Surface:
    return Surface(
        shape=shape,
        behind_mm=behind,
        elements=no_elements,
        extent_mm=extent_mm,
        can_be_textured=not draws.small,
    )


def _contact_radius(radius: float, draws: Draws) -> float:
    """About the radius of the contact of a ball at a middling press [mm]."""
    return math.sqrt(2 * radius * max(draws.lightest_mm, 0.15))


def _tip_radius(draws: Draws) -> float:
    return draws.log(0.7, 3.0) if draws.small else draws.log(2.0, 70)


def _sphere(low: float, high: float, oval: float = 1.0) -> Draw:
    """A ball, paraboloid or hyperboloid; ``oval``: largest ratio of its curvatures."""

    def draw(draws: Draws) -> Surface:
        radius, opening = _tip_radius(draws), draws.uniform(low, high)
        stretch = math.sqrt(draws.uniform(1, oval))

        def behind(u: FloatArray, v: FloatArray) -> FloatArray:
            return dome(u**2 * stretch + v**2 / stretch, radius, opening)

        return _round(Shape.SPHERE, behind, draws, _contact_radius(radius, draws))

    return draw


def _cut_ball(draws: Draws) -> Surface:
    """A ball's cap on the end of a rod, not larger than the rod."""
    radius = _tip_radius(draws)
    limit = max(_contact_radius(radius, draws) * draws.uniform(1.3, 2.5), 0.8)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        squared = u**2 + v**2
        return np.where(squared < limit**2, dome(squared, radius, -1.0), NO_BODY_MM)

    return _round(Shape.SPHERE, behind, draws, _contact_radius(radius, draws))


def _ratio(draws: Draws) -> float:
    return draws.log(1.6, 3.6)


def _ellipsoid(low: float, high: float, egg: float = 0.0) -> Draw:
    """``egg``: largest difference of the two ends of its long axis."""

    def draw(draws: Draws) -> Surface:
        radius = draws.log(0.7, 2.2) if draws.small else draws.log(1.6, 16)
        ratio, opening, uneven = _ratio(draws), draws.uniform(low, high), draws.uniform(0, egg)

        def behind(u: FloatArray, v: FloatArray) -> FloatArray:
            along = ratio * (1 + uneven * np.tanh(u))
            return dome(u**2 / along + v**2, radius, opening)

        extent = _contact_radius(radius * ratio, draws)
        return _round(Shape.ELLIPSOID, behind, draws, extent)

    return draw


def _torus_side(draws: Draws) -> Surface:
    """The outside of a thick bent tube."""
    radius = draws.log(0.7, 2.0) if draws.small else draws.log(1.6, 12)
    ring = radius * _ratio(draws)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        inside = 1 - (v / radius) ** 2
        tube = radius * np.sqrt(inside.clip(min=0))
        reach = (ring - radius + tube) ** 2 - u**2
        surface = ring - np.sqrt(reach.clip(min=0))
        return np.where((inside > 0) & (reach > 0), surface, NO_BODY_MM)

    return _round(Shape.ELLIPSOID, behind, draws, _contact_radius(ring, draws))


def _cylinder(kind: str) -> Draw:
    """The side of a rod: long, ending, tapered, bent, or with flattened flanks."""

    def draw(draws: Draws) -> Surface:
        radius = draws.log(1.6, 3) if draws.small else draws.log(1.8, 16)
        half = draws.uniform(1.6, 3.0) if draws.small else draws.log(5, 16)
        half = half if kind in ("ends", "tapered") or draws.small else 30.0
        taper = draws.uniform(0.01, 0.05) if kind == "tapered" else 0.0
        bend = 1 / draws.uniform(7 * radius, 30 * radius) if kind == "bent" else 0.0
        opening = draws.uniform(0.2, 2) if kind == "flanks" else draws.uniform(-1, 0)

        def behind(u: FloatArray, v: FloatArray) -> FloatArray:
            side = dome(v**2 * (1 + taper * u), radius, opening) + 0.5 * bend * u**2
            return np.where(np.abs(u) < half, side, NO_BODY_MM)

        return Surface(
            shape=Shape.CYLINDER,
            behind_mm=behind,
            elements=no_elements,
            extent_mm=min(half, 6.0),
            is_compact=False,
            can_be_textured=not draws.small,
            largest_lean=0.008,
        )

    return draw


def _tip(height_of: Callable[[Draws], Height]) -> Draw:
    """A tip by the distance from its axis; half-angle 20-60°, a little blunt."""

    def draw(draws: Draws) -> Surface:
        steep = 1 / math.tan(math.radians(draws.uniform(20, 60)))
        blunt, radial = draws.log(0.02, 0.3), height_of(draws)

        def behind(u: FloatArray, v: FloatArray) -> FloatArray:
            return np.asarray(np.hypot(steep * radial(u, v), blunt) - blunt)

        return Surface(
            shape=Shape.PEAK,
            behind_mm=behind,
            elements=no_elements,
            extent_mm=1.0,
            largest_lean=min(0.25, 0.3 * steep),
        )

    return draw


def _pyramid(draws: Draws) -> Height:
    num = draws.one_of((4, 5, 6, 8))
    angles = np.arange(num) * 2 * math.pi / num
    angles = angles + draws.rng.uniform(-0.08, 0.08, num)
    steep = 1 + draws.rng.uniform(-0.1, 0.1, num)
    return lambda u, v: np.maximum.reduce(
        [k * (u * math.cos(a) + v * math.sin(a)) for k, a in zip(steep, angles, strict=True)]
    )


def _squarish(draws: Draws) -> Height:
    power, ratio = draws.uniform(2.5, 6), draws.uniform(0.8, 1)
    return lambda u, v: (np.abs(u) ** power + np.abs(v * ratio) ** power) ** (1 / power)


def _stepped(draws: Draws) -> Height:
    """A cone whose flank bends once, as that of a sharpened pencil."""
    bend, slope = draws.uniform(0.3, 0.8), draws.uniform(0.6, 1.6)

    def radial(u: FloatArray, v: FloatArray) -> FloatArray:
        r = np.hypot(u, v)
        return np.where(r < bend, r, bend + slope * (r - bend))

    return radial


def _smooth_max(faces: list[FloatArray], blunt: float) -> FloatArray:
    """Largest of several faces, their edges rounded, 0 at its least."""
    top = np.maximum.reduce(faces)
    total = np.sum([np.exp((each - top) / blunt) for each in faces], axis=0)
    return np.asarray(top + blunt * np.log(total) - blunt * math.log(len(faces)))


def _edge(kind: str) -> Draw:
    """Dihedral of 60-120°: upright, leaning, short, or along a slightly bent line."""

    def draw(draws: Draws) -> Surface:
        opening = math.radians(draws.uniform(60, 120))
        lean = math.radians(draws.uniform(-14, 14)) if kind == "leaning" else 0.0
        slopes = [1 / math.tan(opening / 2 + sign * lean) for sign in (1, -1)]
        half = draws.uniform(1.5, 2.6) if draws.small else draws.log(3.5, 10)
        half = half if kind == "short" or draws.small else 30.0
        bend = draws.uniform(0.005, 0.025) if kind == "bent" else 0.0
        blunt = draws.log(0.01, 0.15)

        def behind(u: FloatArray, v: FloatArray) -> FloatArray:
            at = v - bend * u**2
            roof = _smooth_max([slopes[0] * at, -slopes[1] * at], blunt)
            return np.where(np.abs(u) < half, roof, NO_BODY_MM)

        return Surface(
            shape=Shape.EDGE,
            behind_mm=behind,
            elements=no_elements,
            extent_mm=min(half, 5.0),
            is_compact=False,
            largest_lean=0.008,
        )

    return draw


def _corner(kind: str) -> Draw:
    """Three faces that meet; one may be folded inwards, or the corner may be that of a long box."""

    def draw(draws: Draws) -> Surface:
        spread = 0.35 if kind == "box" else 0.2
        steep = 1 / math.tan(math.radians(draws.uniform(47, 60)))
        slopes = steep * (1 + draws.rng.uniform(-spread, spread, 4))
        angles = np.radians([0.0, 120.0, 240.0]) + draws.rng.uniform(-0.2, 0.2, 3)
        fold = math.radians(draws.uniform(14, 30)) if kind == "inner" else 0.0
        blunt = draws.log(0.01, 0.12 if kind != "worn" else 0.3)

        def behind(u: FloatArray, v: FloatArray) -> FloatArray:
            faces = [
                k * (u * math.cos(a) + v * math.sin(a))
                for k, a in zip(slopes[:2], angles[:2], strict=True)
            ]
            last = [
                slopes[2] * (u * math.cos(a) + v * math.sin(a))
                for a in {angles[2] - fold, angles[2] + fold}
            ]
            return _smooth_max([*faces, np.minimum.reduce(last)], blunt)

        return Surface(
            shape=Shape.CORNER,
            behind_mm=behind,
            elements=no_elements,
            extent_mm=1.5,
            largest_lean=0.12,
        )

    return draw


ROUNDS: Mapping[Shape, Mapping[str, Draw]] = {
    Shape.SPHERE: {
        "sphere_ball": _sphere(-1, -1),
        "sphere_paraboloid": _sphere(-0.4, 0.4),
        "sphere_hyperboloid": _sphere(0.4, 1.5),
        "sphere_oval": _sphere(-1, 0.8, 1.25),
        "sphere_cap": _cut_ball,
    },
    Shape.ELLIPSOID: {
        "ellipsoid": _ellipsoid(-1, -1),
        "ellipsoid_egg": _ellipsoid(-0.8, 0.6, 0.25),
        "ellipsoid_flat": _ellipsoid(0.4, 1.3),
        "ellipsoid_torus": _torus_side,
    },
    Shape.CYLINDER: {
        f"cylinder_{kind}": _cylinder(kind)
        for kind in ("long", "ends", "tapered", "bent", "flanks")
    },
    Shape.PEAK: {
        "peak_cone": _tip(lambda _: np.hypot),
        "peak_pyramid": _tip(_pyramid),
        "peak_squarish": _tip(_squarish),
        "peak_stepped": _tip(_stepped),
    },
    Shape.EDGE: {f"edge_{kind}": _edge(kind) for kind in ("upright", "leaning", "short", "bent")},
    Shape.CORNER: {f"corner_{kind}": _corner(kind) for kind in ("outer", "inner", "box", "worn")},
}
"""Of each shape: its objects by name."""
