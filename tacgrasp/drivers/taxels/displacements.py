"""Displacements of a taxel array's frames, the shear field of them, and what is wrong with them.

Not here: clouds of heights (``cltp.tactile.cloud``), the packets (``cltp.sensing.taxel_packets``).
"""

from __future__ import annotations

import numpy as np

from cltp.sensing.taxel_packets import UM_LIMIT, TaxelFrame
from cltp.tactile.cloud import FloatArray, Stamp, grid_axes_mm
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField

SATURATED_FRACTION = 0.2
"""Largest fraction of taxels at the end of their range in a valid frame. Our choice: a deeper
contact would destroy the gel first."""


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


def problem_of(frame: TaxelFrame) -> str:
    """Reason why a frame shows no gel; empty for none."""
    counts = frame.counts_um
    if int(counts.min()) == int(counts.max()):
        return (
            f"all taxels read {int(counts[0, 0])} µm; expected a gel, whose noise alone is some "
            "µm: the sensing element is dead or dark, check its light and supply"
        )
    at_end = np.abs(counts.astype(np.int32)) > UM_LIMIT
    if frame.along_um is not None:
        at_end |= (np.abs(frame.along_um.astype(np.int32)) > UM_LIMIT).any(axis=2)
    saturated = float(at_end.mean())
    if saturated > SATURATED_FRACTION:
        return f"{saturated:.0%} of the taxels are at the end of their range: check its supply"
    return ""
