"""Questions whether terms compare so: above, below, between, within so much of each other.

    Are we within 0.2 N of the limit?           abs(force_n - limit_n) <= 0.2
    Are x and y both above zero?                x_mm > 0 and y_mm > 0
    Does at least one hold: over 8 N, or deeper than 1 mm?

Not here: suppositions (``tacgrasp.lessons.dialogue.calculations.suppositions``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike
from tacgrasp.lessons.dialogue.meaning import Calculated

_VERB = r"(?:is|are|was|were|does|do|did|would|will|has|have|can|could)"
_ADVERB = (
    r"(?:still|already|now|currently|really|also|then|even|actually|presently|both|yet|at present|"
    r"right now|at the moment|any|clearly|surely|perhaps)"
)
_BE = (
    r"(?:be|lie|lying|sit|land|stay|come out|end up|remain|get|go|fall|"
    r"(?:put|land|take|bring|push|get|carry) (?:us|me|you|it))"
)
_COMPARED = tuple(
    (sign, re.compile(rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})?(?: {_ADVERB})* (?:{said}) (?P<b>.+)"))
    for sign, said in (
        (">=", r"at least|no less than|not less than|not below|not under|no smaller than"),
        ("<=", r"at most|no more than|not more than|not above|not over|no larger than"),
        (
            ">",
            r"(?:more|greater|larger|higher|bigger|heavier|deeper|stronger|further|farther)"
            r"(?: in size)? than|above|over|"
            r"exceed(?:s|ing)?|beyond|past|surpass(?:es|ing)?|violates?|breaks?|tops?|in excess of|"
            r"outweighs?",
        ),
        (
            "<",
            r"(?:less|smaller|lower|lighter|shallower|weaker|nearer|fewer) than|below|under|"
            r"short of|falls? short of|beneath|undercuts?",
        ),
    )
)
_WITHIN = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})? (?:with)?in (?P<c>#.+?) (?:of|from|around) (?P<b>.+)"
)
_BETWEEN = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})? (?:somewhere )?between (?P<b>.+) and (?P<c>.+)"
)
_IN_BAND = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})? (?:(?P<out>outside(?: of)?|out of)|within|inside|in) "
    r"(?:the |our |this )?(?:\w+ ){0,2}(?:band|range|window|goal|target)"
)
_ANY = re.compile(
    r"(?:either one|at least one|one of (?:them|these|the two)|any)(?: of (?:these|them|the two))?"
    r"(?: (?:is|are|holds?|true|satisfied|met|the case|fulfilled|of the following))*"
)
_ASKS_ANY = re.compile(rf"^(?:{_VERB} )?{_ANY.pattern} | {_ANY.pattern}$")
_JOINT = re.compile(r" (and|or) ")
_RESERVE = re.compile(
    r"(?:we|you|i|there|it) (?:(?:still|have|got|is) )*(?:(?P<more>more|over)|(?P<less>less|"
    r"under)) "
    r"than (?P<b>.+?) (?:in reserve|left|unused|to spare|in hand|headroom|free|remaining)"
    r"(?: (?:before|to|until|below|under) (?:the )?limit)?"
)


def calculated_check(asked: AskedWords) -> Calculated | None:
    """What a question asks whether it is so; None where it asks for no such thing."""
    words, is_any = asked.words, False
    if _ASKS_ANY.search(words):
        is_any, words = True, _ASKS_ANY.sub("", words)
    elif begin := re.match(rf"{_VERB} (?=.)", words):
        words = words[begin.end() :]
    else:
        return None
    condition = _condition(asked, words.strip(), joint=" or " if is_any else "")
    return None if condition is None else Calculated(truth=condition, unit=None)


def condition_of(asked: AskedWords, words: str) -> str | None:
    """The condition that a clause without its verb states; None where it states none."""
    if found := _RESERVE.fullmatch(words):
        left = Term(expression="limit_n - force_n", dimension="force", words="", is_sum=True)
        rest = asked.term(found["b"])
        pair = alike(left, rest) if rest else None
        sign = ">" if found["more"] else "<"
        return f"{pair[0].expression} {sign} {pair[1].factor}" if pair else None
    if found := _WITHIN.fullmatch(words):
        pair = _pair(asked, found["a"], found["b"])
        tolerance = asked.term(found["c"])
        if pair and tolerance and alike(pair[0], tolerance):
            near = alike(pair[0], tolerance)
            assert near is not None
            return f"abs({pair[0].expression} - {pair[1].factor}) <= {near[1].factor}"
    if found := _BETWEEN.fullmatch(words):
        low, high = (_pair(asked, found["a"], found[name]) for name in "bc")
        if low and high:
            a, b, c = low[0].factor, low[1].factor, high[1].factor
            return f"min({b}, {c}) <= {a} <= max({b}, {c})"
    if found := _IN_BAND.fullmatch(words):
        force = asked.term(found["a"], beside=usual("force"))
        if force and force.dimension == "force":
            inside = f"band_low_n <= {force.factor} <= band_high_n"
            return f"not ({inside})" if found["out"] else inside
    return _comparison(asked, words)


def _comparison(asked: AskedWords, words: str) -> str | None:
    for sign, pattern in _COMPARED:
        found = pattern.fullmatch(words)
        if found is None:
            continue
        if pair := _pair(asked, found["a"], found["b"], is_above=">" in sign):
            return f"{pair[0].expression} {sign} {pair[1].factor}"
        if both := _both(asked, found["a"], found["b"], sign):
            return both
    return None


def _both(asked: AskedWords, subjects: str, words: str, sign: str) -> str | None:
    """'x and y both above zero': each of the subjects."""
    parts = re.split(r" (and|or) ", subjects.removeprefix("both ").removeprefix("either "))
    if len(parts) != 3:
        return None
    pairs = [_pair(asked, part, words) for part in (parts[0], parts[2])]
    told = [f"{pair[0].expression} {sign} {pair[1].factor}" for pair in pairs if pair]
    return f" {parts[1]} ".join(told) if len(told) == 2 else None


def _condition(asked: AskedWords, words: str, *, joint: str) -> str | None:
    """The condition of a clause, or of several that 'and' or 'or' joins."""
    if whole := condition_of(asked, words):
        return whole
    for found in _JOINT.finditer(words):
        first = condition_of(asked, words[: found.start()])
        rest = re.sub(rf"^(?:{_VERB} )", "", words[found.end() :])
        second = _condition(asked, rest, joint=joint) if first else None
        if first and second:
            return f"({first}){joint or found[0]}({second})"
    return None


def _pair(asked: AskedWords, a: str, b: str, *, is_above: bool = True) -> tuple[Term, Term] | None:
    second = asked.bound(b, is_above=is_above)
    first = asked.term(a, beside=second) if second else None
    if first is None or second is None:
        return None
    pair = alike(first, second)
    has_quantity = first.has_quantity or second.has_quantity
    return pair if has_quantity else None
