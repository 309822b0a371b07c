"""One contact out of a file: a cloud, a height map, a frame, or a step of an episode.

Not here: reading the formats (``cltp.sensing.touch_files``, ``tacgrasp.episodes``).
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from cltp.sensing.touch_files import read_cloud
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.sensors import sensor_named
from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.episodes import Episode, read_episode
from tacgrasp.episodes.record import PHASE_LABELS

EPISODE_SUFFIX = ".mcap"


class ContactFile(NamedTuple):
    """A contact that was read.

    Attributes:
        cloud: The contact.
        contract: Contract of the episode in this step, with the step's target as its band; None
            for other files, and in episodes of older versions.
        about: Which step of the episode it is, for people; '' for other files.
        episode: The episode; None for other files.
        in_contact: Whether something touches, by the run's test against the gel with open fingers;
            None where none was possible, and for other files.
    """

    cloud: TactileCloud
    contract: Contract | None
    about: str = ""
    episode: Episode | None = None
    in_contact: bool | None = None


def read_contact(
    path: Path,
    sensor: str,
    *,
    background: Path | None = None,
    calibration: Path | None = None,
    step: int | None = None,
) -> ContactFile:
    """Read the contact in a file.

    Args:
        path: Cloud, height map, frame or episode.
        sensor: Name of the sensor that it is from; an episode says so itself.
        background: For a frame: one of the same unit with an untouched gel.
        calibration: For a frame: calibration of the unit; None takes the shipped one.
        step: Number of the step of an episode; None takes the last one.

    Raises:
        TouchError: An unknown sensor, or the file can't be read as one of it.
        EpisodeError: The episode can't be read.
        UsageError: The episode has no such step, or ``step`` is given for another file.
    """
    if path.suffix.lower() == EPISODE_SUFFIX:
        return _step_contact(path, step)
    if step is not None:
        raise UsageError(f"--step is for an episode ({EPISODE_SUFFIX}), {path} is none")
    named = sensor_named(sensor)
    cloud = read_cloud(path, named, background=background, calibration=calibration)
    return ContactFile(cloud, None)


def _step_contact(path: Path, number: int | None) -> ContactFile:
    """The contact of a step, and the contract after all that was felt until then."""
    episode = read_episode(path)
    if not episode.steps:
        raise UsageError(f"{path} has no steps")
    last = episode.steps[-1].index
    number = last if number is None else number
    contract = episode.header.contract
    for step in episode.steps:
        contract = step.contract or contract
        if step.index == number:
            target = None if contract is None else step.under(contract)
            label = PHASE_LABELS.get(step.phase, "")
            about = f"{number} of 0 to {last} {label}".rstrip()
            return ContactFile(step.cloud, target, about, episode, step.in_contact)
    raise UsageError(f"{path} has no step {number}; its steps are 0 to {last}")
