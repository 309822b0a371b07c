"""Whether a held contact slides: a small recurrent network over the cues of its shear; noise.

The network gives, frame by frame, the log odds that less than a fifth of the contact sticks. It
remembers the frames before, so that a slow slide, which no single frame shows, adds up. It was
trained on simulated loads with noise over the whole range of units (``tacgrasp.training.slip``),
so that the threshold alone belongs to a unit: ``tacgrasp calibrate slip`` measures it.

Not here: the cues (``cltp.tactile.shear.contact_shear``), what is done about a slip.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from cltp.tactile.quantiles import spread_about
from cltp.tactile.shear.contact_shear import NUM_VALUES
from cltp.tactile.shear.field import ShearField

MODELS = Path(__file__).parent / "models"

Layer = tuple[FloatArray, FloatArray]
"""Weights (outputs, inputs) and biases (outputs,)."""

LAYERS = ("enter", "take", "keep", "leave")

MIN_FRAMES = 4
"""Fewest frames that tell a unit's noise. Our choice: three differences of some hundred points."""

LARGEST_CUE = 6.0
"""Largest size of a standardised cue; what is beyond is cut. Our choice: rare in training."""

RATE_TOL = 0.1
"""Largest relative difference of a sensor's rate from that of training. Our choice."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipModel:
    """Weights of the network: a layer, a gated recurrent unit of width H, one output.

    Source: Cho et al. 2014, arXiv 1406.1078, in the form of ``torch.nn.GRU``.

    Attributes:
        mean, spread: Shape (NUM_VALUES,): of the cues in training.
        enter: Weights (H, NUM_VALUES) and biases (H,) of the first layer.
        take, keep: Weights (3 H, H) and biases (3 H,) of what comes in and of what was kept; rows
            are those of the gates of reset and of update, and of the candidate.
        leave: Weights (1, H) and biases (1,) of the log odds.
        frame_hz: Frames in a second of training [Hz].
        threshold: Log odds from which a contact counts as slipping.

    Raises:
        TouchError: The shapes don't fit, or a number is not finite.
    """

    mean: FloatArray
    spread: FloatArray
    enter: Layer
    take: Layer
    keep: Layer
    leave: Layer
    frame_hz: float
    threshold: float

    def __post_init__(self) -> None:
        width = self.width
        shapes = {
            "enter": (width, NUM_VALUES),
            "take": (3 * width, width),
            "keep": (3 * width, width),
            "leave": (1, width),
        }
        numbers = [self.mean, self.spread, np.array([self.frame_hz, self.threshold])]
        for name, shape in shapes.items():
            weights, biases = getattr(self, name)
            numbers += [weights, biases]
            if weights.shape != shape or biases.shape != shape[:1]:
                raise TouchError(f"{name} of a slip model is {shape}, got {weights.shape}")
        if not self.mean.shape == self.spread.shape == (NUM_VALUES,):
            raise TouchError(f"a slip model takes {NUM_VALUES} cues, got {len(self.mean)}")
        if not all(np.isfinite(each).all() for each in numbers):
            raise TouchError("a slip model has numbers that are not finite")

    @property
    def width(self) -> int:
        """Numbers that are kept from frame to frame."""
        return len(self.enter[1])

    def step(self, values: FloatArray, kept: FloatArray) -> tuple[float, FloatArray]:
        """Log odds of a slip from cues (NUM_VALUES,) and what was kept (H,); what to keep."""
        cues = (values - self.mean) / self.spread
        entered = np.tanh(_through(self.enter, np.clip(cues, -LARGEST_CUE, LARGEST_CUE)))
        width = self.width
        taken, held = _through(self.take, entered), _through(self.keep, kept)
        gates = 1.0 / (1.0 + np.exp(-(taken[: 2 * width] + held[: 2 * width])))
        reset, stay = gates[:width], gates[width:]
        candidate = np.tanh(taken[2 * width :] + reset * held[2 * width :])
        kept = (1.0 - stay) * candidate + stay * kept
        return float(_through(self.leave, kept)[0]), kept


def _through(layer: Layer, values: FloatArray) -> FloatArray:
    weights, biases = layer
    return np.asarray(weights @ values + biases)


class SlipJudge:
    """Judges one hold frame by frame: its log odds over the threshold.

    Args:
        model: The sensor's model.
        frame_hz: Frames of the sensor in a second [Hz].
        threshold: Threshold of a calibrated unit; None: that of the model.

    Raises:
        TouchError: The model was trained at another rate.
    """

    def __init__(self, model: SlipModel, frame_hz: float, threshold: float | None = None) -> None:
        if abs(frame_hz / model.frame_hz - 1.0) > RATE_TOL:
            raise TouchError(
                f"the slip model was trained at {model.frame_hz:g} frames a second, the sensor "
                f"gives {frame_hz:g}: train one with tacgrasp train slip"
            )
        self._model = model
        self._threshold = model.threshold if threshold is None else threshold
        self._kept = np.zeros(model.width)

    def see(self, values: FloatArray) -> float:
        """Log odds of a slip over the threshold after another frame's cues (NUM_VALUES,)."""
        score, self._kept = self._model.step(values, self._kept)
        return score - self._threshold


@lru_cache
def slip_model(sensor_name: str) -> SlipModel:
    """The model of a sensor.

    Raises:
        TouchError: None comes along for this sensor; the message lists those that do.
    """
    path = MODELS / f"slip_{sensor_name}.npz"
    if not path.is_file():
        known = ", ".join(
            sorted(each.stem.removeprefix("slip_") for each in MODELS.glob("slip_*.npz"))
        )
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
        layers = {name: (arrays[f"{name}_weights"], arrays[f"{name}_biases"]) for name in LAYERS}
        return SlipModel(
            mean=arrays["mean"],
            spread=arrays["spread"],
            **layers,
            frame_hz=float(arrays["frame_hz"]),
            threshold=float(arrays["threshold"]),
        )
    except (OSError, EOFError, BadZipFile, ValueError, KeyError, TypeError) as error:
        raise TouchError(f"{path} holds no slip model: {error}") from None


def write_model(path: Path, model: SlipModel) -> None:
    """Write a model.

    Raises:
        OSError: The file can't be written.
    """
    named = {"mean": model.mean, "spread": model.spread}
    named |= {"frame_hz": np.array(model.frame_hz), "threshold": np.array(model.threshold)}
    for name in LAYERS:
        named[f"{name}_weights"], named[f"{name}_biases"] = getattr(model, name)
    single = {name: each.astype(np.float32) for name, each in named.items()}
    with path.open("wb") as file:
        np.savez_compressed(file, **single)  # type: ignore[arg-type]


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
    along_mm, depth_mm = (spread_about(part, 0.0) / 2**0.5 for part in parts)
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
