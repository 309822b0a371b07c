"""``tacgrasp doctor``: check a rig and advise on every fault."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse

MAX_SOAK_S = 3600.0


@dataclass(frozen=True)
class DoctorFlags:
    """Check every device of a rig; nothing moves. Exit code 0 if all checks pass, 1 if not.

    Attributes:
        rig: Name of a rig, or path of its YAML file.
        task: Task whose limits are shown.
        soak: Seconds for which all devices are then read side by side, for the success rate and
            the jitter of each. Default: not at all.
    """

    rig: str = "sim"
    task: str = "strawberry"
    soak: float = 0.0

    def __post_init__(self) -> None:
        if not 0 <= self.soak <= MAX_SOAK_S:
            raise UsageError(f"--soak must be 0 to {MAX_SOAK_S:g} seconds, got {self.soak}")


def main(argv: Sequence[str]) -> int:
    """Print the result of every check, with advice for those that failed."""
    flags = parse(DoctorFlags, argv, prog="tacgrasp doctor")
    from tacgrasp.bringup.doctor import rig_findings
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console

    config, _ = load(flags.task, flags.rig, os.environ)
    findings, out = rig_findings(config, soak_s=flags.soak), make_console()
    if out.is_terminal:
        from rich.table import Table
        from rich.text import Text

        table = Table(show_lines=False)
        for column in ("device", "check", "", "result", "what to do"):
            table.add_column(column, overflow="fold")
        for finding in findings:
            text = Text("ok", style="green") if finding.ok else Text("not ok", style="bold red")
            table.add_row(finding.device, finding.name, text, finding.detail, finding.advice)
        out.print(table)
    else:
        for finding in findings:
            verdict = "ok" if finding.ok else "NOT OK"
            advice = f" | {finding.advice}" if finding.advice else ""
            out.print(f"{finding.device:8} {finding.name:27} {verdict:7} {finding.detail}{advice}")
    num_failed = sum(not finding.ok for finding in findings)
    out.print(
        f"{num_failed} of {len(findings)} findings are not ok: the rig is not fit to run"
        if num_failed
        else f"all {len(findings)} findings are ok"
    )
    return 1 if num_failed else 0
