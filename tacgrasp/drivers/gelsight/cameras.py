"""Where a GelSight Mini's frames come from: its camera, a video file, a folder of images.

Each source gives one frame after another, in red, green and blue, as large as the sensor's map.

Not here: threads and freshness (``gelsight_mini``), frames to heights
(``cltp.sensing.photometric``).
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.sensing.frames import DARK_LEVEL, FRAME_SUFFIXES, Frame, read_frame
from cltp.sensing.touch_files import ASPECT_TOLERANCE
from cltp.tactile.sensors import SensorSpec
from tacgrasp.drivers.gelsight.frame_folder import BACKGROUND, counted
from tacgrasp.drivers.gelsight.settings import GelSightSettings

BRIGHT_LEVEL, BRIGHT_SHARE = 250, 0.3
"""A frame with more than this share of pixels at the end of a channel is over-exposed. Our choice:
the frames that we have show none."""

BY_ID = Path("/dev/v4l/by-id")

_MISSED = 3  # failed reads in a row until a camera counts as lost; one can be a damaged transfer


class FrameSource(Protocol):
    """Gives frames, from one thread."""

    def next_frame(self) -> Frame:
        """Wait for the next frame, (rows, columns, 3) uint8.

        Raises:
            TouchError: The camera is lost, the recording has ended, or it is no frame.
        """
        ...

    def close(self) -> None:
        """Free what it holds. Idempotent."""
        ...


class Capture(Protocol):
    """As much of ``cv2.VideoCapture`` as is used."""

    def isOpened(self) -> bool:  # noqa: N802 - OpenCV's name
        """Whether it can be read."""
        ...

    def read(self) -> tuple[bool, NDArray[Any] | None]:
        """Next frame in blue, green, red; False without one."""
        ...

    def release(self) -> None:
        """Close it."""
        ...


def open_camera(device: int | str) -> Capture:
    """The camera of an index or a path, not buffering more than it must."""
    import cv2

    backend = cv2.CAP_V4L2 if sys.platform == "linux" else cv2.CAP_ANY
    where = device if isinstance(device, int) else str(Path(device).resolve())
    capture = cv2.VideoCapture(where, backend)
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
    return capture


def open_video(path: Path) -> Capture:
    """A video file."""
    import cv2

    return cv2.VideoCapture(str(path))


class CameraSource:
    """A camera.

    Args:
        device: Its path or index.
        sensor: Whose map the frames are to fill.
        crop_share: Cut off on each side of larger frames.
        opener: Opens it.

    Raises:
        TouchError: There is no such camera, or it can't be opened.
    """

    def __init__(
        self,
        device: int | str,
        sensor: SensorSpec,
        crop_share: float,
        opener: Callable[[int | str], Capture] = open_camera,
    ) -> None:
        self._device, self._sensor, self._crop_share = device, sensor, crop_share
        if isinstance(device, str) and not Path(device).exists():
            raise TouchError(f"no camera {device}: is it plugged in? {_cameras()}")
        self._capture = opener(device)
        if not self._capture.isOpened():
            raise TouchError(
                f"camera {device} can't be opened: another program has it, it is no camera, or you "
                f"may not read it (group video). {_cameras()}"
            )

    def next_frame(self) -> Frame:
        """As ``FrameSource``; a single failed read is tried again."""
        for _ in range(_MISSED):
            came, image = self._capture.read()
            if came and image is not None:
                return fitted(image[..., ::-1], self._sensor, self._crop_share)
            if isinstance(self._device, str) and not Path(self._device).exists():
                raise TouchError(f"camera {self._device} was unplugged; plug it in, start again")
        raise TouchError(
            f"camera {self._device} gives no frames any more ({_MISSED} failed in a row): was it "
            "unplugged? Check the cable and start again"
        )

    def close(self) -> None:
        """As ``FrameSource``."""
        self._capture.release()


class VideoSource:
    """A video file, from its beginning.

    Raises:
        TouchError: It doesn't exist or can't be read.
    """

    def __init__(self, path: Path, sensor: SensorSpec, crop_share: float, repeat: bool) -> None:
        self._path, self._sensor, self._crop_share = path, sensor, crop_share
        self._repeat, self._played = repeat, 0
        if not path.is_file():
            raise TouchError(f"no video {path}; expected a file")
        self._capture = self._opened()

    def _opened(self) -> Capture:
        capture = open_video(self._path)
        if not capture.isOpened():
            raise TouchError(f"{self._path} is not a video that can be read")
        return capture

    def next_frame(self) -> Frame:
        """As ``FrameSource``."""
        came, image = self._capture.read()
        if not came and self._repeat and self._played:
            self._capture.release()
            self._capture = self._opened()
            came, image = self._capture.read()
        if not came or image is None:
            raise TouchError(ended(str(self._path), self._played))
        self._played += 1
        return fitted(image[..., ::-1], self._sensor, self._crop_share)

    def close(self) -> None:
        """As ``FrameSource``."""
        self._capture.release()


class ImageSource:
    """A folder of images, in counting order.

    Raises:
        TouchError: No such folder, or no images in it.
    """

    def __init__(self, folder: Path, sensor: SensorSpec, background: Path, repeat: bool) -> None:
        if not folder.is_dir():
            raise TouchError(f"{folder} is no folder; expected one with frames")
        apart = {(folder / BACKGROUND).resolve(), background.resolve()}
        self._paths = sorted(
            (
                path
                for path in folder.iterdir()
                if path.suffix.lower() in FRAME_SUFFIXES and path.resolve() not in apart
            ),
            key=lambda path: counted(path.name),
        )
        if not self._paths:
            raise TouchError(f"{folder} holds no frames; expected {', '.join(FRAME_SUFFIXES)}")
        self._folder, self._sensor, self._repeat, self._played = folder, sensor, repeat, 0

    def next_frame(self) -> Frame:
        """As ``FrameSource``; images have to be as large as the map."""
        if self._played >= len(self._paths) and not self._repeat:
            raise TouchError(ended(str(self._folder), self._played))
        path = self._paths[self._played % len(self._paths)]
        self._played += 1
        return read_frame(path, self._sensor)

    def close(self) -> None:
        """As ``FrameSource``."""


def make_source(settings: GelSightSettings, sensor: SensorSpec) -> FrameSource:
    """The source that the settings name.

    Raises:
        TouchError: It isn't there, or can't be opened.
    """
    if settings.device is not None:
        return CameraSource(settings.device, sensor, settings.crop_share)
    if settings.video is not None:
        return VideoSource(settings.video, sensor, settings.crop_share, settings.repeat)
    if settings.images is not None:
        return ImageSource(settings.images, sensor, settings.background, settings.repeat)
    raise TouchError("no source of frames; give device, video or images")


def ended(what: str, played: int) -> str:
    """What to tell a person when a recording is over."""
    return (
        f"the recording {what} has ended after {played} touches; nothing newer can be felt: give a "
        "longer one, or repeat it"
    )


def fitted(image: NDArray[Any], sensor: SensorSpec, crop_share: float) -> Frame:
    """A camera's image as a frame of the sensor: cropped and scaled, unless it is one already.

    Args:
        image: (H, W, 3) uint8, red, green, blue.
        sensor: Whose map it is to fill.
        crop_share: Cut off on each side.

    Raises:
        TouchError: Not in colour, too small, or of another aspect.
    """
    if image.ndim != 3 or image.shape[2] != 3 or image.dtype != np.uint8:
        raise TouchError(f"expected frames in 8-bit colour, got {image.shape} of {image.dtype}")
    if image.shape[:2] == (sensor.rows, sensor.columns):
        return np.ascontiguousarray(image)
    down, across = (round(crop_share * size) for size in image.shape[:2])
    cropped = image[down : image.shape[0] - down, across : image.shape[1] - across]
    rows, columns = cropped.shape[:2]
    aspect = columns / rows / (sensor.columns / sensor.rows)
    if rows < sensor.rows or columns < sensor.columns or abs(aspect - 1) > ASPECT_TOLERANCE:
        raise TouchError(
            f"a frame of {image.shape[1]} × {image.shape[0]} px, of which {columns} × {rows} are "
            f"left by crop_share, doesn't fit {sensor.columns} × {sensor.rows} of {sensor.name}; "
            "choose a camera mode that does, and crop as for the calibration"
        )
    import cv2

    size = (sensor.columns, sensor.rows)
    return np.asarray(cv2.resize(cropped, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)


def frame_problem(frame: Frame) -> str:
    """Why a frame shows no gel; empty when it may."""
    mean = float(frame[::4, ::4].mean())
    if mean < DARK_LEVEL:
        return (
            f"the frame is black (mean {mean:.1f} of 255); expected the gel lit by its LEDs: check "
            "the cable and the exposure"
        )
    bright = float((frame[::4, ::4] >= BRIGHT_LEVEL).any(axis=2).mean())
    if bright > BRIGHT_SHARE:
        return (
            f"{bright:.0%} of the frame is over-exposed; expected none: fix the camera's exposure, "
            "and look whether the gel sits in its frame"
        )
    return ""


def _cameras() -> str:
    names = sorted(path.name for path in BY_ID.iterdir()) if BY_ID.is_dir() else []
    return f"There are: {', '.join(names)}" if names else "This computer has no camera now"
