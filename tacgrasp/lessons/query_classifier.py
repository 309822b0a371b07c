"""Queries as classes: what a question probably means, by a classifier that reads all its words.

It has learned the wordings of the grammar, as the language model has, but knows words by their
letters and reads a question as a whole. Where both read a wording that neither has learned, they
mistake different ones. A query of several parts is one class: which they are, the model says.

Not here: how it is trained (``tacgrasp.training.query_classifier``), and how both readings become
one (``tacgrasp.lessons.understanding``).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from cltp.checkpoints.stored_classifier import load_classifier
from cltp.texts.text_classifier import TextClassifier

SEVERAL = "several"
"""Class of the queries of several parts."""

SHIPPED = Path(__file__).with_name("models") / "queries"


def class_of(query: str) -> str:
    """The class of a query."""
    return SEVERAL if ";" in query else query


@lru_cache(maxsize=1)
def shipped_classifier() -> TextClassifier:
    """The classifier that comes along.

    Raises:
        WeightsError: It is missing or damaged.
    """
    return load_classifier(SHIPPED)


class QueryOdds:
    """Log-probabilities of queries for one question.

    Args:
        words: The question in plain words (``tacgrasp.lessons.dialogue.query.asked_text``).
    """

    def __init__(self, words: str) -> None:
        model = shipped_classifier()
        logs = model.log_probabilities(words.split()).tolist()
        self._logs = dict(zip(model.config.classes, logs, strict=True))

    def likeliest(self) -> Iterator[str]:
        """Queries of one part, the likeliest first."""
        ordered = sorted(self._logs, key=self._logs.__getitem__, reverse=True)
        return (name for name in ordered if name != SEVERAL)

    def of(self, query: str) -> float:
        """Log-probability of a query's class; minus infinity where no class is its."""
        return self._logs.get(class_of(query), float("-inf"))
