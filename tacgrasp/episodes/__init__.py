"""Episodes: what was felt, said, asked, sent and reached, one crash-proof MCAP file each."""

from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.paths import episode_path, record_directory
from tacgrasp.episodes.reader import read_episode
from tacgrasp.episodes.record import (
    Episode,
    EpisodeEnd,
    EpisodeHeader,
    Phase,
    TickRecord,
)
from tacgrasp.episodes.writer import EpisodeWriter

__all__ = [
    "Episode",
    "EpisodeEnd",
    "EpisodeError",
    "EpisodeHeader",
    "EpisodeWriter",
    "Phase",
    "TickRecord",
    "episode_path",
    "read_episode",
    "record_directory",
]
