"""Geometric baseline: contact states computed directly from the points that encoders see.

``cltp.tactile.measure`` knows the sensor's geometry, withstands noise and learned nothing. It gives
depth, position, area and force; shape and texture are not computed.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Batch
from cltp.evaluation.scores import Predictions
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import NUMBERS
from cltp.train.text_targets import class_numbers


def unscaled(points: NDArray[np.float32], sensor: SensorSpec) -> TactileCloud:
    """The cloud that scaled points, shape (1024, 3), came from."""
    half = sensor.width_mm / 2
    scale = np.array([half, half, sensor.max_depth_mm], np.float32)
    return TactileCloud(points_mm=points * scale, sensor=sensor)


def predict_geometrically(data: ContactDataset, batches: Iterable[Batch]) -> Predictions:
    """States computed from the points of each contact; -1 for shape and texture."""
    states = [
        contact_state(unscaled(points, sensor_named(data.column("sensor")[index])))
        for batch in batches
        for index, points in zip(batch.index, batch.points, strict=True)
    ]
    numbers = np.array([[getattr(state, name) for name in NUMBERS] for state in states])
    return Predictions(class_numbers(states), numbers)
