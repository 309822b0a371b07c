"""Measure force over current: the gripper squeezes a scale with one current after another.

Who reads the scale is a callable: a person at a prompt, or an instrument.
"""

from __future__ import annotations

import datetime
from collections.abc import Callable, Sequence

from primitives.errors import LimitError
from tacgrasp.drivers.dynamixel.calibration import GripperCalibration, Reading, fit_calibration
from tacgrasp.drivers.dynamixel.fingers import Hand

ReadForce = Callable[[float], float]
"""Given the current that is set [mA], returns the force on the scale [N]."""

_LOWEST_SHARE = 0.1


def steps_ma(max_ma: float, steps: int) -> Sequence[float]:
    """Currents in equal steps, from a tenth of the largest on, so that friction shows [mA]."""
    low = _LOWEST_SHARE * max_ma
    return [low + (max_ma - low) * step / (steps - 1) for step in range(steps)]


def calibrate_gripper(
    hand: Hand,
    read_force: ReadForce,
    currents_ma: Sequence[float],
    *,
    date: datetime.date,
    source: str = "",
) -> GripperCalibration:
    """Squeeze with each current, rising, and fit the line; opens again, whatever happens.

    Rising only: on the way down friction holds against the scale, and the line would be another.

    Args:
        hand: Connected, with a scale between the fingers.
        read_force: Asked once the fingers rest.
        currents_ma: Above 0 [mA].
        date: Of the measurement.
        source: With what, for the record.

    Raises:
        LimitError: A current is beyond ``max_current_ma``; nothing has moved.
        RobotError: The gripper fails, or the readings make no line.
    """
    most_ma = hand.settings.max_current_ma
    wrong = [current for current in currents_ma if not 0 < current <= most_ma]
    if wrong:
        raise LimitError(
            f"currents must lie in (0, {most_ma:g}] mA (max_current_ma of the rig's file), got "
            f"{wrong[0]:g}"
        )
    start_m = hand.width_m()
    readings = []
    try:
        for current_ma in sorted(currents_ma):
            hand.squeeze(current_ma)
            set_ma = hand.unit_ma * max(1, round(current_ma / hand.unit_ma))
            readings.append(Reading(current_ma=set_ma, force_n=read_force(set_ma)))
    finally:
        if not hand.watch.fault:
            hand.open_to(start_m)
    return fit_calibration(readings, hand.settings, date=date, adapter=hand.adapter, source=source)
