"""A sensor's force calibration as its rig's file names it: settings, loading, and its check.

Not here: the calibration itself (``cltp.sensing.force_calibration``), how it is measured
(``tacgrasp.bringup.force_loads``).
"""

from __future__ import annotations

import datetime
from collections.abc import Callable
from pathlib import Path
from typing import Self

from pydantic import Field

from cltp.errors import TouchError
from cltp.sensing.force_calibration import (
    MAX_AGE_DAYS,
    ForceCalibration,
    force_refusal,
    load_force_calibration,
)
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from tacgrasp.base.settings import Number, SettingsBase
from tacgrasp.drivers.check import Finding, finding

CALIBRATE = (
    "calibrate it: tacgrasp calibrate force, then name the file as force_calibration in the rig's "
    "file (hardware.sensor)"
)


FORCE_CHECK = "force calibration"


class SensorUnitSettings(SettingsBase):
    """What the settings of every sensor say about its unit.

    Attributes:
        unit: Name of the unit in its calibrations.
        force_calibration: File of this unit from ``tacgrasp calibrate force``; without one, forces
            are marked as uncalibrated.
        max_force_calibration_age_days: Largest age of a force calibration [days].
    """

    unit: str = Field(default="unnamed", min_length=1)
    force_calibration: Path | None = None
    max_force_calibration_age_days: Number = Field(default=MAX_AGE_DAYS, gt=0, le=10_000)

    @property
    def sensor_name(self) -> str:
        """Name of the sensor's model."""
        raise NotImplementedError

    def without_force(self) -> Self:
        """The same unit without a force calibration, to test it whatever that file is like."""
        return self.model_copy(update={"force_calibration": None})


Today = Callable[[], datetime.date]


def load_unit_force(
    settings: SensorUnitSettings, today: Today = datetime.date.today
) -> ForceCalibration | None:
    """Read the force calibration of a rig's file; None where it names none.

    Raises:
        TouchError: Missing, damaged, of another sensor or unit, too old or of the future.
    """
    path = settings.force_calibration
    if path is None:
        return None
    calibration = load_force_calibration(path)
    refusal = force_refusal(
        calibration,
        sensor=settings.sensor_name,
        unit=settings.unit,
        today=today(),
        max_age_days=settings.max_force_calibration_age_days,
    )
    if refusal:
        raise TouchError(f"{path}: {refusal}")
    return calibration


def force_scale_of(settings: SensorUnitSettings, today: Today = datetime.date.today) -> ForceScale:
    """Force scale of a rig's sensor; ``UNCALIBRATED`` where its file names no calibration.

    Raises:
        TouchError: As ``load_unit_force``.
    """
    calibration = load_unit_force(settings, today)
    return UNCALIBRATED if calibration is None else calibration.scale


def uncalibrated_refusal(settings: SensorUnitSettings) -> str:
    """Reason not to grasp with a sensor whose forces are uncalibrated; empty for none."""
    if settings.force_calibration is not None:
        return ""
    return (
        f"the sensor's forces are {UNCALIBRATED.mark}; calibrate it: tacgrasp calibrate force, "
        "then name the file as hardware.sensor.force_calibration in the rig's file; or accept "
        "that with --allow-uncalibrated-force"
    )


def force_finding(settings: SensorUnitSettings, today: Today = datetime.date.today) -> Finding:
    """Check the force calibration for ``tacgrasp doctor``."""
    try:
        calibration = load_unit_force(settings, today)
    except TouchError as error:
        return finding("sensor", FORCE_CHECK, False, str(error), CALIBRATE)
    if calibration is None:
        detail = f"none: forces are {UNCALIBRATED.mark}"
        return finding("sensor", FORCE_CHECK, False, detail, CALIBRATE)
    return good_finding(calibration, today())


def good_finding(calibration: ForceCalibration, today: datetime.date) -> Finding:
    """The finding of a calibration that fits its unit."""
    detail = (
        f"{calibration.unit}, {calibration.age_days(today)} days old, factor "
        f"{calibration.factor:.3f} ± {calibration.spread:.1%} from {len(calibration.loads)} loads"
    )
    return finding("sensor", FORCE_CHECK, True, detail)
