"""Fine relief of a touching surface: the five textures of the vocabulary.

Limits are those of the notes, beside each class of ``cltp.tactile.states.Texture``. A relief lies
in the pad's plane; on a curved body it is projected, not wrapped, which stretches it by less than a
tenth within a contact.
"""

from __future__ import annotations

import math

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Texture
from sim.objects.skins import caps, grain, valley


def relief_mm(
    texture: Texture,
    rng: np.random.Generator,
    x_mm: FloatArray,
    y_mm: FloatArray,
    sensor: SensorSpec,
) -> FloatArray:
    """Depth of a textured surface behind a smooth one.

    Args:
        texture: Class of the texture.
        rng: Random generator of its parameters.
        x_mm: Shape (H, W), over the whole sensing area [mm].
        y_mm: Same shape [mm].
        sensor: The sensor whose area it is.

    Returns:
        Shape (H, W) [mm]: 0 at the tops, except ``rough``, whose mean is 0.
    """
    if texture is Texture.SMOOTH:
        return np.zeros(np.shape(x_mm))
    if texture is Texture.ROUGH:
        spread, length_mm = rng.uniform(0.03, 0.08), rng.uniform(0.3, 0.6)
        return spread * grain(x_mm.shape, sensor, length_mm, rng)
    angle = rng.uniform(0, math.pi)
    u = x_mm * math.cos(angle) + y_mm * math.sin(angle) + rng.uniform(0, 3)
    v = y_mm * math.cos(angle) - x_mm * math.sin(angle) + rng.uniform(0, 3)
    height = rng.uniform(0.05, 0.2)
    if texture is Texture.BUMPY:
        pitch = rng.uniform(1, 3)
        return height * caps(u, v, pitch, pitch * rng.uniform(0.35, 0.48))  # not quite touching
    period = rng.uniform(0.6, 1.5)
    if texture is Texture.RIDGED:
        return height * valley(u, period)
    return height * np.minimum(valley(u, period), valley(v, period * rng.uniform(0.85, 1.2)))
