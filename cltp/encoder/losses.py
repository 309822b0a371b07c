"""The contrastive losses of CLTP. They know nothing of towers.

Source: paper, section 4, L_T2L and L_T2I; the temperature as ULIP has it, started at 0.07 and kept
from falling below 0.01, and its negatives, gathered over all processes. The paper sums over a batch
where we take the mean, which only scales.

Ours: several rows may belong together. Two contacts with the same caption are no negatives of each
other, and a text that names one dimension alone fits every contact of that class; ``fits`` says so,
and each row then has to give all that fit it the same share.
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

    def forward(self, one: Tensor, other: Tensor, fits: Tensor | None = None) -> Tensor:
        """Loss of features (B, F) and (B, F), row i of one belonging to row i of the other.

        With several processes, all give the loss of the rows of all.

        Args:
            one: Features of one kind.
            other: Of the other.
            fits: Shape (B, B) over the rows of all processes, bool: which rows of ``one`` (first
                index) belong to which of ``other``; each to some. None: to its own alone.
        """
        one = gathered(F.normalize(one, dim=-1))
        other = gathered(F.normalize(other, dim=-1))
        similar = self.scale * one @ other.T
        if fits is None:
            pairs = torch.arange(len(one), device=one.device)
            return 0.5 * (F.cross_entropy(similar, pairs) + F.cross_entropy(similar.T, pairs))
        shares = fits.to(similar.dtype)
        return 0.5 * (
            F.cross_entropy(similar, shares / shares.sum(1, keepdim=True))
            + F.cross_entropy(similar.T, shares.T / shares.T.sum(1, keepdim=True))
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
        fits: Tensor | None = None,
    ) -> dict[str, Tensor]:
        """Named terms; without images (the paper's ablation) ``t2l`` alone.

        ``fits`` is for language: which contacts belong to which texts.
        """
        terms = {"t2l": self.contrast(touch, language, fits)}
        if image is not None:
            terms["t2i"] = self.contrast(touch, image)
        return terms

    def against_prompts(self, touch: Tensor, prompts: Tensor, classes: Tensor) -> Tensor:
        """Contrast of contacts with the texts of every class of one dimension.

        Args:
            touch: Features, shape (B, F).
            prompts: Features of one text a class, shape (classes, F), normalised.
            classes: Shape (B,), the class of each contact; negative where it has none.
        """
        similar = self.contrast.scale * F.normalize(touch, dim=-1) @ prompts.T
        known = classes >= 0
        total = F.cross_entropy(similar, classes, ignore_index=-1, reduction="sum")
        return total / known.sum().clamp(min=1)
