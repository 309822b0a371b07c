"""Requests for data; ``tacgrasp data`` and ``tacgrasp simulate`` read their flags into them.

Imports nothing heavy, so that ``--help`` answers at once.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.base.errors import UsageError


@dataclass(frozen=True)
class GenerateRequest:
    """Make a data set of simulated contacts. The same command continues an interrupted one.

    Attributes:
        out: Folder of the data set; created when missing.
        set: full: the most varied contacts, on four sensors, to train on. paper: the paper's 117
            objects, for its tables.
        contacts: Number of contacts. Default: all, which is 120000 for full and 52425 for paper.
        seed: Random seed of the whole set, below 1000000. Larger seeds belong to the benchmarks.
        shard: Part i of n as i/n, to share the work among machines. Afterwards copy the files of
            all parts into one folder and run the command once more without --shard.
        workers: Number of processes, one per core by default. It does not change the result.
        on: Address of the scheduler of a dask.distributed cluster, such as tcp://10.0.0.1:8786,
            whose workers make the shards instead; this process writes them (extra: scale).
        meshes: Folder of meshes (PLY, OBJ, STL; mm) to press as well (paper only).
        device: Device for the computation: cpu or cuda.
    """

    out: Path
    set: str = "paper"
    contacts: int | None = None
    seed: int = 0
    shard: str | None = None
    workers: int | None = None
    on: str | None = None
    meshes: Path | None = None
    device: str = "cpu"


@dataclass(frozen=True)
class ImportRequest:
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
        least_depth_mm: Heights that stay below this are no contact, and must not be labelled as
            one. Less than the default is for heights without noise.
        held_out: Fraction of the series whose contacts, where the table gives no split, go into the
            split test, drawn at random.
        seed: Random seed of that.
    """

    folder: tyro.conf.Positional[Path]
    labels: Path
    out: Path
    sensor: str = "gelsight_mini"
    background: Path | None = None
    calibration: Path | None = None
    least_depth_mm: float = 0.10
    held_out: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        if not 0 <= self.held_out < 1 or self.seed < 0:
            raise UsageError("--held-out must be 0 to below 1, --seed at least 0")
        if not 0 < self.least_depth_mm <= 1:
            raise UsageError(f"--least-depth-mm must be 0 to 1, got {self.least_depth_mm:g}")
        if not self.folder.is_dir():
            raise UsageError(f"{self.folder} is not a folder; expected that of the measured files")


@dataclass(frozen=True)
class PressRequest:
    """Press an object into a sensor's gel; print force, area, pressure and label.

    The file of --out holds height_mm (H, W), positive into the gel, row 0 at the top, over the
    whole sensing area; pressure_kpa (H, W); force_n; what the sensor would report as cloud_mm
    (N, 3); and with noise its heights seen_mm (H, W), or of a sensor that tracks markers its
    points_mm (N, 3), which are then what other commands read.

    Attributes:
        object: ball:DIAMETER, cylinder:DIAMETER (lying along x) or flat:EDGE (square), in mm; or
            the name of an object of the catalogue, in a random pose.
        depth_mm: Depth of the object's tip below the undeformed surface [mm].
        sensor: Sensor: gelsight_mini, gelsight_mini_markers, gelsight_r15, digit, gelstereo or
            taxels.
        x_mm: Position of the tip, positive to the right of the pad's centre [mm]; of an object of
            the catalogue, added to its random place.
        y_mm: The same, positive towards the top of the pad [mm].
        turn_deg: Rotation of the object in the plane of the pad [deg].
        grid: Grid over the sensing area, COLUMNSxROWS. Default: the sensor's own, 320x240.
        noise: Noise of the sensor: none, unit (a calibrated unit) or uncalibrated.
        seed: Random seed of the noise and of the pose of a catalogue object.
        device: Device for the computation: cpu or cuda.
        out: File to write (.npz).
    """

    object: str
    depth_mm: float
    sensor: str = "gelsight_mini"
    x_mm: float = 0.0
    y_mm: float = 0.0
    turn_deg: float = 0.0
    grid: str = ""
    noise: str = "none"
    seed: int = 0
    device: str = "cpu"
    out: Path | None = None

    @property
    def columns_rows(self) -> tuple[int, int] | None:
        """The grid; None for the sensor's own."""
        if not self.grid:
            return None
        match = re.fullmatch(r"(\d+)x(\d+)", self.grid)
        if match is None:
            raise UsageError(f"--grid must be like 320x240, got {self.grid!r}")
        return int(match[1]), int(match[2])

    def __post_init__(self) -> None:
        if self.seed < 0:
            raise UsageError(f"--seed must not be negative, got {self.seed}")
        if self.out is not None and not self.out.parent.is_dir():
            raise UsageError(f"--out {self.out}: {self.out.parent} is not a folder")
