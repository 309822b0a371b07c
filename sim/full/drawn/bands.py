"""Faces around something: rings, crescents, and faces with a cavity."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.full.drawn.faces import Draw, regular
from sim.full.drawn.outlines import arc, polygon, rectangle, rounded_power
from sim.full.drawn.surface import Draws, Height, Surface, face, round_bar

LEAST_CAVITY_MM = 0.95
"""Least radius of a cavity that a gel of a few mm thickness shows. Our choice."""


def _ring(outline_of: Callable[[Draws, float], Height], *, is_round: bool = False) -> Draw:
    """A ring by the distance from its middle line; ``is_round``: of wire."""

    def draw(draws: Draws) -> Surface:
        radius = draws.size(1.8, 6, (1.1, 2.0))
        half = draws.uniform(0.22, min(1.0 if not is_round else 0.85, 0.22 * radius + 0.05))
        middle = outline_of(draws, radius)
        return _band(Shape.RING, middle, draws, half, 1.15 * radius + half, is_round=is_round)

    return draw


def _band(
    shape: Shape, middle: Height, draws: Draws, half: float, extent: float, *, is_round: bool
) -> Surface:
    """A narrow band along a line: flat, or round as a wire."""
    if not is_round:
        return face(
            shape,
            lambda u, v: middle(u, v) - half,
            draws,
            half_width_mm=half,
            extent_mm=extent,
            can_be_textured=False,
        )
    return Surface(
        shape=shape,
        behind_mm=lambda u, v: round_bar(middle(u, v), half),
        elements=lambda u, v: np.where(middle(u, v) < 0.4 * half, 0, -1),
        needed=1,
        extent_mm=extent,
        is_flat=True,
    )


def _ring_line(draws: Draws, radius: float) -> Height:
    return lambda u, v: np.abs(np.hypot(u, v) - radius)


def _ring_oval(draws: Draws, radius: float) -> Height:
    ratio = draws.uniform(0.78, 0.95)
    return lambda u, v: np.abs(rounded_power(u, v, radius, ratio * radius, 2.0))


def _ring_nut(draws: Draws, radius: float) -> Height:
    corners = regular(draws.count(8, 12), radius)
    return lambda u, v: np.abs(polygon(u, v, corners))


def _crescent(low_deg: float, high_deg: float, *, is_round: bool) -> Draw:
    """Part of a ring, of an angle in all between two limits [°]."""

    def draw(draws: Draws) -> Surface:
        half_angle = math.radians(draws.uniform(low_deg, high_deg)) / 2
        radius = draws.size(2.2, 6.5, (1.4, 2.2))
        half = draws.uniform(0.22, min(0.9, 0.2 * radius + 0.1))
        # About the middle of its arc.
        shift = radius * math.sin(half_angle) / half_angle if half_angle < 2 else 0.0
        extent = max(radius * math.sin(min(half_angle, math.pi / 2)), 0.6 * radius) + half

        def middle(u: FloatArray, v: FloatArray) -> FloatArray:
            return arc(u + shift, v, radius, half_angle)

        return _band(Shape.CRESCENT, middle, draws, half, extent, is_round=is_round)

    return draw


def _moon(draws: Draws) -> Surface:
    """A disc less a larger or smaller one beside it: its horns run out to points."""
    radius = draws.size(2.2, 6, (1.5, 2.3))
    while True:
        bite, thick = radius * draws.uniform(0.7, 1.15), radius * draws.uniform(0.28, 0.62)
        shift = bite - radius + thick
        horn = (radius**2 + shift**2 - bite**2) / (2 * radius * shift)
        if -0.5 < horn < 0.65:
            break

    def outline(u: FloatArray, v: FloatArray) -> FloatArray:
        return np.maximum(np.hypot(u, v) - radius, bite - np.hypot(u - shift, v))

    return face(
        Shape.CRESCENT,
        outline,
        draws,
        half_width_mm=0.5 * thick,
        extent_mm=radius,
        can_be_textured=False,
    )


def _hole(outer: str, cavity: str) -> Draw:
    """A round, square or hexagonal face with a round or square cavity or a slot, off its middle."""

    def draw(draws: Draws) -> Surface:
        half = draws.size(2.6, 5.8, (1.9, 2.4))
        inner = min(max(half * draws.uniform(0.32, 0.5), LEAST_CAVITY_MM), 0.5 * half)
        off = draws.rng.uniform(-0.15, 0.15, 2) * half
        aspect = draws.uniform(0.8, 1)
        slot = max(draws.uniform(0.45, 0.8), 0.9 * LEAST_CAVITY_MM / inner)
        hexagon = regular(6, 1.1 * half, draws.uniform(0, 1))

        def outline(u: FloatArray, v: FloatArray) -> FloatArray:
            if outer == "hexagon":
                distance = polygon(u, v, hexagon)
            elif outer == "square":
                distance = rectangle(u, v, half, aspect * half)
            else:
                distance = rounded_power(u, v, half, aspect * half, 2.0)
            at_u, at_v = u - off[0], v - off[1]
            if cavity == "round":
                within = np.hypot(at_u, at_v) - inner
            elif cavity == "square":
                within = rectangle(at_u, at_v, inner, 0.85 * inner) - 0.1 * inner
            else:
                within = rounded_power(at_u, at_v, 1.2 * inner, slot * inner, 3.0)
            return np.maximum(distance, -within)

        return face(
            Shape.HOLE,
            outline,
            draws,
            half_width_mm=max(0.5 * (0.8 * half - 1.2 * inner), 0.2),
            extent_mm=1.2 * half,
        )

    return draw


BANDS: Mapping[Shape, Mapping[str, Draw]] = {
    Shape.RING: {
        "ring_flat": _ring(_ring_line),
        "ring_wire": _ring(_ring_line, is_round=True),
        "ring_oval": _ring(_ring_oval),
        "ring_nut": _ring(_ring_nut),
    },
    Shape.CRESCENT: {
        "crescent_flat": _crescent(95, 200, is_round=False),
        "crescent_wire": _crescent(95, 200, is_round=True),
        "crescent_horseshoe": _crescent(190, 275, is_round=False),
        "crescent_moon": _moon,
    },
    Shape.HOLE: {
        "hole_round": _hole("round", "round"),
        "hole_panel": _hole("square", "round"),
        "hole_nut": _hole("hexagon", "round"),
        "hole_slot": _hole("square", "slot"),
        "hole_square": _hole("round", "square"),
    },
}
"""Of each shape: its objects by name."""
