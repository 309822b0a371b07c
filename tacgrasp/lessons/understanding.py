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
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import islice
from typing import Protocol

import numpy as np
import torch
from torch import Tensor

from cltp.llm.constrained.grammar import Grammar
from cltp.llm.generation import Reply
from tacgrasp.lessons.dialogue.calculations.borders import farther_border
from tacgrasp.lessons.dialogue.calculations.calculated import calculated
from tacgrasp.lessons.dialogue.calculations.suppositions import begins_supposed
from tacgrasp.lessons.dialogue.choices.choosing import chosen
from tacgrasp.lessons.dialogue.choices.named import loosely_named
from tacgrasp.lessons.dialogue.choices.own_words import in_its_words
from tacgrasp.lessons.dialogue.clauses.clauses import clauses_of, judged_as_one, unfelt
from tacgrasp.lessons.dialogue.clauses.replies import replied
from tacgrasp.lessons.dialogue.clauses.speech import asked_in_speech
from tacgrasp.lessons.dialogue.clauses.verdicts import is_doubted_statement
from tacgrasp.lessons.dialogue.clauses.worded_amounts import in_class_words, without_remark
from tacgrasp.lessons.dialogue.conditions import check_of, number_text
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.families.catalogue import understand
from tacgrasp.lessons.dialogue.families.misspelled import (
    compared_aright,
    compares_unread,
    respelled,
)
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    Calculated,
    Check,
    Meaning,
    Several,
    Unknowable,
)
from tacgrasp.lessons.dialogue.plainer import (
    about_its_topic,
    in_words,
    is_denied_first,
    plainer,
    with_plain_numbers,
)
from tacgrasp.lessons.dialogue.query import (
    asked_text,
    query_grammar,
    query_of,
    read_query,
)
from tacgrasp.lessons.dialogue.rewordings.expressed import expressed
from tacgrasp.lessons.dialogue.rewordings.reworded import reworded
from tacgrasp.lessons.dialogue.rules.advised import advised, step_asked
from tacgrasp.lessons.dialogue.rules.elsewhere import of_elsewhere, of_gripper, of_outcome
from tacgrasp.lessons.dialogue.rules.friction import frictional
from tacgrasp.lessons.dialogue.rules.members import member_of, verdict_of
from tacgrasp.lessons.dialogue.rules.regions import of_region
from tacgrasp.lessons.dialogue.rules.reported import reported
from tacgrasp.lessons.dialogue.rules.ruled import ruled_whole
from tacgrasp.lessons.dialogue.rules.unread import is_beyond
from tacgrasp.lessons.dialogue.sided_questions import to_named_side
from tacgrasp.lessons.dialogue.written_units import (
    in_asked_unit,
    numbers_in_units,
    with_counted_parts,
)
from tacgrasp.lessons.divided_questions import divided
from tacgrasp.lessons.joined_questions import (
    asked_apart,
    asked_together,
    either_of,
    is_either,
    read_part,
    with_adjective,
)
from tacgrasp.lessons.query_classifier import QueryOdds
from tacgrasp.lessons.question_form import (
    alone_asked,
    begins_as_one,
    denied_statement,
    in_usual_order,
    is_one_clause,
    is_unlikely,
    last_asked,
    wanted_instead,
    with_number_before,
    without_aside,
    without_topic,
)
from tacgrasp.lessons.read_question import ReadQuestion
from tacgrasp.lessons.rounded_questions import Rounding, rounded_step, rounding_of

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

CALCULATED_CONFIDENCE = 0.97
"""Confidence in the terms that were read of a question: of 736 blind questions 98 % were read
rightly, and of 126 that had not been looked at 97.6 %."""

LIKELIEST, LONGER, MANY_PARTS, SURE = 0.88, -0.87, -1.55, 3.3
"""Weights of what tells whether a query is the right one: the log odds of its probability among
those named, the logarithm of the number of words, and whether it has several parts. Fitted by
logistic regression to 1,475 blind questions that the grammar lacks; right ones have a higher
confidence than wrong ones in 84 % of pairs (five-fold cross-validation), by the probability alone
in 77 %."""

UNREAD_CONFIDENCE = 0.5
"""Most confidence in a number that is read as 'about that' where the question compares with it in
words that nothing reads, and the other way round. Our choice, below ``answering.UNSURE_BELOW``."""

_ABOUT_NUMBER = re.compile(r"\b(?:about|around|roughly|approx(?:imately)?|circa|ca\.?) ?\d", re.I)
_THRESHOLD = re.compile(r"check (?:not )?[a-z_ ]+ [<>]=? .+")

_EITHER = re.compile(r"\beither\b", re.I)


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


def understood(writer: QueryWriter, question: str, before: str = "") -> ReadQuestion | None:
    """What a question means; None where neither grammar nor model comes to a query.

    Args:
        writer: The model, which is asked where the grammar has not the wording.
        question: The question.
        before: The question before it, where it follows one; ''.
    """
    return understood_by_grammar(question, before) or understood_by_model(writer, question, before)


LONGEST = 2000
"""Characters of a question beyond which no wording is looked for; the grammar's have 200. Ten
thousand words would take a minute and a half."""


def understood_by_grammar(question: str, before: str = "") -> ReadQuestion | None:
    """What a question means by the grammar; None where it has not the wording.

    Some of its wordings (``MOST_JOINED`` at most) that are joined by a comma, 'and' or a question
    mark are asked together.
    """
    if len(question) > LONGEST:
        return None
    if written := expressed(question):
        return ReadQuestion(query_of(written), written, CALCULATED_CONFIDENCE)
    question = compared_aright(with_plain_numbers(question))
    said = reworded(question)
    if said and (read_so := understood_by_grammar(said, before)):
        return read_so
    if rounding := rounding_of(question):
        return _rounded(understood_by_grammar(rounding.question, before), rounding)
    if stated := denied_statement(question):
        return _denied(understood_by_grammar(f"Is it true that {stated}", before), question)
    wanted = wanted_instead(question)
    if wanted and (instead := understood_by_grammar(wanted, before)):
        return instead
    alone = without_remark(question)
    if alone and (in_words_alone := understood_by_grammar(alone, before)):
        return _in_class_words(in_words_alone)
    question = about_its_topic(in_words(question))
    plain = plainer(question)
    is_denied = is_denied_first(question) and not is_denied_first(plain)
    # 'isn't more than 1 N felt' would be read as 'is not more than 1 N felt'
    if is_denied and (affirmed := understood_by_grammar(plain, before)):
        return affirmed
    meaning = None if before else of_elsewhere(question) or reported(question)
    if meaning is None and is_doubted_statement(question):
        meaning = judged_as_one(question)
    meaning = meaning or with_adjective(question) or either_of(question) or step_asked(question)
    meaning = meaning or verdict_of(question)
    meaning = meaning or understand(question, before=before)
    if not before and isinstance(meaning, Unknowable):
        # 'is it a square' is no question for a name, 'is it in the corner' for its surroundings
        meaning = ruled_whole(plain) or of_region(question) or meaning
    if not before and meaning is None:
        meaning = of_gripper(question)
    if not before and meaning is None and _EITHER.search(question):
        meaning = ruled_whole(question)  # plainer text has no 'either'
    in_usual = with_counted_parts(question, as_usual=True)
    if meaning is None and in_usual != question:
        meaning = understand(in_usual, before=before)
    if meaning is None and plain != question and plainer(plain) != question:
        # 'is 3 N more than 5 N' is plainly 'is 5 N less than 3 N', and that the first again
        return understood_by_grammar(plain, before)
    if meaning is None and not before:
        meaning = _composed(question)
    if meaning is None:
        return _by_other_words(question, before)
    asked = asked_text(question, before)
    try:
        query = query_of(meaning, asked.numbers)
    except ValueError:  # it has a number that is no number of the question: 'half a kilo'
        return None
    query = _as_told(query, asked.words)
    if not query:
        return None
    read = read_query(query, asked.numbers)
    if read is None:
        return None
    parts = read.parts if isinstance(read, Several) else (read,)
    is_calculated = any(isinstance(part, Calculated) for part in parts)
    sure = CALCULATED_CONFIDENCE if is_calculated else 1.0
    return _in_its_words(question, _as_one(question, ReadQuestion(query, read, sure)))


def _composed(question: str) -> Meaning | None:
    """What a question means by the first reader that accounts for all of it."""
    return (
        farther_border(question)
        or frictional(question)
        or advised(question)
        or of_region(question)
        or member_of(question)
        or replied(question)
        or (calculated(question) if begins_supposed(question) else None)
        or chosen(question)
        or judged_as_one(question)
        or asked_together(question)
        or ruled_whole(question)
        or calculated(question)
        or clauses_of(question, read_part)
        or asked_apart(question, _read_alone)
    )


def _read_alone(question: str) -> Meaning | None:
    """What a question that begins as one means: by the grammar, a rule, or as a calculation."""
    return (read_part(question) or calculated(question)) if begins_as_one(question) else None


def _by_other_words(question: str, before: str) -> ReadQuestion | None:
    """What a question means by the grammar once slips, or remarks beside it, are taken out."""
    for plain in (respelled(question), alone_asked(question), without_aside(question)):
        if plain != question:
            return understood_by_grammar(plain, before)
    if before:
        return None
    if pointed := with_number_before(question):
        return understood_by_grammar(pointed)
    if ordered := in_usual_order(question):
        return understood_by_grammar(ordered)
    alone, topic = without_topic(question)
    if topic and (read := understood_by_grammar(alone)) and topic in read.query:
        return read
    told = (understood_by_grammar(each) for each in asked_in_speech(question))
    if told_alone := next((read for read in told if read is not None), None):
        return told_alone
    if (last := last_asked(question)) and (asked_last := understood_by_grammar(last)):
        return asked_last
    if choice := loosely_named(question):
        return ReadQuestion(query_of(choice), choice, CALCULATED_CONFIDENCE)
    if (meaning := unfelt(question) or of_outcome(question)) is None:
        return None
    return ReadQuestion(query_of(meaning), meaning, CALCULATED_CONFIDENCE)


def understood_by_model(
    writer: QueryWriter, question: str, before: str = ""
) -> ReadQuestion | None:
    """What a question means to model and classifier; None where they come to no query."""
    return doubted(question, read_by_model(writer, question, before))


def doubted(question: str, read: ReadQuestion | None) -> ReadQuestion | None:
    """What was read by the model, with the probability that it is the right query."""
    if read is None:
        return None
    likely = min(max(read.confidence, 1e-3), 1 - 1e-3)
    odds = SURE + LIKELIEST * math.log(likely / (1 - likely))
    odds += LONGER * math.log(max(len(question.split()), 1))
    odds += MANY_PARTS * isinstance(read.meaning, Several)
    sure = 1 / (1 + math.exp(-odds))
    if " about " in read.query and compares_unread(compared_aright(question)):
        sure = min(sure, UNREAD_CONFIDENCE)
    if _ABOUT_NUMBER.search(question) and _THRESHOLD.fullmatch(read.query):
        sure = min(sure, UNREAD_CONFIDENCE)
    return read._replace(confidence=sure)


def read_by_model(writer: QueryWriter, question: str, before: str = "") -> ReadQuestion | None:
    """What model and classifier read, with the query's probability among those that they name."""
    if asked_alone := without_remark(question):
        read = read_by_model(writer, asked_alone, before)
        return read and _in_class_words(read)
    question = respelled(compared_aright(question))
    question = reworded(question) or question
    if rounding := rounding_of(question):
        return _rounded(read_by_model(writer, rounding.question, before), rounding)
    if is_beyond(question):
        return None
    if stated := denied_statement(question):
        affirmed = read_by_model(writer, f"Is it true that {stated}", before)
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
    if not before:
        by_model = partial(read_by_model, writer)
        read = divided(plain, read, understood_by_grammar, by_model) or read
    return _in_its_words(plain, _as_one(plain, read))


def _in_class_words(read: ReadQuestion) -> ReadQuestion:
    """What was read, answered by words for depth and area."""
    query = in_class_words(read.query)
    meaning = None if query == read.query else read_query(query)
    return read if meaning is None else read._replace(query=query, meaning=meaning)


def _rounded(read: ReadQuestion | None, how: Rounding) -> ReadQuestion | None:
    """What was read, with its number rounded."""
    step = rounded_step(read.meaning, how) if read else 0.0
    if read is None or not isinstance(read.meaning, Amount | Calculated) or not step:
        return read
    meaning = replace(read.meaning, step=step)
    return read._replace(query=f"{read.query[:-1]} to {number_text(step)}.", meaning=meaning)


def _as_told(query: str, words: str) -> str:
    """A query with the side and the unit that the question names; '' where it has no such unit."""
    return in_asked_unit(to_named_side(query, words), words)


def _in_its_words(question: str, read: ReadQuestion) -> ReadQuestion:
    """What was read, to be answered with the question's word where that names alternatives."""
    meaning = in_its_words(question, read.meaning)
    query = query_of(meaning) if isinstance(meaning, Calculated) else read.query
    return read._replace(query=query, meaning=meaning)


def _denied(read: ReadQuestion | None, question: str) -> ReadQuestion | None:
    """What asks whether a condition does not hold; None where none was read."""
    if read is not None and isinstance(read.meaning, Calculated) and read.meaning.unit is None:
        if Expression(read.meaning.truth).choices:
            return None
        opposite = Calculated(truth=f"not ({read.meaning.truth})", unit=None)
        return ReadQuestion(query_of(opposite), opposite, read.confidence)
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
