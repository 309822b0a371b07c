"""Look at every device of a rig and at its file: what ``tacgrasp doctor`` prints. Nothing moves.

Not here: the checks of a device, which are its driver's.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

from primitives.errors import RobotError
from primitives.execution import PadAxes
from tacgrasp.config.hardware import HardwareConfig, SensorSettings
from tacgrasp.config.schema import RunConfig
from tacgrasp.drivers.check import Finding
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.drivers.recorded.settings import RecordedSettings

LIBRARIES = {
    "arm": ("ur-rtde", "1.6"),
    "gripper": ("dynamixel-sdk", "4."),
    "sensor": ("pyserial", "3."),
}
"""Library of each device, and the versions that the drivers were tested with."""


def examine(config: RunConfig) -> Sequence[Finding]:
    """Every finding about the rig of a configuration, in the order of the devices.

    Raises:
        RobotError: The emulators of an emulated rig did not start.
    """
    found = [*_of_the_file(config)]
    if config.hardware is None:
        what = "simulated: there is nothing to connect"
        return [*found, Finding(device="rig", name="devices", ok=True, detail=what)]
    found += _libraries()
    if config.devices == "hardware":
        return [*found, *_of_the_devices(config.hardware)]
    return [*found, *_emulated(config, config.hardware)]


def _of_the_file(config: RunConfig) -> list[Finding]:
    low, high = config.arm.workspace_low_m, config.arm.workspace_high_m
    box = " × ".join(f"{1000 * (b - a):.0f}" for a, b in zip(low, high, strict=True))
    limits = (
        f"{box} mm, steps of {config.arm.max_step_mm:g} mm, {config.arm.max_speed_m_s:g} m/s, "
        f"{config.gripper.min_force_n:g} to {config.gripper.max_force_n:g} N"
    )
    axes = PadAxes(x_tcp=config.pad.x_axis, y_tcp=config.pad.y_axis)
    return [
        Finding(device="rig", name="limits", ok=True, detail=limits),
        Finding(
            device="rig",
            name="pad axes",
            ok=True,
            detail=f"x {_listed(axes.x_tcp)}, y {_listed(axes.y_tcp)} in the TCP's frame",
        ),
    ]


def _libraries() -> list[Finding]:
    found = []
    for device, (package, tested) in LIBRARIES.items():
        try:
            version = metadata.version(package)
        except metadata.PackageNotFoundError:
            version = ""
        found.append(
            Finding(
                device=device,
                name="library",
                ok=version.startswith(tested),
                detail=f"{package} {version or 'not installed'}",
                advice=""
                if version.startswith(tested)
                else f"the driver was tested with {package} {tested}x: install that (make setup)",
            )
        )
    return found


def _of_the_devices(hardware: HardwareConfig) -> list[Finding]:
    from tacgrasp.drivers.dynamixel import gripper as dynamixel
    from tacgrasp.drivers.ur import arm as ur

    return [
        *ur.check(hardware.arm),
        *dynamixel.check(hardware.gripper),
        *_of_the_sensor(hardware.sensor),
    ]


def _of_the_sensor(settings: SensorSettings) -> Sequence[Finding]:
    from tacgrasp.drivers.gelsight import connect as gelsight_mini
    from tacgrasp.drivers.recorded import sensor as recorded
    from tacgrasp.drivers.taxels import connect as taxels

    if isinstance(settings, GelSightSettings):
        return gelsight_mini.check(settings)
    if isinstance(settings, RecordedSettings):
        return recorded.check(settings)
    return taxels.check(settings)


def _emulated(config: RunConfig, hardware: HardwareConfig) -> list[Finding]:
    from sim.emulators.process.spawn import EmulatorProcess
    from tacgrasp.rig.emulated import settings_for

    try:
        with (
            EmulatorProcess("rig", "--seed", str(config.seed)) as emulators,
            tempfile.TemporaryDirectory(prefix="tacgrasp-") as folder,
        ):
            ready = ", ".join(f"{name} {value}" for name, value in emulators.ready.items())
            started = Finding(device="rig", name="emulators", ok=True, detail=ready)
            settings = settings_for(hardware, emulators, Path(folder))
            return [started, *_of_the_devices(settings)]
    except RobotError as error:
        advice = "see the message; python -m sim.emulators rig shows all of it"
        return [Finding(device="rig", name="emulators", ok=False, detail=str(error), advice=advice)]


def _listed(axis: Sequence[float]) -> str:
    return f"({', '.join(f'{value:g}' for value in axis)})"
