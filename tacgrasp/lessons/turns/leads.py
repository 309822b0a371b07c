"""A follow-up without the words that tie it to the line before: 'and', 'so', 'ok, then'."""

from __future__ import annotations

import re

_FIRST = re.compile(
    r"\A(?:(?:(?:and|n|but|or|so|ok|okay|then|now)(?:[,.:;!]+ *| +-+ +| +)|"
    r"(?:well|no|yes|hm+|ah|oh|right|cool|nice|good|great|fine|thanks|thank you|sorry|fair enough|"
    r"alright|all right|got it|i see|interesting|just|also|next|still|actually|wait|hang on|"
    r"hold on|back to (?:the \w+|mine|it))(?:[,.:;!]+ *| +-+ +))(?=\S))+",
    re.I,
)
"""'No contact?' keeps its 'no', 'No, the depth' does not."""

_LAST = re.compile(
    r"(?:, (?:right|correct|yes or no|sorry|over or under|above or below)|"
    r"[, ]+(?:then|instead|please|pls|too|as well|now|also|at least|again|exactly|precisely|"
    r"right now|at the moment|though|by the way|in total|altogether))+(?=[?.! ]*$)",
    re.I,
)

_VERDICT = re.compile(r"\bor\b.*, yes or no[?.! ]*$", re.I)
"""'Is it an edge or a corner, yes or no?' is no choice."""

LEAD = (
    r"(?:(?:and|n|but|or|so|ok|okay|well|then|now|no|sorry|what about|how about|i meant?|"
    r"make (?:it|that))[, ]+)*"
)
END = (
    r"(?:[, ]+(?:then|instead|please|pls|now|more|extra|too|as well|at least|sorry|next|first|"
    r"right))*[?.! ]*"
)


def without_lead(question: str) -> str:
    """A question without what leads into it, and without a last 'then' or 'please'."""
    text = question.strip()
    bare = _FIRST.sub("", text, count=1)
    if _VERDICT.search(bare) is None:
        bare = _LAST.sub("", bare)
    return bare or text


def capital(text: str) -> str:
    """A text that begins a sentence."""
    return f"{text[:1].upper()}{text[1:]}"


def uncapital(text: str) -> str:
    """A text that goes on in a sentence."""
    return text if text[:2] in ("I ", "I'") else f"{text[:1].lower()}{text[1:]}"
