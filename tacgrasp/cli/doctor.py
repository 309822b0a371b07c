"""``tacgrasp doctor``: is a rig fit to run, and if not, what to do."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tacgrasp.cli.flags import parse

if TYPE_CHECKING:
    from rich.console import Console

    from tacgrasp.drivers.check import Finding


@dataclass(frozen=True)
class DoctorFlags:
    """Look at every device of a rig; nothing moves. 0 when all is well, 1 when something is not.

    Attributes:
        rig: Name of a rig, or the path of its YAML file.
        task: Whose limits are shown.
    """

    rig: str = "sim"
    task: str = "strawberry"


def main(argv: Sequence[str]) -> int:
    """Print what was found, and what to do about it."""
    flags = parse(DoctorFlags, argv, prog="tacgrasp doctor")
    from tacgrasp.bringup.doctor import examine
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console

    config, _ = load(flags.task, flags.rig, os.environ)
    found = examine(config)
    _print(make_console(), found)
    return 0 if all(finding.ok for finding in found) else 1


def _print(out: Console, found: Sequence[Finding]) -> None:
    if out.is_terminal:
        from rich.table import Table
        from rich.text import Text

        table = Table(show_lines=False)
        for column in ("device", "what", "", "found", "what to do"):
            table.add_column(column, overflow="fold")
        for one in found:
            shown = Text("ok", style="green") if one.ok else Text("not ok", style="bold red")
            table.add_row(one.device, one.name, shown, one.detail, one.advice)
        out.print(table)
    else:
        for one in found:
            verdict = "ok" if one.ok else "NOT OK"
            todo = f" | {one.advice}" if one.advice else ""
            out.print(f"{one.device:8} {one.name:27} {verdict:7} {one.detail}{todo}")
    wrong = sum(not one.ok for one in found)
    out.print(
        f"{wrong} of {len(found)} findings are not ok: the rig is not fit to run"
        if wrong
        else f"all {len(found)} findings are ok"
    )
