"""``tacgrasp eval captions``: captions of the language model, rated 1 to 5, beside trivial ones."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import write_result
from tacgrasp.cli.flags import contacts_in, parse, writable

if TYPE_CHECKING:
    from tacgrasp.pretraining.report.store import Result


@dataclass(frozen=True)
class CaptionFlags:
    """Rate captions of unseen noisy contacts by a rule, and by a judge where one is named.

    Stored for the table of tacgrasp eval report, with the ratings of trivial captions.

    Attributes:
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
        data: Folder of contacts, of which the test split is used with noise.
        results: Folder of results.
        contacts: Number of contacts.
        questions: Number of contacts to ask questions about too; 0 for none.
        seed: Random seed of the choice of contacts and of the sensor noise.
        judge: Command that gets a JSON object with reference and caption a line, and answers each
            with a line that holds a rating from 1 to 5.
        judge_lm: Directory of a local causal language model that rates instead.
        judge_timeout_s: Longest time for all captions of one call of the command [s].
        json: JSON file for the figures.
    """

    weights: Path | None = None
    data: Path = Path("runs/tcl3d")
    results: Path = Path("runs/results")
    contacts: int = 1000
    questions: int = 0
    seed: int = 0
    judge: str | None = None
    judge_lm: Path | None = None
    judge_timeout_s: float = 600.0
    json: Path | None = None

    def __post_init__(self) -> None:
        if self.contacts < 1 or self.questions < 0:
            raise UsageError("--contacts must be at least 1, --questions at least 0")
        if not self.judge_timeout_s > 0:
            raise UsageError("--judge-timeout-s must be above 0")


def main(argv: Sequence[str]) -> None:
    """Captions of the language model rated 1 to 5 (appendix C), beside trivial ones."""
    flags = parse(CaptionFlags, argv, prog="tacgrasp eval captions")
    writable(flags.json)
    contacts_in(flags.data, command="tacgrasp data generate")
    from cltp.train.progress import Bar
    from tacgrasp.policy_factory import default_weights
    from tacgrasp.training.captions.evaluate import CaptionRun, rate_captions
    from tacgrasp.training.captions.judges import make_judge

    judge = make_judge(flags.judge, flags.judge_lm, flags.judge_timeout_s)
    with Bar(line_s=10.0) as report:
        results = rate_captions(
            CaptionRun(
                weights=flags.weights or default_weights(),
                data=flags.data,
                results=flags.results,
                contacts=flags.contacts,
                questions=flags.questions,
                seed=flags.seed,
                judge=judge,
                command=shlex.join(["tacgrasp", "eval", "captions", *argv]),
                report=report,
            )
        )
    _show(results)
    if flags.json is not None:
        figures = {result.method: dict(result.values) for result in results}
        write_result(flags.json, figures)


def _show(results: Sequence[Result]) -> None:
    from rich.table import Table

    from tacgrasp.console import make_table_console
    from tacgrasp.pretraining.report.caption_table import ROWS
    from tacgrasp.pretraining.report.store import TITLES

    table = Table(title=f"captions, rated 1 to 5; the rest in %: {results[0].contacts} contacts")
    table.add_column("")
    for name in results[0].values:
        table.add_column(name.replace("_", " "), justify="right")
    for result in results:
        values = (result.values.get(name) for name in results[0].values)
        title = ROWS.get(result.method, f"{TITLES[result.method]}-LLM")
        table.add_row(title, *("-" if value is None else f"{value:.3g}" for value in values))
    make_table_console().print(table)
