"""Arm and gripper of a rig's file, connected or checked by their driver: our own or a plugin's.

Not here: what a rig does with them (``tacgrasp.rig.hardware``), the drivers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from cltp.errors import TouchError
from primitives.devices import Arm, Gripper, Pose
from primitives.errors import RobotError
from tacgrasp.config.hardware import ArmSettings, GripperSettings
from tacgrasp.drivers.check import Finding, finding, force_limit_finding
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.plugin import (
    PluginArmSettings,
    PluginGripperSettings,
    PluginSensorSettings,
    plugin_driver,
)
from tacgrasp.drivers.ur.settings import UrSettings

NOT_LOGGED = "not logged by the plugin"
"""What stands in a record for the message on the wire of a plugin's device."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectedArm:
    """A connected arm; ``sent`` returns its driver's last message on the wire."""

    arm: Arm
    sent: Callable[[], str]


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectedGripper:
    """A connected gripper.

    Attributes:
        gripper: The device.
        max_force_n: Largest force that it can be commanded [N]; 0 for one that only opens.
        force_step_n: Least change of the commanded force that it makes [N].
        check_alive: Returns why its readings are too old to move by; raises when it has failed.
        sent: Returns its driver's last message on the wire.
        transients: Returns its transient faults, for people.
    """

    gripper: Gripper
    max_force_n: float
    force_step_n: float
    check_alive: Callable[[], str]
    sent: Callable[[], str]
    transients: Callable[[], object]


def connect_arm_of(settings: ArmSettings) -> ConnectedArm:
    """Connect the arm of a rig's file.

    Raises:
        RobotError: It can't be reached or used.
    """
    if isinstance(settings, UrSettings):
        from tacgrasp.drivers.ur.arm import connect_arm

        arm = connect_arm(settings)
        return ConnectedArm(arm=arm, sent=lambda: arm.sent)
    return ConnectedArm(arm=connect_plugin("arms", settings), sent=lambda: NOT_LOGGED)


def connect_gripper_of(settings: GripperSettings, *, must_grip: bool = True) -> ConnectedGripper:
    """Connect the gripper of a rig's file.

    Args:
        settings: The gripper's section of the rig's file.
        must_grip: Whether a calibration that does not fit is an error; otherwise it is a warning,
            and the gripper only opens.

    Raises:
        RobotError: It can't be reached or used.
    """
    if isinstance(settings, DynamixelSettings):
        from tacgrasp.drivers.dynamixel.gripper import connect_gripper

        gripper = connect_gripper(settings, must_grip=must_grip)
        return ConnectedGripper(
            gripper=gripper,
            max_force_n=gripper.max_force_n,
            force_step_n=gripper.force_step_n,
            check_alive=gripper.check_alive,
            sent=lambda: gripper.sent,
            transients=lambda: gripper.transients,
        )
    device = connect_plugin("grippers", settings)
    return ConnectedGripper(
        gripper=device,
        max_force_n=settings.max_force_n,
        force_step_n=settings.force_step_n,
        check_alive=device.check_alive,
        sent=lambda: NOT_LOGGED,
        transients=lambda: "not counted by the plugin",
    )


def arm_findings(settings: ArmSettings, way_problem: Callable[[Pose], str]) -> Sequence[Finding]:
    """Check the arm for ``tacgrasp doctor``.

    Args:
        settings: The arm's section of the rig's file.
        way_problem: Why the arm may not go to its start by itself from a pose; empty where it may.
    """
    if isinstance(settings, UrSettings):
        from tacgrasp.drivers.ur import preflight

        return preflight.check(settings, way_problem)
    return check_plugin("arms", settings)


def gripper_findings(
    settings: GripperSettings, first_force_n: float | None, max_force_n: float
) -> Sequence[Finding]:
    """Check the gripper for ``tacgrasp doctor``.

    Args:
        settings: The gripper's section of the rig's file.
        first_force_n: The rig's ``gripper.first_force_n`` [N]; None is not checked.
        max_force_n: The rig's ``gripper.max_force_n`` [N].
    """
    if isinstance(settings, DynamixelSettings):
        from tacgrasp.drivers.dynamixel import gripper

        return gripper.check(settings, first_force_n=first_force_n, max_force_n=max_force_n)
    force = force_limit_finding(max_force_n, settings.max_force_n)
    return [*check_plugin("grippers", settings), force]


PluginSettings = PluginArmSettings | PluginGripperSettings | PluginSensorSettings


def connect_plugin(group: str, settings: PluginSettings) -> Any:
    """Connect a plugin's device; its own protocol is that of its group.

    Raises:
        RobotError: It can't be reached, or its code is broken.
        TouchError: Likewise, of a sensor.
    """
    try:
        return plugin_driver(group, settings.kind).connect(settings)
    except (RobotError, TouchError):
        raise
    except (Exception, SystemExit) as error:  # of foreign code: nothing has moved yet
        raise RobotError(
            f"the plugin's driver {settings.kind} (tacgrasp.{group}) failed to connect: "
            f"{type(error).__name__}: {error}; mend the plugin, or name another kind in the rig's "
            "file"
        ) from error


def check_plugin(group: str, settings: PluginSettings) -> Sequence[Finding]:
    """Check a plugin's device for ``tacgrasp doctor``."""
    device = group.removesuffix("s")
    try:
        return plugin_driver(group, settings.kind).check(settings)
    except (Exception, SystemExit) as error:  # of foreign code: a check that raises has failed
        detail = f"{type(error).__name__}: {error}"
        advice = f"mend the plugin's check of {settings.kind}"
        return [finding(device, "plugin", False, " ".join(detail.split()), advice)]
