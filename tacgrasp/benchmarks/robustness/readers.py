"""What reads contacts in the robustness benchmark, and how right it is: heads and captions."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray

from cltp.checkpoints.frozen import frozen
from cltp.checkpoints.tac3d_llm import load_encoder
from cltp.data.sampler import Batch
from cltp.evaluation.features import encode_batches
from cltp.evaluation.llm_scores import predict_by_captions
from cltp.evaluation.probes import predict_with_heads
from cltp.evaluation.scores import Predictions, median_errors, score_classes
from cltp.tactile.states import CLASSES, MEASURABLE, NUMBERS, ContactState
from cltp.train.text_targets import class_numbers
from policies.llm.spoken import CaptionSpeaker
from tacgrasp.benchmarks.robustness.contacts import Sampled, part
from tacgrasp.lessons.captions import read_numbers
from tacgrasp.policy_factory import load_llm

FORCE_METRIC = "force_error_percent"
_FORCE = NUMBERS.index("force_n")
_ROWS = 50

Reader = Callable[[Batch], Predictions]


@lru_cache(maxsize=1)
def heads_reader(weights: Path) -> Reader:
    """What the state heads of an encoder read."""
    encoder, heads = load_encoder(weights / "encoder")
    encoder.eval(), heads.eval()
    reader = frozen(encoder)
    return lambda batch: predict_with_heads(heads, encode_batches(reader, [batch]), [batch])


@lru_cache(maxsize=1)
def caption_reader(weights: Path) -> Reader:
    """What the captions of the language model say."""
    speaker = CaptionSpeaker(load_llm(weights).talker)
    return lambda batch: predict_by_captions(speaker, [batch], read_numbers)


READERS: Mapping[str, Callable[[Path], Reader]] = {
    "heads": heads_reader,
    "captions": caption_reader,
}


def read(reader: Reader, sampled: Sampled) -> Predictions:
    """Predictions about contacts; forces in newtons of their gel."""
    count = len(sampled.batch.states)
    parts = [reader(part(sampled, slice(i, i + _ROWS))) for i in range(0, count, _ROWS)]
    numbers = np.concatenate([each.numbers for each in parts])
    numbers[:, _FORCE] *= sampled.factor
    return Predictions(torch.cat([each.classes for each in parts]), numbers)


def percent_right(predictions: Predictions, states: Sequence[ContactState]) -> dict[str, float]:
    """Percent of classes that are right by dimension, and the median error of the force [%]."""
    scores = score_classes(predictions.classes, class_numbers(states))
    figures = {name: 100 * value for name, value in scores.accuracy.items()}
    return figures | {FORCE_METRIC: median_errors(predictions.numbers, states)["force_percent"]}


def limits(sampled: Sampled) -> dict[str, float]:
    """The same of an observer with exact heights, for what has such a limit."""
    numbers = _numbers(sampled.exact)
    exact = percent_right(Predictions(class_numbers(sampled.exact), numbers), sampled.batch.states)
    return {name: exact[name] for name in (*MEASURABLE, FORCE_METRIC)}


def constant_answer(states: Sequence[ContactState]) -> dict[str, float]:
    """The same of the most frequent class of each dimension and the median force."""
    figures = {}
    for name in CLASSES:
        counts = Counter(word for s in states if (word := getattr(s, name)) is not None)
        figures[name] = 100 * max(counts.values()) / sum(counts.values()) if counts else math.nan
    numbers = np.tile(np.median(_numbers(states), axis=0), (len(states), 1))
    return figures | {FORCE_METRIC: median_errors(numbers, states)["force_percent"]}


def _numbers(states: Sequence[ContactState]) -> NDArray[np.float64]:
    return np.array([[getattr(state, name) for name in NUMBERS] for state in states])
