"""Folders of ball presses: frames of one unit and ``background.png``; their heights.

Not here: benchmarks on them (``tacgrasp.benchmarks.sensing.balls``), calibrating
(``cltp.train.photometric``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.sensing.calibration import default_calibration, load_calibration
from cltp.sensing.frames import FRAME_SUFFIXES, Frame, read_frame
from cltp.sensing.photometric import Photometer
from cltp.tactile.sensors import SensorSpec, sensor_named

BACKGROUND = "background.png"


@dataclass(frozen=True, slots=True, kw_only=True)
class BallFrames:
    """What a folder holds.

    Attributes:
        names: File names without suffix, ordered as a person counts.
        frames: One press each, (rows, columns, 3) uint8.
        background: The same unit untouched.
    """

    names: tuple[str, ...]
    frames: tuple[Frame, ...]
    background: Frame


def read_ball_frames(
    folder: Path, sensor: SensorSpec, background: Path | None = None
) -> BallFrames:
    """Read every image of ``folder`` but the background.

    Args:
        folder: Where they are.
        sensor: Whose frames they are.
        background: The untouched gel; None is ``background.png`` in the folder.

    Raises:
        TouchError: No such folder, no images in it, no background, or an image that is no frame.
    """
    if not folder.is_dir():
        raise TouchError(f"{folder} is no folder; expected one with frames of ball presses")
    behind = background or folder / BACKGROUND
    if not behind.is_file():
        raise TouchError(
            f"no background {behind}; expected a frame of the same unit with nothing touching it: "
            "name it with --background"
        )
    paths = [
        path
        for path in sorted(folder.iterdir(), key=lambda path: counted(path.name))
        if path.suffix.lower() in FRAME_SUFFIXES and path.resolve() != behind.resolve()
    ]
    if not paths:
        raise TouchError(f"{folder} holds no frames; expected {', '.join(FRAME_SUFFIXES)}")
    return BallFrames(
        names=tuple(path.stem for path in paths),
        frames=tuple(read_frame(path, sensor) for path in paths),
        background=read_frame(behind, sensor),
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
        folder: Where the frames are.
        sensor: Whose they are; None is a GelSight Mini.
        background: As ``read_ball_frames``.
        calibration: None is the one that ships.

    Raises:
        TouchError: As ``read_ball_frames``, or the calibration can't be used.
    """
    sensor = sensor or sensor_named("gelsight_mini")
    balls = read_ball_frames(folder, sensor, background)
    net = load_calibration(calibration or default_calibration(sensor), sensor).net
    photometer = Photometer(net, balls.background, sensor)
    return [
        (name, photometer.heights(frame))
        for name, frame in zip(balls.names, balls.frames, strict=True)
    ]


def counted(name: str) -> list[tuple[int, str]]:
    """Key that sorts as a person counts: ball_2 before ball_10."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", name)]
