"""A rig of real drivers: connects what the rig's file names, each device checked before it moves.

The same drivers run on emulators (``tacgrasp.rig.emulated``). Not here: the drivers.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp
from primitives.devices import Arm, Gripper, Pose
from primitives.errors import LimitError, RobotError
from primitives.limits import check_workspace, distance_mm
from tacgrasp.config.hardware import HardwareConfig, SensorSettings, StartConfig
from tacgrasp.config.schema import RunConfig
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.stamps import real_stamp
from tacgrasp.episodes.command_log import CommandLog, LoggedArm, LoggedGripper
from tacgrasp.rig.guard import GuardedArm
from tacgrasp.rig.protocols import WatchedSensor

if TYPE_CHECKING:
    from tacgrasp.drivers.dynamixel.gripper import DynamixelGripper

NEAR_MM = 0.5
"""An arm this near to its start pose is there."""


class RealClock:
    """Time as it passes."""

    def monotonic(self) -> float:
        """Monotonic clock [s]."""
        return time.monotonic()

    def wall(self) -> float:
        """Wall clock [s since the epoch], metadata only."""
        return time.time()

    def sleep(self, seconds: float) -> None:
        """Wait [s]."""
        time.sleep(seconds)

    def stamp(self) -> Stamp:
        """Both clocks, now."""
        return real_stamp()


@dataclass(frozen=True, slots=True, kw_only=True)
class HardwareRig:
    """The devices of one episode; a ``tacgrasp.rig.factory.Rig``.

    Attributes:
        arm: Guarded: stopped in mid-move when gripper or sensor fail.
        gripper, sensor, clock: The others.
        commands: What arm and gripper were given.
        start_pose: Where the first grasp is made.
        first_force_n: Commanded force of the first grasp [N].
        survived: Tells the passing faults that gripper and sensor have survived, in words.
    """

    arm: Arm
    gripper: Gripper
    sensor: WatchedSensor
    clock: RealClock
    commands: CommandLog
    start_pose: Pose
    first_force_n: float
    survived: Callable[[], str]

    def expect_untouched(self) -> None:
        """Compare a camera's gel with its background; the gripper has to be open.

        Raises:
            RobotError: The gel is touched or dirty, or its background is stale.
        """
        look: Callable[[], None] | None = getattr(self.sensor, "expect_untouched", None)
        if look is None:
            return
        try:
            look()
        except TouchError as error:
            raise RobotError(
                f"{error}; if the fingers hold something, open them: tacgrasp jog (key o)"
            ) from None

    def disconnect(self) -> None:
        """Free every device, the arm first. Idempotent, never raises."""
        for device in (self.arm, self.gripper, self.sensor):
            device.disconnect()


def connect(config: RunConfig, hardware: HardwareConfig, first_force_n: float) -> HardwareRig:
    """Connect sensor, gripper and arm; then the arm goes to its start, unless nothing may move.

    Raises:
        RobotError: A device can't be had or is not as it must be; nothing has moved. Or the way to
            the start pose failed.
    """
    from tacgrasp.drivers.dynamixel.gripper import connect_gripper
    from tacgrasp.drivers.ur.arm import connect_arm

    log = CommandLog(time.monotonic)
    with ExitStack() as stack:
        try:
            sensor = connect_sensor(hardware.sensor, config)
        except TouchError as error:  # before an episode it is the rig that can't be had
            raise RobotError(str(error)) from None
        stack.callback(sensor.disconnect)
        gripper = connect_gripper(hardware.gripper)
        stack.callback(gripper.disconnect)
        gripper.hurry_while(lambda: False)  # no arm moves yet: a busy computer is no fault
        _check_forces(config, gripper.max_force_n)
        arm = connect_arm(hardware.arm)
        stack.callback(arm.disconnect)
        guarded = GuardedArm(arm, [lambda: _look_at(gripper), sensor.check_alive])
        stack.callback(guarded.disconnect)
        gripper.hurry_while(guarded.moves)
        logged = LoggedArm(guarded, log, lambda: arm.sent)
        start = _go_to_start(logged, hardware.start, config)
        stack.pop_all()
    return HardwareRig(
        arm=logged,
        gripper=LoggedGripper(gripper, log, lambda: gripper.sent),
        sensor=sensor,
        clock=RealClock(),
        commands=log,
        start_pose=start,
        first_force_n=first_force_n,
        survived=lambda: f"gripper: {gripper.transients}; sensor: {_counts(sensor)}",
    )


def _counts(sensor: WatchedSensor) -> str:
    counts = getattr(sensor, "counts", None)  # a recording has none
    return "nothing counted" if counts is None else str(counts())


def connect_sensor(settings: SensorSettings, config: RunConfig) -> WatchedSensor:
    """The sensor of this kind; points are drawn as on the simulated sensor of the same seed.

    Raises:
        TouchError: It can't be had.
    """
    rng = np.random.default_rng([config.seed, 2])
    if isinstance(settings, GelSightSettings):
        from tacgrasp.drivers.gelsight.connect import connect_gelsight

        return connect_gelsight(settings, rng=rng)
    if isinstance(settings, RecordedSettings):
        from tacgrasp.drivers.recorded.sensor import connect_recorded

        return connect_recorded(settings)
    from tacgrasp.drivers.taxels.connect import connect_taxels

    return connect_taxels(settings, rng=rng)


def _look_at(gripper: DynamixelGripper) -> None:
    if gripper.fault:
        raise RobotError(gripper.fault)


def _check_forces(config: RunConfig, device_n: float) -> None:
    """Refuse limits that the gripper can't keep, before anything has moved."""
    if config.gripper.max_force_n > device_n:
        raise LimitError(
            f"gripper.max_force_n {config.gripper.max_force_n:g} N is beyond this gripper, whose "
            f"calibration and current allow {device_n:.2f} N; lower it in the rig's file"
        )


def _go_to_start(arm: Arm, start: StartConfig, config: RunConfig) -> Pose:
    """Where the episode starts; the arm goes there when it is a pose, unless in a dry run.

    Raises:
        LimitError: The pose is outside the workspace; nothing has moved.
        RobotError: The arm stands too far off (nothing has moved), or failed on the way.
    """
    here = arm.pose()
    if start.position_m is None or start.rotvec_rad is None:
        return here
    pose = Pose(position_m=np.array(start.position_m), rotvec_rad=np.array(start.rotvec_rad))
    check_workspace(pose, config.limits())
    way_mm = distance_mm(here, pose)
    if way_mm > start.max_way_mm:
        raise RobotError(
            f"the arm stands {way_mm:.0f} mm from its start pose, more than the "
            f"{start.max_way_mm:g} mm that it may go by itself (hardware.start.max_way_mm); bring "
            "it nearer with tacgrasp jog or at the pendant"
        )
    if config.dry_run or way_mm <= NEAR_MM:
        return pose
    arm.move_to(pose, speed_m_s=start.speed_m_s)
    return pose
