"""Numbers that stand where a force would, and are none: their unit is unknown, or they are no number."""

from __future__ import annotations

import re
from importlib import resources

from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.elisions import BEFORE_BOUND, BEFORE_VALUE
from policies.instructions.quantities.force_units import ALONE, LOOSE, NUMBER, UNIT
from policies.instructions.quantities.masses import OBJECT

_WORDS = frozenset(
    re.findall(
        r"[a-z]{2,}", (resources.files("policies.instructions") / "words.txt").read_text("utf-8")
    )
)
"""Every word that instructions are read by: behind a number, one of them is no unit."""

_OTHER = re.compile(
    r"°.*|%|[kmh]?pa|psi|m?bars?|atm|[a-z]*pascals?|s|secs?|ms|mins?|h|hrs?|[a-z]*seconds?|minutes?|hours?|[kcdm]?m|[µμu]m|[a-z]*met(?:er|re)s?|"
    r"micro\w*|inch(?:es)?|in|ft|feet|foot|deg|degrees?|c|f|k?hz|rpm|x|st|nd|rd|th|am|pm|[cm]?l|percent|per|pct|kg|kgs|pcs|pieces?|points?|steps?|"
    r"attempts?|tries|try|trials?|repeats?|repetitions?|rounds?|runs?|goes|cycles?|frames?|retries|iterations?|cameras?|sensors?|"
    r"taxels?|contacts?|pads?|gels?|jaws?|sides?|tips?|arms?|points?|waypoints?|layers?|levels?|jobs?|kinds?|ways?|parts?|full|whole|halves|half|thirds?|quarters?|fifths?|tenths?"
)
"""Other units and things that are counted."""

_AFTER = rf"(?P<number>{NUMBER})\s*-?\s*(?!(?:{UNIT}|{LOOSE})\b)(?P<unit>[a-z°µμ]+)\b(?!')"
_BOUNDED = NumberPattern(BEFORE_BOUND + _AFTER)
_VALUED = NumberPattern(
    rf"(?:{BEFORE_VALUE}|\b(?:hold|grip|squeeze|press|grasp)(?: it)? (?:at|to) ){_AFTER}"
)
_ALONE = NumberPattern(rf"^{_AFTER}(?=[ .!]*$)")
_NONE = NumberPattern(
    rf"(?:^|{BEFORE_BOUND}|{BEFORE_VALUE}|\b(?:hold|grip|squeeze|press|grasp|pinch|clamp|push)(?: it| this| the \w+)?(?: (?:at|to))? |\b(?:between|from(?! [\d.]+ ?m\b)) )(?:{NUMBER} ?(?:-|–|to|and) ?)?(?P<number>{NUMBER})\s*-?\s*"
    r"(?P<unit>m/s(?:ec)?[²2]?|m|amps?|stones?|bits?|bananas?|apples|[kmg]?hz|hertz|rpm|°?[cf]|x|notch(?:es)?|ticks?|turns?)(?=\s*(?:$|[.,;:!?)]|(?:of (?:grip |holding )?(?:force|grip|pressure|squeeze)|force|please|on (?:the|it|this|that)|onto|to (?:the|it|this|that)|and|but|thanks)\b))"
)
"""Units that count or measure something else elsewhere ('0.2 m above'), where a force would stand."""
_DERIVED = NumberPattern(
    rf"(?P<number>{NUMBER})\s*(?P<unit>(?:{UNIT})\s?(?:[·⋅*-]\s?|\s)?(?:m|cm|mm|met(?:er|re)s?)\b|[cmk]?nm\b|"
    rf"(?:{UNIT})\s?(?:/|per )\s?(?:s|sec(?:ond)?|[cm]?m|met(?:er|re))\b)"
)
"""Torques, stiffnesses, rates: a force is only a part of them."""

_FORMULA = NumberPattern(
    rf"(?:\b[a-z]+\(\s*{NUMBER}\s*\)|\b{NUMBER} to the (?:power (?:of )?)?{NUMBER}|\b{NUMBER}\)?\s*(?:(?:\^|\*\*)\s*\(?[-+]?|/\s*\(?){NUMBER}\)?|\b{NUMBER}\s*[*×x·]\s?10 ?- ?\d+)\s*(?:{UNIT})\b|"
    rf"(?:\(\s*{NUMBER}\s*[+*/]\s*{NUMBER}\s*\)|(?:√\s*\(?|{NUMBER}\s*[*×x])(?=\d){NUMBER}\)?)\s*(?:{UNIT})\b|"
    rf"{NUMBER}\s*(?:{UNIT})\b\s*(?:\(?\s*(?:\^|\*\*|\*|/|×|·|÷|∕|⁄|x(?= ?\d)|times\b|divided by\b)\s*\d[\d.,]*|: ?\d+(?:\.\d+)?(?=\s*(?:$|[;!]|\.(?!\d)))|quartered\b)"
)
"""Powers, roots and quotients are not worked out."""
_DIGITS = r"(?<![\w.,])\d+(?:[.,]\d+){2,}"
_MALFORMED = NumberPattern(
    rf"(?P<a>{_DIGITS})\s*(?:{UNIT})\b|(?:{BEFORE_BOUND}|{BEFORE_VALUE})(?P<b>{_DIGITS})(?![.,]?\w)"
)
_NO_NUMBER = re.compile(
    rf"{NUMBER} ?[-–] ?\d[\d.,]* ?[-–] ?\d[\d.,]*\s*(?:{UNIT})\b|(?<![\w.,])\d[\d.,]*m?n\d+\b|"
    rf"(?<![\w.,])(?:\d[\d.,]*(?:[:;_'~|\\]\d[\d.,]*| ?\([\d.]+\)| over \d[\d.,]*)\s*|(?<![\w.])[a-z][.,]\d[\d.,]*\s*|(?!0,)\d{{1,3}},\d{{3}}\s*(?=n(?:ewtons?)?\b)|(?<!\d )(?:ii+|iv|vi*|ix|xi*) )(?:{UNIT})\b"
)
"""'0:3 N', '0.8(1) N', '1 over 3 N', 'iv n', 'o,5 N', 'l.2 N'; '1,500 N', which may be 1.5 or 1500."""


_SIGNED_CHANGE = NumberPattern(
    rf"(?:^|(?<=[\s,;:(]))[-−–] ?{NUMBER.removeprefix(ALONE)} ?(?:%|percent|per cent) "
    r"(?:more|less|harder|softer|firmer|gentler|lighter|stronger|weaker|tighter|looser|higher|lower)\b"
)
"""'-50 % more'."""
_SAFETY = re.compile(
    r"\bsafety (?:margin|factor)\b|\b(?:margin|factor) of safety\b|\border of magnitude\b"
)
_OF_WEIGHT = re.compile(
    rf"\b(?:twice|double|thrice|triple|half|(?:{NUMBER}|two|three|four|five|ten)\s?(?:times|x)) (?:(?:of|the|its|his|their|that|this) )*"
    r"(?:own |(?:straw)?berry'?s? |fruit'?s? |object'?s? |egg'?s? )?(?:weight|mass)\b(?! (?:of )?(?:#|as|limit))"
)
"""'Hold it with three times its weight'."""
_PERCENT = rf"{NUMBER}\s*(?:%|percent|per cent)"
_SHARE = rf"(?:{_PERCENT}|\b(?:half|(?:an?|\d) (?:third|quarter|fifth|tenth)s?))"
_YOURS = r"(?: (?:the|your|its|my|our))?(?: (?:gripper|robot|motor|hand|arm)(?:'?s)?)?"
_OF_MOST = re.compile(
    rf"(?:{_PERCENT}(?: of)?{_YOURS} (?:max(?:imum)?|power|strength|capability)|"
    rf"{_SHARE} of{_YOURS} (?:max(?:imum)?|full|peak|total|rated|available|capacity)|"
    r"\bhalf (?:the |your |its )?max(?:imum)?)\b(?! (?:of |is |= ?)?\d)"
)
"""'At 40 % of maximum': what the gripper can do is nothing that a person has seen."""
_VAGUE = re.compile(
    r"\b(?:some|(?:(?P<few>(?:a (?:good )?|only |just |the |with |use |using |apply |about |than |most )few|several)|"
    r"(?:a |any )?(?:handful|number|bunch|dozens|hundreds|lots?|loads?) of|umpteen|(?:god|who) knows how many)(?(few)(?: \d+(?:\.\d+)?)?)(?: odd)?)"
    r" (?:milli-?|kilo-?)?newtons?\b(?! (?:more|less|fewer|extra|harder|firmer|tighter|softer|gentler|lighter|higher|lower|above|below)\b)"
)
"""'A few newtons', 'several hundred millinewtons', whose hundred is in digits by then."""
_DENIED_TWICE = re.compile(
    r"\b(?:do|does|can|could|must|may|should|shall|will|would) (?:not|never) not\b|\bnever not\b|"
    r"\bnot (?:want|wish|like|need|ask|expect)\b[^.;:,#\d]{0,30}?\b(?:not|never|avoid) (?:to )?(?:exceed|go (?:over|above|beyond|past)|pass|top|surpass|cross|(?:use|apply) (?:more|less) than|(?:fall|drop|go) (?:below|under))"
)

_AND_A_BIT = NumberPattern(
    rf"{NUMBER}\s*-?\s*(?:{UNIT})[ ,-]+(?:and|plus|with)[ -](?:(?:maybe|perhaps|just|then|a|an|some|wee|tiny|little|small)[ -])*"
    r"(?:bit|little|touch|tad|hair|smidge\w*|some|something|change|extra|more)(?: (?:more|extra|on top|over|besides))?(?=\s*(?:$|[.,;:!?)]|please|thanks|thank|for|on))"
)
_NAMING = NumberPattern(
    rf"\b(?:the|that|this|those|these|my|our|your|an?|another) (?:[a-z]+ )?{NUMBER}[ -]*(?:{UNIT}) "
    rf"(?:(?!(?:on|onto|for|to|of|and|or|in|at|with|by|from)\b)[a-z]+ )?{OBJECT}"
    r"(?! (?:grip|grasp|hold|squeeze|force|pinch|pressure|setting|limit|recipe|program|mode|profile|preset)\w*)"
)
"""'The 2 N berry'."""
_CUT_OFF = re.compile(
    rf"{NUMBER}\s*(?:{UNIT})?\s*(?:\b(?:to|and|or|but|plus|minus|than)|[-–±])\s*[.!]*$|\b(?:(?:no|not|less|more) than|between)\s*[.!]*$"
    rf"|\bbetween(?: about| around)? {NUMBER}\s*-?\s*(?:{UNIT})\s*(?:$|[.;!](?!\d))"
)
"""'Hold it at 1 to', 'between 1 N': the end of a range is missing."""
_ASKED_TWICE = NumberPattern(
    rf"{NUMBER}\s*-?\s*(?:(?:{UNIT})\s*)?\?+\s*(?:(?:or|maybe|perhaps|no) )*{NUMBER}\s*-?\s*(?:{UNIT})\s*\?"
)
_NO_DIGITS = re.compile(
    r"\b(?:with|at|use|using|apply|most|least|than|exceed|above|below|under|over|about|to|too|for|fore|won|ate|of|(?!a\b)[a-z]|xx+|tb[adc])[ -](?:milli-?|kilo-?)?newtons?\b(?!')"
    r"|\b(?:with|at|to|of|use|is|exceed|than|over|under|above|below|most|least|[=:<>≤≥]) ?m?n ?\d"
    r"|(?:[?_]+|\b(?:xx*|tb[adc])) n\b(?!')"
)
"""'With for newtons', 'use x newtons': what was to be a number is none."""


def undecided_force(text: str, *, is_bounded: bool) -> str:
    """Why the words of a plain text leave a force undecided; '' where they do not.

    Args:
        text: Plain text, its numbers in digits.
        is_bounded: Whether it names a force in numbers.
    """
    if match := _DENIED_TWICE.search(text):
        return f"{match[0]!r} denies a bound twice; say 'at most' or 'at least'"
    if match := _AND_A_BIT.search(text):
        return f"{match[0]!r} leaves the force open; say it as one number, as in '1.5 N'"
    if match := _NAMING.search(text):
        return f"{match[0]!r} names a thing by a force; say 'use 1.5 N' for the grip"
    if match := _CUT_OFF.search(text):
        return f"{match[0].strip()!r} ends in the middle; say both ends, as in '1 to 1.5 N'"
    if match := _ASKED_TWICE.search(text):
        return f"{match[0]!r} asks which force to use; say one"
    if not is_bounded and (match := _NO_DIGITS.search(text)):
        return f"{match[0]!r} has no number; say how many, as in '1.5 N'"
    match = _VAGUE.search(text)
    return (
        f"{match[0]!r} is no number; say how many, as in '1.5 N'"
        if match and (re.search(r"\d", match[0]) or not is_bounded)
        else ""
    )


_AMOUNT = rf"{NUMBER}\s*-?\s*(?:{UNIT})"
_EACH = r"(?:(?:each|every|per|a) (?:\w+ )?(?:second|sec|s|ms|moment|step|time|try|attempt|move|round)\b|at a time\b|step by step\b)"
_STEPS = NumberPattern(
    rf"\b(?:steps|increments|stages|stairs) of {_AMOUNT}\b|"
    rf"\b(?:add|plus|increas\w*|rais\w*|ramp\w*|grow\w*|go(?:ing)? (?:up|down)|step\w* (?:up|down)|lower\w*|reduc\w*|decreas\w*|eas(?:e|ing)|tighten\w*)\b[^.;\d]{{0,30}}{_AMOUNT}\b[^.;\d]{{0,12}} {_EACH}|"
    rf"{_AMOUNT} (?:more|less|extra|harder|softer|firmer|higher|lower) {_EACH}"
)
"""'Add 0.1 N every second', 'in steps of 0.1 N'."""


def open_force(text: str) -> str:
    """Why a text leaves a force to a margin or factor of safety, or to time; '' for none."""
    if match := _STEPS.search(text):
        return (
            f"{match[0]!r} changes the force in steps; say a least and a most, as in '0.5 to 1 N'"
        )
    match = _SAFETY.search(text)
    if match is None or not _has_force(text):
        return ""
    return f"{match[0]!r} leaves the force open; say it as one number, as in '1.5 N'"


_TORN = NumberPattern(rf"(?<![\w.,])(?:[1-9] ?(?:\. | [.,])|(?<=with )[1-9], )\d+\s*(?:{UNIT})\b")
"""'1 .2 N'."""
_ENDLESS = NumberPattern(rf"\d(?:[.,]\d+)?e[+-]?\d{{5,}}\s*(?:{UNIT})\b")
"""'1e99999 N'."""
_FORCE = NumberPattern(rf"{NUMBER}\s*-?\s*(?:{UNIT})\b")


def unknown_force(text: str) -> str:
    """Why a number of a plain text is no force although it stands for one; '' for none.

    Args:
        text: Plain text, its numbers in digits.
    """
    for malformed in _MALFORMED.finditer(text):
        digits = malformed["a"] or malformed["b"]
        if not re.fullmatch(NUMBER, digits):
            return f"{digits!r} is no number; say it as '1.2 N'"
    if match := _TORN.search(text):
        return f"{match[0]!r} is no number; say it as '1.2 N'"
    if match := _NO_NUMBER.search(text):
        return f"{match[0]!r} is no number; say it as '1.2 N'"
    if match := _ENDLESS.search(text):
        return f"{match[0]!r} is no force; say it as '1.2 N'"
    if match := _OF_WEIGHT.search(text):
        return f"{match[0]!r} is a multiple of a weight; say the force in newtons, as in '1.5 N'"
    if match := _OF_MOST.search(text):
        return f"{match[0]!r} is a part of what the gripper can do; say newtons, as in '1.5 N'"
    if match := _SIGNED_CHANGE.search(text):
        return f"{match[0].strip()!r} has a sign and a direction; say 'half as hard' or '20 % less'"
    if match := _FORMULA.search(text):
        return f"{match[0]!r} is a formula; name the force as one number, as in '1.5 N'"
    if match := _DERIVED.search(text) or _NONE.search(text):
        return _reason(match)
    for pattern in (_ALONE, _BOUNDED) if _has_force(text) else (_ALONE, _BOUNDED, _VALUED):
        for match in pattern.finditer(text):
            unit = match["unit"]
            if not {unit, unit.removesuffix("s")} & _WORDS and not _OTHER.fullmatch(unit):
                return _reason(match)
    return ""


def _has_force(text: str) -> bool:
    return _FORCE.search(text) is not None


def _reason(match: re.Match[str]) -> str:
    words = f"{match['number']} {match['unit']}"
    return f"{words!r}: {match['unit']!r} is no unit of force; say N, as in '1.5 N'"
