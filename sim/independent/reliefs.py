"""Relief of the five textures, by other functions than those of ``sim.objects.skins``.

Limits are those of ``cltp.tactile.states.Texture``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Texture


@dataclass(frozen=True, slots=True, kw_only=True)
class Relief:
    """A relief over the pad.

    Attributes:
        behind_mm: Shape (H, W), depth behind the smooth surface [mm].
        pitch_mm: Distance from one element to the next; 0 for a smooth surface [mm].
    """

    behind_mm: FloatArray
    pitch_mm: float


def draw_relief(
    texture: Texture,
    depth_mm: float,
    rng: np.random.Generator,
    x_mm: FloatArray,
    y_mm: FloatArray,
) -> Relief:
    """Draw a relief of at most half the depth of the press, so that not its tops alone touch.

    Args:
        texture: Class of the texture.
        depth_mm: Depth of the press, at least ``LEAST_DEPTH_MM`` but for a smooth surface [mm].
        rng: Random generator.
        x_mm: Shape (H, W), points of a regular grid [mm].
        y_mm: Same shape [mm].
    """
    if texture is Texture.SMOOTH:
        return Relief(behind_mm=np.zeros_like(x_mm), pitch_mm=0.0)
    if texture is Texture.ROUGH:
        length_mm, pitch_mm = rng.uniform(0.35, 0.6), float(x_mm[0, 1] - x_mm[0, 0])
        sigma = 0.5 * length_mm / pitch_mm
        field = gaussian_filter(rng.standard_normal(x_mm.shape), sigma, mode="wrap")
        skewed = np.exp(0.5 * field / field.std())  # deep pits, low tops
        skewed = (skewed - skewed.mean()) / skewed.std()
        spread = rng.uniform(0.03, min(0.08, max(0.031, 0.25 * depth_mm)))
        return Relief(behind_mm=spread * skewed.clip(-2.5, 2.5), pitch_mm=length_mm)
    height = rng.uniform(0.05, min(0.2, max(0.051, 0.5 * depth_mm)))
    angle, shift = rng.uniform(0, math.pi), rng.uniform(0, 3, 2)
    u = x_mm * math.cos(angle) + y_mm * math.sin(angle) + shift[0]
    v = y_mm * math.cos(angle) - x_mm * math.sin(angle) + shift[1]
    if texture is Texture.BUMPY:
        pitch = rng.uniform(1.1, 3.0)
        return Relief(behind_mm=height * _humps(u, v, pitch), pitch_mm=pitch)
    pitch = rng.uniform(0.7, 1.5)
    if texture is Texture.RIDGED:
        # Saw teeth with rounded crests along lines that meander a little.
        phase = (u + 0.12 * pitch * np.sin(v * rng.uniform(0.4, 1.0))) / pitch % 1.0
        lean = rng.uniform(0.3, 0.7)
        tooth = np.where(phase < lean, phase / lean, (1 - phase) / (1 - lean))
        return Relief(behind_mm=height * (1 - tooth) ** 1.4, pitch_mm=pitch)
    return Relief(behind_mm=height * _weave(u, v, pitch), pitch_mm=pitch)


LEAST_DEPTH_MM = 0.13
"""Depth of a press from which a relief can be half as high and still have the class's height."""


def _humps(u: FloatArray, v: FloatArray, pitch: float) -> FloatArray:
    """Raised cosines on a square lattice whose rows are shifted by a third: 0 at their tops."""
    row = np.round(v / pitch)
    off_u = u + row * pitch / 3
    off_u = off_u - pitch * np.round(off_u / pitch)
    r = np.hypot(off_u, v - row * pitch) / (0.46 * pitch)
    return np.asarray(np.where(r < 1, 0.5 - 0.5 * np.cos(np.pi * r), 1.0))


def _weave(u: FloatArray, v: FloatArray, pitch: float) -> FloatArray:
    """Plain weave: round threads along u and v that go over and under each other."""
    along_u = np.cos(np.pi * u / pitch) * (-1.0) ** np.round(v / pitch)
    along_v = -np.cos(np.pi * v / pitch) * (-1.0) ** np.round(u / pitch)
    round_u = 1 - (2 * (v / pitch - np.round(v / pitch))) ** 2
    round_v = 1 - (2 * (u / pitch - np.round(u / pitch))) ** 2
    top = np.maximum(0.6 * round_u + 0.4 * along_u, 0.6 * round_v + 0.4 * along_v)
    return np.asarray(((1 - top) / 1.2).clip(0, 1))
