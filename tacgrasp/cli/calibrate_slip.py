"""``tacgrasp calibrate slip``: the slip threshold of a unit, from its own noise in a hold."""

from __future__ import annotations

import datetime
import os
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_ending, check_kept


@dataclass(frozen=True)
class CalibrateSlipFlags:
    """Find from which score a contact of this unit slips: hold an object still, then unload it.

    No force gauge is needed. Put a firm object between the fingers so that it stands by itself. The
    arm stays where it is. The gripper closes on the object, holds it at rest, lowers the force step
    by step and opens; it opens after Ctrl-C too.

    Attributes:
        rig: Name of a rig, or path of its YAML file.
        sensor: Sensor of a simulated rig.
        force_n: Commanded force of the hold [N].
        hold_s: Duration of the hold [s].
        out: File to write; --slip-calibration of tacgrasp run takes it.
        overwrite: Replace an existing file.
        object: Object between the fingers of a simulated rig.
        seed: Random seed of the simulated world.
    """

    rig: str = "sim"
    sensor: str | None = None
    force_n: float = 1.0
    hold_s: float = 10.0
    out: Path = Path("slip_calibration.json")
    overwrite: bool = False
    object: str = "egg"
    seed: int = 0


def run(flags: CalibrateSlipFlags) -> None:
    """Hold, unload, and write the calibration."""
    _check(flags)
    from cltp import TouchError
    from cltp.tactile.shear.slip import slip_model
    from cltp.tactile.shear.slip_calibration import calibrate_slip, save_slip_calibration
    from tacgrasp.bringup.slip_hold import held_frames
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console, working
    from tacgrasp.rig.factory import make_centred_rig, make_rig

    config, _ = load(None, flags.rig, os.environ)
    update = {"object": flags.object, "seed": flags.seed, "sensor": flags.sensor or config.sensor}
    if config.hardware is not None:
        update |= {"sensor": config.sensor, "hardware": config.hardware.without_start_pose()}
    config = config.model_copy(update=update)
    if not config.gripper.min_force_n <= flags.force_n <= config.gripper.max_force_n:
        raise UsageError(f"--force-n {flags.force_n:g} is beyond the gripper of {flags.rig}")
    if config.hardware is None:
        try:
            slip_model(config.sensor)  # refused before anything moves
        except TouchError as error:
            raise UsageError(f"{error}; name one of them with --sensor") from None
    rig = make_rig(config) if config.devices == "hardware" else make_centred_rig(config)
    try:
        model = slip_model(rig.sensor.spec.name)
        with working(f"holding for {flags.hold_s:g} s"):
            hold, unload = held_frames(rig, flags.force_n, flags.hold_s)
    finally:
        rig.disconnect()
    today = datetime.date.today().isoformat()
    found = calibrate_slip(
        hold, unload, sensor=rig.sensor.spec.name, unit=config.sensor_unit, date=today
    )
    try:
        save_slip_calibration(flags.out, found)
    except OSError as error:
        raise UsageError(f"--out {flags.out} can't be written: {error.strerror}") from None
    console = make_console()
    console.print(f"frames     {found.num_frames}, {len(hold)} at rest and {len(unload)} unloading")
    along_um, depth_um = 1e3 * found.along_mm, 1e3 * found.depth_mm
    console.print(f"noise      {along_um:.1f} µm along the gel, {depth_um:.1f} µm into it")
    console.print(f"score      {found.largest_score:.2f} at most, without any slip")
    console.print(f"threshold  {found.threshold:.2f}, that of the model {model.threshold:.2f}")
    console.print(f"written    {flags.out}; use it with --slip-calibration {flags.out}")


def _check(flags: CalibrateSlipFlags) -> None:
    if not 1.0 <= flags.hold_s <= 60.0:
        raise UsageError(f"--hold-s must be 1 to 60, got {flags.hold_s:g}")
    if not flags.out.parent.is_dir():
        raise UsageError(f"--out {flags.out}: {flags.out.parent} is no folder")
    check_ending(flags.out, ".json")
    check_kept(flags.out, overwrite=flags.overwrite)
