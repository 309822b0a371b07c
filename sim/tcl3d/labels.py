"""True labels of a solved contact, from its pressure and clean heights, never from a point cloud.

The rules are the same for every shape:

- depth: the largest height; - in contact: where pressure acts, with gaps narrower than
``CLOSING_MM`` closed, so that the valleys
  of a fine texture count and the space between two dots does not;
- position: the pressure-weighted centre of the part on the pad. For a cap it is the deepest point.
  Where the two differ (tilted, textured, flat or cut contacts), the deepest point is as noisy as
  the paper reports for large contacts, and a gripper has to bring the centre of the load to the
  middle;
- cut: sides where at least ``CUT_MM`` of the border is in contact.

Texture is named here as well, and the labels that lie too near to a limit to be certain.

Not here: shape (``sim.tcl3d.shape_labels``).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import grey_closing
from torch import Tensor

from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.measure import cut_sides
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import (
    AREA_LIMITS,
    CUT_MM,
    DEPTH_LIMITS_MM,
    DIMENSIONS,
    ContactState,
    Shape,
    Texture,
    area_word,
    depth_word,
    position_word,
)
from sim.objects.object import SolidObject
from sim.tcl3d.contact_geometry import ContactGeometry, covered_fraction

CLOSING_MM = 1.4
"""Width of gaps in contact up to which they are closed. Our choice: just below the longest period
(1.5 mm) of ridged and woven textures, well below the shortest pitch (2 mm) of dots."""


def in_contact(pressure: Tensor, pitch_mm: float) -> NDArray[np.bool_]:
    """Masks (B, H, W) of contacts, fine gaps closed.

    Args:
        pressure: Shape (B, H, W), any unit.
        pitch_mm: Pitch of the grid [mm].
    """
    radius = max(1, round(CLOSING_MM / pitch_mm / 2))
    # The border is continued outwards: a contact that is cut does not end there.
    margin = 2 * radius
    padded = np.pad((pressure > 0).numpy(), ((0, 0), (margin,) * 2, (margin,) * 2), mode="edge")
    closed = grey_closing(padded.view(np.uint8), (1, 2 * radius + 1, 2 * radius + 1))
    return closed[:, margin:-margin, margin:-margin].view(np.bool_)


def label(
    *,
    height_mm: NDArray[np.float32],
    pressure_kpa: NDArray[np.float32],
    touching: NDArray[np.bool_],
    force_n: float,
    sensor: SensorSpec,
    shape: Shape,
    texture: Texture,
) -> ContactState:
    """Label one solved contact over the whole sensing area.

    Args:
        height_mm: Shape (H, W) [mm].
        pressure_kpa: Same shape [kPa], somewhere above 0.
        touching: Same shape, from ``in_contact``.
        force_n: Normal force on the pad [N].
        sensor: The sensor.
        shape: Shape label.
        texture: Texture label.
    """
    rows, columns = height_mm.shape
    x, y = grid_axes_mm(sensor, rows, columns)
    load = pressure_kpa.astype(np.float64)
    total = load.sum()
    x_mm = float(load.sum(axis=0) @ x / total)
    y_mm = float(load.sum(axis=1) @ y / total)
    depth_mm, area_fraction = float(height_mm.max()), covered_fraction(touching)
    return ContactState(
        depth_mm=depth_mm,
        x_mm=x_mm,
        y_mm=y_mm,
        area_fraction=area_fraction,
        force_n=force_n,
        depth=depth_word(depth_mm),
        position=position_word(x_mm, y_mm, sensor),
        area=area_word(area_fraction),
        cut=cut_sides(touching, least=round(CUT_MM / (sensor.width_mm / columns))),
        shape=shape,
        texture=texture,
    )


SHAPE, TEXTURE, DEPTH, POSITION, AREA = DIMENSIONS

DEPTH_MM, POSITION_MM, AREA_FACTOR = 0.0015, 0.02, 1.004
"""Distances from a limit within which a label is unsure. Our choice: twice the error of a depth by
the solver's tolerance, a small fraction of a grid point, and one such point along a rim."""

SMOOTH_RELIEF_MM = 0.015
"""Relief under a contact up to which it is smooth: a little above 10 µm."""

MIN_PERIODS = 1.3
"""Number of a texture's periods that a contact must span for a certain label."""


def name_texture(
    obj: SolidObject, contact: ContactGeometry, relief_mm: FloatArray
) -> tuple[Texture, bool]:
    """Label the texture of a contact, and whether a careful person would give it without doubt.

    Args:
        obj: The pressed object.
        contact: Its contact geometry.
        relief_mm: Shape (H, W), relief of its skin [mm].
    """
    counts = np.bincount(obj.part_of_cell, weights=contact.counts, minlength=len(obj.parts))
    skin = obj.parts[int(counts.argmax())].skin
    textures = {obj.parts[i].skin.texture for i in np.flatnonzero(counts > 0.2 * counts.sum())}
    if skin.texture is Texture.SMOOTH:
        return Texture.SMOOTH, len(textures) == 1
    relief = relief_mm[contact.closed & (contact.cells >= 0)]
    relief_range_mm = float(np.ptp(np.percentile(relief, [3, 97]))) if len(relief) else 0.0
    if relief_range_mm < SMOOTH_RELIEF_MM:
        sure = relief_range_mm < 0.6 * SMOOTH_RELIEF_MM
        return Texture.SMOOTH, sure and len(textures) == 1
    width = math.sqrt(float(contact.closed.sum())) * contact.pitch_mm
    return skin.texture, width > MIN_PERIODS * skin.pitch_mm and len(textures) == 1


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
