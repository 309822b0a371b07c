"""The opening of fingers whose driver has just begun, and the grip that an earlier run left.

Servos keep torque and goals when a run ends or is killed. Nothing is written to them here.
"""

from __future__ import annotations

from collections.abc import Sequence

from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings


def read_kept_ma(bus: Bus, settings: DynamixelSettings) -> float | None:
    """Current of the grip that servos keep [mA]; None without one.

    Every grip of this driver has the closed end as its goal, and no opening has. Servos without
    torque grip nothing, whatever their goals.

    Raises:
        RobotError: A servo does not reply.
    """
    kept_ma = None
    for servo in settings.servos:
        if not bus.read_number(servo.id, reg.TORQUE, 1):
            continue
        goal = bus.read_number(servo.id, reg.GOAL_POSITION, 4, signed=True)
        beyond = goal - servo.closed_ticks
        if (beyond if servo.closed_ticks > servo.open_ticks else -beyond) >= 0:
            units = abs(bus.read_number(servo.id, reg.GOAL_CURRENT, 2, signed=True))
            kept_ma = max(kept_ma or 0.0, units * reg.MODELS[settings.model].unit_ma)
    return kept_ma


def read_width_m(bus: Bus, settings: DynamixelSettings) -> float:
    """Opening between the fingers [m].

    Raises:
        RobotError: A servo does not reply.
    """
    ids = (servo.id for servo in settings.servos)
    positions = [bus.read_number(number, reg.PRESENT_POSITION, 4, signed=True) for number in ids]
    return mean_width_m(settings, positions)


def mean_width_m(settings: DynamixelSettings, positions: Sequence[int]) -> float:
    """Opening between the fingers at positions of their servos [ticks], at least 0 [m]."""
    widths = widths_m(settings, positions)
    return max(0.0, sum(widths) / len(widths))


def widths_m(settings: DynamixelSettings, positions: Sequence[int]) -> list[float]:
    """Opening according to each servo [m], below 0 beyond the closed end."""
    low, high = settings.closed_width_mm, settings.open_width_mm
    return [
        1e-3 * (low + (ticks - s.closed_ticks) / (s.open_ticks - s.closed_ticks) * (high - low))
        for s, ticks in zip(settings.servos, positions, strict=True)
    ]
