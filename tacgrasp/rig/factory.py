"""Build the rig that the configuration names.

A rig of supported devices needs only its YAML file. A new driver gets a line in
``tacgrasp.config.hardware`` and one in ``tacgrasp.rig.hardware``.
"""

from __future__ import annotations

import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from primitives.contract import Contract
from primitives.execution import Executor, PadAxes
from tacgrasp.base.errors import UsageError
from tacgrasp.base.plugins import load_plugin, names_with, plugins
from tacgrasp.config.schema import RunConfig
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import Rig

if TYPE_CHECKING:
    from sim.grasp.rig import SimRig


_ADDED: set[str] = set()  # objects of plugins that the simulator was given


def check_devices(config: RunConfig, *, allow_uncalibrated_force: bool = False) -> None:
    """Refuse to grasp with a sensor that feels nothing, or whose forces are off by any factor.

    Args:
        config: The run; a dry run, which moves nothing, is always allowed.
        allow_uncalibrated_force: Grasp on real devices without a force calibration.

    Raises:
        UsageError: The sensor plays a recording, or has no force calibration.
    """
    from tacgrasp.drivers.force_scale import uncalibrated_refusal

    if config.hardware is None or config.dry_run:
        return
    sensor = config.hardware.sensor
    if not sensor.is_live:
        raise UsageError(
            f"the sensor of the rig's file ({config.rig}) plays a recording: nothing is felt, so "
            "nothing may be grasped; give --dry-run to see what would be decided"
        )
    if config.devices != "hardware" or allow_uncalibrated_force:
        return
    if reason := uncalibrated_refusal(sensor):
        raise UsageError(f"{reason}; nothing moved")


def make_rig(config: RunConfig, *, must_grip: bool = True) -> Rig:
    """Build the rig that ``config.devices`` names; never falls back to another one.

    Args:
        config: The configuration.
        must_grip: Whether a real gripper needs a calibration that fits; without one it only opens.

    Raises:
        UsageError: The simulator knows no such object, or the mesh doesn't exist.
        RobotError: A device can't be reached, or is in a wrong state.
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
        raise UsageError(
            "a rig of real devices needs gripper.first_force_n, the largest commanded force until "
            "something is felt [N]"
        )
    first_force_n = config.gripper.first_force_n
    return hardware_rig.connect(config, config.hardware, first_force_n, must_grip=must_grip)


def make_centred_rig(config: RunConfig) -> Rig:
    """Build a simulated or emulated rig with the object in the middle of the pad, to calibrate it.

    Raises:
        UsageError: The simulator knows no such object, or the mesh doesn't exist.
        RobotError: The emulators did not start.
    """
    from tacgrasp.rig import emulated as emulated_rig

    _check_object(config)
    if config.hardware is None:
        return _simulated(config, centred=True)
    return emulated_rig.start(config, config.hardware, centred=True)


def check_names(config: RunConfig) -> None:
    """Check object, mesh, sensor and calibrations, before anything heavy is loaded or moves.

    Raises:
        UsageError: The simulator knows no such object, or the mesh doesn't exist.
        TouchError: There is no such sensor, or the slip calibration can't be used.
        RobotError: A calibration of a real rig is missing, damaged or too old.
    """
    from cltp.tactile.sensors import sensor_named

    is_named = config.hardware is None or config.devices == "emulated"  # a driver names its own
    if is_named:
        sensor_named(config.sensor)
    check_slip_calibration(config)
    if config.devices != "hardware":
        _check_object(config)
    elif config.hardware is not None:
        from tacgrasp.rig.hardware import check_files

        check_files(config.hardware)


def check_slip_calibration(config: RunConfig) -> None:
    """Check the slip calibration of a run, if it uses one.

    Raises:
        TouchError: It is missing, damaged, too old, or that of another sensor or unit.
    """
    if not config.reflex or config.slip_calibration is None:
        return
    from cltp.tactile.shear.slip_calibration import load_unit_slip

    is_named = config.hardware is None or config.devices == "emulated"  # a driver names its own
    load_unit_slip(
        config.slip_calibration,
        sensor=config.sensor if is_named else None,
        unit=config.sensor_unit,
        today=datetime.date.today(),
    )


def _check_object(config: RunConfig) -> None:
    check_object(config.object, config.object_mesh, is_emulated=config.devices == "emulated")


def check_object(name: str, mesh: Path | None, *, is_emulated: bool) -> None:
    """Check an object and its mesh; one of a plugin is made known to the simulator.

    Raises:
        UsageError: The simulator, or the emulators, know no such object, or the mesh doesn't exist.
    """
    from sim.grasp.bodies import OBJECTS, ObjectKind, add_object

    if name not in object_names() and name in plugins("objects"):
        if is_emulated:
            raise UsageError(
                f"the emulators know no object of a plugin ({name}); use the simulated rig"
            )
        kind = load_plugin("objects", name, object_refusal)
        assert isinstance(kind, ObjectKind)  # the check has refused everything else
        add_object(name, kind)
        _ADDED.add(name)
    if name not in OBJECTS:
        known = ", ".join(names_with("objects", OBJECTS))
        raise UsageError(f"the simulator has no object {name!r}; known: {known}")
    if mesh is not None and not mesh.is_file():
        raise UsageError(f"--object-mesh {mesh} does not exist")


def object_names() -> list[str]:
    """Names of the simulator's own objects."""
    from sim.grasp.bodies import OBJECTS

    return [name for name in OBJECTS if name not in _ADDED]


def object_refusal(added: object) -> str:
    """Why a plugin's object is no kind of object for the simulator; empty for one that is."""
    from sim.grasp.bodies import ObjectKind

    if isinstance(added, ObjectKind):
        return ""
    return f"expected a sim.grasp.bodies.ObjectKind, got {added!r:.80}"


def _simulated(config: RunConfig, *, centred: bool = False) -> SimRig:
    from sim.grasp.mesh_bodies import ScannedObject
    from sim.grasp.rig import build

    _check_object(config)
    mesh = None
    if config.object_mesh is not None:
        mesh = ScannedObject(
            path=config.object_mesh,
            mass_g=config.object_mass_g,
            young_mpa=config.object_young_mpa,
            bruise_n=config.object_bruise_n,
        )
    rig = build(
        config.object,
        config.seed,
        mesh=mesh,
        sensor_name=config.sensor,
        first_force_n=config.gripper.first_force_n,
        start_offset_mm=(0.0, 0.0) if centred else None,
    )
    if config.dry_run:  # on a real rig a person puts the object between the fingers
        rig.gripper.grip(rig.first_force_n)
    return rig


def make_executor(
    rig: Rig, config: RunConfig, contract: Contract | None, sense: GelSense | None = None
) -> Executor:
    """Executor of the primitives on a rig, within the configured limits and the contract.

    Args:
        rig: The rig.
        config: The run.
        contract: Contract of the episode; None for a benchmark's baseline that has none.
        sense: Touch while the fingers close; None closes without feeling.

    Raises:
        LimitError: The rig starts outside its workspace, or the contract is refused.
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
        sense=None if sense is None else sense.for_executor(),
        contract=contract,
        max_gain=config.gripper.max_force_gain,
        force_step_n=rig.force_step_n,
        dry_run=config.dry_run,
    )
