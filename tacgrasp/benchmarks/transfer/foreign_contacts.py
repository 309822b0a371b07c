"""Contacts from elsewhere, as a data set: of the second generator, or of any folder of heights.

A folder is one of three:

- a data set (``dataset.json``), whose test split is taken, or all of it where it has none;
- ``labels.csv`` with a column ``file``, and a file of heights for each row, as
  ``tacgrasp data import`` takes them;
- ``labels.csv`` without that column, and ``heights.npy`` of shape (rows, H, W) in the same order.

Heights are in mm over the whole sensing area, row 0 at the top, positive into the gel, 0 untouched.
"""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.tactile.sensors import sensor_named
from sim.independent.contacts import make_contact
from tacgrasp.base.errors import UsageError
from tacgrasp.console import count_progress
from tacgrasp.datasets.import_touches import import_touches
from tacgrasp.datasets.requests import ImportRequest

LEAST_DEPTH_MM = 0.01
"""Depth from which a labelled contact of a folder counts as one; its heights have no noise."""


def generated(seeds: range, sensor: str, work: Path) -> ContactDataset:
    """Contacts of the second generator, written into an empty folder."""
    spec = sensor_named(sensor)
    with DatasetWriter(work / "generated") as writer, count_progress() as progress:
        for seed in progress.track(seeds, description="contacts"):
            writer.add(make_contact(seed, spec))
    return ContactDataset(work / "generated")


def from_folder(folder: Path, sensor: str, work: Path) -> ContactDataset:
    """Contacts of a folder; a table of labels is read into the empty folder ``work``.

    Raises:
        UsageError: A file is missing or can't be read, or a row is bad; all are named.
        TouchError: The data set can't be used.
    """
    if (folder / "dataset.json").exists():
        data = ContactDataset(folder)
        has_test = Split.TEST in data.column("split")
        return ContactDataset(folder, split=Split.TEST) if has_test else data
    labels = folder / "labels.csv"
    if not labels.is_file():
        raise UsageError(
            f"--data {folder} holds neither dataset.json (a data set) nor labels.csv (a table of "
            "labels beside heights in mm); see docs/data-tools.md"
        )
    source = folder
    if (folder / "heights.npy").exists():
        source = work / "single"
        labels = _unstacked(folder, source)
    request = ImportRequest(
        folder=source,
        labels=labels,
        out=work / "imported",
        sensor=sensor,
        least_depth_mm=LEAST_DEPTH_MM,
    )
    import_touches(request)
    return ContactDataset(work / "imported")


def _unstacked(folder: Path, single: Path) -> Path:
    """Write each map of ``heights.npy`` to a file of its own, and the table that names them."""
    stacked, labels = folder / "heights.npy", folder / "labels.csv"
    try:
        heights = np.load(stacked, mmap_mode="r", allow_pickle=False)
        with labels.open(encoding="utf-8-sig", newline="") as file:
            rows = list(csv.reader(file, strict=True))
    except (OSError, ValueError, csv.Error) as error:
        raise UsageError(f"--data {folder} can't be read: {error}") from None
    if heights.ndim != 3 or len(heights) != len(rows) - 1:
        raise UsageError(
            f"{stacked} must hold one map for each row of labels.csv, ({len(rows) - 1}, H, W), "
            f"got shape {heights.shape}"
        )
    single.mkdir()
    with (single / "labels.csv").open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(["file", *rows[0]])
        for number, (row, height_mm) in enumerate(zip(rows[1:], heights, strict=True)):
            np.save(single / f"{number}.npy", np.asarray(height_mm, dtype=np.float32))
            table.writerow([f"{number}.npy", *row])
    return single / "labels.csv"
