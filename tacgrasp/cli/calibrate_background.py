"""``tacgrasp calibrate background``: take a GelSight Mini's picture with nothing touching it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class CalibrateBackgroundFlags:
    """Average frames of the untouched gel into the background that a rig's file names.

    Free the gel, let its LEDs warm up for a minute, and take it with the light and the crop that
    the rig will have. Heights are read from what differs from it.

    Attributes:
        unit: What the rig's file calls this unit.
        device: The camera: its path under /dev/v4l/by-id, or its index.
        images: A folder of untouched frames instead.
        out: File to write, a .png.
        frames: How many are averaged.
        crop_share: Cut off on each side, as in the rig's file.
    """

    unit: str
    device: str | None = None
    images: Path | None = None
    out: Path = Path("background.png")
    frames: int = 20
    crop_share: float = 1 / 7


def main(argv: Sequence[str]) -> None:
    """The untouched gel of a GelSight Mini."""
    flags = parse(CalibrateBackgroundFlags, argv, prog="tacgrasp calibrate background")
    if not 2 <= flags.frames <= 1000:
        raise UsageError(f"--frames must be 2 to 1000, got {flags.frames}")
    if flags.out.suffix.lower() != ".png" or not flags.out.parent.is_dir():
        raise UsageError(f"--out must be a .png in a folder that exists, got {flags.out}")

    from pydantic import ValidationError

    from tacgrasp.console import make_console
    from tacgrasp.drivers.gelsight.background import save_background
    from tacgrasp.drivers.gelsight.connect import take_background
    from tacgrasp.drivers.gelsight.settings import GelSightSettings

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
    to = make_console()
    to.print(f"background  {background.num_frames} frames of unit {background.unit}")
    to.print(f"taken       {background.taken:%Y-%m-%d %H:%M}")
    to.print(f"written     {flags.out}")
