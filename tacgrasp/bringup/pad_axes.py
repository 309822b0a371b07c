"""Find how the pad sits on the tool centre point (TCP): from moves and what they do to a contact.

The hand goes small steps along the axes of the TCP past an object that stays where it is; a step
towards +x of the pad takes the contact to -x on it. Not here: limits of the moves (``primitives``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.measure import contact_state
from primitives.devices import Pose
from primitives.execution import PadAxes, rotated
from primitives.limits import Limits, check_workspace, clamp_force
from tacgrasp.base.errors import UsageError
from tacgrasp.rig.protocols import Rig

STEP_MM = 2.0
"""Our choice: several times the error of a contact's position, and below the opening."""

WORST_MM = 0.8
"""Largest misfit [mm] of a step: above it the object has moved along, or slipped."""

SQUARE_DEG = 10.0
"""An axis this near to one of the TCP's is taken to be that one (mounts are made square)."""

SPEED_M_S = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundAxes:
    """The pad's axes and how well they explain the contacts.

    Attributes:
        axes: In the TCP's frame.
        misfit_mm: Largest distance between a contact's shift and what the axes explain [mm].
    """

    axes: PadAxes
    misfit_mm: float


def find_pad_axes(
    rig: Rig, limits: Limits, *, force_n: float, clear_mm: float, report: Callable[[str], None]
) -> FoundAxes:
    """Step to both sides along each axis of the TCP, closing on the object every time.

    Ends where it began, open; after an error too it is open, unless the gripper has failed. The
    object must stay where it is while the gripper is open.

    Raises:
        UsageError: ``clear_mm`` is not a positive number; nothing has moved.
        TouchError: There is no contact, it is cut off by the pad's edge, or does not fit.
        LimitError: A step would leave the workspace; nothing has moved.
        RobotError: A device failed.
    """
    if not (math.isfinite(clear_mm) and clear_mm > 0):
        raise UsageError(f"--clear-mm must be a number above 0, got {clear_mm}")
    start, steps = rig.arm.pose(), STEP_MM * np.vstack([np.eye(3), -np.eye(3)])
    targets = [
        Pose(
            position_m=start.position_m + 1e-3 * rotated(start.rotvec_rad, step),
            rotvec_rad=start.rotvec_rad,
        )
        for step in steps
    ]
    for target in targets:
        check_workspace(target, limits)
    force = clamp_force(force_n, limits).value
    speed_m_s = min(SPEED_M_S, limits.max_speed_m_s)
    centre, shifts = _felt_at(rig, force, clear_mm), []
    report(f"at the start ({centre[0]:+.1f}, {centre[1]:+.1f}) mm")
    for step, target in zip(steps, targets, strict=True):
        rig.arm.move_to(target, speed_m_s=speed_m_s)
        at = _felt_at(rig, force, clear_mm)
        shifts.append(at - centre)
        rig.arm.move_to(start, speed_m_s=speed_m_s)
        x, y, z = step
        report(f"TCP ({x:+.0f}, {y:+.0f}, {z:+.0f}) mm: contact ({at[0]:+.1f}, {at[1]:+.1f}) mm")
    return axes_from_shifts(steps, np.array(shifts))


def _felt_at(rig: Rig, force_n: float, clear_mm: float) -> NDArray[np.float64]:
    """Where the contact is on the pad when the fingers are closed [mm]; they are open after it."""
    rig.gripper.grip(force_n)
    try:
        state = contact_state(rig.sensor.read())
    finally:
        rig.gripper.open_by(clear_mm / 1000)
    if not state.in_contact or state.cut:
        what = "runs over the pad's edge" if state.in_contact else "is not there"
        raise TouchError(
            f"the contact {what}; put something small and firm, that stays where it is, at the "
            "middle of the pad, or raise --force-n"
        )
    return np.array([state.x_mm, state.y_mm])


def axes_from_shifts(
    steps_tcp_mm: NDArray[np.float64], shifts_mm: NDArray[np.float64]
) -> FoundAxes:
    """The axes that explain how contacts shifted.

    Least squares, then the nearest pair of perpendicular unit vectors (polar decomposition), then
    square to the TCP where nearly so.

    Args:
        steps_tcp_mm: Shape (n, 3), what the TCP went [mm, TCP frame].
        shifts_mm: Shape (n, 2), what the contact went on the pad [mm].

    Raises:
        TouchError: Too few directions, or the shifts do not fit a rigid pad.
    """
    fitted, _, rank, _ = np.linalg.lstsq(steps_tcp_mm, -shifts_mm, rcond=None)
    if rank < 3:
        raise TouchError("the steps must go along all three axes of the TCP")
    left, strength, right = np.linalg.svd(fitted.T, full_matrices=False)
    pair = left @ right
    nearest = [_squared(axis) for axis in pair]
    if abs(float(nearest[0] @ nearest[1])) < 1e-9:
        pair = np.array(nearest)
    misfit_mm = float(np.abs(shifts_mm + steps_tcp_mm @ pair.T).max())
    if strength.min() < 0.5 or misfit_mm > WORST_MM:
        raise TouchError(
            f"the contact did not go where a rigid pad takes it (up to {misfit_mm:.1f} mm off): "
            "did the object move along, or roll? Fix it and try again"
        )
    x, y = (tuple(float(v) for v in axis) for axis in pair)
    return FoundAxes(
        axes=PadAxes(x_tcp=(x[0], x[1], x[2]), y_tcp=(y[0], y[1], y[2])), misfit_mm=misfit_mm
    )


def _squared(axis: NDArray[np.float64]) -> NDArray[np.float64]:
    square = np.zeros(3)
    largest = int(np.abs(axis).argmax())
    square[largest] = np.sign(axis[largest])
    return square if float(square @ axis) > np.cos(np.radians(SQUARE_DEG)) else axis


def axes_named(right: str, palm: str) -> PadAxes:
    """The axes of someone who looked: '+x', '-z' and so on, of the TCP.

    Args:
        right: Direction of the pad's right.
        palm: Direction towards the palm.

    Raises:
        UsageError: Not such a name, or both along one axis.
    """
    vectors = [_vector(name) for name in (right, palm)]
    if any(a and b for a, b in zip(*vectors, strict=True)):
        raise UsageError(f"right and palm must be perpendicular, got {right} and {palm}")
    (x, y) = (tuple(vector) for vector in vectors)
    return PadAxes(x_tcp=(x[0], x[1], x[2]), y_tcp=(y[0], y[1], y[2]))


def _vector(name: str) -> list[float]:
    found = re.fullmatch(r"\s*([+-]?)([xyz])\s*", name)
    if found is None:
        raise UsageError(f"an axis of the TCP is one of +x -x +y -y +z -z, got {name!r}")
    sign = -1.0 if found[1] == "-" else 1.0
    return [sign if letter == found[2] else 0.0 for letter in "xyz"]


def as_yaml(axes: PadAxes) -> Sequence[str]:
    """The lines of a rig's file."""

    def listed(axis: tuple[float, float, float]) -> str:
        return f"[{', '.join(f'{value + 0.0:g}' for value in axis)}]"

    return ("pad:", f"  x_axis: {listed(axes.x_tcp)}", f"  y_axis: {listed(axes.y_tcp)}")
