"""What a UR arm is allowed to be asked for: the last check before a move is sent.

Pure functions. A task's own limits (``primitives.limits``) are above this one; these bounds come
from the rig's file alone and are checked in the process that owns the arm.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from tacgrasp.drivers.ur.settings import UrSettings
from tacgrasp.drivers.ur.shared_state import CommandRecord

SLACK = 1e-9
"""Relative slack of a comparison with a bound: a bound itself is allowed."""


def refusal(order: CommandRecord, here: Sequence[float], settings: UrSettings) -> str:
    """Why a move must not be sent, '' when it may.

    Args:
        order: The move.
        here: Present pose, six numbers [m, rad].
        settings: The bounds.
    """
    numbers = (*order.pose, order.speed_m_s, order.acceleration_m_s2)
    if len(order.pose) != 6 or not all(math.isfinite(v) for v in numbers):
        return f"a move needs finite numbers, got {numbers}"
    for name, value, most, unit in (
        ("speed", order.speed_m_s, settings.max_speed_m_s, "m/s"),
        ("acceleration", order.acceleration_m_s2, settings.max_acceleration_m_s2, "m/s²"),
    ):
        if not 0 < value <= most * (1 + SLACK):
            return f"{name} {value:g} {unit} must be above 0 and at most the rig's {most:g} {unit}"
    box = zip("xyz", order.pose, settings.workspace_low_m, settings.workspace_high_m, strict=False)
    for axis, value, low, high in box:
        if not low - SLACK <= value <= high + SLACK:
            return (
                f"{axis} = {value:.4f} m is outside the arm's workspace ({low:g} to {high:g} m); "
                "nothing was sent"
            )
    turn_rad = turn_between_rad(order.pose[3:], here[3:])
    if turn_rad > settings.max_turn_rad + 1e-6:
        return (
            f"the tool would turn by {turn_rad:.3f} rad, at most {settings.max_turn_rad:g} rad is "
            "allowed in one move; nothing was sent"
        )
    return ""


def distance_m(a: Sequence[float], b: Sequence[float]) -> float:
    """Distance between the positions of two poses [m]."""
    return math.dist(a[:3], b[:3])


def expected_duration_s(order: CommandRecord, here: Sequence[float]) -> float:
    """How long a move takes on its trapezoid [s]; turning counts like metres, as on a UR."""
    length = distance_m(order.pose, here) or turn_between_rad(order.pose[3:], here[3:])
    top = min(order.speed_m_s, math.sqrt(length * order.acceleration_m_s2))
    return 0.0 if top == 0 else length / top + top / order.acceleration_m_s2


def turn_between_rad(a: Sequence[float], b: Sequence[float]) -> float:
    """Angle between two orientations given as rotation vectors [rad], 0 to pi.

    The same orientation has several rotation vectors (half a turn has two): components differ where
    the angle is 0.
    """
    p, q = _quaternion(a), _quaternion(b)
    cosine = abs(sum(x * y for x, y in zip(p, q, strict=True)))
    sine = math.sqrt(max(0.0, 1.0 - cosine * cosine))
    return 2.0 * math.atan2(sine, cosine)


def _quaternion(rotvec: Sequence[float]) -> tuple[float, float, float, float]:
    angle = math.hypot(*rotvec)
    if angle < 1e-12:
        return (1.0, 0.0, 0.0, 0.0)
    scale = math.sin(angle / 2) / angle
    return (math.cos(angle / 2), rotvec[0] * scale, rotvec[1] * scale, rotvec[2] * scale)


def nearest_rotvec(rotvec: Sequence[float], near: Sequence[float]) -> tuple[float, ...]:
    """The rotation vector of the same orientation that lies nearest to another one [rad].

    A controller may state half a turn as (pi, 0, 0) now and (-pi, 0, 0) a moment later.
    """
    angle = math.hypot(*rotvec)
    if angle < 1e-9:
        return tuple(rotvec)
    other = tuple(v * (1.0 - 2.0 * math.pi / angle) for v in rotvec)
    return min(tuple(rotvec), other, key=lambda v: math.dist(v, near))
