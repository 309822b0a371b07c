"""Measure force over current: the gripper squeezes a scale with one current after another.

The force on the scale is read by a callable: a person at a prompt, or an instrument.
"""

from __future__ import annotations

import datetime
from collections.abc import Callable, Sequence

from primitives.errors import LimitError
from tacgrasp.drivers.dynamixel.calibration import ForceReading, GripperCalibration, fit_calibration
from tacgrasp.drivers.dynamixel.fingers import ServoFingers

ReadForce = Callable[[float], float]
"""Takes the set current [mA] and returns the force on the scale [N]."""

_LOWEST_FRACTION = 0.1


def steps_ma(max_ma: float, steps: int) -> Sequence[float]:
    """Currents in equal steps, from a tenth of the largest, so that friction is visible [mA]."""
    low = _LOWEST_FRACTION * max_ma
    return [low + (max_ma - low) * step / (steps - 1) for step in range(steps)]


def calibrate_gripper(
    fingers: ServoFingers,
    read_force: ReadForce,
    currents_ma: Sequence[float],
    *,
    date: datetime.date,
    source: str = "",
) -> GripperCalibration:
    """Squeeze with each current, rising, and fit the line; opens again, also after an error.

    Rising only: with falling currents friction holds against the scale and gives another line.

    Args:
        fingers: Connected fingers with a scale between them.
        read_force: Called when the fingers rest.
        currents_ma: Currents above 0 [mA].
        date: Date of the measurement.
        source: Instrument, for the record.

    Raises:
        LimitError: A current is beyond ``max_current_ma``; nothing has moved.
        RobotError: The gripper fails, or the readings make no line.
    """
    limit_ma = fingers.settings.max_current_ma
    for current_ma in currents_ma:
        if not 0 < current_ma <= limit_ma:
            raise LimitError(
                f"currents must lie in (0, {limit_ma:g}] mA (max_current_ma of the rig's file), "
                f"got {current_ma:g}"
            )
    start_m = fingers.width_m()
    readings = []
    try:
        for current_ma in sorted(currents_ma):
            fingers.squeeze(current_ma)
            set_ma = fingers.unit_ma * max(1, round(current_ma / fingers.unit_ma))
            readings.append(ForceReading(current_ma=set_ma, force_n=read_force(set_ma)))
    finally:
        if not fingers.poller.fault:
            fingers.open_to(start_m)
    return fit_calibration(
        readings, fingers.settings, date=date, adapter=fingers.adapter, source=source
    )
