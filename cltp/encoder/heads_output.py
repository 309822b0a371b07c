"""What the state heads read of a batch of contacts, before it is brought to units."""

from __future__ import annotations

from typing import NamedTuple

from torch import Tensor


class HeadsOutput(NamedTuple):
    """Output of the heads for a batch.

    Attributes:
        logits: Logits of the five slots, each (B, classes).
        numbers: Shape (B, 5), transformed ``NUMBERS``.
        touching: Shape (B,), logit of contact.
        cut: Shape (B, 4), logit that each side cuts the contact.
        margins: Shape (B, 5, 2), how far below and above ``numbers`` their intervals reach, at
            least 0; None of heads without intervals.
    """

    logits: tuple[Tensor, ...]
    numbers: Tensor
    touching: Tensor
    cut: Tensor
    margins: Tensor | None = None
