"""A sensor that plays a recording: the clouds of an episode, or a folder of contacts.

Every read returns the next recorded cloud, whatever the robot does, stamped with the time of the
read. It is for a rig without a sensor, to look at a policy, and never for a grasp. The end of the
recording is an error.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from cltp.errors import TouchError
from cltp.sensing.frames import FRAME_SUFFIXES
from cltp.sensing.touch_files import read_cloud
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.sensors import SensorSpec, sensor_named
from tacgrasp.drivers.check import Finding, finding
from tacgrasp.drivers.force_scale import force_scale_of
from tacgrasp.drivers.frame_folder import BACKGROUND, ended_message, list_recorded
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.stamps import real_stamp

log = logging.getLogger(__name__)

_SUFFIXES = (".ply", ".pcd", ".xyz", ".npy", ".npz", *FRAME_SUFFIXES)

LoadCloud = Callable[[], TactileCloud]
"""Loads one recorded cloud."""


class RecordedSensor:
    """A ``rig.protocols.WatchedSensor`` that plays recorded clouds.

    Args:
        name: Name of the recording, for messages.
        loaders: Loaders of the clouds, in order; each is called when it is played.
        sensor: Sensor of the recording.
        repeat: Start again at the end.
        force_scale: Force scale of the unit; None is that of each recorded cloud.
    """

    def __init__(
        self,
        name: str,
        loaders: Sequence[LoadCloud],
        sensor: SensorSpec,
        *,
        repeat: bool = False,
        force_scale: ForceScale | None = None,
    ) -> None:
        self._name, self._loaders, self._spec = name, loaders, sensor
        self._force_scale = force_scale
        self._repeat, self._num_played, self._disconnected = repeat, 0, False

    @property
    def spec(self) -> SensorSpec:
        return self._spec

    @property
    def length(self) -> int:
        return len(self._loaders)

    def read(self, frames: int = 1) -> TactileCloud:
        """Return the next recorded cloud with a stamp of now.

        Raises:
            TouchError: Disconnected, the recording has ended, or one of its files can't be read.
        """
        self.check_alive()
        if self._num_played >= len(self._loaders) and not self._repeat:
            raise TouchError(ended_message(self._name, self._num_played))
        cloud = self._loaders[self._num_played % len(self._loaders)]()
        self._num_played += 1
        scale = self._force_scale or cloud.force_scale
        return TactileCloud(
            points_mm=cloud.points_mm, sensor=self._spec, stamp=real_stamp(), force_scale=scale
        )

    def take_reference(self) -> None:
        """Nothing to take: recorded clouds are played as they are.

        Raises:
            TouchError: Disconnected.
        """
        self.check_alive()

    def check_alive(self) -> str:
        if self._disconnected:
            raise TouchError(f"the recording {self._name} is disconnected; connect it again")
        return ""

    def expect_untouched(self) -> None:
        """Nothing to compare: a recording has no untouched gel."""

    def counts(self) -> None:
        """No counts: a recording loses no frames."""

    def disconnect(self) -> None:
        self._disconnected = True


def connect_recorded(settings: RecordedSettings) -> RecordedSensor:
    """Open the recording of a rig's file.

    Raises:
        TouchError: It doesn't exist, can't be read, is empty, or is of another sensor.
    """
    sensor = sensor_named(settings.sensor)
    path = settings.path
    if path.is_dir():
        loaders = _folder_loaders(settings, sensor)
    elif path.is_file() and path.suffix.lower() == ".mcap":
        loaders = _episode_loaders(path, sensor)
    else:
        raise TouchError(f"no recording {path}; expected an episode (.mcap) or a folder of clouds")
    log.info("%d recorded clouds are played from %s: nothing is felt", len(loaders), path)
    scale = None if settings.force_calibration is None else force_scale_of(settings)
    return RecordedSensor(str(path), loaders, sensor, repeat=settings.repeat, force_scale=scale)


def _episode_loaders(path: Path, sensor: SensorSpec) -> list[LoadCloud]:
    from tacgrasp.episodes import EpisodeError, read_episode

    try:
        episode = read_episode(path)
    except EpisodeError as error:
        raise TouchError(str(error)) from None
    if episode.header.sensor != sensor:
        raise TouchError(
            f"{path} was recorded with {episode.header.sensor.name}, expected {sensor.name}; name "
            "that sensor, or another episode"
        )
    if not episode.steps:
        raise TouchError(f"{path} holds no cloud: its run ended before the first one")
    if not episode.complete:
        log.warning("%s is incomplete: %s", path, episode.problem)
    return [partial(_unchanged, step.cloud) for step in episode.steps]


def _unchanged(cloud: TactileCloud) -> TactileCloud:
    return cloud


def _folder_loaders(settings: RecordedSettings, sensor: SensorSpec) -> list[LoadCloud]:
    folder = settings.path
    background = settings.background or folder / BACKGROUND
    paths = list_recorded(folder, _SUFFIXES, content="clouds", excluded=[background])
    calibration = None if settings.calibration == "shipped" else settings.calibration
    return [
        partial(
            read_cloud,
            path,
            sensor,
            background=background if background.is_file() else None,
            calibration=calibration,
        )
        for path in paths
    ]


def check(settings: RecordedSettings) -> Sequence[Finding]:
    """Check the recording for ``tacgrasp doctor``: every cloud is read once."""
    try:
        sensor = connect_recorded(settings.model_copy(update={"repeat": False}))
        count = len([sensor.read() for _ in range(sensor.length)])
    except TouchError as error:
        advice = "name another recording, or correct the error"
        return [finding("sensor", "connection", False, str(error), advice)]
    detail = f"{count} recorded clouds in {settings.path}: nothing is felt"
    return [finding("sensor", "connection", True, detail)]
