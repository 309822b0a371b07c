"""Questions that say how a number is to be rounded: 'Depth, to the nearest tenth of a millimetre?'.

Not here: numbers that are compared ('is it 2 N, to the nearest newton?').
"""

from __future__ import annotations

import re
from typing import NamedTuple

from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT, unit_of
from tacgrasp.lessons.dialogue.meaning import Amount, Calculated, Meaning
from tacgrasp.lessons.dialogue.quantities import UNITS

_STEPS = {
    "whole": 1, "full": 1, "integer": 1, "round": 1, "half": 0.5, "quarter": 0.25, "fifth": 0.2,
    "tenth": 0.1, "hundredth": 0.01, "thousandth": 0.001, "one": 1, "two": 2, "five": 5, "ten": 10,
    "fifty": 50, "hundred": 100, "thousand": 1000,
}  # fmt: skip
_DECIMALS = {"no": 0, "zero": 0, "two": 2, "three": 3}
_STEP = rf"(?:{'|'.join(_STEPS)}|\d{{1,6}}(?:[.,]\d{{1,6}})?)s?"
_UNIT = rf"(?:%|µm|mm²|{UNIT})(?![\w²])"
_NEAREST = r"(?:the )?(?:next|nearest|closest)"
_ROUNDED = re.compile(
    rf"(?:,? ?\b(?:rounded|rounding|round it)(?: off)?)?,? ?\bto (?:{_NEAREST} )"
    rf"(?:(?:(?P<step>{_STEP})(?: (?:of )?an?\b| of)? ?)?(?P<unit>{_UNIT})|"
    rf"(?P<alone>{_STEP})(?= ?(?:[,;:.?!]|$)))|"
    rf",? ?\bround(?:ed)?(?: off)?,? to (?:{_NEAREST} )?(?:an? |the )?"
    rf"(?P<to>{_STEP})\b(?! (?:decimal|digit))(?: (?:of )?an?\b| of)?"
    rf"(?: numbers?(?: of)?)?(?: ?(?P<to_unit>{_UNIT}))?|"
    r"(?:,? ?\brounded(?: off)?)?,? ?\b(?:to|with|at) (?P<decimals>no|zero|(?:a )?single|one|two|"
    r"three|\d) (?:decimals?|digits? (?:after|behind) the (?:decimal )?(?:point|comma))"
    r"(?: places?)?|"
    rf",? ?\b(?:in|as|to) (?:an? )?(?:whole|full|integer|round) (?:percentage|"
    rf"numbers?(?: of)?(?: (?P<of_unit>{_UNIT}))?|(?P<count_unit>{_UNIT}))|"
    r",? ?\bas an integer\b",
    re.I,
)
_ROUND = re.compile(
    r"^(?:please )?(?:(?:can|could) you )?round (?:off )?(?=(?:the |its )?\w+.* to )", re.I
)
_IN_UNIT = re.compile(rf"\b(?:in|as|how many|what) {_UNIT}|\bhow many\b", re.I)


class Rounding(NamedTuple):
    """How a number is to be rounded.

    Attributes:
        question: The question without that.
        step: What it is to be a multiple of.
        unit: Symbol of the step's unit; '' for that of the answer.
    """

    question: str
    step: float
    unit: str


def rounding_of(question: str) -> Rounding | None:
    """How a question wants its number rounded; None where it says nothing of that."""
    text = _ROUND.sub("what is ", question)
    if text != question:
        text = re.sub(r" to (?=[^,?!]*$)", " rounded to ", text)
    if (found := _ROUNDED.search(text)) is None:
        return None
    said = found["unit"] or found["to_unit"] or found["count_unit"] or found["of_unit"]
    before, behind = text[: found.start()].rstrip(" ,"), text[found.end() :].lstrip(" ,:")
    rest = f"{before} {behind}".strip() if behind[:1].isalnum() else f"{before}{behind}"
    if said and not _IN_UNIT.search(rest):
        rest = f"{rest.rstrip(' ?.!')} in {said}?"
    return Rounding(rest, _step_of(found), unit_of(_plain(said)) if said else "")


def rounded_step(meaning: Meaning, how: Rounding) -> float:
    """The step in the unit of a number that is asked for; 0 of any other meaning."""
    if not isinstance(meaning, Amount | Calculated) or meaning.unit is None:
        return 0.0
    if not how.unit or how.unit == meaning.unit:
        return how.step
    said, unit = UNITS[how.unit], UNITS.get(meaning.unit)
    if unit is None or said.dimension != unit.dimension:
        return 0.0
    return how.step * said.size / unit.size


def _step_of(found: re.Match[str]) -> float:
    if decimals := found["decimals"]:
        word = decimals.lower()
        return 10.0 ** -(int(word) if word.isdigit() else _DECIMALS.get(word, 1))
    word = (found["step"] or found["alone"] or found["to"] or "whole").lower().rstrip("s")
    return float(_STEPS.get(word) or word.replace(",", "."))


def _plain(unit: str) -> str:
    return "percent" if unit == "%" else unit.lower()
