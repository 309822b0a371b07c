"""Questions for how far the contact's middle is from a border or a corner, and for the pad's size.

    How far is it from the left edge?                   pad_width_mm / 2 + x_mm
    Do less than 3 mm remain to the right-hand border?  pad_width_mm / 2 - x_mm < 3
    Is it 3 mm clear of every border?                   min(...) >= 3
    How far is it to the nearest border?                min(pad_width_mm / 2 - abs(x_mm), ...)
    How far is it to the farthest border?               max(pad_width_mm / 2 + abs(x_mm), ...)
    With the origin in the lower left corner, what is x?
    Which border is nearest?                            'left' if ... else 'right' ...
    Which corner is nearest?                            'top-left' if ... else ...
    How wide is the pad?                                pad_width_mm

Not here: whether a border cuts or is near (``tacgrasp.lessons.dialogue.rules.edges``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords
from tacgrasp.lessons.dialogue.calculations.phrases import AGAINST, PARTS, is_made_of, sign_of
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import PLAIN, Term
from tacgrasp.lessons.dialogue.meaning import Calculated

_X, _Y = "pad_width_mm / 2", "pad_height_mm / 2"
_SIDES: Mapping[str, tuple[str, str]] = {
    "left": (r"left(?:most)?", f"{_X} + x_mm"),
    "right": (r"right(?:most)?", f"{_X} - x_mm"),
    "top": (r"top(?:most)?|upper|palm|palmar|proximal", f"{_Y} - y_mm"),
    "bottom": (r"bottom|lower|fingertip|distal", f"{_Y} + y_mm"),
}
_TO_UPRIGHT, _TO_LEVEL = f"{_X} - abs(x_mm)", f"{_Y} - abs(y_mm)"
"""Distances from the nearer one of two borders."""

_PAD = r"(?:pad|sensor|gel|sensing area|sensing surface|sensing window|skin)"
_OF_PAD = rf"(?: (?:of|on|in) (?:(?:the|our|its|this|your) )?{_PAD})?"
_RIM = r"(?:edges?|borders?|rims?|boundary|boundaries|margins?|ends?|sides?)"
_BORDER = re.compile(
    rf"\b(?:from|to|and|of|between|before|is|until|till|off|over|past|reach(?:es|ed|ing)?|hits?|"
    rf"across|separates?) "
    rf"(?:(?:the|our|its|this|your) )?(?:{_PAD} )?(?:{_PAD}'s )?(?:"
    + "|".join(f"(?P<{side}>{words})" for side, (words, _) in _SIDES.items())
    + rf")(?: hand)?(?: side)?(?: {_PAD})?(?: side)? (?:edge|border|rim|boundary|margin|end)"
    rf"(?: of (?:(?:the|our|its|this|your) )?{_PAD})?\b"
)
_HIGH, _WIDE = r"(?:(?P<top>top|upper)|bottom|lower)", r"(?:(?P<left>left)|right)"
_CORNER = re.compile(
    rf"\b(?:(?:the|our|its|this|your) )?(?:{_PAD} )?(?:{_PAD}'s )?{_HIGH}(?: hand)? {_WIDE}"
    rf"(?: hand)? corner{_OF_PAD}"
)
_OWN = rf"(?:(?:the|our|its|this|your) )?(?:#\d+ )?(?:{_PAD} |{_PAD}'s )?"
_NEAR = r"(?:nearest|closest|next)"
_ANY_BORDER = re.compile(
    rf"\b(?:(?:{_OWN}{_NEAR}(?: of (?:the )?(?:four|#\d+))?|(?:any|every|each|all|"
    rf"whichever|whatever|either)(?: one)?(?: of {_OWN}|(?= ))(?: (?:the )?(?:four|#\d+))?) ?"
    rf"(?:{_PAD} |{_PAD}'s )?(?P<what>corner|{_RIM}){_OF_PAD}"
    rf"(?: is (?:the )?(?:nearest|closest|nearer|closer)(?: to (?:it|that|the contact))?)?|"
    rf"(?:of )?(?:(?:all )?(?:(?:the|our) )?(?:four|#\d+)(?: {_PAD})? (?P<four>{_RIM}){_OF_PAD}) "
    rf"(?:take |pick |choose )?(?:the|whichever|which)(?: one)?(?: is)? {_NEAR}(?: one)?|"
    rf"{_OWN}(?P<one>corner|border|edge|rim)(?: that| which)? is (?:the )?{_NEAR}(?: to it)?)\b"
)
_NEARER_OF = re.compile(
    rf"(?:the )?(?:nearer|closer|{_NEAR})(?: one)? of (?:the )?(?:#\d+ )?(?:(?P<level>left (?:and|"
    rf"or) (?:the )?right|right (?:and|or) (?:the )?left)|(?:top|upper) (?:and|or) (?:the )?"
    rf"(?:bottom|lower)|(?:bottom|lower) (?:and|or) (?:the )?(?:top|upper)) {_RIM}{_OF_PAD}"
)
_FARTHEST = re.compile(rf"(?:{_OWN})(?:farthest|furthest|remotest|most distant) {_RIM}{_OF_PAD}")
_LONG = rf"#\d+ (?:{UNIT})"
_BY = r"(?:by|x|times)"
_PAD_SIZE = re.compile(
    rf"^(?:(?:the|our|this|your|my) )?{_PAD} (?:is|measures|being|has) {_LONG}(?: (?:wide|broad|"
    rf"high|tall|across|long|by|and|x|width|of width|height|of height|{_LONG}))* (?=[a-z])|"
    rf" (?:(?:given|with|for|at|assuming) )?(?:an? |the )?(?:(?:pad|sensor|gel) )?(?:of )?"
    rf"(?:half )?(?:the |its )?(?:pad )?(?:width|height)(?: (?:is|of|being|equals))? {_LONG}"
    rf"(?: high| wide| across)?$| of (?:the |a |our )?#\d+(?: mm)?(?: {_BY})? #\d+ (?:mm )?{_PAD}\b"
)
_HOW = re.compile(
    r"\b(?:how (?:far|close|near|much)|what|which|distance|gap|clearance|space|room|line)\b"
)
_OF_DISTANCE = (
    r"(?:how|far|close|near|much|what|which|distance|gap|clearance|space|room|stretch|length|way|"
    r"the|a|an|is|are|does|do|lie|lies|lying|sit|sits|sitting|press|presses|pressed|pressing|"
    r"stand|stands|be|will|would|have|has|had|got|remain|remains|remaining|left|there|it|its|this|"
    r"that|of|from|to|and|between|away|in|inward|inwards|off|on|at|up|with|contact|touch|point|"
    r"spot|place|object|thing|item|berry|imprint|print|patch|center|middle|centroid|pad|gel|"
    r"sensor|"
    r"now|currently|presently|measured|counted|separates?|separating|travel|travels|go|move|moved|"
    r"before|until|then|rather|than|still|we|i|you|touching|touched|felt|where|straight|slide|"
    r"slides|"
    r"dividing|divides?|into|reckoned|taken|upward|upwards|downward|"
    r"downwards|leftward|rightward|"
    r"leftwards|rightwards|sideways|horizontally|vertically|measuring|"
    r"counting|height|high|find|found|located|down|"
    r"measure|me|line|crow|flies|as|shortest|smallest|minimum|least|clear|keep|keeps|stay|stays|"
    r"under|below|"
    r"vertical|horizontal|over|above|for|feel|need|so|free|surface|air|bird|flight|keeping|get|"
    r"gets|i'll|"
    r"(?:contact|touch|object|thing|patch|item|print|imprint|dent|spot)'s|midpoint|come|comes|gets|"
    r"dent|trace|apart|separate|extends?|whichever|one|four|level|after|am|going|correction|effect)"
)
_AGAINST = re.compile(rf"\b(?:{AGAINST}) (?P<by>{_LONG})\b")
_CLEAR = re.compile(rf"(?<= )(?P<by>{_LONG}) (?=(?:clear|away|inward|inside|free)\b)")
_VERB = re.compile(
    rf"(?:is|are|does|do|has|have|will|would) |(?=(?:(?:the )?contact(?: center| middle)? )?"
    rf"(?:{AGAINST}) )"
)
_WHOLE_PAD = (
    rf"(?:(?:the|your|this|that|our|its|whole|entire|full) )*(?:(?:sensing|gel|sensor|tactile|"
    rf"touch|"
    rf"finger) )*"
    rf"{_PAD}(?: surface| itself)?(?: (?:that )?(?:you|we) (?:feel|sense|touch)(?: with)?)?"
)
_PAD_IS = re.compile(
    rf"(?:how (?:(?P<wide>wide|broad)|high|tall) is {_WHOLE_PAD}(?: anyhow| anyway)?|"
    r"(?:what is )?(?:(?:the|total|full|whole) )*(?:(?P<width>width|breadth)|height) of "
    rf"{_WHOLE_PAD}|"
    rf"(?:what is )?{_WHOLE_PAD}(?:'s)? (?:(?P<w>width|breadth)|height))"
)
_PAD_RATIO = re.compile(
    rf"(?:what is )?(?:the )?(?:(?:aspect )?ratio of {_WHOLE_PAD}(?: width (?:to|over|by) height)?|"
    rf"width to height ratio of {_WHOLE_PAD})"
)
_PAD_AREA = re.compile(
    rf"(?:what|how (?:large|big|much)) (?:area )?(?:is|has|does) {_WHOLE_PAD}(?: have| in total)?|"
    rf"(?:what is )?(?:(?:the|total|full|whole|entire) )*(?:sens(?:ing|itive) )?(?:area|surface) "
    rf"of "
    rf"{_WHOLE_PAD}|"
    rf"(?:what is )?(?:(?:the|total|full|whole|entire) )+(?:gel|pad|sensor|sensing|"
    rf"sensitive)(?:'s)? "
    rf"(?:area|surface)"
    rf"(?: of {_WHOLE_PAD})?|(?:what is )?(?:the )?size of "
    rf"{_WHOLE_PAD}|(?:what is )?{_WHOLE_PAD}(?:'s)? (?:(?:total|whole|full|entire) )+area"
)
_ORIGIN = re.compile(
    r"\b(?:origin|zero point|coordinates?|coordinate system|image convention|counting from|"
    r"counted from|measured from)\b"
)
_NEW_AXIS = re.compile(
    r"\b(?:what|which|new|the|s|is)(?: is| are)?(?: the)?(?: new)? (?P<axis>[xy])\b(?! (?:still|"
    r"runs?|points?|pointing|to the|goes|going|grows?))|^(?P<first>[xy]) (?:of|in)\b|"
    r"\b(?P<last>[xy]) of (?:the )?contact\b"
)
_BESIDE = re.compile(
    rf"\bhow much(?: of)?(?: (?:the|our|your))? {_PAD}(?: surface)?(?: (?:lies?|is|are|there is|"
    r"remains?|do (?:we|i) have|have we))*(?: still)? (?:to |on )?(?:the )?(?:(?P<left>left)|"
    r"(?P<right>right)|(?P<top>above)|(?P<bottom>below|beneath|under))(?: side)?(?: of)? "
    r"(?P<rest>.+)"
)
_RIM_OR_CORNER = rf"(?:{_RIM}|corners?)"
_WHICH = re.compile(
    rf"\b(?:which|what|name|pick|choose|the|of)\b.*?\b(?:{_RIM_OR_CORNER})\b.*"
    r"\b(?:nearest|closest|nearer|closer)\b|"
    rf"\b(?:nearest|closest)(?: of the (?:four|#\d+))? {_RIM_OR_CORNER}\b"
)
_HOW_FAR = re.compile(r"\bhow (?:far|close|near|much)\b|\b(?:distance|clearance|gap)\b")
_FOUR = r"left|right|top|bottom|upper|lower|one|or|hand"
_OF_WHICH = (
    rf"(?:{_OF_DISTANCE}|{_RIM_OR_CORNER}|nearest|closest|nearer|closer|name|pick|choose|tell|say|"
    rf"{_FOUR}|"
    r"four|#\d+|comes?|lean|leans|towards?|most)"
)


_NAMED_SIDE = (
    rf"(?:the |our )?(?:{_PAD}'s |{_PAD} "
    rf")?(?P<{{0}}>{'|'.join(said for said, _ in _SIDES.values())})"
    rf"(?: hand)?(?: side)?(?P<rim_{{0}}> {_RIM})?{_OF_PAD}"
)
_CLOSER_TO = re.compile(
    rf".*\b(?:closer|nearer|closest|nearest)(?: to)? {_NAMED_SIDE.format('a')} or (?:rather "
    rf")?(?:to )?"
    rf"{_NAMED_SIDE.format('b')}"
)
_ACROSS = re.compile(
    rf"(?:.*\bof the way|.*\bhow far) (?:across|"
    rf"along|over|up|down)\b(?!.*#).*\bfrom (?:the )?(?:{_PAD}'s )?"
    rf"(?P<side>{'|'.join(said for said, _ in _SIDES.values())})\b"
)
"""'What percentage of the way across the pad, from the left?'"""


def to_border(asked: AskedWords) -> Term | None:
    """The distance of the contact's middle from a border, or the pad's width or height."""
    if found := _PAD_IS.fullmatch(asked.words):
        is_wide = found["wide"] or found["width"] or found["w"]
        size = "pad_width_mm" if is_wide else "pad_height_mm"
        return Term(expression=size, dimension="length", words="")
    if _PAD_RATIO.fullmatch(asked.words):
        return Term(expression="pad_width_mm / pad_height_mm", dimension=PLAIN, words="")
    if _PAD_AREA.fullmatch(asked.words):
        return Term(expression="pad_width_mm * pad_height_mm", dimension="area", words="")
    words = _PAD_SIZE.sub("", asked.words)
    is_share = asked.unit == "%" or re.search(rf"\b{PARTS}\b", words)
    if is_share and (across := _ACROSS.search(words)):
        side = _side_named(across["side"])
        size = "pad_width_mm" if side in ("left", "right") else "pad_height_mm"
        share = f"100 * ({_SIDES[side][1]}) / {size}"
        return Term(expression=share, dimension="fraction", words="")
    if expression := _from_corner(words):
        return _length(expression)
    if (beside := _BESIDE.search(words)) and is_made_of(beside["rest"], _OF_DISTANCE):
        return _length(_side_of(beside))
    expression, rest = _distance(words)
    if not expression or re.search(r"#(?!\d+ (?:border|edge|side)s?\b)", rest):
        return None
    is_asked = _HOW.search(words) or asked.unit
    return _length(expression) if is_asked and is_made_of(rest, _OF_DISTANCE) else None


def border_check(asked: AskedWords) -> Calculated | None:
    """Whether that distance is more or less than so much."""
    words = _PAD_SIZE.sub("", asked.words)
    compared = _AGAINST.search(words)
    against = compared or _CLEAR.search(words)
    if against is None or not (begin := _VERB.match(words)):
        return None
    by = asked.term(against["by"])
    expression, rest = _distance(f"{words[begin.end() : against.start()]} {words[against.end() :]}")
    if not expression or by is None or by.dimension != "length":
        return None
    if not is_made_of(rest, _OF_DISTANCE):
        return None
    sign = sign_of(compared) if compared else ">="
    return Calculated(truth=f"{expression} {sign} {by.factor}", unit=None)


def nearest_border(asked: AskedWords) -> Calculated | None:
    """Which of the four borders, or corners, is nearest, in the question's own words."""
    words = asked.words
    if closer := _CLOSER_TO.fullmatch(words):
        return _closer_of(closer)
    if asked.unit or _HOW_FAR.search(words) or not _WHICH.search(words):
        return None
    if not is_made_of(words, _OF_WHICH):
        return None
    named = {side for side, (said, _) in _SIDES.items() if re.search(rf"\b(?:{said})\b", words)}
    if named and len(named) < len(_SIDES):
        return None
    top = "upper" if re.search(r"\bupper\b", words) else "top"
    bottom = "lower" if re.search(r"\blower\b", words) else "bottom"
    if re.search(r"\bcorner", words):
        left, right = (f"('{top}-{x}' if y_mm > 0 else '{bottom}-{x}')" for x in ("left", "right"))
        return Calculated(truth=f"{left} if x_mm < 0 else {right}", unit=None)
    return Calculated(
        truth=(
            f"('left' if x_mm < 0 else 'right') if {_TO_UPRIGHT} < {_TO_LEVEL} else "
            f"('{top}' if y_mm > 0 else '{bottom}')"
        ),
        unit=None,
    )


def _closer_of(found: re.Match[str]) -> Calculated | None:
    """Which of two borders of different directions is nearer; None of opposite ones."""
    sides = [_side_named(found[name]) for name in "ab"]
    if not (found["rim_a"] or found["rim_b"]) or len({side in "left right" for side in sides}) < 2:
        return None
    a, b = (_SIDES[side][1] for side in sides)
    return Calculated(truth=f"'{found['a']}' if {a} < {b} else '{found['b']}'", unit=None)


_FARTHER = re.compile(
    r"(?=.*\b(?:distance|gap|way|space|room|clearance|edges?|borders?|rims?|margin)\b)"
    r"(?=.*\b(?:bigger|larger|greater|longer|wider|farther|further|farthest|furthest)\b)"
    r"(?!.*\b(?:than|how|by)\b)(?:(?:and|so) )?(?:which|what|is|are|where)\b.*"
)
_TWO = re.compile(
    r"\b(?P<a>left|right|top|bottom|upper|lower)\b.*\bor\b.*\b(?P<b>left|right|top|bottom|upper|"
    r"lower)\b"
)
_AWAY = {"left": "x_mm > 0", "right": "x_mm < 0", "top": "y_mm < 0", "upper": "y_mm < 0",
         "bottom": "y_mm > 0", "lower": "y_mm > 0"}  # fmt: skip


def farther_border(question: str) -> Calculated | None:
    """Which of two borders, or of all four, is farther away; None of other questions.

    'What is bigger: the distance to the left edge or to the right edge?'
    """
    words = " ".join(re.findall(r"[a-z]+", question.lower()))
    if _FARTHER.match(words) is None or re.search(r"\d", question):
        return None
    if two := _TWO.search(words):
        a, b = two["a"], two["b"]
        opposite = {_AWAY[a], _AWAY[b]} in ({"x_mm > 0", "x_mm < 0"}, {"y_mm > 0", "y_mm < 0"})
        return Calculated(truth=f"'{a}' if {_AWAY[a]} else '{b}'", unit=None) if opposite else None
    if re.search(r"\b(?:left|right|top|bottom|upper|lower|or)\b", words) or "which" not in words:
        return None
    return Calculated(
        truth=(
            f"('left' if x_mm > 0 else 'right') if {_X} + abs(x_mm) > {_Y} + abs(y_mm) else "
            "('top' if y_mm < 0 else 'bottom')"
        ),
        unit=None,
    )


def _length(expression: str) -> Term:
    return Term(expression=expression, dimension="length", words="", is_sum=True)


def _distance(words: str) -> tuple[str, str]:
    """The distance from the border or corner that words name, and the other words; '' if none."""
    if found := _CORNER.search(words):
        x = _SIDES["left" if found["left"] else "right"][1]
        y = _SIDES["top" if found["top"] else "bottom"][1]
        expression = f"hypot({x}, {y})"
    elif found := _NEARER_OF.search(words):
        expression = _TO_UPRIGHT if found["level"] else _TO_LEVEL
    elif found := _FARTHEST.search(words):
        expression = f"max({_X} + abs(x_mm), {_Y} + abs(y_mm))"
    elif found := _ANY_BORDER.search(words):
        is_corner = (found["what"] or found["four"] or found["one"]) == "corner"
        expression = f"{'hypot' if is_corner else 'min'}({_TO_UPRIGHT}, {_TO_LEVEL})"
    elif found := _BORDER.search(words):
        expression = _side_of(found)
    else:
        return "", words
    return expression, f"{words[: found.start()]} {words[found.end() :]}"


def _side_named(words: str) -> str:
    return next(side for side, (said, _) in _SIDES.items() if re.fullmatch(said, words))


def _side_of(found: re.Match[str]) -> str:
    return next(value for side, (_, value) in _SIDES.items() if found[side])


def _from_corner(words: str) -> str:
    """A coordinate that is counted from a corner of the pad, to the right and upward; else ''.

    From an upper corner y is counted downward where the question says so.
    """
    corner = _CORNER.search(words) or re.search(
        rf"\b{_HIGH} {_WIDE}(?: corner)?(?= y (?:runs?|goes|points?|grows?) down)", words
    )
    if corner is None or not _ORIGIN.search(words) or corner["left"] is None:
        return ""
    rest = f"{words[: corner.start()]} | {words[corner.end() :]}"
    axis = next(filter(None, (each for m in _NEW_AXIS.finditer(rest) for each in m.groups())), "")
    if axis == "x":
        return _SIDES["left"][1]
    is_down = re.search(r"\by (?:\w+ )?(?:runs?|goes|points?|grows?|pointing) down", rest)
    if axis != "y" or (corner["top"] is not None) != (is_down is not None):
        return ""
    return _SIDES["top" if is_down else "bottom"][1]
