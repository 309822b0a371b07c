"""``tacgrasp eval instructions``: how many instructions become the contract that they should."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.result_file import write_result
from tacgrasp.cli.flags import parse, writable


@dataclass(frozen=True)
class InstructionFlags:
    """Read instructions into contracts and compare them with what they should become.

    Attributes:
        file: CSV file with the columns text, kind and expect; by default those that come along.
            expect: band V, range A B, max V, min V [N], softer, firmer, refuse or task.
        task: Task of the instructions.
        json: File for the figures.
        wrong: Print every instruction that is read wrongly.
    """

    file: Path | None = None
    task: str | None = None
    json: Path | None = None
    wrong: bool = True


def main(argv: Sequence[str]) -> None:
    """Compare the contracts that instructions become with what they should be."""
    flags = parse(InstructionFlags, argv, prog="tacgrasp eval instructions")
    writable(flags.json)
    from rich.table import Table

    from tacgrasp.config.layers import load
    from tacgrasp.config.terms import contract_json, task_terms
    from tacgrasp.console import make_console
    from tacgrasp.lessons.instruction_scores import read_wordings, score

    wordings = read_wordings(flags.file)
    task = task_terms(load(flags.task)[0])
    scores = score(wordings, task)
    console = make_console()
    if flags.wrong:
        for each in scores:
            if not each.right:
                contract = each.contract
                band = contract.force_n
                became = contract.refused or (
                    f"{band.low:.2f}-{band.high:.2f} N, at most {contract.limit_n:.2f} N"
                    if band is not None
                    else ""
                )
                wanted = " ".join([each.wording.expect, *(f"{v:g}" for v in each.wording.values)])
                console.print(f"{wanted}: {each.wording.text!r} became: {became}")
    figures: dict[str, dict[str, float]] = {}
    table = Table("expected", "right", "of", "%")
    groups = {**{e: e for e in dict.fromkeys(w.expect for w in wordings)}, "all": ""}
    for name, expect in groups.items():
        mine = [s for s in scores if not expect or s.wording.expect == expect]
        right = sum(s.right for s in mine)
        figures[name] = {"right": right, "n": len(mine), "rate": right / len(mine)}
        table.add_row(name, str(right), str(len(mine)), f"{100 * right / len(mine):.1f}")
    console.print(table)
    if flags.json is not None:
        rows = [
            {
                "text": s.wording.text,
                "kind": s.wording.kind,
                "expect": [s.wording.expect, *s.wording.values],
                "right": s.right,
                "contract": contract_json(s.contract),
            }
            for s in scores
        ]
        write_result(flags.json, {"figures": figures, "instructions": rows})
