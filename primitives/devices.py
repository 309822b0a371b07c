"""Contracts of the two devices that carry out primitives: an arm and a gripper.

Implementations are in ``sim.grasp`` (simulated) and in the drivers. One suite of contract tests,
``tacgrasp.testing``, runs on all of them. Devices know neither primitives nor sensors.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

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
        LimitError: A component is missing or not finite; a controller might accept such a pose.
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
    """State that a gripper reports.

    Attributes:
        width_m: Opening between the fingers [m].
        force_n: Last commanded force, 0 when open [N]; the true force is not measured.
        closed: Whether the last command was ``grip``, be it of an earlier run whose grip is kept.
        clamped: Change of the last command by a limit; '' without one.

    Raises:
        LimitError: A number is not finite; nothing may be decided on such a state.
    """

    width_m: float
    force_n: float
    closed: bool
    clamped: str = ""

    def __post_init__(self) -> None:
        if not (math.isfinite(self.width_m) and math.isfinite(self.force_n)):
            raise LimitError(
                f"a gripper's state needs finite numbers, got {self.width_m} m and {self.force_n} N"
            )


class Arm(Protocol):
    """An arm that moves its tool centre point (TCP) on straight lines.

    Every method raises ``RobotError`` when the device is lost, stopped by a safety function, or did
    not carry out a command; after that only ``stop`` and ``disconnect`` may be called. No method
    returns a stale or invented value.
    """

    def pose(self) -> Pose:
        """The measured pose of the TCP in the base frame."""
        ...

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move on a straight line and return the reached pose.

        Refuses a pose outside the device's own limits (``LimitError``) without moving.
        """
        ...

    def stop(self) -> None:
        """Bring the arm to rest at once. Idempotent, never raises, works after any error."""
        ...

    def disconnect(self) -> None:
        """Stop and free the device. Idempotent, never raises."""
        ...


class Gripper(Protocol):
    """A parallel gripper under force control. Errors as for ``Arm``."""

    def state(self) -> GripperState:
        """The opening and the last commanded force."""
        ...

    def grip(self, force_n: float) -> GripperState:
        """Close until the fingers press with ``force_n`` [N], or adjust a grip to that force.

        Returns when settled. Closing on nothing is not an error: the width is then the minimum.
        Refuses a force that is not finite, not positive or beyond the device (``LimitError``).
        """
        ...

    def open_by(self, clear_m: float) -> GripperState:
        """Open by ``clear_m`` [m] from the present width, so that the object is released."""
        ...

    def stop(self) -> None:
        """Stop moving and keep the present grip. Idempotent, never raises."""
        ...

    def disconnect(self) -> None:
        """Free the device, keeping the present grip. Idempotent, never raises."""
        ...


@runtime_checkable
class AdjustableGripper(Protocol):
    """A gripper whose closed grip can be changed without waiting for it."""

    def adjust(self, force_n: float) -> GripperState:
        """Ask for another force [N] of a closed grip and return at once; the fingers follow.

        Refuses (``LimitError``) a force out of range, and an open grip. Errors as for ``Gripper``.
        """
        ...
