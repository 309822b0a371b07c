"""Questions about what no query has, which would be taken for something near.

Is the pressure above 10 kPa?       Would 0.5 N more be too much?
How far is it from the left edge?   Is the force closer to 0.5 N or to 1 N?
"""

from __future__ import annotations

import re

from policies.instructions.quantities.numerals import in_digits

_NUMBER = r"(?<![\d.,])(\d+(?:\.\d+)?)"
_PRESSURE = r"(?:[kmh]?pa|(?:kilo|mega|hecto)?pascals?|psi|bars?|atm)\b"
_NEWTONS = rf"{_NUMBER} ?m?n(?:ewtons?)?"
_SAME = r"(?:(?! and | or |[,;?]).){0,30}"
_PATTERNS = (
    # pressures
    rf"(?:{_NUMBER}|\bin|\bof|\bmany)\s*{_PRESSURE}",
    r"\b(?:average|mean|peak|maximum) pressure\b|\bper (?:area|unit|square|mm|millimet\w+|"
    r"newtons?|n|"
    r"grams?|g|percent|cm|second|minute)\b",
    # which of several conditions hold
    r"\b(?:exactly|at most|only) one\b.*\b(?:hold|holds|true)\b|\bnot both (?:hold|true)\b",
    # units that no answer has
    r"\b(?:in|many) (?:pixels?|px|taxels?|joules?|watts?|volts?|feet|foot|yards?|"
    r"stones?|tons?|tonnes?)\b",
    # multiples
    r"\b(?:[4-9]|\d\d+) times (?:that|this|the|it|as)\b",
    r"\b(?:twice|double|triple|half) the (?:lower|upper|least|most)\b",
    r"\b(?:twice|doubled?|half|halved|tripled?|\d times)(?: of| as \w+ as)?(?: "
    r"(?:the|our|this|their|its))? "
    r"(?:limit|weight|mass|area|pad|contact|distance|time|friction)\b",
    r"\b(?:limit|weight|mass|area|pad|contact|distance|time|friction)\b.{0,20}\b(?:doubled|"
    r"halved|tripled|"
    r"divided by two|twice|half|\d times)\b",
    # the sensor and the gripper themselves
    r"\b(?:resolution|(?:sampling|frame) rate)\b",
    r"\b(?:gripper|jaws?|fingers|hand)\b.*\b(?:width|wide|open|opening|stroke|apart)\b|"
    r"\b(?:width|opening|stroke) of (?:the|your|this|our|my) (?:gripper|jaws?|fingers|hand)\b",
    # sums of a felt and a named number
    rf"{_NUMBER}\s*(?:%|\w+)?\s+(?:more|extra|less|additional|further)\b(?! than)",
    rf"\badd(?:ing|ed)? (?:another |an extra )?{_NUMBER}",
    rf"\b(?:increas|rais|reduc|lower|tighten|loosen|turn)(?:e|es|ed|ing)? "
    rf"(?:\w+ ){{0,3}}?by {_NUMBER}",
    # a named force against the band, and distances from the band's ends
    rf"^(?:is|are|would|will|does|do|can) {_NUMBER} ?\w+ (?:be |lie |fall )?"
    r"(?:with)?in(?:side)? (?:the|our) (?:\w+ )?(?:band|window|range)",
    rf"{_NEWTONS} (?:or (?:more|less) )?(?:above|below|over|under|short of|away from|from) "
    r"(?:the |our )?"
    r"(?:band|(?:lower|upper|bottom|top|low|high)(?:er|est)? (?:end|edge|bound|limit))",
    # a named force alone, the load that one holds, the nearer of two
    rf"^is {_NEWTONS} (?:ok|okay|fine|alright|safe|good)[?.! ]*$",
    r"\b(?:mass|weight|load|heavy|grams|much)\b.*"
    rf"\b(?:can|could|will|would|does|do) {_NEWTONS}\b",
    rf"\b(?:closer|nearer) to {_NUMBER}.* or\b.*{_NUMBER}",
    # a number to be converted, and one of two comparisons that nothing else reads
    rf"^(?:what is|how much is|convert) {_NUMBER} ?\w+ (?:in|to|into)\b",
    rf"{_NUMBER} ?\w+,? or (?:\w+ ){{0,2}}(?:over|above|under|below|\w+ than) {_NUMBER}",
    # distances from one edge, both offsets, offsets in other units than mm
    r"\b(?:how (?:far|close|near|many mm)|(?:what|which) (?:is the )?distance)\b.*\b"
    r"(?:left|right|top|bottom|upper|lower|palm|tip|fingertip) (?:side )?"
    r"(?:edge|rim|border|margin)\b",
    r"\b(?:x or y|x and y|(?:both|either) (?:of the )?offsets?)\b.*\d",
    r"\b(?:left|right|tip|palm)wards?\b.*(?:microns?|micromet\w+|[µu]m|cm|centimet\w+)\b",
    # another friction, and another pad, than what answers go by
    rf"\bcoefficient\b|\bfriction (?:of|as|at|is|being) {_NUMBER}",
    r"\b(?:pad|sensor|gel|face)(?: \w+)? (?:is|were|was|measures|spans) "
    rf"{_NUMBER} ?(?:mm|cm|square|by)",
    # units that a quantity can't have
    rf"\b(?:depth|deep|indentation|dent)\b{_SAME} in (?:grams?|g|kg|kilos?|newtons?|m?n|percent)\b",
    rf"\b(?:force|squeeze)\b{_SAME} in (?:mm|millimet\w+|microns?|micromet\w+|[µu]m|cm)\b",
    rf"\b(?:area|patch|footprint)\b{_SAME} in (?:grams?|g|newtons?|m?n)\b",
    # two numbers that are named, neither of them felt
    rf"^(?:is|are|does|do|would) {_NUMBER} ?\w+ "
    rf"(?:exceed|beat|surpass|(?:\w+ ){{0,2}}?\w+ than) {_NUMBER}",
    # denials that nothing reads
    r"\bneither\b.*\bnor\b",
)
_UNREAD = re.compile("|".join(_PATTERNS), re.I)


def is_beyond(question: str) -> bool:
    """Whether a question is about what no query has, so that none is near."""
    return _UNREAD.search(in_digits(question.lower())) is not None
