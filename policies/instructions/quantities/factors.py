"""Changes of the task's force: a factor on it ('half as hard') or a difference ('half a newton more')."""

from __future__ import annotations

import re

from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.force import MARK
from policies.instructions.quantities.force_units import NUMBER, UNIT, in_newtons, number
from policies.instructions.quantities.relations import NOT

_THAN = re.compile(r"\b(?:more|harder|firmer|tighter|higher|over|above|exceed\w*)(?: than)?\s*$")
"""Before a factor that bounds: 'no more than twice the usual force'."""
_AT_MOST = re.compile(
    r"\b(?:(?:no|not|n't|never) (?:\w+ ){0,3}?(?:more|harder|firmer|tighter|higher) than|at (?:the )?most|"
    r"up to|maximum(?: of)?|less than|below|under|not over|not above|without exceeding) (?:about )?$"
)
_USUAL = r"(?:(?:the |your |its |that |our )(?!(?:\w+ )?(?:weight|mass)\b)|what (?:you|is) |as )"
_HOW = r"(?:hard|firm(?:ly)?|tight(?:ly)?|strong(?:ly)?|much|gentl[ey]|soft(?:ly)?|light(?:ly)?|forceful(?:ly)?)"
_UP = r"(?:more|harder|firmer|tighter|stronger|higher|above|extra|over|up|heavier)"
_DOWN = r"(?:less|softer|gentler|lighter|weaker|lower|below|under|looser|down|fewer)"
_GO_UP = r"(?:increase|raise|up|boost|turn up|crank up|bump|dial up|strengthen|tighten|add)"
_GO_DOWN = r"(?:reduce|lower|decrease|cut|drop|turn down|dial down|ease|back off|loosen|scale back|bring down|lessen|down)"
_FRACTION = r"(?:(?P<n>an?|one|two|three|\d) (?P<d>half|third|quarter|fifth|tenth)s?|(?P<h>half))"
_MULTIPLE = rf"(?:(?P<x>{NUMBER})\s*(?:times|x|×)|\b(?P<w>twice|double|thrice|triple)) "
_GRIP = r"(?:force|grip|strength|pressure|power|squeeze)\b"
_DENOMINATORS = {"half": 2, "third": 3, "quarter": 4, "fifth": 5, "tenth": 10}


_ADDED = rf"(?P<a>{NUMBER})\s*(?P<u>(?:{UNIT})\b)"
_DELTAS = tuple(
    (NumberPattern(pattern), sign)
    for pattern, sign in (
        (
            rf"{_ADDED} (?:more|harder|firmer|tighter|extra|higher|above|over)(?= (?:than |the |your )*(?:usual|normal|standard|default|last|before|that)|[.,!]*$| please)",
            1,
        ),
        (
            rf"{_ADDED} (?:less|softer|gentler|lighter|lower|looser|below|under)(?= (?:than |the |your )*(?:usual|normal|standard|default|last|before|that)|[.,!]*$| please)",
            -1,
        ),
        (
            rf"\b(?:add|plus|another|an extra|increase(?: \w+){{0,3}} by|raise(?: \w+){{0,3}} by|up(?: \w+){{0,3}} by) {_ADDED}",
            1,
        ),
        (
            rf"\b(?:subtract|deduct|remove|take off|(?:reduce|lower|decrease|drop|cut|down|ease|back off)(?: \w+){{0,3}} by) {_ADDED}",
            -1,
        ),
    )
)


def read_delta(text: str) -> tuple[float | None, str]:
    """Force to add to the task's [N], and the text without it."""
    for pattern, sign in _DELTAS:
        if match := pattern.search(text):
            rest = f"{text[: match.start()]} {MARK} {text[match.end() :]}"
            return sign * in_newtons(match["a"], match["u"]), " ".join(rest.split())
    return None, text


def read_factor(text: str) -> tuple[float | None, str, str]:
    """Factor on the task's force that a text names, its words, and the text without them."""
    percent = rf"(?P<p>{NUMBER})\s*(?:%|percent|per cent)"
    for pattern, value in (
        (rf"\b(?:{_GO_UP}|{_UP})\b[^.;#]{{0,40}}?by (?:about |around )?(?:a )?half\b", lambda m: 1.5),
        (rf"half (?:again as {_HOW}|as {_HOW} again)", lambda m: 1.5),
        (rf"(?P<x>{NUMBER})\s*(?:times|x|×) (?:as {_HOW}|{_USUAL})(?: as)?", lambda m: number(m["x"])),
        (rf"{_MULTIPLE}{_UP}\b", _multiple),
        (rf"{_MULTIPLE}{_DOWN}\b", lambda m: 1 / _multiple(m) if _multiple(m) else 0.0),
        (rf"(?:twice|double|2 times|two times) (?:as {_HOW}|{_USUAL})|\bdouble (?:up )?(?:the|your)|\bdouble {_GRIP}", lambda m: 2.0),
        (rf"(?:three times|triple|thrice) (?:as {_HOW}|{_USUAL})|\btriple (?:the|your)", lambda m: 3.0),
        (rf"(?:half|0\.5) as {_HOW}|\bhalf {_USUAL}|\bhalf (?:of )?{_USUAL}|\b(?:in|by) half\b|\bhalve\b|\bhalf (?:the )?{_GRIP}|\b{_GRIP}(?: (?:at|of|to|is))?:? half\b", lambda m: 0.5),
        (rf"(?:another|an extra|extra|additional|add|plus) {NUMBER}\s*(?:%|percent|per cent)|{NUMBER}\s*(?:%|percent|per cent) (?:on top|extra)", lambda m: 1 + _percent(m) / 100),
        (r"\b(?:to (?:about |around |roughly )?|but (?:only |just )?)half\b", lambda m: 0.5),
        (rf"{percent} {_UP}", lambda m: 1 + number(m["p"]) / 100),
        (rf"{percent} {_DOWN}", lambda m: 1 - number(m["p"]) / 100),
        (rf"\b(?:{_GO_UP}|{_UP})\b[^.;#]{{0,40}}?by (?:about |around )?{percent}", lambda m: 1 + number(m["p"]) / 100),
        (rf"\b(?:{_GO_DOWN}|{_DOWN})\b[^.;#]{{0,40}}?by (?:about |around )?{percent}", lambda m: 1 - number(m["p"]) / 100),
        (rf"{percent} (?:of )?(?:{_USUAL}(?!(?:\w+ ){{0,2}}?(?:pads?|areas?|gels?|sensors?|surface|skin|fruits?|berries|batch|tray|crates?|time|way|people|customers?|day|lot|harvest|crop)\b)|usual|normal|standard|default)", lambda m: number(m["p"]) / 100),
        (rf"{_FRACTION} {_UP}", lambda m: 1 + _part(m)),
        (rf"{_FRACTION} {_DOWN}", lambda m: 1 - _part(m)),
        (rf"\b(?:{_GO_UP}|{_UP})\b[^.;#]{{0,40}}?by (?:about |around )?{_FRACTION}", lambda m: 1 + _part(m)),
        (rf"\b(?:{_GO_DOWN}|{_DOWN})\b[^.;#]{{0,40}}?by (?:about |around )?{_FRACTION}", lambda m: 1 - _part(m)),
        (rf"{_FRACTION} (?:of )?(?:{_USUAL}|usual|normal|standard|default)", lambda m: _part(m)),
        (rf"\b(?P<d>third|quarter|fifth|tenth) (?:of )?(?:(?:the|your|its) )?(?:(?:usual|normal|full) )?{_GRIP}", lambda m: 1 / _DENOMINATORS[m["d"]]),
    ):  # fmt: skip
        if match := re.search(pattern, text):
            factor = value(match)
            if factor > 1 and re.search(r"\bas (?:gent|soft|light)", match[0]):
                factor = 1 / factor  # 'twice as gently'
            if factor > 1 and _AT_MOST.search(text[: match.start()]):
                factor = 1.0  # 'no more than twice the usual force' asks for no more than usual
            return factor, match[0], text[: match.start()] + f" {MARK} " + text[match.end() :]
    return None, "", text


def denied_factor(text: str, factor: float, words: str) -> str:
    """The words of a factor above 1 that is not to be used ('never twice as hard'); '' for none."""
    before = re.split(r"[.;:,]\s|\b(?:but|and)\b", text[: text.find(words)])[-1]
    before = re.sub(r"\b(?:not|never) (?:hesitate|forget|fail|be afraid)\b", "", before)
    is_denied = len(NOT.findall(before)) % 2 == 1 and not _THAN.search(before)
    return words.strip() if factor > 1 and is_denied else ""


def _percent(match: re.Match[str]) -> float:
    return number(re.findall(NUMBER, match[0])[0])


def _multiple(match: re.Match[str]) -> float:
    if match["x"]:
        return number(match["x"])
    return 2.0 if match["w"] in ("twice", "double") else 3.0


def _part(match: re.Match[str]) -> float:
    if match["h"]:
        return 0.5
    count = {"two": 2, "three": 3}.get(match["n"]) or (
        int(match["n"]) if match["n"].isdigit() else 1
    )
    return count / _DENOMINATORS[match["d"]]
