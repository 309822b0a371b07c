"""What a question means: by the grammar where that has the wording, else by the language model.

The grammar (``tacgrasp.lessons.dialogue.families``) says exactly what its wordings mean. For every
other one the model, which learned from them, writes a query under the grammar of queries
(``tacgrasp.lessons.dialogue.query``), without any touch: what a question asks for does not hang on
the contact. A classifier of questions (``tacgrasp.lessons.query_classifier``) names others, and the
query is taken whose probabilities by both have the largest weighted geometric mean, less where the
form of the question speaks against it (``tacgrasp.lessons.question_form``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from statistics import NormalDist
from typing import NamedTuple, Protocol

import numpy as np
import torch
from torch import Tensor

from cltp.llm.constrained.grammar import Grammar
from cltp.llm.generation import Reply
from policies.llm.text import DOUBTFUL_RATIO
from tacgrasp.lessons.dialogue.answers import Answer, answer
from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.families.catalogue import understand
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    AnswerKind,
    Check,
    Meaning,
    Several,
    names_of,
    truth_of,
)
from tacgrasp.lessons.dialogue.plainer import (
    in_words,
    is_denied_first,
    plainer,
)
from tacgrasp.lessons.dialogue.query import (
    asked_text,
    query_grammar,
    query_of,
    read_query,
)
from tacgrasp.lessons.dialogue.rules.unread import is_beyond
from tacgrasp.lessons.dialogue.scene import AskedScene
from tacgrasp.lessons.dialogue.scoring.tolerances import tolerance_of
from tacgrasp.lessons.dialogue.sided_questions import to_named_side
from tacgrasp.lessons.dialogue.written_units import in_asked_unit, numbers_in_units
from tacgrasp.lessons.joined_questions import (
    JOINT,
    MOST_JOINED,
    MOST_JOINTS,
    REQUEST,
    asked_together,
    is_either,
    joinable,
    joined,
    read_part,
    together,
    with_adjective,
)
from tacgrasp.lessons.query_classifier import QueryOdds
from tacgrasp.lessons.question_form import denied_statement, is_one_clause, is_unlikely

PROBABLY_BELOW = 0.6
"""Probability of a word below which an answer says 'probably'. As in D_t."""

SURE_FROM = 0.9
"""Fraction of the numbers that may be true, under which an answer must hold to be said without
'probably'. As many lie in their intervals."""

UNSURE_BELOW = 0.4
"""Probability of a query below which the answer says that another question may have been meant. Our
choice: of so unsure readings of the kept-out questions every second is wrong."""

UNSURE = "Perhaps you meant something else."

DRAWS = 64
"""Numbers that may be true, for each answer. Our choice: a tenth of them is six."""

_NORMAL = NormalDist()
_STEPS = [
    _NORMAL.inv_cdf((number + 0.5) / DRAWS) / _NORMAL.inv_cdf(0.95) for number in range(DRAWS)
]
"""Quantiles of a normal distribution, with the end of an interval at 1."""

NAMED = 12
"""Queries that the classifier names beside the model's. Our choice: the right one is seldom a
later one."""

LEAST_LOG = -5.0
"""Log-probability that counts as none: neither model nor classifier excludes a query alone. Our
choice, of -4 to -12, on questions that are not the kept-out ones."""

WRITERS_PART = 0.4
"""Weight of the language model's log-probability of a query; the classifier has the rest. Our
choice, by 220 wordings of two people that neither has learned from."""

UNLIKELY_LOG = -2.0
"""What a query loses that the question's form speaks against. Our choice; -1 to -5 do alike."""

FOLLOW_UP_WORDS = 5
"""Longest question [words] that may be a follow-up without beginning as one. Our choice."""

ALONE_FROM = 0.5
"""Confidence from which a question that does not begin as a follow-up is none. Our choice."""

SIGNED = ("x_mm", "y_mm")
"""Numbers of a contact that may be below 0."""

_FOLLOWS = re.compile(r"(?:and|but|then|why|how come|what about|how about|same)\b", re.I)

_STANDS_ALONE = re.compile(
    r"(?:is|are|isn't|aren't|was|were|does|do|did|has|have|had|can|could|will|would|shall|should|may|might|must)"
    r"(?: \S+){2}",
    re.I,
)
"""A question with subject and verb: 'Is it round?' follows nothing, 'Is it?' may."""

NOT_UNDERSTOOD = "I don't understand the question."


class QueryWriter(Protocol):
    """What writes queries; ``cltp.llm.generation.Talker`` is one."""

    @property
    def width(self) -> int:
        """Width of its embeddings."""
        ...

    def reply_to(self, touch: Tensor, prompt: str, *, grammar: Grammar) -> Reply:
        """Reply to a prompt behind touch embeddings, here none."""
        ...

    def log_likelihoods(self, prompt: str, replies: Sequence[str]) -> list[float]:
        """Log-probabilities of whole replies to a prompt without touch."""
        ...


class ReadQuestion(NamedTuple):
    """What a question means.

    Attributes:
        query: It as a query.
        meaning: The query's meaning.
        confidence: Probability of the query among those that model or classifier name; 1 by the
            grammar.
    """

    query: str
    meaning: Meaning
    confidence: float


def understood(writer: QueryWriter, question: str, before: str = "") -> ReadQuestion | None:
    """What a question means; None where neither grammar nor model comes to a query.

    Args:
        writer: The model, which is asked where the grammar has not the wording.
        question: The question.
        before: The question before it, where it follows one; ''.
    """
    return understood_by_grammar(question, before) or understood_by_model(writer, question, before)


def understood_by_grammar(question: str, before: str = "") -> ReadQuestion | None:
    """What a question means by the grammar; None where it has not the wording.

    Some of its wordings (``MOST_JOINED`` at most) that are joined by a comma, 'and' or a question
    mark are asked together.
    """
    if stated := denied_statement(question):
        return _denied(understood_by_grammar(f"Is it true that {stated}", before), question)
    question = in_words(question)
    plain = plainer(question)
    is_denied = is_denied_first(question) and not is_denied_first(plain)
    # 'isn't more than 1 N felt' would be read as 'is not more than 1 N felt'
    if is_denied and (affirmed := understood_by_grammar(plain, before)):
        return affirmed
    meaning = with_adjective(question) or understand(question, before=before)
    if meaning is None and plain != question:
        return understood_by_grammar(plain, before)
    if meaning is None and not before:
        meaning = asked_together(question)
    if meaning is None:
        return None
    asked = asked_text(question, before)
    try:
        query = query_of(meaning, asked.numbers)
    except ValueError:  # it has a number that is no number of the question: 'half a kilo'
        return None
    query = _as_told(query, asked.words)
    if not query:
        return None
    read = read_query(query, asked.numbers)
    return None if read is None else _as_one(question, ReadQuestion(query, read, 1.0))


def understood_by_model(
    writer: QueryWriter, question: str, before: str = ""
) -> ReadQuestion | None:
    """What a question means to model and classifier; None where they come to no query."""
    if is_beyond(question):
        return None
    if stated := denied_statement(question):
        affirmed = understood_by_model(writer, f"Is it true that {stated}", before)
        if denied := _denied(affirmed, question):
            return denied
    plain = plainer(question)
    asked = asked_text(plain, before)
    grammar = query_grammar(len(asked.numbers))
    reply = writer.reply_to(torch.zeros(0, writer.width), asked.words, grammar=grammar)
    if not reply.ended:
        return None
    odds = QueryOdds(asked.words)
    queries = dict.fromkeys((reply.text, *islice(odds.likeliest(), NAMED)))
    possible = [
        (query, meaning)
        for query in queries
        if (numbers := numbers_in_units(query, asked.words, asked.numbers)) is not None
        and (meaning := read_query(query, numbers)) is not None
    ]
    if not possible:
        return None
    written = writer.log_likelihoods(asked.words, [query for query, _ in possible])
    logs = [
        WRITERS_PART * max(log, LEAST_LOG)
        + (1 - WRITERS_PART) * max(odds.of(query), LEAST_LOG)
        + (UNLIKELY_LOG if is_unlikely(plain, query) and not before else 0.0)
        for (query, _), log in zip(possible, written, strict=True)
    ]
    weights = np.exp(np.array(logs) - max(logs))
    best = int(weights.argmax())
    query, meaning = possible[best]
    told = _as_told(query, asked.words)
    if not told:
        return None
    if told != query:
        numbers = numbers_in_units(told, asked.words, asked.numbers)
        query, meaning = told, read_query(told, numbers or asked.numbers) or meaning
    read = ReadQuestion(query, meaning, confidence=float(weights[best] / weights.sum()))
    partly = None if before else _partly_known(writer, plain, read.confidence)
    return _as_one(plain, partly if partly and _asks_more(partly, read) else read)


def _as_told(query: str, words: str) -> str:
    """A query with the side and the unit that the question names; '' where it has no such unit."""
    return in_asked_unit(to_named_side(query, words), words)


def _partly_known(writer: QueryWriter, question: str, confidence: float) -> ReadQuestion | None:
    """What wordings of the grammar and one that it lacks ask together; None of others.

    A comma alone may stand before an addition: 'the force, in plain newtons'.
    """
    question = REQUEST.sub("", question, count=1)
    joints = [joint for joint in JOINT.finditer(question) if joint[0].strip() != ","]
    for joint in reversed(joints[:MOST_JOINTS]):
        begin, end = question[: joint.start()], question[joint.end() :]
        for known, lacked in ((begin, end), (end, begin)):
            parts = joinable(read_part(known)) or joined(known, MOST_JOINED - 1)
            other = understood_by_model(writer, lacked) if parts else None
            if other is None or other.confidence < ALONE_FROM:
                continue
            others = joinable(other.meaning)
            meaning = together(parts + others if known == begin else others + parts)
            try:
                query = query_of(meaning, asked_text(question).numbers)
            except ValueError:
                continue
            return ReadQuestion(query, meaning, min(confidence, other.confidence))
    return None


def _asks_more(joined: ReadQuestion, read: ReadQuestion) -> bool:
    """Whether a reading has all parts of another one, and more."""
    parts, fewer = (set(each.query.rstrip(".").split("; ")) for each in (joined, read))
    return fewer < parts


def _denied(read: ReadQuestion | None, question: str) -> ReadQuestion | None:
    """What asks whether a condition does not hold; None where none was read."""
    if read is None or not isinstance(check := read.meaning, Check) or not check.test:
        return None
    meaning = check_of(check.test, denied=not check.denied, length=check.length)
    query = query_of(meaning, asked_text(question).numbers)
    return ReadQuestion(query, meaning, read.confidence)


def _as_one(question: str, read: ReadQuestion) -> ReadQuestion:
    """One yes or no for conditions that one clause asks about: 'Is it round and smooth?'."""
    meaning = read.meaning
    if not isinstance(meaning, Several) or not is_one_clause(question):
        return read
    checks = [part for part in meaning.parts if isinstance(part, Check) and not part.needed_n]
    if len(checks) < len(meaning.parts):
        return read
    shown = (name for check in checks for name in check.shows)
    both = Check(
        condition=(" or " if is_either(question) else " and ").join(
            f"({check.condition})" for check in checks
        ),
        shows=tuple(dict.fromkeys(shown)),
    )
    return read._replace(meaning=both)


def understood_in_turn(writer: QueryWriter, question: str, before: str) -> ReadQuestion | None:
    """What a question means after another one.

    One that begins as follow-ups do, or that the grammar has as one, is read behind the question
    before it. So is another short one, without a verb of its own, where it means little alone, and
    that gives the likelier query.
    """
    if not before:
        return understood(writer, question)
    if _FOLLOWS.match(question):
        return understood(writer, question, before)
    known = understood_by_grammar(question) or understood_by_grammar(question, before)
    if known is not None:
        return known
    alone = understood_by_model(writer, question)
    stands_alone = alone is not None and alone.confidence >= ALONE_FROM
    stands_alone = stands_alone or bool(_STANDS_ALONE.match(question))
    if stands_alone or len(question.split()) > FOLLOW_UP_WORDS:
        return alone
    behind = understood_by_model(writer, question, before)
    read = [each for each in (alone, behind) if each is not None]
    return max(read, key=lambda each: each.confidence, default=None)


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
    told = [(words or {}).get(name, 1.0) for name in names_of(asked.meaning)]
    interval, holds, holds_well = None, 1.0, True
    if given.decidable and given.value is not None and scene.state.in_contact and ends:
        scenes = list(_possible(scene, ends))
        values = [answer(asked.meaning, each).value for each in scenes]
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
    if not isinstance(meaning, Amount):
        return 1.0
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
    return f"{word} {given.text[:1].lower()}{given.text[1:]}"
