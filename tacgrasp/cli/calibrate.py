"""``tacgrasp calibrate NAME``: bench measurements of sensor, gripper and mounting."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tacgrasp.cli import (
    calibrate_background,
    calibrate_force,
    calibrate_gains,
    calibrate_gripper,
    calibrate_pad_axes,
    calibrate_slip,
)
from tacgrasp.cli.calibrate_background import CalibrateBackgroundFlags
from tacgrasp.cli.calibrate_force import CalibrateForceFlags
from tacgrasp.cli.calibrate_gains import CalibrateGainsFlags, check_ball_flags
from tacgrasp.cli.calibrate_gripper import CalibrateGripperFlags, parse_date
from tacgrasp.cli.calibrate_pad_axes import CalibratePadAxesFlags
from tacgrasp.cli.calibrate_slip import CalibrateSlipFlags
from tacgrasp.cli.flags import run_subcommand


@dataclass(frozen=True)
class CalibrateGelsightFlags:
    """Learn heights from colours, from presses of a ball of known diameter.

    Before: press a steel ball at 20 or more places all over the gel, take one frame of each press,
    and one frame with nothing touching the gel. Learning takes about 20 s of one core.

    Attributes:
        balls: Folder with the frames (320 × 240, colour).
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel; background.png in the folder if omitted.
        out: File to write.
        unit: Name of this unit, its serial number for instance; stored in the file.
        source: Origin of the frames; the folder's name if omitted.
        date: Date of the frames, like 2026-01-31; today if omitted.
        seed: Random seed of the training.
        presses: Number of presses to calibrate on, those that lie farthest from each other; the
            others are measured. All are calibrated on if omitted.
        dots: Whether the gel has the 7 × 9 dots of gelsight_mini_markers; they are painted over.
        overwrite: Replace an existing file.
    """

    balls: Path
    diameter_mm: float
    background: Path | None = None
    out: Path = Path("gelsight_mini.safetensors")
    unit: str = "unnamed"
    source: str = ""
    date: str = ""
    seed: int = 0
    presses: int | None = None
    dots: bool = False
    overwrite: bool = False


def main(argv: Sequence[str]) -> int:
    """Run the calibration named by the first argument."""
    commands: dict[str, tuple[type[Any], Callable[[Any], int | None]]] = {
        "gelsight-mini": (CalibrateGelsightFlags, _gelsight_mini),
        "background": (CalibrateBackgroundFlags, calibrate_background.run),
        "force": (CalibrateForceFlags, calibrate_force.run),
        "gains": (CalibrateGainsFlags, calibrate_gains.run),
        "gripper": (CalibrateGripperFlags, calibrate_gripper.run),
        "pad-axes": (CalibratePadAxesFlags, calibrate_pad_axes.run),
        "slip": (CalibrateSlipFlags, calibrate_slip.run),
    }
    return run_subcommand("calibrate", argv, commands) or 0


def _gelsight_mini(flags: CalibrateGelsightFlags) -> None:
    check_ball_flags(flags.diameter_mm, flags.out, overwrite=flags.overwrite)
    date = parse_date(flags.date).isoformat()

    from cltp.sensing.calibration import Calibration, calibrated_as, save_calibration
    from cltp.sensing.photometric import Photometer
    from cltp.tactile.sensors import sensor_named
    from cltp.train.photometric.calibrate import train_gradients
    from cltp.train.progress import Bar
    from tacgrasp.bringup.ball_frames import read_ball_frames
    from tacgrasp.bringup.ball_profiles import ball_profiles
    from tacgrasp.bringup.ball_spread import held_out_line, spread_presses
    from tacgrasp.console import make_console

    sensor, console = sensor_named("gelsight_mini"), make_console()
    if flags.dots:
        sensor = sensor_named("gelsight_mini_markers")
    balls = read_ball_frames(flags.balls, sensor, flags.background)
    others = None
    if flags.presses is not None:
        balls, others = spread_presses(balls, sensor, flags.diameter_mm, flags.presses)
    with Bar(sys.stderr) as bar:
        trained = train_gradients(
            balls.frames,
            balls.background,
            sensor,
            flags.diameter_mm,
            profiles=ball_profiles(sensor.name, flags.diameter_mm),
            seed=flags.seed,
            report=lambda step, steps: bar("calibrating", step, steps, {}),
        )
    for index, reason in trained.rejected.items():
        console.print(f"left out  {balls.names[index]}: {reason}")
    save_calibration(
        flags.out,
        Calibration(
            net=trained.net,
            sensor=calibrated_as(sensor),
            unit=flags.unit,
            date=date,
            ball_diameter_mm=flags.diameter_mm,
            num_frames=len(trained.presses),
            residual=trained.residual,
            seed=flags.seed,
            source=flags.source or flags.balls.resolve().name,
        ),
    )
    depths = sorted(press.depth_mm for press in trained.presses)
    console.print(f"frames    {len(trained.presses)} of {len(balls.frames)}")
    console.print(f"presses   {depths[0]:.2f} to {depths[-1]:.2f} mm deep")
    console.print(f"residual  {trained.residual:.3f} mm per mm, slopes around the ball")
    if others is not None:
        photometer = Photometer(trained.net, balls.background, sensor)
        console.print(held_out_line(others, photometer, flags.diameter_mm))
    console.print(
        f"written   {flags.out}; check it with: tacgrasp bench balls --data {flags.balls}"
    )
