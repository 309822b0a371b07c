"""Conditions that a statement names, however many stand in it: all of them, or one of several.

    a cone pressed in by over 0.4 mm            shape == 'peak', depth_mm > 0.4
    something is touching and the force lies in its band

A statement is divided wherever each part means something; with a word that no part has use for, it
means nothing here.

Not here: what a question asks of them (``tacgrasp.lessons.dialogue.clauses.verdicts``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from tacgrasp.lessons.dialogue.calculations.asked import asked_words
from tacgrasp.lessons.dialogue.calculations.checks import calculated_check
from tacgrasp.lessons.dialogue.clauses.comparing import compared
from tacgrasp.lessons.dialogue.clauses.plain_clause import numbered
from tacgrasp.lessons.dialogue.clauses.states import stated
from tacgrasp.lessons.dialogue.clauses.vocabulary import NEGATIONS
from tacgrasp.lessons.dialogue.clauses.word_sets import words_of

MOST_WORDS = 40
"""Longest statement [words]. Our choice: a longer one tells a story."""

MOST_CONDITIONS = 5
"""Most conditions of one statement. Our choice."""

_JOINT = re.compile(
    r"(?:(?:and|but|while|whilst|whereas|yet|plus|also|as well as|though|with|where|"
    r"at the same time|that is|that are|which is|which are|who is|being|both|all|then|additionally|"
    r"moreover|besides) )+"
)
_OPENING = NEGATIONS | words_of("the a an is are was does do with by at in of on to its being been")
"""Words that begin something: no part of a statement ends with them."""

_CONTINUING = words_of("from of than to")
_READING = re.compile(
    r"\b(?:reading|level|squeeze|pinch|touch)\b(?=.*\b(?:limit|band|window|range)\b)", re.I
)
_BEFORE_NOTHING = words_of("is there has have with touches touching that feel see")
_NEVER_EXCEED = re.compile(
    r"\b(?:never|not|do[ -]not)[ -](?:to[ -]be[ -])?exceed(?:ed)?(?:ing)? (?:value|force|limit|"
    r"figure|mark|line|level)\b",
    re.I,
)
_VERB = r"(?:is|are|was|were|does|do|did|would|will|has|have|can|could)"


def condition_of_statement(
    text: str, *, known: frozenset[str] = frozenset(), is_any: bool = False
) -> str:
    """The condition that a statement names; '' where it means none, or more than conditions.

    Args:
        text: The statement, or a question whether it is so.
        known: Further words that change nothing.
        is_any: Whether one of several conditions is enough.
    """
    text = _NEVER_EXCEED.sub("limit", text)
    words, numbers = numbered(text)
    told = words.split()
    if not told or len(told) > MOST_WORDS:
        return ""
    if condition := _calculated(text):
        return condition
    found = _divided(told, numbers, known, {})
    if not found or len(found) > MOST_CONDITIONS:
        return ""
    if len(found) == 1:
        return found[0]
    is_or = is_any or ("or" in told and _are_parted_by_or(told))
    return (" or " if is_or else " and ").join(f"({each})" for each in found)


def _are_parted_by_or(told: Sequence[str]) -> bool:
    """Whether 'or' and no 'and' stands in a statement."""
    return not {"and", "but", "while"} & set(told)


def _divided(
    told: Sequence[str],
    numbers: Sequence[float],
    known: frozenset[str],
    seen: dict[tuple[int, int], str],
    start: int = 0,
) -> tuple[str, ...]:
    """Conditions of the words from a place on, the longest first; none where a word is left."""
    rest = " ".join(told[start:])
    if joint := _JOINT.match(f"{rest} "):
        skipped = start + len(joint[0].split())
        if start and skipped < len(told):
            return _divided(told, numbers, known, seen, skipped) or ()
    for end in range(len(told), start, -1):
        if told[end - 1] in _OPENING and end < len(told):
            continue
        if _begins_anew(told, start, end):
            continue
        words = " ".join(told[start:end])
        if (start, end) not in seen:
            seen[start, end] = compared(words, numbers, known=known) or stated(words, known=known)
        condition = seen[start, end]
        if not condition:
            continue
        if end == len(told):
            return (condition,)
        if others := _divided(told, numbers, known, seen, end):
            return (condition, *others)
    return ()


def _begins_anew(told: Sequence[str], start: int, end: int) -> bool:
    """Whether another clause begins within some words: 'it is there, nothing is cut'."""
    return (start > 0 and told[start] in _CONTINUING) or any(
        told[place] == "nothing" and told[place - 1] not in _BEFORE_NOTHING
        for place in range(start + 1, end)
    )


def _calculated(text: str) -> str:
    """The condition that terms compare: 'the force exceeds half of the permitted maximum'."""
    text = text.strip(" .?!,:;")
    text = re.sub(r"['’]re\b", " are", text)
    text = re.sub(rf"^(we|you|it|they) {_VERB}\b", r"\1", text, flags=re.I)
    begins = re.match(rf"{_VERB}\b", text, re.I) is not None
    text = _READING.sub("force", text)
    asked = asked_words(text if begins else f"is {text}")
    found = calculated_check(asked)
    return found.truth if found and found.unit is None else ""
