"""Questions about a friction coefficient of the asker's own."""

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.meaning import Unknowable
from tacgrasp.lessons.dialogue.rules.friction import frictional
from tacgrasp.lessons.understanding import understood_by_grammar
from tests.fakes.question_scenes import HELD


@pytest.mark.parametrize(
    ("question", "truth", "unit"),
    [
        (
            "Friction is 0.5 at both fingers. Would a 100 g object slip?",
            "2 * 0.5 * force_n < 0.980665",
            None,
        ),
        (
            "With mu of 0.8, will it stay put at this squeeze?",
            "2 * 0.8 * force_n >= 0.00980665 * mass_g",
            None,
        ),
        (
            "µ = 0.6, two equal fingers: what is the heaviest mass in kg that holds?",
            "2 * 0.6 * force_n / 0.00980665",
            "kg",
        ),
        (
            "What squeeze would a 0.25 kg part need at a friction coefficient of 0.5?",
            "2.45166 / (2 * 0.5)",
            "N",
        ),
        (
            "Two fingers like this one: what is the least friction coefficient that holds it?",
            "0.00980665 * mass_g / (2 * force_n)",
            "",
        ),
        (
            "With a friction of 0.5 and this single contact, what is the largest shear load?",
            "1 * 0.5 * force_n",
            "N",
        ),
        (
            "Friction 0.4, object of 50 grams: slip or hold?",
            "'hold' if 2 * 0.4 * force_n >= 0.490333 else 'slip'",
            None,
        ),
    ],
)
def test_what_a_friction_coefficient_makes_of_the_force_is_worked_out(question, truth, unit):
    meaning = frictional(question)
    assert meaning is not None
    assert (meaning.truth, meaning.unit) == (truth, unit)
    assert understood_by_grammar(question).meaning == meaning


def test_the_answer_is_coulombs():
    read = understood_by_grammar(
        "With mu = 0.5 and two fingers, what is the heaviest mass in grams?"
    )
    told = answered(read, HELD).answer
    assert told.value == pytest.approx(2 * 0.5 * HELD.state.force_n / 9.80665e-3, rel=0.01)


def test_a_number_beside_it_is_no_yes_or_no():
    question = "With µ = 0.4 and two fingers, how many grams is that beyond what they carry now?"
    assert frictional(question) is None


@pytest.mark.parametrize(
    "question",
    ["What is the coefficient of friction between gel and part?", "How slippery is it?"],
)
def test_the_friction_of_the_object_itself_is_not_felt(question):
    assert frictional(question) is None
    assert isinstance(understood_by_grammar(question).meaning, Unknowable)
