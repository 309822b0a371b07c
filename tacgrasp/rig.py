"""What a run needs of a rig, and the factory that builds the one that the configuration names.

To add a rig: write its drivers, its YAML file, and one line in ``make_rig``.
"""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Protocol

from cltp.cloud import Stamp
from primitives.devices import Arm, Gripper, Pose
from primitives.execution import Executor, PadAxes
from primitives.limits import Limits
from tacgrasp.commands import Command, CommandLog
from tacgrasp.config import RunConfig
from tacgrasp.episodes.record import Truth
from tacgrasp.errors import UsageError
from tacgrasp.sensor import TactileSensor

if TYPE_CHECKING:
    from sim.rig import SimRig


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
        RobotError: A device can't be reached.
        TouchError: The mesh can't be used.
    """
    return _simulated(config)  # the only kind so far


def _simulated(config: RunConfig) -> SimRig:
    from sim.bodies import OBJECTS
    from sim.rig import build

    if config.object not in OBJECTS:
        raise UsageError(
            f"the simulator has no object {config.object!r}; known: {', '.join(OBJECTS)}"
        )
    if config.object_mesh is not None and not config.object_mesh.is_file():
        raise UsageError(f"--object-mesh {config.object_mesh} does not exist")
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
    facts = asdict(truth())
    x_mm, y_mm = facts.pop("offset_mm")
    return facts | {"offset_x_mm": x_mm, "offset_y_mm": y_mm}


def commands_of(rig: Rig) -> tuple[Command, ...]:
    """What the devices were given since the last time; empty on rigs that note none (``sim``)."""
    log: CommandLog | None = getattr(rig, "commands", None)
    return () if log is None else log.take()


def limits_of(config: RunConfig) -> Limits:
    """The bounds of everything that is sent in a run."""
    return Limits(
        max_step_mm=config.arm.max_step_mm,
        workspace_low_m=config.arm.workspace_low_m,
        workspace_high_m=config.arm.workspace_high_m,
        max_travel_mm=config.arm.max_travel_mm,
        min_force_n=config.gripper.min_force_n,
        max_force_n=config.gripper.max_force_n,
        max_speed_m_s=config.arm.max_speed_m_s,
    )


def make_executor(rig: Rig, config: RunConfig) -> Executor:
    """What carries the primitives out on a rig, held to the configured limits.

    Raises:
        LimitError: The rig starts outside its workspace.
    """
    return Executor(
        rig.arm,
        rig.gripper,
        limits_of(config),
        clear_mm=config.primitives.clear_mm,
        move_step_mm=config.primitives.move_step_mm,
        first_force_n=rig.first_force_n,
        start_pose=rig.start_pose,
        pad_axes=PadAxes(x_tcp=config.pad.x_axis, y_tcp=config.pad.y_axis),
        clock=rig.clock.monotonic,
        dry_run=config.dry_run,
    )
