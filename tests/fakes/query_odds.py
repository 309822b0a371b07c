"""A classifier of questions that names no query, for tests of what a scripted model writes."""

from collections.abc import Iterator


class NoOdds:
    """Names nothing, and finds all equally likely."""

    def __init__(self, words: str) -> None:
        self.words = words

    def likeliest(self) -> Iterator[str]:
        return iter(())

    def of(self, query: str) -> float:
        return 0.0
