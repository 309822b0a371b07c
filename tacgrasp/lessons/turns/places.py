"""Follow-ups about sides, axes and the size of the pad, written anew.

    Does it touch the left edge?    And the right?      Does it touch the right edge?
    Does it run off the pad?        On the left?        Is it cut on the left side?
    How far is it off sideways?     And vertically?     How far is it off vertically?
    How wide is the pad?            And its height?     the pad's height?

Not here: which side is meant where none is left out (``tacgrasp.lessons.dialogue.rules``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tacgrasp.lessons.dialogue.meaning import (
    Calculated,
    Check,
    Meaning,
    Which,
    names_of,
    truth_of,
)
from tacgrasp.lessons.turns.leads import END, LEAD, uncapital, without_lead

_SIDES = ("left", "right", "top", "bottom", "upper", "lower", "fingertip", "palm")
_SIDE = re.compile(rf"\b(?:{'|'.join(_SIDES)})\b", re.I)
_OPPOSITE = {
    "left": "right", "right": "left", "top": "bottom", "bottom": "top", "upper": "lower",
    "lower": "upper", "fingertip": "palm", "palm": "fingertip",
}  # fmt: skip
_EDGE = r"(?: one| edge| side| rim| border| end| third| half| row| column)"
_ANOTHER_SIDE = re.compile(
    rf"{LEAD}(?:(?:the )?same(?: \w+)? (?:for|at|to|from) )?(?:(?:up|down) )?"
    rf"(?:top,? )?(?:on |at |to |from |off |over |of |towards? )?(?:the |its )?"
    rf"(?P<side>{'|'.join(_SIDES)}){_EDGE}?"
    rf"(?: too| as well)?{END}",
    re.I,
)
_OTHER_SIDE = re.compile(
    rf"{LEAD}(?:on |at |to |from )?(?:the )?(?:other|opposite)(?:{_EDGE})?{END}",
    re.I,
)
_HOW_MANY_SIDES = re.compile(
    rf"{LEAD}(?:over |on |at |across )?(?:how many|(?:the )?(?:total )?number of)"
    rf"(?: of the)?(?: (?:four|4|cut))?(?: of)? (?:sides|edges|rims|borders)(?: is (?:it|that))?"
    rf"(?:[, ]+(?:altogether|in all|in total|overall))?{END}",
    re.I,
)
_ANY_SIDE = re.compile(
    rf"{LEAD}(?:(?:at|on|over|by|of) )?any(?: (?:other|one))?(?: of the)? "
    rf"(?:sides?|edges?|rims?|borders?)(?: at all)?{END}",
    re.I,
)
_ON_SIDES = re.compile(
    r"(?:on|over|at|off|across) (?:more than one|several|two|both|opposite|at least|only|just) .+",
    re.I,
)
_ALONG = {
    "horizontally": "vertically", "sideways": "vertically", "left-right": "up-down",
    "horizontal": "vertical", "x": "y", "width": "height", "wide": "high",
}  # fmt: skip
_ACROSS = {**_ALONG, **{other: word for word, other in _ALONG.items()}, "vertically": "sideways"}
_ANOTHER_AXIS = re.compile(
    rf"{LEAD}(?:how (?=wide|high))?(?:in |the |its |along )*(?P<axis>{'|'.join(_ACROSS)})"
    rf"(?: direction)?{END}",
    re.I,
)
_WHICH_EDGE = re.compile(
    r"(?:and |but )?(?:(?:on |at )?(?:which|what) (?:edge|side|rim|border)s?(?: is it(?: on)?)?|"
    r"where)(?: exactly| then)?[?.! ]*",
    re.I,
)
_BY_HOW_MUCH_TO = re.compile(
    r"(?:and |but )?(?:by )?how (?:much|far|many newtons)(?: is it| is left| is missing| more)? "
    r"(?:to|until|till|from) (?P<rest>the (?:upper|lower|middle|top|bottom)\b.+?)[?.! ]*",
    re.I,
)
_HOW_FAR = re.compile(
    r"(?:and |but |ok )?(?:by )?how (?:far|many (?:mm|millimet(?:re|er)s))"
    r"(?: (?:do|must|should|would) (?:i|we|you|it)(?: have to| need to)?(?: move)?"
    r"(?: it| that way)?)?[?.! ]*",
    re.I,
)
_PAD_SIDES = {"palm": "top", "upper": "top", "fingertip": "bottom", "lower": "bottom"}
"""Sides of the pad by other names."""
_OF_PAD = re.compile(r"\b(?:its|the|(?P<bare>total|whole|full))(?P<size> (?:(?:whole|total|full|"
                     r"entire) )?(?:width|height|area|size)| area)\b", re.I)  # fmt: skip
_WHOLE_AREA = re.compile(
    r"what area (?:does|do) (?:that|they|these|it) make|the whole pad is(?= how)|what (?:is|does) "
    r"(?:that|it)(?: make)? (?:as an area|in area)",
    re.I,
)
_MOVED = re.compile(
    r"\d+(?:\.\d+)? ?(?:mm|millimet(?:re|er)s?) (?:(?:to the )?(?:left|right)|up|down|upwards?|"
    r"downwards?)",
    re.I,
)


def about_place(question: str, meant: Meaning | None) -> Iterator[str]:
    """A short question about edges, ways and bounds, by what was asked before."""
    side = _ANOTHER_SIDE.fullmatch(question)
    condition = truth_of(meant) if isinstance(meant, Check | Calculated | Which) else ""
    is_cut = bool(re.search(r"\bcut", condition))
    if side and is_cut:
        yield f"Is it cut on the {_PAD_SIDES.get(side['side'].lower(), side['side'])} side?"
    if is_cut and _OTHER_SIDE.fullmatch(question):
        told = next((side for side in _OPPOSITE if condition.endswith(f"cut_{side}")), "")
        if told:
            yield f"Is it cut on the {_OPPOSITE[told]} side?"
    if is_cut and _ANY_SIDE.fullmatch(question):
        yield "Does it run off the pad anywhere?"
    if is_cut and _WHICH_EDGE.fullmatch(question):
        yield "Which edge cuts it?"
    if is_cut and _ON_SIDES.match(without_lead(question)):
        yield f"Is it cut {uncapital(without_lead(question))}"
    if is_cut and _HOW_MANY_SIDES.fullmatch(question):
        yield "How many sides of the pad cut it?"
    if found := _BY_HOW_MUCH_TO.fullmatch(question):
        yield f"How far is the force from {found['rest']}?"
    is_way = isinstance(meant, Which) and meant.name in ("action", "position")
    if is_way and _HOW_FAR.fullmatch(question):
        yield "How far is it from the middle of the pad?"


def about_the_pad(question: str, meant: Meaning | None) -> str:
    """A question about the pad's size, where that was asked for before."""
    names = names_of(meant) if isinstance(meant, Calculated) else ()
    if not names or not set(names) <= {"pad_width_mm", "pad_height_mm"}:
        return ""
    words = re.sub(r"\b(area|width|height) of (?:it|that)\b", r"\1", without_lead(question))
    if _WHOLE_AREA.match(words):
        return _WHOLE_AREA.sub("the pad's total area", words)
    if re.fullmatch(r"(?:height|width|area)[?.! ]*", words, re.I):
        return f"the pad's {'total ' if words.lower().startswith('area') else ''}{words}"
    if re.fullmatch(r"how (?:high|wide|tall|broad)[?.! ]*", words, re.I):
        return f"{words.rstrip('?.! ')} is the pad?"
    return _OF_PAD.sub(
        lambda each: f"the pad's{' total' if each['bare'] else ''}{each['size']}", words, count=1
    )


def with_another_axis(question: str, before: str) -> str:
    """The question before, along the other axis of the pad."""
    asked = _ANOTHER_AXIS.fullmatch(question)
    if asked is None:
        return ""
    across = _ACROSS[asked["axis"].lower()]
    same = [word for word, other in _ACROSS.items() if other == asked["axis"].lower()]
    for word in dict.fromkeys((across, *same)):
        text, count = re.subn(rf"\b{word}\b", asked["axis"].lower(), before, count=1, flags=re.I)
        if count:
            return text
    return ""


def moved_otherwise(question: str, before: str) -> str:
    """The question before, of another shift: 'and 3 mm to the left instead?'."""
    other = re.fullmatch(rf"{LEAD}(?:by )?(?P<shift>{_MOVED.pattern}){END}", question, re.I)
    found = _MOVED.search(before)
    if other is None or found is None:
        return ""
    return f"{before[: found.start()]}{other['shift']}{before[found.end() :]}"


def with_another_side(question: str, before: str) -> str:
    """The question before, about another side."""
    asked, other = _ANOTHER_SIDE.fullmatch(question), _OTHER_SIDE.fullmatch(question)
    places = list(_SIDE.finditer(before))
    if (asked is None and other is None) or len(places) != 1:
        return ""
    side = asked["side"].lower() if asked else _OPPOSITE[places[0][0].lower()]
    return f"{before[: places[0].start()]}{side}{before[places[0].end() :]}"
