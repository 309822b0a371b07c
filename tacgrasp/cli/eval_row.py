"""``tacgrasp eval row``: make one row of the paper's tables, or list them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import contacts_in, parse

RESULTS_DIR = Path("docs/results")
"""Folder of the rows' files, from the repository's root."""

ALL = "all"


@dataclass(frozen=True)
class RowFlags:
    """Make one row of the paper's tables: train its encoder, measure it, write one file.

    The same command continues where it was stopped. Without a name, all rows are listed with the
    commands that make them.

    Attributes:
        name: Name of the row; all makes every row that is missing, one after another.
        data: Folder of the set paper, which every row is measured on.
        full: Folder of the set full, for the row that learns from it.
        seed: Random seed of pre-training, noise and probes.
        out: Folder of encoders, towers and encoded contacts.
        results: Folder of the rows' files.
        samples: Samples that the encoder sees, to try out a row; the page marks it.
        limit: Largest number of contacts of each evaluation split, to try out a row; the page marks
            it.
        precision: Precision of matrix products in training; no where the processor has no bf16.
        threads: Number of threads of torch; by default one for each core.
    """

    name: tyro.conf.Positional[str] = ""
    data: Path = Path("runs/tcl3d")
    full: Path = Path("runs/full")
    seed: int = 0
    out: Path = Path("runs/rows")
    results: Path = RESULTS_DIR
    samples: int | None = None
    limit: int | None = None
    precision: Literal["no", "bf16"] = "bf16"
    threads: int | None = None

    def __post_init__(self) -> None:
        for name in ("samples", "limit", "threads"):
            value = getattr(self, name)
            if value is not None and value < 1:
                raise UsageError(f"--{name} must be at least 1, got {value}")


def main(argv: Sequence[str]) -> None:
    """Make one row of the paper's tables, or list them all (without a name)."""
    flags = parse(RowFlags, argv, prog="tacgrasp eval row")
    if not flags.results.parent.is_dir():
        raise UsageError(
            f"--results {flags.results}: {flags.results.parent} is not a folder; start from the "
            "repository's root, or name another folder"
        )
    from tacgrasp.pretraining.report.row_file import load_rows, missing
    from tacgrasp.pretraining.report.rows import ROWS

    name = flags.name.replace("-", "_")
    if not name:
        _list(flags.results)
        return
    if name not in (*ROWS, ALL):
        raise UsageError(f"no row {flags.name!r}; rows are {', '.join(ROWS)}, or {ALL}")
    chosen = missing(load_rows(flags.results)) if name == ALL else [(name, flags.seed)]
    contacts_in(flags.data, command="tacgrasp data generate --set paper")
    if any(ROWS[each].learns_from == "full" for each, _ in chosen):
        contacts_in(flags.full, command="tacgrasp data generate --set full")
    for row, seed in chosen:
        _make(flags, row, seed)


def _make(flags: RowFlags, row: str, seed: int) -> None:
    from tacgrasp.console import make_console
    from tacgrasp.pretraining.make_row import RowRequest, make_row
    from tacgrasp.pretraining.report.print_results import print_results
    from tacgrasp.training.captions.caption_row import make_caption_row

    settings = {key: value for key, value in vars(flags).items() if key not in ("name", "seed")}
    request = RowRequest(name=row, seed=seed, **settings)
    path, results = (make_caption_row if request.recipe.behind else make_row)(request)
    print_results(results, None)
    make_console().print(f"written   {path}", markup=False, highlight=False, soft_wrap=True)


def _list(folder: Path) -> None:
    """Every row that the page wants, and whether it is there."""
    from rich.table import Table

    from tacgrasp.console import make_table_console
    from tacgrasp.pretraining.report.row_file import load_rows
    from tacgrasp.pretraining.report.row_status import HEAD, row_statuses

    table = Table(box=None, pad_edge=False)
    for title in HEAD:
        table.add_column(title)
    for cells in row_statuses(load_rows(folder)):
        table.add_row(*cells)
    make_table_console().print(table, markup=False)
