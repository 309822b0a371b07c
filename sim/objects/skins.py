"""Skins: the fixed fine relief of an object, one of the five textures with its dimensions.

The limits of each texture are those of the notes, beside each class of
``cltp.tactile.states.Texture``. A relief lies in the pad's plane and turns with the object. It
fades where the surface is steep, since a finger feels no grain on a flank.

Not here: skins drawn for every series (``sim.full.skins``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensor_noise import smooth_field
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Texture

_LIMITS: dict[Texture, tuple[tuple[float, float], tuple[float, float]]] = {
    Texture.SMOOTH: ((0.0, 0.0), (0.0, 0.0)),
    Texture.ROUGH: ((0.03, 0.08), (0.3, 0.6)),
    Texture.RIDGED: ((0.05, 0.2), (0.6, 1.5)),
    Texture.BUMPY: ((0.05, 0.2), (1.0, 3.0)),
    Texture.WOVEN: ((0.05, 0.2), (0.6, 1.5)),
}

FADE_SLOPE = (0.5, 1.2)
"""Slopes of a surface between which its relief fades: about 27° and 50°. Our choice."""


@dataclass(frozen=True, slots=True)
class Skin:
    """Relief of a surface.

    Attributes:
        texture: Class of the texture.
        height_mm: Height of ridges, caps or threads; for ``rough`` the standard deviation [mm].
        pitch_mm: Distance from one to the next; for ``rough`` the correlation length [mm].

    Raises:
        ValueError: A number is outside the limits of the class.
    """

    texture: Texture
    height_mm: float = 0.0
    pitch_mm: float = 0.0

    def __post_init__(self) -> None:
        (low, high), (near, far) = _LIMITS[self.texture]
        if not (low <= self.height_mm <= high and near <= self.pitch_mm <= far):
            raise ValueError(
                f"a {self.texture} skin is {low}-{high} mm high and {near}-{far} mm apart, "
                f"got {self.height_mm} and {self.pitch_mm} mm"
            )


SMOOTH = Skin(Texture.SMOOTH)
rough = partial(Skin, Texture.ROUGH)
"""Isotropic grain: standard deviation and correlation length [mm]."""
ridged = partial(Skin, Texture.RIDGED)
"""Parallel ridges across the object's axis: height and distance [mm]."""
bumpy = partial(Skin, Texture.BUMPY)
"""Caps on a hexagonal lattice: height and distance [mm]."""
woven = partial(Skin, Texture.WOVEN)
"""Threads along and across the object's axis: height and distance [mm]."""


def relief_of(
    skin: Skin,
    rng: np.random.Generator,
    x_mm: FloatArray,
    y_mm: FloatArray,
    axis_rad: float,
    sensor: SensorSpec,
) -> FloatArray:
    """Depth of a skin behind a smooth surface.

    Args:
        skin: The skin.
        rng: Random generator of its phase and of the grain of ``rough``.
        x_mm: Shape (H, W), over the whole sensing area [mm].
        y_mm: Same shape [mm].
        axis_rad: Direction of the object's axis on the pad [rad]; ridges lie across it.
        sensor: The sensor whose area it is.

    Returns:
        Shape (H, W) [mm]: 0 at the tops, except ``rough``, whose mean is 0.
    """
    start = rng.uniform(0, 3, 2)
    if skin.texture is Texture.SMOOTH:
        return np.zeros(np.shape(x_mm))
    if skin.texture is Texture.ROUGH:
        return skin.height_mm * _grain(x_mm.shape, sensor, skin.pitch_mm, rng)
    cos, sin = math.cos(axis_rad), math.sin(axis_rad)
    u = x_mm * cos + y_mm * sin + start[0]
    v = y_mm * cos - x_mm * sin + start[1]
    if skin.texture is Texture.RIDGED:
        return skin.height_mm * _valley(u, skin.pitch_mm)
    if skin.texture is Texture.WOVEN:
        return skin.height_mm * np.minimum(_valley(u, skin.pitch_mm), _valley(v, skin.pitch_mm))
    return skin.height_mm * _caps(u, v, skin.pitch_mm, 0.44 * skin.pitch_mm)  # nearly touching


def fade(relief_mm: FloatArray, slope: FloatArray) -> FloatArray:
    """Fade a relief by the slope of the surface under it; both (H, W)."""
    first, last = FADE_SLOPE
    return relief_mm * ((last - slope) / (last - first)).clip(0, 1)


def _valley(along: FloatArray, pitch: float) -> FloatArray:
    """Profile of ridges: 0 on them, 1 between them."""
    return np.asarray(np.sin(math.pi * along / pitch) ** 2)


def _caps(u: FloatArray, v: FloatArray, pitch: float, radius: float) -> FloatArray:
    """Spherical caps on a hexagonal lattice: 0 at their tops, 1 from ``radius`` on."""
    row = pitch * math.sqrt(3)
    squared = np.minimum(
        *(
            _off_lattice(u + shift * pitch, pitch) ** 2 + _off_lattice(v + shift * row, row) ** 2
            for shift in (0.0, 0.5)
        )
    )
    return np.asarray((squared / radius**2).clip(max=1))


def _grain(
    shape: tuple[int, ...], sensor: SensorSpec, length_mm: float, rng: np.random.Generator
) -> FloatArray:
    """Rough relief of standard deviation 1, mean 0, with a correlation length.

    It is clipped: the highest of thousands of tops would keep all others off the gel.
    """
    field = smooth_field((shape[0], shape[1]), sensor, length_mm, rng)
    return field.astype(np.float64).clip(-2, 2)


def _off_lattice(along: FloatArray, pitch: float) -> FloatArray:
    """Distance from the nearest multiple of ``pitch``."""
    return np.asarray(along - pitch * np.round(along / pitch))
