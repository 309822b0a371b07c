"""Follow-ups that the question before them completes.

    Is the force above the limit?  By how much?             abs(force_n - limit_n)
    How far is it from the middle?  And from the left edge? How far is it from the left edge?
    How deep is it in microns?  Is that more than 50?       Is the depth more than 50 µm?

Not here: follow-ups that the grammar has (``tacgrasp.lessons.dialogue.families``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.conditions import IN_BAND, OUTSIDE_BAND
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import Amount, Calculated, Check, Meaning
from tacgrasp.lessons.dialogue.quantities import unit_of_name

_BY_HOW_MUCH = re.compile(
    r"(?:and |but |so )?(?:by (?:how much|what|which margin|what margin|what amount)|how much"
    r"(?: (?:over|under|above|below|more|less|too (?:much|little|high|low)))?)"
    r"(?: (?:is (?:it|that)|exactly|then|precisely|roughly|about))*[?.! ]*",
    re.I,
)
_COMPARED = re.compile(r"(?:not \()?(?P<a>[^<>='\"]+?) [<>]=? (?P<b>[^<>='\"]+?)\)?")

_PREPOSITION = (
    r"from|to|in|into|above|below|over|under|beyond|between|within|at least|at most|more than|"
    r"less than|on|at|near"
)
_GOES_ON = re.compile(
    rf"(?:and|but|or|what about|how about)[, ]+(?P<rest>(?P<word>{_PREPOSITION})\b.+)", re.I
)
_CALLED_SO = ("depth", "force", "area", "mass", "limit")
"""Quantities that a pronoun may stand for: questions call them by these names."""

_PRONOUN = re.compile(r"\b(?:it|that|this)\b", re.I)
_BARE_NUMBER = re.compile(r"(?<=\s)(?P<number>\d+(?:\.\d+)?)(?=[?.! ]*$)")


def asks_by_how_much(question: str) -> bool:
    """Whether a follow-up asks for the difference behind a yes or a no."""
    return _BY_HOW_MUCH.fullmatch(question.strip()) is not None


def difference_of(asked: Meaning) -> Calculated | None:
    """How far apart the two sides of a comparison are; None of what compares no two numbers."""
    if not isinstance(asked, Check | Calculated):
        return None
    condition = asked.condition if isinstance(asked, Check) else asked.truth
    if condition.removeprefix("not (").removesuffix(")") == IN_BAND:
        return Calculated(truth=OUTSIDE_BAND, unit="N")
    if (found := _COMPARED.fullmatch(condition)) is None:
        return None
    truth = f"abs({found['a']} - ({found['b']}))"
    try:
        names = Expression(truth).names
    except ValueError:  # it has several comparisons
        return None
    units = {unit_of_name(name) for name in names}
    return Calculated(truth=truth, unit=units.pop()) if len(units) == 1 else None


def completed(question: str, before: str) -> str:
    """A follow-up that begins with a preposition, behind the words before it; '' of others."""
    if (found := _GOES_ON.match(question.strip())) is None:
        return ""
    places = list(re.finditer(rf"\b{found['word']}\b", before, re.I))
    return f"{before[: places[-1].start()]}{found['rest']}" if places else ""


def leaves_unit_out(question: str) -> bool:
    """Whether a question is about 'it' and ends with a number that has no unit."""
    return bool(_BARE_NUMBER.search(question) and _PRONOUN.search(question))


def with_quantity_of(question: str, asked: Meaning) -> str:
    """A follow-up that leaves the unit out, in the words of the number before it; '' of others."""
    if not isinstance(asked, Amount) or asked.quantity not in _CALLED_SO:
        return ""
    about = _PRONOUN.sub(f"the {asked.quantity}", question, count=1)
    return _BARE_NUMBER.sub(rf"\g<number> {asked.unit}", about)
