"""Options of every emulator, for ``python -m sim.emulators`` and ``tacgrasp emulate`` alike.

Importing this module is cheap: it loads no emulator, no world and no torch.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from sim.emulators.dynamixel.options import DynamixelOptions
from sim.emulators.taxels.options import TaxelOptions
from sim.emulators.ur.options import UrOptions, check_loopback


@dataclass(frozen=True, slots=True, kw_only=True)
class RigOptions:
    """Arm, gripper and taxel array around one object, for a rig file of your own.

    Attributes:
        object: object between the fingers
        object_mesh: mesh file to use in place of the object [mm]
        object_mass_g: mass of the mesh [g]; by default from its volume
        object_young_mpa: Young's modulus of the mesh [MPa]; by default the object's
        object_bruise_n: force that bruises the mesh [N]; by default the object's
        seed: random seed of the object, its pose, the gripper and the sensor noise
        sensor: sensor whose sensing area the taxels cover; taxels sends displacements too
        first_force_n: largest commanded force until something is felt [N]; by default 1.0
        held: start with the object gripped between the fingers
        centred: start with the object in the middle of the pad
        host: loopback address of the arm; by default one that is free

    Raises:
        ValueError: The host is no loopback address, or the force is none.
    """

    object: str = "strawberry"
    object_mesh: Path | None = None
    object_mass_g: float | None = None
    object_young_mpa: float | None = None
    object_bruise_n: float | None = None
    seed: int = 0
    sensor: str = "gelsight_mini"
    first_force_n: float | None = None
    held: bool = False
    centred: bool = False
    host: str | None = None

    def __post_init__(self) -> None:
        if self.host is not None:
            check_loopback(self.host)
        if self.first_force_n is not None and not 0 < self.first_force_n < math.inf:
            raise ValueError(f"--first-force-n must be above 0 N, got {self.first_force_n:g}")


OPTIONS: Mapping[str, type] = {
    "ur": UrOptions,
    "dynamixel": DynamixelOptions,
    "taxels": TaxelOptions,
    "rig": RigOptions,
}
"""Options of each kind of emulator."""
