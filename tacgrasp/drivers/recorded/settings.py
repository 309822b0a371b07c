"""Settings of a recorded sensor: the section ``hardware.sensor`` of a rig's file."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar, Literal

from pydantic import Field

from tacgrasp.drivers.force_scale import SensorUnitSettings


class RecordedSettings(SensorUnitSettings):
    """A recording in place of a sensor: nothing is felt.

    Attributes:
        kind: Name of the driver.
        path: An episode (.mcap), or a folder of clouds, height maps or frames, in counting order.
        sensor: Sensor of the recording.
        background: Frame of the untouched gel, for frames; None is background.png in the folder.
        calibration: Calibration of the frames' unit, or 'shipped'.
        repeat: Start again at the end; otherwise the end is an error.
    """

    is_live: ClassVar[bool] = False
    kind: Literal["recorded"] = "recorded"
    path: Path
    sensor: str = Field(default="gelsight_mini", min_length=1)
    background: Path | None = None
    calibration: Literal["shipped"] | Path = "shipped"
    repeat: bool = False

    @property
    def sensor_name(self) -> str:
        return self.sensor
