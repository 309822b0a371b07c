"""Questions about an edge of the pad: whether it cuts the contact, and whether that is near.

    Is it touching the edge?            check cut.
    Is it touching the left edge?       check cut left.
    Is it cut off on the palm side?     check cut top.
    Does it run off the left or top?    calculate cut_left or cut_top.
    Which edge cuts it?                 word cut_sides.
    Is it close to the right edge?      check near right.

Not here: whether any edge cuts it, and on which side of the middle it lies (``families.contacts``).
"""

from __future__ import annotations

import re

_SIDES = {
    "left": re.compile(r"\bleft(?:most| hand)?\b"),
    "right": re.compile(r"\bright(?:most| hand)?\b(?! now\b)"),
    "top": re.compile(r"\b(?:top|upper|palm|palmar|proximal)\b"),
    "bottom": re.compile(r"\b(?:bottom|lower|tip|fingertip|distal)\b"),
}
_TAG_RIGHT = re.compile(
    r"(?<! the)(?<! on)(?<! at)(?<! to)(?<! or)(?<! and)(?<! from)(?<! is) right$"
)
_EDGE = r"(?:edges?|rims?|borders?|boundary|boundaries|margins?)"
_CUT = (
    r"(?:(?:escap(?:es?|ed|ing)|hidden|hides?|vanish(?:es|ed)?|disappear(?:s|ed)?|leav(?:es?|ing)|"
    r"left) (?:\w+ ){0,3}?(?:past|beyond|over|off|behind|on)|cuts?|cutting|clip(?:s|ped|ping)?|"
    r"crop(?:s|ped|ping)?|truncat(?:es?|ed|ing)|truncation|chop(?:s|ped|ping)?|lop(?:s|ped|ping)?|"
    r"slic(?:es?|ed|ing)|trim(?:s|med|ming)?|sever(?:s|ed|ing)?|shear(?:s|ing)? off|sheared|shorn|"
    r"snip(?:s|ped|ping)?|lost|missing|docked|guillotined|amputat(?:es?|ed|ing)|(?:bit(?:es?|ten|"
    r"ing)?|eat(?:s|en|ing)?|shav(?:es?|ed|ing)|saw(?:s|n|ing)?|tak(?:es?|en|ing)) (?:\w+ "
    r"){0,4}?(?:off|into)|h[au]ng(?:s|ing)? (?:over|off|out)|stick(?:s|ing)? out|pok(?:es?|ed|"
    r"ing) out|jut(?:s|ting)?|protrud(?:es?|ed|ing)|spill(?:s|ed|ing)?|overhang(?:s|ing)?|"
    r"overrun(?:s|ning)?|overshoot(?:s|ing)?|overlap(?:s|ped|ping)?|(?:run|runs|running|ran|go|"
    r"goes|going|went|gone|fall|falls|falling|fallen|fell|slip|slips|slipped|slipping|drop|drops|"
    r"dropped|slid|slide|slides|bleed|bleeds|bleeding|lap|laps|drop|roll|rolls|rolled|extend|"
    r"extends|reach|reaches|pass|passes|passed|lie|lies|lying) (?:partly |partially |right "
    r")?(?:off|over|out|past|beyond)|over the edge|outside|off the (?:pad|edge)|out of the (?:pad|"
    r"sensor|gel))"
)
_MEETS = (
    r"(?:touch(?:es|ed|ing)?|reach(?:es|ed|ing)?|meets?|meeting|hits?|hitting|cross(?:es|ed|ing)?|"
    r"overlap(?:s|ping)?|extends?|extending|over|beyond|past|against|across|up to|outside|off)"
)
_IS_CUT = re.compile(rf"\b(?:{_CUT}\b|{_MEETS}\b.*\b{_EDGE}\b)")
_PAD = r"(?:pad|sensor|gel)"
_MEETS_THE_EDGE = re.compile(
    r"(?:is|are|does|do) (?:it|we|(?:the|our) (?:contact|object|imprint|patch|print)) (?:.*\b)?"
    rf"(?:{_MEETS}|at) (?:the|an|any|its) (?:{_PAD} )?{_EDGE}(?: of (?:the|our|your) {_PAD})?"
)
_IS_NEAR = re.compile(
    rf"\b(?:near|nearby|close to|next to|beside|adjacent to|at)\b(?: \w+){{0,2}} {_EDGE}\b"
)
_NEAR_ANY = re.compile(
    rf"(?:is|are|does|do) (?:it|we|(?:the|our|this) (?:contact|object|imprint|patch|print|touch))"
    rf"(?: (?:very|too|not|anywhere|lie|sit|come))* (?:near|close to|next to|beside) "
    rf"(?:the|an|any|some|its|one) (?:(?:{_PAD}|outer)(?:'s)? )?{_EDGE}"
    rf"(?: of (?:the|our|your) {_PAD})?"
)
_IS_AWAY = re.compile(rf"\b(?:away|far|clear) from\b(?: \w+){{0,2}} {_EDGE}\b")
_WHICH = re.compile(
    rf"\b(?:which|what) (?:{_EDGE}|sides?)\b|\bwhere is it (?:cut|clipped|cropped)\b"
)
_OPEN = re.compile(
    r"^(?:how|why|which|what|where|when|who|by how)\b|\bhow (?:far|close|much|many)\b|"
    r"\b(?:distance|gap|clearance)\b"
)
_MOVES = re.compile(r"\b(?:should|shall|must|move|shift|go|because|if)\b")
_COMPARED = re.compile(r"\b(?:nearer|closer|farther|further|rather)\b.*\bthan\b")
_NO_PAD = re.compile(
    r"\b(?:band|range|window|corridor|target|goal|force|limit|squeeze|cap|newtons?|grams?)\b"
)
_ASKS_WHICH = re.compile(r"\b(?:which|what)\b")
_ALL = re.compile(r"\b(?:both|at once|at the same time|and|as well as|plus)\b")
_OR_BOTH = re.compile(r"\b(?:or|and) (?:perhaps |maybe |even |possibly )?(?:at )?both\b")
_DENIED = re.compile(r"\b(?:not|no part|nothing|never|free of|clear of|neither|nor)\b")

_FREE_OF_CUTS = re.compile(
    r"(?:is|are) (?:it|(?:the|this|our) (?:contact|object|imprint|patch|print|touch)) (?:free|"
    r"clear) of "
    r"(?:any |all )?(?:cut|clip|crop|truncat|chop)\w*(?: offs?)?"
    rf"(?: (?:by|at|on|from) (?:the|an|any) (?:{_PAD} |{_PAD}'s )?{_EDGE}"
    rf"(?: of (?:the|our|your) {_PAD})?)?"
)


def edge_query(words: str) -> str:
    """The query of a question about an edge, in plain words; '' of any other question."""
    words = _TAG_RIGHT.sub("", words)
    if _WHICH.search(words) and _IS_CUT.search(words):
        return "word cut_sides."
    if _FREE_OF_CUTS.fullmatch(words):
        return "check not cut."
    if _NO_PAD.search(words):
        return ""
    if "#" in words or _OPEN.search(words) or _MOVES.search(words) or _COMPARED.search(words):
        return ""
    named = [side for side, pattern in _SIDES.items() if pattern.search(words)]
    denied = "not " if _DENIED.search(words) else ""
    if _NEAR_ANY.fullmatch(words):
        return f"check {'' if denied else 'not '}position centered."
    if not named:
        return f"check {denied}cut." if _MEETS_THE_EDGE.fullmatch(words) else ""
    if _IS_CUT.search(words):
        if len(named) > 1 and _ASKS_WHICH.search(words):
            return "word cut_sides."
        if len(named) > 1:
            is_any = re.search(r"\bn?or\b", words) is not None
            is_all = _ALL.search(_OR_BOTH.sub("", words)) is not None
            if is_any == is_all:
                return ""
            test = (" or " if is_any else " and ").join(f"cut_{side}" for side in named)
            return f"calculate not ({test})." if denied else f"calculate {test}."
        return f"check {denied}cut {named[0]}."
    if _IS_AWAY.search(words) and len(named) == 1:
        return f"check {'' if denied else 'not '}near {named[0]}."
    if _IS_NEAR.search(words) and len(named) == 1:
        return f"check {denied}near {named[0]}."
    return ""
