"""What the model says of single contacts with a part of its input changed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from torch import Tensor

from cltp.encoder.readings import HeadReadings
from cltp.llm.constrained.grammar import Grammar
from cltp.llm.generation import Felt, Reply, Talker
from cltp.tactile.states import CLASSES
from policies.errors import PolicyError
from policies.llm.grammar import step_grammar
from policies.llm.parse import ParsedReply, parse_reply
from policies.llm.text import step_request
from tacgrasp.lessons.dialogue.scene import AskedScene
from tacgrasp.lessons.question_draws import draw_contract
from tacgrasp.training.ablation.touch_parts import Misreading, touch_parts
from tacgrasp.training.question_evaluation import FeltContact

CORRUPTED_EVERY = 5
"""A head is made to misread one contact of so many."""


class Replier(Protocol):
    """What replies: a ``cltp.llm.generation.Talker``, or one that stands in for it."""

    def feel(self, points: NDArray[np.float32]) -> Felt:
        """Encode one contact, points of shape (N, 3) scaled."""
        ...

    def reply_to(self, touch: Tensor, prompt: str, *, grammar: Grammar | None = None) -> Reply:
        """Reply about one contact that is felt."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class AskedStep:
    """One contact under a goal.

    Attributes:
        points: Shape (N, 3), scaled.
        scene: The truth, with a contract.
        prompt: What the model is asked.
    """

    points: NDArray[np.float32]
    scene: AskedScene
    prompt: str

    @property
    def grammar(self) -> Grammar:
        """What may be replied."""
        assert self.scene.contract is not None
        return step_grammar(None, self.scene.contract.terms.force_n)

    @property
    def action(self) -> str:
        """The teacher's advice on the truth, as an action token."""
        advice = self.scene.advice
        return f"<{advice.action if advice is not None and advice.action else 'none'}>"

    def word(self, dimension: str) -> str | None:
        """The true word of a dimension; None without contact, or where nobody named it."""
        word = getattr(self.scene.state, dimension)
        return None if word is None or not self.scene.state.in_contact else str(word)


def draw_steps(contacts: Sequence[FeltContact], seed: int) -> list[AskedStep]:
    """Contacts, each under a goal near its force."""
    rng = np.random.default_rng([seed, 43])
    steps = []
    for contact in contacts:
        contract = draw_contract(contact.scene.state, rng)
        terms = contract.terms
        steps.append(
            AskedStep(
                points=contact.points,
                scene=replace(contact.scene, contract=contract),
                prompt=step_request(terms.force_n, terms.limit_n),
            )
        )
    return steps


def score_replies(steps: Sequence[AskedStep], replies: Sequence[Reply]) -> dict[str, Any]:
    """Figures of replies to steps, None where there is no such step.

    ``words``: by dimension, the fraction whose first word is the true one; ``named``: whose words
    have the true one among them. ``actions``: the fraction whose action is the teacher's.
    ``doubtful``: the fraction with a word in doubt or an interval. ``read``: the fraction that is a
    D_t at all.
    """
    said = [_parsed(reply.text) for reply in replies]
    pairs = list(zip(steps, said, strict=True))
    return {
        "words": {name: _fraction(_first_right(pairs, name)) for name in CLASSES},
        "named": {name: _fraction(_named(pairs, name)) for name in CLASSES},
        "actions": _fraction(
            [reply.action == step.action for step, reply in zip(steps, replies, strict=True)]
        ),
        "doubtful": _fraction([each is not None and _is_doubtful(each) for each in said]),
        "read": _fraction([each is not None for each in said]),
    }


def score_misreadings(talker: Talker, steps: Sequence[AskedStep]) -> dict[str, Any]:
    """Whether the model still says the true word where the head of its dimension misreads.

    In a fifth of the contacts, each under another dimension in turn, the head reads what it reads
    of another contact with another word. ``right``: the fraction that says the true word first;
    ``right_before``: the same without the misreading; ``follows``: that says the misread word.
    """
    readings = [talker.feel(step.points).readings for step in steps]
    counted: list[tuple[bool, bool, bool]] = []
    for step, dimension, misreading, wrong in _misreadings(steps, readings):
        before, after = (_first_said(talker, step, dimension, each) for each in (None, misreading))
        true = step.word(dimension)
        counted.append((before == true, after == true, after == wrong))
    names = ("right_before", "right", "follows")
    columns = zip(*counted, strict=True) if counted else ((), (), ())
    figures = {name: _fraction(list(flags)) for name, flags in zip(names, columns, strict=True)}
    return {"contacts": len(counted)} | figures


def _misreadings(
    steps: Sequence[AskedStep], readings: Sequence[HeadReadings]
) -> Iterator[tuple[AskedStep, str, Misreading, str]]:
    """Steps with the dimension that is misread, how, and the word that the head then reads."""
    dimensions = list(CLASSES)
    for at in range(0, len(steps), CORRUPTED_EVERY):
        place = at // CORRUPTED_EVERY % len(dimensions)
        name = dimensions[place]
        chances = [each.words[place][0] for each in readings]
        words = [CLASSES[name][int(each.argmax())] for each in chances]
        true = steps[at].word(name)
        others = [i for i in (*range(at + 1, len(steps)), *range(at)) if words[i] != true]
        if true is not None and others:
            misreading = Misreading(dimension=name, chances=chances[others[0]])
            yield steps[at], name, misreading, words[others[0]]


def _first_said(
    talker: Talker, step: AskedStep, dimension: str, misreading: Misreading | None
) -> str | None:
    """The first word of a dimension that the model says of a step; None where it says none."""
    touch = touch_parts(talker.model, talker.feel(step.points), misreading).whole
    said = _parsed(talker.reply_to(touch, step.prompt, grammar=step.grammar).text)
    return said.words.get(dimension) if said is not None else None


def _parsed(text: str) -> ParsedReply | None:
    """A reply as D_t; None where it is none, as without a goal."""
    try:
        return parse_reply(text)
    except PolicyError:
        return None


def _is_doubtful(said: ParsedReply) -> bool:
    return bool(said.rivals) or any(low < high for low, high in said.numbers.values())


def _first_right(pairs: Sequence[tuple[AskedStep, ParsedReply | None]], name: str) -> list[bool]:
    return [
        said is not None and said.words.get(name) == step.word(name)
        for step, said in pairs
        if step.word(name) is not None
    ]


def _named(pairs: Sequence[tuple[AskedStep, ParsedReply | None]], name: str) -> list[bool]:
    return [
        said is not None and step.word(name) in (said.words.get(name), said.rivals.get(name))
        for step, said in pairs
        if step.word(name) is not None
    ]


def _fraction(flags: Sequence[bool]) -> float | None:
    return sum(flags) / len(flags) if flags else None
