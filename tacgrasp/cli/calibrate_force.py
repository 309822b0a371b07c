"""``tacgrasp calibrate force``: the factor from what a sensor reads to newtons, by known loads."""

from __future__ import annotations

import datetime
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from tacgrasp.base.errors import UsageError

if TYPE_CHECKING:
    from rich.console import Console

    from cltp.sensing.force_calibration import ForceCalibration
    from tacgrasp.bringup.force_loads import LoadSource
    from tacgrasp.config.schema import RunConfig
    from tacgrasp.rig.protocols import TactileSensor


@dataclass(frozen=True)
class CalibrateForceFlags:
    """Find the newtons of this unit's gel: put known loads on its pad, one after another.

    Gels differ in stiffness from unit to unit, so that forces read without this calibration are
    off by a third. Use a round tip (a ball of about 15 mm) under the weights, in the middle of the
    pad. With --by gripper, the calibrated gripper closes on a round firm object instead. The world
    of a simulated or emulated rig puts the loads itself and knows their force.

    Attributes:
        rig: Name of a rig, or path of its YAML file.
        loads: Loads [N], rising; at least three, the largest three times the smallest or more.
        by: What loads the pad: weights that you put on it, or the rig's calibrated gripper.
        out: File to write; the one named in the rig's file if omitted, else
            force_calibration.json.
        overwrite: Replace an existing file, once the new calibration is complete.
        resume: Continue a measurement of the same loads that was interrupted.
        object: Object between the fingers of a simulated or emulated rig.
        seed: Random seed of the simulated or emulated world.
    """

    rig: str = "sim"
    loads: tuple[float, ...] = (0.5, 1.0, 2.0, 5.0)
    by: Literal["weights", "gripper"] = "weights"
    out: Path | None = None
    overwrite: bool = False
    resume: bool = False
    object: str = "egg"
    seed: int = 0


def run(flags: CalibrateForceFlags) -> None:
    """Measure, fit, write the calibration and say what to do next."""
    from cltp.errors import TouchError
    from cltp.sensing.force_calibration import check_load_values, fit_force
    from tacgrasp.bringup.force_loads import UnfinishedLoads, measure_loads
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console

    try:
        check_load_values(flags.loads)
    except TouchError as error:
        raise UsageError(f"--loads: {error}") from None
    config, _ = load(None, flags.rig, os.environ)
    config = config.model_copy(update={"object": flags.object, "seed": flags.seed})
    named = None if config.hardware is None else config.hardware.sensor.force_calibration
    out = flags.out or named or Path("force_calibration.json")
    sensor, unit = config.sensor, unit_of(config)
    unfinished = UnfinishedLoads(out=out, sensor=sensor, unit=unit, loads_n=flags.loads)
    _check_paths(flags, out, unfinished.path)
    measured = unfinished.read() if flags.resume else []
    console = make_console()
    with _loaded(flags, config) as (device, source, origin):
        try:
            readings = measure_loads(
                device,
                source,
                flags.loads,
                report=console.print,
                keep=unfinished.keep,
                measured=measured,
            )
        except (Exception, KeyboardInterrupt):
            if unfinished.path.exists():
                console.print(f"kept      {unfinished.path}; continue with --resume")
            raise
    try:
        calibration = fit_force(
            readings, sensor=sensor, unit=unit, date=datetime.date.today(), source=origin
        )
    except TouchError as error:
        raise UsageError(
            f"{error} (the readings are kept in {unfinished.path}; measure anew with --overwrite)"
        ) from None
    _write(out, calibration)
    unfinished.drop()
    _print(console, calibration, out, _next(flags, config, out))


def unit_of(config: RunConfig) -> str:
    """Name of the sensor's unit in its calibration."""
    return "simulated" if config.hardware is None else config.hardware.sensor.unit


def _check_paths(flags: CalibrateForceFlags, out: Path, unfinished: Path) -> None:
    """Refuse, before anything is measured, to write nowhere or over what is there."""
    if not out.parent.is_dir():
        raise UsageError(f"the calibration can't be written to {out}: {out.parent} is no folder")
    if out.exists() and not flags.overwrite:
        raise UsageError(
            f"{out} exists and is kept; give --overwrite to replace it, or another file by --out"
        )
    if unfinished.exists() and not (flags.overwrite or flags.resume):
        raise UsageError(
            f"{unfinished} holds the readings of an interrupted measurement; continue it with "
            "--resume, or measure anew with --overwrite"
        )


def _write(out: Path, calibration: ForceCalibration) -> None:
    from cltp.sensing.force_calibration import save_force_calibration

    try:
        save_force_calibration(out, calibration)
    except OSError as error:
        raise UsageError(
            f"the calibration can't be written to {out}: {error.strerror or error}; give --out and "
            "--resume"
        ) from None


@contextmanager
def _loaded(
    flags: CalibrateForceFlags, config: RunConfig
) -> Iterator[tuple[TactileSensor, LoadSource, str]]:
    """The sensor, what loads it, and the origin of the loads in words."""
    from tacgrasp.bringup.force_loads import GripperLoads, PersonLoads, WorldLoads
    from tacgrasp.rig.factory import make_centred_rig
    from tacgrasp.rig.hardware import RealClock, connect_sensor

    if config.devices != "hardware" or config.hardware is None:
        rig = make_centred_rig(config)
        try:
            yield rig.sensor, WorldLoads(rig), f"{flags.object} in the {config.devices} world"
        finally:
            rig.disconnect()
        return
    if flags.by == "weights" and not sys.stdin.isatty():
        raise UsageError(
            "weights need a person at a terminal; run it on one, or give --by gripper, whose "
            "calibration knows the force"
        )
    # a new unit has no calibration yet, and an old one must not be needed to replace it
    settings = config.hardware.sensor.model_copy(update={"force_calibration": None})
    sensor = connect_sensor(settings)
    try:
        if flags.by == "weights":
            yield sensor, PersonLoads(_ask), "weights on the pad"
            return
        from tacgrasp.drivers.dynamixel.gripper import connect_gripper

        gripper = connect_gripper(config.hardware.dynamixel_gripper)
        try:
            yield sensor, GripperLoads(gripper, RealClock()), "the calibrated gripper"
        finally:
            gripper.disconnect()
    finally:
        sensor.disconnect()


def _ask(prompt: str) -> None:
    try:
        input(prompt)
    except EOFError:
        raise UsageError("the input ended before all loads were on the pad") from None


def _print(console: Console, calibration: ForceCalibration, out: Path, advice: str) -> None:
    console.print(f"{'load [N]':>10}{'read [nominal N]':>18}{'fitted [N]':>12}{'residual':>10}")
    for load, residual in zip(calibration.loads, calibration.residuals, strict=True):
        fitted = calibration.factor * load.read_n
        console.print(f"{load.load_n:10.3f}{load.read_n:18.3f}{fitted:12.3f}{residual:+10.1%}")
    console.print(f"factor    {calibration.factor:.4f} N per nominal N, {calibration.source}")
    console.print(f"residual  {calibration.spread:.1%} (standard deviation)")
    console.print(f"written   {out}, for {calibration.unit} ({calibration.sensor})")
    console.print(f"next      {advice}")


def _next(flags: CalibrateForceFlags, config: RunConfig, out: Path) -> str:
    if config.devices != "hardware" or config.hardware is None:
        return (
            "nothing: a simulated or emulated rig carries a calibration of its own, drawn from its "
            "seed"
        )
    check = f"tacgrasp doctor --rig {flags.rig}"
    if config.hardware.sensor.force_calibration == out:
        return check
    line = f"force_calibration: {out.resolve()}"
    return f"in {flags.rig}, under hardware.sensor: {line}; then {check}"
