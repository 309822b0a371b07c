"""Whether a held contact slides: a small network over the cues of its shear; a unit's noise.

The network has two hidden layers and gives the log odds that no part of the contact sticks. It was
trained on simulated loads with noise over the whole range of units (``tacgrasp.training.slip``),
so that the threshold alone belongs to a unit: ``tacgrasp calibrate slip`` measures it.

Not here: the cues (``cltp.tactile.shear.contact_shear``), what is done about a slip.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from cltp.tactile.shear.contact_shear import NUM_VALUES
from cltp.tactile.shear.field import ShearField

MODELS = Path(__file__).parent / "models"

MIN_FRAMES = 4
"""Fewest frames that tell a unit's noise. Our choice: three differences of some hundred points."""


AVERAGED_S = 0.02
"""Time over which log odds are averaged [s]. Our choice: at a precision of 99 % the recall of
taxels rose from 87 to 90 % on held-out loads, and the median delay stayed at two frames."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipModel:
    """Weights of the network.

    Attributes:
        mean, spread: Shape (NUM_VALUES,): of the cues in training.
        layers: Weights (outputs, inputs) and biases (outputs,) of each layer.
        threshold: Log odds from which a contact counts as slipping.

    Raises:
        TouchError: The shapes don't fit, or a number is not finite.
    """

    mean: FloatArray
    spread: FloatArray
    layers: tuple[tuple[FloatArray, FloatArray], ...]
    threshold: float

    def __post_init__(self) -> None:
        width = len(self.mean)
        for weights, biases in self.layers:
            if weights.shape != (len(biases), width):
                raise TouchError(f"a layer of {weights.shape} does not take {width} numbers")
            width = len(biases)
        numbers = [self.mean, self.spread, *(each for layer in self.layers for each in layer)]
        is_finite = all(np.isfinite(each).all() for each in numbers) and np.isfinite(self.threshold)
        if width != 1 or len(self.mean) != NUM_VALUES or not is_finite:
            raise TouchError(
                f"a slip model takes {NUM_VALUES} finite cues and gives one number; it has "
                f"{len(self.mean)} and {width}"
            )

    def score(self, values: FloatArray) -> float:
        """Log odds that no part of the contact sticks, from cues (NUM_VALUES,)."""
        hidden = (values - self.mean) / self.spread
        for weights, biases in self.layers[:-1]:
            hidden = np.tanh(weights @ hidden + biases)
        weights, biases = self.layers[-1]
        return float((weights @ hidden + biases)[0])


class SlipJudge:
    """Judges one hold: the mean log odds of its last frames, over the threshold.

    Args:
        model: The sensor's model.
        frame_hz: Frames of the sensor in a second [Hz].
        threshold: Threshold of a calibrated unit; None: that of the model.
    """

    def __init__(self, model: SlipModel, frame_hz: float, threshold: float | None = None) -> None:
        self._model = model
        self._threshold = model.threshold if threshold is None else threshold
        self._scores: deque[float] = deque(maxlen=averaged_frames(frame_hz))

    def see(self, values: FloatArray) -> float:
        """Log odds of a slip over the threshold after another frame's cues (NUM_VALUES,)."""
        self._scores.append(self._model.score(values))
        return sum(self._scores) / len(self._scores) - self._threshold


def averaged_frames(frame_hz: float) -> int:
    """Frames whose log odds are averaged: those of ``AVERAGED_S``, one at least."""
    return max(1, round(AVERAGED_S * frame_hz))


@lru_cache
def slip_model(sensor_name: str) -> SlipModel:
    """The model of a sensor.

    Raises:
        TouchError: None comes along for this sensor; the message lists those that do.
    """
    path = MODELS / f"slip_{sensor_name}.npz"
    if not path.is_file():
        known = ", ".join(sorted(each.stem.removeprefix("slip_") for each in MODELS.glob("*.npz")))
        raise TouchError(f"no slip model for {sensor_name!r}; known: {known}")
    return read_model(path)


def read_model(path: Path) -> SlipModel:
    """Read a model as ``write_model`` writes it.

    Raises:
        TouchError: The file holds none.
    """
    try:
        with np.load(path, allow_pickle=False) as held:
            arrays = {name: held[name].astype(np.float64) for name in held.files}
        count = len(arrays) // 2 - 1
        return SlipModel(
            mean=arrays["mean"],
            spread=arrays["spread"],
            layers=tuple((arrays[f"weights_{i}"], arrays[f"biases_{i}"]) for i in range(count)),
            threshold=float(arrays["threshold"]),
        )
    except (OSError, EOFError, BadZipFile, ValueError, KeyError, TypeError) as error:
        raise TouchError(f"{path} holds no slip model: {error}") from None


def write_model(path: Path, model: SlipModel) -> None:
    """Write a model.

    Raises:
        OSError: The file can't be written.
    """
    named = {"mean": model.mean, "spread": model.spread, "threshold": np.array(model.threshold)}
    for i, (weights, biases) in enumerate(model.layers):
        named |= {f"weights_{i}": weights, f"biases_{i}": biases}
    single = {name: each.astype(np.float32) for name, each in named.items()}
    with path.open("wb") as file:
        np.savez(file, **single)  # type: ignore[arg-type]


def noise_of(fields: Sequence[ShearField]) -> tuple[float, float]:
    """Noise of a unit from successive frames of a contact at rest.

    Returns:
        Standard deviation of a point's displacement along the gel and into it, from frame to frame
        [mm]: 1.48 times the median size of the differences, over √2, which a frame that did move
        hardly changes.

    Raises:
        TouchError: Fewer frames than ``MIN_FRAMES``, or no point that two of them share.
    """
    if len(fields) < MIN_FRAMES:
        raise TouchError(f"noise needs {MIN_FRAMES} frames of a hold, got {len(fields)}")
    along, depth = [], []
    for before, after in pairwise(fields):
        change = _common_change(before, after)
        along.append(change[:, :2].ravel())
        depth.append(change[:, 2])
    parts = np.concatenate(along), np.concatenate(depth)
    if not len(parts[1]):
        raise TouchError("no two frames of the hold share a point: check the sensor")
    along_mm, depth_mm = (1.4826 * float(np.median(np.abs(part))) / 2**0.5 for part in parts)
    return along_mm, depth_mm


def _common_change(before: ShearField, after: ShearField) -> FloatArray:
    """Change of the displacements at the points that two fields share, (M, 3) [mm]."""
    if np.array_equal(before.positions_mm, after.positions_mm):
        return np.asarray(after.displacement_mm - before.displacement_mm, dtype=np.float64)
    known = {tuple(at): i for i, at in enumerate(before.positions_mm.tolist())}
    pairs = [
        (known[tuple(at)], i)
        for i, at in enumerate(after.positions_mm.tolist())
        if tuple(at) in known
    ]
    first, second = (list(each) for each in zip(*pairs, strict=True)) if pairs else ([], [])
    return np.asarray(
        after.displacement_mm[second].astype(np.float64) - before.displacement_mm[first]
    )
