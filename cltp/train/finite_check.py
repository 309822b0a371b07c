"""A check of every batch before it is learned from: one bad row would spoil all weights."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Batch
from cltp.encoder.heads import Targets
from cltp.errors import TouchError


def check_batch(stage: str, step: int, data: ContactDataset, batch: Batch, labels: Targets) -> None:
    """Refuse a batch with points or labels that are not finite.

    Raises:
        TouchError: A value is not finite; the message names the step and the contacts.
    """
    bad_points = ~np.isfinite(batch.points).all(axis=(1, 2))
    bad_labels = ~labels.numbers.isfinite().all(dim=1).numpy()
    for name, bad in (("points", bad_points), ("labels", bad_labels)):
        if bad.any():
            raise TouchError(
                f"{stage}: step {step} has {name} that are not finite, of contacts "
                f"{_listed(batch.index[bad])} in {data.folder}; generate the data again"
            )


def _listed(rows: NDArray[np.int64], most: int = 8) -> str:
    text = ", ".join(str(row) for row in rows[:most])
    return text if len(rows) <= most else f"{text} and {len(rows) - most} more"
