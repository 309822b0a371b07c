"""Clouds and frames to tokens, and what the class token reads of them without attention.

The three tokenizers of ``cltp.encoder.encoder``, in pure torch.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.tactile.point_layout import EVEN, Sampling


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
        grades: Steps of height that some of the curve's heights are also told in (``graded``); 0
            for none.
        sampling: How the points lie. Where they crowd, each counts for the part of the field that
            it stands for, and ``Whereabouts`` go with the curve.
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
        self.where = Whereabouts(dim, sampling.side) if sampling.pressed > 0 else None
        taken = samples + grades * len(graded_ranks(samples))
        taken += self.where.size if self.where is not None else 0
        self.trunk = nn.Sequential(
            nn.Linear(taken, hidden), nn.GELU(), nn.Linear(hidden, hidden), nn.GELU()
        )
        self.token, self.pooled = nn.Linear(hidden, dim), nn.Linear(hidden, 2 * dim)

    def forward(self, points: Tensor, tokens: Tensor) -> Bearing:
        """What the heights of scaled points (B, N, 3) add, whose groups' tokens are (B, G, C)."""
        parts = None if self.where is None else cell_sizes(points)
        curve = bearing_curve(points, self.samples, parts)
        taken = [5 * curve]
        if self.grades:
            taken.append(graded(curve[:, graded_ranks(self.samples)], self.grades))
        if self.where is not None and parts is not None:
            taken.append(self.where(points, parts, tokens))
        found = self.trunk(torch.cat(taken, dim=1))
        return Bearing(self.token(found)[:, None], self.pooled(found))


def graded(heights: Tensor, grades: int) -> Tensor:
    """Heights (B, K), scaled, as how far each has come through each of so many steps from 0 to 1.

    Shape (B, K * grades), 0 to 1: a limit between two classes, which is one number of many, becomes
    a weight of its own, where a network would have to bend at that very place.

    Source: piecewise linear encoding, Gorishniy et al., 'On Embeddings for Numerical Features in
    Tabular Deep Learning', 2022.
    """
    below = torch.arange(grades, device=heights.device)
    return (heights[..., None] * grades - below).clamp(0, 1).flatten(1)


def graded_ranks(samples: int) -> list[int]:
    """Places on a curve of so many heights that are graded: eight at its deep end, then every 4th.

    Of 64: 0, 1, 3, 6, 10, 16, 23, 31 and 35, 39, ... 63.
    """
    half = samples // 2
    deep = sorted({round((half - 1) * (n / 7) ** 2) for n in range(8)})
    return deep + list(range(half + 3, samples, 4))


class Whereabouts(nn.Module):
    """What even points say by their order alone, said of crowded ones: where, and how much.

    Where the lattice's lines lie and how high each reaches; what tokens say, summed over the parts
    of the field that their groups stand for; and the places of the groups that some heads look at.

    Args:
        dim: Width C of the tokens.
        side: Of the lattice.
        sums: Values summed over the field.
        looks: Heads that look for a place.
    """

    def __init__(self, dim: int, side: int, sums: int = 32, looks: int = 8) -> None:
        super().__init__()
        self.size = 4 * side + sums + 2 * looks
        self.sums, self.looks = nn.Linear(dim, sums), nn.Linear(dim, looks)

    def forward(self, points: Tensor, parts: Tensor, tokens: Tensor) -> Tensor:
        """Shape (B, size), of points (B, N, 3), their parts of the field (B, N) and tokens."""
        columns, rows = _lines(points)
        lattice = _squared(points)
        highest = [5 * lattice[..., 2].amax(dim=axis) for axis in (1, 2)]
        shares = _grouped(_squared(parts[..., None]), tokens.shape[1])[..., 0]
        shares = shares / shares.sum(dim=1, keepdim=True)
        places = _grouped(lattice[..., :2], tokens.shape[1])
        summed = (shares[..., None] * F.relu(self.sums(tokens))).sum(dim=1)
        seen = self.looks(tokens).softmax(dim=1).transpose(1, 2) @ places
        return torch.cat([2 * columns, 2 * rows, *highest, 4 * summed, 2 * seen.flatten(1)], dim=1)


def _grouped(lattice: Tensor, num_groups: int) -> Tensor:
    """Means over the groups of a lattice (B, n, n, K): shape (B, num_groups, K)."""
    edge = lattice.shape[1] // math.isqrt(num_groups)
    return F.avg_pool2d(lattice.permute(0, 3, 1, 2), edge).flatten(2).transpose(1, 2)


def bearing_curve(points: Tensor, samples: int, parts: Tensor | None = None) -> Tensor:
    """Heights (B, samples) in falling order, at ``bearing_ranks``.

    Args:
        points: Shape (B, N, 3).
        samples: How many.
        parts: Shape (B, N), what part of the field each point stands for, in any unit; they all
            stand for the same when not given.
    """
    heights, order = points[..., 2].sort(dim=1, descending=True)
    count = points.shape[1]
    ranks = bearing_ranks(samples, count).to(points.device)
    if parts is None:
        return heights[:, ranks]
    deepest = samples // 2
    passed = parts.gather(1, order).cumsum(dim=1)
    asked = ((ranks[deepest:] + 0.5) / count) * passed[:, -1:]
    rest = torch.searchsorted(passed, asked.contiguous()).clamp(max=count - 1)
    return torch.cat([heights[:, :deepest], heights.gather(1, rest)], dim=1)


def bearing_ranks(samples: int, count: int) -> Tensor:
    """Which of ``count`` heights in falling order make a bearing curve, shape (samples,)."""
    deepest = samples // 2
    rest = torch.linspace(0, 1, samples - deepest + 1)[1:].square()
    spread = deepest - 1 + (rest * (count - deepest)).round().long()
    return torch.cat([torch.arange(deepest), spread])


def cell_sizes(points: Tensor) -> Tensor:
    """What part of the field each point of a square lattice (B, N, 3) stands for, shape (B, N)."""
    along_x, along_y = _steps(points)
    return (along_y[:, :, None] * along_x[:, None, :]).flatten(1)


def _squared(points: Tensor) -> Tensor:
    """Points of a square lattice (B, N, K) as (B, n, n, K)."""
    side = math.isqrt(points.shape[1])
    return points.view(-1, side, side, points.shape[2])


def _lines(points: Tensor) -> tuple[Tensor, Tensor]:
    """Where the columns of a square lattice lie along x, and its rows along y: (B, n) each."""
    lattice = _squared(points)
    return lattice[..., 0].mean(dim=1), lattice[..., 1].mean(dim=2)


def _steps(points: Tensor) -> tuple[Tensor, Tensor]:
    """Distances between neighbouring columns, and rows, of a square lattice: (B, n) each."""
    columns, rows = _lines(points)
    steps = []
    for places in (columns, -rows):
        ends = F.pad((places[:, 2:] - places[:, :-2]) / 2, (1, 1))
        ends[:, 0] = places[:, 1] - places[:, 0]
        ends[:, -1] = places[:, -1] - places[:, -2]
        steps.append(ends.clamp_min(1e-4))
    return steps[0], steps[1]


class LatticeTokenizer(nn.Module):
    """Convolutions over a lattice of points down to 16 × 16 cells, and those to tokens.

    The points of a cell (2 × 2 of 32 × 32) become channels, which keeps all that they say at a
    quarter of the cost; pairs of convolutions mix cells; each 2 × 2 cells with those around become
    one of 64 tokens.

    Args:
        dim: Width of the tokens.
        stem_dim: Channels at 16 × 16.
        blocks: Pairs of convolutions there.
        num_groups: Tokens: 16, 64 or 256.
        sampling: How the points lie. Where they crowd, their places and distances are channels.
    """

    CELLS = 16

    def __init__(
        self,
        dim: int,
        stem_dim: int,
        blocks: int,
        num_groups: int = 64,
        sampling: Sampling = EVEN,
    ) -> None:
        super().__init__()
        self.crowded = sampling.pressed > 0
        self.in_cell = sampling.side // self.CELLS
        channels = self.in_cell**2 * (8 if self.crowded else 4)
        stride = self.CELLS // math.isqrt(num_groups)
        self.stem = nn.Conv2d(channels, stem_dim, 3, padding=1)
        self.mix = nn.Sequential(*(ConvBlock(stem_dim) for _ in range(blocks)))
        self.group = nn.Conv2d(stem_dim, dim, 3, stride=stride, padding=1)
        self.position = nn.Parameter(torch.randn(1, num_groups, dim) * 0.02)

    def forward(self, points: Tensor) -> Tensor:
        """Points (B, side², 3) to tokens (B, num_groups, C)."""
        channels = crowded_channels(points) if self.crowded else even_channels(points)
        cells = F.pixel_unshuffle(channels, self.in_cell)
        x = self.mix(self.stem(cells.contiguous(memory_format=torch.channels_last)))
        x = self.group(F.relu(x))
        return x.flatten(2).transpose(1, 2) + self.position


def even_channels(points: Tensor) -> Tensor:
    """Indentation, its fine relief, and the points' places inside their cells: (B, 4, n, n).

    Brought to a common size, since weights start out alike: 0.3 mm becomes 1, a relief of 0.03 mm
    becomes 1, half a cell becomes 1.
    """
    x, y, z, relief = _fields(points)
    side = x.shape[-1]
    steps = (torch.arange(side, device=points.device) + 0.5) / side - 0.5
    # The scaled field reaches ±1 in x and ± its aspect in y; the aspect is the slope of y over the
    # rows. What is left, in cells, says where in its cell a point lies.
    down = steps[:, None]
    aspect = -(y * down).sum(dim=(1, 2, 3), keepdim=True) / (2 * side * (steps**2).sum())
    dx = (x - 2 * steps) * side
    dy = (y + 2 * aspect * down) * side
    return torch.cat([5 * z, 50 * relief, dx, dy], dim=1)


def crowded_channels(points: Tensor) -> Tensor:
    """As ``even_channels``, with the place on the field and the distances of lattice lines.

    Shape (B, 8, n, n). Places inside cells are told by how far a point is from where its line lies
    on the whole; distances as the logarithm of how much smaller than even ones they are.
    """
    x, y, z, relief = _fields(points)
    side = x.shape[-1]
    along_x, along_y = (step.to(points.dtype) for step in _steps(points))
    dx = (x - x.mean(dim=2, keepdim=True)) / along_x[:, None, None, :]
    dy = (y - y.mean(dim=3, keepdim=True)) / along_y[:, None, :, None]
    near_x = (along_x * side / 2).log()[:, None, None, :].expand_as(x)
    near_y = (along_y * side / 2).log()[:, None, :, None].expand_as(x)
    return torch.cat([5 * z, 50 * relief, 2 * dx, 2 * dy, x, y, near_x, near_y], dim=1)


def _fields(points: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor]:
    """x, y, z and how z differs from its neighbours', of a square lattice: (B, 1, n, n) each."""
    x, y, z = _squared(points).permute(0, 3, 1, 2).split(1, dim=1)
    return x, y, z, z - F.avg_pool2d(z, 3, stride=1, padding=1, count_include_pad=False)


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
