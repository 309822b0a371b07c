"""An emulated gripper for tests of its driver: emulator, settings and calibration in one place."""

import time
from collections.abc import Callable
from pathlib import Path

from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.dynamixel.fingers import SpringLoad
from sim.emulators.dynamixel.options import ServoOptions
from tacgrasp.drivers.dynamixel.emulated import emulated_gripper
from tacgrasp.drivers.dynamixel.gripper import DynamixelGripper, connect_gripper
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings


class EmulatedServos:
    """Servos on a bus of their own; close it at the end.

    Attributes:
        settings: Fit the servos; change them with ``setting``.
    """

    def __init__(self, folder: Path, load=None, num_servos: int = 1, **options) -> None:
        options = {"num_servos": num_servos} | options
        self.folder = folder
        self.emulator = DynamixelEmulator(load or SpringLoad(width_m=0.08), ServoOptions(**options))
        self.settings = emulated_gripper(
            self.emulator.serial_port, folder, num_servos=num_servos, model="XC330-T288"
        )
        self._grippers: list[DynamixelGripper] = []

    def setting(self, **values) -> DynamixelSettings:
        """Change some settings, checked as a rig's file is."""
        self.settings = DynamixelSettings(**(self.settings.model_dump() | values))
        return self.settings

    def poke(self, address: int, value: int, **only: int) -> None:
        """Change a register behind the driver's back."""
        self.emulator.inject("register", address=address, value=value, **only)

    def gripper(self, **options) -> DynamixelGripper:
        """Connect the driver; no arm moves here, so that a busy computer fails no test."""
        gripper = connect_gripper(self.settings, folder=self.folder, **options)
        gripper.fail_fast_while(lambda: False)
        self._grippers.append(gripper)
        return gripper

    def close(self) -> None:
        for gripper in self._grippers:
            gripper.disconnect()
        self.emulator.close()


def eventually(condition: Callable[[], object], seconds: float = 5.0) -> bool:
    """Whether it becomes true in time."""
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.005)
    return bool(condition())
