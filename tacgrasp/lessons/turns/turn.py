"""One question of a dialogue after another: what it means, and what the next one follows."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    AnswerKind,
    Calculated,
    Description,
    Meaning,
    OffTopic,
    Unknowable,
    Why,
    kind_of,
    truth_of,
)
from tacgrasp.lessons.dialogue.query import query_of
from tacgrasp.lessons.read_question import ReadQuestion
from tacgrasp.lessons.turns.follow_ups import (
    asks_by_how_much,
    difference_of,
    in_another_unit,
    leaves_unit_out,
    of_advice,
    of_both,
    reason_of,
    with_quantity_of,
)
from tacgrasp.lessons.turns.leads import without_lead
from tacgrasp.lessons.turns.masses import of_another_mass
from tacgrasp.lessons.turns.references import compared_in, of_number
from tacgrasp.lessons.turns.rewriting import noun_of, rewritten, with_noun
from tacgrasp.lessons.turns.supposed import (
    about_the_force,
    changed_force,
    of_changed_force,
    of_supposed_force,
    supposed_in,
    unsupposed,
    with_another_supposition,
)
from tacgrasp.lessons.turns.told import Told, told_in
from tacgrasp.lessons.understanding import (
    CALCULATED_CONFIDENCE,
    QueryWriter,
    doubted,
    read_by_model,
    understood,
    understood_by_grammar,
    understood_by_model,
)

FOLLOW_UP_WORDS = 5
"""Longest question [words] that may be a follow-up without beginning as one. Our choice."""

ALONE_FROM = 0.5
"""Confidence from which a question that does not begin as a follow-up is none. Our choice."""

_FOLLOWS = re.compile(r"(?:and|but|then|why|how come|what about|how about|same)\b", re.I)
_STANDS_ALONE = re.compile(
    r"(?:is|are|isn't|aren't|was|were|does|do|did|has|have|had|can|could|will|would|shall|should|"
    r"may|might|must)(?: \S+){2}",
    re.I,
)
"""A question with subject and verb: 'Is it round?' follows nothing, 'Is it?' may."""

_WHY = re.compile(r"(?:and |but |so )?(?:why(?: not| so| is that)?|how come)[?.! ]*", re.I)
_ASKS_WHY = re.compile(
    r"\b(?:why|how come|how so|reason|because|cause|what makes|explain|how do you know|what for|"
    r"on what|sure|certain|really|based|evidence|justify|grounds)\b",
    re.I,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Turn:
    """A question of a dialogue.

    Attributes:
        read: What it means; None where it came to nothing.
        text: The question as it stands alone, for the next one to follow; '' before the first.
        about: What was last asked for, a word, number or condition; None before the first.
        number: The number that was last asked for; None before the first.
        numbered: The question that asked for it, as it stands alone; ''.
        earlier: The number before that; None likewise.
        of_felt: What was last asked of the force that is felt, not a supposed one; None likewise.
        condition: What was last asked with a yes or no; None before the first.
        earlier_condition: The same before that; None likewise.
        noun: What a pronoun may stand for: 'the limit', where that was asked for; ''.
        told: What the question tells besides: a mass, a band or a limit; None where it tells none.
    """

    read: ReadQuestion | None = None
    text: str = ""
    about: Meaning | None = None
    number: Meaning | None = None
    numbered: str = ""
    earlier: Meaning | None = None
    of_felt: Meaning | None = None
    condition: Meaning | None = None
    earlier_condition: Meaning | None = None
    noun: str = ""
    told: Told | None = None

    def then(
        self,
        text: str,
        read: ReadQuestion | None,
        *,
        is_whole: bool = False,
        is_supposed: bool = False,
    ) -> Turn:
        """The turn after this; what came to nothing, or asks why, is nothing to follow.

        Args:
            text: The next question as it stands alone.
            read: What it means; None where it came to nothing.
            is_whole: Whether it leaves nothing to those before it.
            is_supposed: Whether it asks of a supposed force what was asked of the felt one.
        """
        if read is None or isinstance(read.meaning, Unknowable | OffTopic):
            return replace(self, read=read, text=self.text or text, told=None)
        about = self.about if isinstance(read.meaning, Why | Description) else read.meaning
        noun = noun_of(read.meaning) or ("" if is_whole else self.noun)
        if is_supposed:
            of_felt = self.of_felt
        else:
            of_felt = unsupposed(read.meaning, text) if supposed_in(text) else about
        turn = replace(
            self, read=read, text=text, about=about, of_felt=of_felt, noun=noun, told=None
        )
        kind = kind_of(read.meaning)
        if kind is AnswerKind.YES_NO and read.meaning != self.condition:
            return replace(turn, condition=read.meaning, earlier_condition=self.condition)
        if kind is not AnswerKind.NUMBER or read.meaning == self.number:
            return turn
        return replace(turn, number=read.meaning, numbered=text, earlier=self.number)


_STILL_SO = re.compile(
    r"(?:(?:and|so|ok|but)[, ]+)*(?:now[, ]+)?(?:is (?:it|that) |are we |does (?:it|that) )?still "
    r"(?:enough|ok|okay|fine|true|so|the case|hold|holds|held|good|a sure hold)(?: now| "
    r"then)*[?.! ]*|"
    r"(?:(?:and|so|ok|but)[, ]+)*(?:now|ok now|and now)[?.! ]*",
    re.I,
)
"""'Still enough?', once a mass or a band was told anew."""

_OF_NUMBERS = (AnswerKind.NUMBER, AnswerKind.YES_NO, AnswerKind.CHOICE)
"""Kinds of questions behind which 'that' may be the last number."""


def next_turn(writer: QueryWriter, question: str, before: Turn) -> Turn:
    """What a question of a dialogue means.

    First it is written anew with the words before it, where the grammar reads that. Then the
    meaning before it completes it. Else it is read as it stands, or by the model behind the
    question before it where it is short and means little alone.

    Args:
        writer: The model, which is asked where the grammar has not the wording.
        question: The question.
        before: The turn before it.
    """
    if (telling := _telling(question, before, writer)) is not None:
        return telling
    if not before.text:
        return before.then(question, understood(writer, question))
    if heavier := of_another_mass(question, before.about):
        return before.then(before.text, _read_so(heavier))
    if before.condition is not None and _STILL_SO.fullmatch(question.strip()):
        return replace(before, read=_read_so(before.condition), about=before.condition, told=None)
    if both := of_both(question, before.condition, before.earlier_condition):
        return replace(before, read=_read_so(both), about=both, told=None)
    if (force := changed_force(question)) and (supposed := of_changed_force(force, before.of_felt)):
        text = next(with_another_supposition(question, before.text), before.text)
        return before.then(text, _read_so(supposed), is_supposed=True)
    for text in (
        *rewritten(question, before.text, before.about, before.noun),
        *rewritten(question, before.numbered, before.number, ""),
    ):
        if (telling := _telling(text, before)) is not None:
            return telling
        read = understood_by_grammar(text)
        if read is not None and not isinstance(read.meaning, Unknowable | OffTopic):
            return before.then(text, read)
    if before.about is not None and (read := _by_meaning(question, before, before.about)):
        return before.then(before.text, read)
    if named := with_noun(question, before.noun):
        return before.then(named, understood_by_model(writer, named))
    return _read_behind(writer, question, before)


def _telling(text: str, before: Turn, writer: QueryWriter | None = None) -> Turn | None:
    """A turn that tells something, with or without a question about it; None of others.

    Args:
        text: What is said.
        before: The turn before it.
        writer: The model, for a question that the grammar lacks; None asks no model.
    """
    if (found := told_in(text, before.about)) is None or understood_by_grammar(text) is not None:
        return None
    told, asked = found
    read = understood_by_grammar(asked) if asked else None
    if asked and read is None and writer is not None and not told.is_supposed:
        read = understood_by_model(writer, asked)
    if read is None and told.is_supposed and not asked and before.about is not None:
        return replace(before.then(before.text, _read_so(before.about)), told=told)
    if read is None and (asked or told.is_supposed):
        return None
    if read is not None:
        return replace(before.then(text, read), told=told)
    # what is told is what the next question may point at
    about = understood_by_grammar(told.question)
    turn = before.then(told.question, about)
    return replace(turn, read=None, told=told)


def _by_meaning(question: str, before: Turn, about: Meaning) -> ReadQuestion | None:
    """A follow-up that takes its other side, its unit or its quantity from what was meant."""
    meaning: Meaning | None = None
    if asks_by_how_much(question):
        meaning = difference_of(about, question)
    elif leaves_unit_out(question) and (named := with_quantity_of(question, about)):
        return understood_by_grammar(named)
    elif unit := in_another_unit(question, about):
        meaning = unit
    elif kind_of(about) in _OF_NUMBERS and (
        by_number := of_number(question, compared_in(about) or before.number, before.earlier)
    ):
        meaning = by_number
    elif by_advice := of_advice(question, about):
        meaning = by_advice
    elif understood_by_grammar(question, before.text) is None:
        meaning = reason_of(about) if _WHY.fullmatch(question.strip()) else None
    if (
        meaning is None
        and (of_force := about_the_force(question)) != question
        and (read := understood_by_grammar(of_force))
    ):
        meaning = of_supposed_force(read.meaning, about)
    return None if meaning is None else _read_so(meaning)


def _read_so(meaning: Meaning) -> ReadQuestion:
    """A follow-up whose meaning was worked out."""
    try:
        query = query_of(meaning)
    except ValueError:  # it has a number of an earlier question, which no query can name
        unit = meaning.unit if isinstance(meaning, Amount) else None
        meaning = Calculated(truth=truth_of(meaning), unit=unit)
        query = query_of(meaning)
    return ReadQuestion(query, meaning, CALCULATED_CONFIDENCE)


def _read_behind(writer: QueryWriter, question: str, before: Turn) -> Turn:
    """A question as it stands, or behind the one before it."""
    core = without_lead(question)
    if core != question and (read := understood_by_grammar(core)):
        return before.then(core, read, is_whole=True)
    is_whole = _STANDS_ALONE.match(core) or len(core.split()) > FOLLOW_UP_WORDS
    if core != question and is_whole:
        return before.then(core, _asked_for(core, understood_by_model(writer, core)), is_whole=True)
    if _FOLLOWS.match(question):
        read = understood(writer, question, before.text)
        return before.then(before.text, _asked_for(question, read))
    if known := understood_by_grammar(question):
        return before.then(question, known, is_whole=True)
    if known := understood_by_grammar(question, before.text):
        return before.then(before.text, known)
    alone = read_by_model(writer, question)
    stands_alone = alone is not None and alone.confidence >= ALONE_FROM
    stands_alone = stands_alone or bool(_STANDS_ALONE.match(question))
    if stands_alone or len(question.split()) > FOLLOW_UP_WORDS:
        read = _asked_for(question, doubted(question, alone))
        return before.then(question, read, is_whole=True)
    behind = _asked_for(question, read_by_model(writer, question, before.text))
    if behind is not None and (alone is None or behind.confidence > alone.confidence):
        return before.then(before.text, doubted(question, behind))
    return before.then(question, _asked_for(question, doubted(question, alone)))


def _asked_for(question: str, read: ReadQuestion | None) -> ReadQuestion | None:
    """What was read by the model, unless it is a reason that nobody asked for."""
    is_reason = read is not None and isinstance(read.meaning, Why)
    return None if is_reason and not _ASKS_WHY.search(question) else read
