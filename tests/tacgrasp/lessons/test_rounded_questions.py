"""Questions that say how their number is to be rounded."""

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.quantities import to_step
from tacgrasp.lessons.dialogue.query import query_of, read_query
from tacgrasp.lessons.rounded_questions import rounding_of
from tacgrasp.lessons.understanding import understood_by_grammar
from tests.fakes.question_scenes import HELD


@pytest.mark.parametrize(
    ("question", "rest", "step", "unit"),
    [
        ("Force to the nearest tenth of a newton?", "Force in newton?", 0.1, "N"),
        ("Depth in mm, rounded to the nearest 0.1?", "Depth in mm?", 0.1, ""),
        ("Depth to the nearest ten microns?", "Depth in microns?", 10, "µm"),
        ("Rounded to a whole newton, what is it?", "what is it in newton?", 1, "N"),
        ("To the nearest half mm, how deep?", "how deep in mm?", 0.5, "mm"),
        ("What is the force to one decimal?", "What is the force?", 0.1, ""),
        ("How many newtons, rounded to two decimals?", "How many newtons?", 0.01, ""),
        ("Area to the nearest 5 %?", "Area in %?", 5, "%"),
        ("Round the force to a whole number.", "what is the force.", 1, ""),
        ("Force in whole newtons?", "Force in newtons?", 1, "N"),
        ("The limit as an integer?", "The limit?", 1, ""),
    ],
)
def test_a_rounding_is_taken_out(question, rest, step, unit):
    assert rounding_of(question) == (rest, pytest.approx(step), unit)


@pytest.mark.parametrize(
    "question",
    [
        "How far is it to the nearest edge?",
        "If 2 mm counts as full scale, what percentage are we at?",
        "Taking the scale as a whole, what percentage is it?",
        "Is it closer to one newton?",
        "Is it round?",
        "",
    ],
)
def test_what_rounds_nothing_stays(question):
    assert rounding_of(question) is None


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("Rounded to a whole newton, what is the force?", "1 N."),
        ("What is the force to the nearest tenth of a newton?", "0.8 N."),
        ("To the nearest 100 mN, how much force?", "800 mN."),
        ("What is the depth to the nearest tenth of a millimetre?", "0.2 mm."),
        ("Depth in mm to the nearest 50 µm?", "0.20 mm."),
        ("Area to the nearest 5 %?", "10 %."),
        ("Force to three decimals?", "0.83 N."),
        ("x to the nearest millimetre?", "+1 mm."),
        ("Half the limit, rounded to a whole newton?", "1 N."),
        ("Is the force 1 N, to the nearest newton?", "No, the force is 0.83 N."),
    ],
)
def test_a_number_is_rounded_as_it_is_asked(question, text):
    read = understood_by_grammar(question)
    assert read is not None
    assert answered(read, HELD).answer.text == text


@pytest.mark.parametrize(
    ("text", "step", "rounded"),
    [
        ("2.34 N", 1, "2 N"),
        ("2.50 N", 1, "3 N"),
        ("-4.1 mm", 0.5, "-4.0 mm"),
        ("-0.2 mm", 1, "0 mm"),
        ("12 %", 0.1, "12 %"),
        ("2.34 N", 0.0, "2.34 N"),
    ],
)
def test_a_number_is_rounded_unless_it_is_coarser(text, step, rounded):
    assert to_step(text, step) == rounded


@pytest.mark.parametrize(
    "query", ["amount depth mm to 0.1.", "calculate 0.5 * limit_n in N to 1.", "amount mass g."]
)
def test_a_rounding_comes_back_from_its_query(query):
    assert query_of(read_query(query)) == query
