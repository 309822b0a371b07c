"""Sources of a GelSight Mini's frames: its camera, a video file, a folder of images.

Each source gives one frame after another, in red, green and blue, of the size of the sensor's map.
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
from tacgrasp.drivers.frame_folder import BACKGROUND, ended_message, list_recorded
from tacgrasp.drivers.gelsight.settings import GelSightSettings

BRIGHT_LEVEL, BRIGHT_FRACTION = 250, 0.3
"""A frame with more than this fraction of pixels at the end of a channel is over-exposed. Our
choice: our recorded frames have none."""

BY_ID = Path("/dev/v4l/by-id")

_NUM_READS = 3  # failed reads in a row that mean a lost camera; one can be a damaged transfer


class FrameSource(Protocol):
    """Gives frames to one thread."""

    def next_frame(self) -> Frame:
        """Wait for the next frame, (rows, columns, 3) uint8.

        Raises:
            TouchError: The camera is lost, the recording has ended, or the image is no frame.
        """

    def close(self) -> None:
        """Release the camera or file. Idempotent."""


class VideoCapture(Protocol):
    """The used part of ``cv2.VideoCapture``."""

    def isOpened(self) -> bool: ...  # noqa: N802 - OpenCV's name

    def read(self) -> tuple[bool, NDArray[Any] | None]:
        """Success, and the next frame in blue, green, red."""

    def release(self) -> None: ...


def open_camera(device: int | str) -> VideoCapture:
    """Open the camera of an index or a path, with the shortest buffer."""
    import cv2

    backend = cv2.CAP_V4L2 if sys.platform == "linux" else cv2.CAP_ANY
    source = device if isinstance(device, int) else str(Path(device).resolve())
    capture = cv2.VideoCapture(source, backend)
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
    return capture


class CameraSource:
    """A camera.

    Args:
        device: Path or index of the camera.
        sensor: Sensor whose map the frames fill.
        crop_share: Fraction cut off on each side of larger frames.
        opener: Opens the camera.

    Raises:
        TouchError: There is no such camera, or it can't be opened.
    """

    def __init__(
        self,
        device: int | str,
        sensor: SensorSpec,
        crop_share: float,
        opener: Callable[[int | str], VideoCapture] = open_camera,
    ) -> None:
        self._device, self._sensor, self._crop_share = device, sensor, crop_share
        if isinstance(device, str) and not Path(device).exists():
            raise TouchError(f"no camera {device}: is it plugged in? {_listed_cameras()}")
        self._capture = opener(device)
        if not self._capture.isOpened():
            raise TouchError(
                f"camera {device} can't be opened: another program has it, it is no camera, or you "
                f"may not read it (group video). {_listed_cameras()}"
            )

    def next_frame(self) -> Frame:
        """As ``FrameSource``; a failed read is repeated."""
        for _ in range(_NUM_READS):
            ok, image = self._capture.read()
            if ok and image is not None:
                return fit_to_sensor(image[..., ::-1], self._sensor, self._crop_share)
            if isinstance(self._device, str) and not Path(self._device).exists():
                raise TouchError(f"camera {self._device} was unplugged; plug it in, start again")
        raise TouchError(
            f"camera {self._device} gives no frames any more ({_NUM_READS} failed in a row): was "
            "it unplugged? Check the cable and start again"
        )

    def close(self) -> None:
        self._capture.release()


class VideoSource:
    """A video file, from its beginning.

    Raises:
        TouchError: It doesn't exist or can't be read.
    """

    def __init__(self, path: Path, sensor: SensorSpec, crop_share: float, repeat: bool) -> None:
        self._path, self._sensor, self._crop_share = path, sensor, crop_share
        self._repeat, self._num_played = repeat, 0
        if not path.is_file():
            raise TouchError(f"no video {path}; expected a file")
        self._capture = self._opened()

    def _opened(self) -> VideoCapture:
        import cv2

        capture = cv2.VideoCapture(str(self._path))
        if not capture.isOpened():
            raise TouchError(f"{self._path} is not a video that can be read")
        return capture

    def next_frame(self) -> Frame:
        ok, image = self._capture.read()
        if not ok and self._repeat and self._num_played:
            self._capture.release()
            self._capture = self._opened()
            ok, image = self._capture.read()
        if not ok or image is None:
            raise TouchError(ended_message(str(self._path), self._num_played))
        self._num_played += 1
        return fit_to_sensor(image[..., ::-1], self._sensor, self._crop_share)

    def close(self) -> None:
        self._capture.release()


class ImageSource:
    """A folder of images, in counting order.

    Raises:
        TouchError: No such folder, or no images in it.
    """

    def __init__(self, folder: Path, sensor: SensorSpec, background: Path, repeat: bool) -> None:
        if not folder.is_dir():
            raise TouchError(f"{folder} is no folder; expected one with frames")
        self._paths = list_recorded(
            folder, FRAME_SUFFIXES, content="frames", excluded=[folder / BACKGROUND, background]
        )
        self._folder, self._sensor, self._repeat, self._num_played = folder, sensor, repeat, 0

    def next_frame(self) -> Frame:
        """As ``FrameSource``; images must have the size of the map."""
        if self._num_played >= len(self._paths) and not self._repeat:
            raise TouchError(ended_message(str(self._folder), self._num_played))
        path = self._paths[self._num_played % len(self._paths)]
        self._num_played += 1
        return read_frame(path, self._sensor)

    def close(self) -> None:
        """As ``FrameSource``."""


def make_source(settings: GelSightSettings, sensor: SensorSpec) -> FrameSource:
    """Open the source named in the settings.

    Raises:
        TouchError: It doesn't exist or can't be opened.
    """
    if settings.device is not None:
        return CameraSource(settings.device, sensor, settings.crop_share)
    if settings.video is not None:
        return VideoSource(settings.video, sensor, settings.crop_share, settings.repeat)
    if settings.images is not None:
        return ImageSource(settings.images, sensor, settings.background, settings.repeat)
    raise TouchError("no source of frames; give device, video or images")


def fit_to_sensor(image: NDArray[Any], sensor: SensorSpec, crop_share: float) -> Frame:
    """Crop and scale a camera's image to a frame of the sensor, unless it has the size already.

    Args:
        image: (H, W, 3) uint8, red, green, blue.
        sensor: Sensor whose map the frame fills.
        crop_share: Fraction cut off on each side.

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
    """Reason why a frame shows no gel; empty for none."""
    mean = float(frame[::4, ::4].mean())
    if mean < DARK_LEVEL:
        return (
            f"the frame is black (mean {mean:.1f} of 255); expected the gel lit by its LEDs: check "
            "the cable and the exposure"
        )
    bright = float((frame[::4, ::4] >= BRIGHT_LEVEL).any(axis=2).mean())
    if bright > BRIGHT_FRACTION:
        return (
            f"{bright:.0%} of the frame is over-exposed; expected none: fix the camera's exposure, "
            "and check that the gel sits in its frame"
        )
    return ""


def _listed_cameras() -> str:
    names = sorted(path.name for path in BY_ID.iterdir()) if BY_ID.is_dir() else []
    return f"There are: {', '.join(names)}" if names else "This computer has no camera now"
