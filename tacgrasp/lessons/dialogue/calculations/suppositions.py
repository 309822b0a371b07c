"""Questions about what would be if a quantity were another one.

    If the force dropped by 20 %, what would remain?        0.8 * force_n
    Suppose you pushed 1 N harder: above the band?          force_n + 1 > band_high_n
    If the limit were halved, would the force violate it?   force_n > 0.5 * limit_n

Not here: questions about what is (``tacgrasp.lessons.dialogue.calculations.amounts``,
``tacgrasp.lessons.dialogue.calculations.checks``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tacgrasp.lessons.dialogue.calculations.amounts import amount_of, calculated_amount
from tacgrasp.lessons.dialogue.calculations.asked import AskedWords
from tacgrasp.lessons.dialogue.calculations.changes import changed
from tacgrasp.lessons.dialogue.calculations.checks import calculated_check
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import Term
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.scene import NAMES

_SUPPOSED = re.compile(
    r"(?:if|suppose|supposing|imagine|assume|assuming|say|were|with|after|once|when)(?: that)? "
    r"(?P<all>.+)"
)
_QUESTION = re.compile(
    r" (?:then )?(?=(?:what|how|would|will|could|can|is|are|does|do|which|by how|in)\b)"
)
_CONDITION = re.compile(
    r" (?:if|suppose|supposing|provided|assuming|once|when|after|with)(?: that)? (?=.)"
)
_EXTRA = re.compile(
    rf"(?:would|will|does) (?:(?:(?:adding|another|an extra|a further) )+(?P<b>#\d+ (?:{UNIT}))(?: "
    rf"more| extra)?|(?P<more>#\d+ (?:{UNIT})) (?:more|extra)) (?P<rest>.+)"
)
_WITHOUT = re.compile(
    rf"(?:can|could|may|might) (?:i|we|you) (?:still )?(?:add|put on|press|squeeze)(?: another)? "
    rf"(?P<b>#\d+ (?:{UNIT}))"
    r"(?: more| harder| extra)? without (?:going over|exceeding|passing|breaking|"
    r"crossing)(?: (?:it|(?:the )?limit))?"
)
_SUBJECT = re.compile(
    r"(?:what|how (?:much|deep|large|big|strong|high)) (?:would|will|is) (.+?) "
    r"(?:be|become|come to|amount to)\b"
)
"""What a pronoun before or behind stands for: 'what would the force be if it rose'."""

_MEASURED = {"deep": "length", "heavy": "mass", "strong": "force", "hard": "force"}
_HOW = re.compile(rf"how ({'|'.join(_MEASURED)})\b")
_NOUN = re.compile(r"\b(?:force|depth|mass|weight|area|limit)\b")
_RESULT = re.compile(
    r"(?:what|how (?:much|deep|heavy|large|big|strong|hard))(?: "
    r"(?:force|depth|mass|weight|area|limit))? (?:would|will|is|are|does|"
    r"do)(?: (?:that|it|we|you|i|there|each(?: of them)?|"
    r"the (?:new|total|resulting|whole|combined) \w+|the (?:force|depth|mass|weight|area|limit)|"
    r"the|remain|be|left|have|result|become|read|show|get|make|come|to|amount|still|then|apply|"
    r"feel|carry|hold|take))*|(?:what|how much) (?:remains|is left|results)|"
    r"(?:what|how many|how much|which)(?: (?:percent|percentage|share))? of (?:the )?pad "
    r"(?:would|will|does) (?:it|that) (?:cover|touch)"
)


def supposed(asked: AskedWords) -> Calculated | None:
    """What a question asks about a changed quantity; None where it changes none."""
    for change, rest in _clauses(asked.words):
        named = _SUBJECT.match(rest)
        subject = asked.term(named[1]) if named else None
        before = asked if subject is None else asked.about(subject, change)
        if (told := changed(before, change)) is None:
            continue
        base = _base(asked, told)
        after = asked.about(told, rest, base)
        if _RESULT.fullmatch(rest.replace(told.words, "it") if told.words else rest):
            named = _NOUN.search(rest)
            about = asked.term(named[0]) if named else None
            is_other = about is not None and about.expression != base
            how = _HOW.match(rest)
            is_other = is_other or (how is not None and _MEASURED[how[1]] != told.dimension)
            return None if is_other else amount_of(told, after)
        found = calculated_check(after) or calculated_amount(after)
        if found and told.expression in found.truth:
            return found
    return None


def supposes(asked: AskedWords) -> bool:
    """Whether a question supposes a change of a quantity."""
    return any(changed(asked, change) for change, _ in _clauses(asked.words))


def _base(asked: AskedWords, told: Term) -> str:
    """Name of the quantity that a supposition changes; '' where it is none of a scene."""
    named = asked.term(told.words) if told.words else None
    names = (named.expression,) if named else Expression(told.expression).names
    return names[0] if len(names) == 1 and names[0] in NAMES else ""


def _clauses(words: str) -> Iterator[tuple[str, str]]:
    """What a question supposes, and what it asks, in every way it may be divided so."""
    if found := _WITHOUT.search(words):
        yield f"we press {found['b']} harder", "would the limit be respected"
    if found := _EXTRA.fullmatch(words):
        yield f"{found['b'] or found['more']} came on top", f"would it {found['rest']}"
    if found := _SUPPOSED.fullmatch(words):
        for joint in _QUESTION.finditer(found["all"]):
            yield found["all"][: joint.start()], found["all"][joint.end() :]
    for joint in _CONDITION.finditer(words):
        yield words[joint.end() :], words[: joint.start()]
