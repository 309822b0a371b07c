"""Bodies of bars, dots and crests: line, cross, stripes, dots, wave."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.gel.gap import NO_BODY_MM
from sim.independent.outlines import bow, polyline
from sim.independent.recipe import HeightBody, PressRecipe, bevelled, log_uniform

Profile = Callable[[FloatArray], FloatArray]


def _bar(rng: np.random.Generator, widest: float = 1.4) -> tuple[Profile, float]:
    """A bar with bevelled rims: its surface over the distance from its middle, its half width."""
    half = rng.uniform(0.25, 0.5 * widest)
    bevel, steep = half * rng.uniform(0.15, 0.5), rng.uniform(0.5, 1.5)
    return (lambda distance: bevelled(distance - half, bevel, steep)), half


def _line(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    half = rng.uniform(1.3, 2.2) if recipe.small else log_uniform(rng, 2.6, 12)
    turn = rng.uniform(0.25, 0.65) if rng.random() < 0.4 else 0.0
    profile, half_width = _bar(rng, 0.4 * half if recipe.small else 1.4)
    points = bow(half, turn)
    return HeightBody(
        variant="curved line" if turn else "straight line",
        behind_mm=lambda u, v: profile(polyline(u, v, points)),
        parts=lambda u, v: np.where(polyline(u, v, points) < half_width, 0, -1),
        is_compact=False,
        extent_mm=2 * half,
    )


def _cross(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """Two bars of their own widths and lengths that cross off their middles."""
    widest = 0.8 if recipe.small else 1.4
    (first, first_half), (second, second_half) = _bar(rng, widest), _bar(rng, widest)
    arms = rng.uniform(1.5, 2.2, 4) if recipe.small else rng.uniform(2, 6.5, 4)
    angle = math.radians(rng.uniform(55, 90))
    cos, sin = math.cos(angle), math.sin(angle)
    bars = (
        np.array([(-arms[0], 0.0), (arms[1], 0.0)]),
        np.array([(-arms[2] * cos, -arms[2] * sin), (arms[3] * cos, arms[3] * sin)]),
    )

    def parts(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
        """The four arms, without the crossing."""
        on_first = polyline(u, v, bars[0]) < first_half
        on_second = polyline(u, v, bars[1]) < second_half
        along = u * cos + v * sin
        number = np.where(on_first, np.where(u < 0, 0, 1), np.where(along < 0, 2, 3))
        return np.where((on_first ^ on_second) & (np.hypot(u, v) > 1.0), number, -1)

    return HeightBody(
        variant="cross",
        behind_mm=lambda u, v: np.minimum(
            first(polyline(u, v, bars[0])), second(polyline(u, v, bars[1]))
        ),
        parts=parts,
        needed=4,
        extent_mm=float(arms.max()) * 2,
    )


def _stripes(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """Parallel bars at uneven distances: straight, curved about one centre, or broken."""
    profile, half_width = _bar(rng, 0.8 if recipe.small else 1.4)
    count = 2 if recipe.small else int(rng.integers(2, 7))
    half = rng.uniform(1.5, 2.2) if recipe.small else log_uniform(rng, 3, 11)
    offsets = np.cumsum(2 * half_width + rng.uniform(1.0, 2.2, count))
    offsets -= offsets.mean()
    kind = ("straight", "curved", "broken")[int(rng.integers(2 if recipe.small else 3))]
    turn = rng.uniform(0.25, 0.6) if kind == "curved" else 0.0
    bars = []
    for offset in offsets:
        pieces = [(-1.0, 1.0)]
        if kind == "broken":
            cut, gap = (
                rng.uniform(-0.35, 0.35),
                0.5 * rng.uniform(1.0, 1.8) / half + half_width / half,
            )
            pieces = [(-1.0, cut - gap), (cut + gap, 1.0)]
        bars.append([bow(half, turn, float(offset), piece) for piece in pieces])

    def distances(u: FloatArray, v: FloatArray) -> FloatArray:
        """Distance from each bar, shape (bars, H, W)."""
        return np.stack(
            [np.minimum.reduce([polyline(u, v, piece) for piece in bar]) for bar in bars]
        )

    def parts(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
        each = distances(u, v)
        return np.where(each.min(axis=0) < half_width, each.argmin(axis=0), -1)

    return HeightBody(
        variant=f"{kind} stripes",
        behind_mm=lambda u, v: profile(distances(u, v).min(axis=0)),
        parts=parts,
        needed=2,
        is_compact=False,
        extent_mm=max(2 * half, float(np.ptp(offsets))),
    )


def _thrown(rng: np.random.Generator, spacing: float, reach: FloatArray, most: int) -> FloatArray:
    """Points (N, 2) in an oval, thrown until none fits at a distance or there are enough."""
    points = [np.zeros(2)]
    for _ in range(600):
        if len(points) == most:
            break
        point = rng.uniform(-1, 1, 2)
        if np.hypot(*point) < 1 and min(np.hypot(*(point * reach - p)) for p in points) > spacing:
            points.append(point * reach)
    return np.array(points)


def _dots(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """Bumps thrown at random: few to dozens, round or longish, of uneven height."""
    dense = not recipe.small and rng.random() < 0.65
    spacing = rng.uniform(1.2, 2.2) if dense or recipe.small else rng.uniform(1.6, 3.6)
    reach = rng.uniform(3.5, 9, 2) if dense else spacing * rng.uniform(1.1, 1.9, 2)
    centres = _thrown(rng, spacing, reach, 5 if recipe.small else 60 if dense else 8)
    count, longish = len(centres), rng.random() < 0.5
    radius = spacing * rng.uniform(0.26, 0.36) * (1 + rng.uniform(-0.12, 0.12, count))
    aspect = rng.uniform(1.3, 1.9, count) if longish else np.ones(count)
    # Longish dots lie at random, or nearly along one direction.
    angle = rng.uniform(0, math.pi, count) * (1.0 if rng.random() < 0.5 else 0.15)
    sunk = rng.uniform(0, 0.3, count) * recipe.depth_mm
    tall, bend = rng.uniform(0.5, 1.0), 0.5 / rng.uniform(25, 80) * (rng.random() < 0.3)
    base = 1.6

    def squared(u: FloatArray, v: FloatArray, i: int) -> FloatArray:
        off_u, off_v = u - centres[i, 0], v - centres[i, 1]
        along = off_u * math.cos(angle[i]) + off_v * math.sin(angle[i])
        across = off_v * math.cos(angle[i]) - off_u * math.sin(angle[i])
        grow = math.sqrt(aspect[i])
        return np.asarray(((along / grow) ** 2 + (across * grow) ** 2) / radius[i] ** 2)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        surface = np.full(np.shape(u), base)
        for i in range(count):
            q = squared(u, v, i)
            bump = np.where(q < 1, sunk[i] + tall * (1 - (1 - q).clip(min=0) ** 0.6), base)
            surface = np.minimum(surface, bump)
        return surface + bend * (u**2 + v**2)

    def parts(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
        each = np.stack([squared(u, v, i) for i in range(count)])
        return np.where(each.min(axis=0) < 1, each.argmin(axis=0), -1)

    kind = "longish dots" if longish else "round dots"
    return HeightBody(
        variant=f"dense {kind}" if count > 12 else kind,
        behind_mm=behind,
        parts=parts,
        needed=3,
        is_compact=not dense,
        extent_mm=2 * float(reach.max()),
    )


def _wave(recipe: PressRecipe, rng: np.random.Generator) -> HeightBody:
    """Crests sharper or blunter than a sinusoid's, over a rectangle."""
    length, power = rng.uniform(3, 6), rng.uniform(1.3, 2.4)
    height = rng.uniform(0.4, 0.95) * recipe.depth_mm  # deeper valleys would look like stripes
    half_u, half_v = rng.uniform(0.8, 3.0) * length, log_uniform(rng, 2.5, 11)
    phase = rng.uniform(-0.5, 0.5)

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        wave = height * np.abs(np.sin(math.pi * (u / length + phase))) ** power
        return np.where((np.abs(u) < half_u) & (np.abs(v) < half_v), wave, NO_BODY_MM)

    return HeightBody(
        variant="wave",
        behind_mm=behind,
        parts=lambda u, v: (
            np.where(
                (np.abs(u) < half_u) & (np.abs(v) < half_v), np.round(u / length + phase), -99
            ).astype(np.int64)
            + 20
        ),
        needed=2,
        is_compact=False,
        max_tilt=0.003,
    )


PATTERNS: dict[Shape, Callable[[PressRecipe, np.random.Generator], HeightBody]] = {
    Shape.LINE: _line,
    Shape.CROSS: _cross,
    Shape.STRIPES: _stripes,
    Shape.DOTS: _dots,
    Shape.WAVE: _wave,
}
