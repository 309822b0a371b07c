"""Clouds and frames to tokens, and what the class token reads of them without attention.

The three tokenizers of ``cltp.encoder``, in pure torch.
"""

from __future__ import annotations

from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.inputs import LATTICE


class Survey(nn.Module):
    """A first look at all groups at once, each with weights of its own, for the class token.

    The groups of a lattice stand in fixed places, so that a dense layer over them reads where and
    how deep the contact is directly, what attention would have to learn.
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


class Bearing(NamedTuple):
    """What a bearing curve adds to an encoding.

    Attributes:
        token: Shape (B, 1, C), to the class token before all layers.
        pooled: Shape (B, 2 C), to the pooled tokens after them.
    """

    token: Tensor
    pooled: Tensor


class BearingCurve(nn.Module):
    """How much of the field lies how deep: the bearing-area curve of surface metrology.

    The heights of all points in falling order: the deepest one by one, the others thinned out.
    Depth is where it begins, the area of contact a place along it. It goes to the class token, and
    past all layers and their norms to the pooled tokens too.

    Source: the material ratio curve of ISO 21920-2 (Abbott and Firestone), over points.

    Args:
        dim: Width C of the tokens.
        samples: Heights along the curve; half of them are the deepest.
        hidden: Width of both layers.
    """

    def __init__(self, dim: int, samples: int, hidden: int = 256) -> None:
        super().__init__()
        self.samples = samples
        self.trunk = nn.Sequential(
            nn.Linear(samples, hidden), nn.GELU(), nn.Linear(hidden, hidden), nn.GELU()
        )
        self.token, self.pooled = nn.Linear(hidden, dim), nn.Linear(hidden, 2 * dim)

    def forward(self, points: Tensor) -> Bearing:
        """What the heights of scaled points (B, N, 3) add."""
        found = self.trunk(5 * bearing_curve(points, self.samples))
        return Bearing(self.token(found)[:, None], self.pooled(found))


def bearing_curve(points: Tensor, samples: int) -> Tensor:
    """Heights (B, samples) of points (B, N, 3) in falling order, at ``bearing_ranks``."""
    heights = points[..., 2].sort(dim=1, descending=True).values
    return heights[:, bearing_ranks(samples, points.shape[1])]


def bearing_ranks(samples: int, count: int) -> Tensor:
    """Which of ``count`` heights in falling order make a bearing curve, shape (samples,)."""
    deepest = samples // 2
    rest = torch.linspace(0, 1, samples - deepest + 1)[1:].square()
    spread = deepest - 1 + (rest * (count - deepest)).round().long()
    return torch.cat([torch.arange(deepest), spread])


class LatticeTokenizer(nn.Module):
    """Convolutions over the 32 × 32 lattice of points down to 8 × 8 tokens.

    Four neighbouring points become one cell of 16 × 16, which keeps all that they say at a quarter
    of the cost; pairs of convolutions mix cells; each 2 × 2 cells with those around become a token.

    Args:
        dim: Width of the tokens.
        stem_dim: Channels at 16 × 16.
        blocks: Pairs of convolutions there.
    """

    CHANNELS = 4

    def __init__(self, dim: int, stem_dim: int, blocks: int) -> None:
        super().__init__()
        self.stem = nn.Conv2d(4 * self.CHANNELS, stem_dim, 3, padding=1)
        self.mix = nn.Sequential(*(ConvBlock(stem_dim) for _ in range(blocks)))
        self.group = nn.Conv2d(stem_dim, dim, 3, stride=2, padding=1)
        self.position = nn.Parameter(torch.randn(1, 64, dim) * 0.02)

    def forward(self, points: Tensor) -> Tensor:
        """Points (B, 1024, 3) to tokens (B, 64, C)."""
        cells = F.pixel_unshuffle(self.channels(points), 2)
        x = self.mix(self.stem(cells.contiguous(memory_format=torch.channels_last)))
        x = self.group(F.relu(x))
        return x.flatten(2).transpose(1, 2) + self.position

    @staticmethod
    def channels(points: Tensor) -> Tensor:
        """Indentation, its fine relief, and the points' places inside their cells.

        Brought to a common size, since weights start out alike: 0.3 mm becomes 1, a relief of
        0.03 mm becomes 1, half a cell becomes 1.
        """
        lattice = points.view(-1, LATTICE, LATTICE, 3).permute(0, 3, 1, 2)
        x, y, z = lattice.split(1, dim=1)
        relief = z - F.avg_pool2d(z, 3, stride=1, padding=1, count_include_pad=False)
        steps = (torch.arange(LATTICE, device=points.device) + 0.5) / LATTICE - 0.5
        # The scaled field reaches ±1 in x and ± its aspect in y; the aspect is the slope of y over
        # the rows. What is left, in cells, says where in its cell a point lies.
        down = steps[:, None]
        aspect = -(y * down).sum(dim=(1, 2, 3), keepdim=True) / (2 * LATTICE * (steps**2).sum())
        dx = (x - 2 * steps) * LATTICE
        dy = (y + 2 * aspect * down) * LATTICE
        return torch.cat([5 * z, 50 * relief, dx, dy], dim=1)


class ConvBlock(nn.Module):
    """A residual pair of 3 × 3 convolutions."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.first = nn.Conv2d(channels, channels, 3, padding=1)
        self.second = nn.Conv2d(channels, channels, 3, padding=1)

    def forward(self, x: Tensor) -> Tensor:
        """Maps (B, C, H, W) to maps."""
        return x + self.second(F.relu(self.first(F.relu(x))))


class FpsTokenizer(nn.Module):
    """Groups around farthest points, each summarised by a small PointNet (Point-BERT).

    Args:
        dim: Width of the tokens.
        width: Channels of the PointNet's first layer; 128 in Point-BERT.
        num_groups: Groups.
        group_size: Nearest points in a group.
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
        found: Tensor = tokens + self.position(centres * 2.0)
        return found


class PatchTokenizer(nn.Module):
    """8 × 8 patches of an image of 64 × 64 pixels, each a token (a vision transformer's)."""

    def __init__(self, dim: int) -> None:
        super().__init__()
        self.patch = nn.Conv2d(3, dim, 8, stride=8)
        self.position = nn.Parameter(torch.randn(1, 64, dim) * 0.02)

    def forward(self, pixels: Tensor) -> Tensor:
        """Pixels (B, 3, 64, 64), 0 to 1, to tokens (B, 64, C)."""
        found: Tensor = self.patch((pixels - 0.5) / 0.25)
        return found.flatten(2).transpose(1, 2) + self.position


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
