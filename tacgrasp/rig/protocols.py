"""What a run needs of a rig: its tactile sensor, its clock, and the rig as a whole.

The contracts of arm and gripper are in ``primitives.devices``.
"""

from __future__ import annotations

from typing import Protocol

from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.sensors import SensorSpec
from primitives.devices import Arm, Gripper, Pose


class TactileSensor(Protocol):
    """A sensor that gives clouds. Implementations: ``sim.grasp.rig.SimSensor``, the drivers."""

    @property
    def spec(self) -> SensorSpec:
        """Which sensor this is."""
        ...

    def read(self) -> TactileCloud:
        """Capture the gel now.

        The cloud is newer than the call, has 1024 stratified points and carries both clocks.

        Raises:
            TouchError: No fresh frame could be had; never answers with an old one.
        """
        ...

    def disconnect(self) -> None:
        """Free the device. Idempotent, never raises."""
        ...


class WatchedSensor(TactileSensor, Protocol):
    """A sensor that can be looked at while the arm moves, without waiting for a frame."""

    def check_alive(self) -> None:
        """Return at once when frames are coming.

        Raises:
            TouchError: They are not.
        """
        ...


class Clock(Protocol):
    """Time as the loop sees it: on a simulated rig, motions and waits take simulated time."""

    def monotonic(self) -> float:
        """For durations and ordering [s]."""
        ...

    def wall(self) -> float:
        """Seconds since the Unix epoch; metadata only."""
        ...

    def sleep(self, seconds: float) -> None:
        """Let time pass [s]."""
        ...

    def stamp(self) -> Stamp:
        """Both clocks, now."""
        ...


class Rig(Protocol):
    """The devices of one episode, at the start pose with the gripper open."""

    @property
    def arm(self) -> Arm:
        """The arm."""
        ...

    @property
    def gripper(self) -> Gripper:
        """The gripper."""
        ...

    @property
    def sensor(self) -> TactileSensor:
        """The tactile sensor in one finger."""
        ...

    @property
    def clock(self) -> Clock:
        """Time."""
        ...

    @property
    def start_pose(self) -> Pose:
        """Where the first grasp is made, and where ``reset`` returns to."""
        ...

    @property
    def first_force_n(self) -> float:
        """Commanded force of the first grasp [N]."""
        ...

    def disconnect(self) -> None:
        """Free every device. Idempotent, never raises."""
        ...
