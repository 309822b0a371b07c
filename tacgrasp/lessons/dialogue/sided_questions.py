"""Questions about one side: 'how far left' counts to the left, where x counts to the right.

    How far left is it?                 amount x mm.          becomes amount leftward mm.
    Is it more than 2 mm left of it?    check x > #1 mm.      becomes check x < -#1 mm.
    How far down is it?                 amount y mm.          becomes amount tipward mm.
    How far left, minus for the right?  amount x mm.          becomes amount leftward mm.

Readers take such a question for one about the coordinate. What names both sides, or a sign, is one,
unless the sign is that of the side.
"""

from __future__ import annotations

import re
from typing import NamedTuple


class _Side(NamedTuple):
    """A side whose coordinate is negative: its coordinate, its amount, its words, the other's."""

    coordinate: str
    amount: str
    named: re.Pattern[str]
    other: re.Pattern[str]


_MIDDLE = r"(?:the |our |its )?(?:\w+ )?(?:middle|cent(?:re|er)|midpoint|origin)"
_SIDES = (
    _Side("x", "leftward", re.compile(r"\bleft(?:wards?)?\b"), re.compile(r"\bright(?:wards?)?\b")),
    _Side(
        "y",
        "tipward",
        re.compile(
            rf"\b(?:down|downwards?|fingertip|tip|tipwards?|(?:below|under|beneath) {_MIDDLE})\b"
        ),
        re.compile(rf"\b(?:up|upwards?|palm|palmwards?|(?:above|over) {_MIDDLE})\b"),
    ),
)
_SIGN = re.compile(r"\b(?:minus|negative|plus|positive|sign|signed)\b")
_SIGN_OF_SIDE = (
    re.compile(
        r"\b(?P<sign>minus|negative|plus|positive) "
        r"(?:(?:for|if|when|to|towards?|means|meaning|is|being|the|it|its) )+"
        r"(?P<side>[a-z]+)"
    ),
    re.compile(
        r"\b(?P<side>[a-z]+) (?:(?:counted|counts|counting|taken|being|is|as) )+"
        r"(?P<sign>minus|negative|plus|positive)"
    ),
)
_TURNED = {">": "<", "<": ">", ">=": "<=", "<=": ">="}


def to_named_side(query: str, words: str) -> str:
    """A query about a coordinate, counted to the side that the question names.

    Args:
        query: The query (``tacgrasp.lessons.dialogue.query``).
        words: The question in plain words.
    """
    if _SIGN.search(words):
        for side in _SIDES:
            if _is_counted_to(side, words):
                query = re.sub(rf"\bamount {side.coordinate}\b", f"amount {side.amount}", query)
        return query
    for side in _SIDES:
        if side.named.search(words) and not side.other.search(words):
            query = re.sub(rf"\bamount {side.coordinate}\b", f"amount {side.amount}", query)
            query = re.sub(
                rf"\bcheck (not )?{side.coordinate} (>=|<=|>|<) #",
                lambda match, name=side.coordinate: (  # type: ignore[misc]
                    f"check {match[1] or ''}{name} {_TURNED[match[2]]} -#"
                ),
                query,
            )
    return query


def _is_counted_to(side: _Side, words: str) -> bool:
    """Whether words give a side the plus, or the other one the minus."""
    for pattern in _SIGN_OF_SIDE:
        if told := pattern.search(words):
            of = side.named if told["sign"] in ("plus", "positive") else side.other
            return of.fullmatch(told["side"]) is not None
    return False
