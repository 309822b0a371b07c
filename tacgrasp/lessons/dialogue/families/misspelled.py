"""Words of no wording that are one slip of the keyboard from one that matters: 'dpeth' is 'depth'.

Slips that are frequent, or larger, stand in a list (``tacgrasp.lessons.dialogue.plain_words``).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from functools import lru_cache
from string import ascii_lowercase

from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.patterns.family import word_lists
from tacgrasp.lessons.dialogue.patterns.phrases import SHARED
from tacgrasp.lessons.dialogue.plain_words import CONTRACTIONS, MISSPELLINGS
from tacgrasp.lessons.dialogue.whole_wordings import whole_wordings

LEAST_LETTERS = 4
"""Shorter words are one slip from too many."""

LEAST_WORDINGS = 15
"""Whole wordings that a word stands in to be one that matters. Our choice: 'depth', 'limit',
'touching', 'slip', but no 'berth' or 'lima'."""

CLEARER = 4
"""How many times as frequent the meant word is as any other one a slip away. Our choice."""

_WORD = re.compile(r"[a-z]+(?![a-z']*')")


def respelled(question: str) -> str:
    """A question with such words set right; the question itself where it has none."""
    lowered = question.lower()
    fixed = _WORD.sub(lambda match: _meant(match[0]), lowered)
    return question if fixed == lowered else fixed


@lru_cache(maxsize=4096)
def _meant(word: str) -> str:
    if len(word) < LEAST_LETTERS or word in _known() or word.removesuffix("s") in _known():
        return word
    counts = _frequent()
    near = sorted((counts[each], each) for each in set(_a_slip_away(word)) if each in counts)
    if not near or (len(near) > 1 and near[-1][0] < CLEARER * near[-2][0]):
        return word
    return near[-1][1]


def _a_slip_away(word: str) -> Iterator[str]:
    """Words with one more letter behind the first, or two neighbours exchanged.

    Another letter in place of one, or one less, makes real words of others: 'grid' is no 'grip'.
    """
    for place in range(1, len(word) + 1):
        head, tail = word[:place], word[place:]
        yield from (f"{head}{letter}{tail}" for letter in ascii_lowercase)
        yield f"{head[:-1]}{tail[:1]}{head[-1]}{tail[1:]}"


@lru_cache(maxsize=1)
def _counts() -> Counter[str]:
    """In how many whole wordings each word stands."""
    return Counter(word for each in whole_wordings() for word in set(each.words.split()))


@lru_cache(maxsize=1)
def _frequent() -> dict[str, int]:
    return {
        word: count
        for word, count in _counts().items()
        if count >= LEAST_WORDINGS and len(word) >= LEAST_LETTERS
    }


@lru_cache(maxsize=1)
def _known() -> frozenset[str]:
    """Words of any wording, of the word lists, and those that plain words set right."""
    listed = (word for words in word_lists().values() for each in words for word in each.split())
    patterns = [
        text
        for family in FAMILIES
        for text in (family.pattern, *(_texts(slot) for slot in family.slots.values()))
    ]
    shared = (_texts(slot) for slot in SHARED.values())
    literal = re.findall(r"[a-z]+", " ".join((*patterns, *shared)))
    return frozenset((*_counts(), *listed, *literal, *CONTRACTIONS, *MISSPELLINGS))


def _texts(slot: str | Mapping[str, str]) -> str:
    return slot if isinstance(slot, str) else " ".join(slot.values())
