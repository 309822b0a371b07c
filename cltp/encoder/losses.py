"""The contrastive losses of CLTP, over features of any encoders.

Source: paper, section 4, L_T2L and L_T2I; the temperature as ULIP has it, started at 0.07 and at
least 0.01, with negatives gathered over all processes. The paper sums over a batch where we take
the mean, which only scales.

Ours: several rows may match. Two contacts with the same caption are no negatives of each other, and
a text that names one dimension alone is true of every contact of that class. Each row then has to
give all its ``matches`` the same probability.
"""

from __future__ import annotations

import math

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.all_gather import gathered

LARGEST_LOG_SCALE = math.log(100.0)


class ContrastiveLoss(nn.Module):
    """Symmetric cross-entropy between paired features, with a learnable temperature."""

    def __init__(self) -> None:
        super().__init__()
        self.log_scale = nn.Parameter(torch.tensor(math.log(1 / 0.07)))

    @property
    def scale(self) -> Tensor:
        """One over the temperature, at most 100."""
        return self.log_scale.clamp(max=LARGEST_LOG_SCALE).exp()

    def forward(self, one: Tensor, other: Tensor, matches: Tensor | None = None) -> Tensor:
        """Loss of features (B, F) and (B, F), row i of one matching row i of the other.

        With several processes, each gives the loss of the rows of all.

        Args:
            one: Features of one kind.
            other: Features of the other kind.
            matches: Shape (B, B) over the rows of all processes, bool: which rows of ``one`` (first
                index) match which of ``other``; each row has a match. None: its own alone.
        """
        one = gathered(F.normalize(one, dim=-1))
        other = gathered(F.normalize(other, dim=-1))
        similar = self.scale * one @ other.T
        if matches is None:
            pairs = torch.arange(len(one), device=one.device)
            return 0.5 * (F.cross_entropy(similar, pairs) + F.cross_entropy(similar.T, pairs))
        targets = matches.to(similar.dtype)
        return 0.5 * (
            F.cross_entropy(similar, targets / targets.sum(1, keepdim=True))
            + F.cross_entropy(similar.T, targets.T / targets.T.sum(1, keepdim=True))
        )


class CltpLoss(nn.Module):
    """L_T2L + L_T2I, one temperature for both as in ULIP."""

    def __init__(self) -> None:
        super().__init__()
        self.contrast = ContrastiveLoss()

    def forward(
        self,
        touch: Tensor,
        language: Tensor,
        image: Tensor | None = None,
        matches: Tensor | None = None,
    ) -> dict[str, Tensor]:
        """Named terms; without images (the paper's ablation) ``t2l`` alone.

        ``matches`` is for language: which contacts match which texts.
        """
        terms = {"t2l": self.contrast(touch, language, matches)}
        if image is not None:
            terms["t2i"] = self.contrast(touch, image)
        return terms

    def against_prompts(self, touch: Tensor, prompts: Tensor, classes: Tensor) -> Tensor:
        """Contrast of contacts with the texts of every class of one dimension.

        Args:
            touch: Features, shape (B, F).
            prompts: Features of one text for each class, shape (classes, F), normalised.
            classes: Shape (B,), the class of each contact; negative without a label.
        """
        similar = self.contrast.scale * F.normalize(touch, dim=-1) @ prompts.T
        total = F.cross_entropy(similar, classes, ignore_index=-1, reduction="sum")
        return total / (classes >= 0).sum().clamp(min=1)
