"""How much more than its load a held contact could carry, from the mean of some frames.

A contact that is loaded far below its friction drags the gel along alike; near it, the rim has slid
and the middle drags most. A small network reads that from the cues of one mean field: of the
logarithm of friction over load, two quantiles. A contact that slides has a reserve of 0 or less.

It was trained on simulated grips that grow ever firmer while the fingers rise
(``tacgrasp.training.reserve``). Not here: slips from frame to frame (``cltp.tactile.shear.slip``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple
from zipfile import BadZipFile

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.contact_shape import ContactShape, grid_of
from cltp.tactile.shear.contact_shear import NUM_OF_RESERVE, ShearWatch
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.slip import MODELS, Layer

QUANTILES = (0.1, 0.5)
"""Quantiles of the reserve that are read: one that it seldom lies below, and the median."""


MEAN_S, MIN_FRAMES = 0.1, 3
"""Time over which frames are averaged [s], and fewest frames. Our choice: the noise of a point
falls to a third with taxels, and a slow rise moves little in it."""


def num_frames(sensor: SensorSpec) -> int:
    """Number of frames that are averaged."""
    return max(MIN_FRAMES, round(MEAN_S * sensor.frame_hz))


class Reserve(NamedTuple):
    """What a contact could carry over what it carries, as a logarithm.

    Attributes:
        low: It seldom lies below this.
        middle: As likely below as above.
    """

    low: float
    middle: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ReserveModel:
    """Weights of the network.

    Attributes:
        mean, spread: Shape (NUM_OF_RESERVE,): of the cues in training.
        layers: Weights (outputs, inputs) and biases (outputs,) of each layer.
    """

    mean: FloatArray
    spread: FloatArray
    layers: tuple[Layer, ...]

    def read(self, mean: MeanField, noise_mm: tuple[float, float]) -> Reserve | None:
        """The reserve in a mean field; None without contact.

        Args:
            mean: Of frames of a contact that changes little.
            noise_mm: Standard deviation of a point along the gel and into it, of one frame [mm].
        """
        cues = mean_cues(mean, noise_mm)
        return None if cues is None else self.of_cues(cues)

    def of_cues(self, cues: FloatArray) -> Reserve:
        """The reserve of cues (NUM_OF_RESERVE,) of a mean field."""
        hidden = (cues - self.mean) / self.spread
        for weights, biases in self.layers[:-1]:
            hidden = np.tanh(weights @ hidden + biases)
        weights, biases = self.layers[-1]
        low, middle = np.sort(weights @ hidden + biases)
        return Reserve(float(low), float(middle))


class MeanField(NamedTuple):
    """The mean of some frames.

    Attributes:
        field: Displacements at all points that any frame has found.
        frames: Number of frames.
    """

    field: ShearField
    frames: int


def mean_field(fields: Sequence[ShearField]) -> MeanField:
    """The mean of some frames of one sensor, one at least."""
    grid = grid_of(fields[0].sensor)
    total, counts = np.zeros((grid.count, 3)), np.zeros(grid.count)
    for each in fields:
        cells = grid.cells_of(each.positions_mm)
        total[cells] += each.displacement_mm
        counts[cells] += 1.0
    found = counts > 0
    mean = replace(
        fields[-1],
        positions_mm=np.stack([grid.x, grid.y], axis=1)[found].astype(np.float32),
        displacement_mm=(total[found] / counts[found, None]).astype(np.float32),
        force_n=None,
    )
    return MeanField(mean, len(fields))


def place_mm(mean: MeanField) -> tuple[float, float] | None:
    """Middle of the indentation, (x, y), gel frame [mm]; None without one."""
    grid = grid_of(mean.field.sensor)
    height_mm = np.zeros(grid.count)
    height_mm[grid.cells_of(mean.field.positions_mm)] = mean.field.displacement_mm[:, 2]
    shape = ContactShape.of(height_mm, grid)
    return None if shape is None else shape.centre


def mean_cues(mean: MeanField, noise_mm: tuple[float, float]) -> FloatArray | None:
    """Cues (NUM_OF_RESERVE,) of a mean field; None where it shows no contact.

    Arguments are those of ``ReserveModel.read``.
    """
    along_mm, depth_mm = (each / mean.frames**0.5 for each in noise_mm)
    return ShearWatch(mean.field.sensor, along_mm, depth_mm).see_reserve(mean.field)


@lru_cache
def reserve_model(sensor_name: str) -> ReserveModel:
    """The model of a sensor.

    Raises:
        TouchError: None comes along for this sensor, or its file is damaged.
    """
    path = MODELS / f"reserve_{sensor_name}.npz"
    try:
        with np.load(path, allow_pickle=False) as held:
            arrays = {name: held[name].astype(np.float64) for name in held.files}
        count = len(arrays) // 2 - 1
        layers = tuple((arrays[f"weights_{i}"], arrays[f"biases_{i}"]) for i in range(count))
        model = ReserveModel(mean=arrays["mean"], spread=arrays["spread"], layers=layers)
    except (OSError, EOFError, BadZipFile, ValueError, KeyError) as error:
        raise TouchError(f"no model of the reserve of {sensor_name!r} in {path}: {error}") from None
    if model.mean.shape != (NUM_OF_RESERVE,) or len(layers[-1][1]) != len(QUANTILES):
        raise TouchError(
            f"{path} is of another version: train anew (`tacgrasp train reserve --help`)"
        )
    return model


def write_reserve_model(path: Path, model: ReserveModel) -> None:
    """Write a model as ``reserve_model`` reads it.

    Raises:
        OSError: The file can't be written.
    """
    named = {"mean": model.mean, "spread": model.spread}
    for i, (weights, biases) in enumerate(model.layers):
        named |= {f"weights_{i}": weights, f"biases_{i}": biases}
    single = {name: each.astype(np.float32) for name, each in named.items()}
    with path.open("wb") as file:
        np.savez(file, **single)  # type: ignore[arg-type]
