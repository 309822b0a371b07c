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
        contacts: How many.
        seed: Draws everything; below 1000000, larger ones are for benchmarks.
        workers: Processes; by default one for each core. They don't change the result.
        sensor: Whose field is pressed.
    """

    out: Path
    contacts: int = 24_000
    seed: int = 0
    workers: int | None = None
    sensor: str = "gelsight_mini"


def main(argv: Sequence[str]) -> int:
    """Dispatch to what can be done with data sets."""
    commands: dict[str, Callable[[Sequence[str]], int | None]] = {"generate": _generate, **TOOLS}
    name, rest = subcommand("data", argv, {n: c.__doc__ or "" for n, c in commands.items()})
    return 0 if name is None else commands[name](rest) or 0


def _generate(argv: Sequence[str]) -> None:
    """Make a data set of simulated contacts, or what is missing of it."""
    flags = parse(Generate, argv, prog="tacgrasp data generate")
    from tacgrasp.generate import generate

    generate(
        flags.out,
        contacts=flags.contacts,
        seed=flags.seed,
        workers=flags.workers,
        sensor_name=flags.sensor,
    )
