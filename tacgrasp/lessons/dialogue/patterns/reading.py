"""Reads a text by a pattern: whether the pattern produces it, and what it binds then.

A part of a pattern leads from a place between two words of the text to other places. Where it
leads to is computed once for each part and place, so that the parts that many patterns share are
read once; parts that can't begin with the word there are passed over.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

from tacgrasp.lessons.dialogue.patterns.pattern import (
    Bound,
    Chain,
    ListSlot,
    Literal,
    Node,
    NumberSlot,
    OneOf,
    literal_words,
)
from tacgrasp.lessons.dialogue.plain_words import NUMBER, PlainText

Places = tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Understood:
    """What a wording says.

    Attributes:
        bindings: Bound values by name.
        numbers: Values of its numbers by name.
    """

    bindings: Mapping[str, str]
    numbers: Mapping[str, float]


class WordingReader:
    """Reads one text by one pattern after another.

    The patterns must live as long as the reader, which tells their parts apart by identity.
    """

    def __init__(self, text: PlainText) -> None:
        self._text, self._words = text, text.words
        self._known: dict[tuple[int, int], Places] = {}

    def understand(self, node: Node) -> Understood | None:
        """What the text says by a pattern, in the first way that it has; None where it has none."""
        end, begin = len(self._words), _begin(node)
        if not begin.is_optional and (not self._words or self._words[0] not in begin.words):
            return None
        if end not in self._ends(node, 0):
            return None
        bindings: dict[str, str] = {}
        numbers: dict[str, float] = {}
        self._bind(node, 0, end, bindings, numbers)
        return Understood(bindings=bindings, numbers=numbers)

    def _ends(self, node: Node, at: int) -> Places:
        """Places behind what a part may produce, of the words from ``at`` on."""
        key = (id(node), at)
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = self._read(node, at)
        return known

    def _read(self, node: Node, at: int) -> Places:
        match node:
            case Literal(text):
                words = literal_words(text)
                end = at + len(words)
                return (end,) if self._words[at:end] == words else ()
            case Chain(parts):
                return self._chain(parts, at)
            case OneOf(parts, optional):
                word = self._words[at] if self._is_in(at) else ""
                by_word, otherwise = _parts_by_first_word(parts)
                ends: dict[int, None] = {}
                for part in by_word.get(word, otherwise):
                    ends |= dict.fromkeys(self._ends(part, at))
                return tuple(ends | {at: None} if optional else ends)
            case Bound(_, _, part):
                return self._ends(part, at)
            case ListSlot(_, entries):
                begun = _by_first_word(entries).get(self._words[at], ()) if self._is_in(at) else ()
                rest = ((at + len(words), words) for words in begun)
                return tuple(end for end, words in rest if self._words[at:end] == words)
        return (at + 1,) if self._is_in(at) and self._words[at] == NUMBER else ()

    def _is_in(self, at: int) -> bool:
        return at < len(self._words)

    def _chain(self, parts: Sequence[Node], at: int) -> Places:
        places: Places = (at,)
        for part in parts:
            if len(places) == 1:
                places = self._ends(part, places[0])
            elif places:
                places = tuple(
                    dict.fromkeys(e for place in places for e in self._ends(part, place))
                )
        return places

    def _bind(
        self, node: Node, at: int, end: int, bindings: dict[str, str], numbers: dict[str, float]
    ) -> None:
        """Take what a part binds where it leads from ``at`` to ``end``."""
        match node:
            case NumberSlot(name):
                numbers[name] = self._text.numbers[at]
            case Bound(name, value, part):
                bindings[name] = value
                self._bind(part, at, end, bindings, numbers)
            case OneOf(parts):
                for part in parts:
                    if end in self._ends(part, at):
                        self._bind(part, at, end, bindings, numbers)
                        return
            case Chain(parts):
                for number, part in enumerate(parts, start=1):
                    behind = parts[number:]
                    place = next(p for p in self._ends(part, at) if end in self._chain(behind, p))
                    self._bind(part, at, place, bindings, numbers)
                    at = place


class _Begin(NamedTuple):
    """How a part may begin.

    Attributes:
        words: Its first words.
        is_optional: Whether it may be empty.
    """

    words: frozenset[str]
    is_optional: bool


@cache
def _begin(node: Node) -> _Begin:
    match node:
        case Literal(text):
            return _Begin(frozenset(literal_words(text)[:1]), not literal_words(text))
        case Chain(parts):
            words: set[str] = set()
            for begin in map(_begin, parts):
                words |= begin.words
                if not begin.is_optional:
                    return _Begin(frozenset(words), False)
            return _Begin(frozenset(words), True)
        case OneOf(parts, optional):
            begins = [_begin(part) for part in parts]
            words = set().union(*(begin.words for begin in begins))
            return _Begin(frozenset(words), optional or any(b.is_optional for b in begins))
        case Bound(_, _, part):
            return _begin(part)
        case ListSlot(_, entries):
            return _Begin(frozenset(_by_first_word(entries)), False)
    return _Begin(frozenset([NUMBER]), False)


@cache
def _parts_by_first_word(
    parts: tuple[Node, ...],
) -> tuple[Mapping[str, Sequence[Node]], Sequence[Node]]:
    """Parts that may produce something before a word, by that word; and those before any other."""
    begins = [_begin(part) for part in parts]
    words = set().union(*(begin.words for begin in begins))
    found: dict[str, list[Node]] = {word: [] for word in words}
    for part, begin in zip(parts, begins, strict=True):
        for word in words if begin.is_optional else begin.words:
            found[word].append(part)
    otherwise = [part for part, begin in zip(parts, begins, strict=True) if begin.is_optional]
    return found, otherwise


@cache
def _by_first_word(entries: tuple[str, ...]) -> Mapping[str, Sequence[tuple[str, ...]]]:
    """Plain words of entries, by the first of them."""
    found: dict[str, list[tuple[str, ...]]] = {}
    for words in map(literal_words, entries):
        if words:
            found.setdefault(words[0], []).append(words)
    return found
