"""Slips of people who type questions, put into plain words while a model learns them.

Words are left out, misspelled, run together or exchanged, and things get names that no list has. No
slip changes what is asked: numbers and 'not' stay where they are. In a few longer questions one
word is replaced by one that nobody knows, so that the meaning is also learned from the others.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np

from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.patterns.family import word_lists
from tacgrasp.lessons.dialogue.patterns.phrases import SHARED

DROPPED, MISSPELLED, JOINED, EXCHANGED, RENAMED = 0.2, 0.18, 0.03, 0.04, 0.12
"""Fractions of learned questions without some of ``FILLERS``, with misspelled words, with two
neighbours run together or exchanged, and with made-up names for things. Our choice."""

REPLACED = 0.08
"""Fraction of learned questions of at least ``LEAST_REPLACED`` words in which one is replaced by a
made-up word. Our choice: people use words that the grammar lacks."""

LEAST_REPLACED = 6

FILLERS = frozenset(
    [
        "a",
        "an",
        "the",
        "this",
        "that",
        "please",
        "now",
        "right",
        "it",
        "of",
        "on",
        "is",
        "are",
        "am",
        "was",
        "do",
        "does",
        "did",
        "you",
        "we",
        "i",
        "me",
        "can",
        "could",
        "would",
        "will",
        "be",
        "been",
        "there",
        "so",
        "just",
        "really",
        "tell",
        "to",
    ]
)
"""Words whose absence changes no question."""

FIXED = frozenset(("#", "not", "no", "never", "?"))
"""Words that stay, each behind the word that it follows."""

LEAST_MISSPELLED = 4
"""Letters of the longest word that is never misspelled: another word would come of it."""

_KEYS = ("qwertyuiop", "asdfghjkl", "zxcvbnm")
_NEIGHBOURS = {
    key: [row[at] for at in (place - 1, place + 1) if 0 <= at < len(row)]
    for row in _KEYS
    for place, key in enumerate(row)
}


def _listed(text: str) -> tuple[str, ...]:
    return tuple(text.split())


_ONSETS = _listed(
    "b bl br c ch cl d dr f fl g gl gr h j k kl l m n p pl qu r s sk sl sn st t tr v w z"
)
_RIMES = _listed(
    "ab ack ad ag am an ap ard ask at eck ed eg ell em en ep est et ick id ig ill im in ip isk it "
    "ob ock od og ol om on op orb ot ub uck ud ug um un up usk ut ail eam ine oat ude"
)
_ENDINGS = ("", "", "er", "le", "y", "o", "a", "ing", "ette", "ish", "on")

_Slip = Callable[[list[str], np.random.Generator], None]


def slipped(words: str, rng: np.random.Generator) -> str:
    """Plain words of a question, perhaps with slips.

    Args:
        words: Plain words (``tacgrasp.lessons.dialogue.plain_words``).
        rng: Draws.
    """
    kept = words.split()
    if rng.random() < DROPPED:
        kept = [word for word in kept if word not in FILLERS or rng.random() < 0.5] or kept
    for chance, slip in _SLIPS:
        if rng.random() < chance:
            slip(kept, rng)
    return " ".join(kept)


def _misspell(words: list[str], rng: np.random.Generator) -> None:
    """A slip of the fingers in one word; sometimes in a second one."""
    for _ in range(1 + int(rng.random() < 0.2)):
        place = int(rng.integers(len(words)))
        word = words[place]
        if len(word) <= LEAST_MISSPELLED or not word.isalpha():
            continue
        at = int(rng.integers(1, len(word) - 1))
        key = _NEIGHBOURS.get(word[at], [word[at]])
        slips = (
            word[:at] + word[at + 1 :],
            word[:at] + word[at] + word[at:],
            word[:at] + word[at + 1] + word[at] + word[at + 2 :],
            word[:at] + key[int(rng.integers(len(key)))] + word[at + 1 :],
            f"{word[:at]} {word[at:]}",
        )
        words[place : place + 1] = slips[int(rng.integers(len(slips)))].split()


def _join(words: list[str], rng: np.random.Generator) -> None:
    """Two neighbours run together: 'isit'."""
    at = int(rng.integers(max(1, len(words) - 1)))
    pair = words[at : at + 2]
    if not FIXED.intersection(words[max(0, at - 1) : at + 3]) and all(map(str.isalpha, pair)):
        words[at : at + 2] = ["".join(pair)]


def _exchange(words: list[str], rng: np.random.Generator) -> None:
    """Two neighbours exchanged, none of them beside a number or a 'not'."""
    at = int(rng.integers(max(1, len(words) - 1)))
    if not FIXED.intersection(words[max(0, at - 1) : at + 3]):
        words[at : at + 2] = reversed(words[at : at + 2])


def _rename(words: list[str], rng: np.random.Generator) -> None:
    """Things get made-up names."""
    names = thing_names()
    words[:] = [made_up(rng) if word in names else word for word in words]


def _replace(words: list[str], rng: np.random.Generator) -> None:
    """One word becomes one that nobody knows; units and what is ``FIXED`` stay."""
    at = int(rng.integers(len(words)))
    is_unit = at > 0 and words[at - 1] == "#"
    if len(words) >= LEAST_REPLACED and words[at] not in FIXED and not is_unit:
        words[at] = made_up(rng)


_SLIPS: Sequence[tuple[float, _Slip]] = (
    (REPLACED, _replace),
    (RENAMED, _rename),
    (EXCHANGED, _exchange),
    (MISSPELLED, _misspell),
    (JOINED, _join),
)


def made_up(rng: np.random.Generator) -> str:
    """A word that no list has, but for chance."""
    syllables = [_one(_ONSETS, rng) + _one(_RIMES, rng) for _ in range(int(rng.integers(1, 3)))]
    return "".join(syllables) + _one(_ENDINGS, rng)


def _one(entries: Sequence[str], rng: np.random.Generator) -> str:
    return entries[int(rng.random() * len(entries))]


@lru_cache(maxsize=1)
def thing_names() -> frozenset[str]:
    """Names of things that mean nothing else in any pattern: 'plum', but not 'ring'."""
    texts = [repr(SHARED)]
    for family in FAMILIES:
        texts += [family.pattern, repr(dict(family.slots))]
    used = set(re.findall(r"[a-z]+", re.sub(r"\{[^{}]*\}", " ", " ".join(texts).lower())))
    lists = word_lists()
    named = {entry for name in ("objects",) for entry in lists[name]}
    listed = {entry for name, entries in lists.items() if name in _MEANT for entry in entries}
    return frozenset(name for name in named - listed if name.isalpha() and name not in used)


_MEANT = ("touchless", "colours", "warmth", "tastes", "smells", "sounds", "materials", "nonsense")
"""Lists whose words are what is asked."""
