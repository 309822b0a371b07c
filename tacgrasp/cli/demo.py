"""``tacgrasp demo [NAME]``: play a scripted demo, or list them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class DemoFlags:
    """Play a scripted demo on the simulated rig; without a name, list them.

    Attributes:
        name: Which demo.
        record: Folder that its episode is written to.
    """

    name: tyro.conf.Positional[str] = ""
    record: Path = Path("episodes")


def main(argv: Sequence[str]) -> int:
    """Play one demo; 1 when it does not come out as told."""
    flags = parse(DemoFlags, argv, prog="tacgrasp demo")
    from tacgrasp.console import LineView, console, end_lines
    from tacgrasp.playback.demo import DEMOS, play

    to = console()
    if not flags.name:
        for name, demo in DEMOS.items():
            to.print(f"{name:10}{demo.what}")
        return 0
    shown = play(flags.name, flags.record, [LineView(to)])
    demo = DEMOS[flags.name]
    to.print(f"episode: {shown.path}")
    for line in end_lines(shown.outcome):
        to.print(line)
    told, came = (
        ", ".join([*actions, end])
        for actions, end in ((demo.actions, demo.end), (shown.actions, shown.outcome.reason))
    )
    to.print(f"as told: {told}" if shown.as_told else f"expected {told}; came {came}")
    return 0 if shown.as_told else 1
