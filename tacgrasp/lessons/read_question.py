"""A question as it was read: its query, its meaning, and how sure that is."""

from __future__ import annotations

from typing import NamedTuple

from tacgrasp.lessons.dialogue.meaning import Meaning


class ReadQuestion(NamedTuple):
    """What a question means.

    Attributes:
        query: It as a query.
        meaning: The query's meaning.
        confidence: Probability that it is the right query; 1 by the grammar.
    """

    query: str
    meaning: Meaning
    confidence: float
