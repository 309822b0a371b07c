"""Skins: the fine relief of an object, drawn anew for every series.

The limits of each texture are those of ``cltp.tactile.states.Texture``; within them the profile,
the directions, the regularity and the sizes vary. A relief lies in the pad's plane and fades where
the surface is steep.

Not here: the fixed skins of the paper's set (``sim.objects.skins``).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensor_noise import smooth_field
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Texture
from sim.full.drawn.outlines import nearest
from sim.full.drawn.surface import Draws

Grid = tuple[FloatArray, FloatArray]
"""Positions x and y of the grid, each (H, W) [mm]."""

TEXTURED = 0.85
"""Fraction of the surfaces that can carry a texture which have one. Our choice."""

LEAST_RELIEF_MM = {
    Texture.ROUGH: 0.03,
    Texture.RIDGED: 0.05,
    Texture.BUMPY: 0.05,
    Texture.WOVEN: 0.05,
}
"""Lowest relief of each texture: standard deviation of ``rough``, height of the others."""

RELIEF_OF_DEPTH = 0.7
"""Largest relief over the depth of the lightest press: deeper valleys leave lone tops in
contact, which are dots or stripes. For ``rough`` half of it, since it is a standard deviation. Our
choice."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnSkin:
    """A relief over the pad.

    Attributes:
        texture: Class of the texture.
        behind_mm: Shape (H, W), depth behind the smooth surface [mm].
        pitch_mm: Distance from one element to the next; 0 of a smooth skin [mm].
    """

    texture: Texture
    behind_mm: FloatArray
    pitch_mm: float


def draw_skin(draws: Draws, grid: Grid, sensor: SensorSpec, *, textured: bool) -> DrawnSkin:
    """Draw a skin that the lightest press shows; smooth if it is too light, or not ``textured``."""
    x_mm = grid[0]
    deepest = RELIEF_OF_DEPTH * draws.lightest_mm
    possible = [
        texture
        for texture, least in LEAST_RELIEF_MM.items()
        if least <= (0.5 * deepest if texture is Texture.ROUGH else deepest)
    ]
    wanted, choice = draws.chance(TEXTURED), draws.uniform(0, 1)
    if not (textured and wanted and possible):
        return DrawnSkin(texture=Texture.SMOOTH, behind_mm=np.zeros_like(x_mm), pitch_mm=0.0)
    texture = possible[int(choice * len(possible))]
    if texture is Texture.ROUGH:
        return _rough(draws, x_mm.shape, sensor, 0.5 * deepest)
    height = draws.uniform(0.05, min(0.2, deepest))
    pitch = draws.uniform(1.0, 3.0) if texture is Texture.BUMPY else draws.uniform(0.6, 1.5)
    relief = _RELIEFS[texture](draws, _turned(draws, grid), pitch)
    return DrawnSkin(texture=texture, behind_mm=height * relief, pitch_mm=pitch)


def _turned(draws: Draws, grid: Grid) -> Grid:
    """The grid in a direction of its own, its origin anywhere."""
    angle = draws.uniform(0, math.pi)
    cos, sin = math.cos(angle), math.sin(angle)
    u = grid[0] * cos + grid[1] * sin + draws.uniform(0, 5)
    return u, grid[1] * cos - grid[0] * sin + draws.uniform(0, 5)


def _rough(draws: Draws, shape: tuple[int, ...], sensor: SensorSpec, highest: float) -> DrawnSkin:
    """Grain of one or two lengths: even, pitted or peaked."""
    size, length = (shape[0], shape[1]), draws.uniform(0.3, 0.6)
    field = smooth_field(size, sensor, length, draws.rng).astype(np.float64)
    if draws.chance(0.3):
        coarse = smooth_field(size, sensor, min(0.6, 1.6 * length), draws.rng)
        field = field + draws.uniform(0.3, 0.8) * coarse
    skew = draws.uniform(-0.5, 0.5)
    if abs(skew) > 0.1:
        field = np.sign(skew) * np.exp(abs(skew) * field / field.std())
    field = (field - field.mean()) / field.std()
    spread = draws.uniform(0.03, max(0.0301, min(0.08, highest)))
    # Clipped: the highest of thousands of tops would keep all others off the gel.
    return DrawnSkin(
        texture=Texture.ROUGH, behind_mm=spread * field.clip(-2.2, 2.2), pitch_mm=length
    )


def _profile(draws: Draws) -> Callable[[FloatArray], FloatArray]:
    """Depth of one period of ridges over its phase in 0-1: 0 on the ridge, 1 in the valley."""
    kind = draws.one_of(("sine", "sharp", "blunt", "saw", "step"))
    if kind == "saw":
        lean = draws.uniform(0.25, 0.75)
        return lambda phase: np.where(phase < lean, phase / lean, (1 - phase) / (1 - lean))
    if kind == "step":
        land, flank = draws.uniform(0.3, 0.55), draws.uniform(0.1, 0.2)
        return lambda phase: (((np.abs(phase - 0.5) * -2 + 1) - land) / flank).clip(0, 1)
    power = {"sine": 1.0, "sharp": draws.uniform(0.5, 0.8), "blunt": draws.uniform(1.3, 2.5)}[kind]
    return lambda phase: np.abs(np.sin(math.pi * phase)) ** (2 * power)


def _phase(draws: Draws, u: FloatArray, v: FloatArray, pitch: float) -> FloatArray:
    """Phase of lines across u that may meander and swell a little."""
    meander, slow = draws.uniform(0, 0.2) * pitch, draws.uniform(0.2, 1.0)
    swell, wide = draws.uniform(0, 0.1), draws.uniform(0.2, 0.6)
    return np.asarray(((u + meander * np.sin(slow * v)) / pitch + swell * np.sin(wide * u)) % 1.0)


def _ridged(draws: Draws, grid: Grid, pitch: float) -> FloatArray:
    """Ridges: straight, meandering, or about a far centre as those of a turned face."""
    profile, (u, v) = _profile(draws), grid
    if draws.chance(0.2):
        far = draws.uniform(8, 40)
        u = np.hypot(u + far, v)
    return profile(_phase(draws, u, v, pitch))


def _woven(draws: Draws, grid: Grid, pitch: float) -> FloatArray:
    """Two directions, at 65-90°: ridges that cross, knurls, or threads over and under."""
    u, v = grid
    angle, ratio = math.radians(draws.uniform(65, 90)), draws.uniform(0.75, 1.3)
    across = v * math.sin(angle) + u * math.cos(angle)
    second = float(np.clip(pitch * ratio, 0.6, 1.5))
    kind = draws.one_of(("crossed", "knurled", "threads"))
    if kind == "threads":
        wide, deep = u / pitch, across / second
        over = np.cos(math.pi * wide) * (-1.0) ** np.round(deep)
        under = -np.cos(math.pi * deep) * (-1.0) ** np.round(wide)
        round_u = 1 - (2 * (deep - np.round(deep))) ** 2
        round_v = 1 - (2 * (wide - np.round(wide))) ** 2
        blend = draws.uniform(0.3, 0.5)
        top = np.maximum(
            (1 - blend) * round_u + blend * over, (1 - blend) * round_v + blend * under
        )
        return np.asarray((1 - top).clip(0, 1))
    profile = _profile(draws)
    first, last = profile(_phase(draws, u, v, pitch)), profile(_phase(draws, across, u, second))
    joined = np.minimum(first, last) if kind == "crossed" else np.maximum(first, last)
    return np.asarray(joined)


def _bumpy(draws: Draws, grid: Grid, pitch: float) -> FloatArray:
    """Caps, cones or studs: in even or shifted rows, or astray; some skins have dimples instead."""
    u, v = grid
    shift, rise = draws.one_of((0.0, 0.5, 0.5, 0.33)), draws.uniform(0.85, 1.0)
    astray = draws.one_of((0.0, draws.uniform(0, 0.2)))
    i, j = np.mgrid[-36:37, -36:37].reshape(2, -1)
    centres = np.stack([(i + shift * (j % 2)) * pitch, j * rise * pitch], axis=1)
    centres = centres + astray * pitch * draws.rng.uniform(-1, 1, centres.shape)
    reach = float(max(np.abs(u).max(), np.abs(v).max())) + 2 * pitch
    centres = centres[(np.abs(centres) < reach).all(axis=1)]
    own = nearest(u, v, centres, 1)[..., 0]
    radius = pitch * draws.uniform(0.34, 0.49)
    q = ((u - centres[own, 0]) ** 2 + (v - centres[own, 1]) ** 2) / radius**2
    kind = draws.one_of(("cap", "cosine", "cone", "stud"))
    r = np.sqrt(q).clip(max=1)
    if kind == "cosine":
        bump = 0.5 - 0.5 * np.cos(math.pi * r)
    elif kind == "cone":
        bump = r
    elif kind == "stud":
        bump = ((r - 0.5) / 0.5).clip(0, 1)
    else:
        bump = r**2
    sizes = 1 - draws.uniform(0, 0.35) * draws.rng.random(len(centres))
    return np.asarray(1 - (1 - bump) * sizes[own])


_RELIEFS: dict[Texture, Callable[[Draws, Grid, float], FloatArray]] = {
    Texture.RIDGED: _ridged,
    Texture.WOVEN: _woven,
    Texture.BUMPY: _bumpy,
}
