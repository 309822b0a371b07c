"""Numbers and units as follow-ups write them.

Not here: the units of answers (``tacgrasp.lessons.dialogue.quantities``).
"""

from __future__ import annotations

import re

from policies.instructions.quantities.numerals import in_digits
from tacgrasp.lessons.dialogue.quantities import UNITS
from tacgrasp.lessons.turns.leads import END, LEAD

_UNIT_WORDS = {
    "N": r"N|newtons?",
    "mN": r"mN|millinewtons?",
    "g": r"g|grams?|gr",
    "kg": r"kg|kilos?|kilograms?",
    "oz": r"oz|ounces?",
    "lb": r"lbs?|pounds?",
    "%": r"%|percent|per cent",
    "mm": r"mm|millimet(?:re|er)s?",
    "µm": r"µm|um|microns?|micromet(?:re|er)s?",
    "cm": r"cm|centimet(?:re|er)s?",
    "mm²": r"mm²|mm2|square millimet(?:re|er)s?",
    "kPa": r"kPa|kilopascals?",
    "thou": r"thou",
    "in": r"inch|inches",
    "cN": r"cN|centinewtons?",
    "lbf": r"lbf|pounds?[ -]force",
    "kgf": r"kgf",
    "cm²": r"cm²|cm2|square centimet(?:re|er)s?",
}
TIMES = {"half": 0.5, "twice": 2, "double": 2, "triple": 3, "thrice": 3, "three times": 3,
         "four times": 4, "quadruple": 4, "a third": 1 / 3, "a quarter": 0.25, "a tenth": 0.1,
         "halved": 0.5, "doubled": 2, "tripled": 3, "ten times": 10, "five times": 5}  # fmt: skip
"""What a follow-up multiplies by, by its words."""

NUMBER = rf"(?P<number>\d+(?:[.,]\d+)?)(?:\s*(?P<unit>{'|'.join(_UNIT_WORDS.values())})(?!\w))?"
STATED = re.compile(rf"(?<![\w.,]){NUMBER}(?!\w|\.\d)", re.I)
ANOTHER_NUMBER = re.compile(
    rf"{LEAD}(?:(?:the )?same(?: question| again| thing)? )?(?:if (?:i|we|you) )?(?:(?:add|added|"
    rf"by|with|for|at|to|of|over|above|below|under|"
    rf"(?:(?:more|less|deeper|higher|lower) )?than|it's|it is|it were|it weighs|only|a|an|about|"
    rf"one|full|whole|even)\s+)*{NUMBER}"
    rf"(?: (?:added|on top|off|one|1|object|part|piece|thing))?{END}",
    re.I,
)


_COUNTED = {"one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8,
            "nine": 9, "ten": 10, "twenty": 20, "thirty": 30, "forty": 40, "fifty": 50,
            "sixty": 60, "seventy": 70, "eighty": 80, "ninety": 90, "a hundred": 100,
            "one hundred": 100, "two hundred": 200}  # fmt: skip
_LAST_NUMBER = re.compile(
    rf"\b(?P<count>{'|'.join(sorted(_COUNTED, key=len, reverse=True))})(?P<half> and a "
    rf"half)?(?={END}$)",
    re.I,
)


def with_last_number(question: str) -> str:
    """A follow-up in digits, also its last number without a unit: 'one and a half'."""

    def number(found: re.Match[str]) -> str:
        return f"{_COUNTED[found['count'].lower()] + (0.5 if found['half'] else 0):g}"

    return _LAST_NUMBER.sub(number, in_digits(question))


def dimension_of(unit: str | None) -> str:
    """What a unit as it is written measures; '' of none."""
    if not unit:
        return ""
    return UNITS[symbol].dimension if (symbol := unit_symbol(unit)) else ""


def unit_symbol(written: str) -> str:
    """The unit of a word, as queries write it; '' of none that follow-ups know."""
    # 'mn' is no unit: a unit's own letters count first
    for flags in (re.NOFLAG, re.I):
        for symbol, words in _UNIT_WORDS.items():
            if re.fullmatch(words, written, flags):
                return symbol
    return ""


def in_own_unit(number: str, unit: str) -> float:
    """A number as it is written, in its dimension's own unit: '1,5' 'kg' are 1500 g."""
    return float(number.replace(",", ".")) * UNITS[unit_symbol(unit)].size
