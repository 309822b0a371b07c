"""Folders of ball presses, for the calibration of a GelSight Mini and the benchmarks on them.

A folder holds one frame per press of a ball on one unit, and ``background.png``. Not here: the
benchmarks (``tacgrasp.benchmarks.balls.heights``), learning a calibration
(``cltp.train.photometric``).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.sensing.calibration import WITHOUT_DOTS, default_calibration, load_calibration
from cltp.sensing.frames import FRAME_SUFFIXES, Frame, read_frame
from cltp.sensing.marker_field import without_dots
from cltp.sensing.photometric import Photometer
from cltp.tactile.sensors import SensorSpec, sensor_named
from tacgrasp.drivers.frame_folder import BACKGROUND, list_recorded


@dataclass(frozen=True, slots=True, kw_only=True)
class BallFrames:
    """The frames of a folder.

    Attributes:
        names: File names without suffix, in counting order.
        frames: One press each, (rows, columns, 3) uint8.
        background: Frame of the same unit with nothing touching it.
    """

    names: tuple[str, ...]
    frames: tuple[Frame, ...]
    background: Frame


def read_ball_frames(
    folder: Path, sensor: SensorSpec, background: Path | None = None
) -> BallFrames:
    """Read every image of ``folder`` but the background.

    Args:
        folder: Folder of the frames.
        sensor: Sensor of the frames; the dots of one with dots are painted over.
        background: Frame of the untouched gel; None is ``background.png`` in the folder.

    Raises:
        TouchError: No such folder, no images in it, no background, or an invalid image.
    """
    if not folder.is_dir():
        raise TouchError(f"{folder} is no folder; expected one with frames of ball presses")
    untouched = background or folder / BACKGROUND
    if not untouched.is_file():
        raise TouchError(
            f"no background {untouched}; expected a frame of the same unit with nothing touching "
            "it: name it with --background"
        )
    paths = list_recorded(folder, FRAME_SUFFIXES, content="frames", excluded=[untouched])
    frames = [read_frame(path, sensor) for path in paths]
    empty = read_frame(untouched, sensor)
    if sensor.name in WITHOUT_DOTS:
        frames, empty = without_dots(frames, empty, sensor)
    return BallFrames(
        names=tuple(path.stem for path in paths), frames=tuple(frames), background=empty
    )


def frames_heights(
    folder: Path,
    *,
    sensor: SensorSpec | None = None,
    background: Path | None = None,
    calibration: Path | None = None,
) -> list[tuple[str, NDArray[np.float32]]]:
    """Heights of every frame in a folder: (name, (rows, columns) [mm]).

    Args:
        folder: Folder of the frames.
        sensor: Sensor of the frames; None is a GelSight Mini.
        background: As in ``read_ball_frames``.
        calibration: Calibration file; None is the one that ships with the package.

    Raises:
        TouchError: As in ``read_ball_frames``, or the calibration can't be used.
    """
    sensor = sensor or sensor_named("gelsight_mini")
    balls = read_ball_frames(folder, sensor, background)
    net = load_calibration(calibration or default_calibration(sensor), sensor).net
    photometer = Photometer(net, balls.background, sensor)
    return [
        (name, photometer.heights(frame))
        for name, frame in zip(balls.names, balls.frames, strict=True)
    ]
