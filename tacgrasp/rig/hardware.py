"""A rig of real drivers: connects the devices of the rig's file and checks each before it moves.

The same drivers run on emulators (``tacgrasp.rig.emulated``). Not here: the drivers.
"""

from __future__ import annotations

import datetime
import logging
import math
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp
from primitives.devices import Arm, Gripper, Pose
from primitives.errors import LimitError, RobotError
from primitives.limits import check_workspace, distance_mm
from tacgrasp.config.hardware import HardwareConfig, SensorSettings, StartConfig
from tacgrasp.config.schema import RunConfig
from tacgrasp.drivers.check import Finding, finding, force_limit_problem
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.force_scale import force_finding
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.drivers.opening import BY_JOG, check_open
from tacgrasp.drivers.plugin import PluginSensorSettings
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.scheduling import ADVICE, granted, lateness_s, request_nice
from tacgrasp.drivers.stamps import real_stamp
from tacgrasp.drivers.ur.motion_limits import turn_between_rad
from tacgrasp.episodes.command_log import Command, CommandLog, LoggedArm, LoggedGripper
from tacgrasp.rig.driver_choice import (
    arm_findings,
    check_plugin,
    connect_arm_of,
    connect_gripper_of,
    connect_plugin,
    gripper_findings,
)
from tacgrasp.rig.gel_sense import prepare
from tacgrasp.rig.guard import GuardedArm
from tacgrasp.rig.protocols import WatchedSensor

if TYPE_CHECKING:
    from sim.grasp.rig import Truth

_SensorDriver = tuple[Callable[..., WatchedSensor], Callable[[], Sequence[Finding]]]

log = logging.getLogger(__name__)

AT_START_MM = 0.5
"""Largest distance from the start pose at which the arm needs no move to it [mm]."""

AT_START_RAD = 0.01
"""Largest turn from it at which the arm needs none [rad]."""


class RealClock:
    """This computer's clocks; a ``tacgrasp.rig.protocols.Clock``."""

    def monotonic(self) -> float:
        return time.monotonic()

    def wall(self) -> float:
        return time.time()

    def sleep(self, seconds: float) -> None:
        time.sleep(seconds)

    def stamp(self) -> Stamp:
        return real_stamp()


@dataclass(frozen=True, slots=True, kw_only=True)
class HardwareRig:
    """The devices of one episode; a ``tacgrasp.rig.protocols.Rig``.

    Attributes:
        arm: Guarded arm, which is stopped in mid-move when gripper or sensor fail.
        gripper, sensor, clock: The other devices.
        command_log: Log of the commands to arm and gripper.
        start_pose: Pose of the first grasp.
        first_force_n: Largest commanded force of a first grasp until something is felt [N].
        force_step_n: Least change of the commanded force that the gripper makes [N].
        fault_counts: Returns the counts of the transient faults of gripper and sensor, and of the
            arm's holds, as text.
        guard: Holds the arm while readings are stale; None in tests without one.
    """

    arm: Arm
    gripper: Gripper
    sensor: WatchedSensor
    clock: RealClock
    command_log: CommandLog
    start_pose: Pose
    first_force_n: float
    fault_counts: Callable[[], str]
    force_step_n: float = 0.0
    guard: GuardedArm | None = None

    def expect_untouched(self) -> None:
        check_open(self.gripper)
        try:
            self.sensor.expect_untouched()
        except TouchError as error:
            raise RobotError(
                f"{error}; if the fingers hold something, open them: {BY_JOG}"
            ) from None

    def commands(self) -> tuple[Command, ...]:
        return self.command_log.take()

    def truth(self) -> Truth | None:
        return None

    def disconnect(self) -> None:
        """Free every device, the arm first. Idempotent, never raises."""
        for device in (self.arm, self.gripper, self.sensor):
            device.disconnect()


def connect(
    config: RunConfig, hardware: HardwareConfig, first_force_n: float, *, must_grip: bool = True
) -> HardwareRig:
    """Connect sensor, gripper and arm, then move the arm to its start, except in a dry run.

    An arm goes to its start pose with an open gripper alone.

    Args:
        config: The configuration.
        hardware: Its devices.
        first_force_n: Largest commanded force of a first grasp until something is felt [N].
        must_grip: Whether the gripper needs a calibration that fits; without one it only opens.

    Raises:
        RobotError: A device can't be reached or is in a wrong state, and nothing has moved; or the
            move to the start pose failed.
    """
    rights = granted()
    if rights.problem:
        log.warning("this computer may be late: %s (%s)", rights.problem, rights)
    request_nice()
    commands = CommandLog(time.monotonic)
    with ExitStack() as stack:
        try:
            sensor = connect_sensor(hardware.sensor)
        except (
            TouchError
        ) as error:  # before an episode begins, a rig without its sensor is unusable
            raise RobotError(str(error)) from None
        stack.callback(sensor.disconnect)
        if hardware.sensor.is_live:  # the first cloud of a recording is the episode's
            prepare(sensor)
        gripper = connect_gripper_of(hardware.gripper, must_grip=must_grip)
        stack.callback(gripper.gripper.disconnect)
        if hardware.start.at == "pose" and not config.dry_run:
            check_open(gripper.gripper)
        if gripper.max_force_n > 0:
            _check_forces(config, gripper.max_force_n)
        arm = connect_arm_of(hardware.arm)
        stack.callback(arm.arm.disconnect)
        guarded = GuardedArm(arm.arm, [gripper.check_alive, sensor.check_alive])
        stack.callback(guarded.disconnect)
        logged = LoggedArm(guarded, commands, arm.sent)
        start = _go_to_start(logged, hardware.start, config)
        stack.pop_all()
    return HardwareRig(
        arm=logged,
        gripper=LoggedGripper(gripper.gripper, commands, gripper.sent),
        sensor=sensor,
        clock=RealClock(),
        command_log=commands,
        start_pose=start,
        first_force_n=first_force_n,
        force_step_n=gripper.force_step_n,
        fault_counts=lambda: (
            f"gripper: {gripper.transients()}; sensor: {sensor.counts()}; arm: held "
            f"{guarded.num_holds} times"
        ),
        guard=guarded,
    )


def check_files(hardware: HardwareConfig) -> None:
    """Read every file that the rig's file names, before anything heavy is loaded.

    Raises:
        RobotError: One is missing, damaged, of another unit or too old; the message names the
            command that makes it anew.
    """
    from tacgrasp.drivers.dynamixel.calibration import load_calibration
    from tacgrasp.drivers.force_scale import load_unit_force

    if isinstance(hardware.gripper, DynamixelSettings):
        load_calibration(hardware.gripper.calibration)
    try:
        if isinstance(hardware.sensor, GelSightSettings):
            from tacgrasp.drivers.gelsight.connect import load_unit_files

            load_unit_files(hardware.sensor, datetime.datetime.now(datetime.UTC))
        load_unit_force(hardware.sensor)
    except TouchError as error:
        raise RobotError(str(error)) from None


def connect_sensor(settings: SensorSettings) -> WatchedSensor:
    """Connect a sensor.

    Raises:
        TouchError: The sensor can't be reached or used.
    """
    connect_driver, _ = _sensor_driver(settings)
    return connect_driver()


def device_findings(
    hardware: HardwareConfig, first_force_n: float | None, max_force_n: float
) -> list[Finding]:
    """Check arm, gripper and sensor for ``tacgrasp doctor``; nothing moves.

    Args:
        hardware: The devices.
        first_force_n: The rig's ``gripper.first_force_n`` [N]; None is not checked.
        max_force_n: The rig's ``gripper.max_force_n`` [N].
    """
    _, check_sensor = _sensor_driver(hardware.sensor.without_force())  # a finding of its own
    arm = arm_findings(hardware.arm, partial(_way_problem, hardware.start))
    gripper = gripper_findings(hardware.gripper, first_force_n, max_force_n)
    of_touch = force_finding(hardware.sensor) if hardware.sensor.is_live else _PLAYS
    return [_computer(), *arm, *gripper, *check_sensor(), of_touch]


_PLAYS = finding(
    "sensor",
    "touch",
    False,
    "plays a recording: nothing is felt",
    "a run is refused, one with --dry-run is not; name a sensor that feels in the rig's file",
)


def _computer() -> Finding:
    """What the operating system grants the drivers' threads."""
    rights = granted()
    detail = f"{rights}, wakes up at most {1e3 * lateness_s():.1f} ms late"
    detail += f": {rights.problem}" if rights.problem else ""
    return finding("computer", "priority and cores", not rights.problem, detail, ADVICE)


def _sensor_driver(settings: SensorSettings) -> _SensorDriver:
    """Functions that connect and check a sensor; each driver of a sensor has its lines here."""
    if isinstance(settings, GelSightSettings):
        from tacgrasp.drivers.gelsight import connect as gelsight

        return partial(gelsight.connect_gelsight, settings), partial(gelsight.check, settings)
    if isinstance(settings, RecordedSettings):
        from tacgrasp.drivers.recorded import sensor as recorded

        return partial(recorded.connect_recorded, settings), partial(recorded.check, settings)
    if isinstance(settings, PluginSensorSettings):
        connect, check = partial(connect_plugin, "sensors"), partial(check_plugin, "sensors")
        return partial(connect, settings), partial(check, settings)
    from tacgrasp.drivers.taxels import connect as taxels

    return partial(taxels.connect_taxels, settings), partial(taxels.check, settings)


def _check_forces(config: RunConfig, device_n: float) -> None:
    """Refuse force limits beyond the gripper's own, before anything has moved."""
    if problem := force_limit_problem(config.gripper.max_force_n, device_n):
        raise LimitError(problem)


def start_pose(start: StartConfig) -> Pose | None:
    """The configured start pose; None where an episode starts at the arm's present one."""
    if start.position_m is None or start.rotvec_rad is None:
        return None
    return Pose(position_m=np.array(start.position_m), rotvec_rad=np.array(start.rotvec_rad))


def _turned_rad(a: Pose, b: Pose) -> float:
    return turn_between_rad(a.rotvec_rad.tolist(), b.rotvec_rad.tolist())


def _way_problem(start: StartConfig, current: Pose) -> str:
    """Why the arm may not go from a pose to its start by itself; empty where it may."""
    pose = start_pose(start)
    if pose is None:
        return ""
    if (turned_rad := _turned_rad(current, pose)) > start.max_turn_rad:
        now = ", ".join(f"{value:.3f}" for value in current.rotvec_rad)
        return (
            f"the tool is turned by {turned_rad:.2f} rad ({math.degrees(turned_rad):.0f}°) from "
            f"its start pose, more than the {start.max_turn_rad:g} rad that it may turn by itself "
            "(hardware.start.max_turn_rad); turn it at the pendant, or, if it stands as it should, "
            f"set hardware.start.rotvec_rad to [{now}]"
        )
    if (offset_mm := distance_mm(current, pose)) <= start.max_way_mm:
        return ""
    return (
        f"the arm stands {offset_mm:.0f} mm from its start pose, more than the "
        f"{start.max_way_mm:g} mm that it may go by itself (hardware.start.max_way_mm); bring "
        "it nearer with tacgrasp jog or at the pendant"
    )


def _go_to_start(arm: Arm, start: StartConfig, config: RunConfig) -> Pose:
    """Move the arm to a configured start pose, except in a dry run; return the start pose.

    Raises:
        LimitError: The pose is outside the workspace; nothing has moved.
        RobotError: The arm is too far away (nothing has moved), or its move failed.
    """
    current, pose = arm.pose(), start_pose(start)
    if pose is None:
        return current
    check_workspace(pose, config.limits())
    if problem := _way_problem(start, current):
        raise RobotError(problem)
    is_there = distance_mm(current, pose) <= AT_START_MM
    if config.dry_run or (is_there and _turned_rad(current, pose) <= AT_START_RAD):
        return pose
    arm.move_to(pose, speed_m_s=start.speed_m_s)
    return pose
