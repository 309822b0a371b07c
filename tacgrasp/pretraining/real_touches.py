"""Real touches with labels: frames, height maps or clouds, and a table of their classes.

The table is CSV with the columns ``file, shape, texture, depth, position, area``: a file relative
to the folder, and words of ``cltp.tactile.states``, empty where unknown. Frames need a picture of
the same unit untouched; it is ``background.png`` of the folder unless another is named.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.checkpoints.frozen import FrozenEncoder
from cltp.data.sampler import sampled
from cltp.errors import TouchError
from cltp.evaluation.features import EncodedContacts
from cltp.evaluation.scores import ClassScores, score_classes
from cltp.sensing.frames import FRAME_SUFFIXES
from cltp.sensing.touch_files import read_cloud, read_heights
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input, scaled
from cltp.tactile.point_layout import EVEN, Sampling
from cltp.tactile.render import render
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import CLASSES, NUMBERS
from tacgrasp.base.errors import UsageError

COLUMNS = ("file", *CLASSES)
BACKGROUND = "background.png"


@dataclass(frozen=True, slots=True, kw_only=True)
class LabelledTouch:
    """One row of the table.

    Attributes:
        file: File of the touch.
        classes: Five class numbers, -1 where empty.
    """

    file: Path
    classes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class TouchPredictions:
    """Predicted classes of real touches.

    Attributes:
        rows: One for each file: its classes with their cosines or probabilities, by column.
        scores: Scores against the labels.
    """

    rows: list[dict[str, str]]
    scores: ClassScores


def read_labels(folder: Path, table: Path) -> list[LabelledTouch]:
    """Read the table.

    Raises:
        UsageError: A file, column or label is wrong; it names file and row.
    """
    try:
        with table.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file)
            names = [name.strip() for name in reader.fieldnames or []]
            if set(names) != set(COLUMNS):
                raise UsageError(
                    f"{table} needs the columns {', '.join(COLUMNS)}, got {', '.join(names)}"
                )
            rows = [{(k or "").strip(): (v or "").strip() for k, v in r.items()} for r in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise UsageError(f"labels can't be read from {table}: {error}") from None
    if not rows:
        raise UsageError(f"{table} has no rows")
    return [_labelled(folder, table, number, row) for number, row in enumerate(rows, start=2)]


def _labelled(folder: Path, table: Path, number: int, row: dict[str, str]) -> LabelledTouch:
    path = folder / row["file"]
    if not row["file"] or not path.is_file():
        raise UsageError(f"{table}, row {number}: {path} does not exist")
    classes = []
    for slot, names in CLASSES.items():
        if row[slot] and row[slot] not in names:
            raise UsageError(
                f"{table}, row {number}: no {slot} {row[slot]!r}; known: {', '.join(names)}"
            )
        classes.append(names.index(row[slot]) if row[slot] else -1)
    return LabelledTouch(file=path, classes=tuple(classes))


def labels_of(rows: Sequence[LabelledTouch]) -> Tensor:
    """Class numbers of touches, shape (N, 5)."""
    return torch.tensor([row.classes for row in rows])


@dataclass(frozen=True, slots=True)
class TouchInputs:
    """Inputs of encoders, made from real touches.

    Attributes:
        clouds: Clouds of 1024 evenly spaced points.
        heights_mm: Height maps, shape (H, W) each, with median 0.
        frames: Rendered frames, shape (N, 3, 64, 64).
    """

    clouds: Sequence[TactileCloud]
    heights_mm: Sequence[NDArray[np.float32]]
    frames: Tensor

    def points(self, sampling: Sampling) -> Tensor:
        """Scaled points, shape (N, side², 3), in the layout that an encoder takes."""
        if sampling == EVEN:
            return torch.from_numpy(np.stack([encoder_input(cloud) for cloud in self.clouds]))
        rng = np.random.default_rng(0)
        points = []
        for cloud, heights_mm in zip(self.clouds, self.heights_mm, strict=True):
            points_mm = sampled(heights_mm, cloud.sensor, sampling, rng)
            points.append(scaled(points_mm, cloud.sensor))
        return torch.from_numpy(np.stack(points))


def read_inputs(
    rows: Sequence[LabelledTouch], sensor: SensorSpec, background: Path | None
) -> TouchInputs:
    """Read touches and make the inputs of encoders.

    Raises:
        TouchError: A file is no touch of this sensor.
    """
    clouds, maps, frames = [], [], []
    for row in rows:
        is_frame = row.file.suffix.lower() in FRAME_SUFFIXES
        untouched = background if is_frame else None
        clouds.append(read_cloud(row.file, sensor, background=untouched))
        heights = read_heights(row.file, sensor, background=untouched)
        maps.append(heights - np.float32(np.median(heights)))
        frames.append(render(maps[-1], sensor))
    return TouchInputs(clouds, maps, torch.stack(frames))


def encode_touches(
    encoder: FrozenEncoder, rows: Sequence[LabelledTouch], touches: TouchInputs
) -> EncodedContacts:
    """Features of touches with their labels; their numbers are NaN.

    Raises:
        TouchError: A feature is not finite; it names the file.
    """
    inputs = touches.frames if encoder.sees_images else touches.points(encoder.sampling)
    parts = [encoder.read(batch) for batch in inputs.split(64)]
    pooled, feature = (torch.cat(part).float() for part in zip(*parts, strict=True))
    if not feature.isfinite().all():
        row = int((~feature.isfinite().all(dim=1)).nonzero()[0, 0])
        raise TouchError(f"{rows[row].file}: its feature is not finite")
    return EncodedContacts(
        pooled=pooled,
        feature=feature,
        classes=labels_of(rows),
        numbers=torch.full((len(rows), len(NUMBERS)), math.nan),
        index=torch.arange(len(rows)),
    )


def predict_touches(
    rows: Sequence[LabelledTouch], scores: Sequence[Tensor], measure: str
) -> TouchPredictions:
    """Take the best class of every dimension.

    Args:
        rows: The touches.
        scores: Scores of each class by dimension, shape (N, classes).
        measure: What scores are: ``cosine`` or ``probability``.
    """
    predicted = torch.stack([of_dimension.argmax(1) for of_dimension in scores], dim=1)
    lines = []
    for number, row in enumerate(rows):
        words, values = {}, {}
        for column, (slot, names) in enumerate(CLASSES.items()):
            best = int(predicted[number, column])
            words[slot] = names[best]
            values[f"{slot}_{measure}"] = f"{float(scores[column][number, best]):.3f}"
        lines.append({"file": str(row.file), **words, **values})
    return TouchPredictions(lines, score_classes(predicted, labels_of(rows)))


def write_predictions(path: Path, predictions: TouchPredictions) -> None:
    """Write a CSV file with a row for each touch.

    Raises:
        UsageError: It can't be written.
    """
    try:
        with path.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, fieldnames=list(predictions.rows[0]))
            writer.writeheader()
            writer.writerows(predictions.rows)
    except OSError as error:
        raise UsageError(f"predictions can't be written to {path}: {error.strerror}") from None
