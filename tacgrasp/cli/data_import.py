"""``tacgrasp data import``: a person's own touches, with what is known of them, as a data set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class Import:
    """Bring heights, clouds or frames with a table of labels into a new data set.

    The table (CSV) has a column file and any of shape, texture, depth, position, area, force_n,
    object, split, series. Where depth, position, area or force are empty they are measured and
    marked so; an empty shape or texture stays unknown. A bad row stops everything.

    Attributes:
        folder: Where the files are.
        labels: The table.
        out: Folder of the data set; made new.
        sensor: Whose field the touches are on.
        background: For frames: another of the same unit with nothing touching it.
        calibration: For frames: of its unit; without it the one that comes along.
    """

    folder: tyro.conf.Positional[Path]
    labels: Path
    out: Path
    sensor: str = "gelsight_mini"
    background: Path | None = None
    calibration: Path | None = None


def import_touches(argv: Sequence[str]) -> int:
    """Bring your own heights, clouds or frames with a table of labels into a data set."""
    flags = parse(Import, argv, prog="tacgrasp data import")
    from cltp.tactile.sensors import sensor_named
    from tacgrasp.console import console
    from tacgrasp.datasets.import_touches import Source
    from tacgrasp.datasets.import_touches import import_touches as bring_in

    if not flags.folder.is_dir():
        raise UsageError(f"{flags.folder} is no folder; expected the one with the touches' files")
    source = Source(
        folder=flags.folder,
        labels=flags.labels,
        sensor=sensor_named(flags.sensor),
        background=flags.background,
        calibration=flags.calibration,
    )
    found = bring_in(source, flags.out)
    to = console()
    to.print(f"written   {flags.out}: {found.contacts} contacts")
    for slot in found.given:
        to.print(
            f"{slot:9} {found.given[slot]} given, {found.measured[slot]} measured, "
            f"{found.unknown[slot]} unknown"
        )
    return 0
