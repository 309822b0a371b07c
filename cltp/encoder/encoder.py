"""The tactile encoder E_T: points of a cloud to tokens and one feature, in pure torch.

Source: PointBERT as ULIP-2 uses it (groups of points, a transformer over them and a class token,
feature = one matrix on the class token beside the maximum over groups).

Its variants differ in how they make tokens (``cltp.encoder.tokenizers``); ``VARIANTS`` lists them
with their presets, so that a further one needs a class there and an entry here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.class_token import (
    LARGEST,
    ClassTokenFeatures,
    HeightQuantiles,
    HeightTerms,
    curves_width,
    ordered_curves,
)
from cltp.encoder.tokenizers import (
    FpsTokenizer,
    GridTokenizer,
    LatticeTokenizer,
    PatchTokenizer,
    grid_maps,
)
from cltp.errors import TouchError
from cltp.tactile.point_layout import EVEN, GRID, PointLayout

Sizes = Mapping[str, int]
"""Sizes of an ``EncoderConfig`` that differ from its defaults."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EncoderVariant:
    """One way of making tokens.

    Attributes:
        build: Makes the tokenizer of a configuration, with random weights.
        presets: Named sizes.
        layout: How the points lie that it takes.
        groups: Number of groups that it makes; None for any.
        has_places: Whether its groups stand at fixed positions, which the class token can read
            directly (``cltp.encoder.class_token``).
        takes_images: Whether it takes pixels (B, 3, 64, 64) instead of points.
    """

    build: Callable[[EncoderConfig], nn.Module]
    presets: Mapping[str, Sizes]
    layout: PointLayout = EVEN
    groups: int | None = None
    has_places: bool = False
    takes_images: bool = False


_READING = {"bearing": 64, "projection": 256}
"""Height quantiles and a hidden layer before the feature."""

_GRID: Sizes = {**_READING, "num_groups": 63, "stem_dim": 32, "grades": 60}

VARIANTS: Mapping[str, EncoderVariant] = {
    # Ours: all heights in 75 × 100 cells, convolutions down to 7 × 9 groups.
    "grid": EncoderVariant(
        build=lambda c: GridTokenizer(
            c.dim, c.stem_dim, c.stem_blocks, sees_pressure=bool(c.pressure)
        ),
        presets={
            "grid": _GRID,
            "grid_pressure": {**_GRID, "pressure": 1},
            "grid_curves": {**_GRID, "curves": 224, "projection": 512},
            "tiny_grid": {
                **{"num_groups": 63, "dim": 48, "depth": 1, "heads": 2, "stem_dim": 4},
                **{"bearing": 16},
            },
        },
        layout=GRID,
        groups=GridTokenizer.GROUPS,
        has_places=True,
    ),
    # Ours, of the paper's 1024 points. They have one point in each of 32 × 32 cells, so that
    # neighbours are known without a search: convolutions over the lattice of points mix a point
    # with its neighbours, and each of 8 × 8 groups becomes a token. It learns the same contacts
    # many times faster than groups around farthest points (docs/pretraining.md, presets).
    "lattice": EncoderVariant(
        build=lambda c: LatticeTokenizer(c.dim, c.stem_dim, c.stem_blocks),
        presets={
            "tiny": {"dim": 48, "depth": 1, "heads": 2, "stem_dim": 8},
            "small": _READING,
            "small_graded": {**_READING, "grades": 60},
        },
        groups=LatticeTokenizer.GROUPS,
        has_places=True,
    ),
    # The reference. Group centres by farthest point sampling, their nearest points relative to the
    # centre, a small PointNet with a maximum over each group. "pointbert" is Point-BERT at 1024
    # points, "ulip2" as deep as ULIP-2, for CLIP ViT-bigG-14.
    "fps": EncoderVariant(
        build=lambda c: FpsTokenizer(c.dim, c.stem_dim, c.num_groups, c.group_size),
        presets={
            "small_pointbert": {},
            "pointbert": {"dim": 384, "depth": 12, "heads": 6, "stem_dim": 128},
            "ulip2": {"dim": 384, "depth": 18, "heads": 6, "stem_dim": 128, "feature_dim": 1280},
        },
    ),
    # Patches of a rendered frame, as a vision transformer has them, for the vision-based baselines
    # of the paper's appendix A.
    "image": EncoderVariant(
        build=lambda c: PatchTokenizer(c.dim),
        presets={"small_image": {}},
        groups=64,
        takes_images=True,
    ),
}
"""By the name of the tokenizer in an encoder's configuration."""


_SIZES = {
    "dim": (1, 2048),
    "depth": (0, 64),
    "heads": (1, 128),
    "num_groups": (1, 4096),
    "group_size": (1, 1024),
    "stem_dim": (1, 1024),
    "stem_blocks": (0, 16),
    "feature_dim": (1, 4096),
    "bearing": (0, 1024),
    "projection": (0, 4096),
    "grades": (0, 1024),
    "pressure": (0, 1),
    "curves": (0, 1024),
}
"""Smallest and largest size of any encoder; the largest published one is a third of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EncoderConfig:
    """Sizes of an encoder, under the names of its stored ``config.json``.

    Attributes:
        tokenizer: Out of ``VARIANTS``.
        dim: Width C of the tokens.
        depth: Number of transformer layers.
        heads: Number of attention heads; divides ``dim``.
        num_groups: Number of tokens beside the class token.
        group_size: Number of points in a group of ``fps``.
        stem_dim: Channels of the first convolution; width of the PointNet in ``fps``.
        stem_blocks: Pairs of convolutions over a lattice, or at either size of a grid.
        feature_dim: Width of the aligned feature, that of CLIP.
        bearing: Number of height quantiles beside the groups; 0 for none.
        projection: Hidden width between the pooled tokens and the aligned feature; 0 for one
            matrix, as in the paper.
        grades: Bins of the piecewise linear encoding of height quantiles; 0 for none.
        pressure: 1 for a grid whose stem sees the pressure under its heights too, 0 for all others.
        curves: Pressures of each map, in falling order, that stand beside the pooled tokens with
            the height quantiles; 0 for none of both.

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
    pressure: int = field(default=0, repr=False)
    curves: int = field(default=0, repr=False)

    def __post_init__(self) -> None:
        for name, (least, most) in _SIZES.items():
            size = getattr(self, name)
            if type(size) is not int or not least <= size <= most:
                raise TouchError(
                    f"{name} must be a whole number of {least} to {most}, got {size!r:.40}"
                )
        if self.tokenizer not in VARIANTS:
            raise TouchError(f"unknown tokenizer {self.tokenizer!r}; known: {', '.join(VARIANTS)}")
        if self.dim % self.heads:
            raise TouchError(f"dim {self.dim} must be a multiple of heads {self.heads}")
        groups = self.variant.groups
        if groups not in (None, self.num_groups):
            raise TouchError(f"{self.tokenizer} has {groups} groups, got {self.num_groups}")
        if self.grades and not self.bearing:
            raise TouchError(f"{self.grades} grades need height quantiles, got a bearing of 0")
        if self.bearing and not self.variant.has_places:
            raise TouchError(f"height quantiles are not for {self.tokenizer}")
        if self.pressure and not self.counts_cells:
            raise TouchError(f"{self.tokenizer} sees no pressure, only grids do")
        if self.curves and not (self.counts_cells and self.bearing and self.curves > LARGEST):
            raise TouchError(
                f"curves need a grid, height quantiles and more than {LARGEST} ranks, got "
                f"{self.curves}"
            )

    @property
    def variant(self) -> EncoderVariant:
        return VARIANTS[self.tokenizer]

    @property
    def counts_cells(self) -> bool:
        """Whether its points are cells of one size, whose edge ends ``Encoded.pooled``."""
        return self.variant.layout.pitch_mm is not None

    @property
    def pooled_dim(self) -> int:
        """Width of ``Encoded.pooled``."""
        beside = curves_width(self.bearing, self.grades, self.curves) if self.curves else 0
        return beside + 2 * self.dim

    @property
    def identity(self) -> str:
        """All sizes in one line; unchanged for encoders that are older than the last three."""
        last = {"grades": self.grades, "pressure": self.pressure, "curves": self.curves}
        return str(self) + "".join(f" {name} {size}" for name, size in last.items() if size)


PRESETS: dict[str, EncoderConfig] = {
    name: EncoderConfig(tokenizer=tokenizer, **sizes)
    for tokenizer, variant in VARIANTS.items()
    for name, sizes in variant.presets.items()
}


class Encoded(NamedTuple):
    """The encoding of a batch of clouds.

    Attributes:
        tokens: Shape (B, G + 1, C); the class token first.
        pooled: Shape (B, P): the class token and the maximum over the groups, plus the terms of
            the height quantiles where there are any; before them ``ordered_curves``, where the
            encoder has them. Of a grid the last entry is the logarithm of a cell's edge over
            ``UNIT_CELL_MM`` instead, by which heads turn cells into millimetres.
        feature: Shape (B, F): aligned with CLIP, not yet normalised; (B, 0) where it is not asked
            for.
    """

    tokens: Tensor
    pooled: Tensor
    feature: Tensor


class TactileEncoder(nn.Module):
    """E_T. The names of its parts are those of the stored weights.

    Args:
        config: Sizes.
    """

    def __init__(self, config: EncoderConfig) -> None:
        super().__init__()
        self.config = config
        dim = config.dim
        self.tokenizer = config.variant.build(config)
        self.cls = nn.Parameter(torch.randn(1, 1, dim) * 0.02)
        has_places = config.variant.has_places
        self.survey = ClassTokenFeatures(dim, config.num_groups) if has_places else None
        self.bearing = None
        if config.bearing:
            self.bearing = HeightQuantiles(
                dim, config.bearing, grades=config.grades, is_grid=config.counts_cells
            )
        self.blocks = nn.ModuleList(
            TransformerBlock(dim, config.heads) for _ in range(config.depth)
        )
        self.norm = nn.LayerNorm(dim)
        self.feature: nn.Module
        if config.projection:
            self.feature = nn.Sequential(
                nn.Linear(config.pooled_dim, config.projection),
                nn.GELU(),
                nn.Linear(config.projection, config.feature_dim, bias=False),
            )
        else:
            self.feature = nn.Linear(config.pooled_dim, config.feature_dim, bias=False)

    def forward(self, points: Tensor, *, aligned: bool = True) -> Encoded:
        """Encode scaled points, shape (B, N, 3), or pixels, where the variant takes images.

        Points have the variant's layout and the order of ``cltp.tactile.encoder_input``.

        Args:
            points: The points, or the pixels.
            aligned: Whether the feature is asked for; without, it has no width.
        """
        config, maps = self.config, None
        if config.counts_cells:
            maps = grid_maps(points, has_pressure=bool(config.pressure or config.curves))
        tokens = self.tokenizer(points if maps is None else maps)
        terms = None if self.bearing is None else self.bearing(points, maps)
        x = self.mixed(tokens, self.class_token(tokens, terms))
        pooled = torch.cat([x[:, 0], x[:, 1:].amax(dim=1)], dim=1)
        if terms is not None:
            pooled = pooled + terms.pooled
        if maps is not None:
            pooled = torch.cat([pooled[:, :-1], maps.log_edge], dim=1)
            if config.curves:
                curves = ordered_curves(points, maps, config.bearing, config.grades, config.curves)
                pooled = torch.cat([curves, pooled], dim=1)
        feature = self.feature(pooled) if aligned else pooled[:, :0]
        return Encoded(tokens=x, pooled=pooled, feature=feature)

    def class_token(self, tokens: Tensor, terms: HeightTerms | None) -> Tensor:
        """The class token, shape (B, 1, C), with everything that is read without attention.

        Args:
            tokens: Tokens of the groups, shape (B, G, C).
            terms: Terms of the height quantiles, where the encoder has them.
        """
        cls = self.cls.expand(len(tokens), -1, -1)
        if self.survey is not None:
            cls = cls + self.survey(tokens)
        return cls if terms is None else cls + terms.token

    def mixed(self, tokens: Tensor, cls: Tensor) -> Tensor:
        """All layers over the class token and any tokens (B, T, C): shape (B, T + 1, C)."""
        x = torch.cat([cls, tokens], dim=1)
        for block in self.blocks:
            x = block(x)
        normed: Tensor = self.norm(x)
        return normed


class TransformerBlock(nn.Module):
    """A pre-norm transformer layer over tokens (B, T, C)."""

    def __init__(self, dim: int, heads: int) -> None:
        super().__init__()
        self.heads = heads
        self.norm1, self.norm2 = nn.LayerNorm(dim), nn.LayerNorm(dim)
        self.qkv, self.out = nn.Linear(dim, 3 * dim), nn.Linear(dim, dim)
        self.up, self.down = nn.Linear(dim, 4 * dim), nn.Linear(4 * dim, dim)

    def forward(self, x: Tensor) -> Tensor:
        batch, length, dim = x.shape
        qkv = self.qkv(self.norm1(x)).view(batch, length, 3, self.heads, dim // self.heads)
        q, k, v = qkv.permute(2, 0, 3, 1, 4)
        mixed = F.scaled_dot_product_attention(q, k, v)
        x = x + self.out(mixed.transpose(1, 2).reshape(batch, length, dim))
        return x + self.down(F.gelu(self.up(self.norm2(x))))
