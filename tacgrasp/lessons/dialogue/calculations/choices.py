"""Questions which of two terms is greater or nearer, and whether to grip more or less.

    What is greater, the force or the weight?       'the force' if ... else 'the weight'
    Is the force nearer to zero or to the limit?
    To get into the band, tighten, hold or loosen?

Not here: choices between words of the contact (``tacgrasp.lessons.dialogue.families.classes``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike
from tacgrasp.lessons.dialogue.meaning import Calculated

_GREATER = r"(?:greater|larger|bigger|higher|more|heavier|stronger|longer|further|farther|most)"
_LESS = r"(?:smaller|less|lower|lighter|weaker|shorter|nearer|closer|least)"
_FROM_ZERO = r"(?: (?:in size|in magnitude|(?:from|to) (?:#\d+|the (?:middle|center))(?: here)?))?"
_WHICH = re.compile(
    rf"(?:which|what)(?: (?:one|figure|value|number|quantity|thing|offset|of (?:the|these) "
    rf"two|of these|"
    rf"is|are|from|the|(?:middle|center)))* (?:the )?(?:(?P<more>{_GREATER})|(?P<less>{_LESS}))"
    rf"(?P<zero>{_FROM_ZERO})(?: one)? (?P<a>.+) or (?P<b>.+)"
)
_NEARER = re.compile(
    r"(?:(?:is|are|does|do|was) )?(?P<a>.+?)(?: (?:sit|lie|lying|stand|be|stay|sitting))? "
    r"(?:nearer|closer)(?: to)? (?P<b>.+) or(?: (?:closer|nearer))?(?: to)? (?P<c>.+)"
)
_WHICH_END = re.compile(
    r"(?:to )?(?:which|what) (?:edge|end|side|bound|limit|border) of (?:the |our )?(?P<band>.+?) "
    r"(?:is|are|does|do) (?P<a>.+?)(?: (?:sit|lie))? (?:nearer|closer)(?: to)?"
    r"(?: (?:the )?(?P<b>\w+)(?: (?:one|end|edge))? or (?:the )?(?P<c>\w+)(?: (?:one|end|edge))?)?"
)
_SIDE = r"above|over|below|under|more|less|higher|lower|beneath|beyond"
_ABOVE_WORDS = ("above", "over", "more", "higher", "beyond")
_OVER_UNDER = re.compile(
    rf"(?:(?:is|are) )?(?P<a>.*?) ?(?P<one>{_SIDE}) or (?P<two>{_SIDE})(?: than)? (?P<b>.+)"
)
_WHICH_SIDE = re.compile(
    rf"(?:on )?which side of (?P<b>.+?)(?: (?:mark|line|threshold))? (?:is|are|does|do) (?P<a>.+?)"
    rf"(?: (?:on|lie|lie on))? (?P<one>{_SIDE}) or (?P<two>{_SIDE})"
)
_TIGHTEN = (
    r"(?:tighten|squeeze (?:harder|more)|grip (?:harder|more)|press (?:harder|more)|increase|add)"
)
_LOOSEN = (
    r"(?:loosen|ease(?: off)?|relax|decrease|reduce|squeeze (?:less|softer)|let go a (?:bit|"
    r"little))"
)
_HOLD = r"(?:hold(?: still| on)?|keep(?: it)?|stay|leave it|do nothing|wait|stop)"
_STEP = re.compile(
    rf"(?=.*\b(?P<more>{_TIGHTEN})\b)(?=.*\b(?P<less>{_LOOSEN})\b)(?:.*\b(?P<hold>{_HOLD})\b)?"
)
_ANOTHER = re.compile(r"\b(?:and|then) (?:why|what|how|which|where)\b")
_BACK = re.compile(
    r"(?:(?:which|what) (?:way|direction|side)|where)(?: to)?\b.*?\b(?:shove|push|nudge|"
    r"slide|shift) "
    r"(?:it|the object|this|that)\b.*\b(?:middle|center|centered)(?: left or right| right or left)?"
)
_ARTICLE = re.compile(r"^(?:the|our|to|to the) ")


def calculated_choice(asked: AskedWords) -> Calculated | None:
    """What a question lets choose by terms; None where it lets choose nothing so."""
    for reader in (_which, _which_end, _nearer, _over_or_under, _step, _back):
        if found := reader(asked):
            return found
    return None


def _chosen(first: str, condition: str, second: str, asked: AskedWords) -> Calculated | None:
    words = [asked.said(_ARTICLE.sub("", each)) for each in (first, second)]
    if words[0] == words[1] or any("'" in word for word in words):
        return None
    return Calculated(truth=f"'{words[0]}' if {condition} else '{words[1]}'", unit=None)


def _which(asked: AskedWords) -> Calculated | None:
    if (found := _WHICH.fullmatch(asked.words)) is None:
        return None
    pair = _terms(asked, found["a"], found["b"])
    if pair is None:
        return None
    a, b = (f"abs({term.expression})" if found["zero"] else term.factor for term in pair)
    sign = ">" if found["more"] else "<"
    return _chosen(found["a"], f"{a} {sign} {b}", found["b"], asked)


def _nearer(asked: AskedWords) -> Calculated | None:
    if (found := _NEARER.fullmatch(asked.words)) is None:
        return None
    b, c = found["b"], found["c"]
    if shared := re.fullmatch(r"(?:the )?(\w+) (.+)", c):
        b = b if asked.term(b) else f"{b} {shared[2]}"
    near, far = asked.term(b), asked.term(c)
    if near is None or far is None:
        return None
    subject = asked.term(found["a"], beside=far if far.has_quantity else near)
    pairs = [alike(subject, each) if subject else None for each in (near, far)]
    if pairs[0] is None or pairs[1] is None:
        return None
    to_b, to_c = (f"abs({a.expression} - {other.factor})" for a, other in filter(None, pairs))
    return _chosen(found["b"], f"{to_b} < {to_c}", found["c"], asked)


def _which_end(asked: AskedWords) -> Calculated | None:
    found = _WHICH_END.fullmatch(asked.words)
    if found is None or not re.search(r"(?:band|range|window|goal|target)$", found["band"]):
        return None
    force = asked.term(found["a"], beside=usual("force"))
    if force is None or force.dimension != "force":
        return None
    low, high = found["b"] or "lower", found["c"] or "upper"
    if re.match(r"upper|top|high|max", low):
        low, high = high, low
    to_low, to_high = (f"abs({force.expression} - {end})" for end in ("band_low_n", "band_high_n"))
    return _chosen(low, f"{to_low} < {to_high}", high, asked)


def _over_or_under(asked: AskedWords) -> Calculated | None:
    for pattern in (_OVER_UNDER, _WHICH_SIDE):
        if (found := pattern.fullmatch(asked.words)) is None:
            continue
        one, two = found["one"], found["two"]
        if (one in _ABOVE_WORDS) == (two in _ABOVE_WORDS):
            return None
        b = asked.term(found["b"])
        a = asked.term(found["a"] or "it", beside=b) if b else None
        pair = alike(a, b) if a and b else None
        if pair is None or not pair[0].has_quantity:
            continue
        above, below = (one, two) if one in _ABOVE_WORDS else (two, one)
        return _chosen(above, f"{pair[0].expression} > {pair[1].factor}", below, asked)
    return None


def _step(asked: AskedWords) -> Calculated | None:
    found = _STEP.match(asked.words)
    if found is None or " or " not in asked.words or _ANOTHER.search(asked.words):
        return None
    more, less, hold = found["more"], found["less"], found["hold"] or "hold"
    return Calculated(
        truth=(
            f"'{more}' if force_n < band_low_n else '{less}' if force_n > band_high_n else '{hold}'"
        ),
        unit=None,
    )


def _back(asked: AskedWords) -> Calculated | None:
    """Where the object must go to be in the middle: away from its side."""
    if _BACK.fullmatch(asked.words) is None:
        return None
    return Calculated(truth="'left' if x_mm > 0 else 'right'", unit=None)


def _terms(asked: AskedWords, a: str, b: str) -> tuple[Term, Term] | None:
    """Both terms to choose from; 'x or y offset' shares its noun."""
    second = asked.term(b)
    first = asked.term(a)
    if first is None and (shared := re.fullmatch(r"(?:the )?(\w+) (.+)", b)):
        first = asked.term(f"{a} {shared[2]}")
    pair = alike(first, second) if first and second else None
    return pair if pair and (pair[0].has_quantity or pair[1].has_quantity) else None
