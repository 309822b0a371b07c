"""Questions that are written as a program writes them, in the names that a truth may use.

    force_n - band_low_n = ? in N          force_n - band_low_n
    return depth_mm * 1e3; // in µm        the depth, in µm
    x_mm < 0 ? 'left' : 'right'            'left' if x_mm < 0 else 'right'
    print(limit_n)                         limit_n

Not here: expressions themselves (``tacgrasp.lessons.dialogue.expression``), sums in words
(``tacgrasp.lessons.dialogue.calculations.terms``).
"""

from __future__ import annotations

import re

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import Calculated, Which
from tacgrasp.lessons.dialogue.quantities import UNITS, unit_of_name
from tacgrasp.lessons.dialogue.scene import NAMES

_IDENTIFIER = re.compile(rf"(?<![\w.])(?:{'|'.join(name for name in NAMES if '_' in name)})(?!\w)")
_COMMENT = re.compile(r"\s*;.*$|\s(?:#|//|->|--).*$")
_SAID_UNIT = re.compile(
    r"(?:\bin |\(|# ?|\[|// ?)\s*(?P<unit>mm²?|[µu]m|cm|m?N|%|newtons?|"
    r"millimet(?:re|er)s?|microns?)\b"
)
_UNIT_BEHIND = re.compile(
    r"[,:]? *(?:\(|\[)?(?:in )?(?<![\w.])(?P<unit>[a-zµ²A-Z%]+)(?:\)|\])?[?.! ]*$"
)
_OTHER_DIMENSION = re.compile(r"\*\*|/ *\(*[a-z]")
"""A power, or a quotient of names: in another unit than these."""
_SPELLED = {"um": "µm", "newton": "N", "newtons": "N", "microns": "µm", "micron": "µm"}
_LEADS = re.compile(
    r"^(?:(?:what(?:['’]s| is)(?: the value of)?|is|does|return|print|assert|echo|eval(?:uate)?|"
    r"compute|calculate|give me|tell me|value of|show)\b:?\s*)+"
)
_CALL = re.compile(
    r"^(?:print|console\.log|log|echo|float|str|eval|return|assert)\s*\((?P<x>.*)\)$"
)
_ASKED = re.compile(r"\s*(?:={1,3} *\?|= *$|\?+$|, *(?:signed|please)|!+$)\s*")
_TERNARY = re.compile(
    r"^(?P<c>[^?]+?)\s*\?\s*(?P<a>'[^']*'|\"[^\"]*\")\s*:\s*(?P<b>'[^']*'|\"[^\"]*\")$"
)
_SIGNS = (
    (re.compile(r"\b(?:Math|math|np|numpy)\."), ""),
    (re.compile(r"&&"), " and "),
    (re.compile(r"\|\|"), " or "),
    (re.compile(r"!(?!=)"), " not "),
    (re.compile(r"===?"), "=="),
    (re.compile(r"\^"), "**"),
    (re.compile(r"≤"), "<="),
    (re.compile(r"≥"), ">="),
)


def expressed(question: str) -> Calculated | Which | None:
    """What an expression in a truth's own names asks for; None of other questions."""
    if _IDENTIFIER.search(question) is None:
        return None
    said = _SAID_UNIT.search(question)
    text, behind = _bare(question)
    unit = said["unit"] if said else behind
    try:
        expression = Expression(text)
    except ValueError:
        return None
    if not expression.names:
        return None
    if text in CLASSES:
        return Which(name=text)
    if expression.choices or expression.result == "condition":
        return Calculated(truth=text, unit=None)
    if expression.result != "number":
        return None
    return _in_unit(expression, _SPELLED.get(unit, unit))


def _bare(question: str) -> tuple[str, str]:
    """The expression alone, and the unit behind it; '' without one."""
    text, unit = _COMMENT.sub("", question.strip()).strip(), ""
    for _ in range(3):
        text = _ASKED.sub("", text) if _TERNARY.match(text) is None else text
        if (behind := _UNIT_BEHIND.search(text)) and (
            _SPELLED.get(behind["unit"], behind["unit"]) in UNITS and behind.start() > 0
        ):
            text, unit = text[: behind.start()], behind["unit"]
        if call := _CALL.match(text):
            text = call["x"].strip()
        text = _LEADS.sub("", text).strip()
    if found := _TERNARY.match(text):
        text = f"{found['a']} if {found['c']} else {found['b']}"
    for sign, written in _SIGNS:
        text = sign.sub(written, text)
    return " ".join(text.split()), unit


def _in_unit(expression: Expression, unit: str) -> Calculated | None:
    """A number in the unit that is said, or in that of its names where they share one."""
    units_of = {unit_of_name(name) for name in expression.names}
    is_plain = not expression.divided and _OTHER_DIMENSION.search(expression.text) is None
    own = next(iter(units_of)) if len(units_of) == 1 and is_plain else ""
    factor = expression.power_of_ten
    if unit == "%" and expression.is_percentage:
        return Calculated(truth=expression.text, unit=unit)
    if own and unit in UNITS and UNITS[unit].dimension == UNITS[own].dimension:
        if factor == 1:
            return Calculated(truth=expression.text, unit=unit)
        if abs(factor * UNITS[unit].size / UNITS[own].size - 1) < 1e-9:
            return Calculated(truth=f"({expression.text}) / {factor:g}", unit=unit)
    if len(units_of) > 1 and unit in UNITS and factor == 1:
        return Calculated(truth=expression.text, unit=unit)
    return Calculated(truth=expression.text, unit=own if factor == 1 else "")
