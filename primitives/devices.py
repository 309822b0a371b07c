"""Contracts of the two devices that carry out primitives: an arm and a gripper.

Implementations: ``sim.grasp.rig`` (simulated), the drivers. One contract suite,
    ``tests/contracts``, runs
over all of them. Devices know nothing of primitives or of touch.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from primitives.errors import LimitError


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """A pose of the tool centre point in the arm's base frame, as UR controllers write it.

    Attributes:
        position_m: Shape (3,) [m].
        rotvec_rad: Shape (3,), rotation vector [rad].

    Raises:
        LimitError: A component is missing or not finite (a controller may accept such a pose).
    """

    position_m: NDArray[np.float64]
    rotvec_rad: NDArray[np.float64]

    def __post_init__(self) -> None:
        for name in ("position_m", "rotvec_rad"):
            value = np.array(getattr(self, name), dtype=np.float64)
            if value.shape != (3,) or not np.isfinite(value).all():
                raise LimitError(f"{name} must be three finite numbers, got {value.tolist()}")
            value.setflags(write=False)
            object.__setattr__(self, name, value)


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperState:
    """What a gripper reports.

    Attributes:
        width_m: Opening between the fingers [m].
        force_n: Force last commanded, 0 when open [N]; not a measurement of the true force.
        closed: True when the fingers were last closed on something by ``grip``.
    """

    width_m: float
    force_n: float
    closed: bool


class Arm(Protocol):
    """An arm that moves its tool centre point (TCP) on straight lines.

    Every method raises ``RobotError`` when the device is lost, stopped by a safety function, or did
    not do what it was asked; after that only ``stop`` and ``disconnect`` are of use. No method
    answers with a stale or invented value.
    """

    def pose(self) -> Pose:
        """The measured pose of the TCP in the base frame."""
        ...

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move on a straight line, return when there with the pose that was reached.

        Refuses (``LimitError``) a pose outside what the device itself allows, without moving.
        """
        ...

    def stop(self) -> None:
        """Bring the arm to rest at once. Idempotent, never raises, safe after any error."""
        ...

    def disconnect(self) -> None:
        """Stop and free the device. Idempotent, never raises."""
        ...


class Gripper(Protocol):
    """A parallel gripper under force control. Errors as for ``Arm``."""

    def state(self) -> GripperState:
        """Opening and last commanded force."""
        ...

    def grip(self, force_n: float) -> GripperState:
        """Close until the fingers press with ``force_n`` [N], or adjust a grip to that force.

        Returns when settled. Closing on nothing is not an error: the width is then the minimum.
        Refuses (``LimitError``) a force that is not finite, not positive or beyond the device.
        """
        ...

    def open_by(self, clear_m: float) -> GripperState:
        """Open by ``clear_m`` [m] from the present width, so that the object is free."""
        ...

    def stop(self) -> None:
        """Stop moving and keep the present grip. Idempotent, never raises."""
        ...

    def disconnect(self) -> None:
        """Free the device, keeping the present grip. Idempotent, never raises."""
        ...
