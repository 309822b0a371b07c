"""Tac3D-LLM: encoder tokens, projected into a causal language model's input space.

Source: paper, section 5.3, after LLaVA: a small MLP maps the encoder's tokens to embeddings, which
stand before the prompt. Beyond the paper, the encoder's pooled tokens and the readings of its state
heads follow them as a few more tokens (``cltp.llm.reading_tokens``). Not here: replies
(``cltp.llm.generation``).
"""

from __future__ import annotations

from typing import Any

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.encoder import Encoded, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.encoder.readings import HeadReadings, readings_of
from cltp.llm.causal_lm import Language
from cltp.llm.reading_tokens import NUM_READINGS, ReadingTokens
from cltp.tactile.point_layout import PointLayout
from cltp.texts.exchange_packing import NOT_LEARNED, Packed

NUM_POOLED = 4
"""Tokens of the encoder's pooled tokens. Our choice: what the heads read is read from these, and
the language model is to feel it without the heads."""

_POOLED_HIDDEN = 256


class Projector(nn.Module):
    """Two layers from the encoder's width to the language model's, and the heads' readings.

    The pooled tokens become ``NUM_POOLED`` further ones.

    Args:
        encoder_dim: Width C of the encoder's tokens.
        lm_dim: Width D of the language model's inputs.
    """

    def __init__(self, encoder_dim: int, lm_dim: int) -> None:
        super().__init__()
        self.encoder_dim, self.lm_dim = encoder_dim, lm_dim
        self.first = nn.Linear(encoder_dim, lm_dim)
        self.second = nn.Linear(lm_dim, lm_dim)
        self.pooled = nn.Sequential(
            nn.Linear(2 * encoder_dim, _POOLED_HIDDEN),
            nn.GELU(),
            nn.Linear(_POOLED_HIDDEN, NUM_POOLED * lm_dim),
            nn.Unflatten(-1, (NUM_POOLED, lm_dim)),
        )
        self.readings = ReadingTokens(lm_dim)

    def forward(
        self, encoded: Encoded, readings: HeadReadings, given: Tensor | None = None
    ) -> Tensor:
        """An encoded batch and its readings to embeddings (B, G + 1 + 4 + 6, D).

        ``given`` is as in ``ReadingTokens.forward``.
        """
        projected = self.second(F.gelu(self.first(encoded.tokens)))
        read = self.readings(readings, given)
        pooled = encoded.pooled[:, -2 * self.encoder_dim :]  # what is before them, the heads read
        return torch.cat([projected, self.pooled(pooled), read], dim=1)


class Tac3dLlm(nn.Module):
    """The whole model.

    Args:
        encoder: E_T.
        heads: Its state heads.
        projector: The MLP between.
        language: The causal language model.
    """

    lm: Any

    def __init__(
        self, encoder: TactileEncoder, heads: StateHeads, projector: Projector, language: Language
    ) -> None:
        super().__init__()
        self.encoder, self.heads, self.projector = encoder, heads, projector
        self.lm = language.lm
        self.language = language

    @property
    def num_touch(self) -> int:
        """Tokens before a prompt: groups, class token, pooled tokens, readings.

        A stock checkpoint's own, which begin a turn, stand before them.
        """
        touch = self.encoder.config.num_groups + 1 + NUM_POOLED + NUM_READINGS
        return len(self.language.begin) + touch

    @property
    def layout(self) -> PointLayout:
        """How the points lie that it takes."""
        return self.encoder.config.variant.layout

    def touch(self, points: Tensor) -> Tensor:
        """Embeddings of scaled points (B, N, 3) of nominal units: shape (B, P, D)."""
        encoded = self.encoder(points)
        return self.projected(encoded, readings_of(self.heads.read(encoded.pooled, points)))

    def projected(
        self, encoded: Encoded, readings: HeadReadings, given: Tensor | None = None
    ) -> Tensor:
        """Embeddings of an encoded batch: shape (B, P, D).

        Args:
            encoded: The batch.
            readings: What the language model is told of it, in newtons.
            given: Shape (B, 6), bool: which readings it is told; None for all.
        """
        embeddings: Tensor = self.projector(encoded, readings, given)
        begin = self.language.begin
        if not begin:
            return embeddings
        before = self.language.embed(begin).to(embeddings)
        return torch.cat([before.expand(len(embeddings), -1, -1), embeddings], dim=1)

    def loss(self, touch: Tensor | None, packed: Packed) -> dict[str, Tensor]:
        """Loss of packed exchanges behind touch embeddings, or of text alone.

        Only replies are learned. Returns the weighted mean as ``language``, and as a score
        ``action_right``: the fraction of actions that are the most probable of the eight, where
        each is one token.
        """
        embedded = self.lm.get_input_embeddings()(packed.ids)
        num_touch = 0
        if touch is not None:
            num_touch = touch.shape[1]
            embedded = torch.cat([touch.to(embedded.dtype), embedded], dim=1)
        hidden = self.lm.model(
            inputs_embeds=embedded,
            attention_mask=packed.mask.to(embedded.dtype),
            position_ids=packed.positions,
            use_cache=False,
        ).last_hidden_state[:, num_touch:]
        learned = packed.labels != NOT_LEARNED
        logits = self.lm.get_output_embeddings()(hidden[learned])
        labels, weights = packed.labels[learned], packed.weights[learned]
        each = F.cross_entropy(logits.float(), labels, reduction="none")
        terms = {"language": (each * weights).sum() / weights.sum()}
        if self.language.words is not None:
            actions = torch.tensor(self.language.words.actions, device=labels.device)
            is_action = torch.isin(labels, actions)
            if is_action.any():
                chosen = actions[logits[is_action][:, actions].argmax(dim=1)]
                terms["action_right"] = (chosen == labels[is_action]).float().mean().detach()
        return terms
