"""Settings of a recorded sensor, as a rig's file gives them."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field

from tacgrasp.base.settings import Section


class RecordedSettings(Section):
    """Touches of the past in place of a sensor: nothing is felt.

    Attributes:
        kind: Which driver.
        path: An episode (.mcap), or a folder of clouds, height maps or frames, in counting order.
        sensor: Which sensor they are of.
        background: For frames: the untouched gel; background.png in the folder when not given.
        calibration: For frames: of their unit; or 'shipped'.
        repeat: Begin anew at the end; otherwise the end is an error.
    """

    kind: Literal["recorded"] = "recorded"
    path: Path
    sensor: str = Field(default="gelsight_mini", min_length=1)
    background: Path | None = None
    calibration: Literal["shipped"] | Path = "shipped"
    repeat: bool = False
