"""The parts of a contact's embeddings: the encoder's tokens, and its heads' readings.

The one place that knows how ``Tac3dLlm`` makes them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import torch
from torch import Tensor

from cltp.encoder.readings import HeadReadings
from cltp.llm.generation import Felt
from cltp.llm.reading_tokens import NUM_READINGS
from cltp.llm.tac3d_llm import Tac3dLlm
from cltp.tactile.states import CLASSES


class TouchParts(NamedTuple):
    """Embeddings of one contact.

    Attributes:
        tokens: Shape (G + 1 + 4, D), from the encoder's tokens.
        readings: Shape (R, D), from the heads' readings.
    """

    tokens: Tensor
    readings: Tensor

    @property
    def whole(self) -> Tensor:
        """All of them, as a prompt follows them: shape (P, D)."""
        return torch.cat([self.tokens, self.readings])


@dataclass(frozen=True, slots=True, kw_only=True)
class Misreading:
    """A head that reads the word of another contact.

    Attributes:
        dimension: Its dimension, of ``cltp.tactile.states.CLASSES``.
        chances: Shape (classes,), the other contact's probabilities.
    """

    dimension: str
    chances: Tensor

    def of(self, readings: HeadReadings) -> HeadReadings:
        """The readings of one contact, misread."""
        words = list(readings.words)
        words[list(CLASSES).index(self.dimension)] = self.chances[None]
        return readings._replace(words=tuple(words))


@torch.inference_mode()
def touch_parts(
    model: Tac3dLlm, felt: Felt, misreading: Misreading | None = None, *, are_told: bool = True
) -> TouchParts:
    """Embed one contact.

    Args:
        model: The model.
        felt: The contact.
        misreading: A head that is made to read wrongly; None leaves all as they are.
        are_told: Whether the model is told the readings, or that they are left out.
    """
    readings = felt.readings if misreading is None else misreading.of(felt.readings)
    given = torch.full((1, NUM_READINGS), are_told)
    touch = model.projected(felt.encoded, readings, given)[0]
    return TouchParts(tokens=touch[:-NUM_READINGS], readings=touch[-NUM_READINGS:])


def mean_tokens(parts: Sequence[TouchParts]) -> Tensor:
    """Means of tokens over contacts: embeddings that tell nothing of any one of them."""
    return torch.stack([each.tokens for each in parts]).mean(0)
