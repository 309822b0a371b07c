"""Settings of a GelSight Mini, as a rig's file gives them."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field, model_validator

from tacgrasp.base.settings import Number, Section


class GelSightSettings(Section):
    """A GelSight Mini: its camera, or a recording of one.

    Attributes:
        kind: Which driver.
        device: The camera: its path under /dev/v4l/by-id, which stays, or its index.
        video: A video file to play instead.
        images: A folder of images to play instead, in counting order, without its background.png.
        play_hz: Play at this rate, as if it were a camera; none: one image for each read [Hz].
        repeat: Begin anew where a recording ends; otherwise its end is an error.
        unit: What the unit is called in its calibration and background.
        calibration: Of this unit, from ``tacgrasp calibrate gelsight-mini``; or 'shipped', which is
            another unit's, so that heights are rough.
        background: Frame of this unit untouched, taken with it; a recording's may be any image.
        max_background_age_h: Older backgrounds are refused: gel and light change [h].
        max_calibration_age_days: Older calibrations are refused [days].
        crop_share: Cut off on each side of a frame that is larger than the sensor's map. Source:
            gsrobotics cuts a seventh, which gives the 0.0634 mm per pixel of the map.
        frame_age_s: How old a camera's frame can be when it arrives: exposure and transfer [s].
        read_timeout_s: Longest wait for a frame captured after the call [s].
        stale_s: Without a frame for so long, the camera is not alive [s].
        connect_timeout_s: Longest wait for the first frame [s].
    """

    kind: Literal["gelsight_mini"] = "gelsight_mini"
    device: int | str | None = None
    video: Path | None = None
    images: Path | None = None
    play_hz: Number | None = Field(default=None, ge=1, le=120)
    repeat: bool = False
    unit: str = Field(min_length=1)
    calibration: Literal["shipped"] | Path = "shipped"
    background: Path
    max_background_age_h: Number = Field(default=24.0, gt=0, le=10_000)
    max_calibration_age_days: Number = Field(default=180.0, gt=0, le=10_000)
    crop_share: Number = Field(default=1 / 7, ge=0, le=0.4)
    frame_age_s: Number = Field(default=0.08, ge=0, le=1)
    read_timeout_s: Number = Field(default=0.5, ge=0.05, le=5)
    stale_s: Number = Field(default=0.2, ge=0.02, le=5)
    connect_timeout_s: Number = Field(default=5.0, ge=0.1, le=30)

    @model_validator(mode="after")
    def _one_source(self) -> GelSightSettings:
        given = [n for n in ("device", "video", "images") if getattr(self, n) is not None]
        if len(given) != 1:
            raise ValueError(
                f"give one of device, video and images, got {' and '.join(given) or 'none'}"
            )
        if self.device is not None and (self.play_hz is not None or self.repeat):
            raise ValueError("play_hz and repeat are for video and images, not for a device")
        return self

    @property
    def is_camera(self) -> bool:
        """Whether it is the real thing."""
        return self.device is not None

    @property
    def source(self) -> str:
        """What the frames come from, for messages."""
        if self.device is not None:
            return f"camera {self.device}"
        return f"video {self.video}" if self.video is not None else f"images in {self.images}"
