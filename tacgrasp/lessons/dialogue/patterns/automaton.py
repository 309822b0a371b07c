"""A pattern as a finite automaton over plain words: exact answers about what it can produce.

The automaton accepts every wording that the pattern produces. A word list of several-word entries
is one class of words a place, so that 'tennis racket' and 'ping pong ball' also admit 'ping racket'
in a list of two-word entries: what the automaton rejects can't be produced, and it may accept a
little more. Numbers are all alike.

Patterns have no recursion, so the automaton has no circle and its language is finite.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache, cached_property, reduce
from operator import or_

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
from tacgrasp.lessons.dialogue.plain_words import NUMBER


class _States:
    """States, each of them once, with the arcs that leave it.

    They are one that takes a word, or some that take none.

    Attributes:
        labels: By state a word, ``NUMBER`` or the name of a class; '' where its arcs take no word.
        targets: By state the states that its arcs lead to.
        next_bits: By state the bits of the labels that may come next; that of '' at the end.
        bits: The bit of each label; '' stands for the end.
        classes: The words of each class.
        end: The state in which wordings end.
    """

    def __init__(self) -> None:
        self.labels = [""]
        self.targets: list[tuple[int, ...]] = [()]
        self.next_bits = [1]
        self.bits = {"": 1}
        self.classes: dict[str, frozenset[str]] = {}
        self.end = 0
        self._words: dict[tuple[str, int], int] = {}
        self._choices: dict[tuple[int, ...], int] = {}

    def word(self, label: str, target: int) -> int:
        """The state that takes a word, before another one."""
        key = label, target
        number = self._words.get(key)
        if number is None:
            number = self._words[key] = len(self.labels)
            self.labels.append(label)
            self.targets.append((target,))
            self.next_bits.append(self.bits.setdefault(label, 1 << len(self.bits)))
        return number

    def either(self, starts: Iterable[int]) -> int:
        """The state that is before any of some others."""
        different = tuple(dict.fromkeys(starts))
        if len(different) == 1:
            return different[0]
        number = self._choices.get(different)
        if number is None:
            number = self._choices[different] = len(self.labels)
            self.labels.append("")
            self.targets.append(different)
            self.next_bits.append(reduce(or_, (self.next_bits[each] for each in different), 0))
        return number


class Automaton:
    """The wordings of a pattern.

    It is built from its end: what is followed by the same is built once, so that a phrase at the
    end of many wordings has one chain of states.

    Args:
        node: The pattern.
    """

    def __init__(self, node: Node) -> None:
        self._states = _States()
        self._known_bits: dict[str, int] = {}
        self._known_behind: dict[int, frozenset[int]] = {}
        self._known_before_last: dict[tuple[str, ...], frozenset[int]] = {}
        self._start = _Builder(self._states).build(node, self._states.end)

    def __len__(self) -> int:
        return len(self._states.labels)

    @cached_property
    def _past(self) -> Mapping[int, tuple[frozenset[int], int]]:
        """By the bit of a label what its states lead to, and the labels that may come next."""
        found: dict[int, set[int]] = {}
        states = self._states
        for label, bit, targets in zip(
            states.labels, states.next_bits, states.targets, strict=True
        ):
            if label:
                found.setdefault(bit, set()).update(targets)
        return {
            bit: (frozenset(targets), reduce(or_, (states.next_bits[each] for each in targets)))
            for bit, targets in found.items()
        }

    def _bits(self, word: str) -> int:
        """Bits of the labels that take a word: itself, and the classes that it is one of."""
        known = self._known_bits.get(word)
        if known is None:
            bits = self._states.bits
            labels = [label for label, words in self._states.classes.items() if word in words]
            known = reduce(or_, (bits[label] for label in labels), bits.get(word, 0))
            self._known_bits[word] = known
        return known

    def _behind(self, state: int) -> frozenset[int]:
        """States that take a word, or end, and are reached from a state without a word."""
        known = self._known_behind.get(state)
        if known is None:
            is_last = bool(self._states.labels[state]) or state == self._states.end
            known = frozenset([state]) if is_last else self._closure(self._states.targets[state])
            self._known_behind[state] = known
        return known

    def _closure(self, states: Iterable[int]) -> frozenset[int]:
        return frozenset().union(*map(self._behind, states))

    def _before(self, bits: int, states: Iterable[int]) -> frozenset[int]:
        """Those of some states behind which one of some labels may come next."""
        next_bits = self._states.next_bits
        return frozenset(state for state in states if next_bits[state] & bits)

    def _taken(self, bits: int, states: Iterable[int]) -> set[int]:
        """What some states lead to with one word of some labels."""
        labels, targets = self._states.labels, self._states.targets
        pending, seen, found = list(states), set(states), set[int]()
        while pending:
            state = pending.pop()
            if labels[state]:
                found.update(targets[state])
                continue
            new = self._before(bits, targets[state]) - seen
            seen |= new
            pending += new
        return found

    def accepts(self, words: Sequence[str]) -> bool:
        """Whether a wording, in plain words, may be produced."""
        if not self.vocabulary.issuperset(words):
            return False
        first, *later = *map(self._bits, words), self._states.bits[""]
        states, taken = self._before(first, [self._start]), first
        for bits in later:
            states, taken = self._before(bits, self._taken(taken, states)), bits
        return bool(states)

    def has_run(self, words: Sequence[str]) -> bool:
        """Whether some words, one after another, occur anywhere in a wording."""
        if not self.vocabulary.issuperset(words):
            return False
        return len(words) < 2 or bool(self._before_last(tuple(words)))

    def _before_last(self, words: tuple[str, ...]) -> frozenset[int]:
        """States behind all but the last of some words, which begin anywhere, and before the last.

        They begin at any state, since each lies on a way from the start to the end.
        """
        known = self._known_before_last.get(words)
        if known is None:
            *first, taken, last = map(self._bits, words)
            if first:
                behind = self._taken(taken, self._before_last(words[:-1]))
            else:
                past = (self._past[bit] for bit in _single(taken))
                behind = set().union(*(states for states, following in past if following & last))
            known = self._known_before_last[words] = self._before(last, behind)
        return known

    def num_wordings(self, most: int) -> int:
        """Number of distinct wordings, up to ``most``.

        All entries of a word list are one, and so are all numbers.
        """

        def count(states: frozenset[int], room: int) -> int:
            targets: dict[str, set[int]] = {}
            for state in states:
                if label := self._states.labels[state]:
                    targets.setdefault(label, set()).update(self._states.targets[state])
            found = int(self._states.end in states)
            for each in targets.values():
                if found >= room:
                    break
                found += count(self._closure(each), room - found)
            return found

        return min(most, count(self._closure([self._start]), most))

    @cached_property
    def vocabulary(self) -> frozenset[str]:
        """All words of its wordings; ``NUMBER`` where they have numbers."""
        classes = self._states.classes
        return frozenset(self._states.bits.keys() - {"", *classes}).union(*classes.values())


def _single(bits: int) -> Iterator[int]:
    """The bits that are set, one by one."""
    while bits:
        yield bits & -bits
        bits &= bits - 1


class _Builder:
    """Builds the states of a pattern.

    Args:
        states: Receives the states.
    """

    def __init__(self, states: _States) -> None:
        self._states = states
        self._built: dict[tuple[int, int], int] = {}

    def build(self, node: Node, end: int) -> int:
        """The state from which a node leads to another state."""
        if isinstance(node, Literal):
            for word in reversed(literal_words(node.text)):
                end = self._states.word(word, end)
            return end
        if isinstance(node, Chain):
            for part in reversed(node.parts):
                end = self.build(part, end)
            return end
        if isinstance(node, Bound):
            return self.build(node.part, end)
        if isinstance(node, NumberSlot):
            return self._states.word(NUMBER, end)
        key = (id(node), end)
        if key not in self._built:
            self._built[key] = self._states.either(self._starts(node, end))
        return self._built[key]

    def _starts(self, node: OneOf | ListSlot, end: int) -> list[int]:
        """The states from which each way through a node leads to another state."""
        if isinstance(node, ListSlot):
            return self._list(node.name, node.entries, end)
        starts = [self.build(part, end) for part in node.parts]
        return [*starts, end] if node.optional else starts

    def _list(self, name: str, entries: Sequence[str], end: int) -> list[int]:
        starts = []
        for length, classes in _classes(tuple(entries)).items():
            at = end
            for place, words in reversed(list(enumerate(classes))):
                label = f"<{name} {place + 1} of {length}>"
                self._states.classes[label] = words
                at = self._states.word(label, at)
            starts.append(at)
        return starts


@cache
def _classes(entries: tuple[str, ...]) -> Mapping[int, tuple[frozenset[str], ...]]:
    """Words at each place of the entries, by the entries' number of words."""
    by_length: dict[int, list[tuple[str, ...]]] = {}
    for entry in entries:
        words = literal_words(entry)
        by_length.setdefault(len(words), []).append(words)
    return {
        length: tuple(frozenset(words[place] for words in group) for place in range(length))
        for length, group in by_length.items()
    }
