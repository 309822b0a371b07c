"""Recorded episodes, one crash-safe MCAP file each: write, read, recover, list and plot them.

Not here: replaying an episode (``tacgrasp.playback``), the loop itself (``tacgrasp.loop``).

May import: cltp, policies, primitives.
"""

from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.paths import episode_path, make_record_directory
from tacgrasp.episodes.reader import read_episode
from tacgrasp.episodes.record import Episode, EpisodeEnd, EpisodeHeader, StepPhase, StepRecord
from tacgrasp.episodes.writer import EpisodeWriter

__all__ = [
    "Episode",
    "EpisodeEnd",
    "EpisodeError",
    "EpisodeHeader",
    "EpisodeWriter",
    "StepPhase",
    "StepRecord",
    "episode_path",
    "make_record_directory",
    "read_episode",
]
