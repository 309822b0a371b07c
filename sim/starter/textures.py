"""Fine relief on a surface that touches: the five textures of the vocabulary.

Limits are those of the notes, beside each class of ``cltp.tactile.states.Texture``. A relief lies
in the pad's plane; on a curved body it is projected, not wrapped, which stretches it by less than a
tenth within a contact.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.sensor_noise import smooth_field
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Texture

FloatArray = NDArray[np.float64]


def relief_mm(
    texture: Texture,
    rng: np.random.Generator,
    x_mm: FloatArray,
    y_mm: FloatArray,
    sensor: SensorSpec,
) -> FloatArray:
    """How far a textured surface lies behind a smooth one.

    Args:
        texture: Which; its parameters are drawn.
        rng: Where the draws come from.
        x_mm: Shape (H, W), over the whole field [mm].
        y_mm: Same shape [mm].
        sensor: Whose field it is.

    Returns:
        Shape (H, W) [mm]: 0 at the tops, except ``rough``, whose mean is 0.
    """
    if texture is Texture.SMOOTH:
        return np.zeros(np.shape(x_mm))
    if texture is Texture.ROUGH:
        return _rough(rng, x_mm.shape, sensor)
    angle = rng.uniform(0, math.pi)
    u = x_mm * math.cos(angle) + y_mm * math.sin(angle) + rng.uniform(0, 3)
    v = y_mm * math.cos(angle) - x_mm * math.sin(angle) + rng.uniform(0, 3)
    height = rng.uniform(0.05, 0.2)
    if texture is Texture.BUMPY:
        return _bumpy(rng, u, v, height)
    period = rng.uniform(0.6, 1.5)
    if texture is Texture.RIDGED:
        return height * _valley(u, period)
    return height * np.minimum(_valley(u, period), _valley(v, period * rng.uniform(0.85, 1.2)))


def _rough(rng: np.random.Generator, shape: tuple[int, ...], sensor: SensorSpec) -> FloatArray:
    spread, length = rng.uniform(0.03, 0.08), rng.uniform(0.3, 0.6)
    field = smooth_field((shape[0], shape[1]), sensor, length, rng)
    # Clipped: the one highest of thousands of tops would hold all others off the gel.
    return spread * field.astype(np.float64).clip(-2, 2)


def _valley(along: FloatArray, period: float) -> FloatArray:
    """0 on the ridges, 1 between them."""
    return np.asarray(np.sin(math.pi * along / period) ** 2)


def _bumpy(rng: np.random.Generator, u: FloatArray, v: FloatArray, height: float) -> FloatArray:
    """Spherical caps on a hexagonal lattice, not quite touching."""
    pitch = rng.uniform(1, 3)
    radius = pitch * rng.uniform(0.35, 0.48)
    row = pitch * math.sqrt(3)
    squared = np.minimum(
        *(
            _off_lattice(u + shift * pitch, pitch) ** 2 + _off_lattice(v + shift * row, row) ** 2
            for shift in (0.0, 0.5)
        )
    )
    return np.asarray(height * (squared / radius**2).clip(max=1))


def _off_lattice(along: FloatArray, pitch: float) -> FloatArray:
    """Distance from the nearest multiple of ``pitch``."""
    return np.asarray(along - pitch * np.round(along / pitch))
