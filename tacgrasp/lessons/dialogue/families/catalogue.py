"""All families, and recognising a question as one of them."""

from __future__ import annotations

from functools import cache

from tacgrasp.lessons.dialogue.families import (
    advice,
    agreed_checks,
    amounts,
    backgrounds,
    checks,
    classes,
    contacts,
    goals,
    lifting,
    off_topic,
    place_checks,
    sides,
    together,
    unanswerable,
)
from tacgrasp.lessons.dialogue.families.family import QuestionFamily
from tacgrasp.lessons.dialogue.meaning import Meaning, truth_of
from tacgrasp.lessons.dialogue.plain_words import plain_text

FAMILIES: tuple[QuestionFamily, ...] = (
    *amounts.FAMILIES,
    *checks.FAMILIES,
    *agreed_checks.FAMILIES,
    *place_checks.FAMILIES,
    *classes.FAMILIES,
    *contacts.FAMILIES,
    *sides.FAMILIES,
    *together.FAMILIES,
    *goals.FAMILIES,
    *lifting.FAMILIES,
    *advice.FAMILIES,
    *unanswerable.FAMILIES,
    *backgrounds.FAMILIES,
    *off_topic.FAMILIES,
)


def understand(text: str, *, before: str = "") -> Meaning | None:
    """Meaning of a question; None where no family has its wording.

    Args:
        text: The question.
        before: The question before it; a follow-up is understood only after one that it fits.
    """
    earlier = understand(before) if before else None
    plain = plain_text(text)
    for family in sorted(FAMILIES, key=lambda each: bool(each.before) != bool(before)):
        if family.before and (earlier is None or truth_of(earlier) not in _truths_before(family)):
            continue
        understood = family.automaton.understand(plain)
        if understood is not None:
            return family.build(understood.bindings, understood.numbers)
    return None


@cache
def _truths_before(family: QuestionFamily) -> frozenset[str]:
    """Truths of the questions that a follow-up follows."""
    meanings = [understand(question) for question in family.before]
    return frozenset(truth_of(meaning) for meaning in meanings if meaning is not None)
