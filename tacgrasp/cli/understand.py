"""``tacgrasp understand "…"``: the contract that an instruction becomes; nothing moves."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.base.result_file import write_result
from tacgrasp.cli.flags import parse, writable


@dataclass(frozen=True)
class UnderstandFlags:
    """Show what an instruction becomes: force band, limit, what was assumed, or why it is refused.

    Attributes:
        instruction: The instruction, in plain English.
        task: Task of the instruction.
        rig: Rig whose gripper bounds the forces.
        json: File for the contract.
    """

    instruction: tyro.conf.Positional[str]
    task: str | None = None
    rig: str | None = None
    json: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Print one contract; 2 when it is refused, as for a run with it."""
    flags = parse(UnderstandFlags, argv, prog="tacgrasp understand")
    writable(flags.json)
    from tacgrasp.config.layers import load
    from tacgrasp.config.terms import contract_json, contract_lines, worded_contract
    from tacgrasp.console import make_console

    config, sources = load(flags.task, flags.rig, os.environ)
    contract = worded_contract(flags.instruction, config, sources)
    console = make_console()
    for line in contract_lines(contract):
        console.print(line)
    if flags.json is not None:
        write_result(flags.json, contract_json(contract))
    return 2 if contract.refused else 0
