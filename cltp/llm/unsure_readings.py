"""Readings with errors and gaps, for learning: the language model is to trust its touch too.

Heads that were always right would be all that a language model listens to. So some readings are
left out, some have one error, some are another contact's, and those that stand for contacts without
any touch tokens are drawn around the truth.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor

from cltp.encoder.readings import HeadReadings
from cltp.llm.reading_tokens import NUM_READINGS
from cltp.tactile.states import CLASSES, NUMBERS, ContactState, Side

LEFT_OUT, ONE_ERROR, SWAPPED = 0.2, 0.3, 0.05
"""Fractions of contacts without any reading, with an error in one of them, and with the readings of
another contact. Of the last, which of the two contacts is meant is drawn: nobody could know."""

NUMBER_ERROR = 0.7
"""Standard deviation of the logarithm of a wrong number over the right one, or of a wrong place
over ``PLACE_ERROR_MM``."""

PLACE_ERROR_MM = 4.0

INTERVALS = (0.02, 0.5)
"""Range of half widths of drawn intervals over their numbers, log-uniform."""


class ShownReadings(NamedTuple):
    """What a language model is shown of the readings of a batch.

    Attributes:
        readings: The readings.
        given: Shape (B, 6), bool, as in ``ReadingTokens.forward``.
        meant: Shape (B,), the contact of the batch that is talked about.
    """

    readings: HeadReadings
    given: Tensor
    meant: Tensor


def shown(readings: HeadReadings, rng: np.random.Generator) -> ShownReadings:
    """Draw what is shown of the right readings of B contacts."""
    size = len(readings.values)
    draw = rng.random(size)
    rows = torch.arange(size)
    given = torch.ones(size, NUM_READINGS, dtype=torch.bool)
    given[torch.from_numpy(draw < LEFT_OUT)] = False
    swapped = torch.from_numpy(draw > 1 - SWAPPED)
    source = torch.where(swapped, rows.roll(1), rows)
    is_other = swapped & torch.from_numpy(rng.random(size) < 0.5)
    meant = torch.where(is_other, source, rows)
    result = HeadReadings(
        tuple(w[source] for w in readings.words), *(r[source] for r in readings[1:])
    )
    for row in np.flatnonzero((draw >= LEFT_OUT) & (draw < LEFT_OUT + ONE_ERROR)):
        _spoil(result, int(row), int(rng.integers(len(CLASSES) + len(NUMBERS))), rng)
    return ShownReadings(result, given, meant)


def _spoil(readings: HeadReadings, row: int, head: int, rng: np.random.Generator) -> None:
    """Put an error into one head's reading of a contact, in place."""
    if head < len(CLASSES):
        readings.words[head][row] = torch.from_numpy(_sure(readings.words[head].shape[1], rng))
        return
    column = head - len(CLASSES)
    if NUMBERS[column] in ("x_mm", "y_mm"):
        shift = PLACE_ERROR_MM * float(rng.normal())
        for part in (readings.values, readings.low, readings.high):
            part[row, column] += shift
        return
    factor = float(np.exp(NUMBER_ERROR * rng.normal()))
    for part in (readings.values, readings.low, readings.high):
        part[row, column] *= factor


def _sure(classes: int, rng: np.random.Generator, right: int | None = None) -> np.ndarray:
    """Probabilities of classes, nearly sure of one: of ``right`` as often as they say."""
    most = 1 - float(rng.random()) ** 3 * 0.7
    rest = rng.dirichlet(np.full(classes, 0.3))
    top = int(rng.integers(classes))
    if right is not None and rng.random() < most:
        top = right
    rest[top] = 0
    rest *= (1 - most) / max(rest.sum(), 1e-9)
    rest[top] = 1 - rest.sum()
    return rest.astype(np.float32)


def drawn_readings(states: Sequence[ContactState], rng: np.random.Generator) -> HeadReadings:
    """Readings such as good heads might give of contacts, around their true states."""
    words: list[list[np.ndarray]] = [[] for _ in CLASSES]
    for state in states:
        for column, (name, classes) in enumerate(CLASSES.items()):
            word = getattr(state, name)
            right = None if word is None else classes.index(word)
            words[column].append(_sure(len(classes), rng, right))
    touching = torch.tensor([0.98 if s.in_contact else 0.02 for s in states])
    cut = torch.tensor([[0.97 if side in s.cut else 0.03 for side in Side] for s in states])
    values = torch.tensor([[getattr(s, n) for n in NUMBERS] for s in states], dtype=torch.float32)
    low, high = np.log(INTERVALS)
    half = torch.from_numpy(np.exp(rng.uniform(low, high, (2, *values.shape))).astype(np.float32))
    sizes = values.abs().clamp(min=0.02)
    return HeadReadings(
        words=tuple(torch.from_numpy(np.stack(column)) for column in words),
        touching=touching,
        cut=cut,
        values=values,
        low=torch.maximum(values - half[0] * sizes, torch.where(values < 0, values * 2, 0.0)),
        high=values + half[1] * sizes,
    )


def told_numbers(
    readings: HeadReadings, row: int
) -> tuple[dict[str, float], dict[str, tuple[float, float]]]:
    """Numbers of one contact and the ends of their intervals, by name."""
    values = readings.values[row].tolist()
    ends = zip(readings.low[row].tolist(), readings.high[row].tolist(), strict=True)
    return dict(zip(NUMBERS, values, strict=True)), dict(zip(NUMBERS, ends, strict=True))
