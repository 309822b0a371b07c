"""Random texts of a grammar, and language models whose logits cost nothing, for tests."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence

import numpy as np
import torch

from cltp.llm.constrained.grammar import Grammar, NumberRange, Verbatim
from cltp.llm.stored_lm import StoredConfig, StoredLm, _shapes


def random_text(grammar: Grammar, rng: random.Random) -> str:
    """A text that a grammar allows: each option is as likely, half the words have a rival."""
    pending = list(reversed(grammar))
    text = ""
    while pending:
        part = pending.pop()
        if isinstance(part, Verbatim):
            text += part.text
        elif isinstance(part, NumberRange):
            text += f" {_number(part, rng)}{part.after}"
        else:
            option = rng.choice(part.options)
            text += option.text
            rivals = [o.rival for o in part.options if o is not option and o.rival]
            if option.rival and rivals and rng.random() < 0.5:
                text += rng.choice(rivals)
            pending += reversed(option.then)
    return text


def _number(part: NumberRange, rng: random.Random) -> str:
    low = rng.randrange(len(part.texts))
    if part.interval and low + 1 < len(part.texts) and rng.random() < 0.5:
        return f"{part.texts[low]}-{part.texts[rng.randrange(low + 1, len(part.texts))]}"
    return part.texts[low]


class FakeDecoder:
    """A decoder whose logits, which are its states, are a function of the tokens so far.

    It counts its passes, and checks that it is used as ``FastDecoder`` can be. With ``reduced``
    logits those are what it gives from a begin on that allows it.
    """

    longest = 512

    def __init__(
        self,
        logits: Callable[[tuple[int, ...]], torch.Tensor],
        reduced: Callable[[tuple[int, ...]], torch.Tensor] | None = None,
    ) -> None:
        self._precise, self._rounded = logits, reduced
        self.is_reduced = False
        self._tokens: list[int] = []
        self._num_inputs = 0
        self.passes = 0

    def begin(
        self, embeddings: torch.Tensor, tokens: Sequence[int] = (), *, reduced: bool = False
    ) -> list[torch.Tensor]:
        self._num_inputs, self._tokens = len(embeddings), []
        self.is_reduced = reduced and self._rounded is not None
        self.passes += 1
        return [self._logits(()), *self._feed(tokens)]

    def advance(self, tokens: Sequence[int]) -> list[torch.Tensor]:
        assert tokens
        self.passes += 1
        return self._feed(tokens)

    def scores(self, logits: torch.Tensor, tokens: Sequence[int]) -> list[float]:
        return logits.numpy()[list(tokens)].tolist()

    def rewind(self, length: int) -> None:
        assert 0 <= length - self._num_inputs <= len(self._tokens)
        del self._tokens[length - self._num_inputs :]

    def _logits(self, said: tuple[int, ...]) -> torch.Tensor:
        return self._rounded(said) if self.is_reduced and self._rounded else self._precise(said)

    def _feed(self, tokens: Sequence[int]) -> list[torch.Tensor]:
        rows = []
        for token in tokens:
            self._tokens.append(token)
            rows.append(self._logits(tuple(self._tokens)))
        assert self._num_inputs + len(self._tokens) <= self.longest
        return rows


def random_logits(size: int, seed: int, scale: float = 3.0) -> Callable[..., torch.Tensor]:
    """Logits of a vocabulary that look random and depend on the tokens so far."""
    table = torch.from_numpy(np.random.default_rng(seed).normal(0, scale, (997, size))).float()
    return lambda tokens: table[hash((seed, tokens)) % len(table)]


def scripted_logits(size: int, script: dict[tuple[int, ...], dict[int, float]]) -> Callable:
    """Logits after certain tokens; zero where nothing is said."""

    def logits(tokens: tuple[int, ...]) -> torch.Tensor:
        row = torch.zeros(size)
        for token, value in script.get(tokens, {}).items():
            row[token] = value
        return row

    return logits


def random_lm(vocabulary: int, seed: int, *, dim: int = 48, layers: int = 2) -> StoredLm:
    """A small Qwen2 with random weights, so large that its logits differ by several nats."""
    config = StoredConfig(
        vocab_size=vocabulary,
        hidden_size=dim,
        intermediate_size=8 * dim // 3,
        num_hidden_layers=layers,
        num_attention_heads=4,
        num_key_value_heads=4,
        rms_norm_eps=1e-6,
        rope_theta=10_000.0,
    )
    generator = torch.Generator().manual_seed(seed)
    state = {
        name: 1.0 + 0.2 * torch.randn(shape, generator=generator)
        if "norm" in name
        else 0.3 * torch.randn(shape, generator=generator)
        for name, shape in _shapes(config).items()
    }
    return StoredLm(config, state)
