"""The meaning of a question by its clauses: a verdict, a threshold, a list, or nothing felt.

Not here: each of them (``verdicts``, ``thresholds``, ``lists``, ``unfelt``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.clauses.items import item_of
from tacgrasp.lessons.dialogue.clauses.lists import Reader, listed
from tacgrasp.lessons.dialogue.clauses.thresholds import kept, range_kept
from tacgrasp.lessons.dialogue.clauses.unfelt import unfelt_query
from tacgrasp.lessons.dialogue.clauses.verdicts import calls_wrong, judged
from tacgrasp.lessons.dialogue.meaning import Meaning, Part
from tacgrasp.lessons.dialogue.query import asked_text, read_query

_OPEN = re.compile(r"(?:how|what|which|where|whereabouts|give|tell|name|state|report|show)\b", re.I)

_SINGLE = ("force", "depth", "area", "distance", "holds", "position", "shape", "texture")
"""What a question may ask for alone; the grammar knows the others better."""

_AS_ONE = re.compile(
    r"\b(?:both|all)(?: (?:of )?(?:these|them|three|four|those|the following|conditions|boxes|this|"
    r"that))?\b.*"
    r"\b(?:true|right|hold|met|so|correct|ok|okay|satisfied|the case|fulfilled|apply)\b|"
    r"\b(?:confirm|check|verify) (?:that )?(?:all|both)\b",
    re.I,
)


def judged_as_one(question: str) -> Meaning | None:
    """The one verdict on what a question wants to hold all at once, or calls wrong; else None."""
    return judged(question) if _AS_ONE.search(question) or calls_wrong(question) else None


_NOT_SO = re.compile(
    r"(?:n't|n’t|\bnot|\bnever)\b[^?]*[,;] *"
    r"(?:right|correct|true|yes|agreed|is that (?:so|right))[?. ]*$",
    re.I,
)
"""'It hasn't sunk in by 1 mm, right?' asks whether it has not."""

_MORE_BESIDE = re.compile(
    r"\bor (?:more|less|fewer) (?:below|above|under|over|from|short|than)\b", re.I
)
_TO_THE_LIMIT = re.compile(
    r"\b(?:to|till|until|before) (?:the |its |our )?(?:limit|ceiling|cap)\b", re.I
)
"""What is left to the limit is not the limit."""


def clauses_of(question: str, read: Reader) -> Meaning | None:
    """What a question means by its clauses; None where one of them has no meaning here.

    Args:
        question: The question.
        read: Reads one clause of a list in another way.
    """
    if any(each.search(question) for each in (_NOT_SO, _MORE_BESIDE, _TO_THE_LIMIT)):
        return None
    if (
        meaning := range_kept(question)
        or judged(question)
        or kept(question)
        or listed(question, read)
    ):
        return meaning
    if _OPEN.match(question) and _is_single(item := item_of(question)):
        return item
    return None


def unfelt(question: str) -> Meaning | None:
    """What a question asks that touch can't know, or that has nothing to do with it; else None."""
    query = unfelt_query(asked_text(question).words)
    return read_query(query) if query else None


def _is_single(item: Part | None) -> bool:
    name = getattr(item, "quantity", None) or getattr(item, "name", None)
    return name in _SINGLE
