"""Patterns and their automata, on small grammars whose wordings can be written out."""

import itertools
import re

import numpy as np
import pytest

from tacgrasp.lessons.dialogue.patterns.automaton import Automaton
from tacgrasp.lessons.dialogue.patterns.pattern import SharedSlots, compile_pattern, draw
from tacgrasp.lessons.dialogue.patterns.reading import WordingReader
from tacgrasp.lessons.dialogue.plain_words import plain_text, plain_words

SLOTS = {
    "side": {"left": "(left|to the left)", "right": "right"},
    "it": "(it|the {*things})",
    "open": "[so,|well,]",
}
LISTS = {"things": ("ball", "ping pong ball", "tennis racket")}
PATTERN = "{open} is {it} {side} [of {#n} mm] ?"


def node(pattern=PATTERN):
    return compile_pattern(pattern, SLOTS, LISTS)


def wordings():
    """Every wording of PATTERN, written out."""
    return {
        " ".join(" ".join(parts).split())
        for parts in itertools.product(
            ("", "so", "well"),
            ("is it", *(f"is the {thing}" for thing in LISTS["things"])),
            ("left", "to the left", "right"),
            ("", "of # mm"),
        )
    }


def test_the_automaton_accepts_what_can_be_written_out_and_only_that():
    automaton = Automaton(node())
    for text in wordings():
        assert automaton.accepts(text.split()), text
        assert not automaton.accepts(text.split()[:-1]) or " ".join(text.split()[:-1]) in wordings()
        assert not automaton.accepts([*text.split(), "now"])
    assert not automaton.accepts(["is", "the", "cube", "left"])
    assert not automaton.accepts([])


def test_a_list_of_longer_names_accepts_a_mixture_of_them_and_says_so():
    automaton = Automaton(compile_pattern("{*pairs}", {}, {"pairs": ("red wine", "blue ink")}))
    assert automaton.accepts(["red", "ink"])  # never fewer than the pattern produces
    assert not automaton.accepts(["wine", "red"])


def test_runs_are_those_of_the_wordings():
    automaton = Automaton(node("{open} is {it} {side} [of {#n} mm] ?"))
    runs = {tuple(w[i : i + 3]) for w in map(str.split, wordings()) for i in range(len(w) - 2)}
    words = sorted({word for run in runs for word in run})
    mixed = {("ping", "pong", "ball"), ("the", "tennis", "racket"), ("tennis", "racket", "right")}
    assert mixed <= runs
    for run in itertools.product(words, repeat=3):
        assert automaton.has_run(run) == (run in runs), run


def test_distinct_wordings_are_counted_once_and_a_list_as_one():
    assert Automaton(node("(a|b|a) [c]")).num_wordings(99) == 4
    # 3 openings, 'it' and names of 1, 2 and 3 words, 3 sides, with and without a number
    assert Automaton(node()).num_wordings(99) == 3 * 4 * 3 * 2
    assert Automaton(node()).num_wordings(10) == 10


def read(tree, text):
    return WordingReader(plain_text(text)).understand(tree)


def test_draws_are_accepted_and_read_as_they_were_drawn():
    rng = np.random.default_rng(3)
    automaton, tree = Automaton(node()), node()
    seen = set()
    for _ in range(200):
        drawn = draw(tree, rng)
        text = drawn.text({"n": "2.5"})
        understood = read(tree, text)
        assert understood is not None, text
        assert automaton.accepts(plain_words(text))
        assert understood.bindings == drawn.bindings
        assert understood.numbers == dict.fromkeys(drawn.numbers, 2.5)
        seen.add(" ".join(plain_words(text)))
    assert seen <= wordings()
    assert len(seen) > 30


def test_given_values_are_drawn():
    rng = np.random.default_rng(0)
    drawn = [draw(node(), rng, {"side": "right"}).bindings["side"] for _ in range(20)]
    assert set(drawn) == {"right"}


def test_another_text_is_not_understood():
    assert read(node(), "is it up?") is None
    assert read(node(), "is it left now?") is None
    assert read(node(), "") is None


def test_what_can_be_written_out_is_read_and_a_mixture_of_two_names_is_not():
    tree = node()
    for text in wordings():
        found = read(tree, text.replace("#", "2.5"))
        assert found is not None, text
        assert found.bindings["side"] == (
            "left" if text.split("of")[0].rstrip().endswith("left") else "right"
        )
        assert found.numbers == ({"n": 2.5} if "#" in text else {})
    pairs = compile_pattern("{*pairs}", {}, {"pairs": ("red wine", "blue ink")})
    assert read(pairs, "red wine") is not None
    assert read(pairs, "red ink") is None


def test_the_first_way_that_leads_to_the_end_is_taken():
    slots = {"n": {"one": "a [b]", "two": "a"}, "m": {"three": "b", "four": "b c"}}
    found = read(compile_pattern("{n} {m}", slots, {}), "a b")
    assert found.bindings == {"n": "one", "m": "three"}
    found = read(compile_pattern("{n} {m}", slots, {}), "a b b c")
    assert found.bindings == {"n": "one", "m": "four"}


def test_a_slot_that_needs_one_of_the_patterns_own_is_not_shared():
    shared = SharedSlots({"a": "x {b}", "b": "y", "c": "z"}, {})
    own = compile_pattern("{a} {c}", {"b": "w"}, {}, shared)
    assert read(own, "x w z") is not None
    assert read(own, "x y z") is None
    other = compile_pattern("{c}", {}, {}, shared)
    assert other is own.parts[1]


def test_what_patterns_have_in_common_is_one_part():
    one, other = node("x (a|[b] c)"), node("y (a|[b] c)")
    assert one.parts[1] is other.parts[1]
    assert one.parts[0] is not other.parts[0]


@pytest.mark.parametrize(
    ("pattern", "named"),
    [("(a|b", "'('"), ("a)", "')'"), ("{none}", "'none'"), ("{*none}", "'none'"), ("[a)", "'['")],
)
def test_a_bad_pattern_is_named(pattern, named):
    with pytest.raises(ValueError, match=re.escape(named)):
        node(pattern)
