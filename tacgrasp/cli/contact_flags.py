"""The flags that ``describe`` and ``ask`` name a contact by.

Not here: reading it (``tacgrasp.playback.contact_file``).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

if TYPE_CHECKING:
    from tacgrasp.playback.contact_file import ContactFile


@dataclass(frozen=True)
class ContactFlags:
    """One contact out of a file.

    Attributes:
        file: Cloud, height map, a frame of the sensor's camera (.png .jpg .bmp), or an episode.
        step: Number of the step of an episode; by default the last one.
        sensor: Name of the sensor that the file is from.
        background: For a frame: a frame of the same sensor unit with an untouched gel.
        calibration: For a frame: calibration of its sensor unit; by default the shipped one.
    """

    file: tyro.conf.Positional[Path]
    step: int | None = None
    sensor: str = "gelsight_mini"
    background: Path | None = None
    calibration: Path | None = None

    def read(self) -> ContactFile:
        """Read the contact; errors as for ``tacgrasp.playback.contact_file.read_contact``."""
        from tacgrasp.playback.contact_file import read_contact

        return read_contact(
            self.file,
            self.sensor,
            background=self.background,
            calibration=self.calibration,
            step=self.step,
        )
