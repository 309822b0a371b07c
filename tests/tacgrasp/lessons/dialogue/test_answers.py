"""The grammar's own answers: grammar of their sentences, units, and truth in every scene."""

import dataclasses

import pytest

from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    AnswerKind,
    Check,
    Description,
    Length,
    OffTopic,
    Several,
    Unknowable,
    Which,
    Why,
)
from tacgrasp.lessons.dialogue.query import read_query
from tests.fakes.question_scenes import ASIDE, FIRM, FREE, HELD, LIGHT, SCENES, UNTOUCHED

SAFE = Check(condition="band_low_n <= force_n <= band_high_n", shows=("force_band",))


def text_of(meaning, scene):
    return answer(meaning, scene).text


@pytest.mark.parametrize(
    ("quantity", "unit", "text"),
    [
        ("depth", "mm", "0.19 mm."),
        ("depth", "µm", "190 µm."),
        ("force", "N", "0.83 N."),
        ("force", "mN", "830 mN."),
        ("force", "g", "85 g."),
        ("area", "%", "12 %."),
        ("area", "mm²", "37 mm²."),
        ("x", "mm", "+0.8 mm."),
        ("y", "mm", "-1.2 mm."),
        ("distance", "mm", "1.4 mm."),
        ("limit", "N", "1.30 N."),
        ("headroom", "N", "0.47 N."),
        ("mass", "g", "25 g."),
        ("holds", "g", "40 g."),
        ("twice force", "N", "1.66 N."),
        ("half depth", "µm", "100 µm."),
        ("thrice holds", "g", "121 g."),
        ("force", "cN", "83 cN."),
        ("free_area", "%", "88 %."),
        ("band_middle", "N", "0.78 N."),
        ("off_middle", "N", "0.05 N."),
        ("band_width", "N", "0.33 N."),
        ("band_to_limit", "N", "0.35 N."),
        ("spare", "g", "+15 g."),
        ("tipward", "mm", "+1.2 mm."),
        ("leftward", "mm", "-0.8 mm."),
        ("larger_offset", "mm", "1.2 mm."),
        ("to_low", "N", "0.21 N."),
        ("to_high", "mN", "120 mN."),
    ],
)
def test_a_number_comes_in_the_unit_that_is_asked_for(quantity, unit, text):
    asked = Amount(quantity=quantity, unit=unit, length=Length.WORD)
    given = answer(asked, HELD)
    assert given.text == text
    assert (given.kind, given.unit, given.decidable) == (AnswerKind.NUMBER, unit, True)
    assert given.value == float(text.split()[0])


def test_a_number_comes_in_a_sentence():
    asked = Amount(quantity="depth", unit="µm", length=Length.SENTENCE)
    assert text_of(asked, HELD) == "The depth is 190 µm."


def test_multiples_and_differences_say_what_they_are():
    asked = Amount(quantity="thrice force", unit="N", length=Length.SENTENCE)
    assert text_of(asked, HELD) == "Three times the force is 2.49 N."
    asked = Amount(quantity="depth", unit="mm", less="0.3", length=Length.SENTENCE)
    assert text_of(asked, HELD) == "The difference of the depth is -0.11 mm."
    parts = (Amount(quantity="force", unit="mN", less="500 / 1000"), Which(name="texture"))
    assert text_of(Several(parts=parts), HELD) == (
        "The difference of the force is +330 mN; the surface is smooth."
    )


def test_what_a_grip_holds_beyond_the_mass_is_negative_where_it_is_too_weak():
    heavy = dataclasses.replace(HELD, mass_g=60.0)
    assert text_of(Amount(quantity="spare", unit="g"), heavy) == "-20 g."


def test_articles_and_plurals_are_right():
    assert text_of(Which(name="shape"), HELD) == "It is an ellipsoid."
    assert text_of(Which(name="shape"), FIRM) == "These are stripes."
    assert text_of(Which(name="shape", length=Length.WORD), HELD) == "Ellipsoid."
    described = text_of(Description(), HELD)
    assert described == (
        "A smooth ellipsoid, centered, with a slight press (0.19 mm), a medium contact area "
        "(12 %) and 0.83 N."
    )
    assert "a very large contact area" in text_of(Description(), FIRM)
    assert text_of(Description(), FREE).startswith("An object, centered, with a slight press")


def test_a_check_names_its_reason():
    asked = Check(condition="force_n > 1", shows=("force",))
    assert text_of(asked, HELD) == "No, the force is 0.83 N."
    short = Check(condition="force_n > 1", shows=("force",), length=Length.WORD)
    assert text_of(short, HELD) == "No."
    assert text_of(short, FIRM) == "Yes."


def test_lifting_is_safe_within_the_band():
    assert text_of(SAFE, HELD) == "Yes, 0.83 N is within the band."
    assert text_of(SAFE, LIGHT) == "No, 0.30 N is below the band."
    assert text_of(SAFE, FIRM) == "No, 5.31 N is above the band."


def test_what_is_missing_is_said():
    assert text_of(SAFE, FREE) == "I can't say: no force band is given."
    assert text_of(Why(), FREE) == "I can't say: no force band is given."
    assert text_of(Amount(quantity="limit", unit="N"), FREE) == "I can't say: no limit is given."
    assert text_of(Amount(quantity="mass", unit="g"), FREE) == "I can't say: no mass is given."
    assert text_of(Which(name="shape"), FREE) == "I can't tell the shape."
    given = answer(SAFE, FREE)
    assert not given.decidable
    assert given.kind is AnswerKind.UNKNOWABLE


def test_where_nothing_touches_answers_say_so():
    for asked in (Amount(quantity="depth", unit="mm"), Which(name="shape"), Description(), SAFE):
        assert text_of(asked, UNTOUCHED) == "Nothing touches the pad."
    assert text_of(Check(condition="contact", shows=("contact",)), UNTOUCHED) == (
        "No, nothing touches the pad."
    )
    assert text_of(Amount(quantity="limit", unit="N", length=Length.WORD), UNTOUCHED) == "1.19 N."
    assert text_of(Which(name="action"), UNTOUCHED).startswith("Reset and grasp again: ")


def test_the_next_step_and_its_reason_are_the_teachers():
    assert text_of(Which(name="action"), LIGHT) == "Increase the force: it is held too lightly."
    assert text_of(Why(), LIGHT) == "Because it is held too lightly."
    assert text_of(Why(with_action=True), ASIDE) == "Move left: it is off center."
    assert text_of(Why(shows=("force_band",)), HELD) == "Because 0.83 N is within the band."


def test_slipping_names_the_force_that_is_needed():
    asked = Check(condition="force_n < 0.0205 * 60", shows=("force",), needed_n="0.0205 * 60")
    assert text_of(asked, HELD) == "Yes, it needs 1.23 N and the force is 0.83 N."


def test_several_answers_stand_in_the_order_of_the_questions():
    parts = (Which(name="texture"), Amount(quantity="x", unit="mm"))
    assert text_of(Several(parts=parts), HELD) == "The surface is smooth; x is +0.8 mm."


def test_what_touch_can_not_know_is_said():
    assert text_of(Unknowable(subject="its price"), HELD) == "I can't feel its price."
    assert text_of(OffTopic(), UNTOUCHED) == "That is not about touch."


def test_no_answer_has_a_wrong_article_or_two_spaces():
    askeds = [Description(), *(Which(name=n) for n in ("shape", "texture", "position", "area"))]
    for scene in SCENES:
        for asked in askeds:
            text = text_of(asked, scene)
            assert "  " not in text
            assert text[0].isupper()
            assert text.endswith(".")
            for noun in (" a e", " a o", " a i", " a u", " an s", " an r", " an c", " an m"):
                assert noun not in f" {text.lower()}", text


@pytest.mark.parametrize(
    ("query", "text"),
    [
        ("amount depth in.", "0.0075 in."),
        ("amount depth m.", "0.00019 m."),
        ("amount force lbf.", "0.187 lbf."),
        ("amount force ozf.", "3.0 ozf."),
        ("amount force kgf.", "0.085 kgf."),
        ("amount force kN.", "0.00083 kN."),
        ("amount force kg.", "0.085 kg."),
        ("amount x in.", "+0.031 in."),
        ("amount area cm².", "0.37 cm²."),
        ("amount mass oz.", "0.88 oz."),
        ("amount needed #1 g lbf.", "0.277 lbf."),
    ],
)
def test_other_units_have_the_digits_of_the_own_one(query, text):
    assert answer(read_query(query, (60.0,)), HELD).text == text


@pytest.mark.parametrize(
    ("query", "numbers", "text"),
    [
        ("check force > #1 g.", [100], "No, the force is 85 g."),
        ("check depth < #1 µm.", [300], "Yes, the depth is 190 µm."),
        ("check area < #1 mm².", [20], "No, the contact area is 37 mm²."),
        ("check force #1 - #2 mN.", [100, 900], "Yes, the force is 830 mN."),
        ("calculate area_mm2 > 20.", [], "Yes, the contact area is 37 mm²."),
    ],
)
def test_what_is_compared_is_told_in_the_unit_of_the_number(query, numbers, text):
    assert text_of(read_query(query, numbers), HELD) == text
