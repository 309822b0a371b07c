"""Masked pre-training of an encoder on clouds alone: Point-MAE and Point-BERT, as baselines.

Our own code after the papers' descriptions; what differs is said where it differs. Both hide
patches of a cloud from the encoder. Point-MAE draws the hidden points again from the visible ones;
Point-BERT says which of a vocabulary of local shapes was hidden, a vocabulary that a discrete
variational autoencoder has learned first.

Source: Pang et al., 'Masked Autoencoders for Point Cloud Self-supervised Learning', 2022; Yu et
al., 'Point-BERT: Pre-training 3D Point Cloud Transformers with Masked Point Modeling', 2022.
"""

from __future__ import annotations

from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.encoder import TactileEncoder, TransformerBlock
from cltp.encoder.tokenizers import FpsTokenizer
from cltp.errors import TouchError
from cltp.tactile.encoder_input import LATTICE

MAE_MASKED = 0.6
"""Share of hidden patches. Source: Point-MAE, section 3.1 and its ablation."""

BERT_MASKED = (0.25, 0.45)
"""Least and largest share of hidden patches. Source: Point-BERT, section 4."""

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
    config = encoder.config
    if config.tokenizer != "lattice" or config.num_groups != (LATTICE // _CELL) ** 2:
        raise TouchError(
            "masked pre-training is for a lattice of 64 groups or for fps, not for "
            f"{config.num_groups} groups of {config.tokenizer}"
        )
    side = LATTICE // _CELL
    grid = points.view(-1, side, _CELL, side, _CELL, 3).transpose(2, 3)
    cells = grid.reshape(len(points), side * side, _CELL * _CELL, 3)
    centres = cells.mean(dim=2)
    return Patches((cells - centres[:, :, None]) * FpsTokenizer.GAIN, centres)


def visible_tokens(
    encoder: TactileEncoder, points: Tensor, seen: Patches, hidden: Tensor
) -> tuple[Tensor, Tensor]:
    """Tokens (B, G, C) that know nothing of hidden patches (those of these are zero), and cls.

    Groups around farthest points are embedded one by one. Convolutions over the lattice look
    beyond a patch, so that there the hidden heights are flattened before.

    Args:
        encoder: E_T.
        points: Shape (B, 1024, 3).
        seen: Their patches.
        hidden: Shape (B, G), bool.
    """
    tokenizer = encoder.tokenizer
    if isinstance(tokenizer, FpsTokenizer):
        tokens = tokenizer.embedded(*seen)
    else:
        side = LATTICE // _CELL
        whole = hidden.view(-1, side, 1, side, 1).expand(-1, side, _CELL, side, _CELL)
        flat = torch.tensor([1.0, 1.0, 0.0], device=points.device)
        points = torch.where(whole.reshape(len(points), -1, 1), points * flat, points)
        tokens = tokenizer(points)
    tokens = tokens * ~hidden[..., None]
    bearing = None if encoder.bearing is None else encoder.bearing(points, tokens)
    return tokens, encoder.class_token(tokens, bearing)


def hide(count: int, num_groups: int, batch: int, rng: torch.Generator) -> Tensor:
    """Exactly ``count`` hidden patches in each row, shape (batch, num_groups), bool."""
    order = torch.rand(batch, num_groups, generator=rng).argsort(dim=1)
    return order < count


def chamfer(one: Tensor, other: Tensor) -> Tensor:
    """Mean squared distance to the nearest point of the other set, both ways.

    Source: the l2 Chamfer distance of Point-MAE, equation 5.

    Args:
        one: Shape (..., n, 3).
        other: Shape (..., m, 3).
    """
    apart = (one[..., :, None, :] - other[..., None, :, :]).square().sum(-1)
    return apart.amin(-1).mean() + apart.amin(-2).mean()


def _place(dim: int) -> nn.Sequential:
    return nn.Sequential(nn.Linear(3, 128), nn.GELU(), nn.Linear(128, dim))


class PointMae(nn.Module):
    """Point-MAE around an encoder: visible tokens in, hidden points out.

    Ours: the class token goes through the decoder too, so that it learns what it is used for later.

    Args:
        encoder: E_T.
        group_size: Points of a patch.
        layers: Of the decoder; 4 in the paper, whose encoder has 12.
    """

    def __init__(self, encoder: TactileEncoder, group_size: int, layers: int = 1) -> None:
        super().__init__()
        dim = encoder.config.dim
        self.encoder = encoder
        self.missing = nn.Parameter(torch.randn(1, 1, dim) * 0.02)
        self.place = _place(dim)
        self.decoder = nn.ModuleList(
            TransformerBlock(dim, encoder.config.heads) for _ in range(layers)
        )
        self.norm = nn.LayerNorm(dim)
        self.points = nn.Linear(dim, 3 * group_size)

    def losses(self, points: Tensor, rng: torch.Generator) -> dict[str, Tensor]:
        """Chamfer distance between hidden points and those drawn for them."""
        seen = patches(self.encoder, points)
        batch, num_groups = seen.centres.shape[:2]
        count = round(MAE_MASKED * num_groups)
        hidden = hide(count, num_groups, batch, rng).to(points.device)
        tokens, cls = visible_tokens(self.encoder, points, seen, hidden)
        shown = self.encoder.mixed(tokens[~hidden].view(batch, num_groups - count, -1), cls)
        places = self.place(seen.centres * 2.0)
        width = shown.shape[-1]
        visible = shown[:, 1:] + places[~hidden].view(batch, -1, width)
        asked = self.missing + places[hidden].view(batch, count, width)
        x = torch.cat([shown[:, :1], visible, asked], dim=1)
        for block in self.decoder:
            x = block(x)
        drawn = self.points(self.norm(x[:, -count:])).view(batch, count, -1, 3)
        return {"chamfer": chamfer(drawn, seen.groups[hidden].view(batch, count, -1, 3))}


class ShapeWords(nn.Module):
    """The discrete variational autoencoder of Point-BERT: patches to words of a vocabulary.

    A small PointNet embeds each patch, a layer mixes patches, and each chooses one of the words by
    a Gumbel softmax; from the words' codes the points are drawn again. Where the paper mixes by a
    dynamic graph network we have a transformer layer, and where it folds a grid, a dense layer; the
    vocabulary is smaller than its 8192 because clouds of gel are far less varied than ShapeNet.

    Args:
        dim: Width.
        group_size: Points of a patch.
        vocabulary: How many words.
    """

    KL_WEIGHT = 0.1
    """Of the divergence from equal use of all words. Source: Point-BERT, its annealed maximum."""

    def __init__(self, dim: int, group_size: int, vocabulary: int = 512) -> None:
        super().__init__()
        self.local = FpsTokenizer(dim, dim // 2, 64, group_size)
        self.before, self.after = TransformerBlock(dim, 4), TransformerBlock(dim, 4)
        self.say = nn.Linear(dim, vocabulary)
        self.codes = nn.Parameter(torch.randn(vocabulary, dim) * 0.02)
        self.place = _place(dim)
        self.points = nn.Sequential(nn.Linear(dim, dim), nn.GELU(), nn.Linear(dim, 3 * group_size))

    def logits(self, seen: Patches) -> Tensor:
        """Scores of the words for each patch, shape (B, G, vocabulary)."""
        found: Tensor = self.say(self.before(self.local.embedded(*seen)))
        return found

    def losses(self, seen: Patches, temperature: float, rng: torch.Generator) -> dict[str, Tensor]:
        """Reconstruction, and the divergence of the words' use from an equal one."""
        scores = self.logits(seen)
        noise = torch.empty(scores.shape).exponential_(generator=rng).to(scores.device)
        soft = F.softmax((scores - noise.clamp_min(1e-20).log()) / temperature, dim=-1)
        codes = self.after(soft @ self.codes + self.place(seen.centres * 2.0))
        drawn = self.points(codes).view(*seen.groups.shape)
        used = F.softmax(scores, dim=-1).mean(dim=(0, 1))
        spread = (used * (used * len(used)).clamp_min(1e-9).log()).sum()
        return {"chamfer": chamfer(drawn, seen.groups), "spread": self.KL_WEIGHT * spread}


class PointBert(nn.Module):
    """Point-BERT around an encoder: which words stand at the hidden patches.

    Its further term, a contrast with a momentum encoder for the class token, is left out.

    Args:
        encoder: E_T.
        words: Trained, and frozen from now on.
    """

    def __init__(self, encoder: TactileEncoder, words: ShapeWords) -> None:
        super().__init__()
        dim = encoder.config.dim
        self.encoder = encoder
        self.words = words.eval().requires_grad_(False)
        self.missing = nn.Parameter(torch.randn(1, 1, dim) * 0.02)
        self.place = _place(dim)
        self.guess = nn.Linear(dim, len(words.codes))

    def losses(self, points: Tensor, rng: torch.Generator) -> dict[str, Tensor]:
        """Cross-entropy of the words at hidden patches, and the share that is guessed right."""
        seen = patches(self.encoder, points)
        batch, num_groups = seen.centres.shape[:2]
        low, high = BERT_MASKED
        share = low + (high - low) * float(torch.rand(1, generator=rng))
        hidden = hide(round(share * num_groups), num_groups, batch, rng).to(points.device)
        with torch.no_grad():
            meant = self.words.logits(seen).argmax(-1)[hidden]
        tokens, cls = visible_tokens(self.encoder, points, seen, hidden)
        blank = self.missing + self.place(seen.centres * 2.0)
        tokens = torch.where(hidden[..., None], blank, tokens)
        guessed = self.guess(self.encoder.mixed(tokens, cls)[:, 1:][hidden])
        right = (guessed.argmax(-1) == meant).float().mean()
        return {"words": F.cross_entropy(guessed, meant), "right": right.detach()}
