"""Pictures of contacts for people: the deformed gel as the sensor's camera sees it, in colour.

The light is that of such a sensor: red from the left, green from the top, blue from the lower
right, each low over the surface, and a weak white one from the camera. Indentations come towards
the viewer. Pictures are made on demand, never stored.

Not here: the image tower's input (``cltp.encoder.render``), on which trained weights depend.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, map_coordinates

from cltp.tactile.cloud import FloatArray, checked_heights
from cltp.tactile.sensors import SensorSpec

WIDTH_PX = 320
"""Width of a picture; its height follows from the sensing area."""

RELIEF = 2.5
"""Slopes are drawn this much steeper than they are, the same for every contact. Our choice: a
contact of 0.1 mm is visible, one of 1 mm is not yet black and white."""

_LIGHTS = (  # direction towards the lamp (x right, y up, z to the viewer), colour, strength
    ((-0.92, 0.10, 0.34), (1.00, 0.26, 0.20), 0.66),
    ((0.20, 0.90, 0.34), (0.24, 0.95, 0.38), 0.58),
    ((0.72, -0.60, 0.34), (0.22, 0.42, 1.00), 0.72),
    ((0.00, 0.00, 1.00), (1.00, 1.00, 1.00), 0.06),
)
_AMBIENT = 0.02
_GLOSS, _SHARPNESS = 0.22, 40.0
_HOLLOW_MM = 1.2  # radius over which a valley is darkened
_HOLLOW_GAIN = 2.5  # per mm below its surroundings


def picture(
    height_mm: NDArray[np.floating], sensor: SensorSpec, width_px: int = WIDTH_PX
) -> NDArray[np.uint8]:
    """A height map (H, W) [mm], clean or noisy, row 0 = top, as the sensor's camera sees it.

    The camera looks straight at the pad, so no part of the surface hides another and the normals
    give the shading. Heights are interpolated by cubic splines to the picture's pixels.

    Returns:
        Shape (rows, width_px, 3), sRGB.

    Raises:
        TouchError: Not a height map.
    """
    heights, pitch_mm = _resampled(height_mm, sensor, width_px)
    down, right = np.gradient(heights, pitch_mm)
    normal = np.stack([-RELIEF * right, RELIEF * down, np.ones_like(heights)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    flat = np.array([0.0, 0.0, 1.0])
    shaded = np.full((*heights.shape, 3), _AMBIENT)
    for direction, colour, strength in _LIGHTS:
        towards = np.array(direction) / np.linalg.norm(direction)
        halfway = (towards + flat) / np.linalg.norm(towards + flat)
        lit = (normal @ towards).clip(0)
        gloss = _GLOSS * (normal @ halfway).clip(0) ** _SHARPNESS
        shaded += strength * (lit + gloss)[..., None] * np.array(colour)
    hollow = heights - gaussian_filter(heights, _HOLLOW_MM / pitch_mm)
    shaded *= np.clip(1 + _HOLLOW_GAIN * hollow, 0.55, 1.25)[..., None]
    return np.asarray(np.rint(255 * shaded.clip(0, 1) ** (1 / 1.3)), dtype=np.uint8)


DEPTH_STOPS_MM = (-0.1, 0.0, 0.05, 0.1, 0.3, 0.6, 0.9, 1.3)
"""Heights at equal distances along the colour scale [mm]: finer where a berry presses, and with the
limits of the depth classes among them."""

_STOP_COLOURS = np.array(
    [  # below the untouched surface, at it, then with growing depth
        (38, 70, 122),
        (24, 28, 38),
        (108, 42, 116),
        (164, 52, 110),
        (206, 66, 78),
        (236, 108, 50),
        (250, 186, 66),
        (255, 248, 200),
    ],
    dtype=np.float64,
)
_NUM_LEVELS = 256


def _palette() -> NDArray[np.uint8]:
    along = np.linspace(0, len(_STOP_COLOURS) - 1, _NUM_LEVELS)
    stops = np.arange(len(_STOP_COLOURS))
    channels = [np.interp(along, stops, _STOP_COLOURS[:, i]) for i in range(3)]
    return np.rint(np.stack(channels, axis=-1)).astype(np.uint8)


DEPTH_PALETTE = _palette()
"""Shape (256, 3), sRGB: the colours of ``depth_levels``, the same in every picture of heights."""


def depth_levels(height_mm: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Position of heights [mm] along the colour scale, 0 to 255; beyond its ends they stay there.

    Every height map is drawn in these colours: a colour means the same depth everywhere.
    """
    top = _NUM_LEVELS - 1
    along = np.linspace(0, top, len(DEPTH_STOPS_MM))
    return np.rint(np.interp(height_mm, DEPTH_STOPS_MM, along)).astype(np.uint8)


def depth_scale(width_px: int, height_px: int) -> NDArray[np.uint8]:
    """The colour scale as a picture, shape (height_px, width_px, 3).

    ``DEPTH_STOPS_MM`` lie at equal distances from its left edge to its right.
    """
    row = DEPTH_PALETTE[np.linspace(0, _NUM_LEVELS - 1, width_px).round().astype(int)]
    return np.repeat(row[None], height_px, axis=0)


def depth_picture(
    height_mm: NDArray[np.floating], sensor: SensorSpec, width_px: int = WIDTH_PX
) -> NDArray[np.uint8]:
    """The height map in colours that mean the same depth in every picture, shape as ``picture``.

    Colours change at the limits of the depth classes; the bulge around a contact is blue.

    Raises:
        TouchError: Not a height map.
    """
    heights, _ = _resampled(height_mm, sensor, width_px)
    return np.asarray(DEPTH_PALETTE[depth_levels(heights)])


def _resampled(
    height_mm: NDArray[np.floating], sensor: SensorSpec, width_px: int
) -> tuple[FloatArray, float]:
    """Heights at a picture's pixels, and the distance between these [mm]."""
    heights = checked_heights(height_mm)
    pitch_mm = sensor.width_mm / width_px
    rows = round(sensor.height_mm / pitch_mm)
    v = (np.arange(rows) + 0.5) / rows * heights.shape[0] - 0.5
    u = (np.arange(width_px) + 0.5) / width_px * heights.shape[1] - 0.5
    pixels = np.stack(np.meshgrid(v, u, indexing="ij"))
    return np.asarray(map_coordinates(heights, pixels, order=3, mode="nearest")), pitch_mm
