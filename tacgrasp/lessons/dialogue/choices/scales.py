"""Scales of words to choose from, and which of them a question offers.

    deeper or shallower         COMPARED: more, less
    too weak, too strong or ok  BAND: below, above, within

Not here: what a choice hangs on (``tacgrasp.lessons.dialogue.choices.choosing``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

GAP = "|"
"""Stands in the rest of a question where an alternative was."""

MOST_BETWEEN = 12
"""Most words between two alternatives. Our choice: longer ones belong to two questions."""

_OR = re.compile(r"\b(?:or|versus|vs|nor)\b")
_OPENING = re.compile(
    r"(?: (?:is|are|was|does|do|it|that|this|they|we|rather|instead|more|on|in|at|to|of|by|as|with|"
    r"towards?|the|a|an|its|our|am|i|still|already|just|only|mostly|mainly|chiefly|largely|"
    r"primarily|maybe|perhaps|should|"
    r"must|shall|nearer|closer|further|farther|off|force|being|be|too|along|if|from|"
    r"will|would|can|could|might|under|"
    r"#\d+|percent|mm|n|g|millimetres?|newtons?|grams?|and))* ?"
)
"""What may stand between 'or' and the alternative behind it."""


@dataclass(frozen=True, slots=True)
class Alternative:
    """An alternative that a question names.

    Attributes:
        value: What it means on its scale.
        said: The question's word for it.
    """

    value: str
    said: str


@dataclass(frozen=True, slots=True)
class Offer:
    """The alternatives of a question, each value once, and what else the question says.

    Attributes:
        options: The alternatives, in the question's order.
        before: Words before the first of them.
        rest: All other words, with ``GAP`` for each alternative.
    """

    options: tuple[Alternative, ...]
    before: str
    rest: str

    @property
    def said(self) -> Mapping[str, str]:
        """The question's words by their values."""
        return {option.value: option.said for option in self.options}


@dataclass(frozen=True, slots=True)
class WordScale:
    """Words that exclude each other.

    Attributes:
        values: Patterns of the words by what they mean.
    """

    values: Mapping[str, str]
    _pattern: re.Pattern[str] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        groups = "|".join(f"(?P<{name}>{words})" for name, words in self.values.items())
        pattern = re.compile(rf"(?<![^ ])(?:{groups})(?![^ ])")
        object.__setattr__(self, "_pattern", pattern)

    def offered(self, words: str) -> Offer | None:
        """The alternatives of this scale that plain words name; None where they name none."""
        found = list(self._pattern.finditer(words))
        options = [Alternative(str(match.lastgroup), _bare(match[0])) for match in found]
        chain = _chain(words, found, options)
        said = {options[place].said for place in chain}
        named = {options[place].value: options[place].said for place in chain}
        if len(named) < 2:
            return None
        gone = [match for match, option in zip(found, options, strict=True) if option.said in said]
        rest = words
        for match in reversed(gone):
            rest = f"{rest[: match.start()]}{GAP}{rest[match.end() :]}"
        values = dict.fromkeys(options[place].value for place in chain)
        before = words[: found[chain[0]].start()].strip()
        return Offer(tuple(Alternative(value, named[value]) for value in values), before, rest)


def _bare(said: str) -> str:
    """An alternative without what only points at it: 'right hand' is 'right'."""
    return re.sub(r"^(?:the|an?|and|some) | hand$| of it$", "", said)


def _chain(words: str, found: Sequence[re.Match[str]], options: Sequence[Alternative]) -> list[int]:
    """Places of the words that 'or' joins, and of those listed before them."""
    pairs = (
        (first, last) for last in range(len(found) - 1, 0, -1) for first in range(last - 1, -1, -1)
    )
    for first, last in pairs:
        if options[first].value == options[last].value:
            continue
        between = words[found[first].end() : found[last].start()]
        joint = _OR.search(between)
        if joint is None or between.count(" ") > MOST_BETWEEN:
            continue
        if _OPENING.fullmatch(between[joint.end() :].rstrip()):
            return [*_listed(words, found, first), last]
    return []


def _listed(words: str, found: Sequence[re.Match[str]], place: int) -> list[int]:
    """A word's place behind those of the words that are listed before it."""
    between = words[found[place - 1].end() : found[place].start()].rstrip() if place else GAP
    if _OPENING.fullmatch(between.replace(" or", "")):
        return [*_listed(words, found, place - 1), place]
    return [place]


_HARDER = r"(?:harder|more|tighter|firmer|stronger|further)"
_SOFTER = r"(?:softer|less|lighter|looser|gentler|weaker)"
_SQUEEZE = r"(?:squeeze|grip|press|push|pinch|clamp|hold)(?: (?:it|on it|on|the \w+))?"
COMPARED = WordScale(
    {
        "least": r"at least(?: that| as \w+)?|no less",
        "most": r"at most|no more|up to",
        "more": (
            r"and (?:over|above|more|up(?:wards)?|higher)|over|above|more|deeper|"
            r"heavier|bigger|larger|higher|greater|stronger|harder|firmer|"
            r"longer|wider|further|farther|beyond|past|tighter|exceeds?|exceeding|in excess|"
            r"broader|thicker|taller|upwards|in excess of"
        ),
        "less": (
            r"under|below|less|shallower|lighter|smaller|lower|lesser|weaker|softer|gentler|"
            r"within|shorter|narrower|thinner|nearer|closer|falls? short|short|shy|beneath|fewer|"
            r"looser"
        ),
    }
)
"""More or less than something."""

STEP = WordScale(
    {
        "more": (
            rf"tighten(?: up| it)?|{_SQUEEZE} {_HARDER}|{_HARDER} (?:force|grip|pressure|squeeze)|"
            r"(?:increase|raise|add)(?: (?:the )?(?:force|grip|pressure|squeeze))?|add to it|"
            r"clamp down|bear down|step it up|firm up|close (?:further|more|a bit)|put more on|"
            r"more|harder|tighter|firmer|up it"
        ),
        "less": (
            rf"loosen(?: up| off| it)?|{_SQUEEZE} {_SOFTER}|"
            rf"{_SOFTER} (?:force|grip|pressure|squeeze)|"
            r"(?:ease|let|back|slacken|lay|dial)(?: (?:it|up))? (?:off|up|back|down)(?: a (?:bit|"
            r"little|touch))?|ease|slacken|"
            r"(?:decrease|reduce|lower|cut|drop)(?: (?:the )?(?:force|grip|pressure|squeeze))?|"
            r"relax|let go a (?:bit|little)|open(?: up)? (?:a (?:bit|little|touch)|slightly)|"
            r"take (?:some|a (?:bit|little)) off|give (?:it )?(?:some )?slack|less|softer|looser|"
            r"gentler|lighter|release(?: a (?:bit|little))?"
        ),
        "keep": (
            r"hold(?: (?:still|on|it|steady|as it is|the force|here))?|"
            r"keep(?: (?:it|going|the (?:force|grip)))?"
            r"(?: (?:as it is|there|like this|steady|so))?|stay(?: (?:put|there|as it is))?|"
            r"leave (?:it|things)(?: (?:be|alone|as it is|as they are|there|so))?|do nothing|"
            r"wait|stop(?: here)?|neither|stand pat|sit tight|maintain(?: it)?|fine|ok(?:ay)?|"
            r"(?:just )?right|enough|as it is"
        ),
    }
)
"""What to do with the force."""

TOUCH = WordScale(
    {
        "touched": (
            r"touch(?:ing|ed)?|in contact|contact|something|anything|(?:an |some |the )?object|"
            r"occupied|pressed|loaded|engaged|in touch|(?:a )?(?:thing|part|load)|covered|"
            r"in use|busy|full|holding something"
        ),
        "free": (
            r"free|empty|nothing(?: at all)?|(?:thin |only |just |plain )?air|clear|bare|untouched|"
            r"no(?: (?:contact|object|touch))?|vacant|idle|unloaded|unoccupied|uncovered|"
            r"not touching|empty handed|out of contact|disengaged|empty (?:air|space)|none|thin air"
        ),
    }
)
"""Whether anything touches."""

MAJORITY = WordScale(
    {
        "more": r"(?:the |a )?majority|mostly (?:covered|touched|pressed)|most(?: of it)?",
        "less": (
            r"(?:the |a )?minority|mostly (?:free|bare|uncovered|untouched|empty|clear)|"
            r"(?:the |a )?smaller (?:part|share)"
        ),
    }
)
COVERED = WordScale(
    {
        "covered": r"covered|touched|pressed|occupied|in contact|used|under load",
        "free": r"free|bare|uncovered|untouched|empty|clear|unused|vacant",
    }
)
"""Parts of the pad, of which one is the larger."""

SIDE_X = WordScale(
    {
        "left": r"left(?:wards?|most)?(?: hand)?|port",
        "right": r"right(?:wards?|most)?(?: hand)?(?! now)|starboard",
    }
)
SIDE_Y = WordScale(
    {
        "palm": (
            r"upper|top|above|up(?:wards?)?|higher(?: up)?|high(?: up)?|palm(?:wards?|ar)?|"
            r"proximal|uppermost"
        ),
        "fingertip": (
            r"lower(?: down)?|bottom|below|down(?:wards?)?|low(?: down)?|"
            r"(?:finger ?)?tip(?:wards?)?|"
            r"distal|beneath|under|lowermost"
        ),
    }
)
AXIS = WordScale(
    {
        "horizontal": (
            r"sideways|horizontal(?:ly)?|x|lateral(?:ly)?|crosswise|crossways|widthwise|widthways|"
            r"across(?: the (?:finger|pad))?|left (?:and |to )?right|side to side|left or right"
        ),
        "vertical": (
            r"lengthwise|lengthways|vertical(?:ly)?|y|up (?:and )?down|endwise|longitudinal(?:ly)?|"
            r"along (?:the )?(?:finger|length|pad)|top (?:and |to )bottom"
        ),
    }
)
BAND = WordScale(
    {
        "below": (
            r"too (?:weak|weakly|light|lightly|little|loose|loosely|low|soft|softly|gentle|"
            r"gently|slack)|weak|light|loose|below|under|beneath|short|low|slack|underneath"
        ),
        "within": (
            r"in between|in (?:band|range)|within|inside|in|ok|okay|fine|alright|just right|"
            r"about right|right|good|on target|spot on|acceptable|correct|as wanted|"
            r"on the mark|bang on|perfect"
        ),
        "above": (
            r"too (?:strong|strongly|hard|much|tight|tightly|high|firm|firmly|heavy|rough)|"
            r"strong|tight|hard|firm|above|over|beyond|high|past"
        ),
    }
)
IN_BAND = WordScale(
    {
        "within": r"in (?:band|range)|within|inside|in|on target",
        "outside": r"outside(?: of)?|out of (?:band|range)|out(?: of)?|off target",
    }
)
LIMIT = WordScale(
    {
        "over": (
            r"over|above|beyond|past|exceed(?:ed|ing|s)?|broken|violated|unsafe|dangerous|"
            r"too much|too (?:hard|high|strong)|over the line|out of bounds|danger"
        ),
        "under": (
            r"within|under|below|inside|safe|ok|okay|fine|alright|respected|kept|still (?:ok|fine)|"
            r"good|in bounds|acceptable|clear|safely (?:under|below|within)"
        ),
    }
)
SIGN = WordScale({"positive": r"positive|plus", "negative": r"negative|minus"})
CENTER = WordScale(
    {
        "centered": r"(?:dead |well )?cent(?:er|ered|ral)|(?:in the )?(?:dead )?middle",
        "off": (
            r"(?:off(?: to| on)? (?:the |a |one )?(?:center|middle|side)|off centered|eccentric|"
            r"out of (?:the )?(?:center|middle)|somewhere else|elsewhere|decentered|not centered)"
        ),
    }
)
"""Whether it lies in the middle cell."""

CUT = WordScale(
    {
        "cut": (
            r"cut(?: off| short)?|clipped(?: off)?|cropped|truncated|partial|incomplete|"
            r"chopped(?: off)?|partly off|hanging over|overhanging|part of it|only part(?: of it)?"
        ),
        "whole": (
            r"whole|complete|entire|full|intact|all of it|the whole(?: thing| of it)?|fully on|"
            r"entirely on|in full|uncut|completely on|all on|the lot"
        ),
    }
)
SLIP = WordScale(
    {
        "stays": (
            r"(?:surely |safely )?held|secure(?:ly held)?|safe|safely held|stays?(?: put)?|holds?|"
            r"firm|sure|sticks?|grips|fine|in hand|steady|okay|ok|keeps? hold"
        ),
        "slips": (
            r"(?:at )?risk(?: of (?:slipping|slip|dropping|falling|loss|being dropped))?|"
            r"slip(?:s|ping|pery)?(?: away| out)?|drop(?:s|ped|ping)?|fall(?:s|ing)?(?: out)?|"
            r"los(?:e|es|t)|unsafe|slid(?:e|es|ing)(?: out)?|insecure|in danger"
            r"(?: of (?:slipping|falling))?|(?:might|may|could|would|will|going to) "
            r"(?:slip|fall|drop|slide)|"
            r"lets? go|escapes?|risky|too heavy|goes"
        ),
    }
)
ENDS = WordScale(
    {
        "low": (
            r"floor|bottom|lower(?:most)?|lowest|low|minimum|min|least|smallest|weak|light|loose"
        ),
        "high": (r"ceiling|top|upper(?:most)?|highest|high|maximum|max|most|greatest|strong|tight"),
    }
)
"""Ends, or halves, of a range."""

ALL = (
    STEP, MAJORITY, COVERED, TOUCH, SLIP, CENTER, CUT, LIMIT, BAND, IN_BAND, ENDS, COMPARED, AXIS,
    SIDE_X, SIDE_Y,
)  # fmt: skip
"""All scales."""
