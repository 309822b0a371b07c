"""``tacgrasp simulate press``: press one object into one sensor's gel."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, subcommand


@dataclass(frozen=True)
class PressFlags:
    """Press an object into a sensor's gel; print force, area, pressure and label.

    The file of --out holds height_mm (H, W), positive into the gel, row 0 at the top, over the
    whole sensing area; pressure_kpa (H, W); force_n; what the sensor would report as cloud_mm
    (N, 3); and with noise its heights seen_mm (H, W).

    Attributes:
        object: ball:DIAMETER, cylinder:DIAMETER (lying along x) or flat:EDGE (square), in mm; or
            the name of an object of the catalogue, in a random pose.
        depth_mm: Depth of the object's tip below the undeformed surface [mm].
        sensor: Sensor: gelsight_mini, digit or gelstereo.
        x_mm: Position of the tip, positive to the right of the pad's centre [mm].
        y_mm: Position of the tip, positive towards the top of the pad [mm].
        turn_deg: Rotation of the object in the plane of the pad [deg].
        grid: Grid over the sensing area, COLUMNSxROWS. Default: the sensor's own, 320x240.
        noise: Noise of the sensor: none, unit (a calibrated unit) or uncalibrated.
        seed: Random seed of the noise and of the pose of a catalogue object.
        device: Device for the computation: cpu or cuda.
        out: File to write (.npz).
    """

    object: str
    depth_mm: float
    sensor: str = "gelsight_mini"
    x_mm: float = 0.0
    y_mm: float = 0.0
    turn_deg: float = 0.0
    grid: str = ""
    noise: str = "none"
    seed: int = 0
    device: str = "cpu"
    out: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Run one subcommand and return its exit code."""
    name, rest = subcommand("simulate", argv, {"press": PressFlags.__doc__ or ""})
    if name is not None:
        _press(parse(PressFlags, rest, prog="tacgrasp simulate press"))
    return 0


def _press(flags: PressFlags) -> None:
    grid = None
    if flags.grid:
        match = re.fullmatch(r"(\d+)x(\d+)", flags.grid)
        if match is None:
            raise UsageError(f"--grid must be like 320x240, got {flags.grid!r}")
        grid = (int(match[1]), int(match[2]))
    if flags.seed < 0:
        raise UsageError(f"--seed must not be negative, got {flags.seed}")
    if flags.out is not None and not flags.out.parent.is_dir():
        raise UsageError(f"--out {flags.out}: {flags.out.parent} is not a folder")
    from tacgrasp.datasets.press import PressRequest, run

    run(
        PressRequest(
            object=flags.object,
            depth_mm=flags.depth_mm,
            sensor=flags.sensor,
            x_mm=flags.x_mm,
            y_mm=flags.y_mm,
            turn_deg=flags.turn_deg,
            grid=grid,
            noise=flags.noise,
            seed=flags.seed,
            device=flags.device,
        ),
        flags.out,
    )
