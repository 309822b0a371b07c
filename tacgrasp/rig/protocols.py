"""Contracts of a rig, of its tactile sensor and of its clock.

Not here: the contracts of arm and gripper (``primitives.devices``).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from cltp.sensing.frames import Frame
from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField
from primitives.devices import Arm, Gripper, Pose
from tacgrasp.episodes.command_log import Command

if TYPE_CHECKING:
    from sim.grasp.rig import Truth


class TactileSensor(Protocol):
    """A sensor that gives clouds. Implementations: ``sim.grasp.devices.SimSensor``, the drivers."""

    @property
    def spec(self) -> SensorSpec:
        """Type and constants of the sensor."""

    def read(self, frames: int = 1) -> TactileCloud:
        """Capture the gel now.

        The cloud is newer than the call, keeps every point that the sensor gives, and carries both
        clocks.

        Args:
            frames: Frames that the cloud is the mean of, the first one newer than the call; a
                recording gives its next cloud, whatever their number.

        Raises:
            TouchError: No fresh frame could be captured; an old one is never returned.
        """

    def take_reference(self) -> None:
        """Take the gel as it is, under open fingers, as untouched: later clouds are relative to it.

        Slow drift of the gel since the last reference is gone afterwards. A sensor that plays a
        recording does nothing.

        Raises:
            TouchError: No fresh frame could be captured; the old reference stays.
        """

    def disconnect(self) -> None:
        """Free the device. Idempotent, never raises."""


@runtime_checkable
class WatchedSensor(TactileSensor, Protocol):
    """A sensor of a real rig, which can be checked while the arm moves."""

    def check_alive(self) -> str:
        """Return at once: why the last frame is too old to move by; empty while frames come.

        Raises:
            TouchError: The sensor has failed.
        """

    def expect_untouched(self) -> None:
        """Compare the gel with its background; a sensor without a background returns at once.

        Raises:
            TouchError: The gel is touched or dirty, or its background is stale.
        """

    def counts(self) -> object | None:
        """Counts of frames and of the faults among them, for people; None without any."""


@runtime_checkable
class CameraSensor(Protocol):
    """A tactile sensor with a camera behind its gel, for records and viewers."""

    def last_frame(self) -> Frame | None:
        """The frame that the last cloud came from, shape (H, W, 3), RGB; None before the first."""


@runtime_checkable
class ShearSensor(Protocol):
    """A tactile sensor that can measure displacements along its gel."""

    def last_shear(self) -> ShearField | None:
        """The shear field of the frames that the last cloud came from, as that after a reference.

        None where the unit measures none, and before the first cloud.
        """


@runtime_checkable
class StreamingShearSensor(Protocol):
    """A sensor of shear whose newest frame can be had at once, for a reflex."""

    def newest_shear(self) -> ShearField | None:
        """The shear field of the newest frame, without waiting; None where there is none.

        Its stamp tells when it was captured: it may be old.

        Raises:
            TouchError: The sensor has failed, or the frame shows no gel.
        """


@runtime_checkable
class CallingClock(Protocol):
    """A clock of a simulated world, which calls back in the middle of motions and waits."""

    def call_every(self, period_s: float, call: Callable[[], None] | None) -> None:
        """Call a function each period of simulated time [s]; None ends it."""

    @property
    def simulated_s(self) -> float:
        """Simulated time so far [s]."""


class Clock(Protocol):
    """Clock of the loop: on a simulated rig, motions and waits take simulated time."""

    def monotonic(self) -> float:
        """Time for durations and ordering [s]."""

    def wall(self) -> float:
        """Seconds since the Unix epoch; metadata only."""

    def sleep(self, seconds: float) -> None:
        """Wait [s]."""

    def stamp(self) -> Stamp:
        """Current time on both clocks."""


class Rig(Protocol):
    """The devices of one episode, at the start pose with the gripper open."""

    @property
    def arm(self) -> Arm: ...

    @property
    def gripper(self) -> Gripper: ...

    @property
    def sensor(self) -> TactileSensor: ...

    @property
    def clock(self) -> Clock: ...

    @property
    def start_pose(self) -> Pose:
        """Pose of the first grasp, to which ``reset`` returns."""

    @property
    def first_force_n(self) -> float:
        """Largest commanded force of a first grasp until something is felt [N]."""

    @property
    def force_step_n(self) -> float:
        """Least change of the commanded force that the gripper makes [N]; 0 for any."""

    def expect_untouched(self) -> None:
        """Check before the first grasp that the gripper is open and nothing touches the gel.

        Raises:
            RobotError: The gripper is not open, the gel is touched or dirty, or its background is
                stale; nothing has moved.
        """

    def commands(self) -> tuple[Command, ...]:
        """Commands to the devices since the last call, oldest first; empty in simulation."""

    def truth(self) -> Truth | None:
        """Truth of the simulated world, never for a policy; None on a real rig.

        Raises:
            RobotError: The emulators do not answer.
        """

    def disconnect(self) -> None:
        """Free every device. Idempotent, never raises."""
