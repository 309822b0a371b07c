"""Questions that name alternatives, spelled so that these are found.

Not here: the alternatives (``tacgrasp.lessons.dialogue.choices.scales``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.choices.scales import ALL

_ABOUT = re.compile(r"\bmore or less(?= (?:#\d|the same|equal|exact|at|in the|right|on))")
_ONE_WAY = re.compile(
    r"\bor (?:not|nah|nope|no|else|what|otherwise|so)\b(?! (?:touch|contact|"
    r"object|more|less))"
)

_SLASH = re.compile(r"\b([a-z]{2,}) ?/ ?([a-z]{2,})\b", re.I)
_SPELLED = (
    (re.compile(r"\bbetween (zero|nothing|\d[\w.]*(?: \w+)?) and\b", re.I), r"from \1 to"),
    (
        re.compile(
            r"(?<![\w.])(\d+(?:\.\d+)?)(?= or (?:to )?\d+(?:\.\d+)? ?(mm|cm|[µu]m|n|g|"
            r"newtons?|grams?|microns?|%)(?![\w/]))",
            re.I,
        ),
        r"\1 \2",
    ),
    (re.compile(r"\b(way|side|half|end|it|that|what|which|she|he)['’]s\b", re.I), r"\1 is"),
    (re.compile(r"\b(it|that|this|they|he|she)['’]d\b", re.I), r"\1 would"),
    (re.compile(r"(?<=[\w,]) as (?=[a-z]+,? or as |neither\b)", re.I), " "),
    (
        re.compile(
            r"\b(left|right|upper|lower|top|bottom|palm|fingertip|which|either|low|high)"
            r"(?: hand)? half\b(?= of\b)",
            re.I,
        ),
        r"\1 side",
    ),
)


def is_one_way(words: str) -> bool:
    """Whether plain words only look like a choice: 'is it deep or not', 'more or less 2 N'."""
    return bool(_ONE_WAY.search(words) or _ABOUT.search(words))


def spelled(question: str) -> str:
    """A question with contracted verbs and slashes written out, and halves that are no number."""
    question = re.sub(r"(?<=[a-z]) / (?=[a-z])", " or ", question)
    for pattern, words in _SPELLED:
        question = pattern.sub(words, question)
    return _SLASH.sub(_or_of, question)


def _or_of(match: re.Match[str]) -> str:
    """'floor/ceiling' as 'floor or ceiling'; a quotient of others as it is."""
    words = f"{match[1]} or {match[2]}"
    return words if any(scale.offered(words.lower()) for scale in ALL) else match[0]
