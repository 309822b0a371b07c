"""Choices between the ends of a range: which one is nearer, and which half it is.

    Is the force nearer the floor or the ceiling of the band?
    The force, is it nearer to the limit or nearer to the top of the band?
    From zero to the limit, are we in the lower or the upper half?

Not here: other choices (``tacgrasp.lessons.dialogue.choices.choosing``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike
from tacgrasp.lessons.dialogue.choices.conditions import choice_of
from tacgrasp.lessons.dialogue.choices.rest import RestOfQuestion, rest_of
from tacgrasp.lessons.dialogue.choices.scales import ENDS, GAP

_NEARER = re.compile(r"\b(?:near|nearer|nearest|closer|closest|close)(?: up)?(?: to)?\b")
_OR = re.compile(
    r" or (?:is it )?(?:rather |instead |more )?(?:nearer |closer )?(?:to )?(?:the |its |our )?"
)
_MOST_WORDS = 9
"""Longest end of a range [words]."""

_BAND_ENDS = ("band_low_n", "band_high_n")
_HEAD = re.compile(r"^(?:(?:the|our|its|to) )+")


def nearer_of(asked: AskedWords) -> str | None:
    """Which of two named terms, or ends of the band, is nearer; None of other questions."""
    if not _NEARER.search(asked.words):
        return None
    if (offer := ENDS.offered(asked.words)) and (rest := rest_of(asked, offer.rest)):
        told = _band_ends(offer.said["low"], offer.said["high"], rest)
        if told:
            return told
    for joint in _OR.finditer(asked.words):
        before, after = asked.words[: joint.start()].split(), asked.words[joint.end() :].split()
        for first in range(max(0, len(before) - _MOST_WORDS), len(before)):
            one = " ".join(before[first:])
            if (near := asked.term(_HEAD.sub("", one))) is None:
                continue
            for last in range(min(len(after), _MOST_WORDS), 0, -1):
                two = " ".join(after[:last])
                if (far := asked.term(two)) is None:
                    continue
                others = f"{' '.join(before[:first])} {GAP} {' '.join(after[last:])}"
                rest = rest_of(asked, others)
                told = _nearer(asked, (one, near), (two, far), rest) if rest else None
                if told:
                    return told
    return None


def _nearer(
    asked: AskedWords, one: tuple[str, Term], two: tuple[str, Term], rest: RestOfQuestion
) -> str | None:
    if not rest.has_only("near", "force", "depth", "larger", "place") or len(rest.terms) > 1:
        return None
    (first, near), (second, far) = one, two
    beside = far if far.has_quantity or far.unit else near
    subject = rest.terms[0] if rest.terms else None
    if subject and subject.words == "press" and beside.dimension == "length":
        subject = None  # 'is the press closer to 0.2 or to 1 mm' asks for its depth
    if subject is None and beside.dimension in ("force", "length", "fraction"):
        subject = usual(beside.dimension)
    pairs = [alike(subject, each) if subject else None for each in (near, far)]
    if pairs[0] is None or pairs[1] is None:
        return None
    away = [f"abs({a.expression} - {b.factor})" for a, b in filter(None, pairs)]
    words = [asked.said(_HEAD.sub("", each)) for each in (first, second)]
    return choice_of((words[0], f"{away[0]} < {away[1]}"), (words[1], ""))


def _band_ends(low: str, high: str, rest: RestOfQuestion) -> str | None:
    if "band" not in rest.cues or any(term.expression != "force_n" for term in rest.terms):
        return None
    if not rest.has_only("band", "near", "end", "force", "larger", "place"):
        return None
    away = [f"abs(force_n - {end})" for end in _BAND_ENDS]
    return choice_of((low, f"{away[0]} < {away[1]}"), (high, ""))


def range_half(asked: AskedWords, low: str, high: str, rest: RestOfQuestion) -> str | None:
    """Which half of the band, or of a range between two terms, a term lies in."""
    if not {"half", "end", "place"} & rest.cues:
        return None
    if not rest.has_only("half", "end", "place", "band", "force", "depth"):
        return None
    felt = [term for term in rest.terms if term.expression in ("force_n", "depth_mm")]
    ends = [term for term in rest.terms if term not in felt]
    if "band" in rest.cues:
        if ends or any(term.expression != "force_n" for term in felt):
            return None
        return choice_of((low, "force_n < (band_low_n + band_high_n) / 2"), (high, ""))
    if len(ends) != 2 or len(felt) > 1:
        return None
    pair = alike(*ends)
    if pair is None or pair[0].dimension not in ("force", "length", "fraction"):
        return None
    subject = felt[0] if felt else usual(pair[0].dimension)
    if subject.dimension != pair[0].dimension:
        return None
    a, b = (term.expression for term in pair)
    middle = f"{b} / 2" if a == "0" else f"({a} + {b}) / 2"
    return choice_of((low, f"{subject.expression} < {middle}"), (high, ""))
