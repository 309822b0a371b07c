"""Bumps and waves: a few or dozens of dots, round or longish, in rows or thrown; crests."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.full.drawn.outlines import nearest
from sim.full.drawn.surface import BASE_MM, Draws, Surface
from sim.gel.gap import NO_BODY_MM

Draw = Callable[[Draws], Surface]

_NEIGHBOURS = 4  # of a position that may carry its surface


def _rows(draws: Draws, pitch: float, reach: FloatArray) -> FloatArray:
    """A lattice, its rows shifted or not, its points a little astray."""
    shift, spread = draws.one_of((0.0, 0.0, 0.5, draws.uniform(0, 0.5))), draws.uniform(0, 0.12)
    rise = pitch * draws.uniform(0.87, 1.15)
    i, j = np.mgrid[-20:21, -20:21].reshape(2, -1)
    points = np.stack([(i + shift * (j % 2)) * pitch, j * rise], axis=1).astype(np.float64)
    points += draws.rng.uniform(0, pitch, 2) + spread * pitch * draws.rng.uniform(
        -1, 1, points.shape
    )
    return np.asarray(points[np.hypot(*(points / reach).T) < 1])


def _thrown(draws: Draws, pitch: float, reach: FloatArray) -> FloatArray:
    """Points thrown one by one, none nearer than 0.8 pitches to another."""
    points: list[FloatArray] = []
    wanted = math.pi * float(reach.prod()) / pitch**2
    for point in draws.rng.uniform(-1, 1, (int(12 * wanted) + 60, 2)):
        if np.hypot(*point) >= 1:
            continue
        at = point * reach
        if all((at[0] - p[0]) ** 2 + (at[1] - p[1]) ** 2 > (0.8 * pitch) ** 2 for p in points):
            points.append(at)
    return np.array(points)


def _sunflower(draws: Draws, pitch: float, reach: FloatArray) -> FloatArray:
    """Points on a golden-angle spiral, as the seeds of a fruit."""
    radius = float(reach.min())
    index = np.arange(max(4, int(0.85 * math.pi * (radius / pitch) ** 2)))
    angle = index * math.pi * (3 - math.sqrt(5)) + draws.uniform(0, 6.28)
    r = radius * np.sqrt((index + 0.5) / len(index))
    return np.stack([r * np.cos(angle), r * np.sin(angle)], axis=1)


def _dots(centres_of: Callable[[Draws, float, FloatArray], FloatArray], kind: str) -> Draw:
    """Dots of a kind: few, dense (dozens, under 2 mm apart), longish, or uneven in size."""

    def draw(draws: Draws) -> Surface:
        dense = kind == "dense" and not draws.small
        pitch = draws.uniform(1.1, 2.0) if dense or draws.small else draws.log(1.5, 4.6)
        reach = np.array([draws.uniform(3, 9), draws.uniform(3, 9)]) * draws.scale
        if draws.small or kind == "few":
            reach = pitch * np.array([draws.uniform(0.95, 1.7), draws.uniform(0.95, 1.7)])
        reach = np.maximum(reach, 1.15 * pitch)
        centres = centres_of(draws, pitch, reach)
        for _ in range(20):
            if len(centres) >= 3:
                break
            reach = 1.15 * reach
            centres = centres_of(draws, pitch, reach)
        return _bumps(centres, pitch, reach, draws, longish=kind == "longish")

    return draw


def _bumps(
    centres: FloatArray, pitch: float, reach: FloatArray, draws: Draws, *, longish: bool
) -> Surface:
    """Bumps at centres (N, 2): caps, cones, cosines or flat studs on a base, plane or bowed."""
    count = len(centres)
    if longish or draws.chance(0.25):
        aspect = draws.rng.uniform(1.25, 2.2, count)
    else:
        aspect = np.ones(count)
    # Longish bumps lie at random, or nearly along one direction.
    angle = draws.rng.uniform(0, math.pi, count) * draws.one_of((1.0, 0.12)) + draws.uniform(0, 3)
    radius = pitch * draws.uniform(0.24, 0.37) * (1 + draws.rng.uniform(-0.15, 0.15, count))
    sunk = draws.lightest_mm * draws.uniform(0, 0.45) * draws.rng.random(count)
    tall, power = draws.uniform(0.6, 1.6) * pitch * 0.35, draws.one_of((0.5, 0.5, 0.7, 1.0))
    flat = draws.uniform(0.2, 0.6) if draws.chance(0.2) else 0.0
    bow = 0.5 / draws.uniform(25, 90) if draws.chance(0.35) else 0.0
    base = min(sunk.max() + tall, BASE_MM)
    has_base = base > 0.8 * BASE_MM or draws.chance(0.4)
    cos, sin, grow = np.cos(angle), np.sin(angle), np.sqrt(aspect)

    def squared(u: FloatArray, v: FloatArray) -> tuple[FloatArray, NDArray[np.int64]]:
        """Squared distance from the nearest bumps, 1 at their outlines, and their numbers."""
        index = nearest(u, v, centres, _NEIGHBOURS)
        off_u, off_v = u[..., None] - centres[index, 0], v[..., None] - centres[index, 1]
        along = (off_u * cos[index] + off_v * sin[index]) / grow[index]
        across = (off_v * cos[index] - off_u * sin[index]) * grow[index]
        return (along**2 + across**2) / radius[index] ** 2, index

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        q, index = squared(u, v)
        over = ((np.sqrt(q) - flat) / (1 - flat)).clip(0, 1) ** 2
        bump = np.where(q < 1, sunk[index] + tall * (1 - (1 - over) ** power), NO_BODY_MM)
        surface = bump.min(axis=-1)
        surface = np.minimum(surface, BASE_MM) if has_base else surface
        return np.asarray(surface + bow * (u**2 + v**2))

    def elements(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
        q, index = squared(u, v)
        best = q.argmin(axis=-1)[..., None]
        number = np.take_along_axis(index, best, -1)[..., 0]
        return np.where(np.take_along_axis(q, best, -1)[..., 0] < 1, number, -1)

    return Surface(
        shape=Shape.DOTS,
        behind_mm=behind,
        elements=elements,
        needed=3,
        extent_mm=float(np.hypot(*centres.T).max() + radius.max()),
        is_compact=float(reach.max()) < 4.5 * draws.scale,
    )


def _wave(kind: str) -> Draw:
    """Crests 3-6 mm apart: sinusoids, sharper or blunter ones, curved or a little uneven."""

    def draw(draws: Draws) -> Surface:
        length, phase = draws.uniform(3, 6), draws.uniform(0, 1)
        # Valleys as deep as a press would look like stripes.
        height = min(draws.uniform(0.2, 0.95), draws.uniform(0.5, 1.1) * 2.5 * draws.lightest_mm)
        power = {"sharp": draws.uniform(1.1, 1.6), "blunt": draws.uniform(2.4, 3.5)}.get(kind, 2.0)
        radius = draws.uniform(12, 50) if kind == "curved" else 0.0
        swell = draws.uniform(0.05, 0.15) if kind == "uneven" else 0.0
        half_u = draws.uniform(0.8, 1.2) * length if draws.small else draws.uniform(4, 14)
        half_v = draws.uniform(1.2, 2.5) if draws.small else draws.log(3, 12)

        def at(u: FloatArray, v: FloatArray) -> FloatArray:
            along = np.hypot(u + radius, v) - radius if radius else u
            return np.asarray(along / length + swell * np.sin(along) + phase)

        def within(u: FloatArray, v: FloatArray) -> NDArray[np.bool_]:
            return np.asarray((np.abs(u) < half_u) & (np.abs(v) < half_v))

        def behind(u: FloatArray, v: FloatArray) -> FloatArray:
            wave = height * np.abs(np.sin(math.pi * at(u, v))) ** power
            return np.where(within(u, v), wave, NO_BODY_MM)

        return Surface(
            shape=Shape.WAVE,
            behind_mm=behind,
            elements=lambda u, v: np.where(
                within(u, v), np.round(at(u, v)).astype(np.int64) + 40, -1
            ),
            needed=2,
            extent_mm=length,
            is_compact=False,
        )

    return draw


DOTS: Mapping[Shape, Mapping[str, Draw]] = {
    Shape.DOTS: {
        "dots_few": _dots(_thrown, "few"),
        "dots_rows": _dots(_rows, "plain"),
        "dots_rows_dense": _dots(_rows, "dense"),
        "dots_thrown": _dots(_thrown, "plain"),
        "dots_thrown_dense": _dots(_thrown, "dense"),
        "dots_longish": _dots(_thrown, "longish"),
        "dots_spiral": _dots(_sunflower, "dense"),
    },
    Shape.WAVE: {
        f"wave_{kind}": _wave(kind) for kind in ("sine", "sharp", "blunt", "curved", "uneven")
    },
}
"""Of each shape: its objects by name."""
