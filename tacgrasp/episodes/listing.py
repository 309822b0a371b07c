"""What lies in a directory of episodes, as tables for people.

Not here: reading (``tacgrasp.episodes.reader``), printing (the command line owns the console).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from rich.markup import escape
from rich.table import Table

from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.reader import read_episode
from tacgrasp.episodes.record import Episode, EpisodeEnd, StepPhase


@dataclass(frozen=True, slots=True, kw_only=True)
class EpisodeSummary:
    """One row of the list.

    Attributes:
        path: The file.
        size_bytes: Its size.
        episode: What is in it; None when it can't be read.
        problem: Why it can't be read or is incomplete; empty otherwise.
    """

    path: Path
    size_bytes: int
    episode: Episode | None
    problem: str


def summarise(path: Path) -> EpisodeSummary:
    """Read one file; what is wrong with it is part of the answer."""
    size = path.stat().st_size if path.is_file() else 0
    try:
        episode = read_episode(path)
    except EpisodeError as error:
        return EpisodeSummary(path=path, size_bytes=size, episode=None, problem=str(error))
    return EpisodeSummary(path=path, size_bytes=size, episode=episode, problem=episode.problem)


def list_episodes(directory: Path) -> list[EpisodeSummary]:
    """All ``.mcap`` files of a directory by name, and so by task and time.

    Raises:
        EpisodeError: It is not a directory.
    """
    if not directory.is_dir():
        raise EpisodeError(
            f"{directory} is not a directory; name the one that episodes were recorded to"
        )
    return [summarise(path) for path in sorted(directory.glob("*.mcap"))]


def duration_s(episode: Episode) -> float:
    """From the header to the end, or to the last tick of a run that was killed [s]."""
    last = episode.end or (episode.steps[-1] if episode.steps else episode.header)
    return last.stamp.monotonic_s - episode.header.stamp.monotonic_s


def table(summaries: Sequence[EpisodeSummary]) -> Table:
    """One row per episode."""
    shown = Table(header_style="bold", expand=False)
    shown.add_column("episode", no_wrap=True)
    for column in ("task", "policy"):
        shown.add_column(column, overflow="fold")
    shown.add_column("ticks", justify="right")
    for column in ("end", "declared", "verified", "truth"):
        shown.add_column(column, overflow="fold")
    shown.add_column("time", justify="right")
    shown.add_column("size", justify="right")
    for summary in summaries:
        shown.add_row(*_row(summary))
    return shown


def info(path: Path) -> Table:
    """Everything about one episode but its touches.

    Raises:
        EpisodeError: As for ``read_episode``.
    """
    episode = read_episode(path)
    header, end = episode.header, episode.end
    shown = Table.grid(padding=(0, 2))
    shown.add_column(style="bold")
    shown.add_column(overflow="fold")
    started = datetime.fromtimestamp(header.stamp.wall_s, tz=UTC)
    rows = {
        "file": f"{path} ({_size(path.stat().st_size)})",
        "complete": "yes" if episode.complete else f"no: {_incomplete(path, episode)}",
        "task": header.task,
        "instruction": header.instruction,
        "policy": header.policy,
        "rig": header.rig + (", dry run" if header.dry_run else ""),
        "seed": "none" if header.seed is None else str(header.seed),
        "sensor": f"{header.sensor.name}, {header.sensor.width_mm:.1f}×"
        f"{header.sensor.height_mm:.1f} mm",
        "started": f"{started:%Y-%m-%d %H:%M:%S} UTC",
        "duration": f"{duration_s(episode):.2f} s",
        "ticks": _ticks_in_words(episode),
        "actions": _actions_in_words(episode),
        "end": end.reason if end else "not recorded: the run was killed or crashed",
        "message": end.message if end else "",
        "declared success": _yes_no(end.declared_success) if end else "",
        "verified success": _yes_no(end.verified_success) if end else "",
        "truth": _truth(end),
        "versions": ", ".join(f"{name} {version}" for name, version in header.versions.items()),
    }
    for name, value in rows.items():
        if value:
            shown.add_row(name, escape(value))
    return shown


def _row(summary: EpisodeSummary) -> list[str]:
    name, size, episode = summary.path.name, _size(summary.size_bytes), summary.episode
    if episode is None:
        reason = summary.problem.removeprefix(f"{summary.path} ")
        return [escape(name), "", "", "", f"[red]{escape(reason)}[/red]", "", "", "", "", size]
    end = episode.end
    outcome = end.reason if end else "no end recorded"
    if not episode.complete:
        outcome += ", unfinished: recover it"
    colour = "green" if end and end.verified_success else "yellow"
    return [
        escape(name),
        escape(episode.header.task),
        escape(episode.header.policy),
        str(_num_turns(episode)),
        f"[{colour}]{escape(outcome)}[/{colour}]",
        _yes_no(end.declared_success) if end else "",
        _yes_no(end.verified_success) if end else "",
        escape(_truth_in_short(end)),
        f"{duration_s(episode):.1f} s",
        size,
    ]


def _num_turns(episode: Episode) -> int:
    return sum(tick.phase == StepPhase.LOOP for tick in episode.steps)


def _ticks_in_words(episode: Episode) -> str:
    turns = _num_turns(episode)
    checks = len(episode.steps) - turns
    return f"{turns}" + (f" and {checks} touches of verification" if checks else "")


def _actions_in_words(episode: Episode) -> str:
    counts = Counter(
        tick.executed.primitive.value
        for tick in episode.steps
        if tick.executed is not None and tick.executed.primitive is not None
    )
    return ", ".join(f"{count} × {name}" for name, count in counts.items())


def _incomplete(path: Path, episode: Episode) -> str:
    return f"{episode.problem}; `tacgrasp episodes recover {path}` makes a finished file of it"


def _truth(end: EpisodeEnd | None) -> str:
    """Facts that hold by name, others with their value."""
    words = []
    for name, value in (end.truth or {}).items() if end else ():
        if isinstance(value, bool):
            words.append(name if value else f"not {name}")
        elif value is not None:
            words.append(f"{name} {value:.3g}" if isinstance(value, float) else f"{name} {value}")
    return ", ".join(words)


def _truth_in_short(end: EpisodeEnd | None) -> str:
    """The facts that hold; when none does, that the first does not."""
    facts = {k: v for k, v in (end.truth or {}).items() if isinstance(v, bool)} if end else {}
    held = [name for name, value in facts.items() if value]
    return ", ".join(held or [f"not {name}" for name in list(facts)[:1]])


def _yes_no(value: bool | None) -> str:
    return {True: "yes", False: "no", None: "not tried"}[value]


def _size(size_bytes: int) -> str:
    return f"{size_bytes / 1e6:.1f} MB" if size_bytes >= 1e5 else f"{size_bytes / 1e3:.1f} kB"
