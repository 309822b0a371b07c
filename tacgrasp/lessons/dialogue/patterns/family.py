"""A family of questions: its wordings, and the meaning of each.

Not here: the families (the other modules of this folder).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from importlib import resources

import numpy as np

from tacgrasp.lessons.dialogue.meaning import Length, Meaning
from tacgrasp.lessons.dialogue.patterns.automaton import Automaton
from tacgrasp.lessons.dialogue.patterns.pattern import Node, SharedSlots, Slots, compile_pattern
from tacgrasp.lessons.dialogue.patterns.phrases import SHARED
from tacgrasp.lessons.dialogue.scene import AskedScene

Bindings = Mapping[str, str]
Numbers = Mapping[str, float]
Chooser = Callable[[AskedScene, Bindings, np.random.Generator], Mapping[str, str]]
Steerer = Callable[[AskedScene, bool, np.random.Generator], Mapping[str, str]]


def no_numbers(_: AskedScene, __: Bindings, ___: np.random.Generator) -> Mapping[str, str]:
    """Numbers of a family whose wordings have none."""
    return {}


def no_steering(_: AskedScene, __: bool, ___: np.random.Generator) -> Mapping[str, str]:
    """Bindings of a family whose answers need no balance."""
    return {}


@dataclass(frozen=True, eq=False)
class QuestionFamily:
    """Questions of one kind.

    Attributes:
        name: Its name in files of questions.
        pattern: Its wordings.
        build: Meaning of a wording, from its bindings and its numbers.
        slots: Slots beside those that all families share.
        choose: Chooses the numbers of a wording for a scene, as text by name.
        steer: Bindings that make the answer in a scene yes, or no.
        before: Questions that this one follows; empty where it stands alone.
    """

    name: str
    pattern: str
    build: Callable[[Bindings, Numbers], Meaning]
    slots: Slots = field(default_factory=dict)
    choose: Chooser = no_numbers
    steer: Steerer = no_steering
    before: tuple[str, ...] = ()

    @cached_property
    def node(self) -> Node:
        """Its wordings, compiled."""
        return compile_pattern(self.pattern, self.slots, word_lists(), _shared_slots())

    @cached_property
    def automaton(self) -> Automaton:
        """All that it can produce."""
        return Automaton(self.node)


def length_of(bindings: Bindings) -> Length:
    """How long an answer is asked to be."""
    named = (bindings[slot] for slot in ("verdict", "length", "first_length") if slot in bindings)
    return Length(next(named, "").removeprefix("one "))


def wants_one_word(bindings: Bindings) -> bool:
    """Whether an answer of one word is asked for, not only a brief one."""
    return "one word" in (bindings.get("length"), bindings.get("first_length"))


def multiple_of(bindings: Bindings, quantity: str) -> str:
    """The multiple of a quantity that a wording names, by its name in queries: 'twice force'."""
    slots = ("times", "changed", "change", "as_much")
    return f"{next(bindings[slot] for slot in slots if slot in bindings)} {quantity}"


@lru_cache(maxsize=1)
def word_lists() -> Mapping[str, tuple[str, ...]]:
    """Word lists by name: the files of ``vocabulary``, and their sections."""
    lists: dict[str, list[str]] = {}
    folder = resources.files("tacgrasp.lessons.dialogue") / "vocabulary"
    for file in sorted(folder.iterdir(), key=lambda each: each.name):
        if not file.name.endswith(".txt"):
            continue
        names = [file.name.removesuffix(".txt")]
        for line in file.read_text(encoding="utf-8").splitlines():
            if section := re.fullmatch(r"\[(\w+)\]", line.strip()):
                names = [names[0], section[1]]
            elif not line.startswith("#"):
                for name in names:
                    lists.setdefault(name, []).extend(w.replace("_", " ") for w in line.split())
    return {name: tuple(dict.fromkeys(words)) for name, words in lists.items()}


@lru_cache(maxsize=1)
def _shared_slots() -> SharedSlots:
    return SharedSlots(SHARED, word_lists())
