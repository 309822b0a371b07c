"""Heads that read a contact state from the encoder's pooled tokens, and their targets.

Beyond the paper, whose encoder learns from captions and images alone: numbers, which its section on
limitations names, make the tokens precise enough to act on. Used in pre-training beside the
contrastive losses, and in evaluation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.tactile.states import CLASSES, NUMBERS, ContactState, Side

SMALLEST_FORCE_N = 0.05
"""Forces are learned as logarithms; below this force, errors count in newtons."""

IGNORED = -1


class Targets(NamedTuple):
    """Labels of a batch for the heads.

    Attributes:
        classes: Shape (B, 5), indices into ``CLASSES``; ``IGNORED`` where there is no label.
        numbers: Shape (B, 5), transformed ``NUMBERS``.
        touching: Shape (B,), 1 where there is contact.
        cut: Shape (B, 4), 1 for each side that cuts the contact.
    """

    classes: Tensor
    numbers: Tensor
    touching: Tensor
    cut: Tensor


def targets(states: Sequence[ContactState]) -> Targets:
    """Targets of labelled states."""
    words = [[(names, getattr(s, slot)) for slot, names in CLASSES.items()] for s in states]
    classes = [[IGNORED if w is None else names.index(w) for names, w in row] for row in words]
    numbers = torch.tensor([[getattr(s, n) for n in NUMBERS] for s in states], dtype=torch.float32)
    return Targets(
        classes=torch.tensor(classes),
        numbers=transformed(numbers),
        touching=torch.tensor([float(s.in_contact) for s in states]),
        cut=torch.tensor([[float(side in s.cut) for side in Side] for s in states]),
    )


def transformed(numbers: Tensor) -> Tensor:
    """Bring ``NUMBERS`` (..., 5) to a common size: lengths scaled, area by root, force by log."""
    depth, x, y, area, force = numbers.unbind(-1)
    softened = torch.log1p(force.clamp(min=0) / SMALLEST_FORCE_N) / 2
    return torch.stack([depth / 0.3, x / 5, y / 5, area.clamp(min=0).sqrt() / 0.3, softened], -1)


def restored(values: Tensor) -> Tensor:
    """Inverse of ``transformed``."""
    depth, x, y, area, force = values.unbind(-1)
    newtons = SMALLEST_FORCE_N * torch.expm1(2 * force.clamp(0, 5))
    return torch.stack([depth * 0.3, x * 5, y * 5, (area.clamp(min=0) * 0.3) ** 2, newtons], dim=-1)


def scaled_force(numbers: Tensor, factor: float | Tensor) -> Tensor:
    """Transformed numbers with the force in newtons instead of nominal newtons.

    Args:
        numbers: Shape (..., 5), transformed ``NUMBERS``, as the heads give them.
        factor: Newtons per nominal newton, one number or (...), above 0
            (``cltp.tactile.force_scale``). The number 1 gives ``numbers`` themselves.
    """
    if isinstance(factor, float | int) and factor == 1:
        return numbers
    *others, force = numbers.unbind(-1)
    newtons = torch.expm1(2 * force.clamp(0, 5)) * factor
    return torch.stack([*others, torch.where(force > 0, torch.log1p(newtons) / 2, force)], -1)


def with_read_numbers(states: Sequence[ContactState], numbers: Tensor) -> list[ContactState]:
    """States with the heads' numbers in place of their own; words stay, and states without contact.

    Args:
        states: B states.
        numbers: Shape (B, 5), transformed ``NUMBERS``, as the heads give them.
    """
    read = restored(numbers.detach().float().cpu())
    read[:, NUMBERS.index("depth_mm")].clamp_(min=0)
    read[:, NUMBERS.index("area_fraction")].clamp_(max=1)
    return [
        replace(state, **dict(zip(NUMBERS, row, strict=True))) if state.in_contact else state
        for state, row in zip(states, read.tolist(), strict=True)
    ]


class HeadsOutput(NamedTuple):
    """Output of the heads for a batch.

    Attributes:
        logits: Logits of the five slots, each (B, classes).
        numbers: Shape (B, 5), transformed ``NUMBERS``.
        touching: Shape (B,), logit of contact.
        cut: Shape (B, 4), logit that each side cuts the contact.
    """

    logits: tuple[Tensor, ...]
    numbers: Tensor
    touching: Tensor
    cut: Tensor


class StateHeads(nn.Module):
    """All heads behind one hidden layer.

    Args:
        pooled_dim: Width of ``Encoded.pooled``.
        hidden_dim: Width of the hidden layer.
    """

    def __init__(self, pooled_dim: int, hidden_dim: int = 256) -> None:
        super().__init__()
        self.sizes = [len(names) for names in CLASSES.values()]
        outputs = sum(self.sizes) + len(NUMBERS) + 1 + len(Side)
        self.hidden = nn.Linear(pooled_dim, hidden_dim)
        self.out = nn.Linear(hidden_dim, outputs)

    def forward(self, pooled: Tensor) -> HeadsOutput:
        """Read states from ``Encoded.pooled`` (B, 2 C)."""
        out = self.out(F.gelu(self.hidden(pooled)))
        *logits, numbers, touching, cut = out.split([*self.sizes, len(NUMBERS), 1, len(Side)], -1)
        return HeadsOutput(tuple(logits), numbers, touching[:, 0], cut)

    def losses(self, pooled: Tensor, labels: Targets) -> dict[str, Tensor]:
        """Named terms, each a mean over the batch."""
        logits, numbers, touching, cut = self(pooled)
        terms = {}
        for column, (slot, scores) in enumerate(zip(CLASSES, logits, strict=True)):
            classes = labels.classes[:, column]
            total = F.cross_entropy(scores, classes, ignore_index=IGNORED, reduction="sum")
            terms[slot] = total / (classes != IGNORED).sum().clamp(min=1)
        errors = F.smooth_l1_loss(numbers, labels.numbers, beta=0.1, reduction="none")
        terms["numbers"] = (errors * labels.touching[:, None]).sum(1).mean()
        terms["touching"] = F.binary_cross_entropy_with_logits(touching, labels.touching)
        terms["cut"] = F.binary_cross_entropy_with_logits(cut, labels.cut)
        return terms
