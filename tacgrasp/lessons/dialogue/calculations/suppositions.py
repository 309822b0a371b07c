"""Questions about what would be if a quantity were another one.

    If the force dropped by 20 %, what would remain?        0.8 * force_n
    Suppose you pushed 1 N harder: above the band?          force_n + 1 > band_high_n
    If the limit were halved, would the force violate it?   force_n > 0.5 * limit_n

Not here: questions about what is (``tacgrasp.lessons.dialogue.calculations.amounts``,
``tacgrasp.lessons.dialogue.calculations.checks``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.amounts import amount_of, calculated_amount
from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.checks import calculated_check
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike
from tacgrasp.lessons.dialogue.meaning import Calculated

_SUPPOSED = re.compile(
    r"(?:if|suppose|supposing|imagine|assume|assuming|say|were|with|after|once|when)(?: "
    r"that)? (?P<all>.+)"
)
_QUESTION = re.compile(
    r" (?:then )?(?=(?:what|how|would|will|could|can|is|are|does|do|which|by how|in)\b)"
)
_CONDITION = re.compile(
    r" (?:if|suppose|supposing|provided|assuming|once|when|after|with)(?: that)? (?=.)"
)
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
    rf"(?P<a>.+?) (?:{_UP}|{_DOWN}) to (?P<n>#\d+) times (?:the )?(?:\w+ )?(?:size|value|"
    rf"amount|depth|self)"
)
_PRESSED = re.compile(
    rf"(?:{_WHO}|it|the (?:fingers|gripper|robot|hand)) (?:push|press|squeez|gripp?|pinch|"
    rf"clamp|put on|add)(?:ed|e|es|s)?"
    r"(?: with)? (?P<b>#.+?) (?:(?P<more>harder|more|firmer|stronger|deeper|extra)|"
    r"(?P<less>softer|less|"
    r"lighter|gentler|shallower))"
)
_EASED = re.compile(
    rf"(?:{_WHO} )?(?:(?:backing|easing) off|releasing|letting go of|let go of|released?|"
    rf"gave up|back(?:ed)? off|ease(?:d)?(?: off)?|took off|"
    rf"took away|drop(?:ped)?)"
    r"(?: by)? (?P<b>.+)"
)
_GONE = re.compile(
    r"(?P<share>.+) of (?P<a>.+?) (?:vanished|vanishes|was lost|were lost|disappeared|went "
    r"away|were gone|was gone|"
    r"is lost|fell away)"
)
_ON_TOP = re.compile(
    r"(?:another )?(?P<b>#\d+ \w+)(?: more)? (?:came|comes|were put|was put|were added|was "
    r"added)(?: on top)?"
)
_CHANGE_OF = re.compile(
    r"(?:an? )?(?P<b>#\d+ \w+) (?:(?P<up>increase|rise|gain|growth)|decrease|drop|fall|"
    r"reduction|cut) (?:of|in) (?P<a>.+)"
)
_MOVED = re.compile(
    r"(?:it|the (?:object|contact|thing))(?: (?:was|were|is|had|has|been))* (?:shifted|moved|"
    r"slid|pushed|moves|slides|shifts)"
    r"(?: by)? (?P<b>#\d+ \w+) (?:to the )?(?P<side>left|right|up|down)(?:wards?)?"
)
_LOADED = re.compile(
    rf"{_WHO} (?:add(?:ed)?|put|stuck|stick|glued?|attach(?:ed)?|placed?|hung) (?:an? "
    rf")?(?P<b>#\d+ \w+)"
    r"(?: \w+)? (?:to|onto|on) (?:the )?\w+"
)
_SHARED = re.compile(
    r"(?P<n>#\d+) (?:jaws|fingers|pads|grippers|people|robots|of them|parts)(?: \w+)? "
    r"(?:share|carry|split|divide)d? "
    r"(?P<a>.+?)(?: (?:equally|evenly|between them|alike))*"
)
_EXTRA = re.compile(
    rf"(?:would|will|does) (?:(?:(?:adding|another|an extra|a further) )+(?P<b>#\d+ "
    rf"(?:{UNIT}))(?: more| extra)?|"
    rf"(?P<more>#\d+ (?:{UNIT})) (?:more|extra)) (?P<rest>.+)"
)
_WITHOUT = re.compile(
    rf"(?:can|could|may|might) (?:i|we|you) (?:still )?(?:add|put on|press|squeeze)(?: "
    rf"another)? (?P<b>#\d+ (?:{UNIT}))"
    r"(?: more| harder| extra)? without (?:going over|exceeding|passing|breaking|"
    r"crossing)(?: (?:it|(?:the )?limit))?"
)
_SUBJECT = re.compile(
    r"(?:what|how (?:much|deep|large|big|strong|high)) (?:would|will|is) (.+?) (?:be|become|"
    r"come to|amount to)\b"
)
"""What a pronoun before or behind stands for: 'what would the force be if it rose'."""

_RESULT = re.compile(
    r"(?:what|how (?:much|deep|heavy|large|big|strong|hard))(?: (?:force|depth|mass|weight|"
    r"area|limit))? "
    r"(?:would|will|is|are|does|do)(?: (?:that|it|we|you|i|there|each(?: of them)?|the (?:new|"
    r"total|resulting|whole|combined) "
    r"\w+|the (?:force|depth|mass|weight|area|limit)|the|remain|be|left|have|result|become|"
    r"read|show|get|make|come|to|amount|still|then|apply|feel|carry|hold|take))*|"
    r"(?:what|how much) (?:remains|is left|results)|"
    r"(?:what|how many|how much|which)(?: (?:percent|percentage|share))? of (?:the )?pad "
    r"(?:would|will|does) (?:it|that) (?:cover|touch)"
)


def supposed(asked: AskedWords) -> Calculated | None:
    """What a question asks about a changed quantity; None where it changes none."""
    for change, rest in _clauses(asked.words):
        named = _SUBJECT.match(rest)
        subject = asked.term(named[1]) if named else None
        before = asked if subject is None else asked.about(subject, change)
        if (changed := _changed(before, change)) is None:
            continue
        after = asked.about(changed, rest)
        if _RESULT.fullmatch(rest.replace(changed.words, "it") if changed.words else rest):
            return amount_of(changed, after)
        if found := calculated_check(after) or calculated_amount(after):
            return found
    return None


def _clauses(words: str) -> Iterator[tuple[str, str]]:
    """What a question supposes, and what it asks, in every way it may be divided so."""
    if found := _WITHOUT.search(words):
        yield f"we press {found['b']} harder", "would the limit be respected"
    if found := _EXTRA.fullmatch(words):
        yield f"we press {found['b'] or found['more']} harder", f"would it {found['rest']}"
    if found := _SUPPOSED.fullmatch(words):
        for joint in _QUESTION.finditer(found["all"]):
            yield found["all"][: joint.start()], found["all"][joint.end() :]
    for joint in _CONDITION.finditer(words):
        yield words[joint.end() :], words[: joint.start()]


def _changed(asked: AskedWords, change: str) -> Term | None:
    """A quantity after a change that a clause tells; None where it tells none."""
    if found := _PRESSED.fullmatch(change):
        by = asked.term(found["b"])
        base = "depth_mm" if by and by.dimension == "length" else "force_n"
        if by is None or by.dimension not in ("force", "length", "mass"):
            return None
        felt = Term(
            expression=base, dimension="length" if base == "depth_mm" else "force", words=""
        )
        return _by(felt, "+" if found["more"] else "-", by)
    for pattern in (_EASED, _ON_TOP):
        by = asked.term(found["b"]) if (found := pattern.fullmatch(change)) else None
        if by is not None and by.dimension in ("force", "length"):
            return _by(usual(by.dimension), "-" if pattern is _EASED else "+", by)
    if found := _GONE.fullmatch(change):
        term, part = asked.term(found["a"]), asked.term(f"{found['share']} of {found['a']}")
        if term is not None and part is not None:
            return _by(term, "-", part)
    if found := _CHANGE_OF.fullmatch(change):
        term, by = asked.term(found["a"]), asked.term(found["b"])
        return _by(term, "+" if found["up"] else "-", by) if term and by else None
    if found := _MOVED.fullmatch(change):
        by = asked.term(found["b"])
        name = "x_mm" if found["side"] in ("left", "right") else "y_mm"
        if by is not None and by.dimension == "length":
            place = Term(expression=name, dimension="length", words=name[0])
            return _by(place, "+" if found["side"] in ("right", "up") else "-", by)
    if found := _LOADED.fullmatch(change):
        by = asked.term(found["b"])
        if by is not None and by.dimension == "mass":
            return _by(Term(expression="mass_g", dimension="mass", words=""), "+", by)
    if found := _SHARED.fullmatch(change):
        whole, count = asked.term(found["a"]), asked.term(found["n"])
        if whole is not None and count is not None:
            expression = f"{whole.factor} / {count.expression}"
            return replace(whole, expression=expression, words="")
    if found := _TO_TIMES.fullmatch(change):
        term, count = asked.term(found["a"]), asked.term(found["n"])
        if term is not None and count is not None:
            expression = f"{count.expression} * {term.factor}"
            return replace(term, expression=expression, words=found["a"])
    for factor, said in _TIMES.items():
        found = re.fullmatch(
            rf"(?:{_WHO} (?:ordered|had|made) )?(?P<a>.+?) {_WAS}(?:{said})(?: {_LARGE})?", change
        ) or re.fullmatch(rf"{_WHO} (?:{said}) (?P<a>.+)", change)
        term = asked.term(found["a"]) if found else None
        if found and term:
            return replace(term, expression=f"{factor} * {term.factor}", words=found["a"])
    for sign, pattern in _CHANGES:
        found = pattern.fullmatch(change)
        term, by = (asked.term(found[name]) for name in "ab") if found else (None, None)
        if found and term and by and (made := _by(term, sign, by)):
            return made
    return None


def _by(term: Term, sign: str, by: Term) -> Term | None:
    """A term that is so much more or less, or becomes another; a percentage is one of itself."""
    if sign == "=":
        pair = alike(term, by)
        return replace(pair[1], words=term.words) if pair else None
    if by.dimension == "fraction" and term.dimension != "fraction":
        expression = f"(1 {sign} {by.factor} / 100) * {term.factor}"
        return replace(term, expression=expression, is_sum=False)
    pair = alike(term, by)
    if pair is None or pair[0].dimension != term.dimension:
        return None
    expression = f"{term.expression} {sign} {pair[1].factor}"
    return replace(term, expression=expression, is_sum=True)
