"""``tacgrasp episodes ls | info | recover | plot``: list and inspect recorded episodes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tyro

from tacgrasp.cli.flags import run_subcommand


@dataclass(frozen=True)
class ListFlags:
    """List the episodes of a folder.

    Attributes:
        folder: Folder of recorded episodes.
    """

    folder: tyro.conf.Positional[Path] = Path("episodes")


@dataclass(frozen=True)
class InfoFlags:
    """Print everything about one episode but its clouds.

    Attributes:
        episode: The .mcap file.
    """

    episode: tyro.conf.Positional[Path]


@dataclass(frozen=True)
class RecoverFlags:
    """Finish the file of an episode that a crash left unfinished.

    Attributes:
        episode: The .mcap file.
        out: File to write; by default the episode is replaced, and the old file kept beside it.
    """

    episode: tyro.conf.Positional[Path]
    out: Path | None = None


@dataclass(frozen=True)
class PlotFlags:
    """Draw an episode as one picture.

    Attributes:
        episode: The .mcap file.
        out: Picture to write; by default the episode's name with .png.
    """

    episode: tyro.conf.Positional[Path]
    out: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Run one of the four subcommands."""
    commands: dict[str, tuple[type[Any], Callable[[Any], int | None]]] = {
        "ls": (ListFlags, _list),
        "info": (InfoFlags, _info),
        "recover": (RecoverFlags, _recover),
        "plot": (PlotFlags, _plot),
    }
    return run_subcommand("episodes", argv, commands) or 0


def _list(flags: ListFlags) -> None:
    from tacgrasp.console import make_table_console
    from tacgrasp.episodes.listing import list_episodes, table

    make_table_console().print(table(list_episodes(flags.folder)))


def _info(flags: InfoFlags) -> None:
    from tacgrasp.console import make_table_console
    from tacgrasp.episodes.listing import info

    make_table_console().print(info(flags.episode))


def _recover(flags: RecoverFlags) -> None:
    from tacgrasp.console import make_console
    from tacgrasp.episodes.recover import recover

    make_console().print(recover(flags.episode, flags.out))


def _plot(flags: PlotFlags) -> None:
    from tacgrasp.console import make_console
    from tacgrasp.episodes.plot import plot_episode

    png = flags.out or flags.episode.with_suffix(".png")
    plot_episode(flags.episode, png)
    make_console().print(f"drawn: {png}")
