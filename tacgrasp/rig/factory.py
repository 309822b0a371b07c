"""Build the rig that the configuration names.

To add a rig of devices that there are drivers for, write its YAML file. To add a driver, give it a
line in ``tacgrasp.config.hardware`` and in ``tacgrasp.rig.hardware``.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import asdict
from typing import TYPE_CHECKING

from primitives import RobotError
from primitives.execution import Executor, PadAxes
from tacgrasp.base.errors import UsageError
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes.command_log import Command, CommandLog
from tacgrasp.episodes.record import Truth
from tacgrasp.rig.protocols import Rig

if TYPE_CHECKING:
    from sim.grasp.rig import SimRig


log = logging.getLogger(__name__)


def make_rig(config: RunConfig) -> Rig:
    """Build the rig that ``config.devices`` names; never another one in its place.

    Raises:
        UsageError: The simulator knows no such object, or the mesh doesn't exist.
        RobotError: A device can't be reached, or is not as it must be.
        TouchError: The mesh can't be used.
    """
    if config.hardware is None:
        return _simulated(config)
    from tacgrasp.rig import emulated as emulated_rig
    from tacgrasp.rig import hardware as hardware_rig

    if config.devices == "emulated":
        _check_object(config)
        return emulated_rig.start(config, config.hardware)
    if config.gripper.first_force_n is None:
        raise UsageError("a rig of real devices needs gripper.first_force_n")
    return hardware_rig.connect(config, config.hardware, config.gripper.first_force_n)


def _check_object(config: RunConfig) -> None:
    from sim.grasp.bodies import OBJECTS

    if config.object not in OBJECTS:
        raise UsageError(
            f"the simulator has no object {config.object!r}; known: {', '.join(OBJECTS)}"
        )
    if config.object_mesh is not None and not config.object_mesh.is_file():
        raise UsageError(f"--object-mesh {config.object_mesh} does not exist")


def _simulated(config: RunConfig) -> SimRig:
    from sim.grasp.rig import build

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
