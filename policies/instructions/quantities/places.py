"""Lengths that a text names with what they bound, and its words about the place on the pad."""

from __future__ import annotations

import re

from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.force import MARK
from policies.instructions.quantities.force_units import NUMBER, number

_LENGTH = NumberPattern(rf"(?P<a>{NUMBER})\s*(?P<u>mm|millimet\w+|µm|μm|um|microns?|micromet\w+)\b")
_PAD = r"(?:pads?|gels?|sensors?|sensing area|finger ?(?:tip|pad)s?)"
_SIDE = r"(?:left|right|top|bottom|upper|lower|middle|cent(?:re|er)|edge|corner|tip|base|end)"
_PLACE = re.compile(
    rf"\b{_SIDE}(?: \w+){{0,2}}? (?:of|on) (?:the |your |each |both )?{_PAD}\b|"
    rf"\b{_SIDE}[- ](?:\w+ ){{0,2}}?{_PAD}\b|"
    r"\b(?:off-? ?cent(?:re|er)|cent(?:red|ered|ring|ering|rally)|cent(?:re|er) (?:it|the contact))\b(?:[^.;#]{0,20}\d ?(?:mm|millimet\w+))?|"
    rf"{NUMBER}\s*(?:mm|millimet\w+)(?: \w+){{0,3}}? (?:left of|right of|off|above|below|from) (?:the )?(?:cent(?:re|er)|middle|edge)\b|"
    rf"{NUMBER}\s*(?:mm|cm|[µμu]m|millimet\w+|centimet\w+|microns?|micromet\w+)(?: (?:further|more|farther))? (?:(?:to|on|towards?) the )?(?:left|right|top|bottom|tip|base|stem|side|front|back|up(?:wards?)?|down(?:wards?)?|above|below|off|leftwards?|rightwards?|higher|lower)\b(?: of (?:the )?\w+)?|"
    r"\b(?:near|by|at|close to|next to|around|below|above|under) (?:the|its) (?:stem|stalk|calyx|leaves|equator|waist|shoulders?|(?:widest|thickest) (?:point|part|place|spot)|tip|base|left|right)\b(?! of)|"
    rf"\b(?:contact|touch)\w*(?: \w+){{0,4}} (?:left|right|edge|corner|middle)\b"
)
AREA = NumberPattern(
    rf"(?P<a>{NUMBER})\s*(?:%|percent|per cent) (?:of )?(?:the )?(?:\w+ )?(?:pad|area|gel|sensor)"
)

_MOVING = re.compile(
    r"\b(?:mov|shift|carr|bring|slid|slip|lift|push|drag|transport|put|travel|drop|fall|fell|turn|rais)\w*\b[^.;,]*$"
)
"""Before a length: the object is to be moved so far, or has moved."""
_CLAUSE_END = re.compile(r"[,;.]\s|\band\b")
_SLIP = re.compile(r"\b(?:slip|slid|shift|creep|mov(?:e|ement) (?:by )?(?:more|at most))")
_DEEP = re.compile(r"\b(?:deep|depth|indent|into the gel|sink)")


def read_lengths(text: str) -> tuple[float | None, float | None]:
    """Slip and depth that a text names [mm]."""
    slip = depth = None
    for match in _LENGTH.finditer(text):
        mm = number(match["a"]) * (
            1e-3 if match["u"][0] in "µμu" or match["u"].startswith("mic") else 1.0
        )
        left, right = text[max(0, match.start() - 40) : match.start()], text[match.end() :][:25]
        clause = f"{_CLAUSE_END.split(left)[-1]}#{_CLAUSE_END.split(right)[0]}"
        for around in (clause, left + right):
            if _SLIP.search(around):
                slip = mm
                break
            if _DEEP.search(around):
                depth = mm
                break
    return slip, depth


_SLIP_BOUND = NumberPattern(
    rf"(?:,? ?(?:and |but )?(?:let |allow |with |tolerate )?(?:it |a |any |at most |no )?)?"
    rf"\bslip\w*(?: of)?(?: (?:is|by|must be|should be|stays?|to be|limit|bound))?,?"
    rf"(?: (?:at most|up to|under|below|less than|no more than|within|limited to|max(?:imum)?))?"
    rf" ?(?:<=?|≤|:|=)? ?{_LENGTH.pattern}"
)


def without_slip_bound(text: str) -> str:
    """A text with ``MARK`` for the slip that it allows, which says nothing of how firm to grip."""
    return _SLIP_BOUND.sub(f" {MARK}", text)


def place_words(text: str) -> str:
    """Words of a text about the place on the pad, which are not read; '' for none."""
    for match in _PLACE.finditer(text):
        if not (match[0][0].isdigit() and _MOVING.search(text[: match.start()])):
            return match[0]
    return ""
