"""Greedy decoding under a grammar: only decisions cost a pass, and a good draft saves those too.

What the grammar forces is fed together with the next decision's place. A draft goes through the
model in the same pass as the prompt: at every place whose tokens so far agree with it, the state is
there already, and a decision costs the logits of the few tokens that the grammar allows. Where the
reply leaves the draft, its rest is fed along again from the next part on.

A choice between texts is made down the trie of their tokens, with softmax over the tokens that may
follow. If the probability of the chosen text is low, its rival is said too: the likeliest token
left aside on the way. The model never decides itself whether to say a rival.

A pass over many tokens rounds otherwise than one over few. A decision within ``CLOSE`` of another
one is taken anew from a pass over prompt and reply so far, which is the same with and without a
draft. So the draft never changes what is said in 32 bits. Passes that take their products in 16
round by more: after them the first decision within ``CLOSE_REDUCED`` has all tokens run through
again.
A model that is itself in 16 bits knows no better, and a draft can change its close decisions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile
from typing import NamedTuple, Protocol

from torch import Tensor

from cltp.errors import TouchError
from cltp.llm.constrained.grammar import (
    Grammar,
    NumberRange,
    Option,
    Part,
    TextChoice,
    Verbatim,
    match,
)
from cltp.llm.constrained.tokens import Node, TextTokens

CLOSE = 1e-3
"""Distance of two logits, of two log-probabilities or of a probability from its threshold, below
which a decision is taken anew. Our choice: a hundred times what passes of other lengths differ."""

CLOSE_REDUCED = 0.03
"""The same after passes with products in bfloat16. Source: 6,200 decisions on 300 contacts: the
difference of two logits moves by 0.009 in the median and by more than this in one of a hundred; in
three of a thousand decisions it is itself less than this. Of 5,000 replies under drawn targets none
differed from that of 32 bits without a draft, and 6 in 100 had tokens run through again."""

DOUBT_BELOW = 0.6
"""Probability below which a text is said with its rival, where none is set for its slot. Our
choice: four in ten are worth a word more."""


class Decoder(Protocol):
    """Runs a language model on a batch of one, as ``cltp.llm.fast_decode.FastDecoder`` does."""

    longest: int
    is_reduced: bool

    def begin(
        self, embeddings: Tensor, tokens: Sequence[int] = (), *, reduced: bool = False
    ) -> Tensor:
        """Begin with inputs (T, D) and tokens; a state behind the inputs and each token.

        From a ``reduced`` begin on, passes may have less precision; ``is_reduced`` tells it.
        """

    def advance(self, tokens: Sequence[int]) -> Tensor:
        """Append tokens; a state behind each of them."""

    def scores(self, state: Tensor, tokens: Sequence[int]) -> list[float]:
        """Logits of some tokens behind a state."""

    def rewind(self, length: int) -> None:
        """Forget all but the first ``length`` positions."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SlotDecision:
    """What was decided about one part of a reply.

    Attributes:
        name: Name of the part.
        chosen: Value of the option, or the number or interval as text.
        probability: Its probability: of a text among those of its choice, of a number the product
            over its digits; 1 where the grammar leaves only one.
        rival: Value of the rival that was said too; '' where none was.
        probabilities: Probability of every option, which add up to 1; of a number, its own alone.
            Options that the walk down the trie left aside together stand under one key, their
            values joined by '|'.
    """

    name: str
    chosen: str
    probability: float
    rival: str
    probabilities: Mapping[str, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Constrained:
    """A reply under a grammar.

    Attributes:
        text: The reply.
        ids: Its tokens, without the one that ends it.
        ended: False where the decoder's positions did not suffice: the text is cut off.
        decisions: What was decided, by the name of the part, in the reply's order.
        passes: Number of forward passes.
        close_calls: Number of passes among these that were spent on close decisions.
    """

    text: str
    ids: list[int]
    ended: bool
    decisions: dict[str, SlotDecision]
    passes: int
    close_calls: int


class _FullError(Exception):
    """The decoder's positions don't suffice."""


class _Left(NamedTuple):
    """Options that a walk left aside together."""

    mass: float
    inside: list[int]


class _Walk(NamedTuple):
    """A walk down the trie of a choice.

    Attributes:
        chosen: Index of the option.
        mass: Its probability.
        left: What was left aside on the way.
        is_close: Whether another decision was near.
    """

    chosen: int
    mass: float
    left: list[_Left]
    is_close: bool


class _States:
    """States of the model behind the tokens of a reply, by as few passes as possible.

    Args:
        decoder: Runs the model.
        inputs: Embeddings of what stands before the reply, shape (T, D).
        prefilled: Called once, after the first pass.
    """

    def __init__(
        self, decoder: Decoder, inputs: Tensor, prefilled: Callable[[], None] | None
    ) -> None:
        self._decoder, self._inputs, self._prefilled = decoder, inputs, prefilled
        self.passes = self.close_calls = 0
        self._fed: list[int] = []
        self._states: list[Tensor] = []

    @property
    def close(self) -> float:
        """Distance of two logits below which rounding may have decided."""
        return CLOSE_REDUCED if self._decoder.is_reduced else CLOSE

    def scores(
        self, said: list[int], tokens: Sequence[int], rest: Sequence[int] | None
    ) -> list[float]:
        """Logits of some tokens behind a reply.

        Args:
            said: The tokens of the reply so far.
            tokens: Those that may follow.
            rest: What is expected to follow; it is fed along if a pass is needed. None for logits
                from a single pass over the inputs and the reply so far.

        Raises:
            _FullError: There are too many tokens.
        """
        state = self._anew(said) if rest is None else self._after(said, rest)
        return self._decoder.scores(state, tokens)

    def _after(self, said: list[int], rest: Sequence[int]) -> Tensor:
        if self._states and self._fed[: len(said)] == said:
            return self._states[len(said)]
        same = len(self._fed)
        if said[:same] != self._fed:
            pairs = zip(said, self._fed, strict=False)
            same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
        room = self._decoder.longest - len(self._inputs) - len(said)
        if room < 0:
            raise _FullError
        ahead = [*said[same:], *rest[:room]]
        self.passes += 1
        if not self._states:
            self._states = list(self._decoder.begin(self._inputs, ahead, reduced=True))
            if self._prefilled is not None:
                self._prefilled()
        else:
            self._decoder.rewind(len(self._inputs) + same)
            self._states[same + 1 :] = list(self._decoder.advance(ahead))
        self._fed[same:] = ahead
        return self._states[len(said)]

    def refined(self) -> bool:
        """Run all tokens through again in full precision; False where they have it."""
        if not self._decoder.is_reduced:
            return False
        self.passes += 1
        self.close_calls += 1
        self._states = list(self._decoder.begin(self._inputs, self._fed))
        return True

    def _anew(self, said: list[int]) -> Tensor:
        if len(self._inputs) + len(said) > self._decoder.longest:
            raise _FullError
        self.passes += 1
        self.close_calls += 1
        self._states = list(self._decoder.begin(self._inputs, said))
        self._fed = list(said)
        return self._states[-1]


class _Draft:
    """The tokens of an expected reply, and where each part begins in them."""

    def __init__(self, text: str, grammar: Grammar, tokens: TextTokens) -> None:
        self._ids: list[int] = []
        self._begins: dict[str, int] = {}
        for segment in match(grammar, text)[0]:
            if segment.name:
                self._begins[segment.name] = len(self._ids)
            self._ids += tokens.of(segment.text)

    def rest(self, said: list[int], name: str, num_said: int) -> Sequence[int]:
        """What to feed along after the reply so far, which is ``num_said`` tokens into a part.

        Within a part that differs it is nothing: where a digit is wrong, those behind it seldom are
        right.
        """
        if self._ids[: len(said)] == said:
            return self._ids[len(said) :]
        begin = self._begins.get(name)
        if begin is None or num_said > 0:
            return ()
        return self._ids[begin:]


class ConstrainedDecoder:
    """Says what a grammar allows.

    Args:
        decoder: Runs the model.
        tokens: Tokens of texts under the model's tokenizer.
    """

    def __init__(self, decoder: Decoder, tokens: TextTokens) -> None:
        self._decoder, self._tokens = decoder, tokens

    def decode(
        self,
        inputs: Tensor,
        grammar: Grammar,
        *,
        draft: str = "",
        penalties: Mapping[str, float] | None = None,
        doubt_below: Mapping[str, float] | None = None,
        prefilled: Callable[[], None] | None = None,
    ) -> Constrained:
        """Say the most probable text of a grammar, part by part.

        Args:
            inputs: Embeddings of what stands before the reply, shape (T, D).
            grammar: What may be said.
            draft: A whole expected reply; it changes the number of passes alone.
            penalties: Amounts taken from the logits of options, by value [nats]; an infinite one
                excludes its option.
            doubt_below: Probabilities below which a text is said with its rival, by name of its
                part; ``DOUBT_BELOW`` for the others.
            prefilled: Called once, after the first pass.

        Raises:
            TouchError: Penalties exclude every option of a choice.
        """
        run = _Run(
            _States(self._decoder, inputs, prefilled),
            self._tokens,
            _Draft(draft, grammar, self._tokens),
            penalties or {},
            doubt_below or {},
        )
        ended = True
        try:
            run.say(grammar)
        except _FullError:
            ended = False
        return Constrained(
            text="".join(run.texts),
            ids=run.said,
            ended=ended,
            decisions=run.decisions,
            passes=run.states.passes,
            close_calls=run.states.close_calls,
        )


class _Run:
    """One reply while it is being said."""

    def __init__(
        self,
        states: _States,
        tokens: TextTokens,
        draft: _Draft,
        penalties: Mapping[str, float],
        doubt_below: Mapping[str, float],
    ) -> None:
        self.states, self.tokens, self.draft = states, tokens, draft
        self.penalties, self.doubt_below = penalties, doubt_below
        self.said: list[int] = []
        self.texts: list[str] = []
        self.decisions: dict[str, SlotDecision] = {}
        self._name, self._begin = "", 0

    def say(self, grammar: Grammar) -> None:
        pending: list[Part] = list(reversed(grammar))
        while pending:
            part = pending.pop()
            if isinstance(part, Verbatim):
                self._say_literal(part.text)
                continue
            self._name, self._begin = part.name, len(self.said)
            if isinstance(part, NumberRange):
                self._say_number(part)
                self._say_literal(part.after)
            else:
                pending += reversed(self._say_choice(part).then)

    def _say_literal(self, text: str) -> None:
        self.said += self.tokens.of(text)
        self.texts.append(text)

    def _say_choice(self, part: TextChoice) -> Option:
        """Decide between texts, and say the chosen one, and its rival where it is in doubt."""
        options = [o for o in part.options if self.penalties.get(o.value) != math.inf]
        if not options:
            raise TouchError(f"every option of {part.name} is excluded; leave at least one")
        begin = len(self.said)
        threshold = self.doubt_below.get(part.name, DOUBT_BELOW)
        walk = self._walk(options, threshold)
        if walk.is_close and self.states.refined():
            del self.said[begin:]
            walk = self._walk(options, threshold)
        if walk.is_close:
            del self.said[begin:]
            walk = self._walk(options, threshold, anew=True)
        chosen = options[walk.chosen]
        self.texts.append(chosen.text)
        rival = ""
        left = max(_rivals(options, chosen, walk.left), default=None, key=lambda one: one.mass)
        if left is not None and walk.mass < threshold:
            others = [options[index] for index in left.inside]
            index = self._descend(tuple(other.rival for other in others))
            rival = others[index].value
            self.texts.append(others[index].rival)
        self.decisions[part.name] = SlotDecision(
            name=part.name,
            chosen=chosen.value,
            probability=walk.mass,
            rival=rival,
            probabilities={chosen.value: walk.mass}
            | {"|".join(options[i].value for i in inside): mass for mass, inside in walk.left},
        )
        return chosen

    def _walk(self, options: list[Option], threshold: float, *, anew: bool = False) -> _Walk:
        """Go down the trie of some options by the likeliest token each time, and say it."""
        node, mass = self.tokens.trie(tuple(option.text for option in options)), 1.0
        left: list[_Left] = []
        is_close = False
        while node.ended is None:
            followers = list(node.children.items())
            if len(followers) > 1:
                logits = self._scores([token for token, _ in followers], anew=anew)
                scores = [
                    logit - self._penalty(options, below)
                    for logit, (_, below) in zip(logits, followers, strict=True)
                ]
                is_close |= _lead(scores) < self.states.close
                best, fractions = _softmax(scores)
                left += [
                    _Left(mass * fraction, n.inside)
                    for i, ((_, n), fraction) in enumerate(zip(followers, fractions, strict=True))
                    if i != best
                ]
                mass *= fractions[best]
            else:
                best = 0
            self.said.append(followers[best][0])
            node = followers[best][1]
        rivals = _rivals(options, options[node.ended], left)
        if rivals:
            close = self.states.close
            is_close |= abs(mass - threshold) < close / 4  # a probability moves by that at most
            if mass < threshold:
                is_close |= _lead([math.log(max(one.mass, 1e-30)) for one in rivals]) < close
        return _Walk(node.ended, mass, left, is_close)

    def _penalty(self, options: list[Option], node: Node) -> float:
        """Penalty of a token: of the one option that it leaves."""
        if len(node.inside) > 1:
            return 0.0
        return self.penalties.get(options[node.inside[0]].value, 0.0)

    def _descend(self, texts: tuple[str, ...]) -> int:
        """Say the likeliest of some texts by the likeliest token each time; its index."""
        node = self.tokens.trie(texts)
        while node.ended is None:
            token, _ = self._likeliest(list(node.children))
            self.said.append(token)
            node = node.children[token]
        return node.ended

    def _say_number(self, part: NumberRange) -> None:
        """Decide a number digit by digit, and whether it is the low end of an interval."""
        node, second = self.tokens.number(part)
        end = self.tokens.of(part.after)[0] if part.after else None
        low, mass = -1, 1.0
        value = ""
        while True:
            followers = {t: n for t, n in node.children.items() if n.most > low}
            is_whole = node.ended is not None and node.ended > low
            is_low = is_whole and part.interval and not value
            if is_low:
                high = {t: n for t, n in second.children.items() if n.most > _index(node)}
                followers |= high
            tokens = [*followers, end] if is_whole and end is not None else list(followers)
            token, fraction = self._likeliest(tokens) if tokens else (end, 1.0)
            mass *= fraction
            if token is None or (is_whole and token == end):
                break  # before a number is whole, a token such as ' ' may begin it and what follows
            if is_low and token in high:
                low = _index(node)
                value = f"{part.texts[low]}-"
            self.said.append(token)
            node = followers[token]
        value += part.texts[_index(node)]
        self.texts.append(f" {value}")
        self.decisions[part.name] = SlotDecision(
            name=part.name,
            chosen=value,
            probability=mass,
            rival="",
            probabilities={value: mass},
        )

    def _likeliest(self, tokens: Sequence[int]) -> tuple[int, float]:
        """The likeliest of some tokens, and its probability among them."""
        if len(tokens) == 1:
            return tokens[0], 1.0
        scores = self._scores(tokens)
        if _lead(scores) < self.states.close and self.states.refined():
            scores = self._scores(tokens)
        if _lead(scores) < self.states.close:
            scores = self._scores(tokens, anew=True)
        best, fractions = _softmax(scores)
        return tokens[best], fractions[best]

    def _scores(self, tokens: Sequence[int], *, anew: bool = False) -> list[float]:
        """Logits of some tokens behind the reply so far."""
        num_said = len(self.said) - self._begin
        rest = None if anew else self.draft.rest(self.said, self._name, num_said)
        return self.states.scores(self.said, tokens, rest)


def _index(node: Node) -> int:
    """Index of the text that ends at a place where one does."""
    if node.ended is None:
        raise ValueError("no text ends here")
    return node.ended


def _rivals(options: list[Option], chosen: Option, left: list[_Left]) -> list[_Left]:
    """What may be said as the rival of an option, of what the walk left aside."""
    if not chosen.rival:
        return []
    groups = (_Left(mass, [i for i in inside if options[i].rival]) for mass, inside in left)
    return [group for group in groups if group.inside]


def _softmax(scores: list[float]) -> tuple[int, list[float]]:
    """Index of the highest score, the first of equal ones, and the softmax of all."""
    highest = max(scores)
    weights = [math.exp(score - highest) for score in scores]
    total = sum(weights)
    return scores.index(highest), [weight / total for weight in weights]


def _lead(scores: list[float]) -> float:
    """Difference of the two highest scores."""
    if len(scores) < 2:
        return math.inf
    second, first = sorted(scores)[-2:]
    return first - second
