"""Force of a gripper over the current of its servos: a measured line, kept in the rig's folder.

A blocked servo with a set current presses with about (current - friction) × slope. Both constants
differ from gripper to gripper and change with wear. A calibration therefore names its gripper and
its date, and is refused for another gripper or when it is too old.

Not here: moving the gripper for a measurement (``measure_calibration``).
"""

from __future__ import annotations

import csv
import datetime
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml
from pydantic import Field, ValidationError, model_validator

from cltp.atomic_write import write_atomically
from primitives.errors import RobotError
from tacgrasp.base.settings import Number, SettingsBase
from tacgrasp.base.strict_yaml import YamlError, read_yaml_file
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings

ADVICE = "make one with: tacgrasp calibrate gripper"

MIN_READINGS = 3
MAX_RESIDUAL_FRACTION = 0.15
"""Residual over the largest force; above it a line does not describe the gripper. Our choice."""


class GripperCalibration(SettingsBase):
    """The fitted line, the gripper that it belongs to, and the quality of the fit.

    Attributes:
        unit: Name of the gripper in its rig's file.
        model: Model of its servos.
        ids: Ids of its servos.
        adapter: Serial number of the USB adapter; empty if the adapter has none.
        date: Date of the measurement.
        newtons_per_ma: Slope of the line [N/mA].
        friction_ma: Current at which the gripper begins to press [mA].
        residual_n: Root mean square residual of the line [N].
        max_force_n: Largest measured force, and the limit of every commanded force [N].
        num_readings: Number of readings.
        source: Instrument or file of the readings.
    """

    unit: str = Field(min_length=1)
    model: str
    ids: tuple[int, ...] = Field(min_length=1, max_length=2)
    adapter: str = ""
    date: datetime.date
    newtons_per_ma: Number = Field(gt=0, le=1)
    friction_ma: Number = Field(ge=-200, le=1000)
    residual_n: Number = Field(ge=0)
    max_force_n: Number = Field(gt=0, le=500)
    num_readings: int = Field(ge=MIN_READINGS, strict=True)
    source: str = ""

    @model_validator(mode="after")
    def _the_line_fits(self) -> GripperCalibration:
        if self.residual_n > MAX_RESIDUAL_FRACTION * self.max_force_n:
            raise ValueError(
                f"residual_n {self.residual_n:.2f} is more than {MAX_RESIDUAL_FRACTION:.0%} "
                f"of max_force_n {self.max_force_n:.2f}: the readings are on no line"
            )
        return self

    def current_ma(self, force_n: float) -> float:
        return self.friction_ma + force_n / self.newtons_per_ma

    def force_n(self, current_ma: float) -> float:
        return max(0.0, (current_ma - self.friction_ma) * self.newtons_per_ma)

    def step_n(self, unit_ma: float) -> float:
        """Change of the force by one unit of current [N]."""
        return self.newtons_per_ma * unit_ma

    def least_n(self, unit_ma: float) -> float:
        """Least force above 0 that every command of whole units of current can make [N]."""
        return max(self.step_n(unit_ma), self.force_n(unit_ma))


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceReading:
    """One force read off a scale at a set current.

    Raises:
        RobotError: A value is not finite or negative.
    """

    current_ma: float
    force_n: float

    def __post_init__(self) -> None:
        values = (self.current_ma, self.force_n)
        if not (np.isfinite(values).all() and min(values) >= 0):
            raise RobotError(
                f"a reading is a current from 0 mA on and a force from 0 N on, got "
                f"{self.current_ma} mA and {self.force_n} N"
            )


def fit_calibration(
    readings: Sequence[ForceReading],
    settings: DynamixelSettings,
    *,
    date: datetime.date,
    adapter: str = "",
    source: str = "",
) -> GripperCalibration:
    """Fit the line through readings, by least squares over those with a force above 0.

    Raises:
        RobotError: Too few readings, or readings that lie on no line.
    """
    pressing = [reading for reading in readings if reading.force_n > 0]
    currents = np.array([reading.current_ma for reading in pressing])
    forces = np.array([reading.force_n for reading in pressing])
    if len(pressing) < MIN_READINGS or len(set(currents)) < 2:
        raise RobotError(
            f"a line needs {MIN_READINGS} or more readings above 0 N at different currents, got "
            f"{len(pressing)}; measure at more currents"
        )
    slope, start = np.polyfit(currents, forces, 1)
    if slope <= 0:
        raise RobotError(
            f"force falls with current ({slope:.4f} N/mA): the readings are wrong or in another "
            "order; expected pairs of current [mA] and force [N]"
        )
    residual_n = float(np.sqrt(np.mean((forces - (slope * currents + start)) ** 2)))
    try:
        return GripperCalibration(
            unit=settings.unit,
            model=settings.model,
            ids=settings.ids,
            adapter=adapter,
            date=date,
            newtons_per_ma=float(slope),
            friction_ma=float(-start / slope),
            residual_n=residual_n,
            max_force_n=float(forces.max()),
            num_readings=len(pressing),
            source=source,
        )
    except ValidationError as error:
        raise RobotError(f"these readings make no calibration: {_first_error(error)}") from None


def read_readings(path: Path) -> Sequence[ForceReading]:
    """Read readings from a CSV file with the columns current_ma and force_n.

    Raises:
        RobotError: No such file, or an invalid line.
    """
    expected = "expected a CSV file with the columns current_ma and force_n"
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = csv.DictReader(file)
            if not {"current_ma", "force_n"} <= set(rows.fieldnames or ()):
                raise RobotError(f"{expected}, got {rows.fieldnames}")
            readings = []
            for row in rows:
                try:
                    current_ma, force_n = float(row["current_ma"]), float(row["force_n"])
                except (TypeError, ValueError):
                    raise RobotError(f"line {rows.line_num}: {expected}, got {row}") from None
                readings.append(ForceReading(current_ma=current_ma, force_n=force_n))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise RobotError(f"{expected}: {error}") from None
    return readings


def save_calibration(path: Path, calibration: GripperCalibration) -> None:
    """Write a calibration as YAML, whole or not at all.

    Raises:
        RobotError: The file can't be written.
    """
    text = (
        "# Force of a gripper over the current of its servos; made by: tacgrasp calibrate gripper\n"
        + yaml.safe_dump(calibration.model_dump(mode="json"), sort_keys=False)
    )
    try:
        write_atomically(path, text)
    except OSError as error:
        raise RobotError(f"the calibration can't be written to {path}: {error.strerror}") from None


def load_calibration(path: Path) -> GripperCalibration:
    """Read a calibration.

    Raises:
        RobotError: The file is missing or damaged.
    """
    try:
        values = read_yaml_file(path)
        if isinstance(values, dict):
            return GripperCalibration(**values)
        reason = "expected fields"
    except FileNotFoundError:
        raise RobotError(f"no calibration of the gripper at {path}; {ADVICE}") from None
    except ValidationError as error:
        reason = _first_error(error)
    except (OSError, UnicodeDecodeError, YamlError) as error:
        reason = " ".join(str(error).split())
    raise RobotError(f"{path} is no calibration of a gripper: {reason}; {ADVICE}")


def refusal(
    calibration: GripperCalibration,
    settings: DynamixelSettings,
    *,
    adapter: str,
    today: datetime.date,
) -> str:
    """Reason to refuse a calibration for this gripper and date; empty for none."""
    for name, calibrated, connected in (
        ("unit", calibration.unit, settings.unit),
        ("model", calibration.model, settings.model),
        ("ids", calibration.ids, settings.ids),
        ("adapter", calibration.adapter or adapter, adapter or calibration.adapter),
    ):
        if calibrated != connected:
            return (
                f"the calibration is of another gripper: its {name} is {calibrated}, this one's "
                f"{connected}; {ADVICE}"
            )
    age_days = (today - calibration.date).days
    if age_days < 0:
        return (
            f"the calibration is dated {calibration.date}, after today ({today}): check this "
            "computer's clock"
        )
    if age_days > settings.max_calibration_age_days:
        return (
            f"the calibration is {age_days} days old (max_calibration_age_days is "
            f"{settings.max_calibration_age_days}); make a new one with: tacgrasp calibrate gripper"
        )
    return ""


def _first_error(error: ValidationError) -> str:
    first = error.errors()[0]
    field = ".".join(str(part) for part in first["loc"])
    return f"{field}: {first['msg']}" if field else str(first["msg"])
