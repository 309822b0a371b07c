"""Bounds of a UR arm's moves: the last check before a move is sent.

Pure functions. A task's own limits (``primitives.limits``) are narrower; these bounds come from the
rig's file alone and are checked in the process that owns the arm.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from tacgrasp.drivers.ur.settings import UrSettings
from tacgrasp.drivers.ur.shared_state import CommandRecord

SLACK = 1e-9
"""Relative tolerance of a comparison with a bound: the bound itself is allowed."""


def refusal(command: CommandRecord, present: Sequence[float], settings: UrSettings) -> str:
    """Reason to refuse a move; empty for none.

    Args:
        command: The move.
        present: Present pose, six numbers [m, rad].
        settings: The bounds.
    """
    numbers = (*command.pose, command.speed_m_s, command.acceleration_m_s2)
    if len(command.pose) != 6 or not all(math.isfinite(v) for v in numbers):
        return f"a move needs finite numbers, got {numbers}"
    for name, value, limit, unit in (
        ("speed", command.speed_m_s, settings.max_speed_m_s, "m/s"),
        ("acceleration", command.acceleration_m_s2, settings.max_acceleration_m_s2, "m/s²"),
    ):
        if not 0 < value <= limit * (1 + SLACK):
            return f"{name} {value:g} {unit} must be above 0 and at most the rig's {limit:g} {unit}"
    box = zip(
        "xyz", command.pose, settings.workspace_low_m, settings.workspace_high_m, strict=False
    )
    for axis, value, low, high in box:
        if not low - SLACK <= value <= high + SLACK:
            return (
                f"{axis} = {value:.4f} m is outside the arm's workspace ({low:g} to {high:g} m); "
                "nothing was sent"
            )
    turn_rad = turn_between_rad(command.pose[3:], present[3:])
    if turn_rad > settings.max_turn_rad + 1e-6:
        return (
            f"the tool would turn by {turn_rad:.3f} rad, at most {settings.max_turn_rad:g} rad is "
            "allowed in one move; nothing was sent"
        )
    return ""


def distance_m(a: Sequence[float], b: Sequence[float]) -> float:
    """Distance between the positions of two poses [m]."""
    return math.dist(a[:3], b[:3])


def expected_duration_s(command: CommandRecord, present: Sequence[float]) -> float:
    """Duration of a move on its trapezoid [s]: of its way [m] or its turn [rad], if that is longer.

    Radians count like metres, as in a turn on the spot. A UR may turn faster along a way, so that
    this is no less than the move takes.
    """
    turn_rad = turn_between_rad(command.pose[3:], present[3:])
    length = max(distance_m(command.pose, present), turn_rad)
    top = min(command.speed_m_s, math.sqrt(length * command.acceleration_m_s2))
    return 0.0 if top == 0 else length / top + top / command.acceleration_m_s2


def turn_between_rad(a: Sequence[float], b: Sequence[float]) -> float:
    """Angle between two orientations given as rotation vectors [rad], 0 to pi.

    One orientation has several rotation vectors (half a turn has two), so that the angle may be 0
    between different vectors.
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
    """The rotation vector of the same orientation that is nearest to another one [rad].

    A controller may report half a turn as (pi, 0, 0) once and (-pi, 0, 0) a moment later.
    """
    angle = math.hypot(*rotvec)
    if angle < 1e-9:
        return tuple(rotvec)
    other = tuple(v * (1.0 - 2.0 * math.pi / angle) for v in rotvec)
    return min(tuple(rotvec), other, key=lambda v: math.dist(v, near))
