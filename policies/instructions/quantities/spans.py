"""Where a text names forces: ranges and single ones, and what they come to in newtons.

Not here: what the words beside them make of them (``relations``, ``forces``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from policies.instructions.english import words
from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.force_units import ALONE, LOOSE, NUMBER, UNIT, in_newtons
from policies.instructions.quantities.tolerances import TOLERANCE, band_of

_SIGNED = rf"(?:(?<![\w.])(?:-(?=[\d.])|(?:minus|negative) ))?(?:{NUMBER}|infinite|infinity|unlimited|inf|nan)"
_LINK = r"\s*(?:-|–|—|\.\.\.?|…|,|\bup to\b|\bto\b|\bthrough\b|\b(?:un)?till?\b|\band\b)\s*"

_RANGE = NumberPattern(
    rf"(?P<pre>\b(?:betw\w*|from|within|inside|range(?: of)?|window(?: of)?|in)\s*\[?\s*|\[\s*)?"
    rf"(?P<a>{NUMBER})\s*(?P<ua>(?:{UNIT}|{LOOSE})\b)?(?P<link>{_LINK})"
    rf"(?P<b>{NUMBER.removeprefix(ALONE)})\s*\]?\s*-?(?P<ub>(?:{UNIT}|{LOOSE})\b)"
)
_FORCE = re.compile(
    rf"\(?(?P<a>{_SIGNED})(?:\s*±\s*(?P<ti>{NUMBER.removeprefix(ALONE)})\s*(?P<tip>%)?\s*)?\)?\s*-?\s*(?P<ua>(?:{UNIT}|{LOOSE})\b){TOLERANCE}"
)

_FORCE_WORD = re.compile(
    r"(?:\b(?:with|apply|applying|use|using|at|to|about|around|roughly|exactly|than|most|least|under|over|above|"
    r"below|exceed\w*|max\w*\.?|min\w*\.?|limit\w*|force|of|between|from|set|just|only|approximately|nearly|by)|"
    r"[:=<>≤≥~])(?: (?:a|an|the|about|around|roughly|exactly|just|only|some))?\s*$"
)
_CORRECTED = re.compile(
    rf"\W*(?:(?:no|sorry|wait|actually|make (?:that|it)|{words.any_of('correction')})\W+)+"
)
"""Between a force and a mass: '100 g, no, 150 g'."""
_DESCRIBED = re.compile(
    r"\b(?:it|this|that|(?:straw)?berry|fruit|egg|tomato|one|object|thing|peg)(?:'s| is| looks| seems| feels| was)\b[^.;#\d]*\b(?:about|around|roughly|approximately|nearly|some|maybe|perhaps)\s*$"
)
"""Before a mass: 'the berry is big, about 40 g'."""
_OF_FORCE = re.compile(r"\b(?:force|grip|press|squeez|push|hold|held|limit|max|most|target)\w*\b")
_MASS_WORD = re.compile(r"\b(?:weigh\w*|mass|heavy|scale|berry of|fruit of)\b[^.;]*$")
_BOUNDED = re.compile(
    r"\s*,?\s*(?:(?:and )?(?:no|not) (?:more|less|over|above|under|below|higher|a gram more)|at (?:the )?(?:very |absolute )?(?:most|least)|max\w*|min\w*|tops?|or (?:less|more|under|over))\b(?! weight)"
)
"""Behind a mass that stands alone: it bounds a force."""
_THING = re.compile(
    r"\s*,? an? (?!force|grip|squeeze|press|push|limit|most|little|bit|tad|touch|gram)\w+|"
    r"\s*-?\s*(?:heavy )?(?:\w+ )?(?:berry|berries|strawberry|fruit|one|piece|object|thing|specimen|heavy|in weight)\b"
)


def force_spans(text: str) -> Iterator[tuple[int, int, list[float], tuple[float, float] | None]]:
    """Begin, end, forces and tolerance [N] of every range and single force, in order."""
    at = end = 0  # end: that of the last force
    while at < len(text):
        span = _RANGE.search(text, at)
        one = _FORCE.search(text, at)
        if span and (not one or span.start() <= one.start()) and _is_range(span, text):
            unit = span["ub"]
            first = span["ua"] or unit
            yield (
                span.start(),
                span.end(),
                [in_newtons(span["a"], first), in_newtons(span["b"], unit)],
                None,
            )
            at = end = span.end()
        elif one:
            if _is_force(one, text) or (end and _CORRECTED.fullmatch(text[end : one.start()])):
                yield one.start(), one.end(), [in_newtons(one["a"], one["ua"])], band_of(one)
                end = one.end()
            at = one.end()
        else:
            return


def _is_range(match: re.Match[str], text: str) -> bool:
    link = match["link"].strip()
    if link in ("and", ","):
        before = match["pre"] or ""
        return "[" in before or (link == "and" and bool(before))
    is_set_off = link in "-–—" and match["link"] != link and not match["pre"]
    first, second = match["ua"] or match["ub"], match["ub"]
    if is_set_off and in_newtons(match["a"], first) > in_newtons(match["b"], second):
        return False  # 'this is berry 7 - 0.8 N'
    if not _is_loose(match["ub"]):
        return True
    return bool(_FORCE_WORD.search(text[: match.start()]) or match["pre"])


def _is_force(match: re.Match[str], text: str) -> bool:
    if not _is_loose(match["ua"]):
        return True
    left, right = text[: match.start()], text[match.end() :]
    if not left and re.fullmatch(r"(?:,? please)?[ .!]*", right):
        return True  # nothing else is said
    if (not left.strip() or left.rstrip().endswith(",")) and _BOUNDED.match(right):
        return True
    if re.search(r"\b(?:force|press\w*|squeez\w*|push\w*)\b.*\bweight of\s*$", left):
        return True
    if _DESCRIBED.search(left) and not _OF_FORCE.search(re.split(r"[.;!?]\s", left)[-1]):
        return False
    return (
        bool(_FORCE_WORD.search(left)) and not _MASS_WORD.search(left) and not _THING.match(right)
    )


def _is_loose(unit: str) -> bool:
    return not re.fullmatch(UNIT, unit)
