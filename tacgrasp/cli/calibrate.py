"""``tacgrasp calibrate background|force|gelsight-mini|gripper|pad-axes``: bench measurements."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tacgrasp.base.errors import UsageError
from tacgrasp.cli import (
    calibrate_background,
    calibrate_force,
    calibrate_gripper,
    calibrate_pad_axes,
)
from tacgrasp.cli.calibrate_background import CalibrateBackgroundFlags
from tacgrasp.cli.calibrate_force import CalibrateForceFlags
from tacgrasp.cli.calibrate_gripper import CalibrateGripperFlags, parse_date
from tacgrasp.cli.calibrate_pad_axes import CalibratePadAxesFlags
from tacgrasp.cli.flags import run_subcommand


@dataclass(frozen=True)
class CalibrateGelsightFlags:
    """Learn heights from colours, from presses of a ball of known diameter.

    Before: press a steel ball at 20 or more places all over the gel, take one frame of each press,
    and one frame with nothing touching the gel. Learning takes about 15 s.

    Attributes:
        balls: Folder with the frames (320 × 240, colour).
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel; background.png in the folder if omitted.
        out: File to write.
        unit: Name of this unit, its serial number for instance; stored in the file.
        source: Origin of the frames; the folder's name if omitted.
        date: Date of the frames, like 2026-01-31; today if omitted.
        seed: Random seed of the training.
    """

    balls: Path
    diameter_mm: float
    background: Path | None = None
    out: Path = Path("gelsight_mini.safetensors")
    unit: str = "unnamed"
    source: str = ""
    date: str = ""
    seed: int = 0


def main(argv: Sequence[str]) -> int:
    """Run the calibration named by the first argument."""
    commands: dict[str, tuple[type[Any], Callable[[Any], int | None]]] = {
        "gelsight-mini": (CalibrateGelsightFlags, _gelsight_mini),
        "background": (CalibrateBackgroundFlags, calibrate_background.run),
        "force": (CalibrateForceFlags, calibrate_force.run),
        "gripper": (CalibrateGripperFlags, calibrate_gripper.run),
        "pad-axes": (CalibratePadAxesFlags, calibrate_pad_axes.run),
    }
    return run_subcommand("calibrate", argv, commands) or 0


def _gelsight_mini(flags: CalibrateGelsightFlags) -> None:
    if not 1.0 <= flags.diameter_mm <= 100.0:
        raise UsageError(f"--diameter-mm must be 1 to 100, got {flags.diameter_mm}")
    if not flags.out.parent.is_dir():
        raise UsageError(f"--out {flags.out}: {flags.out.parent} is no folder")
    date = parse_date(flags.date).isoformat()

    from cltp.sensing.calibration import Calibration, save_calibration
    from cltp.tactile.sensors import sensor_named
    from cltp.train.photometric import train_gradients
    from cltp.train.progress import Bar
    from tacgrasp.bringup.ball_frames import read_ball_frames
    from tacgrasp.bringup.ball_profiles import ball_profiles
    from tacgrasp.console import make_console

    sensor, console = sensor_named("gelsight_mini"), make_console()
    balls = read_ball_frames(flags.balls, sensor, flags.background)
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
            sensor=sensor.name,
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
    console.print(
        f"written   {flags.out}; check it with: tacgrasp bench balls --data {flags.balls}"
    )
