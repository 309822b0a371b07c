"""Questions for a side, a half or a quadrant of the pad, by the contact's signs of x and y.

    Is it on the fingertip's side of the midline?       check bottom.
    Nearer the top edge than the bottom one, right?     check top.
    Top right quadrant, is that where it is?            calculate x_mm > 0 and y_mm > 0.
    Upper half or lower half?                           calculate 'upper' if y_mm > 0 else 'lower'.
    Which quadrant is it in?                            word side_x; word side_y.

Every word of a question must be known: what else it says is not accounted for. Not here: edges that
cut the contact (``tacgrasp.lessons.dialogue.rules.edges``), offsets
(``tacgrasp.lessons.dialogue.rules.offsets``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tacgrasp.lessons.dialogue.plainer import AUXILIARY

_LEFT, _RIGHT = r"left(?: hand)?", r"right(?: hand)?"
_TOP = r"(?:top|upper|uppermost|palm(?:'s)?(?: side| facing)?|palmar|palmward|proximal|higher)"
_BOTTOM = (
    r"(?:bottom|lower|lowermost|(?:finger ?|finger's )?tip(?:'s)?(?: side)?|fingertip(?:'s)?"
    r"(?: side| facing)?|tipward|distal)"
)
_SIDES: Mapping[str, str] = {"L": _LEFT, "R": _RIGHT, "T": _TOP, "B": _BOTTOM}
_OPPOSITE = {"L": "R", "R": "L", "T": "B", "B": "T"}
_CONDITIONS = {"L": "x_mm < 0", "R": "x_mm > 0", "T": "y_mm > 0", "B": "y_mm < 0"}
_STATES = {"L": "left", "R": "right", "T": "top", "B": "bottom"}
_PAD = (
    r"(?:of (?:the |our |your |my )?(?:whole )?"
    r"(?:pad|gel|sensor|sensing (?:area|surface|face)|finger|face|surface|skin|rubber|cushion))"
)
_HALF = r"(?:half|halves|hemisphere|side|part|portion|end|flank|half plane)"
_EDGE = r"(?:edge|rim|border|end|side|boundary|margin|half|part|one)"
_TO = (
    r"(?:towards?|faces|facing|nearest(?: to)?|closest to|next to|near|nearer(?: to)?|closer to|"
    r"by|at|on)"
)
_FROM = r"(?:away from|farthest from|furthest from|opposite(?: to| from)?|not towards?)"
_MIDDLE = (
    r"(?:(?:the |its |our )?(?:very |exact |vertical |horizontal |pad(?:'s)? |central |dead )*"
    r"(?:middle|center|midline|mid line|cent(?:er|re) ?line|middle line|midpoint|mid point|median|"
    r"equator|"
    r"line)(?: line)?)"
)
_NEARER = r"(?:nearer|closer|more)(?: to| towards?)?"


def _phrases(side: str) -> tuple[str, ...]:
    """Patterns of what means a side, the longest first."""
    named, other = _SIDES[side], _SIDES[_OPPOSITE[side]]
    across = {"L": "left", "R": "right"}.get(side)
    beside = (
        rf"(?:to |on )?(?:the )?(?:{across}|{across} hand side) of {_MIDDLE}|{across}wards? of "
        rf"{_MIDDLE}|"
        rf"off to the {across}|(?:to|towards?|on) the {across}(?: hand)?(?: (?:side|half|edge|rim|"
        r"end))?"
        if across
        else rf"(?:(?:above|over|higher (?:up )?than|north of) {_MIDDLE}|above it)|"
        r"(?:higher|further|farther) up"
        if side == "T"
        else r"(?:(?:below|under|beneath|underneath|lower (?:down )?than|south of) "
        rf"{_MIDDLE}|below it)|"
        r"(?:lower|further|farther) down"
    )
    more = (
        rf"more (?:(?:to|on|towards?|in) the )?{across} than (?:(?:to|on|towards?|in) the )?{other}"
        if across
        else rf"more (?:to|on|towards?|in) the {named} than (?:(?:to|on|towards?|in) the )?{other}"
    )
    return (
        rf"{more}|(?:(?:higher|lower) (?:up|down) )?{_NEARER} (?:the )?{named}(?: {_EDGE})? "
        r"(?:rather )?than "
        rf"(?:it is )?(?:to |towards? )?(?:the )?{other}(?: {_EDGE})?",
        rf"(?:in |on |within |to |at )?(?:the |its )?(?:{_HALF} (?:{_PAD} )?(?:that is |which is |"
        r"that lies |lying |that |which )?"
        rf"{_TO} (?:the )?{named}(?: {_EDGE})?|"
        rf"{_HALF} (?:{_PAD} )?(?:that is |which is |that lies |lying )?{_FROM} (?:the "
        rf")?{other}(?: {_EDGE})?|"
        rf"{named}(?: most)? {_HALF}(?: {_PAD}| of {_MIDDLE})?)",
        beside,
        rf"(?:{_NEARER}|towards?) (?:the )?{named}(?: {_EDGE})?",
    )


_REGIONS = tuple(
    (side, re.compile(rf"\b(?:{pattern})(?![\w'])"))
    for place in range(4)
    for side in "LRTB"
    for pattern in (_phrases(side)[place],)
)
_CORNERED = re.compile(
    rf"\b(?:in |on )?(?:the )?(?:(?P<y>(?P<T>{_TOP})|(?P<B>{_BOTTOM}))[ -](?P<x>{_LEFT}|{_RIGHT})|"
    rf"(?P<x2>{_LEFT}|{_RIGHT})[ -](?:(?P<T2>{_TOP})|(?P<B2>{_BOTTOM}))) (?:hand )?"
    rf"(?:quadrant|quarter)(?: {_PAD})?"
)
_RATHER = re.compile(
    r",? ?\b(?:rather than|instead of|as opposed to|and not) (?:on |in |to |towards? |at )?(?:the "
    r")?"
    rf"(?:{_LEFT}|{_RIGHT}|{_TOP}|{_BOTTOM})(?: {_EDGE})?(?: {_PAD}| of {_MIDDLE})?"
)
_PAIRS = {
    "x": (_LEFT, _RIGHT),
    "y": (
        r"(?:top|upper|above|up|palm|palmar|palmward|proximal|higher(?: up)?)(?:wards?)?",
        r"(?:bottom|lower|below|down|fingertip|tip|tipward|distal|lower down)(?:wards?)?",
    ),
}
PAIR = {
    axis: re.compile(
        rf"\b(?:(?:in|on|to|at|towards?|nearer|closer)(?: to)? )?(?:more )?(?:the )?"
        r"(?:(?:one|half|side|part|end) (?:at|by|near|towards?|nearest(?: to)?|next to|facing|on|"
        r"closest to) (?:the )?)?"
        rf"(?:(?P<a>{one})|(?P<b>{two}))(?: {_HALF}| {_EDGE})?(?: {_PAD}| of {_MIDDLE})?"
        rf"(?: or| versus| vs)(?: rather| is it| does it| more| was it)*"
        rf"(?: (?:in|on|to|at|towards?|nearer|closer)(?: to)?)?(?: the)?"
        r"(?: (?:one|half|side|part|end) (?:at|by|near|towards?|nearest(?: to)?|next to|facing|on|"
        r"closest to)(?: the)?)?"
        rf" (?(a)(?P<b2>{two})|(?P<a2>{one}))(?: {_HALF}| {_EDGE})?"
        rf"(?: {_PAD}| (?:of )?{_MIDDLE})?(?![\w'])"
    )
    for axis, (one, two) in _PAIRS.items()
}
FILLERS = frozenset(
    """
    a an the this that it its am mean dent bit i'm she he is are was were be been being do does
    did has have had can could may might would will i we you they my our your one there here where
    which what whereabouts midline line
    in on at to of with within inside somewhere anywhere for me us and so then now still just only
    really actually clearly mostly mainly rather slightly somewhat roughly about quite already
    lie lies lying lay sit sits sitting sat rest rests resting land lands landed landing located
    situated placed positioned place place's located found find end ended ending up
    come came over down fall
    falls fell stand stands stay stays touch touched touches touching contact contacts meet meets
    met make makes made hit hits catch caught grip grips gripped gripping hold holds held holding
    grab grabbed grasp grasped press pressed presses pressing pressure pressed force's bear bears
    object objects thing things item items piece pieces part parts body target load workpiece
    center middle midpoint centroid point spot patch imprint print footprint mark blob bump
    centered pad pad's gel sensor sensor's surface area skin finger rubber
    say said tell call put happen happens take taking taken place side half sides quadrant quarter
    confirm deny or true correct yes no right false whether if agree think reckon guess believe
    wonder asked ask know please thanks hey ok okay well listen
    feel feels felt sense by going according measured
    direction way position drifted drift shifted shift slid moved wandered off gone went strayed
    not never
    """.split()  # noqa: SIM905
)
_NOT_YES = re.compile(r"\b(?:not|never)\b")
_TAGS = re.compile(
    rf"(?: {AUXILIARY} (?:not )?(?:it|they|we|she|he|that|this|you|i)(?: not)?|"
    r"(?<! or)(?<! the)(?<! on)(?<! to) right| yes| no| correct| is it(?: not)?| is it so|"
    r" is that (?:right|so|correct|true)| am i right| does it(?: not)?| true| confirm or deny| "
    r"true "
    r"or false| yes or no| or not| or no| innit)+$"
)
_OPENING = re.compile(
    r"^(?:(?:would|do) you say(?: that)?|(?:can|could) you (?:tell|say|confirm)(?: me)?(?: whether|"
    r" if| that)?|"
    r"(?:tell|confirm)(?: me)? (?:whether|if|that)?|is it (?:true|so|correct|right|the case) that|"
    r"can it be said that|am i right (?:in thinking |that )?(?:that )?|"
    r"(?:i|we) (?:think|reckon|guess|believe|take it|suppose|gather|say|would say|bet)(?: that)?) "
)
_END_ALONE = re.compile(r"\b(?:upper|lower|top|bottom) (?:end|part)$")
"""It may be an end of the band."""

_DENIED_FIRST = re.compile(r"(?:is|was) (?:it|that) not (?:so|true|right|correct|the case)\b")
"""'Is it not so that it is left' may ask whether it is."""

_QUADRANT = re.compile(
    r"(?:(?:tell|give|name|say)(?: me)?(?: the)? )?(?:in |into |on )?(?:(?:which|what)(?: of the "
    r"(?:four|"
    r"#))? )?"
    r"(?:quadrant|quarter)\b(?P<rest>(?! (?:percent|of the (?:limit|force|band))).*)"
)
_ASKS_FOR_ONE = re.compile(r"\b(?:which|what|name|give|tell)\b|^quadrant(?: please)?(?= |$)")
_QUADRANT_FILLERS = frozenset(
    """
    give say name answer left right palm fingertip tip top bottom upper lower up down and or as in
    please words word both for
    """.split()  # noqa: SIM905
)
_ITS_VERB = re.compile(
    r"\b(?!(?:palm|tip|fingertip|finger|pad|gel|sensor)'s)([a-z]+)('s|'d|'ll)(?![\w'])"
)
_VERBS = {"'s": "is", "'d": "would", "'ll": "will"}


def with_verbs(words: str) -> str:
    """Plain words with the verbs written out that plain words leave: 'which way's it off'."""
    return _ITS_VERB.sub(lambda match: f"{match[1]} {_VERBS[match[2]]}", words)


def half_query(words: str) -> str:
    """The query of a question for a side of the middle, in plain words; '' of any other one."""
    words = with_verbs(words)
    if _DENIED_FIRST.match(words):
        return ""
    if quadrant := _QUADRANT.fullmatch(words):
        if not _ASKS_FOR_ONE.search(words):
            return ""
        allowed = FILLERS | _QUADRANT_FILLERS
        known = all(word in allowed for word in quadrant["rest"].split())
        return "word side_x; word side_y." if known else ""
    return _side(words)


def own_words(found: re.Match[str]) -> tuple[str, str]:
    """The words for the first and the second side of a pair."""
    return found["a"] or found["a2"], found["b"] or found["b2"]


def quoted(word: str) -> str:
    """A side's word as an expression has it: 'left hand' is 'left'."""
    return repr(word.removesuffix(" hand"))


def _side(words: str) -> str:
    """A side or a quadrant that is asked for, or one of two."""
    words = _OPENING.sub("", words)
    for axis, pattern in PAIR.items():
        if found := pattern.search(words):
            rest = f"{words[: found.start()]} {words[found.end() :]}"
            if not all(word in FILLERS for word in rest.split()) or _NOT_YES.search(rest):
                return ""
            first, second = own_words(found)
            sign = "<" if axis == "x" else ">"
            return f"calculate {quoted(first)} if {axis}_mm {sign} 0 else {quoted(second)}."
    bare = _RATHER.sub("", _TAGS.sub("", words))
    sides = []
    if found := _CORNERED.search(bare):
        sides = ["T" if found["T"] or found["T2"] else "B"]
        sides.insert(0, "L" if (found["x"] or found["x2"]).startswith("left") else "R")
        bare = f"{bare[: found.start()]} {bare[found.end() :]}"
    for side, pattern in _REGIONS:
        if found := pattern.search(bare):
            if _END_ALONE.search(found[0]):
                return ""
            sides.append(side)
            bare = f"{bare[: found.start()]} {bare[found.end() :]}"
    left = bare.split()
    if not sides or len({"x" if side in "LR" else "y" for side in sides}) < len(set(sides)):
        return ""
    if (
        not all(word in FILLERS for word in left)
        or "or" in left
        or left[:1] in (["which"], ["what"])
    ):
        return ""
    denied = "not " if _NOT_YES.search(bare) else ""
    if len(set(sides)) == 1:
        return f"check {denied}{_STATES[sides[0]]}."
    test = " and ".join(_CONDITIONS[side] for side in dict.fromkeys(sides))
    return f"calculate not ({test})." if denied else f"calculate {test}."
