"""A whole emulated rig: arm (a child process), gripper and taxel array around one world.

``python -m sim.emulators rig --object strawberry --seed 0``. Each rig has an address and ports of
its own, so that several run side by side on one machine.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, closing
from pathlib import Path

from primitives.errors import RobotError
from sim.emulators.dynamixel.bus_process import DynamixelEmulator, ServoOptions
from sim.emulators.dynamixel.fingers import Linkage
from sim.emulators.process.control import ControlServer, Emulated
from sim.emulators.process.lifetime import announce_and_wait
from sim.emulators.taxels.array import TaxelEmulator
from sim.emulators.ur.child import UrChild
from sim.emulators.world import SharedWorld
from sim.grasp.bodies import OBJECTS
from sim.grasp.rig import build

TAXEL_RATE_HZ = 50.0

GRIPPER = ServoOptions(model="XM540-W270")
FINGERS = Linkage(newtons_per_ma=0.0026, friction_ma=54.0)
"""A large servo on a slow linkage: the forces of the simulated gripper, in steps of 7 mN, so that
rounding to the servo's units of current decides as little as possible."""

SWITCH_S = 0.001
"""How long one thread may keep the others waiting [s]: the arm's stream is due every 8 ms."""

_ADDRESSES = 254 * 254
_TRIES = 20


def addresses(start: int) -> Iterator[str]:
    """Loopback addresses to try, those of two processes far apart."""
    for attempt in range(_TRIES):
        row, column = divmod((start + 7919 * attempt) % _ADDRESSES, 254)
        yield f"127.77.{row + 1}.{column + 1}"


def main(argv: Sequence[str]) -> int:
    """Run one emulated rig until told to end."""
    parser = argparse.ArgumentParser(prog="python -m sim.emulators rig", description=__doc__)
    parser.add_argument("--object", default="strawberry", choices=sorted(OBJECTS))
    parser.add_argument("--object-mesh", type=Path, default=None, help="a mesh [mm] instead")
    parser.add_argument("--object-mass-g", type=float, default=None)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--sensor", default="gelsight_mini", help="whose field the taxels cover")
    parser.add_argument("--first-force-n", type=float, default=None)
    parser.add_argument("--held", action="store_true", help="as if somebody held it between them")
    parser.add_argument("--host", default=None, help="loopback address; one that is free")
    flags = parser.parse_args(argv)
    sys.setswitchinterval(SWITCH_S)
    _one_thread()
    simulated = build(
        flags.object,
        flags.seed,
        mesh=flags.object_mesh,
        mass_g=flags.object_mass_g,
        sensor_name=flags.sensor,
        first_force_n=flags.first_force_n,
    )
    if flags.held:
        simulated.gripper.grip(simulated.first_force_n)
    with ExitStack() as stack:
        world = stack.enter_context(closing(SharedWorld(simulated)))
        arm = stack.enter_context(closing(_arm(flags.host, world)))
        gripper = stack.enter_context(closing(DynamixelEmulator(world, GRIPPER, FINGERS)))
        folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="tacgrasp-rig-"))
        link = Path(folder) / "taxel-array"
        taxels = stack.enter_context(
            closing(TaxelEmulator(world, link=link, rate_hz=TAXEL_RATE_HZ, seed=flags.seed))
        )
        devices: Mapping[str, Emulated] = {
            "ur": arm,
            "dynamixel": gripper,
            "taxels": taxels,
            "world": world,
        }
        control = stack.enter_context(closing(ControlServer(devices)))
        announce_and_wait(
            {
                "control_port": control.port,
                "host": arm.host,
                "gripper_port": gripper.serial_port,
                "sensor_port": taxels.port,
                "first_force_n": simulated.first_force_n,
            }
        )
    return 0


def _arm(host: str | None, world: SharedWorld) -> UrChild:
    """An arm at the address asked for, or at the first that is free; a process of its own."""
    if host is not None:
        return UrChild(host, world.moved)
    for tried in addresses(os.getpid()):
        try:
            return UrChild(tried, world.moved)
        except OSError:
            continue
    raise RobotError(f"none of {_TRIES} loopback addresses has the ports of a UR free")


def _one_thread() -> None:
    import torch

    torch.set_num_threads(1)  # contacts are small, and the devices need the other cores
