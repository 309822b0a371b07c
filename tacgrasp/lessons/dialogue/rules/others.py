"""Questions that readers take for others: sides with a sign, the past, and doubts about a word.

leftward > 2 mm                     check x < -#1 mm.
Which way is it off, sideways?      word side_x.
Is it deeper than before?           unknown past.
Is there any shear?                 unknown trait.
How many dots are there?            unknown trait.
How wide is the contact?            unknown size.
Are you sure about the shape?       why shape.
Is it in a corner of the pad?       calculate position in ('top-left', ...).
Should I squeeze more or less?      choice action.
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.quantity_names import THING

_TOWARD = {
    "left": ("x", "<", "-"), "right": ("x", ">", ""), "tip": ("y", "<", "-"),
    "fingertip": ("y", "<", "-"), "palm": ("y", ">", ""),
}  # fmt: skip
_OFFSET = r"(?:offset|shift|shifted|distance|displacement|deviation|component|off|displaced)"
_MORE = r"more than|over|above|greater than|larger than|bigger than|exceeds?|beyond"
_LESS = r"less than|under|below|smaller than"
_SIDED = re.compile(
    r"(?:(?:is|does|are) )?(?:(?:the|its|our|it|we) )*"
    rf"(?:{_OFFSET} (?:(?:to|towards?) (?:the )?)?)?"
    rf"(?P<side>{'|'.join(_TOWARD)})(?:wards?)?(?: {_OFFSET})?(?: (?:is|by))? "
    rf"(?:(?P<more>{_MORE})|(?P<less>{_LESS})|(?P<least>at least)|(?P<most>at most)) "
    r"# (?:mm|millimetres?)"
)
_TURNED = {"<": ">", ">": "<"}

_WHICH_WAY = re.compile(r"\b(?:which|what) (?:direction|way|side)\b")
_SIDEWAYS = re.compile(r"\b(?:horizontal|horizontally|sideways|laterally|along x|in x)\b")
_LENGTHWISE = re.compile(r"\b(?:vertical|vertically|lengthwise|along y|in y)\b")

_EARLIER = re.compile(
    r"\bhow long (?:ago|(?:has|have|had|did|was|were)\b)|\bsince (?:(?:the )?(?:last|previous|"
    r"start|beginning|first)|then|when|yesterday|(?:we|it) (?:touched|started|began|gripped))\b|"
    r"\b(?:second|moment|while|minute|frame|step)s? (?:ago|before|earlier)\b|\bthe (?:touch|"
    r"reading|grip|contact|frame) before\b|\b(?:just |right )?before (?:touchdown|contact|the "
    r"(?:touch|grip|lift))\b|\bduring (?:the )?(?:approach|closing|last|descent|insertion)\b|"
    r"\b(?:last|previous|prior|former) (?:frame|step|time|touch|reading|second|minute|grasp|"
    r"contact|indentation|press|grip|attempt|object|part|try)\b|\bthan (?:before|earlier|"
    r"previously|a (?:moment|second|while) ago|just now)\b"
)
_TIMES_DONE = re.compile(r"how (?:many times|often) (?:did|have|has|had|was|were)\b")
_CHANGED = re.compile(
    r"\b(?:increas|decreas|chang|grow|shrink|ris|drift)(?:e|ed|es|ing|en|n|s)?\b|"
    r"\b(?:got|gotten|getting|become|became|becoming) (?:any )?(?:more|less|\w+er)\b"
)
_ASKS_CHANGE = re.compile(
    r"(?:is|are|was|has|have|had|did|does)\b(?!.*\b(?:should|must|need|band|limit)\b)"
)

_NOT_NORMAL = re.compile(
    r"\b(?:shear|shearing|tangential|torque|torques|torsion|moment of force|twisting moment|"
    r"(?:closing|approach|opening) speed|velocity|acceleration|how fast|"
    r"lateral (?:force|load)|sideways force|friction force)\b"
)
_EXTENT = re.compile(
    r"how (?:long|wide|broad|tall) (?:is|are) (?:the |this |that )?"
    r"(?:contact|patch|contact patch|imprint|print|footprint|dent|object|thing|it)(?: in \w+)?"
)
_COUNTED = re.compile(
    r"how many (?:(?:dots|stripes|lines|edges|corners|bumps|holes|ridges|sides|points|grooves|"
    r"pits)\b|(?:objects|things|items|fingers|dents|people|hands|berries|pieces|parts) "
    r"(?:are|do|does|is|can|hold|touch|lie|there)\b)"
)
_DOUBT = re.compile(
    r"(?:are|how) (?:you )?(?:really |quite |very |so )?(?:sure|certain|confident)(?: are you)?"
    r"(?: (?:really|at all))? (?:about|of|in|with) (?:(?:the|its|it is|this|that|your) )*"
    r"(?P<what>shape|texture|depth|position|location|force|area|surface)"
)
_REASONS = {"location": "position", "surface": "texture", "force": "felt", "area": "felt"}
_BREAKS_AT = re.compile(
    r"(?:(?:what|which|how much|how many) (?:force|squeeze|newtons?|load|grip|n)|"
    r"(?:at|with|from) (?:what|which) (?:force|squeeze|load|grip|newtons?)|"
    r"how (?:hard|firmly|strongly|tight(?:ly)?|much harder) (?:can|may|could|might|should) "
    r"(?:i|we|you|it|one)"
    r"(?=.*\b(?:before|until|without)\b)) .*\b"
    r"(?:bruis|crush|break|burst|crack|squash|ruptur|split)\w*(?: (?:it|this|that|the \w+))?"
)
"""'What force would bruise it?'"""
_HARDNESS = re.compile(
    r"how (?:hard|stiff|soft|elastic|firm) (?:is|are) (?:the|this|that) "
    r"(?:object|thing|material|skin|item|fruit|berry|body)"
)
_GRID = re.compile(
    r"(?=.*\b(?:grid|raster|# by #|# x #)\b).*\b(?:which|what) (?:box|cell|square|field|sector|"
    r"tile|region|compartment)(?: of (?:the|it|a) .*)? (?:is|does|has|holds?|contains?)\b.*"
)
_HOW_FELT = re.compile(
    r"(?:if (?:i|you|we|one) (?:ran|run|drew|slid|put|moved?|stroked?) (?:an?|my|your) "
    r"(?:thumb|finger|fingertip|hand|nail) (?:over|across|along|on) (?:it|this|the \w+) )?"
    r"how (?:would|does|will|might) (?:it|this|the surface|its surface) feel"
    r"(?: (?:to the touch|under (?:my|your|the) (?:thumb|finger)))?"
)
_WHICH_PART = re.compile(
    r"(?:(?:in|on|at) )?(?:what|which) (?:part|area|region|section|zone|spot) of (?:the |your )?"
    r"(?:pad|gel|sensor)(?: (?:is|does|has|was) (?:it|that|this|the \w+))?"
    r"(?: (?:in|on|at|touching|sitting|pressing))?(?: in (?:words|a word|one word))?"
)
_IN_CORNER = re.compile(
    r"(?:is|was|does|do) (?:it|this|that|the \w+|we|something|anything)(?: \w+){0,3}? (?:in|at|on|"
    r"near|into|within)? ?(?:(?:one|any) of )?(?:(?:the|a|any|its|your) )?(?:# )?corners?(?: "
    r"(?:zones?|regions?|cells?|areas?)(?: .*)?| of (?:the |your |its )?(?:pad|gel|sensor|grid|"
    r"sensing area)(?: .*)?)"
)
_IN_ONE_CORNER = re.compile(
    r"(?:is|was|does|do|are) (?:it|this|that|the \w+|we|something|anything)(?: \w+){0,2}? "
    r"(?:in|at|near|into) (?:(?:one|any|#) of (?:the |its )?(?:# |four )?|an? |any |the )corners?"
)
_SIZE_OF = re.compile(
    r"(?:what is |how (?:large|big|long) is )?(?:the )?(?:radius|diameter|width|height|length|"
    r"thickness|volume|circumference|size) of (?:the|this|that|your|my) (?:whole |entire )?"
    rf"(?:{THING}|ball|sphere|cube|cylinder|rod|ring|disc|disk|tube|screw|bolt|nut)(?: in \w+)?"
)
_CORNERS = "('top-left', 'top-right', 'bottom-left', 'bottom-right')"
_LEFT_BY = re.compile(r"(?:who|which \w+|whose \w+) left (?:it|this|that|the \w+)\b")
_HARDER_OR_SOFTER = re.compile(
    r"(?:should|shall|must|do|can|would) (?:i|we|you) .*"
    r"\b(?:squeeze|press|grip|push|pinch|clamp|hold|tighten)\b.*"
    r"\b(?:more or less|less or more|harder or \w+|softer or \w+|tighter or \w+|"
    r"firmer or \w+|stronger or \w+)"
)


def other_query(words: str) -> str:
    """The query of a question in plain words, if it is one of these; '' of any other one."""
    if sided := _SIDED.fullmatch(words):
        return _sided(sided)
    if _WHICH_WAY.search(words) and bool(_SIDEWAYS.search(words)) != bool(
        _LENGTHWISE.search(words)
    ):
        return "word side_x." if _SIDEWAYS.search(words) else "word side_y."
    if _EXTENT.fullmatch(words) or _SIZE_OF.fullmatch(words):
        return "unknown size."
    if _BREAKS_AT.fullmatch(words) or _HARDNESS.fullmatch(words):
        return "unknown trait."
    if _NOT_NORMAL.search(words) or _COUNTED.match(words):
        return "unknown trait."
    if (
        _EARLIER.search(words)
        or _TIMES_DONE.match(words)
        or (_ASKS_CHANGE.match(words) and _CHANGED.search(words) and "#" not in words)
    ):
        return "unknown past."
    if _LEFT_BY.match(words):
        return "unknown owner."
    in_corner = _IN_CORNER.fullmatch(words) or _IN_ONE_CORNER.fullmatch(words)
    if in_corner and " or " not in words:
        return f"calculate position in {_CORNERS}."
    if _GRID.match(words) or _WHICH_PART.fullmatch(words):
        return "word position."
    if _HOW_FELT.fullmatch(words):
        return "word texture."
    if doubt := _DOUBT.match(words):
        return f"why {_REASONS.get(doubt['what'], doubt['what'])}."
    is_advice = _HARDER_OR_SOFTER.match(words) and "#" not in words
    return "choice action." if is_advice else ""


def _sided(sided: re.Match[str]) -> str:
    name, away, minus = _TOWARD[sided["side"]]
    sign = away if sided["more"] or sided["least"] else _TURNED[away]
    equal = "=" if sided["least"] or sided["most"] else ""
    return f"check {name} {sign}{equal} {minus}#1 mm."
