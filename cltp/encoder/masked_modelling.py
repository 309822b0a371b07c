"""Masked pre-training of an encoder on clouds alone: Point-MAE and Point-BERT, as baselines.

Our own code after the papers' descriptions; each difference is named where it occurs. Both hide
patches of a cloud from the encoder. Point-MAE reconstructs the hidden points from the visible ones;
Point-BERT predicts which word of a vocabulary of local shapes was hidden. A discrete variational
autoencoder learns that vocabulary first.

Source: Pang et al., 'Masked Autoencoders for Point Cloud Self-supervised Learning', 2022; Yu et
al., 'Point-BERT: Pre-training 3D Point Cloud Transformers with Masked Point Modeling', 2022.
"""

from __future__ import annotations

from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.encoder import EncoderConfig, TactileEncoder, TransformerBlock
from cltp.encoder.tokenizers import FpsTokenizer
from cltp.errors import TouchError
from cltp.tactile.point_layout import LATTICE

MAE_MASKED = 0.6
"""Fraction of hidden patches. Source: Point-MAE, section 3.1 and its ablation."""

BERT_MASKED = (0.25, 0.45)
"""Least and largest fraction of hidden patches. Source: Point-BERT, section 4."""

_CELL = 4  # points along the edge of a patch of the lattice


class Patches(NamedTuple):
    """A cloud in patches.

    Attributes:
        groups: Shape (B, G, n, 3), points around the centres, in a common size.
        centres: Shape (B, G, 3), scaled.
    """

    groups: Tensor
    centres: Tensor


def patches(encoder: TactileEncoder, points: Tensor) -> Patches:
    """The patches behind an encoder's tokens: its groups, or 4 × 4 cells of the lattice.

    Raises:
        TouchError: The encoder takes images, or its tokens are none of these.
    """
    tokenizer = encoder.tokenizer
    if isinstance(tokenizer, FpsTokenizer):
        return Patches(*tokenizer.groups(points))
    if encoder.config.tokenizer != "lattice":
        raise TouchError(
            "masked pre-training is for groups of points, a lattice's or fps', not for "
            f"{encoder.config.tokenizer}"
        )
    side = LATTICE // _CELL
    grid = points.view(-1, side, _CELL, side, _CELL, 3).transpose(2, 3)
    cells = grid.reshape(len(points), side * side, _CELL * _CELL, 3)
    centres = cells.mean(dim=2)
    return Patches((cells - centres[:, :, None]) * FpsTokenizer.GAIN, centres)


def patch_size(config: EncoderConfig) -> int:
    """Number of points in each of an encoder's ``patches``."""
    return _CELL * _CELL if config.variant.has_places else config.group_size


def visible_tokens(
    encoder: TactileEncoder, points: Tensor, cloud: Patches, hidden: Tensor
) -> tuple[Tensor, Tensor]:
    """Tokens (B, G, C) without information on hidden patches, whose own are zero, and cls.

    Groups around farthest points are embedded one by one. Convolutions over the lattice look
    beyond a patch, so that there the hidden heights are flattened before.

    Args:
        encoder: E_T.
        points: Shape (B, 1024, 3).
        cloud: Their patches.
        hidden: Shape (B, G), bool.
    """
    tokenizer = encoder.tokenizer
    if isinstance(tokenizer, FpsTokenizer):
        tokens = tokenizer.embedded(*cloud)
    else:
        side = LATTICE // _CELL
        whole = hidden.view(-1, side, 1, side, 1).expand(-1, side, _CELL, side, _CELL)
        flat = torch.tensor([1.0, 1.0, 0.0], device=points.device)
        points = torch.where(whole.reshape(len(points), -1, 1), points * flat, points)
        tokens = tokenizer(points)
    tokens = tokens * ~hidden[..., None]
    terms = None if encoder.bearing is None else encoder.bearing(points)
    return tokens, encoder.class_token(tokens, terms)


def hide(count: int, num_groups: int, batch: int, rng: torch.Generator) -> Tensor:
    """Exactly ``count`` hidden patches in each row, shape (batch, num_groups), bool."""
    return torch.rand(batch, num_groups, generator=rng).argsort(dim=1) < count


def chamfer(one: Tensor, other: Tensor) -> Tensor:
    """Mean squared distance to the nearest point of the other set, both ways.

    Source: the l2 Chamfer distance of Point-MAE, equation 5.

    Args:
        one: Shape (..., n, 3).
        other: Shape (..., m, 3).
    """
    distances = (one[..., :, None, :] - other[..., None, :, :]).square().sum(-1)
    return distances.amin(-1).mean() + distances.amin(-2).mean()


def _position_embedding(dim: int) -> nn.Sequential:
    return nn.Sequential(nn.Linear(3, 128), nn.GELU(), nn.Linear(128, dim))


class PointMae(nn.Module):
    """Point-MAE around an encoder: visible tokens in, hidden points out.

    Ours: the class token goes through the decoder too, so that it learns its later use.

    Args:
        encoder: E_T.
        group_size: Number of points in a patch.
        layers: Number of the decoder's layers; 4 in the paper, whose encoder has 12.
    """

    def __init__(self, encoder: TactileEncoder, group_size: int, layers: int = 1) -> None:
        super().__init__()
        dim = encoder.config.dim
        self.encoder = encoder
        self.mask_token = nn.Parameter(torch.randn(1, 1, dim) * 0.02)
        self.position = _position_embedding(dim)
        self.decoder = nn.ModuleList(
            TransformerBlock(dim, encoder.config.heads) for _ in range(layers)
        )
        self.norm = nn.LayerNorm(dim)
        self.points = nn.Linear(dim, 3 * group_size)

    def losses(self, points: Tensor, rng: torch.Generator) -> dict[str, Tensor]:
        """Chamfer distance between hidden points and their reconstruction."""
        cloud = patches(self.encoder, points)
        batch, num_groups = cloud.centres.shape[:2]
        count = round(MAE_MASKED * num_groups)
        hidden = hide(count, num_groups, batch, rng).to(points.device)
        tokens, cls = visible_tokens(self.encoder, points, cloud, hidden)
        encoded = self.encoder.mixed(tokens[~hidden].view(batch, num_groups - count, -1), cls)
        positions = self.position(cloud.centres * 2.0)
        width = encoded.shape[-1]
        visible = encoded[:, 1:] + positions[~hidden].view(batch, -1, width)
        masked = self.mask_token + positions[hidden].view(batch, count, width)
        x = torch.cat([encoded[:, :1], visible, masked], dim=1)
        for block in self.decoder:
            x = block(x)
        drawn = self.points(self.norm(x[:, -count:])).view(batch, count, -1, 3)
        return {"chamfer": chamfer(drawn, cloud.groups[hidden].view(batch, count, -1, 3))}


class ShapeWords(nn.Module):
    """The discrete variational autoencoder of Point-BERT: patches to words of a vocabulary.

    A small PointNet embeds each patch, a layer mixes patches, and each patch chooses one of the
    words by a Gumbel softmax; the points are reconstructed from the words' codes. A transformer
    layer replaces the paper's dynamic graph network and a dense layer its folded grid; the
    vocabulary is smaller than its 8192 because clouds of gel are far less varied than ShapeNet.

    Args:
        dim: Width.
        group_size: Number of points in a patch.
        vocabulary: Number of words.
    """

    KL_WEIGHT = 0.1
    """Weight of the divergence from equal use of all words. Source: Point-BERT, its annealed
    maximum."""

    def __init__(self, dim: int, group_size: int, vocabulary: int = 512) -> None:
        super().__init__()
        self.local = FpsTokenizer(dim, dim // 2, 64, group_size)
        self.before, self.after = TransformerBlock(dim, 4), TransformerBlock(dim, 4)
        self.scores = nn.Linear(dim, vocabulary)
        self.codes = nn.Parameter(torch.randn(vocabulary, dim) * 0.02)
        self.position = _position_embedding(dim)
        self.points = nn.Sequential(nn.Linear(dim, dim), nn.GELU(), nn.Linear(dim, 3 * group_size))

    def logits(self, cloud: Patches) -> Tensor:
        """Scores of the words for each patch, shape (B, G, vocabulary)."""
        scores: Tensor = self.scores(self.before(self.local.embedded(*cloud)))
        return scores

    def losses(self, cloud: Patches, temperature: float, rng: torch.Generator) -> dict[str, Tensor]:
        """Error of the reconstruction, and divergence of the words' use from an equal one."""
        scores = self.logits(cloud)
        noise = torch.empty(scores.shape).exponential_(generator=rng).to(scores.device)
        soft = F.softmax((scores - noise.clamp_min(1e-20).log()) / temperature, dim=-1)
        codes = self.after(soft @ self.codes + self.position(cloud.centres * 2.0))
        drawn = self.points(codes).view(*cloud.groups.shape)
        used = F.softmax(scores, dim=-1).mean(dim=(0, 1))
        spread = (used * (used * len(used)).clamp_min(1e-9).log()).sum()
        return {"chamfer": chamfer(drawn, cloud.groups), "spread": self.KL_WEIGHT * spread}


class PointBert(nn.Module):
    """Point-BERT around an encoder: which words stand at the hidden patches.

    Its further term, a contrast with a momentum encoder for the class token, is left out.

    Args:
        encoder: E_T.
        words: The trained vocabulary; frozen from now on.
    """

    def __init__(self, encoder: TactileEncoder, words: ShapeWords) -> None:
        super().__init__()
        dim = encoder.config.dim
        self.encoder = encoder
        self.words = words.eval().requires_grad_(False)
        self.mask_token = nn.Parameter(torch.randn(1, 1, dim) * 0.02)
        self.position = _position_embedding(dim)
        self.scores = nn.Linear(dim, len(words.codes))

    def losses(self, points: Tensor, rng: torch.Generator) -> dict[str, Tensor]:
        """Cross-entropy of the words at hidden patches, and the fraction predicted correctly."""
        cloud = patches(self.encoder, points)
        batch, num_groups = cloud.centres.shape[:2]
        low, high = BERT_MASKED
        fraction = low + (high - low) * float(torch.rand(1, generator=rng))
        hidden = hide(round(fraction * num_groups), num_groups, batch, rng).to(points.device)
        with torch.no_grad():
            labels = self.words.logits(cloud).argmax(-1)[hidden]
        tokens, cls = visible_tokens(self.encoder, points, cloud, hidden)
        masked = self.mask_token + self.position(cloud.centres * 2.0)
        tokens = torch.where(hidden[..., None], masked, tokens)
        scores = self.scores(self.encoder.mixed(tokens, cls)[:, 1:][hidden])
        right = (scores.argmax(-1) == labels).float().mean()
        return {"words": F.cross_entropy(scores, labels), "right": right.detach()}
