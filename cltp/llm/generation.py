"""Replies of Tac3D-LLM about one contact: text, the choice among eight actions, and durations.

In our own model the eight actions are tokens, and the choice is the softmax over them at the
position where the reply names one. With a grammar a reply says nothing else
(``cltp.llm.constrained``), in our model and in a stock checkpoint alike. Without one the reply is
free; then, in a stock checkpoint, a prefix trie after ``Action:`` leaves only the tokens that
continue one of the eight names.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.encoder.encoder import Encoded
from cltp.encoder.readings import HeadReadings, readings_of
from cltp.llm.causal_lm import CUE, Language
from cltp.llm.constrained.decode import Constrained, ConstrainedDecoder, SlotDecision
from cltp.llm.constrained.grammar import Grammar
from cltp.llm.constrained.tokens import TextTokens
from cltp.llm.fast_decode import FastDecoder, greedy
from cltp.llm.tac3d_llm import Tac3dLlm
from cltp.processor import has_bfloat16
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.point_layout import PointLayout
from cltp.texts.tokenizer import ACTIONS

MAX_TOKENS = 96
"""Bound on the tokens of a reply in free words; our own take about 60."""

ACTION_PART = "action"
"""Name of the part of a grammar whose options are ``cltp.texts.tokenizer.ACTIONS``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """A reply of the model.

    Attributes:
        text: D_t.
        ended: False when ``max_tokens`` came before the end: the text is cut off. With a grammar it
            is False when the model's positions did not suffice.
        num_tokens: Number of generated tokens.
        action: One of ``cltp.texts.tokenizer.ACTIONS``; None when the reply has none.
        probabilities: Probabilities of the eight at the action's position, of those that are
            allowed where there is a grammar; empty without one.
        stage_ms: Durations of encode, project, prefill (the prompt's tokens, which also give the
            first of the reply, and the draft's) and generate (the others) [ms].
        slots: With a grammar, what was decided about each part, by its name; otherwise empty.
        passes: Number of forward passes.
        close_calls: Number of passes among these that were spent on close decisions.
    """

    text: str
    ended: bool
    num_tokens: int
    action: str | None
    probabilities: tuple[float, ...]
    stage_ms: dict[str, float]
    slots: Mapping[str, SlotDecision] = field(default_factory=dict)
    passes: int = 0
    close_calls: int = 0

    @property
    def confidence(self) -> float:
        """Probability of the action among the eight; 0 without an action."""
        return max(self.probabilities, default=0.0)


@dataclass(frozen=True, slots=True)
class Felt:
    """One contact as the model feels it.

    Attributes:
        encoded: The encoder's output, a batch of one.
        readings: What the heads read of it, in the unit's newtons.
        touch: Touch embeddings, shape (P, D).
        stage_ms: Durations of encode and project [ms].
    """

    encoded: Encoded
    readings: HeadReadings
    touch: Tensor
    stage_ms: dict[str, float]


NOMINAL = ForceScale(factor=1.0, spread=0.0, source="nominal")
"""Scale of a unit whose newtons are nominal ones."""


class Talker:
    """Asks a Tac3D-LLM about contacts.

    Args:
        model: The model; its weights are copied.
        clock: Source of the time for durations [s].
        reduces: Whether long passes take their products of matrices in bfloat16; None where a
            model in 32 bits runs on a processor with instructions for it. Close decisions are
            taken in 32 bits still.
    """

    def __init__(
        self,
        model: Tac3dLlm,
        clock: Callable[[], float] = time.perf_counter,
        *,
        reduces: bool | None = None,
    ) -> None:
        self.model = model.eval()
        self._language = model.language
        self._clock = clock
        if reduces is None:
            weight = model.language.lm.get_input_embeddings().weight
            reduces = (weight.dtype, weight.device.type) == (torch.float32, "cpu")
            reduces = reduces and has_bfloat16()
        language = model.language
        self._fast = FastDecoder(language.lm, reduces=reduces) if language.words else None
        self._constrained = ConstrainedDecoder(
            self._fast or _Run(model.language), TextTokens(model.language.encode)
        )

    @property
    def layout(self) -> PointLayout:
        """How the points lie that it takes."""
        return self.model.layout

    @property
    def reduces(self) -> bool:
        """Whether long passes take their products of matrices in bfloat16."""
        return self._fast is not None and self._fast.reduces

    @property
    def width(self) -> int:
        """Width of its embeddings."""
        return self._language.dim

    @torch.inference_mode()
    def feel(
        self,
        points: NDArray[np.float32],
        scale: ForceScale = NOMINAL,
        correct: Callable[[HeadReadings], HeadReadings] | None = None,
    ) -> Felt:
        """Encode one contact, once for all that is asked about it.

        Args:
            points: Shape (N, 3), from ``cltp.tactile.encoder_input`` in the encoder's ``layout``.
            scale: Force scale of the unit that measured them.
            correct: Corrects what the heads read by what else is known; None leaves it.

        Raises:
            TouchError: The weights' heads have no intervals.
        """
        marks = [self._clock()]
        batch = torch.from_numpy(points)[None]
        encoded = self.model.encoder(batch, aligned=False)
        marks.append(self._clock())
        output = self.model.heads.read(encoded.pooled, batch)
        readings = readings_of(output, scale.factor, scale.spread)
        if correct is not None:
            readings = correct(readings)
        touch = self.model.projected(encoded, readings)[0]
        marks.append(self._clock())
        return Felt(encoded, readings, touch, _durations(("encode", "project"), marks))

    def reply(
        self,
        points: NDArray[np.float32],
        prompt: str,
        *,
        scale: ForceScale = NOMINAL,
        grammar: Grammar | None = None,
        draft: str = "",
        doubt_below: Mapping[str, float] | None = None,
        max_tokens: int = MAX_TOKENS,
        penalties: Mapping[str, float] | None = None,
    ) -> Reply:
        """Ask about one contact: ``feel`` and ``reply_to``, whose arguments it takes."""
        felt = self.feel(points, scale)
        reply = self.reply_to(
            felt.touch,
            prompt,
            grammar=grammar,
            draft=draft,
            doubt_below=doubt_below,
            max_tokens=max_tokens,
            penalties=penalties,
        )
        return replace(reply, stage_ms={**felt.stage_ms, **reply.stage_ms})

    @torch.inference_mode()
    def reply_to(
        self,
        touch: Tensor,
        prompt: str,
        *,
        grammar: Grammar | None = None,
        draft: str = "",
        doubt_below: Mapping[str, float] | None = None,
        max_tokens: int = MAX_TOKENS,
        penalties: Mapping[str, float] | None = None,
    ) -> Reply:
        """Ask about one contact that is felt already.

        Args:
            touch: Shape (P, D), touch embeddings as ``feel`` gives them; (0, D) for none.
            prompt: A person's question, or the request of a step.
            grammar: What may be said; None for anything.
            draft: With a grammar, a whole expected reply. It saves time, and changes nothing else
                unless the model itself is in 16 bits (``cltp.llm.constrained.decode``).
            doubt_below: With a grammar, probabilities below which a text is said with its rival, by
                the name of its part; ``cltp.llm.constrained.decode.DOUBT_BELOW`` for the others.
            max_tokens: Bound on the tokens of a reply without a grammar.
            penalties: Penalties of actions out of ``cltp.texts.tokenizer.ACTIONS`` in nats, with a
                grammar of any of its options, which are taken from their logits: a penalised one
                must be exp(penalty) times as probable as the one that replaces it, at the token
                that tells it from all others: options that begin alike are one until then. An
                infinite penalty excludes it.

        Raises:
            TouchError: Grammar and penalties leave no action.
        """
        marks = [self._clock()]
        asked = self._language.embed(self._language.prompt(prompt))
        inputs = torch.cat([touch.to(asked), asked])

        def prefilled() -> None:
            marks.append(self._clock())

        if grammar is not None:
            said = _generated(
                self._constrained.decode(
                    inputs,
                    grammar,
                    draft=draft,
                    penalties=penalties,
                    doubt_below=doubt_below,
                    prefilled=prefilled,
                )
            )
        else:
            generate = partial(_own, self._fast) if self._fast is not None else _stock
            said = generate(self._language, inputs, max_tokens, prefilled, penalties or {})
        text = said.text or self._language.decode(said.ids).strip()
        marks.append(self._clock())
        return Reply(
            text=text,
            ended=said.ended,
            num_tokens=len(said.ids),
            action=ACTIONS[int(np.argmax(said.probabilities))] if said.probabilities else None,
            probabilities=tuple(said.probabilities),
            stage_ms=_durations(("prefill", "generate"), marks),
            slots=said.slots,
            passes=said.passes,
            close_calls=said.close_calls,
        )

    @torch.inference_mode()
    def log_likelihoods(self, prompt: str, replies: Sequence[str]) -> list[float]:
        """Log-probabilities of whole replies to a prompt without touch, each to its end.

        One that its positions do not suffice for has minus infinity.

        Args:
            prompt: A person's question.
            replies: The replies.
        """
        asked = self._language.embed(self._language.prompt(prompt))
        decoder: FastDecoder | _Run = self._fast or _Run(self._language)
        first = decoder.begin(asked)
        logs = []
        for reply in replies:
            tokens = [*self._language.tokens.encode_marked(reply)[0], self._language.end]
            if len(asked) + len(tokens) > decoder.longest:
                logs.append(-math.inf)
                continue
            decoder.rewind(len(asked))
            states = torch.cat([first, decoder.advance(tokens[:-1])])
            logits = self._fast.logits(states) if self._fast is not None else states
            each = torch.log_softmax(logits.float(), dim=-1)[range(len(tokens)), tokens]
            logs.append(float(each.sum()))
        return logs


def _durations(stages: Sequence[str], marks: Sequence[float]) -> dict[str, float]:
    """Durations [ms] of stages between marks [s]."""
    spans = pairwise(marks)
    return {stage: 1e3 * (end - begin) for stage, (begin, end) in zip(stages, spans, strict=False)}


class _Generated(NamedTuple):
    """What was generated, before it is a ``Reply``; ``text`` is '' where the tokens give it."""

    ids: list[int]
    ended: bool
    probabilities: list[float]
    passes: int
    text: str = ""
    slots: Mapping[str, SlotDecision] = {}
    close_calls: int = 0


def _generated(reply: Constrained) -> _Generated:
    """A reply under a grammar, with the probabilities of the eight actions."""
    action = reply.decisions.get(ACTION_PART)
    return _Generated(
        ids=reply.ids,
        ended=reply.ended,
        probabilities=_of_eight(action) if action is not None else [],
        passes=reply.passes,
        text=reply.text,
        slots=reply.decisions,
        close_calls=reply.close_calls,
    )


def _of_eight(action: SlotDecision) -> list[float]:
    """Probabilities of the eight; actions that share one share it equally."""
    probabilities = dict.fromkeys(ACTIONS, 0.0)
    for names, probability in action.probabilities.items():
        together = names.split("|")
        probabilities |= dict.fromkeys(together, probability / len(together))
    return list(probabilities.values())


def _own(
    decoder: FastDecoder,
    language: Language,
    inputs: Tensor,
    max_tokens: int,
    prefilled: Callable[[], None],
    penalties: Mapping[str, float],
) -> _Generated:
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
    return _Generated(
        ids=ids,
        ended=len(ids) < min(max_tokens, decoder.longest - len(inputs)),
        probabilities=probabilities[0].tolist() if probabilities else [],
        passes=len(ids) + 1,
    )


def _stock(
    language: Language,
    inputs: Tensor,
    max_tokens: int,
    prefilled: Callable[[], None],
    penalties: Mapping[str, float],
) -> _Generated:
    """Generate by transformers' own forward, with its cache, for any checkpoint of the family."""
    run = _Run(language)
    logits = run.begin(inputs)[0]
    prefilled()
    ids: list[int] = []
    while len(ids) < max_tokens:
        token = int(logits.argmax())
        if token == language.end:
            return _Generated(ids, True, [], run.passes)
        ids.append(token)
        logits = run.advance([token])[0]
        if language.decode(ids[-8:]).rstrip().endswith(CUE):
            weights = [
                probability * math.exp(-penalties.get(name, 0.0))
                for name, probability in zip(
                    ACTIONS, _action_probabilities(run, logits, language.actions()), strict=True
                )
            ]
            probabilities = [weight / (sum(weights) or 1.0) for weight in weights]
            best = int(np.argmax(probabilities))
            ids += language.actions()[best]
            return _Generated(ids, True, probabilities, run.passes)
    return _Generated(ids, False, [], run.passes)


class _Run:
    """A stock checkpoint's forward pass, with its cache, under the names of ``FastDecoder``.

    What it gives behind each token are the logits themselves.
    """

    def __init__(self, language: Language) -> None:
        self._language = language
        self._past: Any = None
        self.length = self.passes = 0
        self.is_reduced = False
        self.longest = int(language.lm.config.get_text_config().max_position_embeddings)

    def begin(
        self, embeddings: Tensor, tokens: Sequence[int] = (), *, reduced: bool = False
    ) -> Tensor:
        """Begin with inputs (T, D) and tokens; the logits after the inputs and each token.

        A checkpoint runs in the precision that it is loaded in, ``reduced`` or not.
        """
        self._past, self.length = None, 0
        inputs = torch.cat([embeddings, self._language.embed(tokens)]) if tokens else embeddings
        return self._feed(inputs, len(tokens) + 1)

    def advance(self, tokens: Sequence[int]) -> Tensor:
        """Append tokens; the logits of what follows each, shape (tokens, V)."""
        return self._feed(self._language.embed(tokens), len(tokens))

    def scores(self, logits: Tensor, tokens: Sequence[int]) -> list[float]:
        """Logits of some tokens out of those of all, shape (V,)."""
        some: list[float] = logits[list(tokens)].float().tolist()
        return some

    def rewind(self, length: int) -> None:
        """Forget all but the first ``length`` positions."""
        if self.length > length:
            self._past.crop(length - self.length)  # negative: so many fewer
        self.length = length

    def _feed(self, inputs: Tensor, rows: int) -> Tensor:
        before = self.length
        self.length += len(inputs)
        self.passes += 1
        # Positions by number: a Qwen2.5-VL would count them from the last image that it saw.
        positions = torch.arange(before, self.length, device=inputs.device)[None]
        out = self._language.lm(
            inputs_embeds=inputs[None],
            attention_mask=torch.ones(1, self.length, dtype=torch.long, device=inputs.device),
            position_ids=positions,
            past_key_values=self._past,
            use_cache=True,
            logits_to_keep=rows,
        )
        self._past = out.past_key_values
        logits: Tensor = out.logits[0, -rows:]
        return logits


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
            descend(branch, logits if is_leaf else run.advance([token])[0], mass * fraction)
            if not is_leaf:
                run.rewind(length)

    descend([], logits, 1.0)
    return probabilities
