"""Read an episode for a command that shows it or writes it elsewhere, and say what it lacks.

Not here: commands that print this among their own lines (``episodes info``, ``why``, ``replay``).
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tacgrasp.episodes import Episode


def read_and_warn(path: Path) -> Episode:
    """Read an episode; one that is incomplete is told in a line on standard error.

    Raises:
        EpisodeError: As for ``read_episode``.
    """
    from tacgrasp.episodes import read_episode

    episode = read_episode(path)
    warn_of_gaps(episode, path)
    return episode


def warn_of_gaps(episode: Episode, path: Path) -> None:
    """Tell on standard error what an episode lacks, in a line; nothing where it is complete."""
    from tacgrasp.base.printable import printable
    from tacgrasp.episodes.reader import incomplete_text

    if text := incomplete_text(episode, path):
        sys.stderr.write(f"tacgrasp: {path} is incomplete: {printable(text)}\n")
