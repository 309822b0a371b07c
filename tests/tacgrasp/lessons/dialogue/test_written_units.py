import pytest

from tacgrasp.lessons.dialogue.query import asked_text
from tacgrasp.lessons.dialogue.written_units import in_asked_unit, numbers_in_units


@pytest.mark.parametrize(
    ("question", "query", "numbers"),
    [
        ("Is x over 500 microns?", "check x > #1 mm.", (0.5,)),
        ("Is it over 0.3 cm?", "check depth > #1 µm.", (3000.0,)),
        ("Does 200 g press on it?", "check force > #1 N.", (1.96133,)),
        ("Is it 1.2 N ± 100 mN?", "check force #1 +- #2 N.", (1.2, 0.1)),
        ("The force for 0.2 kg?", "amount needed #1 g N.", (200.0,)),
        ("Over 2 N, or 300 µm deep?", "check force > #1 N; check depth > #2 mm.", (2.0, 0.3)),
        ("Is it over 3?", "check force > #1 N.", (3.0,)),
        ("How deep is it?", "amount depth mm.", ()),
    ],
)
def test_numbers_come_in_the_units_of_the_query(question, query, numbers):
    asked = asked_text(question)
    assert numbers_in_units(query, asked.words, asked.numbers) == pytest.approx(numbers, rel=1e-4)


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Is 0.5 N enough for 30 g?", "check stays #1 g."),
        ("Is it 0.5 N for 30 g?", "check force #1 +- #2 N."),
        ("Is it more than 3 mm²?", "check area > #1 %."),
        ("Is it deeper than 2 N?", "check depth > #1 mm."),
        ("Is it over 500 microns?", "check x > #1 mm; check depth > #1 µm."),
    ],
)
def test_a_query_that_takes_a_number_for_something_else_is_none(question, query):
    asked = asked_text(question)
    assert numbers_in_units(query, asked.words, asked.numbers) is None


def test_a_hash_of_the_question_itself_changes_nothing():
    asked = asked_text("Is # over 3 N?")
    assert numbers_in_units("check force > #1 N.", "is # over # n", asked.numbers) == asked.numbers


@pytest.mark.parametrize(
    ("question", "query", "told"),
    [
        ("depth in inches", "amount depth mm.", "amount depth in."),
        ("How many pounds of force?", "amount force N.", "amount force lbf."),
        ("How many pounds can it hold?", "amount holds g.", "amount holds lb."),
        ("force, lbf", "amount force N.", "amount force lbf."),
        ("force in kn", "amount force N.", "amount force kN."),
        ("area in cm²", "amount area mm².", "amount area cm²."),
        ("How much force in ounces for 60 g?", "amount needed #1 g N.", "amount needed #1 g ozf."),
        (
            "Force and depth, in lbf and inches",
            "amount force N; amount depth mm.",
            "amount force lbf; amount depth in.",
        ),
        (
            "x in mm and y in inches",
            "amount x mm; amount y mm.",
            "amount x mm; amount y in.",
        ),
        ("How far is it pressed in?", "amount depth mm.", "amount depth mm."),
        (
            "How deep, in one word, in cm?",
            "amount depth mm in a word.",
            "amount depth cm in a word.",
        ),
        ("force in mm", "amount force N.", ""),
        ("depth in grams", "amount depth mm.", ""),
    ],
)
def test_an_amount_comes_in_the_unit_asked_for(question, query, told):
    assert in_asked_unit(query, asked_text(question).words) == told
