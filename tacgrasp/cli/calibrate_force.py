"""``tacgrasp calibrate force``: the factor from what a sensor reads to newtons, by known loads."""

from __future__ import annotations

import datetime
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_kept

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
    pad. With --by gripper, the calibrated gripper closes on a round firm object instead, with no
    more than the rig's gripper.max_force_n, and is opened again, after Ctrl-C too; it must be open
    at the start. The world of a simulated or emulated rig puts the loads itself and knows their
    force, whatever --by says.

    Attributes:
        rig: Name of a rig, or path of its YAML file.
        loads: Loads [N], rising; at least three, the largest three times the smallest or more. By
            default 0.5 1 2 5, with a gripper up to the rig's limit.
        by: What loads the pad: weights that you put on it, or the rig's calibrated gripper.
        out: File to write; the one named in the rig's file if omitted, else
            force_calibration.json.
        overwrite: Replace an existing file, once the new calibration is complete.
        resume: Continue a measurement of the same loads that was interrupted.
        object: Object between the fingers of a simulated or emulated rig.
        seed: Random seed of the simulated or emulated world.
    """

    rig: str = "sim"
    loads: tuple[float, ...] | None = None
    by: Literal["weights", "gripper"] = "weights"
    out: Path | None = None
    overwrite: bool = False
    resume: bool = False
    object: str = "egg"
    seed: int = 0


def run(flags: CalibrateForceFlags) -> None:
    """Measure, fit, write the calibration and say what to do next."""
    from cltp.errors import TouchError
    from cltp.sensing.force_calibration import fit_force
    from tacgrasp.bringup.force_loads import UnfinishedLoads, measure_loads
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console

    config, _ = load(None, flags.rig, os.environ)
    loads_n, remark = _loads(flags, config)
    config = config.model_copy(update={"object": flags.object, "seed": flags.seed})
    named = None if config.hardware is None else config.hardware.sensor.force_calibration
    out = flags.out or named or Path("force_calibration.json")
    sensor, unit = config.sensor, config.sensor_unit
    unfinished = UnfinishedLoads(out=out, sensor=sensor, unit=unit, loads_n=loads_n)
    _check_paths(flags, out, unfinished.path)
    measured = unfinished.read() if flags.resume else []
    console = make_console()
    if remark:
        console.print(f"loads     {remark}")
    with _loaded(flags, config, loads_n) as (device, source, origin):
        try:
            readings = measure_loads(
                device,
                source,
                loads_n,
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


def _has_world(config: RunConfig) -> bool:
    """Whether a simulated or emulated world puts the loads."""
    return config.devices != "hardware" or config.hardware is None


def _loads(flags: CalibrateForceFlags, config: RunConfig) -> tuple[tuple[float, ...], str]:
    """Loads [N] within the rig's limits, and what the operator should know of them.

    Raises:
        UsageError: They make no calibration, or a gripper would press beyond the limits.
    """
    from cltp.errors import TouchError
    from cltp.sensing.force_calibration import check_load_values
    from tacgrasp.bringup.force_loads import LOADS_N, check_within, default_loads

    limits, by_world = config.gripper, _has_world(config)
    by_gripper = by_world or flags.by == "gripper"
    loads_n, remarks = flags.loads, []
    if loads_n is None:
        loads_n = default_loads(limits.max_force_n) if by_gripper else LOADS_N
        if loads_n != LOADS_N:
            listed = " ".join(f"{load_n:g}" for load_n in loads_n)
            remarks.append(f"{listed} N, up to gripper.max_force_n {limits.max_force_n:g} N")
    try:
        check_load_values(loads_n)
    except TouchError as error:
        raise UsageError(f"--loads: {error}") from None
    if by_gripper:
        whose = f"gripper.min_force_n to max_force_n of {flags.rig}"
        check_within(loads_n, limits.min_force_n, limits.max_force_n, whose)
    if by_world and flags.by == "gripper":
        remarks.append(
            f"put by the {config.devices} world, which knows their true force; --by gripper is for "
            "real devices"
        )
    return loads_n, "; ".join(remarks)


def _check_paths(flags: CalibrateForceFlags, out: Path, unfinished: Path) -> None:
    """Refuse, before anything is measured, to write nowhere or over what is there."""
    if not out.parent.is_dir():
        raise UsageError(f"the calibration can't be written to {out}: {out.parent} is no folder")
    check_kept(out, overwrite=flags.overwrite)
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
    flags: CalibrateForceFlags, config: RunConfig, loads_n: Sequence[float]
) -> Iterator[tuple[TactileSensor, LoadSource, str]]:
    """The sensor, what loads it, and the origin of the loads in words."""
    from tacgrasp.bringup.force_loads import GripperLoads, PersonLoads, WorldLoads, check_within
    from tacgrasp.rig.factory import make_centred_rig
    from tacgrasp.rig.gel_sense import prepare
    from tacgrasp.rig.hardware import RealClock, connect_sensor

    if config.hardware is None or _has_world(config):
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
        from tacgrasp.drivers.opening import check_open

        prepare(sensor)
        gripper = connect_gripper(config.hardware.dynamixel_gripper)
        try:
            check_open(gripper)
            whose = "what the gripper's calibration and max_current_ma allow"
            check_within(loads_n, 0.0, gripper.max_force_n, whose)
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
    if config.hardware is None or _has_world(config):
        return (
            "nothing: a simulated or emulated rig carries a calibration of its own, drawn from its "
            "seed"
        )
    check = f"tacgrasp doctor --rig {flags.rig}"
    if config.hardware.sensor.force_calibration == out:
        return check
    line = f"force_calibration: {out.resolve()}"
    return f"in {flags.rig}, under hardware.sensor: {line}; then {check}"
