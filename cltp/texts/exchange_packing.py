"""Prompts and replies about contacts, packed into sequences for learning.

A sequence is the touch tokens of one contact followed by several (prompt, reply) segments. Each
segment attends to the touch tokens and to itself, not to the other segments, and its positions
start after the touch tokens: the language model computes exactly what it would for each segment
alone, but the touch tokens only once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import torch
from torch import Tensor

from cltp.texts.tokenizer import Words

NOT_LEARNED = -100


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


def prompt_ids(words: Words, prompt: str, *, longest: int = 96) -> list[int]:
    """Tokens before a reply: ``<user> prompt <reply>``.

    Of a prompt with more than ``longest`` tokens, beginning and end remain, half each.
    """
    ids = words.encode(prompt, trusted=False)
    if len(ids) > longest:
        ids = ids[: longest // 2] + ids[-(longest - longest // 2) :]
    return [words.user, *ids, words.reply]


def pack(
    words: Words,
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
        action_weight: Weight of a label that is an action; others weigh 1.
    """
    rows = [_sequence(words, group, num_touch) for group in groups]
    longest = max(len(row.ids) for row in rows)
    total = num_touch + longest
    ids = torch.full((len(rows), longest), words.pad)
    labels = torch.full((len(rows), longest), NOT_LEARNED)
    positions = torch.zeros(len(rows), total, dtype=torch.long)
    positions[:, :num_touch] = torch.arange(num_touch)
    segments = torch.full((len(rows), total), -1)
    segments[:, :num_touch] = 0
    for number, row in enumerate(rows):
        length = len(row.ids)
        ids[number, :length] = torch.tensor(row.ids)
        labels[number, :length] = torch.tensor(row.labels)
        positions[number, num_touch : num_touch + length] = torch.tensor(row.positions)
        segments[number, num_touch : num_touch + length] = torch.tensor(row.segments)
    own = segments[:, :, None] == segments[:, None, :]
    touch = (segments[:, None, :] == 0) & (segments[:, :, None] > 0)
    causal = torch.ones(total, total, dtype=torch.bool).tril()
    mask = torch.zeros(len(rows), 1, total, total)
    mask[:, 0].masked_fill_(~((own | touch) & causal), float("-inf"))
    is_action = torch.isin(labels, torch.tensor(words.actions))
    weights = torch.where(is_action, action_weight, 1.0) * (labels != NOT_LEARNED)
    return Packed(ids=ids, labels=labels, weights=weights, positions=positions, mask=mask)


class _Row(NamedTuple):
    ids: list[int]
    labels: list[int]
    positions: list[int]
    segments: list[int]


def _sequence(words: Words, group: Sequence[Exchange], num_touch: int) -> _Row:
    row = _Row([], [], [], [])
    for segment, exchange in enumerate(group, start=1):
        before = prompt_ids(words, exchange.prompt)
        reply = [*words.encode(exchange.reply), words.eos]
        ids = before + reply[:-1]
        row.ids.extend(ids)
        row.labels.extend([NOT_LEARNED] * (len(before) - 1) + reply)
        row.positions.extend(range(num_touch, num_touch + len(ids)))
        row.segments.extend([segment] * len(ids))
    return row
