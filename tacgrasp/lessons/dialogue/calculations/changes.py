"""A quantity after a change that a clause tells: 'the force rose by 20 %'.

    you pushed 0.2 N harder                     force_n + 0.2
    the limit were halved                       0.5 * limit_n
    it slid 2 mm to the left                    x_mm - 2

Not here: what is asked then (``tacgrasp.lessons.dialogue.calculations.suppositions``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike

_WAS = r"(?:(?:was|were|is|got|gets|had been|has been|be) )?"
_WHO = r"(?:you|we|i|somebody|someone|they)"
_UP = (
    rf"{_WAS}(?:grew|grows?|rose|rises?|increased?|increases|went up|goes up|climbed|gained|raised)"
)
_DOWN = (
    rf"{_WAS}(?:dropped|drops?|fell|falls?|decreased?|decreases|went down|goes down|shrank|"
    rf"shrinks?|lost|"
    r"declined|lowered|reduced|cut)"
)
_RAISED = r"(?:rais(?:e|ed)|increased?|lift(?:ed)?)"
_LOWERED = r"(?:lower(?:ed)?|reduced?|decreased?|cut)"
_LARGE = r"(?:large|big|high|deep|much|great|strong|heavy|hard)"
_TIMES: Mapping[str, str] = {
    "0.5": r"halved?|cut in half|cut by half|divided by two|half as",
    "2": r"doubled?|doubles|multiplied by two|grew to (?:double|twice)(?: the size)?|twice as",
    "3": r"tripled?|triples|multiplied by three|(?:three times|thrice) as",
}
_CHANGES = tuple(
    (sign, re.compile(pattern))
    for sign, pattern in (
        ("+", rf"(?P<a>.+?) {_UP} by (?:another )?(?P<b>.+)"),
        ("-", rf"(?P<a>.+?) {_DOWN} by (?P<b>.+)"),
        ("=", rf"(?P<a>.+?) (?:{_UP}|{_DOWN}|{_WAS}(?:set|changed)) to (?P<b>.+)"),
        ("=", r"(?P<a>.+?) (?:was|were|is)(?: only| just)? (?P<b>#\d+ \w+|twice .+|half .+)"),
        ("+", rf"{_WHO} {_RAISED} (?P<a>.+?) by (?P<b>.+)"),
        ("-", rf"{_WHO} {_LOWERED} (?P<a>.+?) by (?P<b>.+)"),
        ("=", rf"{_WHO} (?:set|{_RAISED}|{_LOWERED}) (?P<a>.+?) to (?P<b>.+)"),
        (
            "+",
            r"(?P<a>.+?) (?:was|were|is) (?P<b>#.+?) (?:more|higher|greater|larger|deeper|heavier)",
        ),
        ("-", r"(?P<a>.+?) (?:was|were|is) (?P<b>#.+?) (?:less|lower|smaller|shallower|lighter)"),
        ("+", rf"{_WHO} (?:add(?:ed)?|put|gave) (?P<b>.+?) (?:to|onto|on) (?P<a>.+)"),
        ("+", r"(?:adding|putting) (?:another )?(?P<b>#.+?)(?: more)? to (?P<a>.+)"),
        ("-", rf"{_WHO} (?:took|take|removed?) (?P<b>.+?) (?:off|from) (?P<a>.+)"),
    )
)
_TO_TIMES = re.compile(
    rf"(?P<a>.+?) (?:{_UP}|{_DOWN}) to (?P<n>#\d+) times "
    rf"(?:the )?(?:\w+ )?(?:size|value|amount|depth|self)"
)
_PRESSED = re.compile(
    rf"(?:{_WHO}|it|the (?:fingers|gripper|robot|hand)) "
    rf"(?:push|press|squeez|gripp?|pinch|clamp|put on|add)(?:ed|e|es|s)?"
    r"(?: with)? (?P<b>#.+?) (?:(?P<more>harder|more|firmer|stronger|deeper|extra)|"
    r"(?P<less>softer|less|lighter|gentler|shallower))"
)
_EASED = re.compile(
    rf"(?:{_WHO} )?(?:(?:backing|easing) off|releasing|letting go of|let go of|released?|gave up|"
    rf"back(?:ed)? off|ease(?:d)?(?: off)?|took off|took away|drop(?:ped)?)"
    r"(?: by)? (?P<b>.+)"
)
_ON_TOP = re.compile(
    r"(?:another )?(?P<b>#\d+ \w+)(?: more)? (?:came|comes|were put|was put|were added|"
    r"was added)(?: on top)?"
)
_GONE = re.compile(
    r"(?P<share>.+) of (?P<a>.+?) (?:vanished|vanishes|was lost|were lost|disappeared|went away|"
    r"were gone|was gone|is lost|fell away)"
)
_CHANGE_OF = re.compile(
    r"(?:an? )?(?P<b>#\d+ \w+) (?:(?P<up>increase|rise|gain|growth)|decrease|drop|fall|reduction|"
    r"cut) (?:of|in) (?P<a>.+)"
)
_MOVED = re.compile(
    r"(?:it|the (?:object|contact|thing))(?: (?:was|were|is|had|has|been))* "
    r"(?:shifted|moved|slid|pushed|moves|slides|shifts)(?: by)? (?P<b>#\d+ \w+) "
    r"(?:to the )?(?P<side>left|right|up|down)(?:wards?)?"
)
_LOADED = re.compile(
    rf"{_WHO} (?:add(?:ed)?|put|stuck|stick|glued?|attach(?:ed)?|placed?|hung) "
    rf"(?:an? )?(?P<b>#\d+ \w+)"
    r"(?: \w+)? (?:to|onto|on) (?:the )?\w+"
)
_SHARED = re.compile(
    r"(?P<n>#\d+) (?:jaws|fingers|pads|grippers|people|robots|of them|parts)(?: \w+)? "
    r"(?:share|carry|split|divide)d? (?P<a>.+?)(?: (?:equally|evenly|between them|alike))*"
)


def changed(asked: AskedWords, change: str) -> Term | None:
    """A quantity after a change that a clause tells; None where it tells none.

    Args:
        asked: The question, whose numbers and pronouns the clause has.
        change: The clause in plain words.
    """
    for reader in (_gripped, _moved, _multiplied, _altered):
        if term := reader(asked, change):
            return term
    return None


def _gripped(asked: AskedWords, change: str) -> Term | None:
    """Force or depth after a firmer or softer grip, and a mass with something put on."""
    for pattern in (_PRESSED, _EASED, _ON_TOP):
        if (found := pattern.fullmatch(change)) is None:
            continue
        by = asked.term(found["b"])
        if by is None or by.dimension not in ("force", "length", "mass"):
            return None
        is_less = pattern is _EASED or (pattern is _PRESSED and found["less"] is not None)
        felt = usual("force" if pattern is _PRESSED and by.dimension == "mass" else by.dimension)
        return _by(felt, "-" if is_less else "+", by)
    found = _LOADED.fullmatch(change)
    load = asked.term(found["b"]) if found else None
    return _by(usual("mass"), "+", load) if load and load.dimension == "mass" else None


def _moved(asked: AskedWords, change: str) -> Term | None:
    """The place of an object that slid."""
    found = _MOVED.fullmatch(change)
    by = asked.term(found["b"]) if found else None
    if found is None or by is None or by.dimension != "length":
        return None
    name = "x" if found["side"] in ("left", "right") else "y"
    place = Term(expression=f"{name}_mm", dimension="length", words=name)
    return _by(place, "+" if found["side"] in ("right", "up") else "-", by)


def _multiplied(asked: AskedWords, change: str) -> Term | None:
    """A multiple of a quantity, or what each of some has of it."""
    for pattern, sign in ((_SHARED, "/"), (_TO_TIMES, "*")):
        found = pattern.fullmatch(change)
        whole, count = (asked.term(found[name]) for name in "an") if found else (None, None)
        if whole is not None and count is not None:
            expression = f"{whole.divisor} {sign} {count.expression}"
            return replace(whole, expression=expression, words="" if sign == "/" else whole.words)
    for factor, said in _TIMES.items():
        found = re.fullmatch(
            rf"(?:{_WHO} (?:ordered|had|made) )?(?P<a>.+?) {_WAS}(?:{said})(?: {_LARGE})?", change
        ) or re.fullmatch(rf"{_WHO} (?:{said}) (?P<a>.+)", change)
        term = asked.term(found["a"]) if found else None
        if found and term:
            return replace(term, expression=f"{factor} * {term.factor}", words=found["a"])
    return None


def _altered(asked: AskedWords, change: str) -> Term | None:
    """A quantity that is so much more or less, or becomes another one."""
    if found := _GONE.fullmatch(change):
        term, part = asked.term(found["a"]), asked.term(f"{found['share']} of {found['a']}")
        return _by(term, "-", part) if term and part else None
    if found := _CHANGE_OF.fullmatch(change):
        term, by = asked.term(found["a"]), asked.term(found["b"])
        return _by(term, "+" if found["up"] else "-", by) if term and by else None
    for sign, pattern in _CHANGES:
        found = pattern.fullmatch(change)
        term, by = (asked.term(found[name]) for name in "ab") if found else (None, None)
        if term and by and (made := _by(term, sign, by)):
            return made
    return None


def _by(term: Term, sign: str, by: Term) -> Term | None:
    """A term that is so much more or less, or becomes another; a percentage is one of itself."""
    if sign == "=":
        pair = alike(term, by)
        return replace(pair[1], words=term.words) if pair else None
    if by.unit == "%" and not by.words.endswith(("point", "points")):
        expression = f"(1 {sign} {by.factor} / 100) * {term.factor}"
        return replace(term, expression=expression, is_sum=False)
    pair = alike(term, by)
    if pair is None or pair[0].dimension != term.dimension:
        return None
    return replace(term, expression=f"{term.expression} {sign} {pair[1].factor}", is_sum=True)
