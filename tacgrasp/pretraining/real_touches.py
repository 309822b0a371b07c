"""Real touches with labels: frames, height maps or clouds, and a table of their classes.

The table is CSV with the columns ``file, shape, texture, depth, position, area``: a file relative
to the folder, and words of ``cltp.tactile.states``, empty where unknown. Frames need a picture of
the same unit untouched; it is ``background.png`` of the folder unless another is named.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.atomic_write import replacing
from cltp.checkpoints.frozen import FrozenEncoder
from cltp.encoder.render import render
from cltp.errors import TouchError
from cltp.evaluation.features import EncodedContacts
from cltp.sensing.frames import FRAME_SUFFIXES
from cltp.sensing.touch_files import read_cloud, read_heights
from cltp.tactile.cells import resampled
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input, grid_points
from cltp.tactile.point_layout import PointLayout
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import CLASSES, NUMBERS
from tacgrasp.base.errors import UsageError

COLUMNS = ("file", *CLASSES)
BACKGROUND = "background.png"


@dataclass(frozen=True, slots=True, kw_only=True)
class RealTouches:
    """Labelled touches of one sensor, with the inputs of encoders that are made from them.

    Attributes:
        name: Name in tables.
        files: The files.
        labels: Class numbers, shape (N, 5); -1 where unknown.
        clouds: Clouds of 1024 evenly spaced points.
        heights_mm: Height maps, shape (H, W) each, with median 0.
        frames: Rendered frames, shape (N, 3, 64, 64).
    """

    name: ClassVar[str] = "real"

    files: Sequence[Path]
    labels: Tensor
    clouds: Sequence[TactileCloud]
    heights_mm: Sequence[NDArray[np.float32]]
    frames: Tensor

    def points(self, layout: PointLayout) -> Tensor:
        """Scaled points, shape (N, points, 3), in the layout that an encoder takes."""
        if layout.is_sampled:
            return torch.from_numpy(np.stack([encoder_input(cloud) for cloud in self.clouds]))
        points = []
        for cloud, heights_mm in zip(self.clouds, self.heights_mm, strict=True):
            cells = layout.cells_on(cloud.sensor.width_mm, cloud.sensor.height_mm)
            points.append(grid_points(resampled(heights_mm, *cells), cloud.sensor, layout))
        return torch.from_numpy(np.stack(points))

    def encode(self, encoder: FrozenEncoder) -> EncodedContacts:
        """Features with labels; the numbers are NaN.

        Raises:
            TouchError: A feature is not finite; it names the file.
        """
        inputs = self.frames if encoder.sees_images else self.points(encoder.layout)
        parts = [encoder.read(batch) for batch in inputs.split(64)]
        pooled, feature = (torch.cat(part).float() for part in zip(*parts, strict=True))
        is_finite = feature.isfinite().all(dim=1)
        if not is_finite.all():
            raise TouchError(
                f"{self.files[int(is_finite.int().argmin())]}: its feature is not finite"
            )
        return EncodedContacts(
            pooled=pooled,
            feature=feature,
            classes=self.labels,
            numbers=torch.full((len(self.files), len(NUMBERS)), math.nan),
            index=torch.arange(len(self.files)),
        )

    def write_predictions(self, path: Path, scores: Sequence[Tensor], measure: str) -> None:
        """Write a CSV file: for each touch the best classes and their scores.

        Args:
            path: The file.
            scores: Scores of each class by dimension, shape (N, classes).
            measure: What scores are: ``cosine`` or ``probability``.

        Raises:
            UsageError: It can't be written.
        """
        columns: dict[str, list[str]] = {"file": [str(file) for file in self.files]}
        for (slot, names), of_slot in zip(CLASSES.items(), scores, strict=True):
            columns[slot] = [names[best] for best in of_slot.argmax(1).tolist()]
        for slot, of_slot in zip(CLASSES, scores, strict=True):
            columns[f"{slot}_{measure}"] = [f"{best:.3f}" for best in of_slot.amax(1).tolist()]
        try:
            with replacing(path) as part, part.open("w", encoding="utf-8", newline="") as file:
                writer = csv.writer(file)
                writer.writerow(columns)
                writer.writerows(zip(*columns.values(), strict=True))
        except OSError as error:
            raise UsageError(f"predictions can't be written to {path}: {error.strerror}") from None


def read_touches(
    folder: Path, table: Path, sensor: SensorSpec, background: Path | None = None
) -> RealTouches:
    """Read a table and its touches, and make the inputs of encoders.

    Args:
        folder: Folder of the touches.
        table: CSV file of the labels.
        sensor: The sensor that recorded the touches.
        background: Frame of the untouched unit; ``background.png`` in the folder when not given.

    Raises:
        UsageError: A file, column or label is wrong; it names file and row.
        TouchError: A file is no touch of this sensor.
    """
    rows = [_labelled(folder, table, number, row) for number, row in _rows(table)]
    if background is None and (folder / BACKGROUND).exists():
        background = folder / BACKGROUND
    clouds, maps, frames = [], [], []
    for path, _ in rows:
        untouched = background if path.suffix.lower() in FRAME_SUFFIXES else None
        clouds.append(read_cloud(path, sensor, background=untouched))
        heights = read_heights(path, sensor, background=untouched)
        maps.append(heights - np.float32(np.median(heights)))
        frames.append(render(maps[-1], sensor))
    files, classes = zip(*rows, strict=True)
    return RealTouches(
        files=files,
        labels=torch.tensor(classes),
        clouds=clouds,
        heights_mm=maps,
        frames=torch.stack(frames),
    )


def _rows(table: Path) -> Iterator[tuple[int, dict[str, str]]]:
    """Rows of the table with their numbers in the file."""
    try:
        with table.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file)
            names = [name.strip() for name in reader.fieldnames or []]
            if set(names) != set(COLUMNS):
                raise UsageError(
                    f"{table} needs the columns {', '.join(COLUMNS)}, got {', '.join(names)}"
                )
            rows = []
            for number, row in enumerate(reader, start=2):
                if None in row:
                    raise UsageError(
                        f"{table}, row {number}: more than {len(names)} fields; a comma inside a "
                        "name needs quotes"
                    )
                rows.append({name.strip(): (label or "").strip() for name, label in row.items()})
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise UsageError(f"labels can't be read from {table}: {error}") from None
    if not rows:
        raise UsageError(f"{table} has no rows")
    return enumerate(rows, start=2)


def _labelled(
    folder: Path, table: Path, number: int, row: dict[str, str]
) -> tuple[Path, list[int]]:
    """File of a touch, and its class numbers, -1 where empty."""
    path = folder / row["file"]
    if not row["file"] or not path.is_file():
        raise UsageError(f"{table}, row {number}: {path} does not exist")
    for slot, names in CLASSES.items():
        if row[slot] and row[slot] not in names:
            raise UsageError(
                f"{table}, row {number}: no {slot} {row[slot]!r}; known: {', '.join(names)}"
            )
    return path, [names.index(row[s]) if row[s] else -1 for s, names in CLASSES.items()]
