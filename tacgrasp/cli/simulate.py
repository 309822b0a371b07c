"""``tacgrasp simulate press``: one press of one thing into one gel."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, subcommand


@dataclass(frozen=True)
class Press:
    """Press a thing into a sensor's gel; print force, area, pressure and label.

    The file holds height_mm (H, W), + into the gel, row 0 at the top, over the whole field,
    pressure_kpa (H, W), force_n, and what the sensor would report: cloud_mm (N, 3), and with noise
    seen_mm (H, W).

    Attributes:
        object: ball:DIAMETER, cylinder:DIAMETER (lying along x) or flat:EDGE (square), in mm; or
            an object of the catalogue by name, its bare surface, in a pose that the seed draws.
        depth_mm: Its tip below the undeformed surface [mm].
        sensor: gelsight_mini, digit or gelstereo.
        x_mm: Where its tip is, + to the right of the pad's centre [mm].
        y_mm: Where its tip is, + towards the top [mm].
        turn_deg: Its rotation in the plane [°].
        grid: COLUMNSxROWS over the whole field; the sensor's own (320x240) when not given.
        noise: Of what the sensor reports: none, unit, or uncalibrated.
        seed: Draws the noise, and the pose of an object.
        device: Where to compute: cpu, cuda.
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
    """Dispatch to what can be simulated."""
    commands: dict[str, Callable[[Sequence[str]], None]] = {"press": _press}
    name, rest = subcommand("simulate", argv, {n: c.__doc__ or "" for n, c in commands.items()})
    if name is not None:
        commands[name](rest)
    return 0


def _press(argv: Sequence[str]) -> None:
    """Press a thing into a sensor's gel."""
    flags = parse(Press, argv, prog="tacgrasp simulate press")
    grid = None
    if flags.grid:
        found = re.fullmatch(r"(\d+)x(\d+)", flags.grid)
        if found is None:
            raise UsageError(f"--grid must be like 320x240, got {flags.grid!r}")
        grid = (int(found[1]), int(found[2]))
    if flags.seed < 0:
        raise UsageError(f"--seed must not be negative, got {flags.seed}")
    if flags.out is not None and not flags.out.parent.is_dir():
        raise UsageError(f"--out {flags.out}: {flags.out.parent} is no folder")
    from tacgrasp.datasets.press import Request, run

    run(
        Request(
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
