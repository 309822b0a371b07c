"""The shear field: displacement of a gel's surface, and force on it, at markers or taxels.

Not here: contact states, captions and encoders, which read heights alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp
from cltp.tactile.sensors import SensorSpec

MAX_FORCE_N = 100.0
"""Largest force on one point. Our choice: far beyond a gripper's, so that another unit is met."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearField:
    """Displacements, and forces where the sensor gives them, at points of a gel.

    Attributes:
        positions_mm: Shape (N, 2), float32, read-only: the points (x, y) on the untouched gel, gel
            frame [mm].
        displacement_mm: Shape (N, 3), float32, read-only: (x, y, z) gel frame, z positive into the
            gel [mm].
        sensor: The sensor that measured it.
        force_n: Shape (N, 3), float32, read-only: force of the body on the gel at each point, on
            its marker's or taxel's share of the area; z positive into the gel [N]. None where the
            sensor gives none.
        stamp: Time of capture; None for a field without a clock.

    Raises:
        TouchError: Empty, of a wrong shape, not finite, beyond the sensing area, moved by more than
            the gel's thickness, or with a force beyond ``MAX_FORCE_N``.
    """

    positions_mm: NDArray[np.float32]
    displacement_mm: NDArray[np.float32]
    sensor: SensorSpec
    force_n: NDArray[np.float32] | None = None
    stamp: Stamp | None = None

    def __post_init__(self) -> None:
        positions = np.array(self.positions_mm, dtype=np.float32)  # copies: nobody can change them
        _check_positions(positions, self.sensor)
        displacement = np.array(self.displacement_mm, dtype=np.float32)
        _check_vectors(displacement, len(positions), "displacement_mm")
        largest = float(np.abs(displacement).max())
        if largest > self.sensor.gel_mm:
            raise TouchError(
                f"a point moved by {largest:.3g} mm, more than the {self.sensor.gel_mm} mm gel of "
                f"{self.sensor.name}; give displacement_mm in mm, from the untouched gel"
            )
        fields = {"positions_mm": positions, "displacement_mm": displacement}
        if self.force_n is not None:
            force = np.array(self.force_n, dtype=np.float32)
            _check_vectors(force, len(positions), "force_n")
            largest = float(np.abs(force).max())
            if largest > MAX_FORCE_N:
                raise TouchError(
                    f"a force of {largest:.3g} on one point is beyond {MAX_FORCE_N:g}; give "
                    "force_n in newtons"
                )
            fields["force_n"] = force
        for name, values in fields.items():
            values.setflags(write=False)
            object.__setattr__(self, name, values)

    @property
    def values(self) -> NDArray[np.float32]:
        """Displacement [mm] and force [N] side by side, shape (N, 6): dx dy dz Fx Fy Fz.

        Raises:
            TouchError: The sensor gives no forces.
        """
        if self.force_n is None:
            raise TouchError(f"this field of {self.sensor.name} has no forces; use displacement_mm")
        return np.concatenate([self.displacement_mm, self.force_n], axis=1)

    @property
    def total_force_n(self) -> NDArray[np.float64]:
        """Sum of the forces, shape (3,) [N].

        Raises:
            TouchError: The sensor gives no forces.
        """
        return np.asarray(self.values[:, 3:].sum(axis=0, dtype=np.float64))


def _check_positions(positions: NDArray[np.float32], sensor: SensorSpec) -> None:
    if positions.ndim != 2 or positions.shape[1] != 2 or len(positions) == 0:
        raise TouchError(f"positions_mm need shape (N, 2) with N >= 1, got {positions.shape}")
    if not np.isfinite(positions).all():
        raise TouchError("positions_mm have NaN or infinite values; drop those points first")
    x, y = np.abs(positions).max(axis=0)
    if x > 0.5 * sensor.width_mm or y > 0.5 * sensor.height_mm:
        raise TouchError(
            f"positions_mm reach |x| {x:.1f}, |y| {y:.1f} mm, beyond the sensing area of "
            f"{sensor.name} (±{sensor.width_mm / 2:.1f}, ±{sensor.height_mm / 2:.1f} mm around its "
            "centre); wrong sensor or frame?"
        )


def _check_vectors(values: NDArray[np.float32], count: int, name: str) -> None:
    if values.shape != (count, 3):
        raise TouchError(
            f"{name} needs shape ({count}, 3), as many as positions_mm, got {values.shape}"
        )
    bad = int((~np.isfinite(values).all(axis=1)).sum())
    if bad:
        raise TouchError(f"{name} has {bad} NaN or infinite points of {count}; drop them first")
