"""The untouched gel of one unit: averaged, saved with its date, refused when it is out of date.

A background is a PNG that any viewer shows; unit, date and number of frames are in its text.
"""

from __future__ import annotations

import datetime
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from cltp.atomic_write import replacing
from cltp.errors import TouchError
from cltp.sensing.frames import Frame, check_frame, read_frame
from cltp.tactile.sensors import SensorSpec

VERSION = 1
_KEY = "tacgrasp_background"

BLUR_PX = 2.0

UNTOUCHED_LEVELS = 6.0
"""Largest (blurred) change of a pixel of an untouched gel. Our choice: in our recorded frames, 0.7
levels where untouched, 30 under the faintest press."""

UNTOUCHED_FRACTION = 0.01
"""Fraction of pixels that may change more, because of dust."""

LIGHT_FRACTION = 0.5
"""Fraction of changed pixels that means another light or a wrong background; fewer: an object."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Background:
    """The untouched gel.

    Attributes:
        frame: (rows, columns, 3) uint8.
        unit: Name of the unit; empty if the image has no record.
        taken: Date and time, with the time zone; None if the image has no record.
        num_frames: Number of averaged frames; 0 if the image has no record.
    """

    frame: Frame
    unit: str
    taken: datetime.datetime | None
    num_frames: int

    def age_h(self, now: datetime.datetime) -> float | None:
        return None if self.taken is None else (now - self.taken).total_seconds() / 3600


def average_frames(
    frames: Sequence[Frame], sensor: SensorSpec, unit: str, taken: datetime.datetime
) -> Background:
    """Average several frames into one background.

    Raises:
        TouchError: Fewer than two frames, a frame of another sensor, or frames that differ from
            each other: something moves, or the light changes.
    """
    if len(frames) < 2:
        raise TouchError(f"a background is averaged from 2 frames or more, got {len(frames)}")
    stack = [check_frame(frame, sensor) for frame in frames]
    check_still(stack)
    frame = np.rint(np.mean(stack, axis=0)).astype(np.uint8)
    return Background(frame=frame, unit=unit, taken=taken, num_frames=len(frames))


def check_still(frames: Sequence[Frame]) -> None:
    """Compare the first half of two or more frames with the second.

    Raises:
        TouchError: They differ: something moves, or the light changes.
    """
    half = len(frames) // 2
    change = pixel_change(np.mean(frames[half:], axis=0), np.mean(frames[:half], axis=0))
    fraction = float((change > UNTOUCHED_LEVELS / 2).mean())
    if fraction > UNTOUCHED_FRACTION:
        raise TouchError(
            f"{fraction:.0%} of the picture changed while the background was taken; expected a "
            "still one: let nothing touch the gel, and let the LEDs warm up for a minute"
        )


def pixel_change(frame: NDArray[np.number], other: NDArray[np.number]) -> NDArray[np.float32]:
    """Change of each pixel, (rows, columns), in levels: blurred, largest of the colours."""
    change = frame.astype(np.float32) - other.astype(np.float32)
    blurred = ndimage.gaussian_filter(change, (BLUR_PX, BLUR_PX, 0))
    return np.asarray(np.abs(blurred).max(axis=2), dtype=np.float32)


def mismatch(frame: Frame, background: Frame) -> str:
    """Reason why a frame differs from the untouched gel of a background; empty for none."""
    fraction = float((pixel_change(frame, background) > UNTOUCHED_LEVELS).mean())
    if fraction > LIGHT_FRACTION:
        return (
            f"stale background: {fraction:.0%} of the picture differs from it by more than "
            f"{UNTOUCHED_LEVELS:g} levels although nothing touches; another unit, another gel or "
            "another light: take a new one: tacgrasp calibrate background"
        )
    if fraction > UNTOUCHED_FRACTION:
        return (
            f"{fraction:.0%} of the picture differs from the background by more than "
            f"{UNTOUCHED_LEVELS:g} levels although nothing should touch: free the gel and clean "
            "it; if it is free, the background is stale or the gel is damaged: take a new one"
        )
    return ""


def is_background(path: Path) -> bool:
    """Whether a file is a background with our record, which a new one may replace."""
    from PIL import Image

    try:
        with Image.open(path) as image:
            return _KEY in getattr(image, "text", {})
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        return False


def save_background(path: Path, background: Background) -> None:
    """Write a background, whole or not at all.

    Raises:
        TouchError: The background has no date, or the file's name does not end in .png.
        OSError: The file can't be written.
    """
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    if background.taken is None or path.suffix.lower() != ".png":
        raise TouchError(f"{path}: a background is kept as a .png, with its date")
    record = {
        "version": VERSION,
        "unit": background.unit,
        "taken": background.taken.isoformat(timespec="seconds"),
        "num_frames": background.num_frames,
    }
    text = PngInfo()
    text.add_text(_KEY, json.dumps(record))
    with replacing(path) as part:
        Image.fromarray(background.frame).save(part, format="PNG", pnginfo=text)


def load_background(
    path: Path,
    sensor: SensorSpec,
    *,
    unit: str,
    max_age_h: float,
    now: datetime.datetime,
    dated: bool,
) -> Background:
    """Read a background, and refuse a wrong or old one.

    Args:
        path: A file of ``save_background``; or, unless ``dated``, any image.
        sensor: Expected sensor of the frame.
        unit: Expected unit, if ``dated``.
        max_age_h: Largest age, if ``dated`` [h].
        now: Present time, with the time zone.
        dated: Whether a record with unit and date is required: for a camera, not for a recording.

    Raises:
        TouchError: The file is missing, no frame of this sensor, of another unit, too old, from the
            future, or without a required record.
    """
    if not path.is_file():
        raise TouchError(
            f"no background {path}: free the gel and take one: tacgrasp calibrate background"
        )
    frame = read_frame(path, sensor)
    background = _with_record(path, frame)
    if not dated:  # a recording is as old as its own background
        return background
    age_h = background.age_h(now)
    if age_h is None:
        raise TouchError(
            f"{path} does not say when and of which unit it was taken; a camera needs a "
            "background that does: free the gel and take one: tacgrasp calibrate background"
        )
    if background.unit != unit:
        raise TouchError(
            f"{path} is of unit {background.unit!r}, expected {unit!r}: take one with this unit"
        )
    if not -0.1 <= age_h <= max_age_h:
        raise TouchError(
            f"{path} was taken {age_h:.0f} h ago, expected 0 to {max_age_h:g} h "
            "(max_background_age_h): free the gel and take a new one: tacgrasp calibrate "
            "background; if it is new, set the clock"
        )
    return background


def _with_record(path: Path, frame: Frame) -> Background:
    from PIL import Image

    with Image.open(path) as image:
        text = getattr(image, "text", {}).get(_KEY)
    if text is None:
        return Background(frame=frame, unit="", taken=None, num_frames=0)
    try:
        record = json.loads(text)
        taken = datetime.datetime.fromisoformat(record["taken"])
        if record["version"] != VERSION or taken.tzinfo is None:
            raise ValueError(f"version {record['version']}, {taken}")
        unit, num_frames = str(record["unit"]), int(record["num_frames"])
        return Background(frame=frame, unit=unit, taken=taken, num_frames=num_frames)
    except (ValueError, KeyError, TypeError) as error:
        raise TouchError(
            f"{path}: its record can't be understood ({error}); take a new background"
        ) from None
