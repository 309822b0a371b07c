"""The answer to a question whose meaning is known, with its doubt: of the question, of the touch.

Numbers that may be true are drawn from the intervals of what is felt; how many of them give the
same answer is how far it holds.

Not here: what a question means (``tacgrasp.lessons.understanding``), the wording of an answer
(``tacgrasp.lessons.dialogue.answers``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from statistics import NormalDist
from typing import NamedTuple

import numpy as np

from policies.llm.text import DOUBTFUL_RATIO
from tacgrasp.lessons.dialogue.answers import Answer, answer
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import (
    AnswerKind,
    Description,
    Meaning,
    Several,
    names_of,
    truth_of,
)
from tacgrasp.lessons.dialogue.scene import AskedScene
from tacgrasp.lessons.dialogue.scoring.tolerances import tolerance_of
from tacgrasp.lessons.read_question import ReadQuestion

PROBABLY_BELOW = 0.6
"""Probability of a word below which an answer says 'probably'. As in D_t."""

SURE_FROM = 0.9
"""Fraction of the numbers that may be true, under which an answer must hold to be said without
'probably'. As many lie in their intervals."""

UNSURE_BELOW = 0.6
"""Probability of a query below which the answer says that another question may have been meant. Our
choice: of 116 so unsure readings of blind questions every second is wrong."""

UNSURE = "Perhaps you meant something else."

DRAWS = 64
"""Numbers that may be true, for each answer. Our choice: a tenth of them is six."""

_NORMAL = NormalDist()
_STEPS = [
    _NORMAL.inv_cdf((number + 0.5) / DRAWS) / _NORMAL.inv_cdf(0.95) for number in range(DRAWS)
]
"""Quantiles of a normal distribution, with the end of an interval at 1."""

SIGNED = ("x_mm", "y_mm")
"""Numbers of a contact that may be below 0."""

NOT_UNDERSTOOD = "I don't understand the question."


class Answered(NamedTuple):
    """An answer with its confidence.

    Attributes:
        answer: The answer.
        confidence: Probability that the question is understood and the answer right; of a number,
            within its usual tolerance (``tacgrasp.lessons.dialogue.scoring.tolerances``).
        interval: Of a number, what holds it in nine cases of ten, in its unit; None without one.
    """

    answer: Answer
    confidence: float
    interval: tuple[float, float] | None = None


def answered(
    asked: ReadQuestion | None,
    scene: AskedScene,
    words: Mapping[str, float] | None = None,
    ends: Mapping[str, tuple[float, float]] | None = None,
) -> Answered:
    """The answer to a question about what is felt, with the doubt whether it was understood.

    Args:
        asked: What the question means; None where it is not understood.
        scene: The contact as it is felt and said, with the contract and the mass.
        words: Probabilities of the contact's words, by dimension.
        ends: Ends of the intervals of the contact's numbers, by name.
    """
    if asked is None:
        unclear = Answer(text=NOT_UNDERSTOOD, kind=AnswerKind.UNKNOWABLE, decidable=False)
        return Answered(unclear, 0.0)
    told = _answered(asked, scene, words, ends)
    if asked.confidence >= UNSURE_BELOW or not told.answer.decidable:
        return told
    return told._replace(answer=replace(told.answer, text=f"{told.answer.text} {UNSURE}"))


def _answered(
    asked: ReadQuestion,
    scene: AskedScene,
    words: Mapping[str, float] | None,
    ends: Mapping[str, tuple[float, float]] | None,
) -> Answered:
    given = answer(asked.meaning, scene)
    if isinstance(asked.meaning, Several) and given.decidable and scene.state.in_contact:
        return _answered_together(asked, asked.meaning, given, scene, words, ends)
    # a description says the shape too, where there is one
    also = ("shape", "texture") if isinstance(asked.meaning, Description) else ()
    told = [(words or {}).get(name, 1.0) for name in (*names_of(asked.meaning), *also)]
    interval, holds, holds_well = None, 1.0, True
    if given.decidable and given.value is not None and scene.state.in_contact and ends:
        told_of = ((each, answer(asked.meaning, each).value) for each in _possible(scene, ends))
        possible = [(each, value) for each, value in told_of if value is not None]
        scenes, values = [each for each, _ in possible], [value for _, value in possible]
        if given.kind is AnswerKind.NUMBER:
            low, high = np.quantile(
                np.array(values, dtype=np.float64), [0.05, 0.95], method="hazen"
            )
            interval = float(f"{low:.4g}"), float(f"{high:.4g}")
            holds_well = low < 0 or high < DOUBTFUL_RATIO * low
            holds = _near(asked.meaning, scene, scenes)
        else:
            holds = float(np.mean([value == given.value for value in values]))
            holds_well = holds >= SURE_FROM
    if given.decidable and (min(told, default=1.0) < PROBABLY_BELOW or not holds_well):
        given = replace(given, text=_probably(given))
    return Answered(given, asked.confidence * math.prod(told) * holds, interval)


def _answered_together(
    asked: ReadQuestion,
    meaning: Several,
    given: Answer,
    scene: AskedScene,
    words: Mapping[str, float] | None,
    ends: Mapping[str, tuple[float, float]] | None,
) -> Answered:
    """The answer to several questions, with the doubt of each: in its clause and in all."""
    sure = asked._replace(confidence=1.0)
    parts = [_answered(sure._replace(meaning=part), scene, words, ends) for part in meaning.parts]
    confidence = asked.confidence * math.prod(part.confidence for part in parts)
    clauses = given.text.rstrip(".").split("; ")
    if len(clauses) == len(parts):
        for place, (clause, part) in enumerate(zip(clauses, parts, strict=True)):
            if part.answer.text != answer(meaning.parts[place], scene).text:
                doubted = _probably(replace(part.answer, text=f"{clause}."))
                clauses[place] = doubted.rstrip(".") if place == 0 else _uncapital(doubted)
        given = replace(given, text=f"{'; '.join(clauses)}.")
    return Answered(given, confidence)


def _uncapital(text: str) -> str:
    return f"{text[:1].lower()}{text[1:].rstrip('.')}"


def _near(meaning: Meaning, scene: AskedScene, scenes: Sequence[AskedScene]) -> float:
    """Fraction of scenes whose number lies within its usual tolerance of what is felt."""
    truth = Expression(truth_of(meaning))
    said, *values = (float(truth.evaluate(each.values()).value or 0.0) for each in (scene, *scenes))
    largest = tolerance_of(truth.names).of(said)
    return float(np.mean(np.abs(np.array(values) - said) <= largest))


def _possible(scene: AskedScene, ends: Mapping[str, tuple[float, float]]) -> Iterator[AskedScene]:
    """Scenes whose numbers are spread around what is felt, each of them evenly over its quantiles.

    The order in which they meet is drawn, the same each time (Latin hypercube sampling).
    """
    rng = np.random.default_rng(0)
    spread = {}
    for name, (low, high) in ends.items():
        value, steps = getattr(scene.state, name), rng.permutation(_STEPS)
        numbers = value + np.where(steps > 0, (high - value) * steps, (value - low) * steps)
        spread[name] = numbers if name in SIGNED else np.maximum(numbers, 0.0)
    for drawn in zip(*(numbers.tolist() for numbers in spread.values()), strict=True):
        yield replace(scene, state=replace(scene.state, **dict(zip(spread, drawn, strict=True))))


def _probably(given: Answer) -> str:
    """An answer that may be wrong, as text; a yes or no still stands first."""
    if given.kind is AnswerKind.NUMBER and " is " in given.text:
        return given.text.replace(" is ", " is about ", 1)
    if given.kind is AnswerKind.YES_NO:
        verdict, comma, clause = given.text.rstrip(".").partition(",")
        return f"{verdict}, probably:{clause}." if comma else f"{verdict}, probably."
    word = "About" if given.kind is AnswerKind.NUMBER and given.text[:1].isdigit() else "Probably"
    is_code = given.text[1:2].isupper()  # 'STOP'
    return f"{word} {given.text if is_code else given.text[:1].lower() + given.text[1:]}"
