"""Replies of Tac3D-LLM about one contact: text, the choice among eight actions, and durations.

For our own model the eight actions are tokens, and the choice is the softmax over them at the place
where the reply names one. For a stock checkpoint, once the reply has come to ``Action:``, a prefix
trie leaves only what continues one of the eight names. Nothing else in a reply is constrained.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.llm.causal_lm import CUE, Language
from cltp.llm.fast_decode import FastDecoder, greedy
from cltp.llm.tac3d_llm import Tac3dLlm
from cltp.texts.tokenizer import ACTIONS

MAX_TOKENS = 96
"""A reply that is longer never ends. Our own take about 60."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """What the model said.

    Attributes:
        text: D_t.
        ended: False when ``max_tokens`` came before the end: the text is cut off.
        num_tokens: Tokens generated.
        action: One of ``cltp.texts.tokenizer.ACTIONS``, None when the reply comes to none.
        probabilities: Of the eight at the action's place; empty when it comes to none.
        stage_ms: Durations of encode, project, prefill (the prompt's tokens, which also give the
            first of the reply) and generate (the others) [ms].
    """

    text: str
    ended: bool
    num_tokens: int
    action: str | None
    probabilities: tuple[float, ...]
    stage_ms: dict[str, float]

    @property
    def confidence(self) -> float:
        """Probability of the action among the eight; 0 without one."""
        return max(self.probabilities, default=0.0)


class Talker:
    """Asks a Tac3D-LLM about contacts.

    Args:
        model: Its weights are taken as they are now.
        clock: For durations [s].
    """

    def __init__(self, model: Tac3dLlm, clock: Callable[[], float] = time.perf_counter) -> None:
        self._model = model.eval()
        self._language = model.language
        self._clock = clock
        self._fast = FastDecoder(model.language.lm) if model.language.words else None

    @property
    def model(self) -> Tac3dLlm:
        """What is asked."""
        return self._model

    @torch.inference_mode()
    def reply(
        self,
        points: NDArray[np.float32],
        prompt: str,
        *,
        max_tokens: int = MAX_TOKENS,
        against: Mapping[str, float] | None = None,
    ) -> Reply:
        """Ask about one contact.

        Args:
            points: Shape (1024, 3), from ``cltp.tactile.encoder_input.encoder_input``.
            prompt: What a person asks.
            max_tokens: Bound on the reply.
            against: What speaks against actions out of ``cltp.texts.tokenizer.ACTIONS``, in nats
                taken from their logits: the logarithm of how many times likelier one has to be than
                what is said in its place. Infinite: the reply must not ask for it.
        """
        marks = [self._clock()]
        encoded = self._model.encoder(torch.from_numpy(points)[None])
        marks.append(self._clock())
        touch = self._model.projected(encoded)[0]
        marks.append(self._clock())
        inputs = torch.cat([touch, self._language.embed(self._language.prompt(prompt))])

        def prefilled() -> None:
            marks.append(self._clock())

        say = partial(_own, self._fast) if self._fast is not None else _stock
        ids, ended, chances = say(
            self._language, inputs, max_tokens, prefilled, dict(against or {})
        )
        text = self._language.decode(ids).strip()
        marks.append(self._clock())
        stages = ("encode", "project", "prefill", "generate")
        return Reply(
            text=text,
            ended=ended,
            num_tokens=len(ids),
            action=ACTIONS[int(np.argmax(chances))] if chances else None,
            probabilities=tuple(chances),
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
    against: Mapping[str, float],
) -> tuple[list[int], bool, list[float]]:
    actions = [tokens[0] for tokens in language.actions()]
    found: list[Tensor] = []

    def watch(token: int, logits: Tensor) -> None:
        if token in actions and not found:
            found.append(logits[actions].softmax(-1))

    ids = greedy(
        decoder,
        inputs,
        stop=language.end,
        max_tokens=max_tokens,
        watch=watch,
        prefilled=prefilled,
        against={t: against[a] for t, a in zip(actions, ACTIONS, strict=True) if a in against},
    )
    return ids, len(ids) < max_tokens, found[0].tolist() if found else []


def _stock(
    language: Language,
    inputs: Tensor,
    max_tokens: int,
    prefilled: Callable[[], None],
    against: Mapping[str, float],
) -> tuple[list[int], bool, list[float]]:
    """The same by transformers' own forward, with its cache, for any checkpoint of the family."""
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
            chances = _score(run, logits_after(run, token), language.actions())
            chances = [
                chance * math.exp(-against.get(name, 0.0))
                for name, chance in zip(ACTIONS, chances, strict=True)
            ]
            chances = [chance / (sum(chances) or 1.0) for chance in chances]
            ids += language.actions()[int(np.argmax(chances))]
            return ids, True, chances
        logits = logits_after(run, token)
    return ids, False, []


class _Run:
    """A forward pass that goes on from where it stands."""

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

    def embed(self, ids: Sequence[int]) -> Tensor:
        return self._language.embed(ids)


def logits_after(run: _Run, token: int) -> Tensor:
    """Logits of what follows when ``token`` is appended."""
    return run.feed(run.embed([token]))


def _score(run: _Run, logits: Tensor, names: list[list[int]]) -> list[float]:
    """Probability of each name under the trie of all of them.

    At every node the model's distribution is restricted to tokens that continue some name, so that
    the probabilities of the eight add up to 1 however many tokens each takes.
    """
    chances = [0.0] * len(names)

    def descend(prefix: list[int], logits: Tensor, mass: float) -> None:
        inside = [n for n in range(len(names)) if names[n][: len(prefix)] == prefix]
        if len(inside) == 1 or any(len(names[n]) == len(prefix) for n in inside):
            ended = next((n for n in inside if len(names[n]) == len(prefix)), inside[0])
            chances[ended] += mass
            return
        nexts = sorted({names[n][len(prefix)] for n in inside})
        shares = logits[nexts].softmax(-1).tolist()
        here = run.length
        for token, share in zip(nexts, shares, strict=True):
            branch = [*prefix, token]
            alone = sum(names[n][: len(branch)] == branch for n in inside) == 1
            descend(branch, logits if alone else logits_after(run, token), mass * share)
            if not alone:
                run.rewind(here)

    descend([], logits, 1.0)
    return chances
