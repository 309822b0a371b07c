"""All families, and recognising a question as one of them."""

from __future__ import annotations

import re
from functools import cache

from tacgrasp.lessons.dialogue.families.amounts import agreed as amounts
from tacgrasp.lessons.dialogue.families.amounts import derived, differences
from tacgrasp.lessons.dialogue.families.classes import asked as classes
from tacgrasp.lessons.dialogue.families.comparisons import agreed as agreed_comparisons
from tacgrasp.lessons.dialogue.families.comparisons import felt as comparisons
from tacgrasp.lessons.dialogue.families.comparisons import multiples, tagged
from tacgrasp.lessons.dialogue.families.comparisons import near as near_comparisons
from tacgrasp.lessons.dialogue.families.comparisons import placed as placed_comparisons
from tacgrasp.lessons.dialogue.families.contacts import contact as contacts
from tacgrasp.lessons.dialogue.families.contacts import reasons, sides, together
from tacgrasp.lessons.dialogue.families.grasps import advice, force, lifting, margins, needed
from tacgrasp.lessons.dialogue.families.unfelt import backgrounds, off_topic, others, traits
from tacgrasp.lessons.dialogue.meaning import Meaning, truth_of
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily
from tacgrasp.lessons.dialogue.patterns.reading import WordingReader
from tacgrasp.lessons.dialogue.plain_words import plain_text
from tacgrasp.lessons.dialogue.whole_wordings import understand_whole

_HYPHENED_CELL = re.compile(
    r"(?:\b(?:in|at|on) )?(?:\bthe )?\b(?:middle|mid|cent(?:re|er))-(left|right)\b(?! ?(?:part|cell))",
    re.I,
)
"""'Is it at the middle-right': without the hyphen its end would be read as 'middle, right?'."""

FAMILIES: tuple[QuestionFamily, ...] = (
    *amounts.FAMILIES,
    *derived.FAMILIES,
    *differences.FAMILIES,
    *comparisons.FAMILIES,
    *agreed_comparisons.FAMILIES,
    *placed_comparisons.FAMILIES,
    *near_comparisons.FAMILIES,
    *multiples.FAMILIES,
    *tagged.FAMILIES,
    *classes.FAMILIES,
    *contacts.FAMILIES,
    *sides.FAMILIES,
    *together.FAMILIES,
    *force.FAMILIES,
    *lifting.FAMILIES,
    *advice.FAMILIES,
    *margins.FAMILIES,
    *needed.FAMILIES,
    *reasons.FAMILIES,
    *traits.FAMILIES,
    *backgrounds.FAMILIES,
    *off_topic.FAMILIES,
    *others.FAMILIES,
)


def understand(text: str, *, before: str = "") -> Meaning | None:
    """Meaning of a question; None where neither a family nor a whole wording is it.

    Args:
        text: The question.
        before: The question before it; a follow-up is understood only after one that it fits.
    """
    earlier = understand(before) if before else None
    reader = WordingReader(plain_text(_HYPHENED_CELL.sub(r"in the middle \1 part", text)))
    for family in sorted(FAMILIES, key=lambda each: bool(each.before) != bool(before)):
        understood = reader.understand(family.node)
        if understood is None:
            continue
        if family.before and (earlier is None or truth_of(earlier) not in _truths_before(family)):
            continue
        return family.build(understood.bindings, understood.numbers)
    return None if before else understand_whole(text)


@cache
def _truths_before(family: QuestionFamily) -> frozenset[str]:
    """Truths of the questions that a follow-up follows."""
    meanings = [understand(question) for question in family.before]
    return frozenset(truth_of(meaning) for meaning in meanings if meaning is not None)
