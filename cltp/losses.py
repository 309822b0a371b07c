"""The contrastive losses of CLTP. They know nothing of towers.

Source: paper, section 4, L_T2L and L_T2I; the temperature as ULIP has it, started at 0.07 and kept
from falling below 0.01. The paper sums over a batch where we take the mean, which only scales.
"""

from __future__ import annotations

import math

import torch
import torch.nn.functional as F
from torch import Tensor, nn

LARGEST_LOG_SCALE = math.log(100.0)


class ContrastiveLoss(nn.Module):
    """Symmetric cross-entropy between paired features, with a learnable temperature."""

    def __init__(self) -> None:
        super().__init__()
        self.log_scale = nn.Parameter(torch.tensor(math.log(1 / 0.07)))

    def forward(self, one: Tensor, other: Tensor) -> Tensor:
        """Loss of features (B, F) and (B, F), row i of one belonging to row i of the other."""
        scale = self.log_scale.clamp(max=LARGEST_LOG_SCALE).exp()
        similar = scale * F.normalize(one, dim=-1) @ F.normalize(other, dim=-1).T
        pairs = torch.arange(len(one), device=one.device)
        return 0.5 * (F.cross_entropy(similar, pairs) + F.cross_entropy(similar.T, pairs))


class CltpLoss(nn.Module):
    """L_T2L + L_T2I, one temperature for both as in ULIP."""

    def __init__(self) -> None:
        super().__init__()
        self.contrast = ContrastiveLoss()

    def forward(
        self, touch: Tensor, language: Tensor, image: Tensor | None = None
    ) -> dict[str, Tensor]:
        """Named terms; without images (the paper's ablation) ``t2l`` alone."""
        terms = {"t2l": self.contrast(touch, language)}
        if image is not None:
            terms["t2i"] = self.contrast(touch, image)
        return terms
