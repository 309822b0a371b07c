"""``tacgrasp episodes ls | info | recover | plot | export``: recorded episodes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_ending
from tacgrasp.cli.flags import run_subcommand

if TYPE_CHECKING:
    from tacgrasp.episodes import Episode


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


@dataclass(frozen=True)
class ExportFlags:
    """Write episodes in a format of other programs; the episodes stay as they are.

    What an incomplete episode lacks is told on standard error; the rest is written.

    Attributes:
        episodes: The .mcap files; several, each of another run, for lerobot alone.
        to: lerobot (a data set of LeRobot v3.0), parquet (one table), rrd (rerun; extra 'export').
        out: New file to write, for lerobot a folder; by default the first episode's name with
            .parquet, .rrd or -lerobot.
        language: Whether lerobot's column language_events is written, which LeRobot knows from 0.6
            on; D_t also stands in observation.text.
    """

    episodes: tyro.conf.Positional[tuple[Path, ...]]
    to: Literal["lerobot", "parquet", "rrd"]
    out: Path | None = None
    language: bool = True

    def __post_init__(self) -> None:
        if not self.episodes:
            raise UsageError("name an episode; `tacgrasp episodes ls` lists them")
        if len(self.episodes) > 1 and self.to != "lerobot":
            raise UsageError(f"--to {self.to} takes one episode, got {len(self.episodes)}")
        if not self.language and self.to != "lerobot":
            raise UsageError(
                f"--no-language belongs to --to lerobot; leave it out, since --to {self.to} has no "
                "column language_events"
            )


def main(argv: Sequence[str]) -> int:
    """Run one of the subcommands."""
    commands: dict[str, tuple[type[Any], Callable[[Any], int | None]]] = {
        "ls": (ListFlags, _list),
        "info": (InfoFlags, _info),
        "recover": (RecoverFlags, _recover),
        "plot": (PlotFlags, _plot),
        "export": (ExportFlags, _export),
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


def _beside(episode: Path, name: str) -> Path:
    """A file beside an episode.

    Raises:
        UsageError: A folder was given instead of an episode.
    """
    if episode.is_dir():
        raise UsageError(f"can't read {episode}: it is a folder; name an episode in it (.mcap)")
    return episode.with_name(name)


def _plot(flags: PlotFlags) -> None:
    from tacgrasp.console import make_console
    from tacgrasp.episodes.plot import plot_episode

    png = flags.out or _beside(flags.episode, f"{flags.episode.stem}.png")
    check_ending(png, ".png")
    plot_episode(flags.episode, png)
    make_console().print(f"drawn: {png}")


def _export(flags: ExportFlags) -> None:
    from cltp.atomic_write import replacing
    from tacgrasp.cli.incomplete import read_and_warn
    from tacgrasp.console import make_console, working
    from tacgrasp.episodes import EpisodeError
    from tacgrasp.episodes.paths import refusal

    first = flags.episodes[0]
    name = f"{first.stem}-lerobot" if flags.to == "lerobot" else f"{first.stem}.{flags.to}"
    out = flags.out or _beside(first, name)
    with working(f"writing {out.name}"):
        if flags.to == "lerobot":
            from tacgrasp.episodes.export.lerobot import write_lerobot

            episodes = [read_and_warn(path) for path in flags.episodes]
            _refuse_twice(flags.episodes, episodes)
            write_lerobot(episodes, out, language=flags.language)
        else:
            check_ending(out, f".{flags.to}")
            if out.exists():
                raise EpisodeError(
                    f"{out} exists; exports are never overwritten, give another --out"
                )
            episode = read_and_warn(first)
            write = _writer(flags.to)
            try:
                with replacing(out) as part:
                    write(episode, part)
            except OSError as error:
                raise EpisodeError(refusal(out, "write", error, flag="--out")) from None
    make_console().print(f"written: {out}")


def _refuse_twice(paths: Sequence[Path], episodes: Sequence[Episode]) -> None:
    """Refuse two files of one run, as one that was named twice, copied or recovered.

    Raises:
        UsageError: The first two.
    """
    from tacgrasp.episodes.codec import to_json

    headers = [to_json(episode.header) for episode in episodes]
    for number, header in enumerate(headers):
        if header in headers[:number]:
            first, second = paths[headers.index(header)], paths[number]
            what = f"{first} and {second} are of the same run"
            if first == second:
                what = f"{first} is named twice"
            raise UsageError(f"{what}; a data set holds a run once, leave one out")


def _writer(kind: str) -> Callable[[Episode, Path], None]:
    if kind == "parquet":
        from tacgrasp.episodes.export.parquet import write_parquet

        return write_parquet
    from tacgrasp.viewer.server import require_rerun
    from tacgrasp.viewer.show import write_rrd

    require_rerun("--to rrd", "export")
    return write_rrd
