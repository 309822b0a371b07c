"""Follow-ups written anew, with the words of the question before them, so that they stand alone.

    What if I add 0.2 N?             And 0.9 N?          What if I add 0.9 N?
    What is the limit?               Are we over it?     Are we over the limit?
    How far is it from the middle?   From the left edge? How far is it from the left edge?

Sides and axes, the band, masses, suppositions and names have modules of their own. Each
text is a proposal: whether it means anything is for the reader of questions to say.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from policies.instructions.quantities.numerals import in_digits
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    AnswerKind,
    Calculated,
    Check,
    Meaning,
    Several,
    kind_of,
    names_of,
)
from tacgrasp.lessons.turns.bands import HOW_FAR_FROM, about_the_band
from tacgrasp.lessons.turns.masses import needed, of_a_mass
from tacgrasp.lessons.turns.naming import (
    claimed,
    enough_to_hold,
    figure_of,
    free_part,
    in_a_word,
    in_that_place,
    named_alone,
    of_named_class,
    of_that_quantity,
    stated,
    what_like,
    which_then,
)
from tacgrasp.lessons.turns.places import (
    about_place,
    about_the_pad,
    moved_otherwise,
    with_another_axis,
    with_another_side,
)
from tacgrasp.lessons.turns.references import is_multiple
from tacgrasp.lessons.turns.supposed import (
    still_under,
    under_supposition,
    with_another_supposition,
)
from tacgrasp.lessons.turns.units import ANOTHER_NUMBER, STATED, dimension_of, with_last_number

_PREPOSITION = (
    r"from|to|in|into|above|below|over|under|beyond|between|within|at least|at most|more than|"
    r"less than|on|at|near"
)
_GOES_ON = re.compile(
    rf"(?P<lead>(?:and|but|or|what about|how about)[, ]+)?(?P<rest>(?P<word>{_PREPOSITION})\b.+)",
    re.I,
)
_MOST_WORDS = 4
"""Longest follow-up that begins with a preposition and no 'and' [words]. Our choice."""
_OBJECT = re.compile(
    r"\b(?P<before>over|for|above|below|under|in|within|inside|outside|to|of|near|past|beyond|than|"
    r"exceed(?:ing|ed)?|reach(?:ing|ed)?|break(?:ing)?|pass(?:ed|ing)?|at|from) "
    r"(?P<pronoun>it\b(?! \w+s\b)|(?:that|this)\b(?! (?!(?:is|are|am|do|does|would|will|can|we|i|"
    r"it|now|right|still|at|in|on)\b)\w))",
    re.I,
)
_CALLED = {
    "limit": "the limit",
    "band_low": "the lower end of the band",
    "band_high": "the upper end of the band",
    "band_middle": "the middle of the band",
    "mass": "the mass",
    "needed": "the force that is needed",
}
"""Quantities that a pronoun may stand for behind a preposition, as questions call them."""
_COMPARED_WITH = {"limit_n": "the limit", "mass_g": "the mass"}
"""The same of what a comparison was made with."""


def rewritten(question: str, before: str, meant: Meaning | None, noun: str) -> Iterator[str]:
    """What a follow-up may be in full.

    Args:
        question: The follow-up.
        before: The question before it, as it stands alone.
        meant: What that means; None where that is not known.
        noun: What a pronoun may stand for; '' for nothing.
    """
    question = question.strip()
    if is_multiple(question) and meant is not None and kind_of(meant) is AnswerKind.NUMBER:
        noun = ""  # 'half of that' is half the number, not half of what it was compared with
    for text in (
        claimed(question, before),
        stated(question),
        of_that_quantity(question, meant),
        enough_to_hold(question),
        still_under(question, noun),
        figure_of(question, meant),
        which_then(question, meant),
        what_like(question),
        in_a_word(question, meant),
        in_that_place(question, meant),
        free_part(question, meant),
        about_the_pad(question, meant),
        *about_place(question, meant),
        with_another_side(question, before),
        *about_the_band(question, meant),
        needed(question, before, meant),
        _with_another_number(question, before),
        *with_another_supposition(question, before),
        under_supposition(question, before),
        with_another_axis(question, before),
        of_named_class(question, meant),
        of_a_mass(question, before, meant),
        named_alone(question, before),
        moved_otherwise(question, before),
        with_noun(question, noun),
        HOW_FAR_FROM.sub("how far is the force from ", with_noun(question, noun)),
        _completed(question, before),
    ):
        if text and text != question:
            yield text


_MORE = re.compile(r"\b(?:more|over|above|at least|deeper|higher|exceed\w*|heavier|beyond)\b", re.I)
_LESS = re.compile(r"\b(?:less|under|below|at most|shallower|lower|lighter)\b", re.I)


def _with_another_number(question: str, before: str) -> str:
    """The question before with the number of a follow-up, in its unit where that has none."""
    asked = ANOTHER_NUMBER.fullmatch(with_last_number(question))
    if STATED.search(before) is None:
        before = in_digits(before)
    if (
        asked is None
        or (_MORE.search(before) and _LESS.search(question))
        or (_LESS.search(before) and _MORE.search(question))
    ):
        return ""
    dimension = dimension_of(asked["unit"])
    for found in reversed(list(STATED.finditer(before))):
        if asked["unit"] is None:
            return before[: found.start("number")] + asked["number"] + before[found.end("number") :]
        if dimension_of(found["unit"]) == dimension:
            number = f"{asked['number']} {asked['unit']}"
            return before[: found.start()] + number + before[found.end() :]
    return ""


def noun_of(meant: Meaning) -> str:
    """What a pronoun may stand for after something was asked: 'the limit'; '' for nothing."""
    if isinstance(meant, Several) and all(isinstance(part, Amount) for part in meant.parts):
        names = {part.quantity for part in meant.parts if isinstance(part, Amount)}
        return "the band" if names == {"band_low", "band_high"} else ""
    if isinstance(meant, Amount) and meant.quantity in _CALLED:
        return f"{_CALLED[meant.quantity]} for {meant.of}" if meant.of else _CALLED[meant.quantity]
    if not isinstance(meant, Amount | Check | Calculated):
        return ""
    names = {name for name in names_of(meant) if name in _COMPARED_WITH}
    return _COMPARED_WITH[names.pop()] if len(names) == 1 else ""


def with_noun(question: str, noun: str) -> str:
    """A question with a noun in place of the pronoun behind a preposition; '' of others."""
    if not noun or _OBJECT.search(question) is None:
        return ""
    return _OBJECT.sub(lambda found: f"{found['before']} {noun}", question)


def _completed(question: str, before: str) -> str:
    """A follow-up that begins with a preposition, behind the words before it; '' of others."""
    found = _GOES_ON.match(question)
    if found is None or (not found["lead"] and len(question.split()) > _MOST_WORDS):
        return ""
    places = list(re.finditer(rf"\b{found['word']}\b", before, re.I))
    return f"{before[: places[-1].start()]}{found['rest']}" if places else ""
