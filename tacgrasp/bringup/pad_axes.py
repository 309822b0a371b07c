"""Find how the pad sits on the tool centre point (TCP), from moves and the shifts of a contact.

The arm makes small steps along the axes of the TCP past a fixed object; a step towards +x of the
pad moves the contact to -x on the pad. Not here: limits of the moves (``primitives``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.measure import contact_state
from primitives.execution import PadAxes, rotate
from primitives.limits import Limits, check_workspace, clamp_force
from tacgrasp.base.errors import UsageError
from tacgrasp.drivers.opening import check_open
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import Rig
from tacgrasp.rig.release import let_go, opened_afterwards

STEP_MM = 2.0
"""Length of a step. Our choice: several times the error of a contact's position, and below the
opening."""

MAX_MISFIT_MM = 0.8
"""Largest misfit of a step [mm]; above it the object has moved along or slipped."""

SQUARE_DEG = 10.0
"""An axis of the pad this close to one of the TCP is set to it, because mounts are square."""

SPEED_M_S = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredAxes:
    """The pad's axes, and the quality of their fit.

    Attributes:
        axes: Axes in the TCP's frame.
        misfit_mm: Largest distance between a measured shift and the fit [mm].
    """

    axes: PadAxes
    misfit_mm: float


def find_pad_axes(
    rig: Rig, limits: Limits, *, force_n: float, clear_mm: float, report: Callable[[str], None]
) -> MeasuredAxes:
    """Step to both sides along each axis of the TCP, and close on the object after every step.

    The arm ends at its start with the gripper open; the gripper is open after an error too, unless
    it has failed itself. The object must keep its place while the gripper is open.

    Raises:
        UsageError: ``clear_mm`` leaves no room for the steps; nothing has moved.
        TouchError: No contact, a contact cut off by the pad's edge, or a shift that fits no pad.
        LimitError: A step would leave the workspace; nothing has moved.
        RobotError: The gripper is not open, and nothing has moved; or a device failed.
    """
    if not (math.isfinite(clear_mm) and clear_mm > 2 * STEP_MM):
        raise UsageError(
            f"--clear-mm must be above {2 * STEP_MM:g}, since the arm steps {STEP_MM:g} mm to both "
            f"sides past the object; got {clear_mm}"
        )
    start, steps = rig.arm.pose(), STEP_MM * np.vstack([np.eye(3), -np.eye(3)])
    targets = [
        replace(start, position_m=start.position_m + 1e-3 * rotate(start.rotvec_rad, step))
        for step in steps
    ]
    for target in targets:
        check_workspace(target, limits)
    force = clamp_force(force_n, limits).value
    speed_m_s = min(SPEED_M_S, limits.max_speed_m_s)
    check_open(rig.gripper)
    centre, shifts = _contact_position(rig, force, clear_mm), []
    report(f"at the start ({centre[0]:+.1f}, {centre[1]:+.1f}) mm")
    for step, target in zip(steps, targets, strict=True):
        rig.arm.move_to(target, speed_m_s=speed_m_s)
        contact = _contact_position(rig, force, clear_mm)
        shifts.append(contact - centre)
        rig.arm.move_to(start, speed_m_s=speed_m_s)
        x, y, z = step
        position = f"({contact[0]:+.1f}, {contact[1]:+.1f})"
        report(f"TCP ({x:+.0f}, {y:+.0f}, {z:+.0f}) mm: contact {position} mm")
    return axes_from_shifts(steps, np.array(shifts))


def _contact_position(rig: Rig, force_n: float, clear_mm: float) -> NDArray[np.float64]:
    """Close from open, measure the position of the contact on the pad [mm], and open again."""
    sense = GelSense(rig.sensor)
    sense.take_reference()
    with opened_afterwards(lambda: let_go(rig.gripper, clear_mm / 1000)):
        rig.gripper.grip(force_n)
        cloud = sense.read()
        state = contact_state(cloud, in_contact=sense.in_contact(cloud))
    if not state.in_contact or state.cut:
        problem = "runs over the pad's edge" if state.in_contact else "is missing"
        raise TouchError(
            f"the contact {problem}; put something small and firm, that stays where it is, at the "
            "middle of the pad, or raise --force-n"
        )
    return np.array([state.x_mm, state.y_mm])


def axes_from_shifts(
    steps_tcp_mm: NDArray[np.float64], shifts_mm: NDArray[np.float64]
) -> MeasuredAxes:
    """Fit the pad's axes to the shifts of a contact.

    Least squares, then the nearest pair of perpendicular unit vectors (polar decomposition), then
    the TCP's own axes where these are close.

    Args:
        steps_tcp_mm: Shape (n, 3), steps of the TCP [mm, TCP frame].
        shifts_mm: Shape (n, 2), shifts of the contact on the pad [mm].

    Raises:
        TouchError: Too few directions, or shifts that fit no rigid pad.
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
    if strength.min() < 0.5 or misfit_mm > MAX_MISFIT_MM:
        raise TouchError(
            f"the contact did not go where a rigid pad takes it (up to {misfit_mm:.1f} mm off): "
            "did the object move along, or roll? Fix it and try again"
        )
    x, y = (tuple(float(v) for v in axis) for axis in pair)
    return MeasuredAxes(
        axes=PadAxes(x_tcp=(x[0], x[1], x[2]), y_tcp=(y[0], y[1], y[2])), misfit_mm=misfit_mm
    )


def _squared(axis: NDArray[np.float64]) -> NDArray[np.float64]:
    square = np.zeros(3)
    largest = int(np.abs(axis).argmax())
    square[largest] = np.sign(axis[largest])
    return square if float(square @ axis) > np.cos(np.radians(SQUARE_DEG)) else axis


def axes_named(right: str, palm: str) -> PadAxes:
    """Axes of the pad from the names of axes of the TCP: '+x', '-z' and so on.

    Args:
        right: Axis that points to the pad's right.
        palm: Axis that points to the palm.

    Raises:
        UsageError: An invalid name, or two names of one axis.
    """
    x, y = _vector(right), _vector(palm)
    if any(a and b for a, b in zip(x, y, strict=True)):
        raise UsageError(f"right and palm must be perpendicular, got {right} and {palm}")
    return PadAxes(x_tcp=x, y_tcp=y)


def _vector(name: str) -> tuple[float, float, float]:
    match = re.fullmatch(r"\s*([+-]?)([xyz])\s*", name)
    if match is None:
        raise UsageError(f"an axis of the TCP is one of +x -x +y -y +z -z, got {name!r}")
    sign = -1.0 if match[1] == "-" else 1.0
    x, y, z = (sign if letter == match[2] else 0.0 for letter in "xyz")
    return x, y, z


def as_yaml(axes: PadAxes) -> Sequence[str]:
    """Lines for a rig's file."""

    def listed(axis: tuple[float, float, float]) -> str:
        return f"[{', '.join(f'{value + 0.0:g}' for value in axis)}]"

    return ("pad:", f"  x_axis: {listed(axes.x_tcp)}", f"  y_axis: {listed(axes.y_tcp)}")
