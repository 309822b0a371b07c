"""Questions for how far the contact's middle is from a border of the pad, and for the pad's size.

    How far is it from the left edge?                   pad_width_mm / 2 + x_mm
    Do less than 3 mm remain to the right-hand border?  pad_width_mm / 2 - x_mm < 3
    How wide is the pad?                                pad_width_mm

Not here: whether a border cuts or is near (``tacgrasp.lessons.dialogue.rules.edges``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords
from tacgrasp.lessons.dialogue.calculations.phrases import AGAINST, is_made_of, sign_of
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import Term
from tacgrasp.lessons.dialogue.meaning import Calculated

_SIDES: Mapping[str, tuple[str, str]] = {
    "left": (r"left(?:most)?", "pad_width_mm / 2 + x_mm"),
    "right": (r"right(?:most)?", "pad_width_mm / 2 - x_mm"),
    "top": (r"top(?:most)?|upper|palm|palmar|proximal", "pad_height_mm / 2 - y_mm"),
    "bottom": (r"bottom|lower|fingertip|distal", "pad_height_mm / 2 + y_mm"),
}
_PAD = r"(?:pad|sensor|gel|sensing area|sensing surface|skin)"
_BORDER = re.compile(
    rf"\b(?:from|to|and|of|between|before|is|until|till|off|over|past|reach(?:es|ed|ing)?|hits?|"
    rf"across) "
    rf"(?:(?:the|our|its|this|your) )?(?:{_PAD} )?(?:{_PAD}'s )?(?:"
    + "|".join(f"(?P<{side}>{words})" for side, (words, _) in _SIDES.items())
    + rf")(?: hand)?(?: side)?(?: {_PAD})?(?: side)? (?:edge|border|rim|boundary|margin|end)"
    rf"(?: of (?:(?:the|our|its|this|your) )?{_PAD})?\b"
)
_LONG = rf"#\d+ (?:{UNIT})"
_PAD_SIZE = re.compile(
    rf"^(?:(?:the|our|this|your|my) )?{_PAD} (?:is|measures|being|has) {_LONG}(?: (?:wide|broad|"
    rf"high|tall|across|long|by|and|x|width|of width|height|of height|{_LONG}))* (?=[a-z])|"
    rf" (?:(?:given|with|for|at|assuming) )?(?:an? |the )?(?:(?:pad|sensor|gel) )?(?:of )?"
    rf"(?:half )?(?:the |its )?(?:pad )?(?:width|height)(?: (?:is|of|being|equals))? {_LONG}"
    r"(?: high| wide| across)?$"
)
_HOW = re.compile(r"\b(?:how (?:far|close|near|much)|what|distance|gap|clearance|space|room)\b")
_OF_DISTANCE = (
    r"(?:how|far|close|near|much|what|which|distance|gap|clearance|space|room|stretch|length|way|"
    r"the|a|an|is|are|does|do|lie|lies|lying|sit|sits|sitting|press|presses|pressed|pressing|"
    r"stand|stands|be|will|would|have|has|remain|remains|remaining|left|there|it|its|this|that|of|"
    r"from|to|and|between|away|in|inward|inwards|off|on|at|up|with|contact|touch|point|spot|place|"
    r"object|thing|item|berry|imprint|print|patch|center|middle|centroid|pad|gel|sensor|"
    r"now|currently|presently|measured|counted|separates?|separating|travel|travels|go|move|moved|"
    r"before|until|then|rather|than|still|we|i|you|touching|felt|where|straight|slide|slides|"
    r"dividing|divides?|into|reckoned|taken|upward|upwards|downward|"
    r"downwards|leftward|rightward|"
    r"leftwards|rightwards|sideways|horizontally|vertically|measuring|"
    r"counting|height|high|find|found|located|down)"
)
_AGAINST = re.compile(rf"\b(?:{AGAINST}) (?P<by>{_LONG})\b")
_VERB = re.compile(r"(?:is|are|does|do|has|have|will|would) ")
_PAD_IS = re.compile(
    rf"how (?:(?P<wide>wide|broad)|high|tall) is (?:(?:the|your|this|our) )?{_PAD}"
)


def to_border(asked: AskedWords) -> Term | None:
    """The distance of the contact's middle from a border, or the pad's width or height."""
    if found := _PAD_IS.fullmatch(asked.words):
        size = "pad_width_mm" if found["wide"] else "pad_height_mm"
        return Term(expression=size, dimension="length", words="")
    words = _PAD_SIZE.sub("", asked.words)
    found = _BORDER.search(words)
    if found is None or "#" in words or not _HOW.search(words):
        return None
    rest = f"{words[: found.start()]} {words[found.end() :]}"
    return _distance(found) if is_made_of(rest, _OF_DISTANCE) else None


def border_check(asked: AskedWords) -> Calculated | None:
    """Whether that distance is more or less than so much."""
    words = _PAD_SIZE.sub("", asked.words)
    against = _AGAINST.search(words)
    if against is None or words.count("#") > 1 or not (begin := _VERB.match(words)):
        return None
    by = asked.term(against["by"])
    words = f"{words[begin.end() : against.start()]} {words[against.end() :]}"
    found = _BORDER.search(words)
    if found is None or by is None or by.dimension != "length":
        return None
    if not is_made_of(f"{words[: found.start()]} {words[found.end() :]}", _OF_DISTANCE):
        return None
    return Calculated(
        truth=f"{_distance(found).expression} {sign_of(against)} {by.factor}", unit=None
    )


def _distance(found: re.Match[str]) -> Term:
    expression = next(value for side, (_, value) in _SIDES.items() if found[side])
    return Term(expression=expression, dimension="length", words="", is_sum=True)
