"""What the class token of a lattice reads of a cloud without attention.

``ClassTokenFeatures`` look at all groups at once; ``HeightQuantiles`` read the sorted heights, and
``PositionFeatures`` the layout of points from contact-adaptive sampling. The names of attributes
are those of the stored weights.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.tokenizers import cell_sizes, line_positions, square_lattice
from cltp.tactile.point_layout import EVEN, Sampling


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
        sampling: How the points lie. With contact-adaptive sampling each point counts for the part
            of the sensing area that it stands for, and ``PositionFeatures`` are added.
    """

    def __init__(
        self,
        dim: int,
        samples: int,
        hidden: int = 256,
        *,
        grades: int = 0,
        sampling: Sampling = EVEN,
    ) -> None:
        super().__init__()
        self.samples, self.grades = samples, grades
        self.where = PositionFeatures(dim, sampling.side) if sampling.adaptive else None
        size = samples + grades * len(encoded_ranks(samples))
        size += self.where.size if self.where is not None else 0
        self.trunk = nn.Sequential(
            nn.Linear(size, hidden), nn.GELU(), nn.Linear(hidden, hidden), nn.GELU()
        )
        self.token, self.pooled = nn.Linear(hidden, dim), nn.Linear(hidden, 2 * dim)

    def forward(self, points: Tensor, tokens: Tensor) -> HeightTerms:
        """Terms of scaled points (B, N, 3), whose groups' tokens are (B, G, C)."""
        sizes = None if self.where is None else cell_sizes(points)
        quantiles = height_quantiles(points, self.samples, sizes)
        features = [5 * quantiles]
        if self.grades:
            encoded = quantiles[:, encoded_ranks(self.samples)]
            features.append(piecewise_linear(encoded, self.grades))
        if self.where is not None and sizes is not None:
            features.append(self.where(points, sizes, tokens))
        hidden = self.trunk(torch.cat(features, dim=1))
        return HeightTerms(self.token(hidden)[:, None], self.pooled(hidden))


def height_quantiles(points: Tensor, samples: int, cell_sizes: Tensor | None = None) -> Tensor:
    """Heights (B, samples) in falling order, at ``quantile_ranks``.

    Args:
        points: Shape (B, N, 3).
        samples: Number of heights.
        cell_sizes: Shape (B, N), the part of the sensing area that each point stands for, in any
            unit; the same for all points when not given.
    """
    heights, order = points[..., 2].sort(dim=1, descending=True)
    count = points.shape[1]
    ranks = quantile_ranks(samples, count).to(points.device)
    if cell_sizes is None:
        return heights[:, ranks]
    deepest = samples // 2
    area = cell_sizes.gather(1, order).cumsum(dim=1)
    levels = ((ranks[deepest:] + 0.5) / count) * area[:, -1:]
    rest = torch.searchsorted(area, levels.contiguous()).clamp(max=count - 1)
    return torch.cat([heights[:, :deepest], heights.gather(1, rest)], dim=1)


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


class PositionFeatures(nn.Module):
    """Position and size of a contact in points from contact-adaptive sampling.

    The order of even points alone gives both. Here they come from the positions of the lattice's
    lines and the largest height on each, from the tokens summed over the parts of the sensing area
    that their groups stand for, and from the positions of the groups that some heads attend to.

    Args:
        dim: Width C of the tokens.
        side: Rows and columns of the lattice.
        sums: Number of values summed over the sensing area.
        looks: Number of heads that attend to a position.
    """

    def __init__(self, dim: int, side: int, sums: int = 32, looks: int = 8) -> None:
        super().__init__()
        self.size = 4 * side + sums + 2 * looks
        self.sums, self.looks = nn.Linear(dim, sums), nn.Linear(dim, looks)

    def forward(self, points: Tensor, cell_sizes: Tensor, tokens: Tensor) -> Tensor:
        """Shape (B, size), of points (B, N, 3), their ``cell_sizes`` (B, N) and tokens."""
        columns, rows = line_positions(points)
        lattice = square_lattice(points)
        highest = [5 * lattice[..., 2].amax(dim=axis) for axis in (1, 2)]
        areas = _grouped(square_lattice(cell_sizes[..., None]), tokens.shape[1])[..., 0]
        areas = areas / areas.sum(dim=1, keepdim=True)
        centres = _grouped(lattice[..., :2], tokens.shape[1])
        summed = (areas[..., None] * F.relu(self.sums(tokens))).sum(dim=1)
        attended = self.looks(tokens).softmax(dim=1).transpose(1, 2) @ centres
        return torch.cat(
            [2 * columns, 2 * rows, *highest, 4 * summed, 2 * attended.flatten(1)], dim=1
        )


def _grouped(lattice: Tensor, num_groups: int) -> Tensor:
    """Means over the groups of a lattice (B, n, n, K): shape (B, num_groups, K)."""
    edge = lattice.shape[1] // math.isqrt(num_groups)
    return F.avg_pool2d(lattice.permute(0, 3, 1, 2), edge).flatten(2).transpose(1, 2)
