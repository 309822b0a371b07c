"""Frames of a camera behind a gel: reading image files, and checks that a frame is plausible.

Not here: heights from frames (``cltp.sensing.photometric``), live capture (``tacgrasp.drivers``).
"""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.sensors import SensorSpec

FRAME_SUFFIXES = (".png", ".jpg", ".jpeg", ".bmp")
"""Formats of image files."""

DARK_LEVEL = 10.0
"""Mean (of 255) below which a frame was taken without light. Our choice: the frames that we have
are at 92; without light a camera is at 0 to 3."""

JPEG_QUALITY = 92
"""Quality of frames in records, of 100. Our choice: for people; heights are stored as a cloud."""

MAX_RECORDED_PX = 4_000_000
"""Most pixels of a recorded frame. Our choice: fifty times those of a GelSight Mini."""

Frame = NDArray[np.uint8]


def read_frame(path: Path, sensor: SensorSpec) -> Frame:
    """Read one frame.

    Returns:
        Shape (rows, columns, 3), uint8, red, green, blue; row 0 is the top of the gel (+y).

    Raises:
        TouchError: Missing, not an image, truncated, in grey, of another size, or black.
    """
    from PIL import Image, UnidentifiedImageError  # only where an image is read

    if path.suffix.lower() not in FRAME_SUFFIXES:
        raise TouchError(f"{path}: expected an image {', '.join(FRAME_SUFFIXES)}")
    if not path.is_file():
        raise TouchError(f"{path} {'is a directory' if path.is_dir() else 'does not exist'}")
    try:
        with Image.open(path) as image:
            if image.mode not in ("RGB", "RGBA", "P"):
                raise TouchError(
                    f"{path}: expected a colour image, got mode {image.mode}; heights are read "
                    "from colours, so save the camera's frames in colour"
                )
            # the size is checked before the pixels are decoded: a file can claim any size
            _check_size((image.height, image.width), sensor, str(path))
            frame = np.asarray(image.convert("RGB"))
    except UnidentifiedImageError:
        raise TouchError(f"{path} is not an image that can be read") from None
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise TouchError(f"{path} can't be read whole: {error}") from None
    return check_frame(frame, sensor, str(path))


def jpeg_of(frame: Frame) -> bytes:
    """A frame as a JPEG file of quality ``JPEG_QUALITY``."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(frame).save(file, format="JPEG", quality=JPEG_QUALITY)
    return file.getvalue()


def frame_of_jpeg(data: bytes) -> Frame:
    """The pixels of a recorded frame, shape (H, W, 3).

    Raises:
        TouchError: Not a whole JPEG file, or of more than ``MAX_RECORDED_PX`` pixels.
    """
    from PIL import Image

    try:
        with Image.open(io.BytesIO(data), formats=("JPEG",)) as image:
            if image.width * image.height > MAX_RECORDED_PX:  # before anything is decoded
                raise TouchError(
                    f"a recorded frame has {image.width} × {image.height} px; expected at most "
                    f"{MAX_RECORDED_PX} pixels of a tactile sensor's camera"
                )
            return np.asarray(image.convert("RGB"))
    except (OSError, SyntaxError, ValueError) as error:
        raise TouchError(f"a recorded frame is no whole JPEG file: {error}") from None


def check_frame(frame: NDArray[np.generic], sensor: SensorSpec, name: str = "the frame") -> Frame:
    """Return ``frame`` if it can come from ``sensor``.

    Raises:
        TouchError: Wrong shape, type or size, or black.
    """
    if frame.ndim != 3 or frame.shape[2] != 3 or frame.dtype != np.uint8:
        raise TouchError(f"{name}: expected (H, W, 3) of uint8, got {frame.shape} of {frame.dtype}")
    _check_size(frame.shape[:2], sensor, name)
    mean = float(frame.mean())
    if mean < DARK_LEVEL:
        raise TouchError(
            f"{name} is black (mean {mean:.1f} of 255); expected the gel lit by the sensor's LEDs: "
            "check its cable and exposure"
        )
    return frame.astype(np.uint8, copy=False)


def _check_size(size: tuple[int, ...], sensor: SensorSpec, name: str) -> None:
    if tuple(size) != (sensor.rows, sensor.columns):
        raise TouchError(
            f"{name} has {size[1]} × {size[0]} px, expected {sensor.columns} × {sensor.rows} "
            f"of {sensor.name}; scale and crop it as the calibration's frames were"
        )
