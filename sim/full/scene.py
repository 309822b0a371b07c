"""A scene: an object over the pad, ready to be pressed, and what labels its contacts need."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.sensors import SensorSpec
from sim.tcl3d.labelled_press import NameContact
from sim.tcl3d.series import grid_over

GENTLE_MM, GENTLE_FRACTION, NEAR_MM = 0.6, 0.22, 0.25
"""Largest depth where more than this fraction of the pad's surface is nearer than ``NEAR_MM``: a
deeper press of a large face would take more force than any gripper has. As in ``sim.tcl3d``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PressScene:
    """An object over the pad.

    Attributes:
        gap_mm: Shape (H, W), its surface behind its foremost point, ``NO_BODY_MM`` beside it [mm].
        loads: Rising depths [mm] of a rigid body, forces [N] of a soft one.
        modulus_mpa: Plane-strain modulus of a soft body [MPa]; None for a rigid one.
        by_force: Whether the loads are forces.
        name: Names a contact.
    """

    gap_mm: FloatArray
    loads: tuple[float, ...]
    modulus_mpa: float | None = None
    by_force: bool = False
    name: NameContact


def pad_grid(sensor: SensorSpec) -> tuple[FloatArray, FloatArray]:
    """Positions x and y of a sensor's grid, each (H, W) [mm]."""
    x, y = np.meshgrid(*grid_axes_mm(sensor, *grid_over(sensor)))
    return x, y


def gentle(depths_mm: tuple[float, ...], gap_mm: FloatArray) -> tuple[float, ...]:
    """Depths [mm], reduced in proportion where a large part of the pad would be pressed deep."""
    if float((gap_mm < NEAR_MM).mean()) <= GENTLE_FRACTION or depths_mm[-1] <= GENTLE_MM:
        return depths_mm
    factor = GENTLE_MM / depths_mm[-1]
    return tuple(each * factor for each in depths_mm)
