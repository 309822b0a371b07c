"""The tactile encoder E_T: points of a cloud to tokens and one feature, in pure torch.

Source: PointBERT as ULIP-2 uses it (groups of points, a transformer over them and a class token,
feature = one matrix on the class token beside the maximum over groups). Tokenizers:

``fps``: the reference. Group centres by farthest point sampling, their nearest points relative to
    the centre, a small PointNet with a maximum over each group.
``lattice``: ours. Our clouds have one point in each of 32 × 32 cells, so that neighbours are known
    without a search: convolutions over the lattice of points mix a point with its neighbours, and
    each of 8 × 8 groups becomes a token. It learns the same contacts many times faster (README).
``pressed``: as ``lattice``, of 1024 points that crowd where the gel is pressed
    (``cltp.tactile.point_layout``); ``fine``: of 4096 points, evenly. Both are tried beside the
    paper's uniform sampling: clouds of sensors have 1024 points, evenly.
``image``: patches of a rendered frame, as a vision transformer has them, for the vision-based
    baselines of the paper's appendix A. Such an encoder takes pixels (B, 3, 64, 64) for points.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.tokenizers import (
    Bearing,
    BearingCurve,
    FpsTokenizer,
    LatticeTokenizer,
    PatchTokenizer,
    Survey,
)
from cltp.errors import TouchError
from cltp.tactile.point_layout import EVEN, FINE, PRESSED, Sampling

SAMPLINGS: dict[str, Sampling] = {
    "lattice": EVEN,
    "pressed": PRESSED,
    "fine": FINE,
    "fps": EVEN,
    "image": EVEN,
}
"""By tokenizer: how the points lie that it takes."""

LATTICES = ("lattice", "pressed", "fine")
"""Tokenizers that convolve over neighbours."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EncoderConfig:
    """Sizes of an encoder.

    Attributes:
        tokenizer: Out of ``SAMPLINGS``.
        dim: Width C of the tokens.
        depth: Transformer layers.
        heads: Attention heads; divides ``dim``.
        num_groups: Tokens beside the class token; 16, 64 or 256 of a lattice, 64 of an image.
        group_size: Points in a group of ``fps``.
        stem_dim: Channels of a lattice before its groups; width of the PointNet in ``fps``.
        stem_blocks: Pairs of convolutions over a lattice.
        feature_dim: Width of the aligned feature, that of CLIP.
        bearing: Heights along the bearing curve beside a lattice; 0 for none.
        projection: Hidden width of the way from pooled tokens to the aligned feature; 0 for one
            matrix, as in the paper.
        grades: Steps of height that the bearing curve is also told in; 0 for none.

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
    bearing: int = 0
    projection: int = 0
    grades: int = field(default=0, repr=False)  # see ``identity``

    def __post_init__(self) -> None:
        if self.tokenizer not in SAMPLINGS:
            raise TouchError(f"unknown tokenizer {self.tokenizer!r}; known: {', '.join(SAMPLINGS)}")
        if self.dim % self.heads:
            raise TouchError(f"dim {self.dim} must be a multiple of heads {self.heads}")
        known = {"image": (64,), "fps": (self.num_groups,)}.get(self.tokenizer, (16, 64, 256))
        if self.num_groups not in known:
            several = ", ".join(map(str, known))
            raise TouchError(f"{self.tokenizer} has {several} groups, got {self.num_groups}")
        if min(self.bearing, self.projection, self.grades) < 0:
            sizes = f"{self.bearing}, {self.projection} and {self.grades}"
            raise TouchError(f"bearing, projection and grades are 0 or more, got {sizes}")
        if self.grades and not self.bearing:
            raise TouchError(f"{self.grades} grades are for a bearing curve, and there is none")
        if self.bearing and self.tokenizer not in LATTICES:
            raise TouchError(f"a bearing curve is for a lattice, not for {self.tokenizer}")

    @property
    def sampling(self) -> Sampling:
        """How the points lie that the encoder takes."""
        return SAMPLINGS[self.tokenizer]

    @property
    def identity(self) -> str:
        """What tells it from others, in words that stay the same for those from before grades."""
        return f"{self} grades {self.grades}" if self.grades else str(self)


PRESETS: dict[str, EncoderConfig] = {
    "tiny": EncoderConfig(dim=48, depth=1, heads=2, stem_dim=8),
    "small": EncoderConfig(bearing=64, projection=256),
    "small_plain": EncoderConfig(),
    "small_graded": EncoderConfig(bearing=64, projection=256, grades=60),
    "small_pressed": EncoderConfig(tokenizer="pressed", bearing=64, projection=256),
    "small_pressed_graded": EncoderConfig(
        tokenizer="pressed", bearing=64, projection=256, grades=60
    ),
    "small_fine": EncoderConfig(tokenizer="fine", bearing=64, projection=256),
    "small_16": EncoderConfig(num_groups=16, bearing=64, projection=256),
    "small_256": EncoderConfig(num_groups=256, bearing=64, projection=256),
    "small_pointbert": EncoderConfig(tokenizer="fps"),
    "small_image": EncoderConfig(tokenizer="image"),
    "pointbert": EncoderConfig(tokenizer="fps", dim=384, depth=12, heads=6, stem_dim=128),
    "ulip2": EncoderConfig(
        tokenizer="fps", dim=384, depth=18, heads=6, stem_dim=128, feature_dim=1280
    ),
}
"""``small_plain``: ``small`` without bearing curve and projection. ``small_graded``: heights of
that curve told in steps too. ``small_pressed``: of points that crowd in the contact,
``small_fine``: of more points; ``small_16``, ``small_256``: of fewer and more groups.
``small_pointbert``, ``small_image``: the reference and a vision transformer of that size.
``pointbert``: Point-BERT at 1024 points; ``ulip2``: as deep as ULIP-2, for CLIP ViT-bigG-14.
"""


DEFAULT_PRESETS = {
    "cltp": "small_graded",
    "cltp_no_image": "small_graded",
    "point_mae": "small",
    "point_bert": "small",
    "tvl": "small_image",
    "unitouch": "small_image",
    "random": "small",
}
"""By method of pre-training. ``small`` for other encoders of points, and CLTP is tried with it too,
so that objectives are compared and not tokens; a step of ``small_pointbert`` takes eight times as
long on a CPU."""


class Encoded(NamedTuple):
    """What an encoder makes of a batch of clouds.

    Attributes:
        tokens: Shape (B, G + 1, C); the class token first.
        pooled: Shape (B, 2 C): the class token and the maximum over the groups, plus what the
            bearing curve adds where there is one.
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
        is_lattice = config.tokenizer in LATTICES
        if is_lattice:
            self.tokenizer = LatticeTokenizer(
                dim, config.stem_dim, config.stem_blocks, config.num_groups, config.sampling
            )
        elif config.tokenizer == "image":
            self.tokenizer = PatchTokenizer(dim)
        else:
            self.tokenizer = FpsTokenizer(
                dim, config.stem_dim, config.num_groups, config.group_size
            )
        self.cls = nn.Parameter(torch.randn(1, 1, dim) * 0.02)
        self.survey = Survey(dim, config.num_groups) if is_lattice else None
        self.bearing = None
        if config.bearing:
            self.bearing = BearingCurve(
                dim, config.bearing, grades=config.grades, sampling=config.sampling
            )
        self.blocks = nn.ModuleList(
            TransformerBlock(dim, config.heads) for _ in range(config.depth)
        )
        self.norm = nn.LayerNorm(dim)
        self.feature = _projection(2 * dim, config)

    def forward(self, points: Tensor) -> Encoded:
        """Encode scaled points, shape (B, N, 3).

        A lattice needs the order of ``cltp.tactile.encoder_input``.
        """
        tokens = self.tokenizer(points)
        bearing = None if self.bearing is None else self.bearing(points, tokens)
        x = self.mixed(tokens, self.class_token(tokens, bearing))
        pooled = torch.cat([x[:, 0], x[:, 1:].amax(dim=1)], dim=1)
        if bearing is not None:
            pooled = pooled + bearing.pooled
        return Encoded(tokens=x, pooled=pooled, feature=self.feature(pooled))

    def class_token(self, tokens: Tensor, bearing: Bearing | None) -> Tensor:
        """The class token, shape (B, 1, C), with what can be read without attention.

        Args:
            tokens: Of the groups, shape (B, G, C).
            bearing: Of the points' bearing curve, where the encoder has one.
        """
        cls = self.cls.expand(len(tokens), -1, -1)
        if self.survey is not None:
            cls = cls + self.survey(tokens)
        return cls if bearing is None else cls + bearing.token

    def mixed(self, tokens: Tensor, cls: Tensor) -> Tensor:
        """All layers over the class token and any tokens (B, T, C): shape (B, T + 1, C)."""
        x = torch.cat([cls, tokens], dim=1)
        for block in self.blocks:
            x = block(x)
        found: Tensor = self.norm(x)
        return found


def _projection(pooled_dim: int, config: EncoderConfig) -> nn.Module:
    if config.projection == 0:
        return nn.Linear(pooled_dim, config.feature_dim, bias=False)
    return nn.Sequential(
        nn.Linear(pooled_dim, config.projection),
        nn.GELU(),
        nn.Linear(config.projection, config.feature_dim, bias=False),
    )


class TransformerBlock(nn.Module):
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
