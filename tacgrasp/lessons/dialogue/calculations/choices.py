"""Questions which of two terms is greater or nearer, and whether to grip more or less.

    What is greater, the force or the weight?       'the force' if ... else 'the weight'
    Is the force nearer to zero or to the limit?
    To get into the band, tighten, hold or loosen?

Not here: choices between words of the contact (``tacgrasp.lessons.dialogue.families.classes``).
"""

from __future__ import annotations

import re
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.checks import shared_noun
from tacgrasp.lessons.dialogue.calculations.quantity_names import is_band
from tacgrasp.lessons.dialogue.calculations.scales import half_of_scale
from tacgrasp.lessons.dialogue.calculations.terms import alike
from tacgrasp.lessons.dialogue.meaning import Calculated

_GREATER = r"(?:greater|larger|bigger|higher|more|heavier|stronger|longer|further|farther|most)"
_LESS = r"(?:smaller|less|lower|lighter|weaker|shorter|nearer|closer|least)"
_FROM_ZERO = r"(?: (?:in size|in magnitude|(?:from|to) (?:#\d+|the (?:middle|center))(?: here)?))?"
_WHICH = re.compile(
    rf"(?:which|what)(?: (?:one|figure|value|number|quantity|thing|offset|of (?:the|these) two|"
    rf"of these|is|are|from|the|(?:middle|center)))* (?:the )?(?:(?P<more>{_GREATER})|"
    rf"(?P<less>{_LESS}))(?P<zero>{_FROM_ZERO})(?: (?:one|number|figure|amount|value|"
    r"quantity|force(?! (?:limit|band))|of (?:them|the lot)))?(?: (?:here|now|right now|"
    r"at present))?(?: of (?:(?:the |these |those )?(?:#\d+|two|both)|[a-z]+(?= (?:the|its|my|"
    r"our)\b)))? "
    r"(?P<a>.+) or (?P<b>.+)"
)
_AWAY = r"(?:further|farther)(?: (?:away|off))? from"
_FARTHER = re.compile(
    rf"(?:(?:is|are|does|do|was) )?(?P<a>(?!which|what).+?) {_AWAY} (?P<b>.+) or(?: {_AWAY})?"
    r"(?: from)? (?P<c>.+)|"
    rf"(?:which|what)(?: of (?:these|them|the two))? is {_AWAY} (?P<a2>.+?) "
    r"(?P<b2>(?:the |our |#\d).+) or (?P<c2>.+)"
)
_NEARER = re.compile(
    r"(?:(?:is|are|does|do|was) )?(?P<a>.+?)(?: (?:sit|lie|lying|stand|be|stay|sitting))? "
    r"(?:nearer|closer)(?: to)? (?P<b>.+) or(?: (?:closer|nearer))?(?: to)? (?P<c>.+)"
)
_THREE = re.compile(
    r"(?:which|what)(?: one)?(?: of (?:these|the|those) (?:#\d+|three))? is (?:the )?"
    r"(?:(?P<more>greatest|largest|biggest|highest|strongest|longest|most)|"
    r"smallest|lowest|least|weakest|shortest) "
    r"(?P<a>(?:the |our )?\S+(?: \S+){0,5}?) (?P<b>(?:the |our |#\d)\S*(?: \S+){0,5}?) or "
    r"(?P<c>.+)"
)
_WHICH_NEARER = re.compile(
    r"(?:which|what)(?: of (?:these|them|the two))? (?:is|are|does|do) (?P<a>.+?) "
    r"(?:nearer|closer)(?: to)? (?P<b>.+) or(?: to)? (?P<c>.+)"
)
_NAMED_NEARER = re.compile(
    r"(?P<b>.+?) or (?P<c>.+?) (?:to )?which(?: (?:one|of (?:these|them|the two|those)))? "
    r"(?:is|are|does|do) (?P<a>.+?)(?: (?:come|lie|be|sit|stand|get))? (?:nearer|closer)(?: to)?"
)
_WHICH_END = re.compile(
    r"(?:to )?(?:which|what) (?:edge|end|side|bound|limit|border) of (?:the |our )?(?P<band>.+?) "
    r"(?:is|are|does|do) (?P<a>.+?)(?: (?:sit|lie))? (?:nearer|"
    r"closer)(?: to)?(?: (?:the )?(?P<b>\w+)(?: (?:one|end|edge))? or "
    r"(?:the )?(?P<c>\w+)(?: (?:one|end|edge))?)?"
)
_PICKED_END = re.compile(
    r"(?:(?:pick|choose|name|take) )?(?:the )?(?:edge|end|side|bound) of (?:the |"
    r"our )?(?P<band>.+?) "
    r"(?P<b>low|lower|upper|high|bottom|top) or (?P<c>low|lower|upper|high|bottom|top) "
    r"(?:that|which) (?:is|lies) (?:nearer|closer|nearest|closest)(?: to)? (?P<a>.+)"
)
_OF_BOTH_ENDS = re.compile(
    r"(?:which|what) (?:of the (?:#\d+|two) )?(?:(?:edge|end|side|bound)s? of "
    r"(?:the |our )?(?P<band>.+?)|(?P<of>\w+) (?:edge|end)s?) (?:is|are) "
    r"(?:(?:nearer|closer)(?: to)? (?P<a>.+?)|(?P<also>.+?) (?:nearer|closer)(?: to)?) "
    r"(?:the )?(?P<b>lower|upper|bottom|top)(?: one)? or "
    r"(?:the )?(?P<c>lower|upper|bottom|top)(?: one)?"
)
_COVERED = re.compile(
    r"is (?:more|most|the (?:larger|greater|bigger) part) of (?:the )?pad (?P<one>\w+) or "
    r"(?P<two>\w+)"
)
_TOUCHED, _FREE = ("covered", "touched", "pressed"), ("free", "uncovered", "untouched", "empty")
_SIDE = r"above|over|below|under|more|less|higher|lower|beneath|beyond"
_ABOVE_WORDS = ("above", "over", "more", "higher", "beyond")
_OVER_UNDER = re.compile(
    rf"(?:(?:is|are) )?(?P<a>.*?) ?(?P<one>{_SIDE}) or (?P<two>{_SIDE})(?: than)? (?P<b>.+)"
)
_WHICH_SIDE = re.compile(
    rf"(?:on )?which side of (?P<b>.+?)(?: (?:mark|line|threshold))? (?:is|are|does|do) "
    rf"(?P<a>.+?)(?: (?:on|lie|lie on))? (?P<one>{_SIDE}) or (?P<two>{_SIDE})"
)
_TIGHTEN = (
    r"(?:tighten(?:ed)?|squeeze (?:harder|more)|grip (?:harder|more)|press (?:harder|more)|"
    r"increased?|raised|add)"
)
_LOOSEN = (
    r"(?:loosen(?:ed)?|eased?(?: off)?|relax(?:ed)?|decreased?|reduced?|lowered|"
    r"squeeze (?:less|softer)|let go a (?:bit|little))"
)
_HOLD = (
    r"(?:hold(?: still| on)?|held|keep(?: it)?|kept|stay|leave it|left (?:alone|as it is)|"
    r"do nothing|wait|stop)"
)
_STEP = re.compile(
    rf"(?=.*\b(?P<more>{_TIGHTEN})\b)(?=.*\b(?P<less>{_LOOSEN})\b)(?:.*\b(?P<hold>{_HOLD})\b)?"
)
_INTO_BAND = re.compile(r"(?=.*\bor\b).*\b(?:band|range|window|corridor|target|goal)\b")
_ANOTHER = re.compile(
    r"\b(?:and|then) (?:why|what|how|which|where|as the reason|quote|tell|give)\b"
)
_BACK = re.compile(
    r"(?:(?:which|what) (?:way|direction|side)|where)(?: to)?\b.*?\b(?:shove|push|nudge|slide|"
    r"shift) (?:it|the object|this|that)\b.*\b(?:middle|center|centered)(?: left or right|"
    r" right or left)?"
)
_UPPER, _LOWER = r"(?:upper|top|above|up|higher)", r"(?:lower|bottom|below|down|under)"
_HALVES = re.compile(
    rf"(?=.*\b(?P<up>{_UPPER})\b)(?=.*\b(?P<down>{_LOWER})\b).*\b(?:{_UPPER}|{_LOWER}) "
    rf"(?:half |part |side |one )?or (?:is it |the |in the |more )*(?:{_UPPER}|{_LOWER})\b.*"
)
_ASKS_WHERE = re.compile(r"(?:is|are|does|do|would|which|what|where|in which|on which|contact)\b")
_PLACED = re.compile(r"\b(?:half|side|part|where|contact|middle|center|pad|thing|gel)\b")
_NOT_PLACED = re.compile(
    r"\b(?:if|how|than|straight|band|range|window|force|limit|goal|target|depth|area|mass|edge|"
    r"offset|matter|whether|#\d+|should|move|go)\b"
)
_ARTICLE = re.compile(r"^(?:the|our|to|to the) ")


_OF_THE_TWO = re.compile(
    r"(?:of|between) (?:(?:the|these) )?#\d+ (?P<a>.+) and (?P<b>.+) which (?:one )?(?:is|are) "
    r"(?P<how>.+)|is it (?P<a2>.+) or (?P<b2>.+) (?:that|which) (?:is|are) (?P<how2>.+)"
)


def calculated_choice(asked: AskedWords) -> Calculated | None:
    """What a question lets choose by terms; None where it lets choose nothing so."""
    if two := _OF_THE_TWO.fullmatch(asked.words):
        a, b, how = (two[name] or two[f"{name}2"] for name in ("a", "b", "how"))
        asked = replace(asked, words=f"which is {how} {a} or {b}")
    for reader in (
        _which, _of_three, _which_end, _nearer, _farther, _scale_half, _over_or_under, _step, _back,
        _half, _covered,
    ):  # fmt: skip
        if found := reader(asked):
            return found
    return None


def _chosen(first: str, condition: str, second: str, asked: AskedWords) -> Calculated | None:
    words = [asked.said(_ARTICLE.sub("", each)) for each in (first, second)]
    if words[0] == words[1]:
        return None
    return Calculated(truth=f"{words[0]!r} if {condition} else {words[1]!r}", unit=None)


def _which(asked: AskedWords) -> Calculated | None:
    if (found := _WHICH.fullmatch(asked.words)) is None:
        return None
    first, second = (asked.term(each) for each in shared_noun(asked, found["a"], found["b"]))
    pair = alike(first, second) if first and second else None
    if pair is None or pair[0].expression == pair[1].expression:
        return None
    if not (pair[0].has_quantity or pair[1].has_quantity):
        return None
    a, b = (f"abs({term.expression})" if found["zero"] else term.factor for term in pair)
    sign = ">" if found["more"] else "<"
    return _chosen(found["a"], f"{a} {sign} {b}", found["b"], asked)


def _of_three(asked: AskedWords) -> Calculated | None:
    """The largest or the smallest of three terms."""
    if (found := _THREE.fullmatch(asked.words)) is None:
        return None
    names = [found[each] for each in "abc"]
    terms = [term for each in names if (term := asked.term(each))]
    if len(terms) < len(names) or len({term.dimension for term in terms}) > 1:
        return None
    if not any(term.has_quantity for term in terms):
        return None
    a, b, c = (term.factor for term in terms)
    sign = ">=" if found["more"] else "<="
    said = [repr(asked.said(_ARTICLE.sub("", each))) for each in names]
    rest = f"{said[1]} if {b} {sign} {c} else {said[2]}"
    truth = f"{said[0]} if {a} {sign} {b} and {a} {sign} {c} else {rest}"
    return Calculated(truth=truth, unit=None)


def _nearer(asked: AskedWords) -> Calculated | None:
    """The one of two terms that a third is nearer to."""
    patterns = (_WHICH_NEARER, _NAMED_NEARER, _NEARER)
    found = next(filter(None, (each.fullmatch(asked.words) for each in patterns)), None)
    return _by_distance(asked, *(found[name] for name in "abc"), sign="<") if found else None


def _farther(asked: AskedWords) -> Calculated | None:
    """The one of two terms that a third is farther from."""
    if (found := _FARTHER.fullmatch(asked.words)) is None:
        return None
    return _by_distance(asked, *(found[name] or found[f"{name}2"] for name in "abc"), sign=">")


def _by_distance(asked: AskedWords, a: str, b: str, c: str, *, sign: str) -> Calculated | None:
    """The second of three phrases where its distance from the first is less, or more, by a sign."""
    names = shared_noun(asked, b, c)
    one, other = (asked.term(name) for name in names)
    if one is None or other is None:
        return None
    subject = asked.term(a, beside=other if other.has_quantity else one)
    pairs = [alike(subject, each) if subject else None for each in (one, other)]
    if pairs[0] is None or pairs[1] is None:
        return None
    to_b, to_c = (f"abs({a.expression} - {b.factor})" for a, b in filter(None, pairs))
    return _chosen(b, f"{to_b} {sign} {to_c}", c, asked)


def _which_end(asked: AskedWords) -> Calculated | None:
    patterns = (_WHICH_END, _PICKED_END, _OF_BOTH_ENDS)
    found = next(filter(None, (each.fullmatch(asked.words) for each in patterns)), None)
    if found is None or not is_band(found["band"] or found["of"]):
        return None
    named = found["a"] or found.groupdict().get("also") or ""
    force = asked.term(named, beside=usual("force"))
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
    if found is None or not _INTO_BAND.search(asked.words) or _ANOTHER.search(asked.words):
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


def _covered(asked: AskedWords) -> Calculated | None:
    """Which part of the pad is the larger one, in the question's own words."""
    found = _COVERED.fullmatch(asked.words)
    if found is None:
        return None
    one, two = found["one"], found["two"]
    if one in _FREE and two in _TOUCHED:
        one, two = two, one
    if one not in _TOUCHED or two not in _FREE:
        return None
    return Calculated(truth=f"'{one}' if area_percent > 50 else '{two}'", unit=None)


def _scale_half(asked: AskedWords) -> Calculated | None:
    """The half of a stated scale that a quantity is in."""
    told = half_of_scale(asked)
    return _chosen(*told, asked) if told else None


def _half(asked: AskedWords) -> Calculated | None:
    """The upper or the lower half of the pad, in the question's own words."""
    found = _HALVES.fullmatch(asked.words)
    if (
        found is None
        or not _ASKS_WHERE.match(asked.words)
        or not _PLACED.search(asked.words)
        or _NOT_PLACED.search(asked.words)
    ):
        return None
    return Calculated(truth=f"'{found['up']}' if y_mm > 0 else '{found['down']}'", unit=None)
