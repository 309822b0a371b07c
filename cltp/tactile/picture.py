"""Pictures of contacts for people: the deformed gel as a mesh, seen from the sensor, in colour.

Light as in such a sensor: red from the left, green from the top, blue from the lower right, each
low over the surface, and a weak white one from the camera. What is pressed in comes towards the
viewer. Made on demand, never stored.

Not here: the image tower's input (``cltp.tactile.render``), on which trained weights depend.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, map_coordinates

from cltp.errors import TouchError
from cltp.tactile.sensors import SensorSpec

FloatArray = NDArray[np.float64]

WIDTH_PX = 320
"""Width of a picture; its height follows from the sensor's field."""

RELIEF = 2.5
"""Slopes are drawn this much steeper than they are, the same for every contact. Our choice: a
contact of 0.1 mm is seen, one of 1 mm is not yet black and white."""

_LIGHTS = (  # direction from which it comes (x right, y up, z to the viewer), colour, strength
    ((-0.92, 0.10, 0.34), (1.00, 0.26, 0.20), 0.66),
    ((0.20, 0.90, 0.34), (0.24, 0.95, 0.38), 0.58),
    ((0.72, -0.60, 0.34), (0.22, 0.42, 1.00), 0.72),
    ((0.00, 0.00, 1.00), (1.00, 1.00, 1.00), 0.06),
)
_AMBIENT = 0.02
_GLOSS, _SHARPNESS = 0.22, 40.0
_HOLLOW_MM = 1.2  # radius over which a valley is darkened
_HOLLOW_GAIN = 2.5  # per mm below its surroundings


def surface_mesh(
    height_mm: NDArray[np.floating], sensor: SensorSpec
) -> tuple[FloatArray, NDArray[np.int64]]:
    """The deformed surface as triangles.

    Args:
        height_mm: Shape (H, W), indentation over the whole field [mm], row 0 = top.
        sensor: Whose field it is.

    Returns:
        Vertices, shape (H·W, 3) [mm, gel frame], and faces, shape (2 (H-1)(W-1), 3), counter-
        clockwise seen from the sensor (from +z).

    Raises:
        TouchError: It is no height map.
    """
    heights = _checked(height_mm)
    rows, columns = heights.shape
    x = ((np.arange(columns) + 0.5) / columns - 0.5) * sensor.width_mm
    y = (0.5 - (np.arange(rows) + 0.5) / rows) * sensor.height_mm
    at_x, at_y = np.meshgrid(x, y)
    vertices = np.stack([at_x.ravel(), at_y.ravel(), heights.ravel()], axis=1)
    number = np.arange(rows * columns).reshape(rows, columns)
    top_left, top_right = number[:-1, :-1].ravel(), number[:-1, 1:].ravel()
    low_left, low_right = number[1:, :-1].ravel(), number[1:, 1:].ravel()
    faces = np.concatenate(
        [
            np.stack([top_left, low_left, top_right], axis=1),
            np.stack([top_right, low_left, low_right], axis=1),
        ]
    )
    return vertices, faces.astype(np.int64)


def picture(
    height_mm: NDArray[np.floating], sensor: SensorSpec, width_px: int = WIDTH_PX
) -> NDArray[np.uint8]:
    """The surface as the sensor's camera sees it, shaded.

    The camera looks straight at the pad, so the mesh's picture is that of its normals: no triangle
    hides another. Heights are interpolated by cubic splines to the picture's pixels.

    Args:
        height_mm: Shape (H, W), clean or noisy [mm], row 0 = top.
        sensor: Whose field it is.
        width_px: Width of the picture.

    Returns:
        Shape (rows, width_px, 3), sRGB.

    Raises:
        TouchError: It is no height map.
    """
    heights, pitch_mm = _fine(height_mm, sensor, width_px)
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


_DEPTH_COLOURS = np.array(
    [  # below the untouched surface, at it, then deeper and deeper
        (38, 70, 122),
        (24, 28, 38),
        (92, 38, 96),
        (178, 54, 84),
        (236, 108, 50),
        (250, 186, 66),
        (255, 248, 200),
    ],
    dtype=np.float64,
)
_DEPTH_STOPS_MM = (-0.1, 0.0, 0.15, 0.3, 0.6, 0.9, 1.3)


def depth_picture(
    height_mm: NDArray[np.floating], sensor: SensorSpec, width_px: int = WIDTH_PX
) -> NDArray[np.uint8]:
    """The height map in colours that mean the same depth in every picture, shape as ``picture``.

    Colours change at the limits of the depth classes; what rises around a contact is blue.

    Raises:
        TouchError: It is no height map.
    """
    heights, _ = _fine(height_mm, sensor, width_px)
    channels = [np.interp(heights, _DEPTH_STOPS_MM, _DEPTH_COLOURS[:, i]) for i in range(3)]
    return np.rint(np.stack(channels, axis=-1)).astype(np.uint8)


def _fine(
    height_mm: NDArray[np.floating], sensor: SensorSpec, width_px: int
) -> tuple[FloatArray, float]:
    """Heights at a picture's pixels, and how far apart these are [mm]."""
    heights = _checked(height_mm)
    pitch_mm = sensor.width_mm / width_px
    rows = round(sensor.height_mm / pitch_mm)
    v = (np.arange(rows) + 0.5) / rows * heights.shape[0] - 0.5
    u = (np.arange(width_px) + 0.5) / width_px * heights.shape[1] - 0.5
    at = np.stack(np.meshgrid(v, u, indexing="ij"))
    fine = map_coordinates(heights, at, order=3, mode="nearest")
    return np.asarray(fine, dtype=np.float64), pitch_mm


def _checked(height_mm: NDArray[np.floating]) -> FloatArray:
    heights = np.asarray(height_mm, dtype=np.float64)
    if heights.ndim != 2 or min(heights.shape) < 8 or not np.isfinite(heights).all():
        raise TouchError(
            f"a picture needs finite heights of shape (H, W) from 8 × 8 up, got {heights.shape}"
        )
    return heights
