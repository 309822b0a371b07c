"""Queries: every question of the grammar has one, and it reads back to the same meaning."""

from itertools import pairwise

import numpy as np
import pytest

from cltp.llm.constrained.grammar import match
from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.meaning import Amount, Length, Several, Unknowable, Which, Why
from tacgrasp.lessons.dialogue.query import asked_text, query_grammar, query_of, read_query
from tacgrasp.lessons.question_draws import draw_question
from tests.fakes.question_scenes import SCENES


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_every_question_of_the_grammar_has_a_query_that_reads_back(family):
    rng = np.random.default_rng(len(family.name))
    for scene in SCENES:
        question = draw_question(scene, rng, family)
        asked = asked_text(question.text, question.before)
        query = query_of(question.meaning, asked.numbers)
        assert read_query(query, asked.numbers) == question.meaning, (question.text, query)
        assert match(query_grammar(len(asked.numbers)), query)[1], query


@pytest.mark.parametrize(
    ("question", "words", "numbers"),
    [
        ("Isn't it deeper than 0.3 mm?", "is not it deeper than # millimetre", (0.3,)),
        ("Over half a newton?", "over # newton", (0.5,)),
        ("Does it cover a third of the pad?", "does it cover # percent of the pad", (33.3,)),
        ("Between two and three newtons?", "between # and # newtons", (2.0, 3.0)),
        ("In one word: how deep?", "in a word how deep", ()),
        ("A tenth of a millimetre or more?", "# millimetre or more", (0.1,)),
        ("A full millimetre or more?", "# millimetre or more", (1.0,)),
        ("Is three times the force 2 N?", "is thrice the force # n", (2.0,)),
    ],
)
def test_numbers_are_taken_out_of_a_question(question, words, numbers):
    asked = asked_text(question)
    assert asked.words == words
    assert asked.numbers == pytest.approx(numbers)


def test_a_follow_up_stands_behind_the_question_before():
    assert asked_text("And in grams?", "How hard is it held?").words == (
        "how hard is it held ? and in grams"
    )


@pytest.mark.parametrize(
    ("query", "meaning"),
    [
        ("amount depth µm in a word.", Amount(quantity="depth", unit="µm", length=Length.WORD)),
        ("word shape.", Which(name="shape", is_open=True)),
        ("check not force within.", check_of("force within", denied=True)),
        ("check force > #2 g.", check_of("force > 250 g")),
        ("check force #1 +- #2 N.", check_of("force 1 +- 250 N")),
        ("check twice force over.", check_of("twice force over")),
        ("amount lacking N.", Amount(quantity="lacking", unit="N")),
        ("amount twice force mN.", Amount(quantity="twice force", unit="mN")),
        ("amount half holds g.", Amount(quantity="half holds", unit="g")),
        ("amount free_area %.", Amount(quantity="free_area", unit="%")),
        ("amount depth - #1 mm.", Amount(quantity="depth", unit="mm", less="1")),
        ("amount force - #2 mN.", Amount(quantity="force", unit="mN", less="250 / 1000")),
        ("check thrice depth > #2 µm.", check_of("thrice depth > 250 µm")),
        ("check force > #2 cN.", check_of("force > 250 cN")),
        ("because mass, twice force.", Why(shows=("mass", "twice force"))),
        ("why felt.", Why(shows=("depth", "area", "force"))),
        ("unknown trait.", Unknowable(subject="that")),
        ("why both.", Why(with_action=True)),
        ("unknown price.", Unknowable(subject="its price")),
        (
            "amount depth mm; choice texture.",
            Several(parts=(Amount(quantity="depth", unit="mm"), Which(name="texture"))),
        ),
    ],
)
def test_queries_have_their_meanings(query, meaning):
    assert read_query(query, (1.0, 250.0)) == meaning
    assert query_of(meaning, (1.0, 250.0)) == query


def test_a_number_that_the_question_does_not_have_is_no_meaning():
    assert read_query("check force > #2 N.", (1.0,)) is None
    assert not match(query_grammar(1), "check force > #2 N.")[1]
    assert read_query("amount depth - #2 mm.", (1.0,)) is None
    assert not match(query_grammar(1), "amount depth - #2 mm.")[1]


@pytest.mark.parametrize(
    "query", ["", "amount depth mm", "amount depth N.", "amount twice x mm.", "why not.", "x; y."]
)
def test_what_is_no_query_is_refused(query):
    with pytest.raises(ValueError, match="quer"):
        read_query(query)


def test_less_than_nothing_to_the_left_is_to_the_right():
    asked = read_query("check x < -#1 mm.", (-2.0,))
    assert (asked.condition, query_of(asked, (2.0,))) == ("x_mm < 2", "check x < #1 mm.")


@pytest.mark.parametrize("test", ["depth > 1 N", "colour red", "slips 3 N", "shape bent", "", "x"])
def test_what_is_no_condition_is_refused(test):
    with pytest.raises(ValueError, match="there is no"):
        check_of(test)


def test_no_query_is_the_beginning_of_another():
    texts = sorted(option.text for option in query_grammar(2)[0].options)
    assert len(set(texts)) == len(texts)
    assert not [a for a, b in pairwise(texts) if b.startswith(a)]
