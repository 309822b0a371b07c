"""Settings and calibration of the emulated gripper (``sim.emulators.dynamixel.bus_process``).

The emulator's own line of force over current is saved as a calibration with today's date. The force
then differs from the commanded one by the quantisation of the current only.
"""

from __future__ import annotations

import datetime
from pathlib import Path

from sim.emulators.dynamixel.fingers import Linkage
from tacgrasp.drivers.dynamixel.calibration import (
    MIN_READINGS,
    GripperCalibration,
    save_calibration,
)
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings, ServoSettings

UNIT = "emulated"
MAX_MA = 900.0


def emulated_gripper(
    port: str,
    folder: Path,
    *,
    model: str = "XC330-T288",
    num_servos: int = 1,
    baud: int = 1_000_000,
    linkage: Linkage | None = None,
) -> DynamixelSettings:
    """Settings for an emulator at a port; writes its calibration into a folder.

    Args:
        port: Port announced by the emulator.
        folder: Folder of the rig's file, or a temporary one.
        model: Model of the emulated servos.
        num_servos: Number of emulated servos, 1 or 2.
        baud: Baud rate of the emulator [bit/s].
        linkage: Linkage of the emulator; None is its default.

    Raises:
        RobotError: The calibration can't be written.
    """
    fingers = linkage or Linkage()
    settings = DynamixelSettings(
        port=port,
        baud=baud,
        unit=UNIT,
        model=model,
        servos=tuple(
            ServoSettings(
                id=index + 1,
                open_ticks=round(fingers.ticks(index, fingers.open_width_m)),
                closed_ticks=round(fingers.ticks(index, 0.0)),
            )
            for index in range(num_servos)
        ),
        open_width_mm=1000 * fingers.open_width_m,
        speed_mm_s=200.0,
        max_current_ma=MAX_MA,
    )
    save_calibration(folder / settings.calibration, emulated_calibration(settings, fingers))
    return settings


def emulated_calibration(settings: DynamixelSettings, fingers: Linkage) -> GripperCalibration:
    """Calibration of an emulated gripper: its own line of force over current, dated today."""
    return GripperCalibration(
        unit=settings.unit,
        model=settings.model,
        ids=tuple(servo.id for servo in settings.servos),
        date=datetime.date.today(),
        newtons_per_ma=fingers.newtons_per_ma,
        friction_ma=fingers.friction_ma,
        residual_n=0.0,
        max_force_n=fingers.force_n(settings.max_current_ma),
        num_readings=MIN_READINGS,
        source="the emulator's own line",
    )
