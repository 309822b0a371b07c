"""Geometric baseline: contact states computed directly from the points that encoders see.

``cltp.tactile.measure`` knows the sensor's geometry, withstands noise and learned nothing. It gives
depth, position, area and force; shape and texture are not computed.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from cltp.data.sampler import Batch
from cltp.evaluation.scores import Predictions
from cltp.tactile.measure import contact_state
from cltp.tactile.states import NUMBERS
from cltp.train.text_targets import class_numbers


def predict_geometrically(batches: Iterable[Batch]) -> Predictions:
    """States computed from the points of each contact; -1 for shape and texture."""
    states = [
        contact_state(batch.cloud(row)) for batch in batches for row in range(len(batch.index))
    ]
    numbers = np.array([[getattr(state, name) for name in NUMBERS] for state in states])
    return Predictions(class_numbers(states), numbers)
