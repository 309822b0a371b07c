"""Tables of recorded episodes, for people.

Not here: reading (``tacgrasp.episodes.reader``), printing (``tacgrasp.cli.episodes``).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from rich.markup import escape
from rich.table import Table

from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.reader import incomplete_text, read_episode
from tacgrasp.episodes.record import NO_END, Episode, EpisodeEnd, StepPhase, end_label, harms

_YES_NO = {True: "yes", False: "no", None: "not tried"}


def list_episodes(directory: Path) -> list[Path]:
    """All ``.mcap`` files of a directory by name, and so by task and time.

    Raises:
        EpisodeError: It is not a directory.
    """
    if not directory.is_dir():
        raise EpisodeError(
            f"{directory} is not a directory; name the one that episodes were recorded to"
        )
    return sorted(directory.glob("*.mcap"))


def duration_s(episode: Episode) -> float:
    """Time from the header to the end, or to the last step of a killed run [s]."""
    last = episode.end or (episode.steps[-1] if episode.steps else episode.header)
    return last.stamp.monotonic_s - episode.header.stamp.monotonic_s


def table(paths: Sequence[Path]) -> Table:
    """One row per episode, also for a file that can't be read; it fits a terminal of 80 columns.

    The name of a file holds task, start and seed.
    """
    grid = Table(header_style="bold", box=None, padding=(0, 2, 0, 0))
    grid.add_column("episode", no_wrap=True)  # whole, to be copied
    grid.add_column("policy", overflow="fold")
    grid.add_column("steps", justify="right", no_wrap=True)
    grid.add_column("end", overflow="fold")
    grid.add_column("time", justify="right", no_wrap=True)
    for path in paths:
        grid.add_row(*_row(path))
    return grid


def info(path: Path) -> Table:
    """Everything about one episode but its clouds.

    Raises:
        EpisodeError: As for ``read_episode``.
    """
    episode = read_episode(path)
    header, end = episode.header, episode.end
    started = datetime.fromtimestamp(header.stamp.wall_s, tz=UTC)
    executed = [step.executed.primitive for step in episode.steps if step.executed is not None]
    actions = Counter(primitive.value for primitive in executed if primitive is not None)
    rows = {
        "file": f"{path} ({_size(path.stat().st_size)})",
        "complete": "yes" if episode.complete else f"no: {incomplete_text(episode, path)}",
        "task": header.task,
        "instruction": header.instruction,
        "policy": header.policy,
        "rig": header.rig + (", dry run" if header.dry_run else ""),
        "seed": "none" if header.seed is None else str(header.seed),
        "sensor": f"{header.sensor.name}, {header.sensor.width_mm:.1f}×"
        f"{header.sensor.height_mm:.1f} mm",
        "started": f"{started:%Y-%m-%d %H:%M:%S} UTC",
        "duration": f"{duration_s(episode):.2f} s",
        "steps": _steps_text(episode),
        "actions": ", ".join(f"{count} × {name}" for name, count in actions.items()),
        "end": end_label(end.reason, end.truth) if end else f"not recorded: {NO_END}",
        "message": end.message if end else "",
        "declared success": _YES_NO[end.declared_success] if end else "",
        "verified success": _YES_NO[end.verified_success] if end else "",
        "truth": _truth_text(end),
        "versions": ", ".join(f"{name} {version}" for name, version in header.versions.items()),
    }
    grid = Table.grid(padding=(0, 2))
    grid.add_column(style="bold")
    grid.add_column(overflow="fold")
    for name, value in rows.items():
        if value:
            grid.add_row(name, escape(value))
    return grid


def _row(path: Path) -> list[str]:
    name = escape(path.name)
    try:
        episode = read_episode(path)
    except EpisodeError as error:
        reason = escape(str(error).removeprefix(f"{path} "))
        return [name, "", "", f"[red]{reason}[/red]", ""]
    end = episode.end
    outcome = _end_text(end) if end else "no end recorded"
    colour = "green" if outcome == "success" else "yellow"
    if not episode.complete:
        outcome += ", incomplete" if episode.finished else ", unfinished: recover it"
    return [
        name,
        escape(episode.header.policy),
        str(len(episode.steps)),
        f"[{colour}]{escape(outcome)}[/{colour}]",
        f"{duration_s(episode):.1f} s",
    ]


def _end_text(end: EpisodeEnd) -> str:
    """The end held against the truth; what became of the body where it was no success."""
    label = end_label(end.reason, end.truth)
    new = [harm for harm in harms(end.truth or {}) if harm not in label]
    return ", ".join([label, *new])


def _steps_text(episode: Episode) -> str:
    """All steps, as a run counts them, and how many belong to the verification."""
    num_checks = sum(step.phase != StepPhase.LOOP for step in episode.steps)
    checks = f", {num_checks} of the verification" if num_checks else ""
    return f"{len(episode.steps)}{checks}"


def _truth_text(end: EpisodeEnd | None) -> str:
    """Facts that hold by name, others with their value, in the order of the record."""
    words = []
    for name, value in (end.truth or {}).items() if end else ():
        if isinstance(value, bool):
            words.append(name if value else f"not {name}")
        elif value is not None:
            words.append(f"{name} {value:.3g}" if isinstance(value, float) else f"{name} {value}")
    return ", ".join(words)


def _size(size_bytes: int) -> str:
    return f"{size_bytes / 1e6:.1f} MB" if size_bytes >= 1e5 else f"{size_bytes / 1e3:.1f} kB"
