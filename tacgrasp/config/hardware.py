"""The section of a rig's file that names its devices, a driver each, and the start of an episode.

Nothing in it is a flag: devices that are bolted to a bench are named in its file alone.
Not here: the settings of a driver (``tacgrasp.drivers``), the limits of a run
(``tacgrasp.config.schema``).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, SerializeAsAny, Tag, model_validator

from tacgrasp.base.errors import UsageError
from tacgrasp.base.settings import Number, RotationVector, SettingsBase, Vector
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.drivers.plugin import (
    PluginArmSettings,
    PluginGripperSettings,
    PluginSensorSettings,
    plugin_settings,
)
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.taxels.settings import TaxelSettings
from tacgrasp.drivers.ur.settings import UrSettings

OWN_KINDS = {
    "arm": ("ur",),
    "gripper": ("dynamixel",),
    "sensor": ("gelsight_mini", "taxels", "recorded"),
}
"""Kinds of our own drivers, which no plugin can take."""

PLUGIN = "plugin"
"""Tag of the settings of every plugin's device."""


def _kind_or(default: str | None, base: type[SettingsBase]) -> Callable[[Any], str | None]:
    """Function from a section to its driver: its ``kind``, ``default`` without one, or a plugin."""

    def kind(section: Any) -> str | None:
        if isinstance(section, base):
            return PLUGIN
        is_mapping = isinstance(section, dict)
        name = section.get("kind", default) if is_mapping else getattr(section, "kind", None)
        return name if isinstance(name, str) and name != PLUGIN else None

    return kind


ArmSettings = SerializeAsAny[
    Annotated[
        Annotated[UrSettings, Tag("ur")] | Annotated[PluginArmSettings, Tag(PLUGIN)],
        Discriminator(_kind_or("ur", PluginArmSettings)),
    ]
]
GripperSettings = SerializeAsAny[
    Annotated[
        Annotated[DynamixelSettings, Tag("dynamixel")]
        | Annotated[PluginGripperSettings, Tag(PLUGIN)],
        Discriminator(_kind_or("dynamixel", PluginGripperSettings)),
    ]
]
SensorSettings = SerializeAsAny[
    Annotated[
        Annotated[GelSightSettings, Tag("gelsight_mini")]
        | Annotated[TaxelSettings, Tag("taxels")]
        | Annotated[RecordedSettings, Tag("recorded")]
        | Annotated[PluginSensorSettings, Tag(PLUGIN)],
        Discriminator(_kind_or(None, PluginSensorSettings)),
    ]
]
"""One type for every arm, gripper and sensor with a driver, and for those of plugins."""


class StartConfig(SettingsBase):
    """Start pose of an episode, to which ``reset`` returns.

    Attributes:
        at: 'here': the arm's current pose; 'pose': the pose below, to which the arm moves slowly.
        position_m: Position of the TCP [m, base frame].
        rotvec_rad: Rotation vector of the TCP [rad].
        max_way_mm: Largest distance between the arm's current pose and the start pose [mm].
        max_turn_rad: Largest angle between the tool's current orientation and that of the start
            pose [rad].
        speed_m_s: Speed of the move to the start pose [m/s].
    """

    at: Literal["here", "pose"] = "here"
    position_m: Vector | None = None
    rotvec_rad: RotationVector | None = None
    max_way_mm: Number = Field(default=100.0, gt=0, le=1000)
    max_turn_rad: Number = Field(default=0.5, gt=0, le=3.1)
    speed_m_s: Number = Field(default=0.02, gt=0, le=0.1)

    @model_validator(mode="after")
    def _check_pose(self) -> StartConfig:
        is_set = [self.position_m is not None, self.rotvec_rad is not None]
        if self.at == "pose" and not all(is_set):
            raise ValueError("a start at a pose needs position_m and rotvec_rad")
        if self.at == "here" and any(is_set):
            raise ValueError("position_m and rotvec_rad are for a start at a pose (at: pose)")
        return self


class HardwareConfig(SettingsBase):
    """The devices of a rig.

    Attributes:
        arm: Arm of kind ur, or of a plugin's.
        gripper: Gripper of kind dynamixel, or of a plugin's.
        sensor: Sensor of kind gelsight_mini, taxels or recorded, or of a plugin's.
        start: Start pose of an episode.
    """

    arm: ArmSettings
    gripper: GripperSettings
    sensor: SensorSettings
    start: StartConfig = StartConfig()

    @model_validator(mode="before")
    @classmethod
    def _of_plugins(cls, data: Any) -> Any:
        """A section whose kind is a plugin's is checked by the plugin's own settings."""
        if not isinstance(data, dict):
            return data
        return data | {
            name: plugin_settings(f"{name}s", data[name], own)
            for name, own in OWN_KINDS.items()
            if name in data
        }

    @property
    def names_sensor(self) -> bool:
        """Whether the file names the sensor; an emulated taxel array else has the run's."""
        section = self.sensor
        return not isinstance(section, TaxelSettings) or "sensor" in section.model_fields_set

    @property
    def ur_arm(self) -> UrSettings:
        """The arm, for what works with a UR alone.

        Raises:
            UsageError: It is a plugin's.
        """
        if isinstance(self.arm, UrSettings):
            return self.arm
        raise UsageError(f"this works with an arm of kind ur alone, the rig's is {self.arm.kind}")

    @property
    def dynamixel_gripper(self) -> DynamixelSettings:
        """The gripper, for what works with Dynamixel servos alone.

        Raises:
            UsageError: It is a plugin's.
        """
        if isinstance(self.gripper, DynamixelSettings):
            return self.gripper
        raise UsageError(
            f"this works with a gripper of kind dynamixel alone, the rig's is {self.gripper.kind}"
        )

    def without_start_pose(self) -> HardwareConfig:
        """The same devices, but the arm does not move when it is connected.

        Jogging needs this: it brings the arm near its start pose in the first place.
        """
        return self.model_copy(update={"start": StartConfig()})


def with_workspace(fields: dict[str, Any]) -> dict[str, Any]:
    """Fields of a rig's file with its workspace copied to the arm's driver, when that has none."""
    limits, hardware = fields.get("arm"), fields.get("hardware")
    if not (isinstance(limits, dict) and isinstance(hardware, dict)):
        return fields
    driver = hardware.get("arm")
    if not isinstance(driver, dict):
        return fields
    box = {k: limits[k] for k in ("workspace_low_m", "workspace_high_m") if k in limits}
    return {**fields, "hardware": {**hardware, "arm": {**box, **driver}}}


def resolve_paths(section: SettingsBase, folder: Path) -> SettingsBase:
    """The same settings with relative paths resolved against ``folder``, that of the rig's file."""
    changes: dict[str, object] = {}
    for name in type(section).model_fields:
        value = getattr(section, name)
        if isinstance(value, SettingsBase):
            changes[name] = resolve_paths(value, folder)
        elif isinstance(value, Path) and not value.is_absolute():
            changes[name] = folder / value
    return section.model_copy(update=changes)
