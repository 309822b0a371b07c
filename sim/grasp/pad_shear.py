"""Shear of one pad through a grasp: what each grip, load and slide leaves in its gel.

The world (``sim.grasp.world``) decides whether the body is held, by the same friction; this follows
it point by point, and changes nothing of it. Until friction gives way, the contact takes the load
in partial slip; then it follows the body's motion.

Not here: a load that changes many times a second (``sim.grasp.holding``).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import torch
from torch import Tensor

from cltp.processor import torch_threads
from cltp.tactile.cloud import FloatArray, Stamp
from cltp.tactile.shear.field import ShearField
from sim.gel.shear.layer import Shear
from sim.gel.shear.load import carry
from sim.gel.shear.sensed import shear_field
from sim.grasp.fingers import LENGTH_MM, FlatFingers, Patch

_LOAD_TOL, _TOL = 5e-3, 5e-4
"""Errors of a load over the friction, and of the solver. Our choice: 20 to 30 ms a load."""


SLIDING_STICK = 0.02
"""Stick fraction up to which all of a contact slides. Our choice: what the solver's tolerance
leaves."""

_REACHES_MM = (0.0, 0.2, 1.0, 5.0)
"""Motions that are tried until a contact slides."""


def slides(shear: Shear) -> bool:
    """Whether all of a contact slides, or nothing touches."""
    return float(shear.stick_fraction) <= SLIDING_STICK


def coarse(fingers: FlatFingers, grid: FloatArray) -> Tensor:
    """A grid (H, W) of the pressure's elements on those of friction, (1, H, W), float32."""
    return fingers.shear.coarse(torch.as_tensor(grid, dtype=torch.float32)[None])


def grid_axes(fingers: FlatFingers, offset_mm: FloatArray | tuple[float, float]) -> FloatArray:
    """Motion of a pad's grid per motion of the body's centre of mass, (3, 3).

    The latter is (x, y [mm], turn × ``LENGTH_MM``), the former as ``ShearLayer.step`` takes it. The
    transpose of this times a load about the grid's centre is that about the centre of mass, (x, y,
    moment over ``LENGTH_MM``) [N].

    Args:
        fingers: The body.
        offset_mm: Shape (2,), its origin on the pad [mm, gel frame].
    """
    com_mm = np.array(offset_mm) + np.array(fingers.body.com_mm)
    turn = 1.0 / LENGTH_MM
    return np.array([[1.0, 0.0, com_mm[1] * turn], [0.0, 1.0, -com_mm[0] * turn], [0.0, 0.0, turn]])


class PadShear:
    """Memory of the gel of one pad; the other one's is the same.

    Args:
        fingers: Body, gel and friction.

    Attributes:
        shear: The contact now; None without any.
    """

    def __init__(self, fingers: FlatFingers) -> None:
        self._fingers, self._layer = fingers, fingers.shear.shear_layer
        self.shear: Shear | None = None
        self._patch: Patch | None = None
        self._load: FloatArray | None = None
        self._seen: tuple[Shear | None, Patch | None, ShearField] | None = None

    def clear(self) -> None:
        """Nothing touches the pad any more."""
        self.shear, self._patch, self._load = None, None, None

    def press(self, patch: Patch) -> None:
        """The gripper's force changed; the body does not move along the pad."""
        self._step(patch, np.zeros(3))

    @torch_threads()
    def carry(self, patch: Patch, load_n: FloatArray) -> None:
        """The body came to rest under a load, as ``FlatFingers.load_on`` gives it."""
        if patch is self._patch and self._load is not None and (load_n == self._load).all():
            return
        axes = grid_axes(self._fingers, patch.offset_mm)
        load = torch.as_tensor(np.linalg.solve(axes.T, load_n))[None]
        carried = carry(
            self._layer, self.shear, self._pressure(patch), load, load_tol=_LOAD_TOL, tol=_TOL
        )
        self.shear, self._patch, self._load = carried.shear, patch, load_n

    def slide(self, patch: Patch, motion_mm: FloatArray) -> None:
        """The body slid: its centre of mass along x and y, and its turn × ``LENGTH_MM`` [mm].

        The motion is that of sliding alone: what the gel gives way before it slides is added.
        """
        length_mm = float(np.linalg.norm(motion_mm))
        if length_mm == 0:
            return
        before, motion = self.shear, grid_axes(self._fingers, patch.offset_mm) @ motion_mm
        for reach_mm in _REACHES_MM:
            self.shear = before
            self._step(patch, motion * max(1.0, reach_mm / length_mm))
            if self.shear is not None and slides(self.shear):
                return

    def field(self, stamp: Stamp | None = None) -> ShearField:
        """What the pad's markers or taxels see, without errors."""
        if (
            self._seen is None
            or self._seen[0] is not self.shear
            or self._seen[1] is not self._patch
        ):
            self._seen = self.shear, self._patch, self._field()
        return replace(self._seen[2], stamp=stamp)

    @torch_threads()
    def _field(self) -> ShearField:
        layer, sensor = self._layer, self._fingers.sensor
        if self.shear is None or self._patch is None:
            rest = layer.at_rest()
            return shear_field(layer, rest, rest.pressure_kpa, sensor)
        height_mm = coarse(self._fingers, self._patch.height_mm)
        return shear_field(layer, self.shear, height_mm, sensor)

    @torch_threads()
    def _step(self, patch: Patch, motion: FloatArray) -> None:
        move = torch.as_tensor(motion)[None]
        self.shear = self._layer.step(self.shear, self._pressure(patch), move, tol=_TOL)
        self._patch, self._load = patch, None

    def _pressure(self, patch: Patch) -> Tensor:
        return coarse(self._fingers, patch.pressure_kpa)
