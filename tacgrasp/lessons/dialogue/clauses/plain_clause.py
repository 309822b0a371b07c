"""A clause in plain words with numbered numbers: 'half of your pad' is '#1 percent of your pad'.

Not here: what it means (``tacgrasp.lessons.dialogue.clauses.conditions``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.plainer import metric
from tacgrasp.lessons.dialogue.query import asked_text

_SHARES = {
    "two thirds": 66.6667, "three quarters": 75.0, "a third": 33.3333, "one third": 33.3333,
    "a quarter": 25.0, "one quarter": 25.0, "a fifth": 20.0, "one fifth": 20.0, "a tenth": 10.0,
    "one tenth": 10.0, "a half": 50.0, "one half": 50.0, "half": 50.0, "quarter": 25.0,
    "third": 33.3333, "the majority": 50.0,
}  # fmt: skip
_FACES = (
    r"(?:pad|gel|sens[eo]r|surface|fingertip|skin|sensing area|face|membrane|rubber|area|thing)"
)
_SHARE = re.compile(
    r"(?<!left )(?<!right )(?<!upper )(?<!lower )(?<!top )(?<!bottom )(?<!palm )(?<!tip "
    rf")(?<!other )\b(?P<share>{'|'.join(_SHARES)})(?:(?= (?:covered|touched|free|bare|"
    r"untouched|uncovered)\b)|(?: of)? (?=(?:the |this |our |its |my |your |that )"
    rf"(?:\w+ ){{0,2}}{_FACES}\b))",
    re.I,
)
_POSSESSIVE = re.compile(r"(?<=[a-z])['’]s\b(?<!it's)(?<!that's)(?<!there's)", re.I)
_FULL = re.compile(
    r"\b(?:an?|one) (?:full|whole|single|entire|good|mere) (?=square|milli|micro|centi|newton|gram|"
    r"kilo|mm|cm)",
    re.I,
)
_AT_ONCE = re.compile(r"\bright (?=(?:now|here|there|at)\b)", re.I)
_THEN = re.compile(
    r"\b(?P<more>more|less|deeper|greater|higher|lower|bigger|smaller|fewer|larger|"
    r"heavier) then (?=an?\b|\d|half|one|two|the)",
    re.I,
)
_QUATER = re.compile(r"\bquater(?=s?\b)", re.I)
_DOSE = re.compile(r"^dose (?=(?:it|the|this|that|we)\b)", re.I)
_HALF = re.compile(
    r"\b(?P<side>left|right|upper|lower|top|bottom|palm|tip|fingertip)(?:[- ]hand)? half\b", re.I
)
_SQUARE = re.compile(r"\b(?:an?|one) (?=square (?:milli|centi))", re.I)
_SQUARE_CM = re.compile(r"#(\d+) (?:cm2|square (?:cm|centimet(?:re|er)s?))")


def numbered(text: str) -> tuple[str, tuple[float, ...]]:
    """A clause in plain words, '#1' for its first number, and the numbers."""
    text = _THEN.sub(r"\g<more> than ", _QUATER.sub("quarter", _DOSE.sub("does ", text)))
    text = _HALF.sub(r"\g<side> side", text)
    text = _SHARE.sub(lambda match: f"{_SHARES[match['share'].lower()]:g} percent of ", text)
    text = _SQUARE.sub("1 ", _FULL.sub("1 ", _POSSESSIVE.sub("", _AT_ONCE.sub("", text))))
    asked = asked_text(metric(" ".join(text.split())))
    places = iter(range(1, len(asked.numbers) + 1))
    words = re.sub("#", lambda _: f"#{next(places, 0)}", asked.words)
    return words, asked.numbers
