"""``tacgrasp describe FILE``: the contact state of a cloud or height map in words and numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class Describe:
    """Say what a cloud (.ply .pcd .xyz .npy .npz) or a height map (.npy .npz), in mm, is.

    Attributes:
        file: The file.
        sensor: Whose field it is.
    """

    file: tyro.conf.Positional[Path]
    sensor: str = "gelsight_mini"


def main(argv: Sequence[str]) -> int:
    """Describe one file."""
    flags = parse(Describe, argv, prog="tacgrasp describe")
    from cltp.files import read_touch
    from cltp.sensors import sensor_named
    from tacgrasp.describe import describe
    from tacgrasp.view import console

    to = console()
    for line in describe(read_touch(flags.file, sensor_named(flags.sensor))):
        to.print(line)
    return 0
