"""The part of a rig's file that names its devices: a driver each, and where an episode starts.

Not here: the settings of a driver (``tacgrasp.drivers``), the limits of a run
(``tacgrasp.config.schema``). Nothing of it is a flag: what is bolted to a bench is written in its
file.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from tacgrasp.base.settings import Number, Section, Vector
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.taxels.settings import TaxelSettings
from tacgrasp.drivers.ur.settings import UrSettings

SensorSettings = Annotated[
    GelSightSettings | TaxelSettings | RecordedSettings, Field(discriminator="kind")
]
"""One line for every sensor that there is a driver for."""


class StartConfig(Section):
    """Where an episode starts, and ``reset`` returns to.

    Attributes:
        at: 'here': where the arm stands; 'pose': the pose below, which the arm goes to slowly.
        position_m: Of the TCP [m, base frame].
        rotvec_rad: Rotation vector of the TCP [rad].
        max_way_mm: Farthest that the arm may stand from the pose [mm].
        speed_m_s: Of the way to it [m/s].
    """

    at: Literal["here", "pose"] = "here"
    position_m: Vector | None = None
    rotvec_rad: Vector | None = None
    max_way_mm: Number = Field(default=100.0, gt=0, le=1000)
    speed_m_s: Number = Field(default=0.02, gt=0, le=0.1)

    @model_validator(mode="after")
    def _pose_is_given_when_it_is_used(self) -> StartConfig:
        given = [self.position_m is not None, self.rotvec_rad is not None]
        if self.at == "pose" and not all(given):
            raise ValueError("a start at a pose needs position_m and rotvec_rad")
        if self.at == "here" and any(given):
            raise ValueError("position_m and rotvec_rad are for a start at a pose (at: pose)")
        return self


class HardwareConfig(Section):
    """The devices of a rig.

    Attributes:
        arm: Of kind ur.
        gripper: Of Dynamixel servos.
        sensor: Of kind gelsight_mini, taxels or recorded.
        start: Where an episode starts.
    """

    arm: UrSettings
    gripper: DynamixelSettings
    sensor: SensorSettings
    start: StartConfig = StartConfig()

    @property
    def felt_by(self) -> str:
        """Name of the sensor whose field and units the driver's clouds are in."""
        sensor = self.sensor
        return "gelsight_mini" if isinstance(sensor, GelSightSettings) else sensor.sensor

    @property
    def feels(self) -> bool:
        """Whether the sensor feels what the fingers do; a recording never does."""
        sensor = self.sensor
        if isinstance(sensor, GelSightSettings):
            return sensor.is_camera
        return not isinstance(sensor, RecordedSettings)

    def where_it_stands(self) -> HardwareConfig:
        """The same devices, but the arm stays where it is when it is connected.

        For whoever moves it by hand: jogging is how it is brought near its start pose.
        """
        return self.model_copy(update={"start": StartConfig()})


def with_box(fields: dict[str, Any]) -> dict[str, Any]:
    """A rig file's fields with its workspace given to the arm's driver, when that has none."""
    limits, hardware = fields.get("arm"), fields.get("hardware")
    if not (isinstance(limits, dict) and isinstance(hardware, dict)):
        return fields
    driver = hardware.get("arm")
    if not isinstance(driver, dict):
        return fields
    box = {k: limits[k] for k in ("workspace_low_m", "workspace_high_m") if k in limits}
    return {**fields, "hardware": {**hardware, "arm": {**box, **driver}}}


def beside(section: Section, folder: Path) -> Section:
    """The same settings with relative paths taken from ``folder``, where the rig's file lies."""
    changes: dict[str, object] = {}
    for name in type(section).model_fields:
        value = getattr(section, name)
        if isinstance(value, Section):
            changes[name] = beside(value, folder)
        elif isinstance(value, Path) and not value.is_absolute():
            changes[name] = folder / value
    return section.model_copy(update=changes)
