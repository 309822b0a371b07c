"""What the surface of a contact is like, and which of its labels lie too near a limit to be sure.

Not here: the name of its shape (``sim.tcl3d.shape_labels``).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import AREA_LIMITS_SHARE, DEPTH_LIMITS_MM, ContactState, Texture
from sim.objects.object import Thing
from sim.objects.ray_casting import FloatArray
from sim.tcl3d.touch import Touch

SHAPE, TEXTURE, DEPTH, POSITION, AREA = "shape", "texture", "depth", "position", "area"

DEPTH_MM, POSITION_MM, AREA_FACTOR = 0.0015, 0.02, 1.004
"""Distances from a limit within which a label is unsure. Our choice: twice what the
solver's tolerance moves a depth by, a small part of a grid point, and one such point in a rim."""

FELT_MM = 0.015
"""Relief under a contact below which its surface is smooth: 10 µm and a little."""

PERIODS = 1.3
"""Widths of a texture's pitch that a contact must span for the texture to be told."""


class Surface(NamedTuple):
    """A texture, and whether a careful person would call it so without doubt."""

    texture: Texture
    sure: bool


def name_texture(thing: Thing, touch: Touch, relief_mm: FloatArray) -> Surface:
    """Name the texture of what touches.

    Args:
        thing: What is pressed.
        touch: Where it touches.
        relief_mm: Shape (H, W), its skin's relief [mm].
    """
    counts = np.bincount(thing.part_of_cell, weights=touch.counts, minlength=len(thing.parts))
    skin = thing.parts[int(counts.argmax())].skin
    textures = {thing.parts[i].skin.texture for i in np.flatnonzero(counts > 0.2 * counts.sum())}
    if skin.texture is Texture.SMOOTH:
        return Surface(Texture.SMOOTH, len(textures) == 1)
    under = relief_mm[touch.closed & (touch.cells >= 0)]
    felt = float(np.ptp(np.percentile(under, [3, 97]))) if len(under) else 0.0
    if felt < FELT_MM:
        return Surface(Texture.SMOOTH, felt < 0.6 * FELT_MM and len(textures) == 1)
    width = math.sqrt(float(touch.closed.sum())) * touch.pitch_mm
    return Surface(skin.texture, width > PERIODS * skin.pitch_mm and len(textures) == 1)


def doubts(state: ContactState, sensor: SensorSpec) -> set[str]:
    """Which of depth, position and area are within a hair's breadth of another class."""
    unsure = set()
    if any(abs(state.depth_mm - limit) < DEPTH_MM for limit in DEPTH_LIMITS_MM):
        unsure.add(DEPTH)
    beside_x = abs(abs(state.x_mm) - sensor.width_mm / 6)
    beside_y = abs(abs(state.y_mm) - sensor.height_mm / 6)
    if min(beside_x, beside_y) < POSITION_MM:
        unsure.add(POSITION)
    for limit in AREA_LIMITS_SHARE:
        if limit / AREA_FACTOR < state.area_share < limit * AREA_FACTOR:
            unsure.add(AREA)
    return unsure
