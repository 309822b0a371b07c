"""A sensor that plays what another one felt: an episode, or a folder of touches.

It answers every read with the next recorded touch, whatever the robot does, stamped with the time
at which it is played. For a rig without a sensor, for looking at a policy: never for a grasp. Its
end is an error.

Not here: policies that repeat an episode's decisions (``policies.recorded``).
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from pathlib import Path

from cltp.errors import TouchError
from cltp.sensing.frames import FRAME_SUFFIXES
from cltp.sensing.touch_files import read_touch
from cltp.tactile.cloud import NUM_POINTS, Stamp, TactileCloud
from cltp.tactile.encoder_input import lattice_points
from cltp.tactile.sensors import SensorSpec, sensor_named
from tacgrasp.drivers.check import Finding
from tacgrasp.drivers.gelsight.frame_folder import BACKGROUND, counted
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.stamps import real_stamp

log = logging.getLogger(__name__)

_SUFFIXES = (".ply", ".pcd", ".xyz", ".npy", ".npz", *FRAME_SUFFIXES)

Touch = Callable[[], TactileCloud]
"""Reads one recorded touch."""


class RecordedSensor:
    """Plays touches; a ``TactileSensor`` in all but that nothing is felt.

    Args:
        name: Of the recording, for messages.
        touches: What to play, in order; each is read when its turn comes.
        sensor: Which sensor they are of.
        repeat: Begin anew at the end.
        stamp: Both clocks.
    """

    def __init__(
        self,
        name: str,
        touches: Sequence[Touch],
        sensor: SensorSpec,
        *,
        repeat: bool = False,
        stamp: Callable[[], Stamp] = real_stamp,
    ) -> None:
        self._name, self._touches, self._spec = name, touches, sensor
        self._repeat, self._stamp = repeat, stamp
        self._played, self._disconnected = 0, False

    @property
    def spec(self) -> SensorSpec:
        """Which sensor the recording is of."""
        return self._spec

    @property
    def length(self) -> int:
        """Touches of the recording."""
        return len(self._touches)

    @property
    def played(self) -> int:
        """Touches played so far."""
        return self._played

    def read(self) -> TactileCloud:
        """The next recorded touch, as if it were captured now.

        Raises:
            TouchError: Disconnected, the recording has ended, or a file of it can't be read.
        """
        self.check_alive()
        if self._played >= len(self._touches) and not self._repeat:
            raise TouchError(
                f"the recording {self._name} has ended after {self._played} touches; nothing newer "
                "can be felt: give a longer one, or repeat it"
            )
        cloud = self._touches[self._played % len(self._touches)]()
        self._played += 1
        points = cloud.points_mm if len(cloud.points_mm) == NUM_POINTS else lattice_points(cloud)
        return TactileCloud(points_mm=points, sensor=self._spec, stamp=self._stamp())

    def check_alive(self) -> None:
        """Return while it is connected.

        Raises:
            TouchError: Disconnected.
        """
        if self._disconnected:
            raise TouchError(f"the recording {self._name} is disconnected; connect it again")

    def disconnect(self) -> None:
        """Play no more. Idempotent, never raises."""
        self._disconnected = True


def connect_recorded(
    settings: RecordedSettings, *, stamp: Callable[[], Stamp] = real_stamp
) -> RecordedSensor:
    """Open the recording of a rig's file.

    Raises:
        TouchError: It doesn't exist, can't be read, holds no touches, or is of another sensor.
    """
    sensor = sensor_named(settings.sensor)
    path = settings.path
    if path.is_dir():
        touches = _of_folder(settings, sensor)
    elif path.is_file() and path.suffix.lower() == ".mcap":
        touches = _of_episode(path, sensor)
    else:
        raise TouchError(f"no recording {path}; expected an episode (.mcap) or a folder of touches")
    log.info("%d recorded touches are played from %s: nothing is felt", len(touches), path)
    return RecordedSensor(str(path), touches, sensor, repeat=settings.repeat, stamp=stamp)


def _of_episode(path: Path, sensor: SensorSpec) -> list[Touch]:
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
    if not episode.ticks:
        raise TouchError(f"{path} holds no touch: its run ended before the first one")
    return [_kept(tick.cloud) for tick in episode.ticks]


def _kept(cloud: TactileCloud) -> Touch:
    return lambda: cloud


def _of_folder(settings: RecordedSettings, sensor: SensorSpec) -> list[Touch]:
    folder = settings.path
    background = settings.background or folder / BACKGROUND
    paths = sorted(
        (
            path
            for path in folder.iterdir()
            if path.suffix.lower() in _SUFFIXES and path.resolve() != background.resolve()
        ),
        key=lambda path: counted(path.name),
    )
    if not paths:
        raise TouchError(f"{folder} holds no touches; expected files {', '.join(_SUFFIXES)}")
    return [_of_file(path, settings, sensor, background) for path in paths]


def _of_file(path: Path, settings: RecordedSettings, sensor: SensorSpec, background: Path) -> Touch:
    calibration = None if settings.calibration == "shipped" else settings.calibration
    return lambda: read_touch(
        path,
        sensor,
        background=background if background.is_file() else None,
        calibration=calibration,
    )


def check(settings: RecordedSettings) -> Sequence[Finding]:
    """Look at the recording for ``tacgrasp doctor``: every touch of it is read once."""
    try:
        sensor = connect_recorded(settings.model_copy(update={"repeat": False}))
        count = len([sensor.read() for _ in range(sensor.length)])
    except TouchError as error:
        advice = "name another recording, or put right what it says"
        return [Finding(device="sensor", name="found", ok=False, found=str(error), advice=advice)]
    found = f"{count} recorded touches in {settings.path}: nothing is felt"
    return [Finding(device="sensor", name="found", ok=True, found=found)]
