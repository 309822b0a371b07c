"""The two parts of a contact's embeddings: the encoder's tokens, and its heads' readings.

The one place that knows how ``Tac3dLlm`` makes them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.encoder.heads import HeadsOutput, scaled_force
from cltp.llm.tac3d_llm import Tac3dLlm
from cltp.tactile.states import CLASSES


class TouchParts(NamedTuple):
    """Embeddings of one contact.

    Attributes:
        tokens: Shape (G + 1, D), from the encoder's tokens.
        readings: Shape (R, D), from the heads' readings.
    """

    tokens: Tensor
    readings: Tensor

    @property
    def whole(self) -> Tensor:
        """All of them, as a prompt follows them: shape (G + 1 + R, D)."""
        return torch.cat([self.tokens, self.readings])


@dataclass(frozen=True, slots=True, kw_only=True)
class Misreading:
    """A head that reads the word of another contact.

    Attributes:
        dimension: Its dimension, of ``cltp.tactile.states.CLASSES``.
        logits: Shape (classes,), the other contact's.
    """

    dimension: str
    logits: Tensor


@torch.inference_mode()
def read_heads(model: Tac3dLlm, points: NDArray[np.float32]) -> HeadsOutput:
    """What the heads read of one contact, points of shape (N, 3) scaled."""
    return model.heads(model.encoder(torch.from_numpy(points)[None]).pooled)


@torch.inference_mode()
def touch_parts(
    model: Tac3dLlm,
    points: NDArray[np.float32],
    force_factor: float = 1.0,
    misreading: Misreading | None = None,
) -> TouchParts:
    """Embed one contact.

    Args:
        model: The model.
        points: Shape (N, 3), scaled.
        force_factor: Newtons per nominal newton of the unit that measured the points.
        misreading: A head that is made to read wrongly; None leaves all as they are.
    """
    encoded = model.encoder(torch.from_numpy(points)[None])
    if misreading is None:
        touch = model.projected(encoded, force_factor)[0]
    else:
        read = model.heads(encoded.pooled)
        logits = list(read.logits)
        logits[list(CLASSES).index(misreading.dimension)] = misreading.logits[None]
        numbers = scaled_force(read.numbers, force_factor)
        touch = model.projector(
            encoded.tokens, read._replace(logits=tuple(logits), numbers=numbers)
        )
        touch = touch[0]
    num_tokens = encoded.tokens.shape[1]
    return TouchParts(tokens=touch[:num_tokens], readings=touch[num_tokens:])


def mean_parts(parts: Sequence[TouchParts]) -> TouchParts:
    """Means over contacts: embeddings that tell nothing of any one of them."""
    tokens, readings = zip(*parts, strict=True)
    return TouchParts(tokens=torch.stack(tokens).mean(0), readings=torch.stack(readings).mean(0))
