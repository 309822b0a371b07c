"""Texture label of a contact, and the labels that lie too near to a limit to be certain.

Not here: the shape label (``sim.tcl3d.shape_labels``).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import AREA_LIMITS, DEPTH_LIMITS_MM, DIMENSIONS, ContactState, Texture
from sim.objects.object import SolidObject
from sim.tcl3d.contact_geometry import ContactGeometry

SHAPE, TEXTURE, DEPTH, POSITION, AREA = DIMENSIONS

DEPTH_MM, POSITION_MM, AREA_FACTOR = 0.0015, 0.02, 1.004
"""Distances from a limit within which a label is unsure. Our choice: twice the error of a depth by
the solver's tolerance, a small fraction of a grid point, and one such point along a rim."""

SMOOTH_RELIEF_MM = 0.015
"""Relief under a contact up to which it is smooth: a little above 10 µm."""

MIN_PERIODS = 1.3
"""Number of a texture's periods that a contact must span for a certain label."""


class TextureLabel(NamedTuple):
    """A texture, and whether a careful person would give this label without doubt."""

    texture: Texture
    sure: bool


def name_texture(obj: SolidObject, contact: ContactGeometry, relief_mm: FloatArray) -> TextureLabel:
    """Label the texture of a contact.

    Args:
        obj: The pressed object.
        contact: Its contact geometry.
        relief_mm: Shape (H, W), relief of its skin [mm].
    """
    counts = np.bincount(obj.part_of_cell, weights=contact.counts, minlength=len(obj.parts))
    skin = obj.parts[int(counts.argmax())].skin
    textures = {obj.parts[i].skin.texture for i in np.flatnonzero(counts > 0.2 * counts.sum())}
    if skin.texture is Texture.SMOOTH:
        return TextureLabel(Texture.SMOOTH, len(textures) == 1)
    relief = relief_mm[contact.closed & (contact.cells >= 0)]
    relief_range_mm = float(np.ptp(np.percentile(relief, [3, 97]))) if len(relief) else 0.0
    if relief_range_mm < SMOOTH_RELIEF_MM:
        return TextureLabel(
            Texture.SMOOTH, relief_range_mm < 0.6 * SMOOTH_RELIEF_MM and len(textures) == 1
        )
    width = math.sqrt(float(contact.closed.sum())) * contact.pitch_mm
    return TextureLabel(skin.texture, width > MIN_PERIODS * skin.pitch_mm and len(textures) == 1)


def uncertain_labels(state: ContactState, sensor: SensorSpec) -> set[str]:
    """Those of depth, position and area that lie too near to the limit of a class."""
    unsure = set()
    if any(abs(state.depth_mm - limit) < DEPTH_MM for limit in DEPTH_LIMITS_MM):
        unsure.add(DEPTH)
    margin_x = abs(abs(state.x_mm) - sensor.width_mm / 6)
    margin_y = abs(abs(state.y_mm) - sensor.height_mm / 6)
    if min(margin_x, margin_y) < POSITION_MM:
        unsure.add(POSITION)
    for limit in AREA_LIMITS:
        if limit / AREA_FACTOR < state.area_fraction < limit * AREA_FACTOR:
            unsure.add(AREA)
    return unsure
