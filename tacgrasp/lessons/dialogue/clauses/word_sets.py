"""Sets of words, written as texts."""

from __future__ import annotations


def words_of(*texts: str) -> frozenset[str]:
    """The words of texts."""
    return frozenset(word for text in texts for word in text.split())
