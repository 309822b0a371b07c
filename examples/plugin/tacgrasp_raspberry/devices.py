"""Drivers of an arm, a gripper and a sensor: settings, connection, check, and the device."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np
from pydantic import Field

from cltp import TouchError
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.sensors import SensorSpec
from primitives import LimitError
from primitives.devices import GripperState, Pose
from tacgrasp.drivers.check import Finding, finding
from tacgrasp.drivers.force_scale import force_scale_of
from tacgrasp.drivers.plugin import (
    DeviceDriver,
    PluginArmSettings,
    PluginGripperSettings,
    PluginSensorSettings,
)
from tacgrasp_raspberry import sdk


class ArmSettings(PluginArmSettings):
    """The section ``hardware.arm``; ``bench`` is the name of the bench."""

    kind: Literal["raspberry_arm"] = "raspberry_arm"
    bench: str = Field(min_length=1)
    seed: int = Field(default=1, ge=0)


class GripperSettings(PluginGripperSettings):
    """The section ``hardware.gripper``."""

    kind: Literal["raspberry_gripper"] = "raspberry_gripper"
    bench: str = Field(min_length=1)
    seed: int = Field(default=1, ge=0)


class SensorSettings(PluginSensorSettings):
    """The section ``hardware.sensor``."""

    kind: Literal["raspberry_pad"] = "raspberry_pad"
    bench: str = Field(min_length=1)
    seed: int = Field(default=1, ge=0)


class BenchArm:
    """A ``primitives.devices.Arm``."""

    def __init__(self, settings: ArmSettings) -> None:
        self._settings, self._is_connected = settings, True
        self._arm = sdk.join(settings.bench, settings.seed).arm

    def pose(self) -> Pose:
        return self._arm.pose()

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        low, high = self._settings.workspace_low_m, self._settings.workspace_high_m
        if (pose.position_m < low).any() or (pose.position_m > high).any():
            raise LimitError(f"{np.round(pose.position_m, 4)} m is outside of {low} to {high} m")
        if speed_m_s > self._settings.max_speed_m_s:
            raise LimitError(f"{speed_m_s} m/s is above {self._settings.max_speed_m_s} m/s")
        return self._arm.move_to(pose, speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2)

    def stop(self) -> None:
        self._arm.stop()

    def disconnect(self) -> None:
        if self._is_connected:
            sdk.leave(self._settings.bench)
        self._is_connected = False


class BenchGripper:
    """A ``primitives.devices.Gripper`` that can be checked while the arm moves."""

    def __init__(self, settings: GripperSettings) -> None:
        self._settings, self._is_connected = settings, True
        self._gripper = sdk.join(settings.bench, settings.seed).gripper

    def state(self) -> GripperState:
        return self._gripper.state()

    def grip(self, force_n: float) -> GripperState:
        if not 0 < force_n <= self._settings.max_force_n:
            raise LimitError(f"{force_n} N is not in 0 to {self._settings.max_force_n} N")
        return self._gripper.grip(force_n)

    def open_by(self, clear_m: float) -> GripperState:
        return self._gripper.open_by(clear_m)

    def check_alive(self) -> str:
        """Why its readings are too old to move by; never here."""
        return ""

    def stop(self) -> None:
        self._gripper.stop()

    def disconnect(self) -> None:
        if self._is_connected:
            sdk.leave(self._settings.bench)
        self._is_connected = False


class BenchSensor:
    """A ``tacgrasp.rig.protocols.WatchedSensor``."""

    def __init__(self, settings: SensorSettings) -> None:
        self._scale = force_scale_of(settings)  # refuses a calibration that does not fit
        self._settings, self._is_connected = settings, True
        self._sensor = sdk.join(settings.bench, settings.seed).sensor

    @property
    def spec(self) -> SensorSpec:
        return self._sensor.spec

    def read(self, frames: int = 1) -> TactileCloud:
        self._check_connected()
        return replace(self._sensor.read(frames), force_scale=self._scale)

    def take_reference(self) -> None:
        self._check_connected()
        self._sensor.take_reference()

    def check_alive(self) -> str:
        self._check_connected()
        return ""

    def expect_untouched(self) -> None:
        """It has no background to compare the gel with."""

    def counts(self) -> None:
        """Nothing is counted."""

    def disconnect(self) -> None:
        if self._is_connected:
            sdk.leave(self._settings.bench)
        self._is_connected = False

    def _check_connected(self) -> None:
        if not self._is_connected:
            raise TouchError("the pad is disconnected")


def _arm_check(settings: ArmSettings) -> Sequence[Finding]:
    return [finding("arm", "bench", True, f"{settings.bench} answers")]


def _gripper_check(settings: GripperSettings) -> Sequence[Finding]:
    detail = f"{settings.bench} answers, up to {settings.max_force_n:g} N"
    return [finding("gripper", "bench", True, detail)]


def _sensor_check(settings: SensorSettings) -> Sequence[Finding]:
    return [finding("sensor", "bench", True, f"{settings.bench} answers, {settings.sensor}")]


ARM = DeviceDriver(settings=ArmSettings, connect=BenchArm, check=_arm_check)
GRIPPER = DeviceDriver(settings=GripperSettings, connect=BenchGripper, check=_gripper_check)
SENSOR = DeviceDriver(settings=SensorSettings, connect=BenchSensor, check=_sensor_check)
