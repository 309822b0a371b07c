"""Prompts and replies about contacts, packed into sequences for learning.

A sequence is the touch tokens of one contact followed by several (prompt, reply) segments. Each
segment attends to the touch tokens and to itself, not to the other segments, and its positions
start after the touch tokens: the language model computes exactly what it would for each segment
alone, but the touch tokens only once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import torch
from torch import Tensor
from torch.nn.utils.rnn import pad_sequence

NOT_LEARNED = -100


class ExchangeTokens(Protocol):
    """A tokenizer of exchanges: ours, or that of a stock checkpoint."""

    pad: int
    eos: int

    def prompt_ids(self, text: str) -> list[int]:
        """Tokens between the touch and the reply."""
        ...

    def encode_marked(self, text: str) -> tuple[list[int], list[bool]]:
        """Tokens of a reply, and which of them name an action."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Exchange:
    """A prompt and the reply to be learned, as text.

    Attributes:
        prompt: Request of a person; empty for a text to be learned as a whole.
        reply: Text to be generated.
    """

    prompt: str
    reply: str


class Packed(NamedTuple):
    """A batch of sequences of length L behind P touch tokens each.

    Attributes:
        ids: Shape (B, L).
        labels: Shape (B, L): the next token, ``NOT_LEARNED`` outside replies.
        weights: Shape (B, L): weight of each label in the loss.
        positions: Shape (B, P + L).
        mask: Shape (B, 1, P + L, P + L), added to attention scores: 0 or -inf.
    """

    ids: Tensor
    labels: Tensor
    weights: Tensor
    positions: Tensor
    mask: Tensor


def pack(
    words: ExchangeTokens,
    groups: Sequence[Sequence[Exchange]],
    num_touch: int,
    *,
    action_weight: float = 1.0,
) -> Packed:
    """Pack the exchanges of each contact.

    Args:
        words: Tokenizer.
        groups: For each of B contacts, one or more exchanges.
        num_touch: Number P of touch tokens; 0 for learning from text alone.
        action_weight: Weight of a label that names an action; others weigh 1.
    """
    rows = [_sequence(words, group, num_touch) for group in groups]
    ids, labels, actions, positions, segments = (
        pad_sequence([torch.tensor(one) for one in column], batch_first=True, padding_value=padding)
        for column, padding in zip(
            zip(*rows, strict=True), (words.pad, NOT_LEARNED, 0, 0, -1), strict=True
        )
    )
    total = positions.shape[1]
    own = segments[:, :, None] == segments[:, None, :]
    touch = (segments[:, None, :] == 0) & (segments[:, :, None] > 0)
    causal = torch.ones(total, total, dtype=torch.bool).tril()
    mask = torch.zeros(len(ids), 1, total, total)
    mask[:, 0].masked_fill_(~((own | touch) & causal), float("-inf"))
    weights = torch.where(actions > 0, action_weight, 1.0) * (labels != NOT_LEARNED)
    return Packed(ids=ids, labels=labels, weights=weights, positions=positions, mask=mask)


def _sequence(
    words: ExchangeTokens, group: Sequence[Exchange], num_touch: int
) -> tuple[list[int], ...]:
    """Tokens, labels, which of these name an action; positions and segments behind the touch."""
    all_ids: list[int] = []
    labels: list[int] = []
    actions: list[int] = []
    positions, segments = list(range(num_touch)), [0] * num_touch
    for segment, exchange in enumerate(group, start=1):
        before = words.prompt_ids(exchange.prompt)
        said, marks = words.encode_marked(exchange.reply)
        reply = [*said, words.eos]
        ids = before + reply[:-1]
        all_ids += ids
        labels += [NOT_LEARNED] * (len(before) - 1) + reply
        actions += [0] * (len(before) - 1) + [int(mark) for mark in marks] + [0]
        positions += range(num_touch, num_touch + len(ids))
        segments += [segment] * len(ids)
    return all_ids, labels, actions, positions, segments
