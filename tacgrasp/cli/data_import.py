"""``tacgrasp data import``: make a data set of your own measured contacts and their labels."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.base.errors import UsageError


@dataclass(frozen=True)
class ImportFlags:
    """Make a data set of height maps, clouds or frames and a table of their labels.

    The table (CSV) has a column file and any of shape, texture, depth, position, area, force_n,
    object, split, series. An empty depth, position, area or force is measured and marked as
    measured. An empty shape or texture stays unknown. After a bad row nothing is written.

    Attributes:
        folder: Folder of the files.
        labels: CSV file of the table.
        out: Folder of the new data set.
        sensor: Sensor that measured the contacts.
        background: Frame of the same unit with nothing touching it (frames only).
        calibration: Calibration of the unit (frames only). Default: the shipped one.
    """

    folder: tyro.conf.Positional[Path]
    labels: Path
    out: Path
    sensor: str = "gelsight_mini"
    background: Path | None = None
    calibration: Path | None = None


def import_table(flags: ImportFlags) -> None:
    """Run ``data import``."""
    from cltp.tactile.sensors import sensor_named
    from tacgrasp.console import make_console
    from tacgrasp.datasets.import_touches import Source, import_touches

    if not flags.folder.is_dir():
        raise UsageError(f"{flags.folder} is not a folder; expected that of the measured files")
    source = Source(
        folder=flags.folder,
        labels=flags.labels,
        sensor=sensor_named(flags.sensor),
        background=flags.background,
        calibration=flags.calibration,
    )
    counts = import_touches(source, flags.out)
    out = make_console()
    out.print(f"written   {flags.out}: {counts.contacts} contacts")
    for slot in counts.given:
        out.print(
            f"{slot:9} {counts.given[slot]} given, {counts.measured[slot]} measured, "
            f"{counts.unknown[slot]} unknown"
        )
