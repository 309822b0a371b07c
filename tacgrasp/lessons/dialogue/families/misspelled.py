"""Words of no wording that are one slip of the keyboard from one that matters: 'dpeth' is 'depth'.

Slips that are frequent, or larger, stand in a list (``tacgrasp.lessons.dialogue.plain_words``).
Words of comparison are known by their place too, before 'than' or a number: 'deaper then 0.2 mm' is
'deeper than 0.2 mm'.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import pairwise
from string import ascii_lowercase

from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.patterns.family import word_lists
from tacgrasp.lessons.dialogue.patterns.phrases import SHARED
from tacgrasp.lessons.dialogue.plain_words import (
    CONTRACTIONS,
    MISSPELLINGS,
    NUMBER,
    plain_words,
)
from tacgrasp.lessons.dialogue.whole_wordings import whole_wordings

LEAST_LETTERS = 4
"""Shorter words are one slip from too many."""

LEAST_WORDINGS = 15
"""Whole wordings that a word stands in to be one that matters. Our choice: 'depth', 'limit',
'touching', 'slip', but no 'berth' or 'lima'."""

CLEARER = 4
"""How many times as frequent the meant word is as any other one a slip away. Our choice."""

_WORD = re.compile(r"[a-z]+(?![a-z']*')")
_MORE_THAN = (
    "deeper", "shallower", "heavier", "lighter", "stronger", "weaker", "higher", "lower", "larger",
    "smaller", "bigger", "greater", "firmer", "softer", "harder", "gentler", "tighter", "looser",
    "fewer", "closer", "nearer", "farther", "further", "wider", "thicker", "more", "less",
)  # fmt: skip
_BEYOND = (
    "above", "below", "under", "over", "beneath", "beyond", "within", "between", "inside",
    "outside", "exceed", "exceeds", "exceeding", "exceeded",
)  # fmt: skip
_COUNTED = r"(?:\d|[.]\d|an?\b|half\b|one\b|two\b|three\b|four\b|five\b|ten\b)"
_SPELLED = (
    (_MORE_THAN, re.compile(r"[a-z]{3,}(?= (?:than|then)\b)", re.I)),
    (_BEYOND, re.compile(r"[a-z]{3,}(?= [.]?\d)", re.I)),
)
_IS_MORE_THEN = re.compile(
    rf"\b(?P<more>{'|'.join(_MORE_THAN)}) then"
    rf"(?: (?={_COUNTED})|(?P<the> )(?=(?:the|our|its|my|this|that)\b))",
    re.I,
)
_SUPPOSES = re.compile(r"\b(?:if|when|once|suppose|were|after|imagine|say)\b", re.I)


def respelled(question: str) -> str:
    """A question with such words set right; the question itself where it has none."""
    lowered = question.lower()
    fixed = _WORD.sub(lambda match: _meant(match[0]), lowered)
    return question if fixed == lowered else fixed


def compared_aright(question: str) -> str:
    """A question whose words of comparison are spelled as they are meant, by where they stand.

    Args:
        question: The question, which keeps everything else.
    """
    for known, place in _SPELLED:
        question = place.sub(lambda word: _compared(word[0], known), question)  # noqa: B023
    return _IS_MORE_THEN.sub(
        lambda found: (
            found[0] if found["the"] and _SUPPOSES.search(question) else f"{found['more']} than "
        ),
        question,
    )


def compares_unread(question: str) -> bool:
    """Whether a question has 'than', or before a number a word that nothing knows."""
    words = plain_words(question)
    return "than" in words or any(
        number == NUMBER and word != NUMBER and word not in _known()
        for word, number in pairwise(words)
    )


def _compared(word: str, known: tuple[str, ...]) -> str:
    """The word of comparison that another one stands for; the word itself where it is none.

    Vowels and doubled letters are what most people mistake, and hardly anybody the first letter;
    whatever else is one slip away must be no word.
    """
    lowered = word.lower()
    if lowered in (*_MORE_THAN, *_BEYOND):
        return word
    alike = [each for each in known if each[0] == lowered[0]]
    near = [each for each in alike if _bones(each) == _bones(lowered)]
    if not near and lowered not in _known():
        near = [each for each in alike if _are_a_slip_apart(each, lowered)]
    return near[0] if len(near) == 1 else word


def _bones(word: str) -> str:
    """The first letter of a word and its other consonants, none of them twice in a row."""
    return re.sub("(?<!^)[aeiou]", "", re.sub(r"(.)\1+", r"\1", word))


def _are_a_slip_apart(one: str, other: str) -> bool:
    """Whether one letter is more, less or another one, or two neighbours are exchanged."""
    while one and other and one[0] == other[0]:
        one, other = one[1:], other[1:]
    while one and other and one[-1] == other[-1]:
        one, other = one[:-1], other[:-1]
    return max(len(one), len(other)) < 2 or (len(one) == 2 and one == other[::-1])


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
