"""``tacgrasp calibrate background``: take a GelSight Mini's picture with nothing touching it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_kept


@dataclass(frozen=True)
class CalibrateBackgroundFlags:
    """Take the picture of a GelSight Mini with nothing touching it.

    Frames of the untouched gel are averaged into the background named in a rig's file. Free the
    gel, let its LEDs warm up for a minute, and use the rig's light and crop. Heights are computed
    from the difference to the background.

    Attributes:
        unit: Name of this unit in the rig's file.
        device: Camera: its path under /dev/v4l/by-id, or its index.
        images: Folder of frames of the untouched gel, in place of a camera.
        out: File to write, a .png; an earlier background is replaced.
        overwrite: Replace any other picture, too.
        frames: Number of frames to average.
        crop_share: Fraction cut off on each side of a frame, as in the rig's file.
    """

    unit: str
    device: str | None = None
    images: Path | None = None
    out: Path = Path("background.png")
    overwrite: bool = False
    frames: int = 20
    crop_share: float = 1 / 7


def run(flags: CalibrateBackgroundFlags) -> None:
    """Average the frames and save them."""
    if not 2 <= flags.frames <= 1000:
        raise UsageError(f"--frames must be 2 to 1000, got {flags.frames}")
    if flags.out.suffix.lower() != ".png" or not flags.out.parent.is_dir():
        raise UsageError(f"--out must be a .png in a folder that exists, got {flags.out}")

    if (flags.device is None) == (flags.images is None):
        raise UsageError("give one of --device and --images")

    from pydantic import ValidationError

    from tacgrasp.console import make_console
    from tacgrasp.drivers.gelsight.background import is_background, save_background
    from tacgrasp.drivers.gelsight.connect import take_background
    from tacgrasp.drivers.gelsight.settings import GelSightSettings

    check_kept(flags.out, overwrite=flags.overwrite or is_background(flags.out))
    device = flags.device
    try:
        settings = GelSightSettings(
            device=int(device) if device is not None and device.isdigit() else device,
            images=flags.images,
            unit=flags.unit,
            background=flags.out,
            crop_share=flags.crop_share,
        )
    except ValidationError as error:
        first = error.errors()[0]
        raise UsageError(f"{'.'.join(map(str, first['loc']))} {first['msg']}".strip()) from None
    background = take_background(settings, num_frames=flags.frames)
    save_background(flags.out, background)
    console = make_console()
    console.print(f"background  {background.num_frames} frames of unit {background.unit}")
    console.print(f"taken       {background.taken:%Y-%m-%d %H:%M}")
    console.print(f"written     {flags.out}")
