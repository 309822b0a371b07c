"""Zero-shot on real touches: a folder of frames, height maps or clouds with a table of labels.

The table is CSV with the columns ``file, shape, texture, depth, position, area``: a file relative
to the folder, and words of ``cltp.states``, empty where unknown. Frames need a picture of the same
unit untouched; it is ``background.png`` of the folder unless another is named.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import torch

from cltp.clip import Towers
from cltp.errors import TouchError
from cltp.files import read_touch
from cltp.frames import FRAME_SUFFIXES
from cltp.frozen import Frozen
from cltp.inputs import encoder_input
from cltp.probes import Judged, judge
from cltp.samples import CLASSES
from cltp.sensors import SensorSpec
from cltp.train.sayings import NOTHING
from cltp.zero_shot import Prompts
from tacgrasp.errors import UsageError

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


def predict(
    encoder: Frozen,
    towers: Towers,
    rows: list[Labelled],
    sensor: SensorSpec,
    *,
    background: Path | None,
    prompting: str = "single",
) -> Predictions:
    """Name the classes of every touch.

    Args:
        encoder: Aligned with ``towers``; of points.
        towers: Whose prompts are compared.
        rows: The touches.
        sensor: That made them.
        background: Frame of the unit untouched, for frames.
        prompting: Out of ``cltp.zero_shot.PROMPTINGS``.

    Raises:
        TouchError: A file is no touch of this sensor.
    """
    points = []
    for row in rows:
        is_frame = row.file.suffix.lower() in FRAME_SUFFIXES
        cloud = read_touch(row.file, sensor, background=background if is_frame else None)
        points.append(torch.from_numpy(encoder_input(cloud)))
    with torch.inference_mode():
        batches = torch.stack(points).split(64)
        feature = torch.cat([encoder.encoder(batch).feature for batch in batches])
    if not feature.isfinite().all():
        bad = int((~feature.isfinite().all(dim=1)).nonzero()[0, 0])
        raise TouchError(f"{rows[bad].file}: its feature is not finite")
    prompts = Prompts(towers, prompting)
    said, near = prompts.said(feature), prompts.surety(feature)
    truth = torch.tensor([row.classes for row in rows])
    told = []
    for number, row in enumerate(rows):
        words = {
            slot: names[int(said[number, c])] for c, (slot, names) in enumerate(CLASSES.items())
        }
        sure = {f"{s}_cosine": f"{float(near[number, c]):.3f}" for c, s in enumerate(CLASSES)}
        told.append({"file": str(row.file), **words, **sure})
    return Predictions(told, judge(said, truth))


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
