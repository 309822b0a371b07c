"""``tacgrasp eval ablate``: what the language model does without a part of its input."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import write_result
from tacgrasp.cli.flags import contacts_in, parse, writable


@dataclass(frozen=True)
class AblateFlags:
    """Leave out tokens, readings or goal, or swap them with another contact's, and compare.

    Attributes:
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
        data: Folder of contacts, whose test split is used; a few are made when not given.
        blind: Folder of an instruction-blind copy (tacgrasp train llm --blind-of).
        contacts: Number of contacts.
        episodes: Number of simulated strawberry episodes of each condition; 0 for none.
        seed: Random seed of contacts, noise, goals and swaps.
        json: JSON file for the figures.
    """

    weights: Path | None = None
    data: Path | None = None
    blind: Path | None = None
    contacts: int = 100
    episodes: int = 4
    seed: int = 0
    json: Path | None = None

    def __post_init__(self) -> None:
        if self.contacts < 2 or self.episodes < 0:
            raise UsageError("--contacts must be at least 2, --episodes at least 0")


def main(argv: Sequence[str]) -> None:
    """Measure every condition and print them beside each other."""
    flags = parse(AblateFlags, argv, prog="tacgrasp eval ablate")
    writable(flags.json)
    if flags.data is not None:
        contacts_in(flags.data, command="tacgrasp data generate --set full")
    from cltp.train.progress import Bar
    from tacgrasp.policy_factory import default_weights
    from tacgrasp.training.ablation.evaluate import ablate

    with Bar(line_s=10.0) as report:
        results = ablate(
            flags.weights or default_weights(),
            data=flags.data,
            blind=flags.blind,
            num_contacts=flags.contacts,
            num_episodes=flags.episodes,
            seed=flags.seed,
            report=report,
        )
    _show(results)
    if flags.json is not None:
        write_result(flags.json, results)


def _show(results: Mapping[str, Any]) -> None:
    from rich.table import Table

    from cltp.tactile.states import CLASSES
    from tacgrasp.console import make_table_console

    console = make_table_console()
    columns = ("", *CLASSES, "action", "in doubt", "verified", "bruised")
    table = Table(*columns, title=f"% right, {results['contacts']} contacts, noisy")
    for name, figures in results["replies"].items():
        episodes = results["episodes"].get(name, {})
        table.add_row(
            name,
            *(_percent(figures["words"][dimension]) for dimension in CLASSES),
            _percent(figures["actions"]),
            _percent(figures["doubtful"]),
            _percent(episodes.get("verified_success_rate")),
            _percent(episodes.get("bruised_rate")),
        )
    console.print(table)
    misread = results["misreadings"]
    console.print(
        f"a head misreads {misread['contacts']} contacts: its word is right in "
        f"{_percent(misread['right'])} % of the replies (before {_percent(misread['right_before'])}"
        f" %), the misread one in {_percent(misread['follows'])} %"
    )


def _percent(fraction: float | None) -> str:
    return "-" if fraction is None else f"{100 * fraction:.1f}"
