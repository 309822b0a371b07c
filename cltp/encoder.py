"""The tactile encoder E_T: points of a cloud to tokens and one feature, in pure torch.

Source: PointBERT as ULIP-2 uses it (groups of points, a transformer over them and a class token,
feature = one matrix on the class token beside the maximum over groups). Two tokenizers:

``fps``: the reference. Group centres by farthest point sampling, their nearest points relative to
    the centre, a small PointNet with a maximum over each group.
``lattice``: ours. Our clouds have one point in each of 32 × 32 cells, so that neighbours are known
    without a search: convolutions over the lattice of points mix a point with its neighbours, and
    each of 8 × 8 groups becomes a token. It learns the same contacts many times faster (README).
``image``: patches of a rendered frame, as a vision transformer has them, for the vision-based
    baselines of the paper's appendix A. Such an encoder takes pixels (B, 3, 64, 64) for points.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.errors import TouchError
from cltp.inputs import LATTICE

TOKENIZERS = ("lattice", "fps", "image")


@dataclass(frozen=True, slots=True, kw_only=True)
class EncoderConfig:
    """Sizes of an encoder.

    Attributes:
        tokenizer: Out of ``TOKENIZERS``.
        dim: Width C of the tokens.
        depth: Transformer layers.
        heads: Attention heads; divides ``dim``.
        num_groups: Tokens beside the class token; 64 for ``lattice`` and ``image``.
        group_size: Points in a group of ``fps``.
        stem_dim: Channels of ``lattice`` before its groups; width of the PointNet in ``fps``.
        stem_blocks: Pairs of convolutions in ``lattice``.
        feature_dim: Width of the aligned feature, that of CLIP.

    Raises:
        TouchError: The sizes don't fit together.
    """

    tokenizer: str = "lattice"
    dim: int = 128
    depth: int = 2
    heads: int = 4
    num_groups: int = 64
    group_size: int = 32
    stem_dim: int = 64
    stem_blocks: int = 1
    feature_dim: int = 128

    def __post_init__(self) -> None:
        if self.tokenizer not in TOKENIZERS:
            raise TouchError(
                f"unknown tokenizer {self.tokenizer!r}; known: {', '.join(TOKENIZERS)}"
            )
        if self.dim % self.heads:
            raise TouchError(f"dim {self.dim} must be a multiple of heads {self.heads}")
        if self.tokenizer != "fps" and self.num_groups != 64:
            raise TouchError(f"{self.tokenizer} has 64 groups, got {self.num_groups}")


PRESETS: dict[str, EncoderConfig] = {
    "tiny": EncoderConfig(dim=48, depth=1, heads=2, stem_dim=8),
    "small": EncoderConfig(),
    "small_pointbert": EncoderConfig(tokenizer="fps"),
    "small_image": EncoderConfig(tokenizer="image"),
    "pointbert": EncoderConfig(tokenizer="fps", dim=384, depth=12, heads=6, stem_dim=128),
    "ulip2": EncoderConfig(
        tokenizer="fps", dim=384, depth=18, heads=6, stem_dim=128, feature_dim=1280
    ),
}
"""``small_pointbert``, ``small_image``: the reference and a vision transformer at the size of
``small``. ``pointbert``: Point-BERT at 1024 points; ``ulip2``: as deep as ULIP-2, for CLIP
ViT-bigG-14."""


class Encoded(NamedTuple):
    """What an encoder makes of a batch of clouds.

    Attributes:
        tokens: Shape (B, G + 1, C); the class token first.
        pooled: Shape (B, 2 C): the class token and the maximum over the groups.
        feature: Shape (B, F): aligned with CLIP, not yet normalised.
    """

    tokens: Tensor
    pooled: Tensor
    feature: Tensor


class TactileEncoder(nn.Module):
    """E_T.

    Args:
        config: Sizes.
    """

    def __init__(self, config: EncoderConfig) -> None:
        super().__init__()
        self.config = config
        dim = config.dim
        self.tokenizer: nn.Module
        if config.tokenizer == "lattice":
            self.tokenizer = LatticeTokenizer(dim, config.stem_dim, config.stem_blocks)
        elif config.tokenizer == "image":
            self.tokenizer = PatchTokenizer(dim)
        else:
            self.tokenizer = FpsTokenizer(
                dim, config.stem_dim, config.num_groups, config.group_size
            )
        self.cls = nn.Parameter(torch.randn(1, 1, dim) * 0.02)
        self.survey = Survey(dim, config.num_groups) if config.tokenizer == "lattice" else None
        self.blocks = nn.ModuleList(Block(dim, config.heads) for _ in range(config.depth))
        self.norm = nn.LayerNorm(dim)
        self.feature = nn.Linear(2 * dim, config.feature_dim, bias=False)

    def forward(self, points: Tensor) -> Encoded:
        """Encode scaled points, shape (B, N, 3); ``lattice`` needs the order of ``cltp.inputs``."""
        tokens = self.tokenizer(points)
        x = self.mixed(tokens, self.class_token(tokens))
        pooled = torch.cat([x[:, 0], x[:, 1:].amax(dim=1)], dim=1)
        return Encoded(tokens=x, pooled=pooled, feature=self.feature(pooled))

    def class_token(self, tokens: Tensor) -> Tensor:
        """The class token, shape (B, 1, C), before it has seen anything but a survey."""
        cls = self.cls.expand(len(tokens), -1, -1)
        return cls if self.survey is None else cls + self.survey(tokens)

    def mixed(self, tokens: Tensor, cls: Tensor) -> Tensor:
        """All layers over the class token and any tokens (B, T, C): shape (B, T + 1, C)."""
        x = torch.cat([cls, tokens], dim=1)
        for block in self.blocks:
            x = block(x)
        found: Tensor = self.norm(x)
        return found


class Block(nn.Module):
    """A pre-norm transformer layer."""

    def __init__(self, dim: int, heads: int) -> None:
        super().__init__()
        self.heads = heads
        self.norm1, self.norm2 = nn.LayerNorm(dim), nn.LayerNorm(dim)
        self.qkv, self.out = nn.Linear(dim, 3 * dim), nn.Linear(dim, dim)
        self.up, self.down = nn.Linear(dim, 4 * dim), nn.Linear(4 * dim, dim)

    def forward(self, x: Tensor) -> Tensor:
        """Tokens (B, T, C) to tokens."""
        batch, length, dim = x.shape
        qkv = self.qkv(self.norm1(x)).view(batch, length, 3, self.heads, dim // self.heads)
        q, k, v = qkv.permute(2, 0, 3, 1, 4)
        mixed = F.scaled_dot_product_attention(q, k, v)
        x = x + self.out(mixed.transpose(1, 2).reshape(batch, length, dim))
        return x + self.down(F.gelu(self.up(self.norm2(x))))


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
