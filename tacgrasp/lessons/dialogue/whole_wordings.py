"""Wordings that were written whole, with their queries: what people say that no pattern composes.

``whole_wordings.tsv`` has a query, a tab and a wording in each line:

    check force over	Have we gone past the limit?
    check shape ring	Could it be a ring?

A word of a class that stands in both stands for every word of its dimension.

Not here: wordings that patterns compose (``tacgrasp.lessons.dialogue.families``).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.meaning import Meaning
from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.dialogue.query import asked_text, read_query

_PLAIN: Mapping[str, Mapping[str, str]] = {
    name: {" ".join(plain_words(word)): word for word in words} for name, words in CLASSES.items()
}
"""Words of each dimension as classes name them, by their plain words."""

_SAID = {
    name: re.compile(rf"\b({'|'.join(sorted(words, key=len, reverse=True))})\b")
    for name, words in _PLAIN.items()
}
_ASKED = re.compile(r"(check (?:not )?(\w+) (?:[<>]=? )?)([a-z][a-z -]*)")
_A, _AN = (re.compile(rf"\b{article} (?=\{{)") for article in ("a", "an"))


@dataclass(frozen=True, slots=True)
class WholeWording:
    """A wording with its query.

    Attributes:
        query: The query, with '{}' for a word of ``dimension``.
        words: The wording in plain words ('#' for a number), with '{}' there too.
        dimension: Dimension whose words may stand there; '' for none.
    """

    query: str
    words: str
    dimension: str = ""

    def variants(self) -> Iterator[tuple[str, str]]:
        """Its wordings in plain words, each with its query."""
        if not self.dimension:
            yield self.words, self.query
        for plain, word in _PLAIN.get(self.dimension, {}).items():
            said = _A.sub("an " if plain[0] in "aeiou" else "a ", self.words)
            yield said.format(plain), self.query.format(word)

    def drawn(self, rng: np.random.Generator) -> tuple[str, str]:
        """One of its wordings, with its query."""
        variants = list(self.variants())
        return variants[int(rng.integers(len(variants)))]


@lru_cache(maxsize=1)
def whole_wordings() -> tuple[WholeWording, ...]:
    """All of them, in the order of the file."""
    file = resources.files("tacgrasp.lessons.dialogue") / "whole_wordings.tsv"
    lines = file.read_text(encoding="utf-8").splitlines()
    return tuple(_wording(*line.split("\t")) for line in lines if line)


def drawn_whole(rng: np.random.Generator) -> tuple[str, str]:
    """One of them in plain words, with its query: rare queries oftener than there are wordings."""
    wordings = whole_wordings()
    return wordings[int(rng.choice(len(wordings), p=_chances()))].drawn(rng)


def understand_whole(text: str) -> Meaning | None:
    """The meaning of a question that is one of these wordings; None where it is none."""
    words, numbers = asked_text(text)
    known = _queries()
    if query := known.get(("", words)):
        return read_query(query, numbers)
    for name, said in _SAID.items():
        if len(found := said.findall(words)) == 1:
            query = known.get((name, _AN.sub("a ", said.sub("{}", words))))
            if query:
                return read_query(query.format(_PLAIN[name][found[0]]), numbers)
    return None


def _wording(query: str, text: str) -> WholeWording:
    query, words = f"{query}.", asked_text(text).words
    for part in query[:-1].split("; "):
        asked = _ASKED.fullmatch(part)
        if asked and asked[3] in CLASSES.get(asked[2], ()):
            said = _SAID[asked[2]]
            plain = " ".join(plain_words(asked[3]))
            if said.findall(words) == [plain] and query.count(part) == 1:
                query = query.replace(part, f"{asked[1]}{{}}")
                return WholeWording(query, _AN.sub("a ", said.sub("{}", words)), asked[2])
    return WholeWording(query, words)


@lru_cache(maxsize=1)
def _chances() -> NDArray[np.float64]:
    """Chance of each wording, shape (N,): a query's goes with the root of its wordings' number."""
    queries = [each.query for each in whole_wordings()]
    counts = Counter(queries)
    weights = np.array([counts[query] ** -0.5 for query in queries])
    return weights / weights.sum()


@lru_cache(maxsize=1)
def _queries() -> Mapping[tuple[str, str], str]:
    """Queries by dimension and words."""
    return {(each.dimension, each.words): each.query for each in whole_wordings()}
