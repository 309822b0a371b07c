"""``tacgrasp episodes ls | info | recover | plot``: what has been recorded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

from tacgrasp.cli.flags import parse, subcommand

if TYPE_CHECKING:
    from rich.console import Console


@dataclass(frozen=True)
class Ls:
    """List the episodes of a folder.

    Attributes:
        folder: Where they were recorded.
    """

    folder: tyro.conf.Positional[Path] = Path("episodes")


@dataclass(frozen=True)
class Info:
    """Everything about one episode but its touches.

    Attributes:
        episode: The .mcap file.
    """

    episode: tyro.conf.Positional[Path]


@dataclass(frozen=True)
class Recover:
    """Make a finished file of one that a crash left unfinished.

    Attributes:
        episode: The .mcap file.
        out: Where to write it; without it the file is replaced and the old one kept beside it.
    """

    episode: tyro.conf.Positional[Path]
    out: Path | None = None


@dataclass(frozen=True)
class Plot:
    """Draw an episode.

    Attributes:
        episode: The .mcap file.
        out: The picture; without it the episode's name with .png.
    """

    episode: tyro.conf.Positional[Path]
    out: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Dispatch to the four commands."""
    actions: dict[str, Callable[[Sequence[str], str], None]] = {
        "ls": _ls,
        "info": _info,
        "recover": _recover,
        "plot": _plot,
    }
    name, rest = subcommand("episodes", argv, {n: a.__doc__ or "" for n, a in actions.items()})
    if name is not None:
        actions[name](rest, f"tacgrasp episodes {name}")
    return 0


def _ls(argv: Sequence[str], prog: str) -> None:
    """List the episodes of a folder."""
    from tacgrasp.episodes.listing import list_episodes, table

    found = list_episodes(parse(Ls, argv, prog=prog).folder)
    _wide().print(table(found))


def _info(argv: Sequence[str], prog: str) -> None:
    """Everything about one episode but its touches."""
    from tacgrasp.episodes.listing import info

    _wide().print(info(parse(Info, argv, prog=prog).episode))


def _recover(argv: Sequence[str], prog: str) -> None:
    """Make a finished file of one that a crash left unfinished."""
    from tacgrasp.console import console
    from tacgrasp.episodes.recover import recover

    flags = parse(Recover, argv, prog=prog)
    console().print(recover(flags.episode, flags.out).message)


def _plot(argv: Sequence[str], prog: str) -> None:
    """Draw an episode."""
    from tacgrasp.console import console
    from tacgrasp.episodes.plot import plot_episode

    flags = parse(Plot, argv, prog=prog)
    png = flags.out or flags.episode.with_suffix(".png")
    plot_episode(flags.episode, png)
    console().print(f"drawn: {png}")


def _wide() -> Console:
    """As wide as the terminal; wide enough for the tables where there is none."""
    from rich.console import Console

    to = Console()
    return to if to.is_terminal else Console(width=160)
