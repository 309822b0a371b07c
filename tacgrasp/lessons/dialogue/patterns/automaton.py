"""A pattern as a finite automaton over plain words: exact answers about what it can produce.

The automaton accepts every wording that the pattern produces. A word list of several-word entries
is one class of words a place, so that 'tennis racket' and 'ping pong ball' also admit 'ping racket'
in a list of two-word entries: what the automaton rejects can't be produced, and it may accept a
little more. Numbers are all alike.

Patterns have no recursion, so the automaton has no circle and its language is finite.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache, cached_property
from typing import NamedTuple

from tacgrasp.lessons.dialogue.patterns.pattern import (
    Bound,
    Chain,
    ListSlot,
    Literal,
    Node,
    OneOf,
    literal_words,
)
from tacgrasp.lessons.dialogue.plain_words import NUMBER


class _State(NamedTuple):
    """A state, with the arcs that leave it: one that takes a word, or some that take none.

    Attributes:
        label: A word, ``NUMBER`` or the name of a class; '' where the arcs take no word.
        targets: States that the arcs lead to.
    """

    label: str
    targets: tuple[int, ...]


class Automaton:
    """The wordings of a pattern.

    It is built from its end: what is followed by the same is built once, so that a phrase at the
    end of many wordings has one chain of states.

    Args:
        node: The pattern.
    """

    def __init__(self, node: Node) -> None:
        self._states: list[_State] = []
        self.classes: dict[str, frozenset[str]] = {}
        self._known_behind: dict[int, frozenset[int]] = {}
        self._known_takers: dict[str, frozenset[int]] = {}
        self._known_after: dict[tuple[str, ...], frozenset[int]] = {}
        builder = _Builder(self._states, self.classes)
        self._end = builder.state("", ())
        self._start = builder.build(node, self._end)

    def __len__(self) -> int:
        return len(self._states)

    @cached_property
    def _with_label(self) -> Mapping[str, frozenset[int]]:
        """The states that take a word, by their label."""
        found: dict[str, list[int]] = {}
        for number, state in enumerate(self._states):
            if state.label:
                found.setdefault(state.label, []).append(number)
        return {label: frozenset(numbers) for label, numbers in found.items()}

    def _takers(self, word: str) -> frozenset[int]:
        """The states that take a word, as itself or as one of a class."""
        known = self._known_takers.get(word)
        if known is None:
            labels = [word, *(label for label, words in self.classes.items() if word in words)]
            found = (self._with_label.get(label, frozenset()) for label in labels)
            known = self._known_takers[word] = frozenset().union(*found)
        return known

    def _behind(self, state: int) -> frozenset[int]:
        """States that take a word, or end, and are reached from a state without a word."""
        known = self._known_behind.get(state)
        if known is None:
            label, targets = self._states[state]
            is_last = bool(label) or state == self._end
            known = frozenset([state]) if is_last else self._closure(targets)
            self._known_behind[state] = known
        return known

    def _closure(self, states: Iterable[int]) -> frozenset[int]:
        return frozenset().union(*map(self._behind, states))

    def _past(self, takers: Iterable[int]) -> frozenset[int]:
        """States that take a word, or end, once some states have taken theirs."""
        return self._closure({self._states[taker].targets[0] for taker in takers})

    def _ways(self, words: Sequence[str]) -> list[frozenset[int]] | None:
        """By word the states that take it behind those before, and the end; None if it is missed.

        A state may be among them from which the words that follow are not taken.
        """
        if not self.vocabulary.issuperset(words):
            return None
        ways, states = [], self._behind(self._start)
        for word in words:
            ways.append(states & self._takers(word))
            states = self._past(ways[-1])
        return [*ways, frozenset([self._end])] if self._end in states else None

    def accepts(self, words: Sequence[str]) -> bool:
        """Whether a wording, in plain words, may be produced."""
        return self._ways(words) is not None

    def has_run(self, words: Sequence[str]) -> bool:
        """Whether some words, one after another, occur anywhere in a wording."""
        return self.vocabulary.issuperset(words) and bool(self._after(tuple(words)))

    def _after(self, words: tuple[str, ...]) -> frozenset[int]:
        """States that take a word, or end, behind some words that begin anywhere."""
        known = self._known_after.get(words)
        if known is None:  # from any state, since each lies on a way from the start to the end
            takers = self._takers(words[-1])
            if len(words) > 1:
                takers &= self._after(words[:-1])
            known = self._known_after[words] = self._past(takers)
        return known

    def num_wordings(self, most: int) -> int:
        """Number of distinct wordings, up to ``most``.

        All entries of a word list are one, and so are all numbers.
        """

        def count(states: frozenset[int], room: int) -> int:
            targets: dict[str, set[int]] = {}
            for state in (self._states[each] for each in states):
                if state.label:
                    targets.setdefault(state.label, set()).update(state.targets)
            found = int(self._end in states)
            for each in targets.values():
                if found >= room:
                    break
                found += count(self._closure(each), room - found)
            return found

        return min(most, count(self._closure([self._start]), most))

    @cached_property
    def vocabulary(self) -> frozenset[str]:
        """All words of its wordings; ``NUMBER`` where they have numbers."""
        words = frozenset(state.label for state in self._states) - {"", *self.classes}
        return words.union(*self.classes.values())


class _Builder:
    """Builds the states of a pattern, each of them once.

    Args:
        states: Receives the states.
        classes: Receives the words of each class.
    """

    def __init__(self, states: list[_State], classes: dict[str, frozenset[str]]) -> None:
        self._states, self._classes = states, classes
        self._numbers: dict[_State, int] = {}
        self._built: dict[tuple[int, int], int] = {}

    def state(self, label: str, targets: tuple[int, ...]) -> int:
        """The number of a state."""
        state = _State(label, targets)
        if state not in self._numbers:
            self._numbers[state] = len(self._states)
            self._states.append(state)
        return self._numbers[state]

    def build(self, node: Node, end: int) -> int:
        """The state from which a node leads to another state."""
        key = (id(node), end)
        if key not in self._built:
            self._built[key] = self._before(node, end)
        return self._built[key]

    def _before(self, node: Node, end: int) -> int:
        match node:
            case Literal(text):
                for word in reversed(literal_words(text)):
                    end = self.state(word, (end,))
                return end
            case ListSlot(name, entries):
                return self._list(name, entries, end)
            case Chain(parts):
                for part in reversed(parts):
                    end = self.build(part, end)
                return end
            case OneOf(parts, optional):
                starts = [self.build(part, end) for part in parts]
                return self._either([*starts, end] if optional else starts)
            case Bound(_, _, part):
                return self.build(part, end)
        return self.state(NUMBER, (end,))

    def _either(self, starts: Sequence[int]) -> int:
        different = tuple(dict.fromkeys(starts))
        return different[0] if len(different) == 1 else self.state("", different)

    def _list(self, name: str, entries: Sequence[str], end: int) -> int:
        starts = []
        for length, classes in _classes(tuple(entries)).items():
            at = end
            for place, words in reversed(list(enumerate(classes))):
                label = f"<{name} {place + 1} of {length}>"
                self._classes[label] = words
                at = self.state(label, (at,))
            starts.append(at)
        return self._either(starts)


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
