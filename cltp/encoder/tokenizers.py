"""Clouds and frames to tokens: one class for each way of tokenizing, in pure torch.

Not here: which encoder uses which (``VARIANTS`` in ``cltp.encoder.encoder``).
"""

from __future__ import annotations

from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.gel.pressure_maps import DAMPED, pressure_maps
from cltp.tactile.encoder_input import GRID_UNIT_MM, OUTSIDE
from cltp.tactile.point_layout import GRID, LATTICE

UNIT_CELL_MM = 0.2
"""Edge of a cell in which lengths along a grid are told [mm]."""


class LatticeTokenizer(nn.Module):
    """Convolutions over a lattice of points down to 16 × 16 cells, and those to tokens.

    The points of a cell (2 × 2 of 32 × 32) become channels, which keeps all their information at a
    quarter of the cost; pairs of convolutions mix cells; each 2 × 2 cells with those around become
    one of 64 tokens.

    Args:
        dim: Width of the tokens.
        stem_dim: Channels at 16 × 16.
        blocks: Pairs of convolutions there.
    """

    GROUPS = 64
    CELLS = 16

    def __init__(self, dim: int, stem_dim: int, blocks: int) -> None:
        super().__init__()
        self.in_cell = LATTICE // self.CELLS
        self.stem = nn.Conv2d(self.in_cell**2 * 4, stem_dim, 3, padding=1)
        self.mix = nn.Sequential(*(ConvBlock(stem_dim) for _ in range(blocks)))
        self.group = nn.Conv2d(stem_dim, dim, 3, stride=2, padding=1)
        self.position = nn.Parameter(torch.randn(1, self.GROUPS, dim) * 0.02)

    def forward(self, points: Tensor) -> Tensor:
        """Points (B, 1024, 3) to tokens (B, 64, C)."""
        cells = F.pixel_unshuffle(even_channels(points), self.in_cell)
        x = self.mix(self.stem(cells.contiguous(memory_format=torch.channels_last)))
        x = self.group(F.relu(x))
        return x.flatten(2).transpose(1, 2) + self.position


def even_channels(points: Tensor) -> Tensor:
    """Indentation, its fine relief, and the points' positions in their cells: (B, 4, n, n).

    Brought to a common size, since weights start out alike: 0.3 mm becomes 1, a relief of 0.03 mm
    becomes 1, half a cell becomes 1.
    """
    side = LATTICE
    x, y, z = points.view(-1, side, side, 3).permute(0, 3, 1, 2).split(1, dim=1)
    steps = (torch.arange(side, device=points.device) + 0.5) / side - 0.5
    # The scaled sensing area reaches ±1 in x and ± its aspect in y; the aspect is the slope of y
    # over the rows. The remainder, in cells, is the position of a point in its cell.
    down = steps[:, None]
    aspect = -(y * down).sum(dim=(1, 2, 3), keepdim=True) / (2 * side * (steps**2).sum())
    dx = (x - 2 * steps) * side
    dy = (y + 2 * aspect * down) * side
    relief = z - F.avg_pool2d(z, 3, stride=1, padding=1, count_include_pad=False)
    return torch.cat([5 * z, 50 * relief, dx, dy], dim=1)


class GridTokenizer(nn.Module):
    """Strided convolutions over a grid of all heights, three times, and their output to tokens.

    75 × 100 cells become 38 × 50, 19 × 25 and 7 × 9 tokens; at the first two sizes pairs of
    convolutions mix cells, where textures and outlines are.

    Args:
        dim: Width of the tokens.
        stem_dim: Channels at 38 × 50; three times as many at 19 × 25.
        blocks: Pairs of convolutions at either size.
        sees_pressure: Whether the pressure under the heights is seen beside them.
    """

    GROUPS = 63

    def __init__(
        self, dim: int, stem_dim: int, blocks: int, *, sees_pressure: bool = False
    ) -> None:
        super().__init__()
        self.sees_pressure = sees_pressure
        wide = 3 * stem_dim
        channels = 5 + len(DAMPED) * sees_pressure
        self.stem = nn.Conv2d(channels, stem_dim, 3, stride=2, padding=1)
        self.mix = nn.Sequential(*(ConvBlock(stem_dim) for _ in range(blocks)))
        self.widen = nn.Conv2d(stem_dim, wide, 3, stride=2, padding=1)
        self.mix_wide = nn.Sequential(*(ConvBlock(wide) for _ in range(blocks)))
        self.group = nn.Conv2d(wide, dim, 5, stride=3, padding=2)
        self.position = nn.Parameter(torch.randn(1, self.GROUPS, dim) * 0.02)
        self.to(memory_format=torch.channels_last)  # type: ignore[call-overload]  # faster

    def forward(self, maps: GridMaps) -> Tensor:
        """Maps of clouds to tokens (B, 63, C)."""
        seen = grid_channels(maps, sees_pressure=self.sees_pressure)
        x = self.mix(self.stem(seen.contiguous(memory_format=torch.channels_last)))
        x = self.mix_wide(self.widen(F.relu(x)))
        x = self.group(F.relu(x))
        return x.flatten(2).transpose(1, 2) + self.position


class GridMaps(NamedTuple):
    """A grid of points as maps, (B, rows, columns) unless stated.

    Attributes:
        x, y: Positions, scaled.
        inside: 1 in the cells that the pad takes, 0 in the others.
        height: Scaled heights, 0 outside.
        mean: Their means over 3 × 3 cells, as far as these are inside; 0 outside.
        pressures: Shape (B, maps, rows, columns), 0 outside (``cltp.gel.pressure_maps``); no maps
            where none are asked for.
        log_edge: Shape (B, 1): ``log_cell_edge``.
    """

    x: Tensor
    y: Tensor
    inside: Tensor
    height: Tensor
    mean: Tensor
    pressures: Tensor
    log_edge: Tensor


def grid_maps(points: Tensor, *, has_pressure: bool = False) -> GridMaps:
    """Maps of scaled points (B, 7500, 3), of the pressure too if asked for."""
    x, y, z = points.view(-1, GRID.rows, GRID.columns, 3).unbind(dim=-1)
    inside = (z > OUTSIDE / 2).to(z.dtype)
    height = z * inside
    mean = inside * sums_of_nine(height) / sums_of_nine(inside).clamp(min=1)
    pressures = (
        inside[:, None] * pressure_maps(height)
        if has_pressure
        else inside.new_empty(len(inside), 0, *inside.shape[1:])
    )
    return GridMaps(x, y, inside, height, mean, pressures, log_cell_edge(points))


def log_cell_edge(points: Tensor) -> Tensor:
    """Logarithm of a cell's edge over ``UNIT_CELL_MM``, of grids of scaled points: (B, 1)."""
    edge_mm = GRID_UNIT_MM * (points[:, 1, 0] - points[:, 0, 0])
    return (edge_mm / UNIT_CELL_MM).log()[:, None]


def sums_of_nine(maps: Tensor) -> Tensor:
    """Sums over 3 × 3 cells of maps (B, rows, columns); a pooling takes ten times as long."""
    padded = F.pad(maps, (1, 1, 1, 1))
    down = padded[:, :-2] + padded[:, 1:-1] + padded[:, 2:]
    return down[..., :-2] + down[..., 1:-1] + down[..., 2:]


def grid_channels(maps: GridMaps, *, sees_pressure: bool = False) -> Tensor:
    """Indentation, its fine relief, positions, where the pad is, and pressures if asked for.

    Shape (B, 5 or more, rows, columns).

    Brought to a common size, since weights start out alike: 0.3 mm becomes 1, a relief of 0.03 mm
    becomes 1, 10 mm along the pad becomes 1.
    """
    x, y, inside, height, mean, pressures, _ = maps
    channels = [5 * height, 50 * (height - mean), x, y, inside]
    if sees_pressure:
        channels += pressures.unbind(dim=1)
    return torch.stack(channels, dim=-1).permute(0, 3, 1, 2)


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
