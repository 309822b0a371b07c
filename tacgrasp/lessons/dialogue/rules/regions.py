"""Questions about parts of the pad: thirds, quadrants, corner fields, and the sides that cut.

    Is it in the left, center or right third?           'left' if x_mm < -pad_width_mm / 6 else ...
    Is it in the upper third?                           y_mm > pad_height_mm / 6
    Upper-left, upper-right, lower-left or lower-right? ('upper-left' if ... else ...) if ...
    How many sides of the pad cut it?                   cut_left + cut_right + cut_top + cut_bottom
    Does it leave the pad on two opposite sides?        (cut_left and cut_right) or ...
    Off the top, off the bottom, both or neither?       'both' if cut_top and cut_bottom else ...

Not here: halves (``tacgrasp.lessons.dialogue.rules.halves``), one side
(``tacgrasp.lessons.dialogue.rules.edges``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.phrases import is_made_of
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.plainer import AUXILIARY

_X, _Y = "pad_width_mm / 6", "pad_height_mm / 6"
_MIDDLE = r"middle|cent(?:er|re)|mid|central"
_ACROSS = {"left": f"x_mm < -{_X}", "right": f"x_mm > {_X}"}
_ALONG = {
    "top": f"y_mm > {_Y}",
    "upper": f"y_mm > {_Y}",
    "bottom": f"y_mm < -{_Y}",
    "lower": f"y_mm < -{_Y}",
}
_WORDS = re.compile(r"[a-z]+(?:-[a-z]+)?|\d+")
_PART = rf"left|top|upper|bottom|lower|{_MIDDLE}|right"
_STRIP = r"(?: one| third| strip| column| row| part)?"
_THIRDS = re.compile(
    rf"\b(?P<a>{_PART})(?P<strip>{_STRIP}) (?:or )?(?:(?:in )?the )?(?P<b>{_PART}){_STRIP} or "
    rf"(?:(?:in )?the )?(?P<c>{_PART})\b(?P<last>{_STRIP})"
)
_OF_PLACE = (
    r"(?:is|s|true|that|does|do|in|into|on|at|the|a|an|of|it|its|this|that|contact|contact's|"
    r"touch|center|centre|middle|object|thing|patch|print|imprint|pad|pad's|gel|sensor|width|"
    r"height|third|thirds|strip|strips|column|columns|row|rows|part|parts|side|by|which|what|"
    r"contains?|holds?|has|have|lies?|sits?|falls?|fall|lands?|landed|lie|sit|be|horizontally|"
    r"vertically|sideways|split|cut|divided?|dividing|into|three|3|equal|one|ones|or|and|looking|"
    r"only|just|would|you|call|say|if|i|we|left|right|top|upper|bottom|lower|mid|central|hand|"
    r"field|fields|region|zone|located|from|to|now|currently|lengthwise|horizontal|vertical|with|"
    r"are|being|where|somewhere|please|sitting|resting|lying|standing|fingertip|sensing|area|near|"
    r"end|towards?|tip|palm)"
)
_THIRD = re.compile(
    rf"(?:(?:in|within|into|on) )?(?:the )?(?P<word>left|top|upper|bottom|lower|{_MIDDLE}|right)"
    r"(?:most| hand)? (?:third|strip|column|row)\b"
)
_QUADRANT = re.compile(
    r"(?=.*\b(?P<top>upper|top)[ -]left\b)(?=.*\b(?:upper|top)[ -]right\b)"
    r"(?=.*\b(?P<bottom>lower|bottom)[ -]left\b)(?=.*\b(?:lower|bottom)[ -]right\b)"
    r"(?!.*\bor (?:the |in the )?(?:middle|cent(?:er|re)|neither|none)\b)(?!.*\bcorner\b)"
)
_ONE_QUADRANT = re.compile(
    r"\b(?P<y>upper|top|lower|bottom) (?P<x>left|right) (?:quadrant|quarter)\b|"
    r"\b(?P<first>first) quadrant\b"
)
_CORNER_FIELD = re.compile(
    r"\b(?:one|any) of (?:the |its )?(?:four |4 )?corner (?:fields?|regions?|cells?|bits?|parts?|"
    r"squares?|zones?|areas?)\b|\bin (?:a|any) corner (?:field|region|cell|square|zone|area)\b|"
    r"\b(?:in|at) (?:a|any|the) corner$"
)
_MIDDLE_FIELD = re.compile(
    r"\bin (?:the )?(?:very )?(?:middle|cent(?:er|re)|central) (?:field|cell|square|zone|region|"
    r"ninth|box)\b"
)
_CORNERS = "['top-left', 'top-right', 'bottom-left', 'bottom-right']"

_SIDES = r"(?:sides?|edges?|rims?|borders?|boundar(?:y|ies))"
_RUNS = (
    r"\b(?:run|runs|ran|running|cross|crosses|crossing|cut|cuts|clip|clips|clipped|leave|leaves|"
    r"leaving|lose|loses|hang|hangs|go|goes|going|spill|spills|overlap|overlaps|off|over|reach|"
    r"reaches|past|touch|touches|extend|extends|exceed|exceeds|stick|sticks|overrun\w*|"
    r"truncat\w+)\b"
)
_HOW_MANY = re.compile(
    rf"\bhow many (?:of (?:the |its |our )?)?(?:(?:four|4|two|2|pad|pad's|gel|sensor|(?P<axis>"
    rf"lateral|side|horizontal|vertical)) )*{_SIDES}\b"
)
_OF_AXIS = {"vertical": ("top", "bottom")}
_FOUR = ("left", "right", "top", "bottom")
_NUM_CUT = " + ".join(f"cut_{side}" for side in _FOUR)
_COUNTS = {"one": 1, "a single": 1, "two": 2, "three": 3}
_NUMBER_OF = re.compile(rf"\bnumber of (?:(?:the|pad|cut|its) )*{_SIDES}\b")
_EXACTLY = re.compile(
    rf"\b(?:exactly|just|only) (?:on )?(?P<count>one|a single|two|three) {_SIDES}\b"
)
_OR_MORE = re.compile(
    rf"\b(?:at least (?P<least>one|two|three)|(?P<count>one|two|three) or more) {_SIDES}\b"
)
_OPPOSITE = re.compile(rf"\b(?:two|both|any) opposite {_SIDES}\b")
_BOTH_OR_NEITHER = re.compile(
    r"\b(?P<a>left|right|top|bottom)\b(?: \w+)?,? (?:or )?(?:(?:off|over|at|on|past) )?(?:the )?"
    r"(?P<b>left|right|top|bottom)\b(?: \w+)?,? (?:or )?both,? (?:or )?(?:neither|none)\b"
)


_ASKS_YES = re.compile(
    rf"^(?:(?!\b(?:what|which|how|where)\b).)*?\b{AUXILIARY} (?:it|the|we)\b|"
    rf"^{AUXILIARY}\b"
)


def of_region(question: str) -> Calculated | None:
    """What a question asks about a part of the pad; None of any other question."""
    words = " ".join(_WORDS.findall(question.lower()))
    truth = _thirds(words) or _quadrants(words) or _sides(words)
    if not truth and _ASKS_YES.search(words) and " or " not in words:
        truth = _third(words) or _field(words)
    is_count = "+" in truth and not re.search("[<>=]", truth)
    return Calculated(truth=truth, unit="" if is_count else None) if truth else None


def _thirds(words: str) -> str:
    """Which of the three thirds it is in, in the question's words."""
    if (found := _THIRDS.search(words)) is None or not is_made_of(words, _OF_PLACE):
        return ""
    named = (found["a"], found["b"], found["c"])
    strip = found["strip"] if found["strip"] == found["last"] and found["strip"] != " one" else ""
    tests = {word: _ACROSS.get(word) or _ALONG.get(word) for word in named}
    sides = [word for word in named if tests[word]]
    middle = [word for word in named if not tests[word]]
    is_axis = all(word in _ACROSS for word in sides) or all(word in _ALONG for word in sides)
    if len(sides) != 2 or len(middle) != 1 or not is_axis or tests[sides[0]] == tests[sides[1]]:
        return ""
    a, b = sides
    return f"'{a}{strip}' if {tests[a]} else '{b}{strip}' if {tests[b]} else '{middle[0]}{strip}'"


def _third(words: str) -> str:
    """Whether it is in one third of the pad."""
    if (found := _THIRD.search(words)) is None or not is_made_of(words, _OF_PLACE):
        return ""
    word = found["word"]
    if test := _ACROSS.get(word) or _ALONG.get(word):
        return test
    is_across = re.search(r"\b(?:column|width|horizontal\w*|sideways)\b", words)
    is_along = re.search(r"\b(?:row|height|vertical\w*|lengthwise)\b", words)
    if bool(is_across) == bool(is_along):
        return ""
    return f"abs({'x_mm' if is_across else 'y_mm'}) <= {_X if is_across else _Y}"


def _quadrants(words: str) -> str:
    """Which of the four quadrants it is in, in the question's words."""
    text = words.replace("-", " ")
    if (found := _QUADRANT.match(text)) is None:
        return ""
    top, bottom = found["top"], found["bottom"]
    left, right = (f"('{top}-{x}' if y_mm > 0 else '{bottom}-{x}')" for x in ("left", "right"))
    return f"{left} if x_mm < 0 else {right}"


def _field(words: str) -> str:
    """Whether it is in a corner field, or that in the middle."""
    if quarter := _ONE_QUADRANT.search(words.replace("-", " ")):
        if quarter["first"]:
            return "x_mm > 0 and y_mm > 0"
        y = ">" if quarter["y"] in ("upper", "top") else "<"
        return f"x_mm {'<' if quarter['x'] == 'left' else '>'} 0 and y_mm {y} 0"
    if _CORNER_FIELD.search(words):
        return f"position in {_CORNERS}"
    return "position == 'centered'" if _MIDDLE_FIELD.search(words) else ""


def _sides(words: str) -> str:
    """How many sides of the pad cut it, whether opposite ones do, and which of two."""
    if not re.search(_RUNS, words):
        return ""
    if (counted := _HOW_MANY.search(words)) or _NUMBER_OF.search(words):
        named = [side for side in _FOUR if re.search(rf"\b{side}\b", words)]
        if not named and counted and counted["axis"]:
            named = list(_OF_AXIS.get(counted["axis"], ("left", "right")))
        return " + ".join(f"cut_{side}" for side in named or _FOUR)
    if re.search(rf"\bmore than one (?:{_SIDES})\b", words):
        return f"{_NUM_CUT} > 1"
    if several := _OR_MORE.search(words):
        return f"{_NUM_CUT} >= {_COUNTS[several['count'] or several['least']]}"
    if (exactly := _EXACTLY.search(words)) and not re.search(r"\b(?:newton|mm|percent)", words):
        return f"{_NUM_CUT} == {_COUNTS[exactly['count']]}"
    if _OPPOSITE.search(words):
        return "(cut_left and cut_right) or (cut_top and cut_bottom)"
    if found := _BOTH_OR_NEITHER.search(words):
        a, b = found["a"], found["b"]
        none = "neither" if "neither" in words else "none"
        return (
            f"'both' if cut_{a} and cut_{b} else '{a}' if cut_{a} else '{b}' if cut_{b} else "
            f"'{none}'"
        )
    return ""
