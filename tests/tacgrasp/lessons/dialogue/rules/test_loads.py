"""Questions that name masses."""

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.query import asked_text
from tacgrasp.lessons.dialogue.rules.loads import load_query
from tacgrasp.lessons.dialogue.rules.ruled import ruled
from tacgrasp.lessons.understanding import understood_by_grammar
from tests.fakes.question_scenes import HELD


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("Is 0.5 N ok for 30 g?", "No, it needs 0.61 N."),
        ("0.5 N fine for a 30 g berry?", "No, it needs 0.61 N."),
        ("Is 700 mN good enough for 0.03 kg?", "Yes, it needs 0.61 N."),
        ("Will 30 g slip at 0.5 N?", "Yes, it needs 0.61 N."),
        ("Does a 30 g berry need more than 0.7 N?", "No, it needs 0.61 N."),
        ("Is 0.7 N too weak for 30 g?", "No, it needs 0.61 N."),
        (
            "Would it hold 10 g and 50 g?",
            "Yes, 10 g needs 0.21 N and the force is 0.83 N; "
            "no, 50 g needs 1.03 N and the force is 0.83 N.",
        ),
        (
            "Will 10 or 50 g slip?",
            "No, 10 g needs 0.21 N and the force is 0.83 N; "
            "yes, 50 g needs 1.03 N and the force is 0.83 N.",
        ),
        (
            "How much force is needed for 10 g and 50 g?",
            "The force that surely holds 10 g is 0.205 N; "
            "the force that surely holds 50 g is 1.03 N.",
        ),
    ],
)
def test_a_named_mass_is_judged_by_the_force_that_surely_holds_it(question, text):
    assert answer(ruled(question), HELD).text == text


@pytest.mark.parametrize(
    "question",
    [
        "Would it hold 50 g?",
        "Does 0.5 N match 30 g?",
        "Is the force more than 0.5 N for 30 g?",
        "Is 5 N too much for 30 g?",
        "Is it between 10 and 50 g?",
        "Is it 0.5 N or 1 N?",
        "How many newtons hold 30 g at 2 N?",
        "How much more could it hold?",
        "How many newtons does it hold with?",
    ],
)
def test_other_questions_are_not_read(question):
    assert load_query(asked_text(question).words) == ""


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("How many grams does it hold?", "40 g."),
        ("What load can this grip safely carry?", "40 g."),
        ("What mass would it hold, in pounds?", "0.088 lb."),
    ],
)
def test_the_load_that_is_held_is_no_force(question, text):
    read = understood_by_grammar(question)
    assert read is not None
    assert answered(read, HELD).answer.text == text
