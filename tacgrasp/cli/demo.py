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
        name: Name of the demo.
        record: Folder for the recorded episode.
    """

    name: tyro.conf.Positional[str] = ""
    record: Path = Path("episodes")


def main(argv: Sequence[str]) -> int:
    """Play one demo; 1 when actions or end differ from its script."""
    flags = parse(DemoFlags, argv, prog="tacgrasp demo")
    from tacgrasp.console import StepPrinter, end_lines, make_console, width_of, working
    from tacgrasp.playback.demo import DEMOS, play

    console = make_console()
    if not flags.name:
        for name, demo in DEMOS.items():
            console.print(f"{name:10}{demo.summary}")
        return 0
    with working(f"playing {flags.name}"):  # steps are printed above the spinner
        result = play(flags.name, flags.record, [StepPrinter(console)])
    demo = DEMOS[flags.name]
    console.print(f"episode: {result.path}")
    for line in end_lines(result.outcome, result.config, width_of(console)):
        console.print(line)
    script = ", ".join([*demo.actions, demo.end])
    if result.as_scripted:
        console.print(f"as scripted: {script}")
        return 0
    console.print(f"expected {script}; got {', '.join([*result.actions, result.outcome.reason])}")
    return 1
