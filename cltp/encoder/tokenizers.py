"""Clouds and frames to tokens: one class for each way of tokenizing, in pure torch.

Not here: which encoder uses which (``VARIANTS`` in ``cltp.encoder.encoder``).
"""

from __future__ import annotations

import math

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.tactile.point_layout import EVEN, Sampling


def square_lattice(points: Tensor) -> Tensor:
    """Points of a square lattice (B, N, K) as (B, n, n, K)."""
    side = math.isqrt(points.shape[1])
    return points.view(-1, side, side, points.shape[2])


def line_positions(points: Tensor) -> tuple[Tensor, Tensor]:
    """Positions of a square lattice's columns along x, and of its rows along y: (B, n) each."""
    lattice = square_lattice(points)
    return lattice[..., 0].mean(dim=1), lattice[..., 1].mean(dim=2)


def line_distances(points: Tensor) -> tuple[Tensor, Tensor]:
    """Distances between neighbouring columns, and rows, of a square lattice: (B, n) each."""
    columns, rows = line_positions(points)
    distances = []
    for lines in (columns, -rows):
        between = F.pad((lines[:, 2:] - lines[:, :-2]) / 2, (1, 1))
        between[:, 0] = lines[:, 1] - lines[:, 0]
        between[:, -1] = lines[:, -1] - lines[:, -2]
        distances.append(between.clamp_min(1e-4))
    return distances[0], distances[1]


def cell_sizes(points: Tensor) -> Tensor:
    """Part of the sensing area that each point of a square lattice (B, N, 3) stands for: (B, N)."""
    along_x, along_y = line_distances(points)
    return (along_y[:, :, None] * along_x[:, None, :]).flatten(1)


class LatticeTokenizer(nn.Module):
    """Convolutions over a lattice of points down to 16 × 16 cells, and those to tokens.

    The points of a cell (2 × 2 of 32 × 32) become channels, which keeps all their information at a
    quarter of the cost; pairs of convolutions mix cells; each 2 × 2 cells with those around become
    one of 64 tokens.

    Args:
        dim: Width of the tokens.
        stem_dim: Channels at 16 × 16.
        blocks: Pairs of convolutions there.
        num_groups: Number of tokens: 16, 64 or 256.
        sampling: How the points lie. With contact-adaptive sampling, their positions and distances
            are channels too.
    """

    CELLS = 16

    def __init__(
        self, dim: int, stem_dim: int, blocks: int, num_groups: int = 64, sampling: Sampling = EVEN
    ) -> None:
        super().__init__()
        self.is_adaptive = sampling.adaptive
        self.in_cell = sampling.side // self.CELLS
        channels = self.in_cell**2 * (8 if self.is_adaptive else 4)
        stride = self.CELLS // math.isqrt(num_groups)
        self.stem = nn.Conv2d(channels, stem_dim, 3, padding=1)
        self.mix = nn.Sequential(*(ConvBlock(stem_dim) for _ in range(blocks)))
        self.group = nn.Conv2d(stem_dim, dim, 3, stride=stride, padding=1)
        self.position = nn.Parameter(torch.randn(1, num_groups, dim) * 0.02)

    def forward(self, points: Tensor) -> Tensor:
        """Points (B, side², 3) to tokens (B, num_groups, C)."""
        channels = adaptive_channels(points) if self.is_adaptive else even_channels(points)
        cells = F.pixel_unshuffle(channels, self.in_cell)
        x = self.mix(self.stem(cells.contiguous(memory_format=torch.channels_last)))
        x = self.group(F.relu(x))
        return x.flatten(2).transpose(1, 2) + self.position


def even_channels(points: Tensor) -> Tensor:
    """Indentation, its fine relief, and the points' positions in their cells: (B, 4, n, n).

    Brought to a common size, since weights start out alike: 0.3 mm becomes 1, a relief of 0.03 mm
    becomes 1, half a cell becomes 1.
    """
    x, y, z, relief = _maps(points)
    side = x.shape[-1]
    steps = (torch.arange(side, device=points.device) + 0.5) / side - 0.5
    # The scaled sensing area reaches ±1 in x and ± its aspect in y; the aspect is the slope of y
    # over the rows. The remainder, in cells, is the position of a point in its cell.
    down = steps[:, None]
    aspect = -(y * down).sum(dim=(1, 2, 3), keepdim=True) / (2 * side * (steps**2).sum())
    dx = (x - 2 * steps) * side
    dy = (y + 2 * aspect * down) * side
    return torch.cat([5 * z, 50 * relief, dx, dy], dim=1)


def adaptive_channels(points: Tensor) -> Tensor:
    """As ``even_channels`` for contact-adaptive sampling, with positions and line distances.

    Shape (B, 8, n, n). The position in a cell is the distance of a point from the mean of its line;
    line distances are logarithms of their ratio to even ones.
    """
    x, y, z, relief = _maps(points)
    side = x.shape[-1]
    along_x, along_y = (step.to(points.dtype) for step in line_distances(points))
    dx = (x - x.mean(dim=2, keepdim=True)) / along_x[:, None, None, :]
    dy = (y - y.mean(dim=3, keepdim=True)) / along_y[:, None, :, None]
    near_x = (along_x * side / 2).log()[:, None, None, :].expand_as(x)
    near_y = (along_y * side / 2).log()[:, None, :, None].expand_as(x)
    return torch.cat([5 * z, 50 * relief, 2 * dx, 2 * dy, x, y, near_x, near_y], dim=1)


def _maps(points: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor]:
    """x, y, z of a square lattice, and z less its neighbours' mean: (B, 1, n, n) each."""
    x, y, z = square_lattice(points).permute(0, 3, 1, 2).split(1, dim=1)
    return x, y, z, z - F.avg_pool2d(z, 3, stride=1, padding=1, count_include_pad=False)


class ConvBlock(nn.Module):
    """A residual pair of 3 × 3 convolutions over maps (B, C, H, W)."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.first = nn.Conv2d(channels, channels, 3, padding=1)
        self.second = nn.Conv2d(channels, channels, 3, padding=1)

    def forward(self, x: Tensor) -> Tensor:
        return x + self.second(F.relu(self.first(F.relu(x))))


class FpsTokenizer(nn.Module):
    """Groups around farthest points, each summarised by a small PointNet (Point-BERT).

    Args:
        dim: Width of the tokens.
        width: Channels of the PointNet's first layer; 128 in Point-BERT.
        num_groups: Number of groups.
        group_size: Number of nearest points in a group.
    """

    GAIN = 8.0  # neighbours lie about 0.1 apart in scaled units

    def __init__(self, dim: int, width: int, num_groups: int, group_size: int) -> None:
        super().__init__()
        self.num_groups, self.group_size = num_groups, group_size
        self.first = nn.Sequential(nn.Linear(3, width), nn.GELU(), nn.Linear(width, 2 * width))
        self.second = nn.Sequential(
            nn.Linear(4 * width, 2 * dim), nn.GELU(), nn.Linear(2 * dim, dim)
        )
        self.position = nn.Sequential(nn.Linear(3, 128), nn.GELU(), nn.Linear(128, dim))

    def forward(self, points: Tensor) -> Tensor:
        """Points (B, N, 3) to tokens (B, num_groups, C)."""
        return self.embedded(*self.groups(points))

    def groups(self, points: Tensor) -> tuple[Tensor, Tensor]:
        """Points around their centres, in a common size (B, G, n, 3), and the centres (B, G, 3)."""
        batch = torch.arange(len(points), device=points.device)[:, None]
        with torch.no_grad():
            centre_index = farthest_points(points, self.num_groups)
            centres = points[batch, centre_index]
            near = torch.cdist(centres, points).topk(self.group_size, largest=False).indices
        return (points[batch[:, :, None], near] - centres[:, :, None]) * self.GAIN, centres

    def embedded(self, groups: Tensor, centres: Tensor) -> Tensor:
        """Tokens (B, G, C) of groups."""
        local = self.first(groups)
        whole = local.amax(dim=2, keepdim=True).expand_as(local)
        tokens = self.second(torch.cat([whole, local], dim=-1)).amax(dim=2)
        positioned: Tensor = tokens + self.position(centres * 2.0)
        return positioned


class PatchTokenizer(nn.Module):
    """8 × 8 patches of an image of 64 × 64 pixels, each a token (a vision transformer's)."""

    def __init__(self, dim: int) -> None:
        super().__init__()
        self.patch = nn.Conv2d(3, dim, 8, stride=8)
        self.position = nn.Parameter(torch.randn(1, 64, dim) * 0.02)

    def forward(self, pixels: Tensor) -> Tensor:
        """Pixels (B, 3, 64, 64), 0 to 1, to tokens (B, 64, C)."""
        patches: Tensor = self.patch((pixels - 0.5) / 0.25)
        return patches.flatten(2).transpose(1, 2) + self.position


def farthest_points(points: Tensor, num: int) -> Tensor:
    """Indices (B, num) of points, each farthest from those before it; the first one is point 0."""
    batch = torch.arange(len(points), device=points.device)
    chosen = torch.zeros(len(points), num, dtype=torch.long, device=points.device)
    nearest = torch.full(points.shape[:2], float("inf"), device=points.device)
    for step in range(1, num):
        last = points[batch, chosen[:, step - 1]].unsqueeze(1)
        nearest = torch.minimum(nearest, ((points - last) ** 2).sum(-1))
        chosen[:, step] = nearest.argmax(dim=1)
    return chosen
