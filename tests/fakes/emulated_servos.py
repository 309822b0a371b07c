"""An emulated gripper for tests of its driver: emulator, settings and calibration in one place."""

import time
from collections.abc import Callable
from pathlib import Path

from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.dynamixel.fingers import Linkage, SpringLoad
from sim.emulators.dynamixel.options import ServoOptions
from tacgrasp.drivers.dynamixel.calibration import save_calibration
from tacgrasp.drivers.dynamixel.gripper import DynamixelGripper, connect_gripper
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings, ServoSettings
from tacgrasp.rig.emulated import emulated_calibration

UNIT = "emulated"
MAX_MA = 900.0


def emulated_gripper(
    port: str,
    folder: Path,
    *,
    model: str = "XC330-T288",
    num_servos: int = 1,
    baud: int = 1_000_000,
    linkage: Linkage | None = None,
) -> DynamixelSettings:
    """Settings for an emulator at a port; writes its calibration into a folder.

    Args:
        port: Port announced by the emulator.
        folder: Folder of the rig's file, or a temporary one.
        model: Model of the emulated servos.
        num_servos: Number of emulated servos, 1 or 2.
        baud: Baud rate of the emulator [bit/s].
        linkage: Linkage of the emulator; None is its default.
    """
    fingers = linkage or Linkage()
    settings = DynamixelSettings(
        port=port,
        baud=baud,
        unit=UNIT,
        model=model,
        servos=tuple(
            ServoSettings(
                id=index + 1,
                open_ticks=round(fingers.ticks(index, fingers.open_width_m)),
                closed_ticks=round(fingers.ticks(index, 0.0)),
            )
            for index in range(num_servos)
        ),
        open_width_mm=1000 * fingers.open_width_m,
        speed_mm_s=200.0,
        max_current_ma=MAX_MA,
    )
    save_calibration(folder / settings.calibration, emulated_calibration(settings, fingers))
    return settings


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
        gripper = connect_gripper(self.settings, folder=self.folder, **options)
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
