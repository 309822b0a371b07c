"""What the language model says of contacts: its captions as predictions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import torch
from numpy.typing import NDArray

from cltp.data.sampler import Batch
from cltp.errors import TouchError
from cltp.evaluation.scores import Predictions
from cltp.tactile.states import CLASSES, NUMBERS
from cltp.texts.captions import Slots, parse_caption


class Speaker(Protocol):
    """What describes contacts."""

    def caption(self, points: NDArray[np.float32]) -> str:
        """Describe one contact, points of shape (N, 3) scaled."""
        ...


def predict_by_captions(
    speaker: Speaker,
    batches: Sequence[Batch],
    read_numbers: Callable[[str], Sequence[float] | None],
) -> Predictions:
    """Ask for a caption of each contact and read classes and numbers out of it.

    A reply that is no caption is wrong in all dimensions.

    Args:
        speaker: The model.
        batches: Contacts.
        read_numbers: Reads ``NUMBERS`` out of a reply; None where it has none, which counts as
            infinitely wrong.
    """
    classes, numbers = [], []
    for batch in batches:
        for points in batch.points:
            text = speaker.caption(points)
            try:
                slots = parse_caption(text.split(".")[0])
            except TouchError:
                slots = Slots()
            words = [(names, getattr(slots, dimension)) for dimension, names in CLASSES.items()]
            classes.append([-1 if word is None else names.index(word) for names, word in words])
            numbers.append(read_numbers(text) or [np.inf] * len(NUMBERS))
    return Predictions(torch.tensor(classes), np.array(numbers))
