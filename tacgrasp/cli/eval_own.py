"""``tacgrasp eval own``: one table of what weights read in one's own contacts and in ours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import write_result
from tacgrasp.cli.flags import contacts_in, parse, writable

if TYPE_CHECKING:
    from tacgrasp.training.own_contacts import OwnScores

TITLES = {"own": "your own, held out", "ours": "ours"}


@dataclass(frozen=True)
class OwnFlags:
    """Measure weights on one's own held-out contacts and on ours, before and after training on.

    Attributes:
        weights: Folder of the weights after training on: of tacgrasp train llm, or of tacgrasp
            train cltp, which has no captions yet.
        also: Folder of one's own contacts, whose test split is used.
        data: Folder of our contacts, whose test split is used with noise.
        before: Folder of the weights before, or the word shipped.
        contacts: Largest number of contacts of each.
        seed: Random seed of the choice of contacts and of the noise.
        threads: Threads of torch.
        json: JSON file for the figures.
    """

    weights: Path
    also: Path
    data: Path = Path("runs/full")
    before: Path = Path("shipped")
    contacts: int = 500
    seed: int = 0
    threads: int = 1
    json: Path | None = None

    def __post_init__(self) -> None:
        if min(self.contacts, self.threads) < 1:
            raise UsageError("--contacts and --threads must be at least 1")


def main(argv: Sequence[str]) -> None:
    """Your own held-out contacts and ours, before and after training on, in one table."""
    flags = parse(OwnFlags, argv, prog="tacgrasp eval own")
    writable(flags.json)
    contacts_in(flags.data, command="tacgrasp data generate --set full")
    if flags.also.resolve() == flags.data.resolve():
        raise UsageError(
            f"--also {flags.also} is the folder of --data too; name that of your own contacts"
        )
    import torch

    from cltp.train.progress import Bar
    from tacgrasp.policy_factory import named_weights
    from tacgrasp.training.own_contacts import OwnEvaluation, evaluate_own, figures

    torch.set_num_threads(flags.threads)
    run = OwnEvaluation(
        data=flags.data,
        also=flags.also,
        before=named_weights(flags.before) or flags.before,
        after=flags.weights,
        contacts=flags.contacts,
        seed=flags.seed,
    )
    with Bar(line_s=10.0) as report:
        rows = evaluate_own(run, report)
    _show(rows)
    if flags.json is not None:
        write_result(flags.json, {"rows": figures(rows)})


def _show(rows: Sequence[OwnScores]) -> None:
    from rich.table import Table

    from cltp.tactile.states import CLASSES
    from tacgrasp.console import make_table_console

    table = Table("contacts", "read by", title="% right of the given labels: before → after")
    for name in CLASSES:
        table.add_column(name, justify="right")
    for contacts, title in TITLES.items():
        readers = dict.fromkeys(row.reader for row in rows if row.contacts == contacts)
        for reader in readers:
            pair = {r.weights: r for r in rows if (r.contacts, r.reader) == (contacts, reader)}
            before, after = pair["before"], pair.get("after")
            cells = [
                f"{_percent(old)} → {_percent(None if after is None else after.right[column])}"
                for column, old in enumerate(before.right)
            ]
            table.add_row(title, reader.replace("_", "-"), *cells)
        table.add_row(title, "contacts with a label", *map(str, before.count))
    make_table_console().print(table)


def _percent(value: float | None) -> str:
    return "-" if value is None else f"{value:.1f}"
