"""``tacgrasp why EPISODE``: the first fault, refusal or failed verification of an episode."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class WhyFlags:
    """Show what went wrong first: the state before it, what was sent, and how to replay it.

    Attributes:
        episode: The .mcap file.
    """

    episode: tyro.conf.Positional[Path]


def main(argv: Sequence[str]) -> int:
    """Print it; 0 when nothing went wrong, 1 when something did or the file is incomplete."""
    flags = parse(WhyFlags, argv, prog="tacgrasp why")
    from rich.text import Text

    from tacgrasp.console import make_console, width_of, wrapped
    from tacgrasp.episodes import read_episode
    from tacgrasp.episodes.why import explain, first_trouble

    episode = read_episode(flags.episode)
    console = make_console()
    for name, value in explain(episode, str(flags.episode)):
        line = f"{name:15}  {' '.join(value.split())}"
        is_command = value.startswith("tacgrasp ")  # stays in one piece, to be copied
        for part in [line] if is_command else wrapped(line, 0, 17, width_of(console)):
            console.print(Text(part, style="bold" if name == "trouble" else ""))
    return 0 if first_trouble(episode) is None and episode.complete else 1
