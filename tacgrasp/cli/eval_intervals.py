"""``tacgrasp eval intervals``: errors of the heads' numbers, how often they and words hold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import write_result
from tacgrasp.cli.flags import contacts_in, parse, writable

MEDIANS = {
    "depth_mm": "depth mm",
    "place_mm": "place mm",
    "area_percent": "area %",
    "force_percent": "force %",
    "light_force_n": "below 1 N",
    "scale_x": "x read / true",
    "scale_y": "y read / true",
    "scale_area": "area read / true",
}
INTERVALS = {"depth_mm": "depth", "x_mm": "x", "y_mm": "y", "area_fraction": "area"} | {
    "force_n": "force"
}


@dataclass(frozen=True)
class IntervalFlags:
    """Measure errors and intervals of the numbers that the heads read, and how sure words are.

    Attributes:
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
        data: Folder of contacts, as tacgrasp data generate --set full made it.
        contacts: Most contacts of each group.
        seed: Random seed of choice, noise and units.
        json: JSON file for the figures.
    """

    weights: Path | None = None
    data: Path = Path("runs/full")
    contacts: int = 1000
    seed: int = 0
    json: Path | None = None

    def __post_init__(self) -> None:
        if self.contacts < 20:
            raise UsageError(f"--contacts must be at least 20, got {self.contacts}")


def main(argv: Sequence[str]) -> None:
    """Measure and print."""
    flags = parse(IntervalFlags, argv, prog="tacgrasp eval intervals")
    writable(flags.json)
    contacts_in(flags.data, command="tacgrasp data generate --set full")
    from cltp.train.progress import Bar
    from tacgrasp.benchmarks.transfer.intervals import evaluate_intervals
    from tacgrasp.policy_factory import default_weights

    weights = flags.weights or default_weights()
    with Bar(line_s=10.0) as report:
        found = evaluate_intervals(
            weights, flags.data, num=flags.contacts, seed=flags.seed, report=report
        )
    _show(found["groups"])
    if flags.json is not None:
        write_result(flags.json, found)


def _show(groups: dict[str, Any]) -> None:
    from rich.table import Table

    from tacgrasp.console import make_table_console

    inside = [f"{word} in, %" for word in INTERVALS.values()]
    wide = [f"{word} width" for word in INTERVALS.values()]
    table = Table("median errors; intervals", *MEDIANS.values(), *inside, *wide, "n")
    for name, one in groups.items():
        row = [_shown(one[key]) for key in MEDIANS]
        row += [_shown(one["inside"][key], 1) for key in INTERVALS]
        row += [_shown(one["width"][key]) for key in INTERVALS]
        table.add_row(name, *row, str(one["n"]))
    rival = groups[next(iter(groups))]["trivial"]
    row = [_shown(rival.get(key)) for key in MEDIANS] + ["90"] * len(INTERVALS)
    row += [_shown(rival["width"][key]) for key in INTERVALS]
    table.add_row("one answer to all seen", *row, "")
    console = make_table_console()
    console.print(table)
    first = next(iter(groups.values()))["words"]
    words = Table("words right / how sure, %", *first, "n")
    for name, one in groups.items():
        said = [
            f"{_shown(each['right'], 1)} / {_shown(each['confidence'], 0)}"
            for each in one["words"].values()
        ]
        words.add_row(name, *said, str(one["n"]))
    console.print(words)
    console.print("widths are medians over those of seen objects")


def _shown(value: float | None, digits: int = 3) -> str:
    return "-" if value is None else f"{value:.{digits}f}"
