"""What the class token of a lattice reads of a cloud without attention.

``ClassTokenFeatures`` look at all groups at once; ``HeightQuantiles`` read the sorted heights. The
names of attributes are those of the stored weights.
"""

from __future__ import annotations

from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn


class ClassTokenFeatures(nn.Module):
    """A dense layer over all groups at once, each with weights of its own, for the class token.

    The groups of a lattice stand at fixed positions, so that this layer reads directly where and
    how deep the contact is; attention would have to learn that.
    """

    def __init__(self, dim: int, num_groups: int, narrow: int = 24, hidden: int = 512) -> None:
        super().__init__()
        self.narrow = nn.Linear(dim, narrow)
        self.wide = nn.Linear(num_groups * narrow, hidden)
        self.out = nn.Linear(hidden, dim)

    def forward(self, tokens: Tensor) -> Tensor:
        """Tokens (B, G, C) to one more, (B, 1, C)."""
        flat = F.relu(self.narrow(tokens)).flatten(1)
        return self.out(F.relu(self.wide(flat)))[:, None]


class HeightTerms(NamedTuple):
    """What the height quantiles add to an encoding.

    Attributes:
        token: Shape (B, 1, C), added to the class token before all layers.
        pooled: Shape (B, 2 C), added to the pooled tokens after them.
    """

    token: Tensor
    pooled: Tensor


class HeightQuantiles(nn.Module):
    """Sorted heights of all points: how much of the sensing area lies how deep.

    The deepest heights are taken one by one, the others thinned out. Depth is the first of them,
    the area of contact a position along them. They go to the class token and, past all layers and
    their norms, to the pooled tokens too.

    Source: the material ratio curve of ISO 21920-2 (Abbott and Firestone), over points.

    Args:
        dim: Width C of the tokens.
        samples: Number of quantiles; half of them are the deepest heights.
        hidden: Width of both layers.
        grades: Bins of the piecewise linear encoding of some of the quantiles; 0 for none.
    """

    def __init__(self, dim: int, samples: int, hidden: int = 256, *, grades: int = 0) -> None:
        super().__init__()
        self.samples, self.grades = samples, grades
        size = samples + grades * len(encoded_ranks(samples))
        self.trunk = nn.Sequential(
            nn.Linear(size, hidden), nn.GELU(), nn.Linear(hidden, hidden), nn.GELU()
        )
        self.token, self.pooled = nn.Linear(hidden, dim), nn.Linear(hidden, 2 * dim)

    def forward(self, points: Tensor) -> HeightTerms:
        """Terms of scaled points (B, N, 3)."""
        quantiles = height_quantiles(points, self.samples)
        features = [5 * quantiles]
        if self.grades:
            encoded = quantiles[:, encoded_ranks(self.samples)]
            features.append(piecewise_linear(encoded, self.grades))
        hidden = self.trunk(torch.cat(features, dim=1))
        return HeightTerms(self.token(hidden)[:, None], self.pooled(hidden))


def height_quantiles(points: Tensor, samples: int) -> Tensor:
    """Heights (B, samples) of points (B, N, 3) in falling order, at ``quantile_ranks``."""
    heights = points[..., 2].sort(dim=1, descending=True).values
    return heights[:, quantile_ranks(samples, points.shape[1]).to(points.device)]


def quantile_ranks(samples: int, count: int) -> Tensor:
    """Ranks of the quantiles among ``count`` heights in falling order, shape (samples,)."""
    deepest = samples // 2
    rest = torch.linspace(0, 1, samples - deepest + 1)[1:].square()
    spread = deepest - 1 + (rest * (count - deepest)).round().long()
    return torch.cat([torch.arange(deepest), spread])


def piecewise_linear(heights: Tensor, grades: int) -> Tensor:
    """Scaled heights (B, K) as their progress through each of ``grades`` equal bins from 0 to 1.

    Shape (B, K * grades), 0 to 1. A limit between two classes, which is one number of many, becomes
    a weight of its own, where a network would have to bend at exactly that height.

    Source: piecewise linear encoding, Gorishniy et al., 'On Embeddings for Numerical Features in
    Tabular Deep Learning', 2022.
    """
    below = torch.arange(grades, device=heights.device)
    return (heights[..., None] * grades - below).clamp(0, 1).flatten(1)


def encoded_ranks(samples: int) -> list[int]:
    """Which of so many quantiles are encoded piecewise: eight of the deepest, then every 4th.

    Of 64: 0, 1, 3, 6, 10, 16, 23, 31 and 35, 39, ... 63.
    """
    half = samples // 2
    deep = sorted({round((half - 1) * (n / 7) ** 2) for n in range(8)})
    return deep + list(range(half + 3, samples, 4))
