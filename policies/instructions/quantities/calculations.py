"""Forces that a text leaves to be worked out from others that it names.

'Halfway between 0.4 N and 0.8 N' becomes '0.6 n'. In 'yesterday 0.8 N; knock a quarter off that' the
change becomes '⇒ 0.6 n', where ``WORKED_OUT`` says that the force takes the place of the one before it.
Its patterns take a quarter of a second to compile, so that it is imported for texts with a digit alone.
Not here: sums and multiples that stand beside their force ('1 N plus 0.2 N', ``elisions``), and changes
of the task's force (``factors``).
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from policies.instructions.quantities.force import WORKED_OUT
from policies.instructions.quantities.force_units import ALONE, NUMBER, UNIT, in_newtons, number

_SHARE_OF = re.compile(
    rf"(?<![\w.,/])(?:(?P<a>\d+)\s*/\s*(?P<b>[1-9]\d*)|(?P<c>0?\.\d+)) of (?:the |that |your |our )?(?P<v>{NUMBER})\s*(?P<u>(?:{UNIT})\b)"
)
_CHANGED_TO = re.compile(
    rf"\b(?:reduce|lower|decrease|turn|bring|change|correct|go|drop|move|switch|take|dial|ease|scale|back|cut)\b(?: (?!from\b)[a-z]+){{0,4}}? (?:from )?(?P<v>{NUMBER})\s*(?P<vu>(?:{UNIT})\b)? (?:down )?to (?P<w>{NUMBER})\s*(?P<wu>(?:{UNIT})\b)"
)

_RAISED_TO = re.compile(
    rf"(?<!may )(?<!can )(?<!could )(?<!might )(?<!not )(?<!never )\b(?:increas|rais|boost|bump|step|crank|turn|ramp|push|strengthen|tighten|chang|adjust|correct|switch|updat|modify|revis)(?:e|ing)?\b(?: (?!from\b|not\b|any\w*\b)[a-z]+){{0,5}}? from {NUMBER}\s*(?:(?:{UNIT})\b)? (?:up )?to (?P<force>{NUMBER}\s*(?:{UNIT})\b)"
)


def with_shares(text: str) -> str:
    """Fractions in digits of a force worked out ('1/4 of 2 n'), and what a force is changed to."""

    def share(found: re.Match[str]) -> str:
        part = float(found["c"]) if found["c"] else int(found["a"]) / int(found["b"])
        return f"{part * in_newtons(found['v'], found['u']):.6g} n"

    def lowered(found: re.Match[str]) -> str:
        before_n = in_newtons(found["v"], found["vu"] or found["wu"])
        is_less = in_newtons(found["w"], found["wu"]) < before_n
        return f"use {found['w']} {found['wu']}" if is_less else found[0]

    return _RAISED_TO.sub(r"use \g<force>", _CHANGED_TO.sub(lowered, _SHARE_OF.sub(share, text)))


_BARE = NUMBER.removeprefix(ALONE)
_FORCE = rf"{NUMBER}\s*-?\s*(?:{UNIT})\b"
_PERCENT = r"\s*(?:%|percent\b|per cent\b|pct\b)"
_PARTS = {
    "half": 2, "halve": 2, "third": 3, "quarter": 4, "fourth": 4, "fifth": 5, "sixth": 6, "seventh": 7,
    "eighth": 8, "ninth": 9, "tenth": 10, "twentieth": 20,
}  # fmt: skip
_TIMES = {"twice": 2.0, "double": 2.0, "triple": 3.0, "thrice": 3.0, "quadruple": 4.0}
_PART = rf"(?:(?:an?|one|\d+)[ -])?(?:{'|'.join(_PARTS)})s?\b"
_SHARE = rf"(?:{NUMBER}{_PERCENT}|{_PART}|(?<![\d.,/])\d/\d+\b)"
_AMOUNT = rf"(?:{_FORCE}|{_SHARE})"
_ABOUT = (
    r"(?:(?:about|around|roughly|approximately|exactly|precisely|some|just|only|another|an? (?:further|extra|additional|good|full|mere)|"
    r"further|extra|additional|say|maybe|the|to|on|off|in) )*"
)
_FIGURE = r"(?:figure|value|number|amount|force|result|reading|total|rating|setting|level|grip|load|sum|quantity|lot|limit|maximum|max|squeeze|pressure|strength)"
_THAT = (
    rf"(?:(?:that|this|the|those|these|his|her|their|its)(?: (?:same|old|last|first|rated|written|printed|stated|quoted|recorded|given|original|listed|dummy|sheet))? {_FIGURE}|"
    r"that|this|those|which|the (?:above|former|same))\b(?! (?:berr|straw|fruit|is\b|are\b|was\b|were\b|has\b|looks?\b|went\b|gone\b|one\b|punnet|tray|box))"
)
_IT = rf"(?:{_THAT}|it\b|them\b|things\b)"
_RAISE = r"(?:increas(?:e|ed|es|ing)|rais(?:e|ed|ing)|boost(?:ed|ing)?|bump(?:ed|ing)?(?: it)?|upp(?:ed|ing)|up|uprat(?:e|ed)|hik(?:e|ed)|lift(?:ed)?|augment(?:ed)?|strengthen(?:ed)?|step(?:ped)? up|top(?:ped)? up|go(?:ing)? up|turn(?:ed)? (?:it )?up|crank(?:ed)? (?:it )?up|dial(?:led)? (?:it )?up|scal(?:e|ed) (?:it )?up|push(?:ed)? (?:it )?up|nudg(?:e|ed) (?:it )?up)"
_LOWER = r"(?:reduc(?:e|ed|es|ing)|lower(?:ed|ing)?|decreas(?:e|ed|ing)|cut(?:ting)?|drop(?:ped|ping)?|de-?rat(?:e|ed|ing)|down-?rat(?:e|ed)|discount(?:ed|ing)?|trim(?:med|ming)?|shav(?:e|ed|ing)|lessen(?:ed)?|diminish(?:ed)?|shr[iu]nk|slash(?:ed)?|curtail(?:ed)?|eas(?:e|ed|ing)|back(?:ed|ing)?|go(?:ing)? down|turn(?:ed)? (?:it )?down|dial(?:led)? (?:it )?(?:down|back)|scal(?:e|ed) (?:it )?(?:down|back)|bring (?:it )?down|knock(?:ed)? (?:it )?down|com(?:e|ing) down|throttl(?:e|ed))"
_MOVE = r"(?:dial|turn|bring|scale|take|crank|bump|push|step|nudge|move|knock|ramp|wind|notch)"
_OBJECT = rf"(?: {_IT})?(?: (?:up|down|back|off|further))*"
_TAKE = r"(?:knock|tak|shav|trim|cut|lop|chop|subtract|deduct|remov|drop|dock|strip|skim|slic|los|pull|clip|whip)(?:e|es|ed|n|ing|s|p(?:ed|ing)|t(?:ed|ing))?"
_PUT = r"(?:add|put|tack|stick|pil|throw|lump|chuck|slap|pop|bung|whack|stack|giv)(?:e|ed|ing)?(?: it)?"
_ONTO = rf"(?: (?:more|extra|on top|to|onto|on|of|besides|in addition|{_THAT}|it))*"

_GO = r"(?:go|come|get|stay|run|(?:set|make|turn|nudge|bring|dial|move|put) (?:it|that|this))"
_TWO = rf"(?P<a>{NUMBER})\s*(?P<u>(?:{UNIT})\b)?(?: ?(?:,|and|&|to|-|–) ?)+(?:the )?(?P<b>{_BARE})\s*(?P<v>(?:{UNIT})\b)"
_MIDDLE = (
    r"(?:(?:average|mean|mid-?point|middle|centre|center|median)(?: value| figure| force)?(?: of| between| from)|"
    r"(?:half-?way|half way|mid-?way|mid way|(?:in )?the (?:\w+ )?(?:middle|centre|center)|equidistant|split the difference|splitting the difference)(?: point)?(?: up)?(?: between| from| of))"
    r"(?: (?:the|those|these|range|band|window|two|of|between|from|values?|figures?|limits?|our|my))*"
)
_BETWEEN: tuple[tuple[re.Pattern[str], Callable[[float, float], float]], ...] = (
    (re.compile(rf"(?:\b(?:the|an?) )?\b{_MIDDLE} {_TWO}"), lambda a, b: (a + b) / 2),
    (re.compile(rf"{_TWO},? (?:averaged|on average)\b"), lambda a, b: (a + b) / 2),
    (re.compile(rf"(?:\bthe )?\b(?:sum|total) of {_TWO}"), lambda a, b: a + b),
    (re.compile(rf"(?:\bthe )?\bdifference (?:between|of) {_TWO}"), lambda a, b: abs(a - b)),
    (re.compile(rf"(?:\bthe )?\b(?:smaller|lower|lesser|smallest|lowest|minimum) (?:one )?of {_TWO}"), min),
    (re.compile(rf"(?:\bthe )?\b(?:larger|higher|greater|bigger|largest|highest) (?:one )?of {_TWO}"), max),
)  # fmt: skip
_OF_THE_WAY = re.compile(rf"(?P<share>{_SHARE}) of the way (?:up )?(?:from|between) {_TWO}")
_INNER: tuple[tuple[re.Pattern[str], int], ...] = (
    (re.compile(rf"\b{_RAISE} (?:the |that |our |a )?(?:\w+ )?(?P<one>{_FORCE})(?: \w+){{0,2}}? by {_ABOUT}(?P<by>{_AMOUNT})"), 1),
    (re.compile(rf"\b{_LOWER} (?:the |that |our |a )?(?:\w+ )?(?P<one>{_FORCE})(?: \w+){{0,2}}? by {_ABOUT}(?P<by>{_AMOUNT})"), -1),
    (re.compile(rf"\b{_PUT} {_ABOUT}(?P<by>{_AMOUNT})(?: extra| more)? (?:on top of|onto|to|on) (?:the |that |our |a )?(?:\w+ )?(?P<one>{_FORCE})"), 1),
    (re.compile(rf"\b{_TAKE} {_ABOUT}(?P<by>{_AMOUNT}) (?:off|from|out of|away from)(?: of)? (?:the |that |our |a )?(?:\w+ )?(?P<one>{_FORCE})"), -1),
    (re.compile(rf"\b{_MOVE} (?:the |that |our |a )?(?P<one>{_FORCE})(?: \w+)? (?:up|higher) by {_ABOUT}(?P<by>{_AMOUNT})"), 1),
    (re.compile(rf"\b{_MOVE} (?:the |that |our |a )?(?P<one>{_FORCE})(?: \w+)? (?:down|back|lower) by {_ABOUT}(?P<by>{_AMOUNT})"), -1),
)  # fmt: skip
"""'Derate 0.8 N by 25 %', 'add 0.1 N to 0.4 N': the force stands within the change."""
_CHANGES: tuple[tuple[re.Pattern[str], int], ...] = (
    (re.compile(rf"\b{_RAISE}{_OBJECT} by {_ABOUT}(?P<by>{_AMOUNT})"), 1),
    (re.compile(rf"\b{_LOWER}{_OBJECT} by {_ABOUT}(?P<by>{_AMOUNT})"), -1),
    (re.compile(rf"\badd(?:ed|ing)?(?: on)? {_ABOUT}(?P<by>{_AMOUNT}){_ONTO}"), 1),
    (re.compile(rf"\b{_PUT}(?: on)? {_ABOUT}(?P<by>{_AMOUNT})(?: (?:more|extra))? (?:on top|to|onto|on)(?: of)?(?: {_IT})?(?=\s*(?:$|[.,;:!?)]|and\b|please|today|now|this|for|because|since|as))"), 1),
    (re.compile(rf"(?:\b(?:and|with|then|plus)|,|\+) (?:another|an? (?:further|extra|additional)|further|extra|additional|{_ABOUT}(?={_AMOUNT} (?:on top|extra|in addition|besides|as well)\b)) ?{_ABOUT}(?P<by>{_AMOUNT}){_ONTO}"), 1),
    (re.compile(rf"(?:\bplus|\+) {_ABOUT}(?P<by>{_SHARE}) of {_THAT}"), 1),
    (re.compile(rf"\bminus {_ABOUT}(?P<by>{_SHARE}) of {_THAT}"), -1),
    (re.compile(rf"\b(?P<by>{_AMOUNT}) (?:on top|extra|more|higher|firmer|tighter|harder|stronger|above|over|up)(?: of| than| on| from)? {_THAT}"), 1),
    (re.compile(rf"\b{_TAKE}(?: off)? {_ABOUT}(?P<by>{_AMOUNT}) (?:off|from|out of|away)(?: of)?(?: {_IT})?"), -1),
    (re.compile(rf"\b{_TAKE} off {_ABOUT}(?P<by>{_AMOUNT})"), -1),
    (re.compile(rf"(?:\bplus|(?<=[,;:] )\+) {_ABOUT}(?P<by>{_AMOUNT})(?! (?:of )?(?:tolerance|margin|slack|at (?:the )?most|max))"), 1),
    (re.compile(rf"\b{_GO} {_ABOUT}(?P<by>{_AMOUNT}) (?:lower|down|less|softer|gentler|lighter|looser|weaker)\b(?! than\b)"), -1),
    (re.compile(rf"\b{_GO} {_ABOUT}(?P<by>{_AMOUNT}) (?:higher|up|more|firmer|tighter|harder|stronger)\b(?! than\b)"), 1),
    (re.compile(rf"\b(?:subtract|deduct|remov(?:e|ing)|los(?:e|ing)|subtracting|deducting|(?<!plus[ /-])(?<!or )(?<!and )(?<!/)minus|less) {_ABOUT}(?P<by>{_AMOUNT})"), -1),
    (re.compile(rf"\b(?P<by>{_AMOUNT}) (?:less|lower|softer|gentler|lighter|looser|weaker|below|under|off|down|short)(?: of| than| from)? {_THAT}"), -1),
    (re.compile(rf"\b(?P<by>{_SHARE})(?: knocked| taken| shaved)? off(?=\s*(?:$|[.,;:!?)]|please|today|now|for|because|since))"), -1),
)  # fmt: skip
"""Changes of a force that is named before."""
_MULTIPLES: tuple[re.Pattern[str], ...] = (
    re.compile(rf"\b{_ABOUT}(?P<share>{_SHARE}|{NUMBER}) (?:of {_THAT}|thereof\b|(?:as much|the amount|the force)(?! (?:again|more)\b)(?: as {_THAT})?(?=\s*(?:$|[.,;:!?)]|for|on|please|today|now|here|because|since)))"),
    re.compile(rf"\b(?:use|take|apply|try|want|with|only|just|at) {_ABOUT}(?P<share>{_SHARE}) of it\b(?! (?:is|are|was|were|has))"),
    re.compile(rf"\b(?P<share>{'|'.join(_TIMES)}|{NUMBER} (?:times|x|×))(?: of)? (?:{_THAT}|(?:as much|the amount|the force)(?: as {_THAT})?(?=\s*(?:$|[.,;:!?)]|for|on|please|today|now|here)))"),
    re.compile(r"\b(?P<share>half (?:as (?:much|hard|firm\w*|strong\w*) )?again(?: as (?:much|hard|firm\w*|strong\w*))?|as much again)\b"),
    re.compile(rf"\b(?P<share>half) (?:of )?{_THAT}"),
    re.compile(rf"\b(?P<share>halv|doubl|tripl|trebl|quadrupl)(?:e|ed|ing)(?: {_IT})?(?=\s*(?:$|[.,;:!?)]|for|and|please|today|now|because|since))"),
    re.compile(rf"\bmultipl(?:y|ied|ying){_OBJECT} (?:by|with) (?:a factor of )?(?P<share>{_SHARE}|{NUMBER})"),
    re.compile(rf"\bdivid(?:e|ing) {_IT} by (?:a factor of )?(?P<divisor>{NUMBER})"),
    re.compile(rf"\b(?:scal(?:e|ed|ing)|{_LOWER}){_OBJECT} (?:to|by a factor of|down to) {_ABOUT}(?P<share>{_SHARE}|0?[.,]\d+)(?! ?(?:{UNIT})\b)(?: of (?:{_THAT}|it))?"),
    re.compile(rf"\b(?:scal(?:e|ed|ing)){_OBJECT} by (?P<share>{_SHARE}|{NUMBER})"),
    re.compile(rf"\b(?:cut|chop|split|divide|slice){_OBJECT} in (?P<share>half)\b"),
)  # fmt: skip
_MOVED_TO = re.compile(
    rf"\b(?!up\b)(?:{_RAISE}|{_LOWER}|{_MOVE})(?: {_IT}| the (?:force|grip|squeeze|pressure))?(?: (?:up|down|back|off|further))* to {_ABOUT}(?P<to>{_FORCE})"
)
"""'1 N, lower it to 0.8 N'."""
_BOUND_NAME = r"(?:(?:(?P<low>lower )?(?:upper )?(?:limit|bound))|(?P<top>cap|ceiling|max(?:imum)?)|(?P<floor>floor|min(?:imum)?))"
_BOUND_CHANGED = re.compile(
    rf"\b{_BOUND_NAME}(?: (?!not\b)[a-z]+){{0,3}}? ?(?:was|is|used to be|had been|stood at|stands at|:|=|of) (?P<one>{_FORCE})[^\d]{{0,40}}?\b(?:(?P<up>{_RAISE})|{_LOWER}) (?:it|that|this|the (?:(?:lower |upper )?(?:limit|bound)|cap|ceiling|max(?:imum)?|floor|min(?:imum)?)) by {_ABOUT}(?P<by>{_AMOUNT})"
)
"""'The cap was 1.7 N, lower the cap by 0.3 N.'"""
_MARGIN = re.compile(
    rf"\b(?:an? |the )?(?:(?:safety|safe|good|comfortable|clear) )?(?:distance|margin|clearance|buffer|gap|reserve) of {_ABOUT}(?P<by>{_FORCE}) (?:from|to|below|under|beneath) (?:{_IT}|there)(?! (?:the|our|my|between|\d))"
)
"""'It bruised at 0.8 N, I want a safety distance of 0.2 N from that.'"""
_THAT_OR = re.compile(
    rf"\b(?:with|at|use|using|apply|to) {_THAT} or (?:(?:something|anything|even|slightly|a (?:bit|little|touch)) )?(?:(?P<more>more|greater|higher|above|larger|stronger|firmer|harder)|less|lower|below|smaller|softer|gentler|weaker)\b"
)
"""'I measured 1.8 N. Squeeze with that or something greater.'"""
_STEMS = {"halv": 0.5, "doubl": 2.0, "tripl": 3.0, "trebl": 3.0, "quadrupl": 4.0}

_DENIED = re.compile(
    r"\b(?:not|never|no need|without|avoid\w*|rather than|instead of|nobody|nothing|forget(?: about)?)\b[^.;:,]*$"
)
_CONDITION = re.compile(
    r"\b(?:if|unless|in case|should (?:it|the)|when(?:ever)?|once|until|or)\b[^.;!?]*$"
)
_BOUND_BEFORE = re.compile(
    r"(?:\b(?:at (?:the )?(?:very |absolute )?(?:most|least)|than|under|over|above|below|beneath|beyond|past|up to|exceed(?:ing)?|max(?:imum)?|min(?:imum)?|"
    r"limit|ceiling|cap|floor|(?:max(?:imum)?|min(?:imum)?|limit|ceiling|cap|floor|capped) (?:of|is|at|to)|reach(?:ing)?|reaches|hits?)|[<>≤≥])\s*$"
)
_RANGE_BEFORE = re.compile(rf"{_FORCE}\s*(?:\bto|\bup to|-|–)\s*$|\bbetween {_FORCE}\s*and\s*$")
_PAIRED = re.compile(r"\s*(?:-|–|to|and|or|up to|,)\s*")
_UNSURE = re.compile(
    rf"\b(?:{_RAISE}|{_LOWER}){_OBJECT} by {_ABOUT}(?:{_AMOUNT}|{NUMBER}(?=\s*(?:$|[.,;:!?)](?!\d)|and\b|please))|an? (?!\w+ (?:of the way|millimet))(?:bit|little|lot|notch|touch|tad|hair|smidge\w*|few|fraction|part|portion|good|small|certain|couple)\b|some\b)|\b{_ABOUT}(?:{_SHARE}|a (?:small |large |good |tiny )?(?:fraction|part|bit|portion|fractions|multiple)) (?:of|off|less than|more than|below|above) (?:{_THAT})|\b(?:fraction|portion|multiple|bit|little|some) (?:of|off|less than|more than) (?:the |that )?{_FORCE}|"
    rf"\b(?:de-?rat|multipl(?:y|ied)|divid(?:e|ed))(?:e|ed|ing)?\b(?= (?:by|it|that|this|with|accordingly)|[.,;!?]|$)|\b(?:knock|shave|lop|skim)\w*(?: \w+){{0,4}}? off(?: (?:that|it|this))?\b|\b(?:geometric|harmonic|weighted|quadratic) mean\b|\b(?:average|mean|mid-?point|halfway|midway) (?:of|between)\b|"
    rf"\b{_SHARE} off\b|\b(?:half again|as much again)\b"
)
"""Words of a change, where none could be worked out."""


def worked_out(text: str) -> str:
    """A plain text, its numbers in digits, with forces in place of what they are worked out from."""
    for pattern, reckon in _BETWEEN:
        text = pattern.sub(partial(_between, reckon=reckon), text)
    text = _OF_THE_WAY.sub(_part_of_the_way, text)
    for inner, sign in _INNER:
        text = inner.sub(partial(_changed_within, sign=sign), text)
    text = _BOUND_CHANGED.sub(_changed_bound, text)
    for pattern in (_MARGIN, _THAT_OR):
        for match in reversed(list(pattern.finditer(text))):
            if one := _antecedent(text, match.start()):
                text = f"{text[: match.start()]}{_bound_by(match, one)}{text[match.end() :]}"
    at = 0
    while found := _next(text, at):
        match, begin, one = found
        text = f"{text[:begin]}{one}{text[match.end() :]}"
        at = begin + len(one)
    return text


def unsure_change(text: str) -> str:
    """Words of a change of a force that was not worked out; '' for none.

    Args:
        text: What ``worked_out`` returned.
    """
    for match in _UNSURE.finditer(text):
        if not _DENIED.search(text[: match.start()]) and re.search(_FORCE, text):
            return match[0].strip()
    return ""


def change_of_range(text: str) -> str:
    """Words of a change of a range that stands before it; '' for none.

    Args:
        text: What ``worked_out`` returned.
    """
    for pattern in (*(pattern for pattern, _ in _CHANGES), *_MULTIPLES):
        for match in pattern.finditer(text):
            ones = list(re.finditer(_FORCE, text[: match.start()]))
            between = text[ones[-1].end() : match.start()] if ones else ""
            if not ones or _DENIED.search(between) or _CONDITION.search(between):
                continue
            if _is_range(text, ones):
                return match[0].strip()
    return ""


def _changed_within(match: re.Match[str], sign: int) -> str:
    return _changed(match["one"], match["by"], sign)


def _changed_bound(match: re.Match[str]) -> str:
    kind = "least" if match["low"] or match["floor"] else "most"
    return f"at {kind} {_changed(match['one'], match['by'], 1 if match['up'] else -1)}"


def _bound_by(match: re.Match[str], one: str) -> str:
    """A bound at a force that is named before, or below it."""
    if match.re is _MARGIN:
        return f"at most {_changed(one, match['by'], -1)}"
    return f"at {'least' if match['more'] else 'most'} {one}"


def _between(match: re.Match[str], reckon: Callable[[float, float], float]) -> str:
    unit = match["v"]
    first = number(match["a"]) * in_newtons("1", match["u"] or unit) / in_newtons("1", unit)
    return f"{reckon(first, number(match['b'])):.6g} {unit}"


def _part_of_the_way(match: re.Match[str]) -> str:
    share = _share(match["share"])
    return _between(match, lambda a, b: a + share * (b - a))


def _next(text: str, at: int) -> tuple[re.Match[str], int, str] | None:
    """The next change behind a place, where it begins, and the force that it comes to."""
    found: list[tuple[re.Match[str], int, str]] = []
    for pattern, sign in _CHANGES:
        for match in pattern.finditer(text, at):
            if one := _antecedent(text, match.start()):
                found.append((match, match.start(), _changed(one, match["by"], sign)))
                break
    for pattern in _MULTIPLES:
        for match in pattern.finditer(text, at):
            if one := _antecedent(text, match.start()):
                found.append((match, match.start(), _times(one, _factor(match))))
                break
    for match in _MOVED_TO.finditer(text, at):
        if _antecedent(text, match.start()):
            found.append((match, match.start(), match["to"]))
            break
    if not found:
        return None
    match, begin, one = min(found, key=lambda each: (each[1], -each[0].end()))
    is_end = _BOUND_BEFORE.search(text[:begin]) or _RANGE_BEFORE.search(text[:begin])
    mark = "" if is_end else f"{WORKED_OUT} "
    before = " " if begin and text[begin - 1].isalnum() else ""
    return match, begin, f"{before}{mark}{one}"


def _antecedent(text: str, place: int) -> str:
    """The force that a change at a place is of; '' where it is denied, supposed or not certain."""
    before = text[:place]
    ones = list(re.finditer(_FORCE, before))
    if not ones or _DENIED.search(before[ones[-1].end() :]):
        return ""
    if _CONDITION.search(before[ones[-1].end() :]):
        return ""
    return "" if _is_range(before, ones) else ones[-1][0]


def _is_range(text: str, ones: list[re.Match[str]]) -> bool:
    """Whether the last of the forces of a text is the end of a range, or one of two."""
    if len(ones) > 1 and _PAIRED.fullmatch(text[ones[-2].end() : ones[-1].start()]):
        return True
    return re.search(rf"{NUMBER}\s*(?:-|–|to|or)\s*$", text[: ones[-1].start()]) is not None


def _changed(one: str, by: str, sign: int) -> str:
    value, unit = _split(one)
    if re.fullmatch(_FORCE, by):
        other, its_unit = _split(by)
        other *= in_newtons("1", its_unit) / in_newtons("1", unit)
    else:
        other = _share(by) * value
    return f"{value + sign * other:.6g} {unit}"


def _times(one: str, factor: float) -> str:
    value, unit = _split(one)
    return f"{factor * value:.6g} {unit}"


def _factor(match: re.Match[str]) -> float:
    said = match.groupdict()
    if said.get("divisor"):
        divisor = number(said["divisor"])
        return 1 / divisor if divisor else 0.0
    return _share(said["share"] or "")


def _share(text: str) -> float:
    """'25 %', 'a quarter', '2 thirds', '3/4', 'twice', '3 times' as a number."""
    text = text.strip()
    if re.search(r"\bagain\b", text):
        return 1.5 if text.startswith("half") else 2.0
    if text in _STEMS or text in _TIMES:
        return {**_STEMS, **_TIMES}[text]
    if match := re.fullmatch(rf"({NUMBER}){_PERCENT}", text):
        return number(match[1]) / 100
    if match := re.fullmatch(r"(\d)/(\d+)", text):
        return int(match[1]) / int(match[2]) if int(match[2]) else 0.0
    if match := re.fullmatch(rf"(?:(an?|one|\d+)[ -])?({'|'.join(_PARTS)})s?", text):
        count = int(match[1]) if match[1] and match[1].isdigit() else 1
        return count / _PARTS[match[2]]
    return number(re.findall(NUMBER, text)[0])


def _split(one: str) -> tuple[float, str]:
    match = re.fullmatch(rf"({NUMBER})\s*-?\s*((?:{UNIT}))", one)
    if match is None:
        raise ValueError(f"no force: {one!r}")
    return number(match[1]), match[2]
