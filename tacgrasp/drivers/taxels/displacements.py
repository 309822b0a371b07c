"""Displacements of a taxel array's frames, and the shear field of them.

Not here: clouds of heights (``cltp.tactile.cloud``), the packets (``cltp.sensing.taxel_packets``).
"""

from __future__ import annotations

import numpy as np

from cltp.sensing.taxel_packets import TaxelFrame
from cltp.tactile.cloud import FloatArray, Stamp, grid_axes_mm
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField


def displacement_mm(frame: TaxelFrame) -> FloatArray:
    """Displacements of a frame, (rows, columns, 3) [mm, gel frame]: x, y and z.

    Of a frame of heights alone, (rows, columns, 1): z.
    """
    height, along = frame.height_mm[:, :, None], frame.along_mm
    moved = height if along is None else np.concatenate([along, height], axis=2)
    return moved.astype(np.float64)


def shear_of(moved_mm: FloatArray, sensor: SensorSpec, stamp: Stamp) -> ShearField | None:
    """Shear field of displacements as ``displacement_mm`` gives them; None of heights alone.

    Raises:
        TouchError: A taxel moved by more than the gel's thickness.
    """
    rows, columns, numbers = moved_mm.shape
    if numbers == 1:
        return None
    x, y = np.meshgrid(*grid_axes_mm(sensor, rows, columns))
    return ShearField(
        positions_mm=np.stack([x.ravel(), y.ravel()], axis=1).astype(np.float32),
        displacement_mm=moved_mm.reshape(-1, 3).astype(np.float32),
        sensor=sensor,
        stamp=stamp,
    )
