"""Clauses that compare what is felt with a number: its unit and a few words tell what is meant.

    we are not squeezing the bun with more than a newton and a half     force_n <= 1.5
    the contact spans upwards of 15 % of the pad                        area_percent > 15
    off centre by more than 3 mm                                        hypot(x_mm, y_mm) > 3
    sure to hold 100 g                                                  holds_g >= 100

Not here: comparisons with the limit or the band (``tacgrasp.lessons.dialogue.clauses.states``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT, unit_of
from tacgrasp.lessons.dialogue.clauses.vocabulary import NEGATIONS, all_known
from tacgrasp.lessons.dialogue.clauses.word_sets import words_of
from tacgrasp.lessons.dialogue.conditions import number_text
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, UNITS

_MORE = (
    r"(?:more|greater|larger|bigger|higher|heavier|deeper|stronger|further|farther|firmer|harder|"
    r"wider|tighter) than|over|above|upwards? of|north of|in excess of|beyond|past|exceed(?:s|ed|"
    r"ing)?|surpass(?:es|ed|ing)?|top(?:s|ped|ping)?|(?:gone|going|goes|go) past|passed|pass"
)
_LESS = (
    r"(?:less|fewer|smaller|lower|lighter|shallower|weaker|nearer|closer|softer|gentler) than|"
    r"under|below|beneath|south of|short of|shy of"
)
_SIGNS = (
    (
        ">=",
        rf"at least|at the least|at minimum|(?:no|not(?: any)?) (?:{_LESS})|a minimum of|minimum|"
        r"reach(?:es|ed|ing)?|(?:comes?|come|gets?|goes) up to|amounts? to at least",
    ),
    (
        "<=",
        rf"at most|at the most|at maximum|(?:no|not(?: any)?) (?:{_MORE})|a maximum of|maximum|"
        r"max|a limit of|does not exceed",
    ),
    (">", _MORE),
    ("<", _LESS),
)
_BEHIND = (
    (
        ">=",
        r"(?:or|and) (?:more|above|over|better|greater|higher|deeper|up|upwards?|heavier|beyond|"
        r"further|stronger|harder)|(?:as )?(?:a )?minimum|at (?:the )?(?:very )?least|upwards?",
    ),
    (
        "<=",
        r"(?:or|and) (?:less|under|below|lower|fewer|shallower|lighter|smaller|closer|nearer|"
        r"softer|weaker|within)|(?:as )?(?:a )?maximum|at (?:the )?(?:very )?most|max|tops",
    ),
)
_BY = r"(?:(?:a|the|full|whole|good|of|by|only|just|about|some|as much as) )*"
_THING = r"(?: (?:deep|of force|of pressure|of indentation|of depth|off|in|down))?"
_NUMBER = rf"{_BY}#(?P<n>\d+)(?: (?P<unit>{UNIT})(?= |$))?{_THING}"
_OF_PAD = r"(?: of (?:the|your|our|its|my|this) (?:\w+ ){0,2}(?:pad|gel|sensor|surface|skin|area))?"
_COMPARED = tuple(
    (sign, re.compile(pattern))
    for sign, pattern in (
        *((sign, rf"(?:^|(?<= )){_NUMBER}{_OF_PAD} (?:{words})(?= |$)") for sign, words in _BEHIND),
        *((sign, rf"(?:^|(?<= ))(?:{words}) {_NUMBER}(?= |$)") for sign, words in _SIGNS),
    )
)
_WITHIN = re.compile(
    rf"(?:^|(?<= ))(?:to )?(?:with)?in {_NUMBER}(?: either way)?"
    r"(?=(?: (?:of|from) (?:\w+ ){0,3}(?:center|middle)| ?$))"
)
_BETWEEN = re.compile(
    rf"(?:^|(?<= ))(?:anywhere |somewhere )?(?:between|"
    rf"from) #(?P<low>\d+)(?: (?P<other>{UNIT}))? (?:and|to) {_NUMBER}(?= |$)"
)
_BARE = re.compile(rf"(?:^|(?<= )){_NUMBER}(?= |$)")
_FLIPPED = {">": "<=", "<=": ">", "<": ">=", ">=": "<"}


@dataclass(frozen=True, slots=True)
class _Meant:
    """A quantity that a clause may be about.

    Attributes:
        truth: Its expression.
        dimension: Dimension of the number's unit.
        marks: What at least one word, or run of words, must be; '' where the unit is enough.
        known: Words that may stand beside.
    """

    truth: str
    dimension: str
    marks: str
    known: frozenset[str]


_PADS = "pad gel sensor skin rubber elastomer jelly membrane silicone surface sensing "
_FORCES = (
    "force forces grip grips gripping gripped grasp grasping squeeze squeezes squeezing squeezed "
    "press presses pressing pressed push pushes pushing pushed pinch pinches pinching pinched "
    "clamp clamps clamping clamped hold holds holding held apply applies applying applied exert "
    "exerts exerting exerted put puts putting pressure contact normal felt feel feels feeling "
    "reading read reads measured show shows shown hard firm firmly tight tightly strongly strength "
    "crush crushing against down worth dose level level's harder firmer "
)
_FORCE_WORDS = words_of(_FORCES)
_DEPTHS = (
    "depth deep deeply indentation indent indents indented dent dents dented penetration penetrate "
    "penetrates penetrated sunk sink sinks sinking sank press presses pressed pressing push pushed "
    "pushing pushes squash squashed squashing squish squished squishing compress compressed "
    "compression hollow deflection deflected deform deformed deformation imprint bite bites biting "
    "dig digs dug far deepest maximum max peak point down contact reading goes range travel scale "
)
_PLACES = (
    "center centered middle bullseye centerline off offset distance away miss misses missed shift "
    "shifted shifts displaced displacement deviation deviate deviates eccentric eccentricity "
    "located contact spot radial radially far farther further position placed lands landed "
)
_AREAS = (
    "area contact patch footprint coverage cover covers covered covering coated fill fills filled "
    "filling span spans spanned spanning take takes taken taking occupy occupies occupied "
    "occupying touch touches touched touching spread spreads pressed press pressing imprint print "
    "impression leave leaves leaving left meet meets reach reaches share fraction percentage "
    "portion proportion squishy soft engaged "
    "wetted involved "
)
_HOLDS = (
    "hold holds holding held carry carries carrying lift lifts lifting lifted bear bears support "
    "supports keep keeps hang hangs manage manages sure surely certain guaranteed guarantee "
    "guarantees definitely safe safely secure securely good enough able grip grasp squeeze force "
    "slip slips slipping drop drops dropping fall falls lose loses losing slide slides mass weight "
    "payload weighing heavy without risk reliably certainty doubt bet trusted trust put strength "
    "strong suffice suffices sufficient "
)


_RANGE = frozenset({"range", "interval", "window", "anywhere", "somewhere"})
_CENTER = r"\b(?:center|centered|middle|bullseye|eccentric\w*|off|offset|centerline)\b"
_SIDEWAYS = r"\b(?:sideways|lateral|laterally|horizontal|horizontally)\b"
_LENGTHWISE = r"\b(?:lengthwise|lengthways|vertical|vertically)\b"
_COVERED = (
    r"\b(?:area|patch|footprint|coverage|cover\w*|fill\w*|span\w*|tak(?:es?|en|ing) up|occup\w+|"
    r"touch(?:es|ed|ing)|contact|spread\w*|imprint|impression|print|pressed|engaged)\b|\bof (?:the|"
    r"your|our|"
    r"its|my|this) (?:\w+ ){0,2}(?:pad|gel|sensor|skin|surface|area|rubber)\b"
)
_SURE = (
    r"\b(?:hold\w*|held|carr\w+|lift\w*|bears?|supports?|keeps?|hang\w*|manage\w*|slip\w*|drop\w*|"
    r"falls?|los(?:es?|ing)|slides?|payload|enough|put|suffic\w+)\b"
)
_MEANT = (
    _Meant("abs(x_mm)", "length", _SIDEWAYS, words_of(_PADS, _PLACES, "sideways lateral laterally "
           "horizontal horizontally")),
    _Meant("abs(y_mm)", "length", _LENGTHWISE, words_of(_PADS, _PLACES, "lengthwise lengthways "
           "vertical vertically")),
    _Meant("-x_mm", "length", rf"\bleft\b(?=.*{_CENTER})|{_CENTER}.*\bleft\b",
           words_of(_PADS, _PLACES, "left")),
    _Meant("x_mm", "length", rf"\bright of\b(?=.*{_CENTER})|{_CENTER}.*\bto the right\b",
           words_of(_PADS, _PLACES, "right")),
    _Meant("y_mm", "length", rf"\b(?:palm|top)\b(?=.*{_CENTER})|{_CENTER}.*\b(?:palm|top)\b|"
           r"\btowards? the palm\b", words_of(_PADS, _PLACES, "palm top towards above side")),
    _Meant("-y_mm", "length", rf"\b(?:fingertip|tip|bottom)\b(?=.*{_CENTER})|{_CENTER}.*"
           r"\b(?:fingertip|tip|bottom)\b|\btowards? the (?:finger)?tip\b",
           words_of(_PADS, _PLACES, "fingertip tip bottom towards toward below side")),
    _Meant("hypot(x_mm, y_mm)", "length", _CENTER, words_of(_PADS, _PLACES)),
    _Meant("depth_mm", "length", r"\b(?:dep\w+|deep\w*|indent\w*|dent\w*|penetrat\w+|s[iau]nk\w*|"
           r"press\w* (?:\w+ )?(?:in|into|down|by)|press\w*|push\w*|squash\w*|squish\w*|"
           r"compress\w*|hollow|defl\w+|deform\w*|imprint|bit\w+|d[iu]gs?)\b",
           words_of(_PADS, _DEPTHS)),
    _Meant("100 - area_percent", "fraction", r"\b(?:free|bare|idle|uncovered|untouched|empty|"
           r"unused|unoccupied|exposed|clear)\b",
           words_of(_PADS, "area free bare idle uncovered untouched empty unused unoccupied "
                           "exposed "
                "clear left share part")),
    _Meant("area_percent", "fraction", _COVERED, words_of(_PADS, _AREAS)),
    _Meant("area_mm2", "area", _COVERED, words_of(_PADS, _AREAS)),
    _Meant("mass_g", "mass", r"\b(?:weighs?|weighing|mass|heavy)\b(?!.*\b(?:hold|lift|carry|"
                             r"slip)\b)",
           words_of("weigh weighs weighing mass weight heavy stated given")),
    _Meant("holds_g", "mass", _SURE, words_of(_HOLDS)),
    _Meant("force_n", "force", "", words_of(_PADS, _FORCES)),
    _Meant("force_n", "mass", r"\b(?:force|gripp(?:ed|ing)|clamped|pinched|press(?:ing|ed)?|"
                              r"squeez\w+|push\w*)\b",
           words_of(_PADS, _FORCES)),
)  # fmt: skip
_SLIPS = re.compile(r"\b(?:slip\w*|drop\w*|falls?|los(?:es?|ing)|slides?)\b")
_IS_SURE = re.compile(
    r"\b(?:sure|surely|certain\w*|guarantee\w*|definitely|safe|safely|secure\w*|enough|able|"
    r"hold\w*|held|suffic\w+|slip\w*|carr\w+|lift\w*|manage\w*|drop\w*|support\w*|bears?)\b"
)


def compared(words: str, numbers: Sequence[float], *, known: frozenset[str] = frozenset()) -> str:
    """The condition that a clause states by a comparison with a number; '' of any other clause.

    Args:
        words: The clause in plain words, with the question's numbers as #1, #2, ...
        numbers: The question's numbers.
        known: Further words that change nothing.
    """
    if words.count("#") == 2 and (found := _BETWEEN.search(words)):
        return _between(words, found, numbers, known)
    if words.count("#") != 1:
        return ""
    for sign, pattern in (("<=", _WITHIN), *_COMPARED):
        if found := pattern.search(words):
            return _compared(words, found, sign, numbers, known)
    return _held(words, numbers, known)


def _compared(
    words: str, found: re.Match[str], sign: str, numbers: Sequence[float], known: frozenset[str]
) -> str:
    if found["unit"] is None:
        return ""
    unit = UNITS[unit_of(found["unit"])]
    rest = f"{words[: found.start()]} {words[found.end() :]}".split()
    negations = [word for word in rest if word in NEGATIONS]
    meant = _meant_by(words, rest, unit.dimension, known)
    if meant is None or len(negations) > 1 or "neither" in negations:
        return ""
    number = numbers[int(found["n"]) - 1] * unit.size
    if meant.truth == "holds_g" and _SLIPS.search(words):
        return ""
    if meant.truth == "force_n" and unit.dimension == "mass":
        number *= GRAVITY_N_PER_G
    sign = _FLIPPED[sign] if negations else sign
    return f"{meant.truth} {sign} {number_text(number)}"


def _between(
    words: str, found: re.Match[str], numbers: Sequence[float], known: frozenset[str]
) -> str:
    if found["unit"] is None or found["other"] not in (None, found["unit"]):
        return ""
    unit = UNITS[unit_of(found["unit"])]
    rest = f"{words[: found.start()]} {words[found.end() :]}".split()
    meant = _meant_by(words, rest, unit.dimension, known | _RANGE)
    if meant is None or NEGATIONS & set(rest):
        return ""
    low, high = sorted(numbers[int(found[name]) - 1] * unit.size for name in ("low", "n"))
    return f"{number_text(low)} <= {meant.truth} <= {number_text(high)}"


def _held(words: str, numbers: Sequence[float], known: frozenset[str]) -> str:
    """What a clause says of holding a mass: 'sure to hold 100 g', '300 g, guaranteed no slip'."""
    found = _BARE.search(words)
    if found is None or found["unit"] is None or not _IS_SURE.search(words):
        return ""
    unit = UNITS[unit_of(found["unit"])]
    rest = f"{words[: found.start()]} {words[found.end() :]}".split()
    if unit.dimension != "mass" or _meant_by(words, rest, "mass", known) is None:
        return ""
    if not re.search(_SURE, words) or not all_known(rest, words_of(_HOLDS) | known | NEGATIONS):
        return ""
    negations = sum(word in NEGATIONS for word in rest)
    slips = _SLIPS.search(words) is not None
    if negations > 1:
        return ""
    sign = ">=" if slips == bool(negations) else "<"
    return f"holds_g {sign} {number_text(numbers[int(found['n']) - 1] * unit.size)}"


def _meant_by(words: str, rest: list[str], dimension: str, known: frozenset[str]) -> _Meant | None:
    """The quantity that the words beside a number are about; None where a word speaks against."""
    for meant in _MEANT:
        if meant.dimension != dimension or not re.search(meant.marks, words):
            continue
        if meant.truth == "holds_g" and re.search(r"\bof force\b|\bforce of\b", words):
            continue
        has_mark = bool(meant.marks) or bool((_FORCE_WORDS | known) & set(rest))
        if all_known(rest, meant.known | known | NEGATIONS, may_name=has_mark):
            return meant
    return None
