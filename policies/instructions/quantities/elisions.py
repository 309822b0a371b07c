"""Forces that a text leaves half said, written out, so that each number has its own unit.

'Above 0.6 N but under 1.5' gives the second number the unit of the first, 'half to one newton'
makes a number of the half, and 'twice 0.4 N' and '10 % below 1 N' are multiplied. A number that
stands where a force would, in a text without a unit of force near it, is reported.
"""

from __future__ import annotations

import re

from policies.instructions.english import words
from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.force_units import ALONE, NUMBER, UNIT, in_newtons, number

_BARE = NUMBER.removeprefix(ALONE)
_PERCENT = r"\s*(?:%|percent|per cent)"
_ONE = rf"(?P<a>{NUMBER})\s*(?P<u>(?:{UNIT})\b)"

_MORE = r"(?:more|harder|firmer|tighter|greater|higher|above|over)"
_LESS = r"(?:less|softer|gentler|lighter|smaller|lower|below|under)"
_TIMES = {"half": 0.5, "twice": 2.0, "double": 2.0, "triple": 3.0, "thrice": 3.0}
_PARTS = {"third": 3, "quarter": 4, "fourth": 4, "fifth": 5, "tenth": 10}
_MULTIPLE = NumberPattern(
    rf"(?:\b(?P<word>{'|'.join(_TIMES)})|(?P<times>{NUMBER})\s*(?:times|x|×|\*)|(?P<percent>{NUMBER}){_PERCENT}|"
    rf"\b(?:(?P<count>an?|\d) )?(?P<part>{'|'.join(_PARTS)})s?)(?: of| as [a-z]+ as| (?:(?P<more>{_MORE})|(?P<less>{_LESS})) than)?(?: the)?\s+{_ONE}"
)
_RELATIVE = NumberPattern(
    rf"(?P<percent>{NUMBER}){_PERCENT} (?:(?P<more>{_MORE})|{_LESS}|off)(?: than)?\s+{_ONE}"
)

_SUM = NumberPattern(
    rf"(?P<a>{NUMBER})\s*(?P<u>(?:{UNIT})\b)?\s*(?P<sign>\+|\bplus\b|\bminus\b|\bless\b|\band (?:another|an extra|an additional)\b)\s*(?P<b>{_BARE})(?:\s*(?P<v>(?:{UNIT})\b))?(?!\s*(?:/|%|per ?cent\b|\d))"
)
_SUM_OF_PERCENT = NumberPattern(
    rf"{_ONE}\s*(?P<sign>\+|-(?= ?\d)|\bplus\b|\bminus\b|\bless\b)\s*(?P<percent>{_BARE}){_PERCENT}"
)
_APART = NumberPattern(
    rf"(?P<b>{NUMBER})\s*(?P<v>(?:{UNIT})\b) (?:(?P<more>{_MORE})|{_LESS}) than (?P<a>{NUMBER})\s*(?P<u>(?:{UNIT})\b)"
)
_OF_THAT = re.compile(
    rf"\b(?P<word>{'|'.join(_TIMES)})(?: of)? (?:that|this|it)\b|(?<=than )(?P<more>{'|'.join(_TIMES)})(?=\s*(?:$|[.,;:!?)]))"
)

_BOUND = (
    r"(?:at (?:the )?(?:very |absolute )?(?:most|least)|(?:less|more|lower|higher|harder|softer|stronger|weaker|firmer|gentler|tighter|looser|lighter|heavier|greater|smaller) than|"
    r"(?:no|not|never|nor) (?:under|over|above|below)|under|over|above|below|beneath|up to|exceed(?:ing)?|"
    r"(?:max(?:imum|imally)?|min(?:imum|imally)?|limit|ceiling|cap|floor|(?:upper|lower|top|bottom) (?:bound|limit|end)|(?:hard )?stop)\b\.?(?: of| is| at| to)?|"
    r"(?:bruis|crush|slip|slid|break|burst|squash)\w* (?:at|from))"
)
_SCALE = r"(?:(?:grip(?:ping)? |force |holding |squeez(?:e|ing) |clamping )?(?:strength|power|level|intensity|setting|stage|grade|gear|notch|firmness|hardness|tightness|pressure|effort|grip force))"
"""What a number without a unit may stand on, as on a dial: it says no force."""
_VALUE = rf"(?:with|use|using|apply|but|make it|aim(?:ing)? (?:for|at)|(?:target|goal|force|(?:the |a )?{_SCALE})(?: (?:level|setting|value))?(?: of| to| is| at)?|grip (?:of|at)|at a force of)"
_ROUGHLY = r"(?: a force of| about| around| roughly)?"
BEFORE_BOUND = rf"(?:\b{_BOUND}{_ROUGHLY}|[<>≤≥])\s*[:=]?\s*"
"""What stands before a number that bounds a force."""
BEFORE_VALUE = rf"\b{_VALUE}{_ROUGHLY}\s*[:=]?\s*"
"""What stands before a number that is a force."""
_BEFORE = rf"(?:{BEFORE_BOUND}|{BEFORE_VALUE})"
_AFTER = r"(?=\s*(?:$|[.,;:!?)](?![\d.])|[–—-] (?!\d)|(?:and|but|or|yet|please|then|(?:will|would)(?= (?:bruis|crush|hurt|damag|slip|break|squash))|is|bruis\w*|crush\w*|at (?:the )?(?:most|least)|max(?:imum)?|min(?:imum)?|for (?:me|us|now|this|that|today|the (?:berry|strawberry|fruit))|while|whilst|because|since|until|till|today|tonight|this time|thanks?|thank you|cheers|mate|love|dear|pal|when i|as i|if you)\b))"
_HALVES = (
    NumberPattern(rf"(?<!in )(?:\ban? |\b1 )?\bhalf(?= ?(?:-|–|to|and|or|up to) {_ONE})"),
    re.compile(rf"(?<=(?:than|nder|over|elow|bove|most|east) )(?:an? )?half{_AFTER}"),
)
_HELD_AT = r"\b(?:(?:hold|grip|squeeze|press|grasp|clamp|pinch)(?: it| this| that| the \w+)? (?:at|to)|(?:set|put|keep|have|leave|run|try|make|dial|fix|peg|stick|whack|bring|turn|adjust|tune|ramp|crank|bump|give)(?: it| this| that| the \w+)?(?: up| down| in)? (?:at|to)|(?:go|going) (?:with|for|at|to)) "
_HELD = r"\b(?:hold|grip|squeeze|press|grasp|clamp|pinch|gentl[ey]|soft(?:ly)?|light(?:ly)?|firm(?:ly)?|hard)(?: (?:it|this|that))? "
"""What asks to hold, directly before a number: 'grip it 0.8'."""
_QUANTITY = NumberPattern(
    rf"{NUMBER}\s*-?\s*(?:(?P<force>(?:{UNIT})\b)|mm\b|cm\b|millimet\w+|[µμu]m\b|micro\w+|%|percent\b|per cent\b)"
)
_LINK = r"\s*(?:-|–|\bto\b|\bup to\b|\bthrough\b)\s*"
_BOUND_BEHIND = (
    r"(?:(?:at|on) (?:(?:an?|the) )?(?:very |absolute )?(?:most|least|max(?:imum)?|min(?:imum)?|outside|utmost|(?:high|low|higher|lower|upper) end)|"
    r"tops?|max(?:imum)?|min(?:imum)?|or (?:less|more)|"
    r"(?:as (?:an?|the|its|my|our|your) )?(?:(?:upper|lower|hard|absolute|strict|safe|safety|force|grip) )*(?:bound|limit|end|cap|ceiling|lid|floor|stop))\b"
)
"""What bounds a force and stands behind its number."""
_BARES = (
    NumberPattern(rf"\bbetween (?P<a>{NUMBER})(?: and |{_LINK})(?P<b>{_BARE}){_AFTER}"),
    NumberPattern(rf"(?:{_BEFORE}|{_HELD}|\bfrom |^)(?P<a>{NUMBER}){_LINK}(?P<b>{_BARE}){_AFTER}"),
    NumberPattern(rf"{_BEFORE}(?P<a>{NUMBER}){_AFTER}"),
    NumberPattern(
        rf"{BEFORE_BOUND}(?P<a>{NUMBER})(?= (?:with|(?:ruin|harm|hurt|damag|kill|destroy|spoil|break|burst|split|crack)\w*)\b)"
    ),
    NumberPattern(rf"{_HELD_AT}(?P<a>{NUMBER}){_AFTER}"),
    NumberPattern(rf"{_HELD}(?P<a>{NUMBER}){_AFTER}"),
    NumberPattern(
        rf"(?P<a>{NUMBER})(?= (?:{_BOUND_BEHIND}|(?:is |would be )?(?:too|not enough)\b|(?:will|would) (?:bruis|crush|hurt|damag|squash|slip|break)\w*\b))"
    ),
    NumberPattern(
        rf"^(?P<a>{NUMBER})(?=\s*(?:$|,|\(?at (?:the )?(?:most|least)\b|\(?max\b|\(?min\b))"
    ),
)
_HALF_RANGES = (
    NumberPattern(rf"\bbetween {NUMBER}\s*(?P<u>(?:{UNIT})\b) and (?P<b>{NUMBER}){_AFTER}"),
    NumberPattern(rf"{NUMBER}\s*(?P<u>(?:{UNIT})\b){_LINK}(?P<b>{_BARE}){_AFTER}"),
)

_ALTERNATIVES = (
    NumberPattern(
        rf"(?P<b>{NUMBER})(?=(?:, {_BARE})*(?:,? (?:or|nor)|,(?= (?:maybe|perhaps|possibly)))(?: even| rather| maybe| perhaps| about| else)* {NUMBER}\s*(?P<u>(?:{UNIT})\b))"
    ),
    NumberPattern(
        rf"{NUMBER}\s*(?P<u>(?:{UNIT})\b),? or(?: even| rather| maybe| perhaps| about| else)* (?P<b>{NUMBER}){_AFTER}"
    ),
)
"""'0.5 or 1 N', '1 N or 0.8'."""
_CORRECTED = NumberPattern(
    rf"\b(?:no(?!\.)|wait|make (?:that|it)|{words.any_of('correction')}|better(?: still| yet)?|sorry|actually|otherwise|else)[ ,:.…!-]*(?:(?:i (?:mean|meant|said)|use|make (?:it|that)|only|just|no|wait|rather) )*(?P<a>{NUMBER}){_AFTER}"
)
"""'0.5 N, no wait, 0.8'."""
_ONE_ALONE = NumberPattern(
    rf"(?P<before>{NUMBER}\s*(?P<u>(?:{UNIT})\b)(?:{_LINK}|,? (?:and|but|or) |, )(?:{_BOUND} )?)one(?=\s*(?:$|[.,;:!?)]))"
)
"""'Between half a newton and one'."""
_ON_A_SCALE = NumberPattern(
    rf"(?:{_BEFORE}|{_HELD_AT}|\b(?:hold|grip|squeeze)(?: it)? )(?P<a>{NUMBER})\s*(?:/|out of|of|on a scale of)\s*(?:\d+ to )?{_BARE}(?=\s*(?:$|[.,;:!?)]))"
)
"""'At 7 out of 10'."""
_BESIDE_SCALE = NumberPattern(
    rf"\b{_SCALE} (?P<a>{NUMBER})(?= (?:grip|grasp|hold|squeeze|pinch|force|pressure|strength)\b)"
)
"""'Use level 3 grip'."""
_THAN_THAT = NumberPattern(
    rf"(?P<by>{NUMBER})\s*(?:(?P<unit>(?:{UNIT})\b)|(?P<percent>%|percent|per cent))? (?:(?P<more>{_MORE})|{_LESS}) than (?:that|this|it)\b"
)
"""'It was 1 N; use 0.2 less than that'."""

_LEFT_OVER = (
    NumberPattern(
        rf"(?<!\bnot ){ALONE}(?P<a>\d*\.\d+)(?:{_AFTER}|(?= (?:at|on|as|in|upper|lower|hard)\b))"
    ),
    NumberPattern(
        rf"[,;:] (?:(?:the|its|my|your|our) )?(?!{words.any_of('numbered')})\w+:? (?P<a>\d+)(?=\s*(?:$|[.,;:!?)](?![\d.])))"
    ),
)
"""'Hold it at 1 N, redline 1.1': a fraction anywhere, a whole number after one unknown word."""
_UNSAID = (
    NumberPattern(
        rf"(?:\b(?<!not )(?:with|to|by|about|around|roughly|use|apply|grip|force|it|is|value|target)|[:=]|^) ?{ALONE}(?P<a>\d*\.\d+)(?:{_AFTER}|(?= (?:ok(?:ay)?|alright|thanks?|mate|boss|now|then|on|for|and|but|or)\b))"
    ),
    NumberPattern(
        rf"\b(?:(?:hold|grip|grasp|squeeze|press|clamp|pinch)(?: (?:it|this|that|the \w+))? with|give (?:it|me) an?|go for|aim for|(?:raise|increase|lower|reduce) it by) "
        rf"(?:(?:an?|the|about|around|roughly) )*(?P<a>\d+)(?:{_AFTER}|(?= (?:ok(?:ay)?|please|on the (?:grip|force|gripper))\b))"
    ),
    NumberPattern(
        rf"\b(?:force|grip|strength|pressure|squeeze)\b(?:[,:=]? (?:of|be|is|at|to|minus|about|an?))*[,:=]? (?P<a>\d+(?:\.\d+)?){_AFTER}"
    ),
    NumberPattern(
        r"(?<![\w.])(?P<a>\d+(?:\.\d+)?) (?:of (?:force|grip)|strong|as (?:the )?force)\b"
    ),
    NumberPattern(
        r"\bbetween (?P<a>\d+(?:\.\d+)?) and \d+(?:\.\d+)? (?:for|on|of|in) (?:the )?(?:grip|force|squeeze)\b"
    ),
    NumberPattern(
        rf"\b(?:give|grip|hold|take|grasp|apply|grab)(?: (?:on to|on|onto|it|(?:this|that|the) \w+|this|that))* (?:(?:with|on|at),? )?(?:an? )?(?:(?:solid|strong|good|full|oh|say),? )*(?P<a>\d+(?:\.\d+)?){_AFTER}"
    ),
)
"""'Hold it with 0.9 ok', 'give it a 10': where no force is named, a number that can be none else."""
_NUMBERED = re.compile(rf"not|through|{words.any_of('numbered')}")
_BARE_NUMBER = NumberPattern(
    rf"(?:(?P<before>\w+)\s+)?(?<![\w.])(?P<a>\d+(?:\.\d+)?)(?:{_AFTER}|(?= (?:at|on|as|in|if|when|with|peak|absolute|upper|lower|hard|for (?:the|a))\b))"
)
"""'At least 0.5 N, 1 in the worst case': beside a least, which bounds nothing from above."""
_NO_FORCE = re.compile(
    r"\b(?:(?:slip|slid)\w*[^,;.!?]*|(?:calibration|measuring|data) )\.?\d[\d.]*"
)


def left_over(text: str) -> str:
    """A number that stays when all quantities of a text are read, as a force might; '' for none."""
    text = _NO_FORCE.sub(" ", text)
    for pattern in _LEFT_OVER:
        if match := pattern.search(text):
            return match["a"]
    return ""


def unsaid_force(text: str) -> str:
    """A number that stands for a force in a text that names none; '' for none."""
    return next((match["a"] for pattern in _UNSAID if (match := pattern.search(text))), "")


def bare_number(text: str) -> str:
    """A number that a text leaves without a unit, where it might be the most; '' for none."""
    for match in _BARE_NUMBER.finditer(_NO_FORCE.sub(" ", text)):
        if not _NUMBERED.fullmatch(match["before"] or ""):
            return match["a"]
    return ""


def written_out(text: str) -> tuple[str, str]:
    """Give each number that names a force its unit.

    Args:
        text: Plain text, its numbers in digits.

    Returns:
        The text, and the first number that stands where a force would without one; '' for none.
    """
    while (summed := _SUM.sub(_added, text)) != text:
        text = summed
    for pattern, reckoned in (
        (_SUM_OF_PERCENT, _related),
        (_APART, _added),
        (_RELATIVE, _related),
        (_MULTIPLE, _multiplied),
    ):
        text = pattern.sub(reckoned, text)
    text = _with_differences_to_that(_with_multiples_of_that(text))
    if re.search(rf"{NUMBER}\s*-?\s*(?:{UNIT})\b", text):
        for half in _HALVES:
            text = half.sub("0.5", text)
    for pattern in (*_HALF_RANGES, *_ALTERNATIVES):
        while match := pattern.search(text):
            text = f"{text[: match.end('b')]} {match['u']}{text[match.end('b') :]}"
    text = _ONE_ALONE.sub(r"\g<before>1 \g<u>", text)
    on_a_scale = _ON_A_SCALE.search(text) or _BESIDE_SCALE.search(text)
    unitless = on_a_scale["a"] if on_a_scale else ""
    for pattern in (*_BARES, *((_CORRECTED,) if re.search(_ONE, text) else ())):
        at = 0
        while match := pattern.search(text, at):
            at = match.end()
            unit = _unit_near(text, match.start("a"))
            if not unit:
                unitless = unitless or match["a"]
                continue
            for name in sorted(match.groupdict(), reverse=True):  # the last first: places stay
                text = f"{text[: match.end(name)]} {unit}{text[match.end(name) :]}"
    return text, unitless


def _added(match: re.Match[str]) -> str:
    unit = match["u"] or match["v"]
    if unit is None:
        return match[0]
    said = match.groupdict()
    is_less = said.get("sign") in ("minus", "less") or ("sign" not in said and not said["more"])
    other = number(match["b"]) * in_newtons("1", match["v"] or unit) / in_newtons("1", unit)
    return f"{number(match['a']) + (-other if is_less else other):.6g} {unit}"


def _with_multiples_of_that(text: str) -> str:
    """'At least 0.5 N, at most twice that' -> 'at least 0.5 N, at most 1 N'."""
    at = 0
    while match := _OF_THAT.search(text, at):
        at = match.end()
        before = list(re.finditer(_ONE, text[: match.start()]))
        if before:
            times = _TIMES[match["word"] or match["more"]]
            one = f"{times * number(before[-1]['a']):.6g} {before[-1]['u']}"
            at = match.start() + len(one)
            text = text[: match.start()] + one + text[match.end() :]
    return text


def _with_differences_to_that(text: str) -> str:
    """'It was 1 N; use 0.2 less than that' -> 'it was 1 N; use no wait, 0.8 N'."""
    at = 0
    while match := _THAN_THAT.search(text, at):
        at = match.end()
        before = list(re.finditer(_ONE, text[: match.start()]))
        if not before:
            continue
        that, unit = number(before[-1]["a"]), before[-1]["u"]
        by = number(match["by"]) * (
            that / 100
            if match["percent"]
            else in_newtons("1", match["unit"] or unit) / in_newtons("1", unit)
        )
        one = f"{that + (by if match['more'] else -by):.6g} {unit}"
        if not re.search(rf"{BEFORE_BOUND}$", text[: match.start()]):
            one = f"no wait, {one}"  # it stands for the other
        at = match.start() + len(one)
        text = text[: match.start()] + one + text[match.end() :]
    return text


def _multiplied(match: re.Match[str]) -> str:
    if match["word"]:
        factor = _TIMES[match["word"]]
    elif match["part"]:
        count = match["count"] or "1"
        factor = (int(count) if count.isdigit() else 1) / _PARTS[match["part"]]
    else:
        factor = number(match["times"]) if match["times"] else number(match["percent"]) / 100
    if factor < 1 and (match["more"] or match["less"]):
        factor = 1 + factor if match["more"] else 1 - factor  # 'a third less than 1 N'
    elif match["less"]:
        factor = 1 / factor
    return f"{factor * number(match['a']):.6g} {match['u']}"


def _related(match: re.Match[str]) -> str:
    said = match.groupdict()
    is_more = said["sign"] in ("+", "plus") if "sign" in said else bool(said["more"])
    percent = number(match["percent"]) * (1 if is_more else -1)
    return f"{(1 + percent / 100) * number(match['a']):.6g} {match['u']}"


def _unit_near(text: str, place: int) -> str:
    """Unit of the quantity nearest to a place; '' where that is no force, or there is none."""
    found = min(
        _QUANTITY.finditer(text), key=lambda quantity: abs(quantity.start() - place), default=None
    )
    return (found["force"] or "") if found else ""
