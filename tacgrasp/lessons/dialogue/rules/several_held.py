"""Questions whether the grip holds several such objects, a multiple of one, or less of it.

    Would two of these be held?             force_n >= gram_n * 2 * mass_g
    Can it carry three 20 g weights?        force_n >= gram_n * 3 * 20
    Would half its mass slip?               force_n < gram_n * 0.5 * mass_g
    What force is needed for three?         gram_n * 3 * mass_g
    By how many grams is it too heavy?      mass_g - holds_g

A count is no mass: 'would it hold two?' is not about 2 g.

Not here: a mass that is named alone (``tacgrasp.lessons.dialogue.rules.loads``), the multiple of a
supposed one (``tacgrasp.lessons.dialogue.calculations``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.quantity_names import THING

_COUNTS = {
    "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8, "nine": 9,
    "ten": 10, "a dozen": 12, "a pair": 2, "both": 2,
}  # fmt: skip
_TIMES = {"half": 0.5, "a third of": 1 / 3, "a quarter of": 0.25, "twice": 2, "double": 2,
          "thrice": 3, "triple": 3}  # fmt: skip
_UNITS = r"(?:newtons|grams|kilos|kilograms|millinewtons|ounces|pounds|times|percent)"
_MASS = r"(?P<mass>\d+(?:\.\d+)?)[ -]?(?P<unit>kg|g|grams?|kilos?|kilograms?)"
_THINGS = rf"(?!{_UNITS}\b)[a-z]{{2,}}s\b"
_ALIKE = r"(?:identical|equal|like|similar)"
_SEVERAL = (
    rf"(?P<count>{'|'.join(_COUNTS)}|\d+(?= (?:of|such|{_ALIKE}|{_THINGS}|\d)))"
    rf"(?: of (?:these|those|them|it)| such)?(?: {_ALIKE})?(?: (?:{_MASS} )?{_THINGS})?"
)
"""'Two', 'two of these', '2 such objects', 'three 20 g weights'; '60' leaves out the grams."""

_MULTIPLE = (
    rf"(?P<times>{'|'.join(_TIMES)}|(?P<number>\d+(?:\.\d+)?|{'|'.join(_COUNTS)}) times) "
    rf"(?:(?:the|its|this|that) )(?:(?:object|{THING})(?:'s)? )?(?:mass|weight|load)"
)
_HELD = rf"(?:{_SEVERAL}|{_MULTIPLE})"
_GRIP = r"(?:it|this|that|i|we|you|(?:the|this|that|our|my) (?:grip|gripper|hand|robot|force))"
_STILL = r"(?: (?:still|also|even|safely|surely|now|be able to))*"
_AT_ONCE = (
    r"(?: (?:at once|at (?:the same|one) time|together|altogether|in one go|like this|too|as well|"
    r"then|now|safely|surely|instead|up|out|away))*"
)
_HOLDS = r"(?:hold|carry|lift|support|take|bear|keep|pick up|manage)"
_CARRIES = re.compile(
    rf"(?:would|will|can|could|does|do|may) {_GRIP}{_STILL} {_HOLDS}(?: up)? {_HELD}{_AT_ONCE}"
)
_ARE_CARRIED = re.compile(
    rf"(?:would|will|can|could|are|is|do) {_HELD}{_STILL} (?:(?:be )?(?:held|carried|lifted|kept|"
    r"safe|supported)|hold|stay(?: put)?|stick|remain|(?P<slips>slip|fall|drop|slide|be dropped|be "
    rf"lost)){_AT_ONCE}"
)

_NEEDED_FOR = re.compile(
    r"(?:how much|what|which) (?:force|grip|squeeze) (?:(?:is|are|would|will|do|does|should|be|i|"
    r"we|"
    r"you|it|need|needs|needed|required|necessary|take|have) )*(?:for|to (?:hold|lift|carry)) "
    rf"{_HELD}{_AT_ONCE}"
)
_IT = rf"(?:it|this|that|(?:the|this|that|our|my) {THING})"
_TOO_HEAVY = re.compile(
    rf"(?:by )?how (?:much|many (?P<unit>grams|kilos|kilograms)) (?:(?:is|are) )?(?:{_IT} )?too "
    rf"heavy(?: (?:is|are) {_IT})?(?: (?:for|to) .+)?|"
    r"how (?:much|many (?P<grams>grams|kilos|kilograms)) lighter (?:must|should|would|does|has) "
    rf"{_IT} (?:(?:have|need) to )?(?:be|become|get)(?: (?:for|to|so|if) .+)?"
)
"""'By how many grams is it too heavy?', 'how much lighter must it be?'"""


def several_query(question: str) -> str:
    """The query of a question for several objects, or for what one has too much; '' of others.

    Args:
        question: The question, as ``tacgrasp.lessons.dialogue.plainer`` leaves it.
    """
    words = " ".join(question.lower().replace("’", "'").split()).strip(" ?.!")
    if heavy := _TOO_HEAVY.fullmatch(words):
        unit = heavy["unit"] or heavy["grams"] or "grams"
        return f"calculate mass_g - holds_g in {'g' if unit == 'grams' else 'kg'}."
    if found := _NEEDED_FOR.fullmatch(words):
        return f"calculate gram_n * {_factor(found):.6g} * {_each(found)} in N."
    found = _CARRIES.fullmatch(words) or _ARE_CARRIED.fullmatch(words)
    if found is None:
        return ""
    sign = "<" if found.groupdict().get("slips") else ">="
    return f"calculate force_n {sign} gram_n * {_factor(found):.6g} * {_each(found)}."


def _factor(found: re.Match[str]) -> float:
    """How many objects are meant, or which multiple of one."""
    if said := found["count"] or found["number"]:
        return float(_COUNTS.get(said) or said)
    return _TIMES[found["times"]]


def _each(found: re.Match[str]) -> str:
    """The mass of one: a number of grams, or that which was told."""
    if found["mass"] is None:
        return "mass_g"
    return f"{float(found['mass']) * (1000 if found['unit'].startswith('k') else 1):.6g}"
