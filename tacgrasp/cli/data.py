"""``tacgrasp data``: make contacts to learn from, and look into them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.cli.data_tools import TOOLS
from tacgrasp.cli.flags import parse, subcommand


@dataclass(frozen=True)
class Generate:
    """Make a data set of simulated contacts; the same command goes on where it was stopped.

    Attributes:
        out: Folder; made when missing.
        set: 'tcl3d': 117 objects, splits and further domains; 'starter': what the weights that
            come along were trained on.
        contacts: How many; by default all: 52425 of tcl3d, 24000 of starter.
        seed: Draws everything; below 1000000, larger ones are for benchmarks.
        shard: Only part i of n, as i/n, 1/4 to 4/4: for several machines. Copy the files of all
            parts into one folder and run the command once more without it.
        workers: Processes; by default one for each core. They don't change the result.
        meshes: Folder of meshes (PLY, OBJ, STL; mm) whose contacts are added; only for tcl3d.
        device: Where to compute: 'cpu' or 'cuda'; only for tcl3d.
        sensor: Whose field is pressed; only for starter.
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


def main(argv: Sequence[str]) -> int:
    """Dispatch to what can be done with data sets."""
    commands: dict[str, Callable[[Sequence[str]], int | None]] = {"generate": _generate, **TOOLS}
    name, rest = subcommand("data", argv, {n: c.__doc__ or "" for n, c in commands.items()})
    return 0 if name is None else commands[name](rest) or 0


def _generate(argv: Sequence[str]) -> None:
    """Make a data set of simulated contacts, or what is missing of it."""
    flags = parse(Generate, argv, prog="tacgrasp data generate")
    from tacgrasp.datasets.generate import generate

    generate(
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
