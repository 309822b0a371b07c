"""``tacgrasp data NAME``: make data sets of contacts, and look into them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tacgrasp.cli import data_import, data_tools
from tacgrasp.cli.flags import run_subcommand


@dataclass(frozen=True)
class GenerateFlags:
    """Make a data set of simulated contacts. The same command continues an interrupted one.

    Attributes:
        out: Folder of the data set; created when missing.
        set: tcl3d: 117 objects with splits and further domains. starter: part of what the shipped
            weights were trained on.
        contacts: Number of contacts. Default: all, which is 52425 for tcl3d and 24000 for starter.
        seed: Random seed of the whole set, below 1000000. Larger seeds belong to the benchmarks.
        shard: Part i of n as i/n, to share the work among machines. Afterwards copy the files of
            all parts into one folder and run the command once more without --shard.
        workers: Number of processes, one per core by default. It does not change the result.
        meshes: Folder of meshes (PLY, OBJ, STL; mm) to press as well (tcl3d only).
        device: Device for the computation: cpu or cuda (tcl3d only).
        sensor: Sensor whose gel is pressed (starter only).
    """

    out: Path
    set: str = "tcl3d"
    contacts: int | None = None
    seed: int = 0
    shard: str | None = None
    workers: int | None = None
    meshes: Path | None = None
    device: str = "cpu"
    sensor: str = "gelsight_mini"


def generate(flags: GenerateFlags) -> None:
    """Make a data set, or what is missing of it."""
    from tacgrasp.datasets.generate import generate as make

    make(
        flags.out,
        contacts=flags.contacts,
        seed=flags.seed,
        workers=flags.workers,
        sensor_name=flags.sensor,
        set_name=flags.set,
        meshes=flags.meshes,
        shard=flags.shard,
        device=flags.device,
    )


COMMANDS: dict[str, tuple[type[Any], Callable[[Any], int | None]]] = {
    "generate": (GenerateFlags, generate),
    "inspect": (data_tools.InspectFlags, data_tools.inspect),
    "stats": (data_tools.StatsFlags, data_tools.stats),
    "verify": (data_tools.VerifyFlags, data_tools.verify),
    "gallery": (data_tools.GalleryFlags, data_tools.gallery),
    "sheet": (data_tools.SheetFlags, data_tools.sheet),
    "import": (data_import.ImportFlags, data_import.import_table),
}
"""Flags and function of each subcommand; the function returns the exit code, None for 0."""


def main(argv: Sequence[str]) -> int:
    """Run one subcommand and return its exit code."""
    return run_subcommand("data", argv, COMMANDS) or 0
