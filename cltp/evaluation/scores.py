"""Predictions about contacts and their scores: accuracy, confusion matrices, median errors."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from torch import Tensor, bincount, stack

from cltp.tactile.states import CLASSES, NUMBERS, ContactState


@dataclass(frozen=True, slots=True)
class Predictions:
    """What a method predicts about contacts.

    Attributes:
        classes: Shape (N, 5), class numbers in the order of ``CLASSES``; -1 for no prediction.
        numbers: Shape (N, 5), ``NUMBERS``; infinite where a method gives none.
    """

    classes: Tensor
    numbers: NDArray[np.floating]


@dataclass(frozen=True, slots=True)
class ClassScores:
    """Accuracy of predicted classes.

    Attributes:
        accuracy: Fraction predicted rightly by dimension; NaN where no contact has a label.
        confusion: Counts by dimension, shape (classes, classes): labels by row, predictions by
            column.
        count: Number of contacts.
    """

    accuracy: Mapping[str, float]
    confusion: Mapping[str, Tensor]
    count: int

    def restricted(self, dimensions: Sequence[str]) -> ClassScores:
        """The scores of some dimensions; the accuracy of the others becomes NaN."""
        accuracy = {
            name: value if name in dimensions else math.nan for name, value in self.accuracy.items()
        }
        confusion = {name: self.confusion[name] for name in dimensions}
        return ClassScores(accuracy, confusion, self.count)


def best_classes(scores: Sequence[Tensor]) -> Tensor:
    """Classes (N, 5) with the highest scores, which are (N, classes) for each dimension."""
    return stack([of_dimension.argmax(1) for of_dimension in scores], dim=1)


def score_classes(predicted: Tensor, labels: Tensor) -> ClassScores:
    """Compare classes.

    Args:
        predicted: Shape (N, 5), class numbers in the order of ``CLASSES``; -1 for none.
        labels: Shape (N, 5); -1 where a contact has no label, which is not scored.
    """
    accuracy, confusion = {}, {}
    for column, (dimension, names) in enumerate(CLASSES.items()):
        labelled = labels[:, column] >= 0
        truth, chosen = labels[labelled, column], predicted[labelled, column]
        right = int((truth == chosen).sum())
        accuracy[dimension] = right / len(truth) if len(truth) else math.nan
        named = chosen >= 0
        flat = truth[named] * len(names) + chosen[named]
        confusion[dimension] = bincount(flat, minlength=len(names) ** 2).view(len(names), -1)
    return ClassScores(accuracy, confusion, len(labels))


def median_errors(
    numbers: NDArray[np.floating], states: Sequence[ContactState]
) -> dict[str, float]:
    """Median absolute errors of predicted ``NUMBERS``, shape (N, 5), of contacts that touch.

    Returns:
        ``depth_mm``, ``position_mm`` (distance), ``area_percent`` (of the sensing area) and
        ``force_percent`` (of the true force, at least 0.05 N).
    """
    truth = np.array([[getattr(state, name) for name in NUMBERS] for state in states])
    touching = np.array([state.in_contact for state in states])
    error = np.abs(numbers - truth)[touching]
    force_n = np.maximum(truth[touching, 4], 0.05)
    return {
        "depth_mm": float(np.median(error[:, 0])),
        "position_mm": float(np.median(np.hypot(error[:, 1], error[:, 2]))),
        "area_percent": 100 * float(np.median(error[:, 3])),
        "force_percent": 100 * float(np.median(error[:, 4] / force_n)),
    }
