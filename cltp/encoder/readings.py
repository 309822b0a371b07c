"""Readings of the state heads in probabilities and units, as everybody uses them.

The loop, ``tacgrasp describe`` and the language model are given the same readings. Not here: the
words and warnings that follow from them (``cltp.encoder.reader``).
"""

from __future__ import annotations

from typing import NamedTuple

import torch
from torch import Tensor

from cltp.encoder.heads import restored
from cltp.encoder.heads_output import HeadsOutput
from cltp.errors import TouchError
from cltp.tactile.states import NUMBERS

TAILS = 1.645
"""Standard deviations that 5 % lie beyond, on either side."""

WITHOUT_INTERVALS = (
    "these weights read numbers without intervals; train them anew: tacgrasp train cltp"
)

LEAST_FORCE_N = 1e-3
"""Force below which ratios of forces mean nothing."""

_FORCE = NUMBERS.index("force_n")
_AREA = NUMBERS.index("area_fraction")
_SIGNED = [name in ("x_mm", "y_mm") for name in NUMBERS]


class HeadReadings(NamedTuple):
    """What the heads read of a batch of contacts.

    Attributes:
        words: Probabilities of the classes of the five dimensions, each (B, classes).
        touching: Probability that anything touches, shape (B,).
        cut: Probability that each side cuts the contact, shape (B, 4).
        values: ``NUMBERS`` in their units, shape (B, 5); forces are the unit's newtons.
        low, high: Ends of the intervals that hold the truth in nine cases of ten, shape (B, 5).
    """

    words: tuple[Tensor, ...]
    touching: Tensor
    cut: Tensor
    values: Tensor
    low: Tensor
    high: Tensor

    def at(self, row: int) -> HeadReadings:
        """The readings of one contact, as a batch of one."""
        part = slice(row, row + 1)
        return HeadReadings(tuple(w[part] for w in self.words), *(each[part] for each in self[1:]))

    def to(self, device: torch.device) -> HeadReadings:
        """The readings on another device."""
        return HeadReadings(
            tuple(w.to(device) for w in self.words), *(x.to(device) for x in self[1:])
        )


def readings_of(
    output: HeadsOutput, factor: float | Tensor = 1.0, spread: float | Tensor = 0.0
) -> HeadReadings:
    """Readings out of the heads' output.

    Args:
        output: Output of ``StateHeads`` for B contacts.
        factor: Newtons per nominal newton of the unit, one number or (B,), above 0
            (``cltp.tactile.force_scale``).
        spread: Standard deviation of its logarithm, one number or (B,): the interval of the force
            is as much wider. That of a unit without a calibration is how much units differ.

    Raises:
        TouchError: The heads have no intervals.
    """
    if output.margins is None:
        raise TouchError(WITHOUT_INTERVALS)
    below, above = output.margins.unbind(-1)
    numbers = output.numbers
    ends = restored(torch.stack([numbers, numbers - below, numbers + above]))
    factors, spreads = (
        torch.as_tensor(each, dtype=ends.dtype, device=ends.device) for each in (factor, spread)
    )
    force, least, most = factors * ends[..., _FORCE]
    forces = torch.stack([force, *_widened(force, least, most, TAILS * spreads)])
    values, low, high = _clipped(torch.cat([ends[..., :_FORCE], forces[..., None]], dim=-1))
    return HeadReadings(
        words=tuple(scores.softmax(-1) for scores in output.logits),
        touching=output.touching.sigmoid(),
        cut=output.cut.sigmoid(),
        values=values,
        low=low,
        high=high,
    )


def _widened(force: Tensor, low: Tensor, high: Tensor, spread: Tensor) -> tuple[Tensor, Tensor]:
    """The ends of forces (B,) with an independent error of the logarithm added."""
    floor = LEAST_FORCE_N
    up = torch.hypot((high.clamp(min=floor) / force.clamp(min=floor)).log(), spread)
    down = torch.hypot((force.clamp(min=floor) / low.clamp(min=floor)).log(), spread)
    return torch.where(low > 0, force * (-down).exp(), 0.0), force * up.exp()


def _clipped(numbers: Tensor) -> Tensor:
    """Numbers (..., 5) without negative depths, areas and forces, and areas of at most 1."""
    signed = torch.tensor(_SIGNED, device=numbers.device)
    numbers = torch.where(signed, numbers, numbers.clamp(min=0))
    numbers[..., _AREA].clamp_(max=1)
    return numbers
