"""Real touches to try encoders on: frames, height maps or clouds, and a table of labels.

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
from cltp.evaluation.features import Observed
from cltp.evaluation.probes import Judged, judge
from cltp.sensing.frames import FRAME_SUFFIXES
from cltp.sensing.touch_files import read_heights, read_touch
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input, scaled
from cltp.tactile.point_layout import EVEN, Sampling
from cltp.tactile.render import render
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import CLASSES, NUMBERS
from cltp.train.text_targets import NOTHING
from tacgrasp.base.errors import UsageError

COLUMNS = ("file", *CLASSES)
BACKGROUND = "background.png"


@dataclass(frozen=True, slots=True, kw_only=True)
class Labelled:
    """One row of the table.

    Attributes:
        file: Of the touch.
        classes: Five class numbers, ``NOTHING`` where empty.
    """

    file: Path
    classes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Predictions:
    """What was said of real touches.

    Attributes:
        rows: One for each file: what was said and how near it is, by dimension.
        judged: Against the labels.
    """

    rows: list[dict[str, str]]
    judged: Judged


def read_labels(folder: Path, table: Path) -> list[Labelled]:
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


def _labelled(folder: Path, table: Path, number: int, row: dict[str, str]) -> Labelled:
    path = folder / row["file"]
    if not row["file"] or not path.is_file():
        raise UsageError(f"{table}, row {number}: {path} does not exist")
    classes = []
    for slot, names in CLASSES.items():
        if row[slot] and row[slot] not in names:
            raise UsageError(
                f"{table}, row {number}: no {slot} {row[slot]!r}; known: {', '.join(names)}"
            )
        classes.append(names.index(row[slot]) if row[slot] else NOTHING)
    return Labelled(file=path, classes=tuple(classes))


@dataclass(frozen=True, slots=True)
class Touches:
    """What encoders take of real touches.

    Attributes:
        clouds: Of 1024 points, evenly.
        heights_mm: Height maps, shape (H, W) each, with median 0.
        frames: Rendered, shape (N, 3, 64, 64).
    """

    clouds: Sequence[TactileCloud]
    heights_mm: Sequence[NDArray[np.float32]]
    frames: Tensor

    def points(self, sampling: Sampling) -> Tensor:
        """Scaled points, shape (N, side², 3), as an encoder wants them to lie."""
        if sampling == EVEN:
            return torch.from_numpy(np.stack([encoder_input(cloud) for cloud in self.clouds]))
        rng = np.random.default_rng(0)
        found = []
        for cloud, heights_mm in zip(self.clouds, self.heights_mm, strict=True):
            points_mm = sampled(heights_mm, cloud.sensor, sampling, rng)
            found.append(scaled(points_mm, cloud.sensor))
        return torch.from_numpy(np.stack(found))


def read_inputs(rows: list[Labelled], sensor: SensorSpec, background: Path | None) -> Touches:
    """What encoders take of touches.

    Raises:
        TouchError: A file is no touch of this sensor.
    """
    clouds, maps, frames = [], [], []
    for row in rows:
        is_frame = row.file.suffix.lower() in FRAME_SUFFIXES
        untouched = background if is_frame else None
        clouds.append(read_touch(row.file, sensor, background=untouched))
        heights = read_heights(row.file, sensor, background=untouched)
        maps.append(heights - np.float32(np.median(heights)))
        frames.append(render(maps[-1], sensor))
    return Touches(clouds, maps, torch.stack(frames))


def observed(encoder: FrozenEncoder, rows: list[Labelled], touches: Touches) -> Observed:
    """Features of touches with their labels; of numbers nothing is known.

    Raises:
        TouchError: A feature is not finite; it names the file.
    """
    taken = touches.frames if encoder.sees_images else touches.points(encoder.sampling)
    parts = [encoder.read(batch) for batch in taken.split(64)]
    pooled, feature = (torch.cat(found).float() for found in zip(*parts, strict=True))
    if not feature.isfinite().all():
        bad = int((~feature.isfinite().all(dim=1)).nonzero()[0, 0])
        raise TouchError(f"{rows[bad].file}: its feature is not finite")
    return Observed(
        pooled=pooled,
        feature=feature,
        classes=torch.tensor([row.classes for row in rows]),
        numbers=torch.full((len(rows), len(NUMBERS)), math.nan),
        index=torch.arange(len(rows)),
    )


def told(rows: list[Labelled], sure: Sequence[Tensor], measure: str) -> Predictions:
    """Name the classes of every touch.

    Args:
        rows: The touches.
        sure: For each dimension, how sure of each class, shape (N, classes).
        measure: What that is: ``cosine`` or ``probability``.
    """
    said = torch.stack([found.argmax(1) for found in sure], dim=1)
    lines = []
    for number, row in enumerate(rows):
        words, near = {}, {}
        for column, (slot, names) in enumerate(CLASSES.items()):
            chosen = int(said[number, column])
            words[slot] = names[chosen]
            near[f"{slot}_{measure}"] = f"{float(sure[column][number, chosen]):.3f}"
        lines.append({"file": str(row.file), **words, **near})
    return Predictions(lines, judge(said, torch.tensor([row.classes for row in rows])))


def write_predictions(path: Path, found: Predictions) -> None:
    """One row a prediction, CSV.

    Raises:
        UsageError: It can't be written.
    """
    try:
        with path.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, fieldnames=list(found.rows[0]))
            writer.writeheader()
            writer.writerows(found.rows)
    except OSError as error:
        raise UsageError(f"predictions can't be written to {path}: {error.strerror}") from None
