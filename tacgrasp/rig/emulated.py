"""The emulated rig: starts emulators and connects the real drivers to them.

``tacgrasp.rig.hardware`` runs unchanged; only addresses, ports and the gripper's calibration, which
can't be measured on an emulator, are put into the settings. The truth of the emulated world comes
through the control channel, for records and people, never for a policy.
"""

from __future__ import annotations

import datetime
import tempfile
from contextlib import ExitStack
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from cltp.sensing.force_calibration import save_force_calibration
from primitives.errors import RobotError
from sim.emulators.dynamixel.fingers import Linkage
from sim.emulators.process.spawn import EmulatorProcess
from sim.emulators.rig import FINGERS
from sim.grasp.force_calibration import drawn_force_calibration
from sim.grasp.rig import Truth
from tacgrasp.base.errors import UsageError
from tacgrasp.config.hardware import HardwareConfig
from tacgrasp.config.schema import RunConfig
from tacgrasp.drivers.dynamixel.calibration import (
    MIN_READINGS,
    GripperCalibration,
    save_calibration,
)
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.rig.hardware import HardwareRig, connect


@dataclass(frozen=True, slots=True, kw_only=True)
class EmulatedRig(HardwareRig):
    """A rig of real drivers on emulators.

    Attributes:
        emulators: Process of the emulators.
    """

    emulators: EmulatorProcess

    def truth(self) -> Truth:
        facts = self.emulators.control.facts("world")
        x_mm, y_mm = facts["offset_x_mm"], facts["offset_y_mm"]
        if not (isinstance(x_mm, float) and isinstance(y_mm, float)):
            raise RobotError(f"the emulators' truth has no position on the pad: {facts}")
        values: dict[str, Any] = {f.name: facts[f.name] for f in fields(Truth) if f.name in facts}
        return Truth(offset_mm=(x_mm, y_mm), **values)

    def disconnect(self) -> None:
        """Free every device, then end the emulators. Idempotent, never raises."""
        HardwareRig.disconnect(self)
        self.emulators.close()


def start(config: RunConfig, hardware: HardwareConfig, *, centred: bool = False) -> EmulatedRig:
    """Start the emulators of the configured object and seed, and connect to them.

    Args:
        config: The run.
        hardware: Devices of the rig's file.
        centred: Start with the object in the middle of the pad.

    Raises:
        RobotError: They did not start, or a driver refuses them.
        TouchError: The sensor's driver refuses its emulator.
        UsageError: The rig's file names a device without an emulator.
    """
    with tempfile.TemporaryDirectory(prefix="tacgrasp-") as folder, ExitStack() as stack:
        emulators = stack.enter_context(EmulatorProcess("rig", *_options(config, centred=centred)))
        settings = settings_for(config, hardware, emulators, Path(folder))
        first_force_n = float(str(emulators.ready["first_force_n"]))
        rig = connect(config, settings, first_force_n)
        stack.pop_all()
    parts = {field.name: getattr(rig, field.name) for field in fields(rig)}
    return EmulatedRig(**parts, emulators=emulators)


def settings_for(
    config: RunConfig, hardware: HardwareConfig, emulators: EmulatorProcess, folder: Path
) -> HardwareConfig:
    """Settings of the rig with the addresses of these emulators.

    The gripper's calibration is the emulator's own line, the sensor's that of the simulated rig of
    the same seed. They are written into ``folder``, which has to last until both are connected.

    Raises:
        UsageError: The sensor has no emulator.
        RobotError: The calibration can't be written.
    """
    if hardware.sensor.kind != "taxels":
        raise UsageError(
            f"the emulated rig has a sensor of kind taxels, its file names {hardware.sensor.kind}"
        )
    ready = emulators.ready
    calibration = folder / "gripper_calibration.yaml"
    save_calibration(calibration, emulated_calibration(hardware.dynamixel_gripper))
    force = folder / "force_calibration.json"
    drawn = drawn_force_calibration(config.sensor, config.seed, unit=hardware.sensor.unit)
    save_force_calibration(force, drawn)
    gripper = {"port": str(ready["gripper_port"]), "calibration": calibration}
    return hardware.model_copy(
        update={
            "arm": hardware.ur_arm.for_emulator(host=str(ready["host"])),
            "gripper": hardware.dynamixel_gripper.for_emulator(**gripper),
            "sensor": hardware.sensor.for_emulator(
                port=str(ready["sensor_port"]), sensor=config.sensor, force_calibration=force
            ),
        }
    )


def emulated_calibration(
    settings: DynamixelSettings, fingers: Linkage = FINGERS
) -> GripperCalibration:
    """Calibration of an emulated gripper: its own line of force over current, dated today."""
    return GripperCalibration(
        unit=settings.unit,
        model=settings.model,
        ids=settings.ids,
        date=datetime.date.today(),
        newtons_per_ma=fingers.newtons_per_ma,
        friction_ma=fingers.friction_ma,
        residual_n=0.0,
        max_force_n=fingers.force_n(settings.max_current_ma),
        num_readings=MIN_READINGS,
        source="the emulator's own line",
    )


def _options(config: RunConfig, *, centred: bool) -> list[str]:
    options = ["--object", config.object, "--seed", str(config.seed), "--sensor", config.sensor]
    optional = (
        ("--object-mesh", config.object_mesh),
        ("--object-mass-g", config.object_mass_g),
        ("--object-young-mpa", config.object_young_mpa),
        ("--object-bruise-n", config.object_bruise_n),
        ("--first-force-n", config.gripper.first_force_n),
    )
    for flag, value in optional:
        options += [flag, str(value)] if value is not None else []
    flags = {"--held": config.dry_run, "--centred": centred}
    return [*options, *(flag for flag, is_set in flags.items() if is_set)]
