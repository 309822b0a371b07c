"""What a sensor sees of a sheared gel: displacement and force at its markers or taxels.

Not here: errors of a sensor; none is added.
"""

from __future__ import annotations

import math

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.tactile.cloud import Stamp, grid_axes_mm, heights_at
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField
from sim.gel.shear.layer import Shear, ShearLayer

TAXELS = (12, 12)
"""Rows and columns of points of a sensor that measures no shear. Our choice."""


def surface_mm(layer: ShearLayer, shear: Shear, height_mm: Tensor) -> Tensor:
    """Displacement of the surface by pressure and traction together, (B, 3, H, W) [mm].

    Args:
        layer: The gel of the contacts.
        shear: Contacts.
        height_mm: Their surface under pressure alone, as a ``Press`` gives it, (B, H, W) [mm].
    """
    along = shear.displacement_mm + layer.spread_mm(shear)
    return torch.cat([along, (height_mm + layer.sink_mm(shear))[:, None]], 1)


def shear_field(
    layer: ShearLayer,
    shear: Shear,
    height_mm: Tensor,
    sensor: SensorSpec,
    *,
    grid: tuple[int, int] | None = None,
    stamp: Stamp | None = None,
) -> ShearField:
    """One contact as a sensor sees it at the middle of equal cells of its sensing area.

    Displacements are those of the surface at these points; the force on each is that on its cell,
    so that no force is lost.

    Args:
        layer: The gel, on a grid over the whole sensing area.
        shear: One contact.
        height_mm: Its surface under pressure alone, (1, H, W) [mm].
        sensor: The sensor.
        grid: Rows and columns of points; None are those of the sensor, or ``TAXELS`` where it
            measures no shear.
        stamp: Time of capture.

    Raises:
        ValueError: More contacts than one, or a grid that does not cover the sensing area.
        TouchError: A displacement or force that no sensor has.
    """
    rows, columns = grid or sensor.shear_grid or sensor.markers or TAXELS
    given = layer.layer
    extent = given.rows * given.pitch_mm, given.columns * given.pitch_mm
    area = sensor.height_mm, sensor.width_mm
    if len(shear.pressure_kpa) != 1:
        raise ValueError(f"a field is of one contact, got {len(shear.pressure_kpa)}; take one")
    if not all(math.isclose(a, b, rel_tol=0.01) for a, b in zip(extent, area, strict=True)):
        raise ValueError(
            f"the gel's grid spans {extent[0]:.2f} × {extent[1]:.2f} mm, the sensing area of "
            f"{sensor.name} {area[0]:.2f} × {area[1]:.2f}; solve on a grid over all of it"
        )
    x, y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(sensor, rows, columns)))
    moved = _numpy(surface_mm(layer, shear, height_mm)[0])
    stress = torch.cat([shear.traction_kpa, shear.pressure_kpa[:, None]], 1)[0]
    element_n = 1e-3 * _numpy(stress) * given.pitch_mm**2
    force = _shares(given.rows, rows) @ element_n @ _shares(given.columns, columns).T
    return ShearField(
        positions_mm=np.stack([x, y], axis=1).astype(np.float32),
        displacement_mm=np.stack([heights_at(each, x, y, sensor) for each in moved], axis=1).astype(
            np.float32
        ),
        force_n=force.reshape(3, -1).T.astype(np.float32),
        sensor=sensor,
        stamp=stamp,
    )


def _numpy(values: Tensor) -> NDArray[np.float64]:
    return np.asarray(values.detach().double().cpu().numpy())


def _shares(elements: int, cells: int) -> NDArray[np.float64]:
    """Fraction of each of equal elements that lies in each of equal cells, (cells, elements)."""
    edges = np.arange(elements)[None, :] / elements, np.arange(cells)[:, None] / cells
    common = np.minimum(edges[0] + 1 / elements, edges[1] + 1 / cells) - np.maximum(*edges)
    return np.asarray(elements * np.clip(common, 0.0, None))
