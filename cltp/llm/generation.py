"""Replies of Tac3D-LLM about one contact: text, the choice among eight actions, and durations.

In our own model the eight actions are tokens, and the choice is the softmax over them at the
position where the reply names one. In a stock checkpoint, a prefix trie after ``Action:`` leaves
only the tokens that continue one of the eight names. The rest of a reply is not constrained.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.llm.causal_lm import CUE, Language
from cltp.llm.fast_decode import FastDecoder, greedy
from cltp.llm.tac3d_llm import Tac3dLlm
from cltp.tactile.point_layout import PointLayout
from cltp.texts.tokenizer import ACTIONS

MAX_TOKENS = 96
"""Bound on the tokens of a reply; our own take about 60."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """A reply of the model.

    Attributes:
        text: D_t.
        ended: False when ``max_tokens`` came before the end: the text is cut off.
        num_tokens: Number of generated tokens.
        action: One of ``cltp.texts.tokenizer.ACTIONS``; None when the reply has none.
        probabilities: Probabilities of the eight at the action's position; empty without one.
        token_probabilities: Probability of each token of a free reply; empty where not known.
        stage_ms: Durations of encode, project, prefill (the prompt's tokens, which also give the
            first of the reply) and generate (the others) [ms].
    """

    text: str
    ended: bool
    num_tokens: int
    action: str | None
    probabilities: tuple[float, ...]
    stage_ms: dict[str, float]
    token_probabilities: tuple[float, ...] = ()

    @property
    def confidence(self) -> float:
        """Probability of the action among the eight; 0 without an action."""
        return max(self.probabilities, default=0.0)


class Talker:
    """Asks a Tac3D-LLM about contacts.

    Args:
        model: The model; its weights are copied.
        clock: Source of the time for durations [s].
    """

    def __init__(self, model: Tac3dLlm, clock: Callable[[], float] = time.perf_counter) -> None:
        self.model = model.eval()
        self._language = model.language
        self._clock = clock
        self._fast = FastDecoder(model.language.lm) if model.language.words else None

    @property
    def layout(self) -> PointLayout:
        """How the points lie that it takes."""
        return self.model.layout

    @torch.inference_mode()
    def reply(
        self,
        points: NDArray[np.float32],
        prompt: str,
        *,
        max_tokens: int = MAX_TOKENS,
        penalties: Mapping[str, float] | None = None,
        force_factor: float = 1.0,
    ) -> Reply:
        """Ask about one contact.

        Args:
            points: Shape (N, 3), from ``cltp.tactile.encoder_input`` in the encoder's ``layout``.
            prompt: A person's question or instruction.
            max_tokens: Bound on the tokens of the reply.
            penalties: Penalties of actions out of ``cltp.texts.tokenizer.ACTIONS`` in nats, which
                are taken from their logits: a penalised action must be exp(penalty) times as
                probable as the one that replaces it. An infinite penalty excludes an action.
            force_factor: Newtons per nominal newton of the unit that measured the points.
        """
        began = self._clock()
        encoded = self.model.encoder(torch.from_numpy(points)[None])
        encoded_at = self._clock()
        touch = self.model.projected(encoded, force_factor)[0]
        projected_at = self._clock()
        reply = self.reply_to(touch, prompt, max_tokens=max_tokens, penalties=penalties)
        stages = {
            "encode": 1e3 * (encoded_at - began),
            "project": 1e3 * (projected_at - encoded_at),
        }
        return replace(reply, stage_ms=stages | reply.stage_ms)

    @torch.inference_mode()
    def reply_to(
        self,
        touch: Tensor,
        prompt: str,
        *,
        max_tokens: int = MAX_TOKENS,
        penalties: Mapping[str, float] | None = None,
    ) -> Reply:
        """Ask about one contact that is embedded already.

        Args:
            touch: Shape (P, D), touch embeddings as ``Tac3dLlm.projected`` gives them.
            prompt: As for ``reply``.
            max_tokens: As for ``reply``.
            penalties: As for ``reply``.
        """
        marks = [self._clock()]
        inputs = torch.cat([touch, self._language.embed(self._language.prompt(prompt))])
        generate = partial(_own, self._fast) if self._fast is not None else _stock
        ids, ended, probabilities = generate(
            self._language, inputs, max_tokens, lambda: marks.append(self._clock()), penalties or {}
        )
        text = self._language.decode(ids).strip()
        marks.append(self._clock())
        stages = ("prefill", "generate")
        return Reply(
            text=text,
            ended=ended,
            num_tokens=len(ids),
            action=ACTIONS[int(np.argmax(probabilities))] if probabilities else None,
            probabilities=tuple(probabilities),
            stage_ms={
                stage: 1e3 * (end - begin)
                for stage, begin, end in zip(stages, marks, marks[1:], strict=False)
            },
        )


def _own(
    decoder: FastDecoder,
    language: Language,
    inputs: Tensor,
    max_tokens: int,
    prefilled: Callable[[], None],
    penalties: Mapping[str, float],
) -> tuple[list[int], bool, list[float]]:
    actions = [tokens[0] for tokens in language.actions()]
    probabilities: list[Tensor] = []

    def watch(token: int, logits: Tensor) -> None:
        if token in actions and not probabilities:
            probabilities.append(logits[actions].softmax(-1))

    ids = greedy(
        decoder,
        inputs,
        stop=language.end,
        max_tokens=max_tokens,
        watch=watch,
        prefilled=prefilled,
        penalties={
            t: penalties[a] for t, a in zip(actions, ACTIONS, strict=True) if a in penalties
        },
    )
    return ids, len(ids) < max_tokens, probabilities[0].tolist() if probabilities else []


def _stock(
    language: Language,
    inputs: Tensor,
    max_tokens: int,
    prefilled: Callable[[], None],
    penalties: Mapping[str, float],
) -> tuple[list[int], bool, list[float]]:
    """Generate by transformers' own forward, with its cache, for any checkpoint of the family."""
    run = _Run(language)
    logits = run.feed(inputs)
    prefilled()
    ids: list[int] = []
    while len(ids) < max_tokens:
        token = int(logits.argmax())
        if token == language.end:
            return ids, True, []
        ids.append(token)
        if language.decode(ids[-8:]).rstrip().endswith(CUE):
            logits = run.append(token)
            weights = [
                probability * math.exp(-penalties.get(name, 0.0))
                for name, probability in zip(
                    ACTIONS, _action_probabilities(run, logits, language.actions()), strict=True
                )
            ]
            probabilities = [weight / (sum(weights) or 1.0) for weight in weights]
            ids += language.actions()[int(np.argmax(probabilities))]
            return ids, True, probabilities
        logits = run.append(token)
    return ids, False, []


class _Run:
    """A forward pass that continues after the tokens so far."""

    def __init__(self, language: Language) -> None:
        self._language = language
        self._past: Any = None
        self.length = 0

    def feed(self, inputs: Tensor) -> Tensor:
        self.length += len(inputs)
        out = self._language.lm(
            inputs_embeds=inputs[None],
            attention_mask=torch.ones(1, self.length, dtype=torch.long, device=inputs.device),
            past_key_values=self._past,
            use_cache=True,
        )
        self._past = out.past_key_values
        return out.logits[0, -1]

    def rewind(self, length: int) -> None:
        if self.length > length:
            self._past.crop(length - self.length)  # negative: so many fewer
        self.length = length

    def append(self, token: int) -> Tensor:
        """Logits of what follows ``token``."""
        return self.feed(self._language.embed([token]))


def _action_probabilities(run: _Run, logits: Tensor, names: list[list[int]]) -> list[float]:
    """Probability of each name under the trie of all of them.

    At every node the model's distribution is restricted to tokens that continue some name, so that
    the probabilities of the eight add up to 1 however many tokens each takes.
    """
    probabilities = [0.0] * len(names)

    def descend(prefix: list[int], logits: Tensor, mass: float) -> None:
        inside = [n for n in range(len(names)) if names[n][: len(prefix)] == prefix]
        if len(inside) == 1 or any(len(names[n]) == len(prefix) for n in inside):
            ended = next((n for n in inside if len(names[n]) == len(prefix)), inside[0])
            probabilities[ended] += mass
            return
        nexts = sorted({names[n][len(prefix)] for n in inside})
        fractions = logits[nexts].softmax(-1).tolist()
        length = run.length
        for token, fraction in zip(nexts, fractions, strict=True):
            branch = [*prefix, token]
            is_leaf = sum(names[n][: len(branch)] == branch for n in inside) == 1
            descend(branch, logits if is_leaf else run.append(token), mass * fraction)
            if not is_leaf:
                run.rewind(length)

    descend([], logits, 1.0)
    return probabilities
