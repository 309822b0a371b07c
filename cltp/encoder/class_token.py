"""What the class token of a lattice reads of a cloud without attention.

``ClassTokenFeatures`` look at all groups at once; ``HeightQuantiles`` read the sorted heights. The
names of attributes are those of the stored weights.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.tokenizers import GridMaps
from cltp.gel.pressure_maps import DAMPED
from cltp.tactile.encoder_input import OUTSIDE

_LEAST_NOISE = 1e-3
"""Scaled noise below which no two are told apart: 1.5 µm."""


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
        is_grid: Whether points are a grid, of whose maps ``grid_summary`` is read too.
    """

    def __init__(
        self, dim: int, samples: int, hidden: int = 256, *, grades: int = 0, is_grid: bool = False
    ) -> None:
        super().__init__()
        self.samples, self.grades, self.is_grid = samples, grades, is_grid
        size = samples + grades * len(encoded_ranks(samples)) + SUMMARY * is_grid
        self.trunk = nn.Sequential(
            nn.Linear(size, hidden), nn.GELU(), nn.Linear(hidden, hidden), nn.GELU()
        )
        self.token, self.pooled = nn.Linear(hidden, dim), nn.Linear(hidden, 2 * dim)

    def forward(self, points: Tensor, maps: GridMaps | None = None) -> HeightTerms:
        """Terms of scaled points (B, N, 3), and of their maps where they are a grid."""
        quantiles = height_quantiles(points, self.samples)
        features = [5 * quantiles]
        if self.grades:
            encoded = quantiles[:, encoded_ranks(self.samples)]
            features.append(piecewise_linear(encoded, self.grades))
        if self.is_grid:
            assert maps is not None, "expected the maps of a grid"
            features.append(grid_summary(maps))
        hidden = self.trunk(torch.cat(features, dim=1))
        return HeightTerms(self.token(hidden)[:, None], self.pooled(hidden))


def height_quantiles(points: Tensor, samples: int) -> Tensor:
    """Heights (B, samples) of points (B, N, 3) in falling order, at ``quantile_ranks``.

    Points outside the pad don't count.
    """
    heights = in_falling_order(points[..., 2])
    count = (heights > OUTSIDE / 2).sum(dim=1, keepdim=True)
    return heights.gather(1, quantile_ranks(samples, count))


def in_falling_order(values: Tensor) -> Tensor:
    """Values sorted along the last axis, the largest first; no gradient goes through.

    On a CPU numpy sorts, which takes a twentieth of torch's time for as many as a grid has.
    """
    values = values.detach()
    if values.device.type != "cpu":
        return values.sort(dim=-1, descending=True).values
    return torch.from_numpy(np.sort(values.numpy(), axis=-1)[..., ::-1].copy())


def quantile_ranks(samples: int, count: Tensor) -> Tensor:
    """Ranks of the quantiles among numbers (B, 1) of heights in falling order: (B, samples).

    The first half are the deepest heights one by one, the others are fractions of the pad.
    """
    deepest = samples // 2
    rest = torch.linspace(0, 1, samples - deepest + 1, device=count.device)[1:].square()
    spread = deepest - 1 + (rest * (count - deepest)).round().long()
    first = torch.arange(deepest, device=count.device).expand(len(count), -1)
    return torch.minimum(torch.cat([first, spread], dim=1), count - 1)


def curves_width(samples: int, grades: int, ranks: int) -> int:
    """Width of ``ordered_curves``."""
    return samples + grades + len(DAMPED) * ranks


def ordered_curves(points: Tensor, maps: GridMaps, samples: int, grades: int, ranks: int) -> Tensor:
    """Heights and pressures of a grid in falling order, as they are: (B, ``curves_width``).

    Where a cloud's depth and area are in one place, untouched by all that is learned. The deepest
    height is encoded piecewise too.

    Args:
        points: Scaled points (B, N, 3) of a grid.
        maps: Their maps, with the pressures.
        samples: Height quantiles.
        grades: Bins of the deepest one's encoding.
        ranks: Pressures of each map (``cltp.gel.pressure_maps``).
    """
    heights = height_quantiles(points, samples)
    ordered = in_falling_order(maps.pressures.flatten(2))
    rest = torch.linspace(0, 1, ranks - LARGEST + 1, device=points.device)[1:].square()
    spread = LARGEST + (rest * (ordered.shape[2] - 1 - LARGEST)).long()
    chosen = torch.cat([torch.arange(LARGEST, device=points.device), spread])
    logs = (_PRESSURE_GAIN * ordered[..., chosen].clamp(min=0)).log1p()
    deepest = piecewise_linear(heights[:, :1], grades)
    return torch.cat([5 * heights, deepest, logs.flatten(1)], dim=1)


LARGEST = 16
"""Largest pressures that are taken one by one."""

_PRESSURE_GAIN = 8.0
"""Pressures are told as logarithms of one and so many times them: the edge of a contact, where they
are small, is what tells its area."""

SUMMARY, _SMOOTH = 36, 32


def grid_summary(maps: GridMaps) -> Tensor:
    """What tells true heights from noise, and the size of the pad: (B, ``SUMMARY``).

    The deepest means of 3 × 3 cells; the fine noise, by its median absolute value and the logarithm
    of that; the logarithms of the part that the pad takes of the grid and of a cell's edge.
    """
    inside, height, mean = maps.inside, maps.height, maps.mean
    smooth = mean.where(inside > 0, OUTSIDE).flatten(1).topk(_SMOOTH, dim=1).values
    relief = (height - mean).abs().where(inside > 0, -1)[:, ::2, ::2]  # a quarter will do
    ordered = in_falling_order(relief.flatten(1))
    count = (ordered >= 0).sum(dim=1, keepdim=True)
    noise = ordered.gather(1, (count.clamp(min=1) - 1) // 2)
    taken = inside.mean(dim=(1, 2))[:, None].log()
    levels = [5 * smooth, 50 * noise, (1 + noise / _LEAST_NOISE).log(), taken, maps.log_edge]
    return torch.cat(levels, dim=1)


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
