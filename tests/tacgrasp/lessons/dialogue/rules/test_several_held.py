"""Several objects, multiples of one, and what one has too much."""

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.rules.loads import several_query
from tacgrasp.lessons.dialogue.written_units import numbers_in_units
from tacgrasp.lessons.understanding import understood_by_grammar
from tests.fakes.question_scenes import HELD

TOO_HEAVY = "calculate mass_g - holds_g in g."
TOO_WEAK = "calculate gram_n * mass_g - force_n in N."


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Would two of these objects be held?", "calculate force_n >= gram_n * 2 * mass_g."),
        ("Would it hold two?", "calculate force_n >= gram_n * 2 * mass_g."),
        ("Can the gripper carry a pair of them?", "calculate force_n >= gram_n * 2 * mass_g."),
        ("Does this grip hold 3 such boxes?", "calculate force_n >= gram_n * 3 * mass_g."),
        ("Will four of those slip?", "calculate force_n < gram_n * 4 * mass_g."),
        ("Would it hold two 20 g weights?", "calculate force_n >= gram_n * 2 * 20."),
        ("Will three 0.1 kg jars be dropped?", "calculate force_n < gram_n * 3 * 100."),
        ("Would half the object's mass be held?", "calculate force_n >= gram_n * 0.5 * mass_g."),
        ("Will ten times the load drop?", "calculate force_n < gram_n * 10 * mass_g."),
        ("If there were two of them, would they slip?", "calculate force_n < gram_n * 2 * mass_g."),
        ("What force is needed for three of these?", "calculate gram_n * 3 * mass_g in N."),
        ("How much grip to lift twice the mass?", "calculate gram_n * 2 * mass_g in N."),
        ("How many grams too heavy is it?", TOO_HEAVY),
        ("By how much is this part too heavy for us?", TOO_HEAVY),
        ("How much lighter must the object be to be carried?", TOO_HEAVY),
        ("How much too weak is the grip for this weight?", TOO_WEAK),
        ("How many newtons are we too loose to hold it?", TOO_WEAK),
        ("What force is missing to keep it safely?", TOO_WEAK),
    ],
)
def test_several_objects_and_multiples_are_weighed(question, query):
    assert understood_by_grammar(question).query == query


@pytest.mark.parametrize(
    "question",
    [
        "Would it hold 60?",
        "Would it hold 40 as well?",
        "Would two newtons hold it?",
        "Would two kilos slip?",
        "Would it hold 30 g?",
    ],
)
def test_a_number_alone_is_no_count(question):
    assert several_query(question) == ""


def test_a_count_of_things_is_no_mass():
    assert numbers_in_units("check stays #1 g.", "would # such boxes stay", (2.0,)) is None
    assert numbers_in_units("check stays #1 g.", "would # g stay", (2.0,)) == (2.0,)


def test_the_answer_tells_what_several_need():
    read = understood_by_grammar("Would two of these be held?")
    assert answered(read, HELD).answer.text == "No, it would need 1.03 N and the force is 0.83 N."
