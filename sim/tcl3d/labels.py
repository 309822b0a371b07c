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

Not here: shape and texture (``sim.tcl3d.shape_labels``, ``sim.tcl3d.texture_labels``).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import grey_closing
from torch import Tensor

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.measure import cut_sides
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import (
    CUT_MM,
    ContactState,
    Shape,
    Texture,
    area_word,
    depth_word,
    position_word,
)
from sim.tcl3d.masks import covered_fraction

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
