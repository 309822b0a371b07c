"""Patterns: the notation of the grammar, with its draws.

A pattern is text with

    (a|b|c)     one of these
    [a|b]       one of these, or nothing
    {name}      the slot of that name: another pattern, or a table of values with their patterns,
                of which the one that is drawn is bound to the name
    {#name}     a number, bound to the name
    {*name}     an entry of a word list

Not here: the patterns themselves (``tacgrasp.lessons.dialogue.families``), recognition
(``tacgrasp.lessons.dialogue.patterns.reading``), what they can produce at all
(``tacgrasp.lessons.dialogue.patterns.automaton``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from tacgrasp.lessons.dialogue.plain_words import plain_words

Slots = Mapping[str, "str | Mapping[str, str]"]
"""Slots by name: a pattern, or a table from values to patterns."""

OPTION_PROBABILITY = 0.25
"""How often an optional part is drawn. Our choice: most questions are short."""


@dataclass(frozen=True, slots=True, eq=False)
class Literal:
    """A piece of text, with its punctuation."""

    text: str


@dataclass(frozen=True, slots=True, eq=False)
class NumberSlot:
    """A number that is chosen when the question is put to a contact."""

    name: str


@dataclass(frozen=True, slots=True, eq=False)
class ListSlot:
    """An entry of a word list."""

    name: str
    entries: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """Parts one after another."""

    parts: tuple[Node, ...]


@dataclass(frozen=True, slots=True, eq=False)
class OneOf:
    """One of some parts; ``optional`` adds the empty one."""

    parts: tuple[Node, ...]
    optional: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Bound:
    """A part that gives a name its value."""

    name: str
    value: str
    part: Node


@cache
def literal_words(text: str) -> tuple[str, ...]:
    """Plain words of a piece of a pattern, or of an entry of a word list."""
    return plain_words(text)


Node = Literal | NumberSlot | ListSlot | Chain | OneOf | Bound

_MADE: dict[tuple[object, ...], Node] = {}


def _literal(text: str) -> Node:
    return _MADE.setdefault((Literal, text), Literal(text))


def _chain(parts: Sequence[Node]) -> Node:
    """The one chain of these parts: what patterns have in common is one object, and read once."""
    if len(parts) == 1:
        return parts[0]
    return _MADE.setdefault((Chain, *map(id, parts)), Chain(tuple(parts)))


def _one_of(parts: Sequence[Node], *, optional: bool = False) -> Node:
    return _MADE.setdefault((OneOf, optional, *map(id, parts)), OneOf(tuple(parts), optional))


_SYNTAX = re.compile(r"\(|\)|\[|\]|\||\{[#*]?\w+\}|[^\s()\[\]{}|]+")


class SharedSlots:
    """Slots that many patterns have, each read once.

    Args:
        slots: The slots.
        lists: The word lists.
    """

    def __init__(self, slots: Slots, lists: Mapping[str, Sequence[str]]) -> None:
        self.slots = slots
        self._compiler = _Compiler(slots, lists)
        self._parts: dict[str, frozenset[str]] = {}

    def node(self, name: str, own: frozenset[str]) -> Node | None:
        """What a slot produces; None where it is none of these, or needs one of some own slots."""
        if name not in self.slots or self._needed(name) & own:
            return None
        return self._compiler.leaf(f"{{{name}}}")

    def _needed(self, name: str) -> frozenset[str]:
        """Names of the slots that a slot is made of, its own among them."""
        if name not in self._parts:
            slot = self.slots[name]
            text = slot if isinstance(slot, str) else " ".join(slot.values())
            inner = (self._needed(part) for part in re.findall(r"\{(\w+)\}", text))
            self._parts[name] = frozenset([name]).union(*inner)
        return self._parts[name]


def compile_pattern(
    text: str,
    slots: Slots,
    lists: Mapping[str, Sequence[str]],
    shared: SharedSlots | None = None,
) -> Node:
    """Read a pattern.

    Args:
        text: The pattern.
        slots: Its own slots, which stand for shared ones of the same name.
        lists: The word lists.
        shared: Slots that it has beside its own.

    Raises:
        ValueError: Brackets that don't match, or an unknown slot or list; the message names it.
    """
    return _Compiler(slots, lists, shared).compile(text)


class _Compiler:
    """Reads a pattern and each of its slots once.

    Args:
        slots: The slots.
        lists: The word lists.
        shared: Slots beside these, read by another compiler.
    """

    def __init__(
        self,
        slots: Slots,
        lists: Mapping[str, Sequence[str]],
        shared: SharedSlots | None = None,
    ) -> None:
        self._own, self._lists, self._shared = frozenset(slots), lists, shared
        self._slots = slots if shared is None else {**shared.slots, **slots}
        self._compiled: dict[str, Node] = {}

    def compile(self, text: str) -> Node:
        tokens = _SYNTAX.findall(text)
        node, end = self._choice(tokens, 0)
        if end != len(tokens):
            raise ValueError(f"unmatched {tokens[end]!r} in the pattern {text[:60]!r}")
        return node

    def _choice(self, tokens: Sequence[str], begin: int) -> tuple[Node, int]:
        """Parts that ``|`` separates, up to a closing bracket or the end."""
        choices: list[Node] = []
        parts: list[Node] = []
        at = begin
        while at < len(tokens) and tokens[at] not in (")", "]"):
            token = tokens[at]
            at += 1
            if token == "|":
                choices.append(_chain(parts))
                parts = []
            elif token in ("(", "["):
                inner, at = self._choice(tokens, at)
                if at >= len(tokens) or tokens[at] != {"(": ")", "[": "]"}[token]:
                    raise ValueError(f"a {token!r} is not closed in {' '.join(tokens)[:60]!r}")
                at += 1
                parts.append(_one_of((inner,), optional=True) if token == "[" else inner)
            else:
                parts.append(self.leaf(token))
        choices.append(_chain(parts))
        return (choices[0] if len(choices) == 1 else _one_of(choices)), at

    def leaf(self, token: str) -> Node:
        """What one token stands for."""
        if not token.startswith("{"):
            return _literal(token)
        name = token[1:-1]
        if name.startswith("#"):
            return NumberSlot(name[1:])
        if name.startswith("*"):
            if name[1:] not in self._lists:
                known = ", ".join(self._lists)
                raise ValueError(f"no word list is called {name[1:]!r}; known: {known}")
            return ListSlot(name[1:], tuple(self._lists[name[1:]]))
        if name not in self._slots:
            raise ValueError(f"no slot is called {name!r}; known: {', '.join(self._slots)}")
        if name not in self._compiled:
            shared = None if self._shared is None else self._shared.node(name, self._own)
            self._compiled[name] = shared or self._slot(name)
        return self._compiled[name]

    def _slot(self, name: str) -> Node:
        slot = self._slots[name]
        if isinstance(slot, str):
            return self.compile(slot)
        return OneOf(tuple(Bound(name, value, self.compile(p)) for value, p in slot.items()))


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnWording:
    """A wording before its numbers are chosen.

    Attributes:
        pieces: Pieces of text in order; a ``NumberSlot`` stands for its number.
        bindings: Bound values by name.
    """

    pieces: tuple[str | NumberSlot, ...]
    bindings: Mapping[str, str]

    @property
    def numbers(self) -> tuple[str, ...]:
        """Names of the numbers to be chosen."""
        return tuple(piece.name for piece in self.pieces if isinstance(piece, NumberSlot))

    def text(self, numbers: Mapping[str, str]) -> str:
        """The wording with its numbers, given as text by name."""
        words = [numbers[p.name] if isinstance(p, NumberSlot) else p for p in self.pieces]
        joined = re.sub(r"\s+([?.,;:!%])", r"\1", " ".join(words))
        return re.sub(r"(?<=\d)%", " %", joined)


def draw(
    node: Node, rng: np.random.Generator, given: Mapping[str, str] | None = None
) -> DrawnWording:
    """Draw one wording; ``given`` are values of names that are not to be drawn."""
    pieces: list[str | NumberSlot] = []
    bindings: dict[str, str] = {}
    _draw(node, rng, given or {}, pieces, bindings)
    return DrawnWording(pieces=tuple(pieces), bindings=bindings)


def _draw(
    node: Node,
    rng: np.random.Generator,
    given: Mapping[str, str],
    pieces: list[str | NumberSlot],
    bindings: dict[str, str],
) -> None:
    match node:
        case Literal(text):
            pieces.append(text)
        case NumberSlot():
            pieces.append(node)
        case ListSlot(_, entries):
            pieces.append(entries[int(rng.random() * len(entries))])
        case Chain(parts):
            for part in parts:
                _draw(part, rng, given, pieces, bindings)
        case OneOf(parts, optional):
            if not optional or rng.random() < OPTION_PROBABILITY:
                part = _given_part(parts, given) or parts[int(rng.random() * len(parts))]
                _draw(part, rng, given, pieces, bindings)
        case Bound(name, value, part):
            bindings[name] = value
            _draw(part, rng, given, pieces, bindings)


def _given_part(parts: Sequence[Node], given: Mapping[str, str]) -> Node | None:
    """The part that binds a name to its given value; None where there is none.

    The parts of a slot bind its name, all of them; other parts bind nothing themselves.
    """
    if not given or not isinstance(parts[0], Bound):
        return None
    for part in parts:
        if isinstance(part, Bound) and given.get(part.name) == part.value:
            return part
    return None


def walk(node: Node, visit: Callable[[Node], None]) -> None:
    """Visit a node and all that it consists of."""
    visit(node)
    match node:
        case Chain(parts) | OneOf(parts):
            for part in parts:
                walk(part, visit)
        case Bound(_, _, part):
            walk(part, visit)
