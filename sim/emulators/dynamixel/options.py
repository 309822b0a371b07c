"""Options of the emulated Dynamixel bus."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import tyro

from sim.emulators.dynamixel.control_table import BAUDS, CURRENT_BASED_POSITION, MODELS
from sim.emulators.dynamixel.fingers import Linkage, SpringLoad


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoOptions:
    """The servos of one gripper.

    Attributes:
        model: model of the servos
        num_servos: number of servos, 1 or 2; their ids are 1 and 2
        baud: baud rate of the bus [bit/s]
        mode: operating mode of the servos; 5 is current-based position control
    """

    model: str = "XC330-T288"
    num_servos: Annotated[int, tyro.conf.arg(name="servos")] = 1
    baud: int = 1_000_000
    mode: int = CURRENT_BASED_POSITION

    def __post_init__(self) -> None:
        if self.model not in MODELS:
            raise ValueError(f"model must be one of {', '.join(MODELS)}, got {self.model!r}")
        if self.num_servos not in (1, 2):
            raise ValueError(f"a gripper has 1 or 2 servos, got {self.num_servos}")
        if self.baud not in BAUDS:
            raise ValueError(f"baud must be one of {', '.join(map(str, BAUDS))}, got {self.baud}")


@dataclass(frozen=True, slots=True, kw_only=True)
class DynamixelOptions(ServoOptions):
    """A Dynamixel bus on a serial port, with fingers on a spring.

    Attributes:
        spring_width_m: width of the uncompressed block between the fingers [m]
        spring_n_m: stiffness of the block [N/m]
        newtons_per_ma: slope of force over current [N/mA]
        friction_ma: current at which the fingers begin to press [mA]
    """

    spring_width_m: float = 0.03
    spring_n_m: float = 2000.0
    newtons_per_ma: float = Linkage().newtons_per_ma
    friction_ma: float = Linkage().friction_ma

    def load(self) -> SpringLoad:
        return SpringLoad(width_m=self.spring_width_m, stiffness_n_m=self.spring_n_m)

    def linkage(self) -> Linkage:
        return Linkage(newtons_per_ma=self.newtons_per_ma, friction_ma=self.friction_ma)
