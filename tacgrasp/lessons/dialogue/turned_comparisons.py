"""Comparisons whose number comes first, turned round: 'does 2 N exceed the force?'.

    Is 0.3 mm less than the depth?             is the depth more than 0.3 mm?
    Does 2 N exceed what you feel?             is the force less than 2 N?
    Would 1 N be an understatement of the force?    is the force more than 1 N?

Not here: what is left out of a question (``tacgrasp.lessons.dialogue.plainer``).
"""

from __future__ import annotations

import re

_UNIT = (
    r"(?:mm²|mm2|mm\^2|square (?:mm|milli\w+)|mm|milli\w+|µm|um|micro\w+|cm|m?n|cn|%|percent|"
    r"per ?cent|kg|kilo\w*|g|grams?|newtons?)"
)
_NUMBER = (
    r"(?P<number>(?:about |only )?(?:\d+(?:\.\d+)?|half an?|an?|one|two|three|four|five|ten)\s*"
    rf"{_UNIT}(?: of force)?)"
)
_LESS = r"(?:less|smaller|lower|lighter|shallower|fewer)"
_MORE = r"(?:more|greater|larger|bigger|higher|heavier|deeper)"
_WHAT = r"(?P<what>.+)"
_DOES, _WOULD = r"(?:does|do|did|would)", r"(?:is|would|was)"
_ABOVE = (
    rf"(?:is|was) {_NUMBER} (?:still )?{_LESS} than {_WHAT}",
    rf"(?:is|was) {_NUMBER} (?:exceeded|surpassed|topped|passed) by {_WHAT}",
    rf"{_DOES} {_NUMBER} (?:fall short of|stay below|lie below|undershoot) {_WHAT}",
    rf"{_WOULD} {_NUMBER} (?:be )?an? (?:understatement|underestimate) (?:of|for) {_WHAT}",
    rf"{_WOULD} {_NUMBER} (?:be )?too low an? (?:guess|estimate|figure) (?:of|for) {_WHAT}",
)
_BELOW = (
    rf"(?:is|was) {_NUMBER} (?:still )?{_MORE} than {_WHAT}",
    rf"{_DOES} {_NUMBER} (?:exceed|surpass|top|outdo|lie above|overshoot) {_WHAT}",
    rf"{_WOULD} {_NUMBER} (?:be )?an? (?:overstatement|overestimate) (?:of|for) {_WHAT}",
    rf"{_WOULD} {_NUMBER} (?:be )?too high an? (?:guess|estimate|figure) (?:of|for) {_WHAT}",
)
_TURNED = [
    (re.compile(pattern, re.I), sign)
    for sign, patterns in (("more", _ABOVE), ("less", _BELOW))
    for pattern in patterns
]
_FELT = re.compile(
    r"what (?:you|we|the pad|the sensor) (?:feel|feels|sense|senses|measure|measures)", re.I
)
_YOU_FEEL = re.compile(r" (?:that )?(?:you|we) (?:feel|sense|measure|report|read)$", re.I)


def turned(question: str) -> str:
    """A question whose number comes first with its subject first; any other one as it is."""
    for pattern, sign in _TURNED:
        if found := pattern.fullmatch(question.strip(" ?")):
            felt = (
                "the depth"
                if re.search(r"mm|µm|micro|milli(?!n)|cm", found["number"], re.I)
                else "the force"
            )
            what = _YOU_FEEL.sub("", _FELT.sub(felt, found["what"]))
            return f"is {what} {sign} than {found['number']}?"
    return question
