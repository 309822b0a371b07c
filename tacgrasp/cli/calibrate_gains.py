"""``tacgrasp calibrate gains``: x and y gains of another unit's calibration, from a few presses."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_ending, check_kept
from tacgrasp.cli.calibrate_gripper import parse_date

if TYPE_CHECKING:
    from cltp.sensing.ball_gains import Gains


@dataclass(frozen=True)
class CalibrateGainsFlags:
    """Correct how steep another unit's calibration reads your gel in x and in y.

    Press a steel ball at 3 to 8 places, one frame each, and take one frame of the untouched gel.
    The corrected calibration is written, as it was where no gain differs from 1. Where gains alone
    don't explain the presses, nothing is written: then press at 20 places and run tacgrasp
    calibrate gelsight-mini.

    Attributes:
        balls: Folder with the frames (320 × 240, colour).
        diameter_mm: Diameter of the ball [mm].
        calibration: Calibration of the other unit. Default: the shipped one.
        background: Frame of the untouched gel; background.png in the folder if omitted.
        out: File to write.
        unit: Name of this unit, its serial number for instance; stored in the file.
        date: Date of the frames, like 2026-01-31; today if omitted.
        overwrite: Replace an existing file.
    """

    balls: Path
    diameter_mm: float
    calibration: Path | None = None
    background: Path | None = None
    out: Path = Path("gelsight_mini.safetensors")
    unit: str = "unnamed"
    date: str = ""
    overwrite: bool = False


def check_ball_flags(diameter_mm: float, out: Path, *, overwrite: bool) -> None:
    """Check what every calibration on presses of a ball is told.

    Raises:
        UsageError: No such ball, no folder for ``out``, or ``out`` is no .safetensors, or exists.
    """
    if not 1.0 <= diameter_mm <= 100.0:
        raise UsageError(f"--diameter-mm must be 1 to 100, got {diameter_mm}")
    if not out.parent.is_dir():
        raise UsageError(f"--out {out}: {out.parent} is no folder")
    check_ending(out, ".safetensors")
    check_kept(out, overwrite=overwrite)


def run(flags: CalibrateGainsFlags) -> int:
    """Measure and print the gains, write the corrected calibration; 1 where they don't explain."""
    check_ball_flags(flags.diameter_mm, flags.out, overwrite=flags.overwrite)
    date = parse_date(flags.date).isoformat()

    from dataclasses import replace

    from cltp.sensing.ball_gains import corrected, measure_gains
    from cltp.sensing.calibration import default_calibration, load_calibration, save_calibration
    from cltp.sensing.photometric import Photometer
    from cltp.tactile.sensors import sensor_named
    from tacgrasp.bringup.ball_frames import read_ball_frames
    from tacgrasp.console import make_console

    sensor, console = sensor_named("gelsight_mini"), make_console()
    other = load_calibration(flags.calibration or default_calibration(sensor), sensor)
    balls = read_ball_frames(flags.balls, sensor, flags.background)
    photometer = Photometer(other.net, balls.background, sensor)
    gains = measure_gains(photometer, balls.frames, balls.background, flags.diameter_mm)
    for index, reason in gains.rejected.items():
        console.print(f"left out  {balls.names[index]}: {reason}")
    for line in lines_of(gains):
        console.print(line)
    if not gains.explain:
        console.print(
            "flagged   gains don't explain these presses: nothing is written; calibrate this unit "
            "from 20 presses: tacgrasp calibrate gelsight-mini"
        )
        return 1
    net, taken = other.net, f"{other.unit}, as it was"
    if gains.are_off():
        net = corrected(other.net, gains)
        taken = f"{other.unit}, gains x {gains.x:.3f} and y {gains.y:.3f} taken out"
    save_calibration(
        flags.out,
        replace(
            other,
            net=net,
            unit=flags.unit,
            date=date,
            ball_diameter_mm=flags.diameter_mm,
            num_frames=len(gains.presses),
            source=taken,
        ),
    )
    console.print(f"written   {flags.out}: {taken}")
    return 0


def lines_of(gains: Gains) -> list[str]:
    """What is printed of some gains."""
    verdict = "these differ from 1" if gains.are_off() else "no different from 1"
    return [
        f"presses   {len(gains.presses)}",
        f"gains     x {gains.x:.3f} ± {100 * gains.error_x:.1f} %, y {gains.y:.3f} ± "
        f"{100 * gains.error_y:.1f} %: {verdict}",
        f"a ball    is read {1 / gains.ratio:.3f} times as wide in x as in y",
        f"misfit    {100 * gains.misfit:.0f} % of the slopes under the ball, with these gains",
    ]
