"""Patterns of bars: lines, crosses and stripes, straight, curved, fanned and broken."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.full.drawn.outlines import bent, curve
from sim.full.drawn.surface import BASE_MM, Draws, Rim, Surface, round_bar
from sim.gel.gap import NO_BODY_MM

Draw = Callable[[Draws], Surface]
Profile = Callable[[FloatArray], FloatArray]


def _bar(draws: Draws, widest: float = 1.5) -> tuple[Profile, float]:
    """Surface of a bar over the distance from its middle line, and its half width [mm]."""
    half = draws.uniform(0.2, 0.5 * (min(widest, 0.9) if draws.small else widest))
    kind = draws.one_of(("round", "flat", "blade"))
    if kind == "round":
        return (lambda distance: round_bar(distance, half)), half
    if kind == "flat":
        rim = Rim.draw(draws, half)
        return (lambda distance: rim.behind(distance - half)), half
    steep, blunt = draws.uniform(0.8, 2.5), draws.uniform(0.1, 0.25)
    return (
        lambda distance: np.where(
            distance < half + 0.3, np.hypot(steep * distance, blunt) - blunt, NO_BODY_MM
        )
    ), half


def _pattern(
    shape: Shape,
    profile: Profile,
    bars: Sequence[Sequence[FloatArray]],
    half_width: float,
    draws: Draws,
    *,
    needed: int,
    is_compact: bool,
) -> Surface:
    """Bars, each of one or more pieces (lines through points), perhaps on a base."""
    has_base, bow = draws.chance(0.4), 0.0
    if draws.chance(0.25) and not draws.small:
        bow = 0.5 / draws.uniform(40, 120)

    def distances(u: FloatArray, v: FloatArray) -> FloatArray:
        return np.stack([np.minimum.reduce([curve(u, v, piece) for piece in bar]) for bar in bars])

    def behind(u: FloatArray, v: FloatArray) -> FloatArray:
        surface = profile(distances(u, v).min(axis=0))
        surface = np.minimum(surface, BASE_MM) if has_base else surface
        return surface + bow * v**2

    def elements(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
        each = distances(u, v)
        return np.where(each.min(axis=0) < half_width, each.argmin(axis=0), -1)

    points = np.concatenate([piece for bar in bars for piece in bar])
    return Surface(
        shape=shape,
        behind_mm=behind,
        elements=elements,
        needed=needed,
        extent_mm=float(np.hypot(*points.T).max()),
        is_compact=is_compact,
    )


def _line(kind: str) -> Draw:
    """One bar: straight, curved by up to 55°, wavy, or broken along its length."""

    def draw(draws: Draws) -> Surface:
        profile, half_width = _bar(draws)
        half = draws.size(2.6, 12, (1.3, 2.2))
        half = max(half, 3.2 * half_width)
        turn = draws.uniform(0.25, 0.95) if kind == "curved" else 0.0
        points = bent(half, turn)
        pieces = [points]
        if kind == "wavy":
            along = np.linspace(-half, half, 25)
            swing = draws.uniform(0.04, 0.09) * half
            points = np.stack(
                [along, swing * np.sin(draws.uniform(1.5, 3.2) * along / half * 2)], 1
            )
            pieces = [points]
        if kind == "broken":
            gap = half_width + draws.uniform(0.25, 0.6)
            at = draws.uniform(-0.4, 0.4) * half
            pieces = [
                np.array([[-half, 0.0], [at - gap, 0.0]]),
                np.array([[at + gap, 0.0], [half, 0.0]]),
            ]
        is_compact = half < 4.5 * draws.scale
        return _pattern(
            Shape.LINE, profile, [pieces], half_width, draws, needed=1, is_compact=is_compact
        )

    return draw


def _cross(kind: str) -> Draw:
    """Two bars that cross: at right angles, askew, off their middles, or of different lengths."""

    def draw(draws: Draws) -> Surface:
        profile, half_width = _bar(draws, 1.3)
        angle = math.radians(draws.uniform(80, 90) if kind == "upright" else draws.uniform(48, 90))
        reach = draws.size(2.4, 7.5, (1.4, 2.1))
        arms = np.full(4, reach)
        if kind == "offset":
            arms = reach * draws.rng.uniform(0.55, 1.0, 4)
        if kind == "unequal":
            arms[2:] *= draws.uniform(0.5, 0.8)
        arms = np.maximum(arms, half_width + 0.8)
        cos, sin = math.cos(angle), math.sin(angle)
        bars = [
            np.array([(-arms[0], 0.0), (arms[1], 0.0)]),
            np.array([(-arms[2] * cos, -arms[2] * sin), (arms[3] * cos, arms[3] * sin)]),
        ]
        arms_of = _pattern(
            Shape.CROSS,
            profile,
            [[bar] for bar in bars],
            half_width,
            draws,
            needed=4,
            is_compact=reach < 5 * draws.scale,
        )

        def elements(u: FloatArray, v: FloatArray) -> NDArray[np.int64]:
            """The four arms, without the crossing."""
            first, second = curve(u, v, bars[0]) < half_width, curve(u, v, bars[1]) < half_width
            number = np.where(first, np.where(u < 0, 0, 1), np.where(u * cos + v * sin < 0, 2, 3))
            return np.where(first ^ second, number, -1)

        return Surface(
            shape=Shape.CROSS,
            behind_mm=arms_of.behind_mm,
            elements=elements,
            needed=4,
            extent_mm=arms_of.extent_mm,
            is_compact=arms_of.is_compact,
        )

    return draw


def _broken(half: float, offset: float, half_width: float, draws: Draws) -> list[FloatArray]:
    """A straight bar in pieces of its own lengths."""
    pieces, at = [], -half
    while at < half:
        end = min(half, at + draws.uniform(1.2, 4.0) + 2 * half_width)
        if end - at > 0.6:
            pieces.append(np.array([[at, offset], [end, offset]]))
        at = end + 2 * half_width + draws.uniform(0.6, 1.8)
    return pieces


def _stripes(kind: str) -> Draw:
    """Two or more bars side by side: even, uneven, curved, fanned, broken, or many and fine."""

    def draw(draws: Draws) -> Surface:
        fine = kind == "fine"
        profile, half_width = _bar(draws, 0.8 if fine else 1.5)
        count = 2 if draws.small else draws.count(5, 10) if fine else draws.count(2, 7)
        half = draws.size(2.8, 11, (1.4, 2.2))
        free = draws.uniform(0.7, 1.2) if fine or draws.small else draws.uniform(0.9, 2.6)
        steps = np.full(count, 2 * half_width + free)
        if kind == "uneven":
            steps = 2 * half_width + draws.rng.uniform(0.9, 2.6, count)
        offsets = np.cumsum(steps) - np.cumsum(steps).mean()
        turn = draws.uniform(0.25, 0.8) if kind == "curved" else 0.0
        if turn:  # the innermost line must not turn about a point within the pattern
            turn = min(turn, half / (float(offsets.max()) + 1.0))
        fan = math.radians(draws.uniform(3, 12)) / max(count - 1, 1) if kind == "fanned" else 0.0
        bars = []
        for number, offset in enumerate(offsets):
            pieces = [bent(half, turn, float(offset))]
            if kind == "broken":
                pieces = _broken(half, float(offset), half_width, draws) or pieces
            angle = fan * (number - (count - 1) / 2)
            spin = np.array(
                [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
            )
            middle = np.array([0.0, offset])
            bars.append([(piece - middle) @ spin.T + middle for piece in pieces])
        return _pattern(
            Shape.STRIPES,
            profile,
            bars,
            half_width,
            draws,
            needed=2,
            is_compact=max(half, float(offsets.max())) < 5 * draws.scale,
        )

    return draw


PATTERNS: Mapping[Shape, Mapping[str, Draw]] = {
    Shape.LINE: {f"line_{kind}": _line(kind) for kind in ("straight", "curved", "wavy", "broken")},
    Shape.CROSS: {
        f"cross_{kind}": _cross(kind) for kind in ("upright", "askew", "offset", "unequal")
    },
    Shape.STRIPES: {
        f"stripes_{kind}": _stripes(kind)
        for kind in ("even", "uneven", "curved", "fanned", "broken", "fine")
    },
}
"""Of each shape: its objects by name."""
