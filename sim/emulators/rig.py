"""A whole emulated rig: arm (a child process), gripper and taxel array around one world.

``python -m sim.emulators rig --object strawberry --seed 0``. Each rig has its own address and
ports, so several rigs run side by side on one machine.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, closing
from pathlib import Path

from cltp.processor import torch_threads
from primitives.errors import RobotError
from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.dynamixel.fingers import Linkage
from sim.emulators.dynamixel.options import ServoOptions
from sim.emulators.live_world import LiveWorld, sends_shear
from sim.emulators.options import RigOptions
from sim.emulators.process.lifetime import WORLD_PRIORITY, request_real_time, serve
from sim.emulators.taxels.array import TaxelEmulator
from sim.emulators.ur.child import UrChild
from sim.emulators.world import SharedWorld
from sim.grasp.mesh_bodies import ScannedObject
from sim.grasp.rig import build

TAXEL_RATE_HZ = 60.0

GRIPPER = ServoOptions(model="XM540-W270")
FINGERS = Linkage(newtons_per_ma=0.0026, friction_ma=54.0)
"""A large servo on a slow linkage: the forces of the simulated gripper in steps of 7 mN, so that
rounding to the servo's units of current has little effect."""

SWITCH_S = 0.001
"""Longest time that one thread keeps the others waiting [s]: the arm's stream is due every 8 ms."""

_NUM_ADDRESSES = 254 * 254
_MAX_ATTEMPTS = 20


def addresses(start: int) -> Iterator[str]:
    """Loopback addresses to try; those of two processes are far apart."""
    for attempt in range(_MAX_ATTEMPTS):
        row, column = divmod((start + 7919 * attempt) % _NUM_ADDRESSES, 254)
        yield f"127.77.{row + 1}.{column + 1}"


def run(options: RigOptions) -> None:
    """Run one emulated rig, until the process is to end."""
    sys.setswitchinterval(SWITCH_S)
    with ExitStack() as stack:
        # One thread: contacts are small, and the devices need the other cores.
        stack.enter_context(torch_threads())
        simulated = build(
            options.object,
            options.seed,
            mesh=_scanned(options),
            sensor_name=options.sensor,
            first_force_n=options.first_force_n,
            start_offset_mm=(0.0, 0.0) if options.centred else None,
        )
        if options.held:
            simulated.gripper.grip(simulated.first_force_n)
        # From here on for all threads: one that holds Python's lock while ordinary work has the
        # processor keeps the devices from answering, by more than a second on a busy machine.
        request_real_time(priority=WORLD_PRIORITY)
        spec = simulated.sensor.spec
        live = LiveWorld(simulated) if sends_shear(spec) else None
        world = stack.enter_context(closing(live or SharedWorld(simulated)))
        arm = stack.enter_context(closing(_arm(options.host, world)))
        gripper = stack.enter_context(closing(DynamixelEmulator(world, GRIPPER, FINGERS)))
        folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="tacgrasp-rig-"))
        link = Path(folder) / "taxel-array"
        taxels = stack.enter_context(
            closing(
                TaxelEmulator(
                    world,
                    link=link,
                    along_mm=None if live is None else live.along_mm,
                    rate_hz=TAXEL_RATE_HZ if live is None else spec.frame_hz,
                    seed=options.seed,
                )
            )
        )
        serve(
            {"ur": arm, "dynamixel": gripper, "taxels": taxels, "world": world},
            {
                "host": arm.host,
                "gripper_port": gripper.serial_port,
                "sensor_port": taxels.port,
                "first_force_n": simulated.first_force_n,
            },
        )


def _scanned(options: RigOptions) -> ScannedObject | None:
    """The mesh to grasp, None for the drawn object.

    Raises:
        RobotError: A property of a mesh, and no mesh.
        TouchError: A property outside its range.
    """
    numbers = {
        "mass_g": options.object_mass_g,
        "young_mpa": options.object_young_mpa,
        "bruise_n": options.object_bruise_n,
    }
    if options.object_mesh is not None:
        return ScannedObject(path=options.object_mesh, **numbers)
    for name, value in numbers.items():
        if value is not None:
            flag = f"--object-{name.replace('_', '-')}"
            raise RobotError(f"{flag} is that of a mesh; give --object-mesh too, or leave it out")
    return None


def _arm(host: str | None, world: SharedWorld) -> UrChild:
    """An arm in a process of its own, at the given address or at the first free one."""
    begin = world.begin if isinstance(world, LiveWorld) else None
    if host is not None:
        return UrChild(host, world.follow, begin)
    for address in addresses(os.getpid()):
        try:
            return UrChild(address, world.follow, begin)
        except OSError:
            continue
    raise RobotError(f"none of {_MAX_ATTEMPTS} loopback addresses has the ports of a UR free")
