"""Drivers that plugins add: base classes of their settings, and what their entry points give.

Not here: finding and loading them (``tacgrasp.base.plugins``), the protocols of the devices
(``primitives.devices``, ``tacgrasp.rig.protocols``).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

from pydantic import Field, ValidationError

from tacgrasp.base.plugins import load_plugin, plugins
from tacgrasp.base.settings import Number, SettingsBase, Vector
from tacgrasp.drivers.check import Finding
from tacgrasp.drivers.force_scale import SensorUnitSettings

S = TypeVar("S", bound=SettingsBase)


class PluginArmSettings(SettingsBase):
    """Settings of a plugin's arm: the section ``hardware.arm`` of a rig's file; to be subclassed.

    Attributes:
        kind: Name of the driver, that of the entry point.
        workspace_low_m: Lower corner of the box that the TCP must stay in [m, base frame].
        workspace_high_m: Upper corner of the box [m, base frame].
        max_speed_m_s: Largest speed of a move [m/s].
        max_acceleration_m_s2: Largest acceleration of a move [m/s²].
    """

    kind: str
    workspace_low_m: Vector
    workspace_high_m: Vector
    max_speed_m_s: Number = Field(default=0.4, gt=0, le=1)
    max_acceleration_m_s2: Number = Field(default=10.0, gt=0, le=15)


class PluginGripperSettings(SettingsBase):
    """Settings of a plugin's gripper: the section ``hardware.gripper``; to be subclassed.

    Attributes:
        kind: Name of the driver, that of the entry point.
        max_force_n: Largest commanded force of the device [N].
        force_step_n: Least change of the commanded force that it makes [N]; 0 for any.
    """

    kind: str
    max_force_n: Number = Field(gt=0, le=200)
    force_step_n: Number = Field(default=0.0, ge=0, le=10)


class PluginSensorSettings(SensorUnitSettings):
    """Settings of a plugin's sensor: the section ``hardware.sensor``; to be subclassed.

    Attributes:
        kind: Name of the driver, that of the entry point.
        sensor: Type of its clouds (``cltp.tactile.sensors``).
        read_timeout_s: Longest wait for a frame captured after the call [s].
        is_live: Whether it feels what is there now; False for a recording.
    """

    is_live: ClassVar[bool] = True
    kind: str
    sensor: str = "gelsight_mini"
    read_timeout_s: Number = Field(default=0.5, ge=0.05, le=5)

    @property
    def sensor_name(self) -> str:
        return self.sensor


@dataclass(frozen=True, slots=True, kw_only=True)
class DeviceDriver:
    """What an entry point of ``tacgrasp.sensors``, ``arms`` or ``grippers`` gives.

    Attributes:
        settings: Settings of the device, a subclass of the base class of its group.
        connect: Connects the device that the settings name. An arm is a
            ``primitives.devices.Arm``; a gripper a ``Gripper`` with ``check_alive``; a sensor a
            ``tacgrasp.rig.protocols.WatchedSensor``. Raises ``RobotError`` (a sensor
            ``TouchError``).
        check: Checks the device for ``tacgrasp doctor``; moves nothing and never raises.
    """

    settings: type[SettingsBase]
    connect: Callable[[Any], Any]
    check: Callable[[Any], Sequence[Finding]]


BASES: Mapping[str, type[SettingsBase]] = {
    "arms": PluginArmSettings,
    "grippers": PluginGripperSettings,
    "sensors": PluginSensorSettings,
}
"""Base class of the settings of each group of drivers."""


def driver_refusal(group: str) -> Callable[[object], str]:
    """The check of what an entry point of a group of drivers gives."""

    def refusal(added: object) -> str:
        base = BASES[group]
        if not isinstance(added, DeviceDriver):
            return f"expected a tacgrasp.drivers.plugin.DeviceDriver, got {added!r:.80}"
        if not (isinstance(added.settings, type) and issubclass(added.settings, base)):
            return f"expected settings derived from {base.__name__}, got {added.settings!r:.80}"
        return ""

    return refusal


def plugin_driver(group: str, kind: str) -> DeviceDriver:
    """The driver of a plugin.

    Raises:
        UsageError: The plugin is broken; the message names it.
    """
    added = load_plugin(group, kind, driver_refusal(group))
    assert isinstance(added, DeviceDriver)  # the check has refused everything else
    return added


def plugin_settings(group: str, section: object, own: Collection[str]) -> object:
    """A section of a rig's file as the settings of the plugin that its ``kind`` names.

    Anything else is returned as it is.

    Args:
        group: Group of drivers.
        section: The section as it was read.
        own: Kinds of tacgrasp's own, which no plugin takes.

    Raises:
        ValueError: A field that the plugin's settings refuse; the message names it.
        UsageError: The plugin is broken.
    """
    kind = section.get("kind") if isinstance(section, dict) else None
    if not isinstance(kind, str) or kind in own or kind not in plugins(group):
        return section
    settings = plugin_driver(group, kind).settings
    try:
        return settings.model_validate(section)
    except ValidationError as error:
        first = error.errors()[0]
    name = ".".join([group.removesuffix("s"), *map(str, first["loc"])])
    known = ", ".join(settings.model_fields)
    if first["type"] == "missing":
        raise ValueError(f"{name} is missing; fields of kind {kind}: {known}")
    if first["type"] == "extra_forbidden":
        raise ValueError(f"unknown field {name}; known here: {known}")
    raise ValueError(f"{name}: {first['msg']}, got {first['input']!r:.80}")
