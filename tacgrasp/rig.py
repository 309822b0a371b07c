"""What a run needs of a rig, and the factory that builds the one that the configuration names.

To add a rig of devices that there are drivers for, write its YAML file. To add a driver, give it a
line in ``tacgrasp.hardware_config`` and in ``tacgrasp.hardware_rig``.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import asdict
from typing import TYPE_CHECKING, Protocol

from cltp.cloud import Stamp
from primitives import RobotError
from primitives.devices import Arm, Gripper, Pose
from primitives.execution import Executor, PadAxes
from tacgrasp.commands import Command, CommandLog
from tacgrasp.config import RunConfig
from tacgrasp.episodes.record import Truth
from tacgrasp.errors import UsageError
from tacgrasp.sensor import TactileSensor

if TYPE_CHECKING:
    from sim.rig import SimRig


log = logging.getLogger(__name__)


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


def make_rig(config: RunConfig) -> Rig:
    """Build the rig that ``config.devices`` names; never another one in its place.

    Raises:
        UsageError: The simulator knows no such object, or the mesh doesn't exist.
        RobotError: A device can't be reached, or is not as it must be.
        TouchError: The mesh can't be used.
    """
    if config.hardware is None:
        return _simulated(config)
    from tacgrasp import emulated_rig, hardware_rig

    if config.devices == "emulated":
        _check_object(config)
        return emulated_rig.start(config, config.hardware)
    if config.gripper.first_force_n is None:
        raise UsageError("a rig of real devices needs gripper.first_force_n")
    return hardware_rig.connect(config, config.hardware, config.gripper.first_force_n)


def _check_object(config: RunConfig) -> None:
    from sim.bodies import OBJECTS

    if config.object not in OBJECTS:
        raise UsageError(
            f"the simulator has no object {config.object!r}; known: {', '.join(OBJECTS)}"
        )
    if config.object_mesh is not None and not config.object_mesh.is_file():
        raise UsageError(f"--object-mesh {config.object_mesh} does not exist")


def _simulated(config: RunConfig) -> SimRig:
    from sim.rig import build

    _check_object(config)
    rig = build(
        config.object,
        config.seed,
        mesh=config.object_mesh,
        mass_g=config.object_mass_g,
        sensor_name=config.sensor,
        first_force_n=config.gripper.first_force_n,
    )
    if config.dry_run:  # in place of a person who holds the object between the real fingers
        rig.gripper.grip(rig.first_force_n)
    return rig


def truth_of(rig: Rig) -> Truth | None:
    """What the simulator knows, None on a real rig. For records and people, never for a policy."""
    truth = getattr(rig, "truth", None)
    if truth is None:
        return None
    try:
        facts = asdict(truth())
    except RobotError as error:  # the emulator is gone: the robot must be made safe all the same
        log.warning("the truth can't be recorded: %s", error)
        return None
    x_mm, y_mm = facts.pop("offset_mm")
    return facts | {"offset_x_mm": x_mm, "offset_y_mm": y_mm}


def expect_untouched(rig: Rig) -> None:
    """Hold the sensor to its picture of the untouched gel, before the first grasp of an episode.

    Of a rig that knows no such picture nothing is asked. In a dry run somebody holds the object.

    Raises:
        RobotError: The gel is touched or dirty, or its background is stale; nothing has moved.
    """
    look: Callable[[], None] | None = getattr(rig, "expect_untouched", None)
    if look is not None:
        look()


def commands_of(rig: Rig) -> tuple[Command, ...]:
    """What the devices were given since the last time; empty on rigs that note none (``sim``)."""
    log: CommandLog | None = getattr(rig, "commands", None)
    return () if log is None else log.take()


def make_executor(rig: Rig, config: RunConfig) -> Executor:
    """What carries the primitives out on a rig, held to the configured limits.

    Raises:
        LimitError: The rig starts outside its workspace.
    """
    return Executor(
        rig.arm,
        rig.gripper,
        config.limits(),
        clear_mm=config.primitives.clear_mm,
        move_step_mm=config.primitives.move_step_mm,
        first_force_n=rig.first_force_n,
        start_pose=rig.start_pose,
        pad_axes=PadAxes(x_tcp=config.pad.x_axis, y_tcp=config.pad.y_axis),
        clock=rig.clock.monotonic,
        dry_run=config.dry_run,
    )
