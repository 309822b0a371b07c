"""Settings of a GelSight Mini: the section ``hardware.sensor`` of a rig's file."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field, model_validator

from tacgrasp.base.settings import Number
from tacgrasp.drivers.force_scale import SensorUnitSettings


class GelSightSettings(SensorUnitSettings):
    """A GelSight Mini: its camera, or a recording of one.

    Attributes:
        kind: Name of the driver.
        sensor: ``gelsight_mini_markers`` for the gel with 7 × 9 dots, which shows shear.
        device: Camera: its path under /dev/v4l/by-id, which is stable, or its index.
        video: Video file to play instead of a camera.
        images: Folder of images to play instead, in counting order, without its background.png.
        play_hz: Rate of a recording played like a camera [Hz]; None gives one image for each read.
        repeat: Start a recording again at its end; otherwise its end is an error.
        unit: Name of the unit in its calibrations and background.
        calibration: File of this unit from ``tacgrasp calibrate gelsight-mini``; or 'shipped',
            which belongs to another unit, so that heights are rough.
        background: Frame of this unit's untouched gel; for a recording, any image.
        max_background_age_h: Largest age of a background: gel and light change [h].
        max_calibration_age_days: Largest age of a calibration [days].
        crop_share: Fraction cut off on each side of a frame larger than the sensor's map. Source:
            gsrobotics cuts a seventh, which gives the 0.0634 mm per pixel of the map.
        frame_age_s: Largest age of a camera's frame at arrival: exposure and transfer [s].
        read_timeout_s: Longest wait for a frame captured after the call [s].
        connect_timeout_s: Longest wait for the first frame [s].
    """

    kind: Literal["gelsight_mini"] = "gelsight_mini"
    sensor: Literal["gelsight_mini", "gelsight_mini_markers"] = "gelsight_mini"
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
    connect_timeout_s: Number = Field(default=5.0, ge=0.1, le=30)

    @model_validator(mode="after")
    def _one_source(self) -> GelSightSettings:
        names = [n for n in ("device", "video", "images") if getattr(self, n) is not None]
        if len(names) != 1:
            raise ValueError(
                f"give one of device, video and images, got {' and '.join(names) or 'none'}"
            )
        if self.device is not None and (self.play_hz is not None or self.repeat):
            raise ValueError("play_hz and repeat are for video and images, not for a device")
        return self

    @property
    def sensor_name(self) -> str:
        return self.sensor

    @property
    def is_camera(self) -> bool:
        return self.device is not None

    @property
    def source(self) -> str:
        if self.device is not None:
            return f"camera {self.device}"
        return f"video {self.video}" if self.video is not None else f"images in {self.images}"

    @property
    def is_live(self) -> bool:
        return self.is_camera
