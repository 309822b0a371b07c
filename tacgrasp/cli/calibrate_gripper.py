"""``tacgrasp calibrate gripper``: measure force over current, with a scale between the fingers."""

from __future__ import annotations

import datetime
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_ending, check_kept

if TYPE_CHECKING:
    from rich.console import Console

    from tacgrasp.drivers.dynamixel.calibration import GripperCalibration
    from tacgrasp.drivers.dynamixel.settings import DynamixelSettings


@dataclass(frozen=True)
class CalibrateGripperFlags:
    """Measure force over current of a gripper, with a scale or from a file of readings.

    The driver sets newtons by it. Put a scale between the open fingers. The gripper squeezes it
    with one current after another, and you type the force that it shows. With --readings nothing
    moves: a file is fitted.

    Attributes:
        rig: Path of the rig's YAML file, whose section hardware.gripper names the gripper and the
            file of its calibration.
        readings: CSV file with the columns current_ma and force_n, to fit instead of measuring.
        max_ma: Largest current [mA]; the rig's max_current_ma if omitted.
        steps: Number of currents.
        source: Instrument that showed the force; stored in the file.
        date: Date of the readings, like 2026-01-31; today if omitted.
        out: File to write; the one named in the rig's file if omitted.
        overwrite: Replace an existing file, once the new calibration is complete.
    """

    rig: Path
    readings: Path | None = None
    max_ma: float | None = None
    steps: int = 8
    source: str = ""
    date: str = ""
    out: Path | None = None
    overwrite: bool = False


def run(flags: CalibrateGripperFlags) -> None:
    """Measure, or fit the file of readings, and save the calibration."""
    from primitives.errors import RobotError
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console
    from tacgrasp.drivers.dynamixel.calibration import (
        fit_calibration,
        read_readings,
        save_calibration,
    )

    if not 3 <= flags.steps <= 50:
        raise UsageError(f"--steps must be 3 to 50, got {flags.steps}")
    date = parse_date(flags.date)
    config, _ = load(None, str(flags.rig), os.environ)
    if config.hardware is None:
        raise UsageError(
            f"--rig {flags.rig} has no section hardware, hence no gripper to calibrate"
        )
    settings, console = config.hardware.dynamixel_gripper, make_console()
    out = flags.out or settings.calibration
    if not out.parent.is_dir():
        raise UsageError(f"the calibration can't be written to {out}: {out.parent} is no folder")
    if flags.out is not None:
        check_ending(flags.out, ".yaml", ".yml")
    if out.resolve() == flags.rig.resolve():
        raise UsageError(f"--out {out} is the rig's own file; name another")
    check_kept(out, overwrite=flags.overwrite)
    if flags.readings is None:
        calibration = _measured(flags, settings, date, console)
    else:
        source = flags.source or flags.readings.name
        try:
            readings = read_readings(flags.readings)
            calibration = fit_calibration(readings, settings, date=date, source=source)
        except RobotError as error:
            raise UsageError(f"--readings {flags.readings}: {error}") from None
    save_calibration(out, calibration)
    console.print(f"readings  {calibration.num_readings}, up to {calibration.max_force_n:.2f} N")
    console.print(
        f"line      {calibration.newtons_per_ma:.5f} N/mA from {calibration.friction_ma:.1f} mA on"
    )
    console.print(f"residual  {calibration.residual_n:.3f} N")
    console.print(f"written   {out}, for {settings.unit} ({settings.model})")


def parse_date(text: str) -> datetime.date:
    """Date of a flag; today for an empty text.

    Raises:
        UsageError: No date in the form 2026-01-31, or one after today.
    """
    today = datetime.date.today()
    try:
        date = datetime.date.fromisoformat(text) if text else today
    except ValueError:
        raise UsageError(f"--date must be like 2026-01-31, got {text}") from None
    if date > today:
        raise UsageError(f"--date {text} is after today ({today}); give the day of the readings")
    return date


def _measured(
    flags: CalibrateGripperFlags, settings: DynamixelSettings, date: datetime.date, console: Console
) -> GripperCalibration:
    from primitives.errors import RobotError
    from tacgrasp.drivers.dynamixel.fingers import connect_fingers
    from tacgrasp.drivers.dynamixel.measure_calibration import calibrate_gripper, steps_ma
    from tacgrasp.drivers.opening import opening_problem
    from tacgrasp.rig.release import opened_afterwards

    fingers = connect_fingers(settings)
    try:
        grip = "" if fingers.kept_ma is None else f"{fingers.kept_ma:.0f} mA"
        problem = opening_problem(fingers.width_m(), grip, "it would be squeezed harder, then fall")
        if problem:
            raise RobotError(f"{problem}; nothing moved")
        console.print("put the scale between the fingers, at zero; they will close")
        _read_line("press Enter when it is there, Ctrl-C to leave: ")
        max_ma = settings.max_current_ma if flags.max_ma is None else flags.max_ma
        start_m = fingers.width_m()
        with opened_afterwards(lambda: fingers.open_to(start_m)):
            return calibrate_gripper(
                fingers,
                _ask_force,
                steps_ma(max_ma, flags.steps),
                date=date,
                source=flags.source or "read by a person",
            )
    finally:
        fingers.disconnect()


def _ask_force(current_ma: float) -> float:
    """Ask for the force on the scale [N], until the answer is a number from 0 on."""
    while True:
        text = _read_line(f"{current_ma:.0f} mA; force on the scale [N]: ")
        try:
            force_n = float(text.replace(",", "."))
        except ValueError:
            continue
        if 0 <= force_n < 1000:
            return force_n


def _read_line(prompt: str) -> str:
    try:
        return input(prompt)
    except EOFError:
        raise UsageError(
            "the input ended before all forces were read; without a person at the keyboard give "
            "--readings FILE"
        ) from None
