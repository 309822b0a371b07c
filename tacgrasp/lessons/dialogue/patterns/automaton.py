"""A pattern as a finite automaton over plain words: exact answers about what it can produce.

The automaton accepts every wording that the pattern produces. A word list of several-word entries
is one class of words a place, so that 'tennis racket' and 'ping pong ball' also admit 'ping racket'
in a list of two-word entries: what the automaton rejects can't be produced, and it may accept a
little more. Numbers are all alike.

Patterns have no recursion, so the automaton has no circle and its language is finite.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

from tacgrasp.lessons.dialogue.patterns.pattern import Bound, Chain, ListSlot, Literal, Node, OneOf
from tacgrasp.lessons.dialogue.plain_words import NUMBER, PlainText, plain_words


@dataclass(frozen=True, slots=True, kw_only=True)
class Understood:
    """How a text was recognised.

    Attributes:
        bindings: Bound values by name.
        numbers: Values of its numbers by name.
    """

    bindings: Mapping[str, str]
    numbers: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class _Arc:
    """An arc to a state: labelled by nothing, a word, a class of words, or a number.

    Attributes:
        target: State that it leads to.
        label: A word, ``NUMBER`` or the name of a class; '' for an arc that takes no word.
        binding: Name and value that it binds; for a number its name and ''.
    """

    target: int
    label: str = ""
    binding: tuple[str, str] | None = None


class Automaton:
    """The wordings of a pattern.

    Args:
        node: The pattern.
    """

    def __init__(self, node: Node) -> None:
        self._size = 0
        self._silent: dict[int, list[_Arc]] = {}
        self._spoken: dict[int, dict[str, list[_Arc]]] = {}
        self._listed: dict[int, list[_Arc]] = {}
        self.classes: dict[str, frozenset[str]] = {}
        self._known_after: dict[tuple[str, ...], frozenset[int]] = {}
        self._start = self._state()
        self._end = self._build(node, self._start)

    @cached_property
    def _targets(self) -> Mapping[str, set[int]]:
        """By word, the states that any arc with it leads to."""
        targets: dict[str, set[int]] = {}
        for arcs in self._spoken.values():
            for word, some in arcs.items():
                targets.setdefault(word, set()).update(arc.target for arc in some)
        return targets

    @cached_property
    def _listed_targets(self) -> Mapping[str, set[int]]:
        """By class of words, the states that any arc with it leads to."""
        targets: dict[str, set[int]] = {}
        for arcs in self._listed.values():
            for arc in arcs:
                targets.setdefault(arc.label, set()).add(arc.target)
        return targets

    def __len__(self) -> int:
        return self._size

    def _state(self) -> int:
        self._size += 1
        return self._size - 1

    def _say(self, start: int, words: Iterable[str], binding: tuple[str, str] | None = None) -> int:
        for word in words:
            end = self._state()
            self._spoken.setdefault(start, {}).setdefault(word, []).append(_Arc(end, word, binding))
            start = end
        return start

    def _build(self, node: Node, start: int) -> int:
        match node:
            case Literal(text):
                return self._say(start, _plain(text))
            case ListSlot(name, entries):
                return self._build_list(name, entries, start)
            case Chain(parts):
                for part in parts:
                    start = self._build(part, start)
                return start
            case OneOf(parts, optional):
                end = self._state()
                for part in parts:
                    self._silent.setdefault(self._build(part, start), []).append(_Arc(end))
                if optional:
                    self._silent.setdefault(start, []).append(_Arc(end))
                return end
            case Bound(name, value, part):
                inner = self._state()
                arc = _Arc(inner, binding=(name, value))
                self._silent.setdefault(start, []).append(arc)
                return self._build(part, inner)
        return self._say(start, [NUMBER], (node.name, ""))

    def _build_list(self, name: str, entries: Sequence[str], start: int) -> int:
        end = self._state()
        for length, classes in _classes(tuple(entries)).items():
            at = start
            for place, words in enumerate(classes):
                label = f"<{name} {place + 1} of {length}>"
                self.classes[label] = words
                target = end if place == length - 1 else self._state()
                self._listed.setdefault(at, []).append(_Arc(target, label))
                at = target
        return end

    def _closure(self, states: Iterable[int]) -> frozenset[int]:
        seen, left = set(states), list(states)
        while left:
            for arc in self._silent.get(left.pop(), ()):
                if arc.target not in seen:
                    seen.add(arc.target)
                    left.append(arc.target)
        return frozenset(seen)

    def _arcs(self, state: int, word: str) -> list[_Arc]:
        listed = [arc for arc in self._listed.get(state, ()) if word in self.classes[arc.label]]
        return self._spoken.get(state, {}).get(word, []) + listed

    def _step(self, states: Iterable[int], word: str) -> frozenset[int]:
        return self._closure({arc.target for state in states for arc in self._arcs(state, word)})

    def accepts(self, words: Sequence[str]) -> bool:
        """Whether a wording, in plain words, may be produced."""
        if not self.vocabulary.issuperset(words):
            return False
        states = self._closure([self._start])
        for word in words:
            states = self._step(states, word)
        return self._end in states

    def has_run(self, words: Sequence[str]) -> bool:
        """Whether some words, one after another, occur anywhere in a wording."""
        return self.vocabulary.issuperset(words) and bool(self._after(tuple(words)))

    def _after(self, words: tuple[str, ...]) -> frozenset[int]:
        """States that take a word, or end, behind some words that begin anywhere."""
        if words not in self._known_after:
            if len(words) > 1:
                states = self._step(self._after(words[:-1]), words[-1])
            else:  # from any state, since each of them lies on a way from the start to the end
                targets = set(self._targets.get(words[0], ()))
                for label, ends in self._listed_targets.items():
                    if words[0] in self.classes[label]:
                        targets |= ends
                states = self._closure(targets)
            self._known_after[words] = frozenset(
                state
                for state in states
                if state in self._spoken or state in self._listed or state == self._end
            )
        return self._known_after[words]

    def understand(self, text: PlainText) -> Understood | None:
        """Bindings of the first way in which a text may be produced; None where there is none."""
        if not self.vocabulary.issuperset(text.words):
            return None
        failed: set[tuple[int, int]] = set()
        trail: list[tuple[tuple[str, str], int]] = []

        def follow(state: int, at: int) -> bool:
            if (state, at) in failed:
                return False
            if state == self._end and at == len(text.words):
                return True
            arcs = [(arc, at) for arc in self._silent.get(state, ())]
            if at < len(text.words):
                arcs += [(arc, at + 1) for arc in self._arcs(state, text.words[at])]
            for arc, after in arcs:
                if arc.binding is not None:
                    trail.append((arc.binding, at))
                if follow(arc.target, after):
                    return True
                if arc.binding is not None:
                    trail.pop()
            failed.add((state, at))
            return False

        if not follow(self._start, 0):
            return None
        return Understood(
            bindings={name: value for (name, value), _ in trail if value},
            numbers={name: text.numbers[at] for (name, value), at in trail if not value},
        )

    def num_wordings(self, most: int) -> int:
        """Number of distinct wordings, up to ``most``.

        All entries of a word list are one, and so are all numbers.
        """

        def count(states: frozenset[int], room: int) -> int:
            targets: dict[str, set[int]] = {}
            for state in states:
                for word, arcs in self._spoken.get(state, {}).items():
                    targets.setdefault(word, set()).update(arc.target for arc in arcs)
                for arc in self._listed.get(state, ()):
                    targets.setdefault(arc.label, set()).add(arc.target)
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
        words = frozenset(word for arcs in self._spoken.values() for word in arcs)
        return words.union(*self.classes.values())


@cache
def _plain(text: str) -> tuple[str, ...]:
    return plain_words(text)


@cache
def _classes(entries: tuple[str, ...]) -> Mapping[int, tuple[frozenset[str], ...]]:
    """Words at each place of the entries, by the entries' number of words."""
    by_length: dict[int, list[tuple[str, ...]]] = {}
    for entry in entries:
        words = _plain(entry)
        by_length.setdefault(len(words), []).append(words)
    return {
        length: tuple(frozenset(words[place] for words in group) for place in range(length))
        for length, group in by_length.items()
    }
