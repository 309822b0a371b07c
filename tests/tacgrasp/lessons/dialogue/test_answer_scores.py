"""Reading and scoring of answers: what is right, and above all what is not."""

import pytest

from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.scoring.answer_reading import read_answer
from tacgrasp.lessons.dialogue.scoring.answer_scores import score_answer
from tacgrasp.lessons.dialogue.scoring.question_file import question_row
from tacgrasp.lessons.dialogue.scoring.truth_units import scale_of
from tests.fakes.question_scenes import ASIDE, FREE, HELD, UNTOUCHED


def row(kind, truth="", tolerance=""):
    columns = {"family": "f", "question": "q?", "kind": kind, "truth": truth}
    return question_row({**columns, "tolerance": tolerance})


def right(text, kind, truth="", scene=HELD, tolerance=""):
    return score_answer(text, row(kind, truth, tolerance), scene).right


@pytest.mark.parametrize(
    "text",
    [
        "0.19 mm.",
        "190 µm",
        "It is 190 microns.",
        "0.019 cm",
        "The depth is 0,19 mm.",
        "0.19 mm, that is 190 µm.",
        "0.19 mm deep.",
        "About 0.23 mm.",  # within 0.05 mm
    ],
)
def test_a_depth_is_right_in_any_unit_of_length(text):
    assert right(text, "number", "depth_mm")


@pytest.mark.parametrize(
    "text",
    [
        "0.19",  # no unit
        "0.19 N",
        "0.19 mm²",
        "190 mm",
        "0.25 mm.",
        "0.19 mm or 0.35 mm.",
        "0.19 mm with 0.83 N.",
        "Yes.",
        "I can't tell.",
        "Nothing touches the pad.",
        "",
    ],
)
def test_a_depth_is_not_right_otherwise(text):
    assert not right(text, "number", "depth_mm")


def test_grams_stand_for_a_force_and_square_millimetres_for_a_percentage():
    assert right("85 g", "number", "force_n")
    assert right("830 mN", "number", "force_n")
    assert not right("0.83 g", "number", "force_n")
    assert right("37 mm²", "number", "area_percent")  # 12 % of 20.3 x 15.2 mm
    assert right("37 square millimetres", "number", "area_percent")
    assert not right("12 mm²", "number", "area_percent")
    assert right("25 g", "number", "mass_g")
    assert right("0.025 kg", "number", "mass_g")
    assert not right("0.25 N", "number", "mass_g")


def test_a_name_over_another_of_its_dimension_is_a_percentage():
    assert right("64 %", "number", "100 * force_n / limit_n")  # 0.83 of 1.3 N
    assert not right("0.64 N", "number", "100 * force_n / limit_n")
    assert right("1.23 N", "number", "60 * gram_n")
    assert right("1.4 mm", "number", "(x_mm * x_mm + y_mm * y_mm) / hypot(x_mm, y_mm)")
    assert right("37 mm²", "number", "area_mm2")


def test_a_share_is_a_percentage_or_a_plain_ratio_as_its_truth_is_written():
    assert right("9.5 %", "number", "100 * depth_mm / 2")
    assert not right("9.5 mm", "number", "100 * depth_mm / 2")
    assert right("0.64", "number", "force_n / limit_n")
    assert right("64 %", "number", "force_n / limit_n")
    assert not right("0.64", "number", "100 * force_n / limit_n")
    assert right("0.42 N", "number", "0.5 * force_n")
    assert right("0.25 N", "number", "mass_g * 9.81 / 1000")  # 25 g
    assert right("-62 cN", "number", "force_n - 145 / 100")


def test_a_truth_may_be_stated_in_the_unit_that_is_asked_for():
    assert right("190 µm", "number", "depth_mm * 1000")
    assert right("0.019 cm", "number", "depth_mm / 10")
    assert right("830 mN", "number", "1000 * force_n")
    assert right("0.025 kg", "number", "mass_g / 1000")
    assert right("0.085 kg", "number", "force_n / 9.81")
    assert right("0.37 cm²", "number", "area_mm2 / 100")
    assert right("0.19 mm; 830 mN.", "text", "depth_mm; force_n * 1000")
    assert right("1420 µm", "number", "hypot(x_mm, y_mm) * 1000", tolerance="100")
    assert not right("1420 µm", "number", "hypot(x_mm, y_mm) * 1000", tolerance="1")
    assert right("240 µm", "number", "depth_mm * 1000")  # within 0.05 mm, as without the factor
    # another unit than the stated one
    assert not right("0.19 mm", "number", "depth_mm * 1000")
    assert not right("190 mm", "number", "depth_mm / 1000")
    assert not right("0.19 µm", "number", "depth_mm")
    assert not right("190 µm", "number", "2 * depth_mm")
    # ten times the depth, where no unit is a tenth of a millimetre
    assert right("1.9 mm", "number", "10 * depth_mm")


@pytest.mark.parametrize(
    ("text", "truth"),
    [
        ("0.0075 in.", "depth_mm / 25.4"),
        ("7.5 thou.", "depth_mm / 25.4 * 1000"),
        ("0.19 mm.", "depth_mm"),
        ("0.187 lbf.", "force_n / 4.4482"),
        ("85 g.", "force_n / 9.81 * 1000"),
    ],
)
def test_a_truth_may_be_in_units_that_are_no_power_of_ten(text, truth):
    assert right(text, "number", truth)


def test_a_word_beside_a_number_has_no_unit():
    truth = Expression("depth == 'deep' and x_mm < 0")

    assert scale_of(truth) == 1.0


def test_loads_lengths_and_pressures_are_told_by_their_truths():
    assert right("63 g", "number", "limit_n / gram_n")  # 1.3 N
    assert not right("63 N", "number", "limit_n / gram_n")
    assert right("0.51 N", "number", "mass_g * gram_n")
    assert not right("0.51 g", "number", "mass_g * gram_n")
    assert right("6.9 mm", "number", "2 * sqrt(area_mm2 / 3.14159)")
    assert right("22.4 kPa", "number", "1000 * force_n / area_mm2")
    assert right("0.0224 N/mm²", "number", "force_n / area_mm2")
    assert not right("0.0224 N", "number", "force_n / area_mm2")


def test_a_choice_by_a_condition_is_one_of_its_words():
    truth = "'above' if force_n > 1 else 'below'"
    assert right("Below.", "choice", truth)
    assert not right("Above.", "choice", truth)
    assert not right("Above or below.", "choice", truth)
    assert right("Left: x is -0.6 mm.", "choice", "'left half' if x_mm < 9 else 'right half'")
    assert not right("Right.", "choice", "'left half' if x_mm < 9 else 'right half'")
    truth = "shape if shape in ('ring', 'disc') else 'neither'"
    assert right("Neither: it is an ellipsoid.", "choice", truth)
    assert not right("It is a ring.", "choice", truth)
    assert right("Off-centre.", "choice", "'centre' if x_mm > 9 else 'off-centre'")
    assert not right("Centre.", "choice", "'centre' if x_mm > 9 else 'off-centre'")
    larger = "'limit' if force_n < 99 else 'force'"
    assert right("Limit: the force is 1 N and the limit is 2 N.", "choice", larger)
    assert right("Force limit: the force is 1 N and the limit is 2 N.", "choice", larger)
    assert not right("Force: the force is 1 N and the limit is 2 N.", "choice", larger)
    assert not right("The force is 1 N and the limit is 2 N.", "choice", larger)
    assert right("It is nearer to the palm.", "choice", "'palm' if y_mm > -5 else 'fingertip'")


def test_a_tolerance_of_the_row_counts_in_its_unit_or_in_percent():
    assert right("0.9 N", "number", "force_n", tolerance="0.1")
    assert not right("0.9 N", "number", "force_n", tolerance="0.05")
    assert right("0.9 N", "number", "force_n", tolerance="10%")
    assert not right("0.9 N", "number", "force_n", tolerance="5%")


@pytest.mark.parametrize(
    ("text", "is_yes"),
    [
        ("Yes.", True),
        ("yes, 0.83 N", True),
        ("Yes 0.83 N", True),
        ("Yeah.", True),
        ("Correct.", True),
        ("No.", False),
        ("no: 0.83 N", False),
        ("Nope, it is a ring.", False),
        ("The force is 0.83 N, so no.", False),
        ("0.83 N, so yes", True),
        ("Yes, the force is 0.83 N, so no.", None),
        ("0.83 N.", None),
        ("Nothing touches the pad.", None),
        ("No force band is given.", None),
        ("Yesterday.", None),
    ],
)
def test_yes_and_no_are_read_at_the_beginning_or_the_end(text, is_yes):
    assert read_answer(text).is_yes is is_yes


def test_yes_is_right_where_the_truth_is_so():
    assert right("Yes, 0.83 N.", "yes_no", "force_n > 0.8")
    assert not right("No, 0.83 N.", "yes_no", "force_n > 0.8")
    assert not right("0.83 N.", "yes_no", "force_n > 0.8")


def test_a_threshold_within_the_rows_tolerance_is_left_out():
    close = score_answer("No.", row("yes_no", "force_n > 0.8", "0.05"), HELD)
    assert close.is_close
    assert not score_answer("No.", row("yes_no", "force_n > 0.8", "0.02"), HELD).is_close
    assert not score_answer("No.", row("yes_no", "force_n > 0.8"), HELD).is_close


@pytest.mark.parametrize(
    ("text", "truth", "is_right"),
    [
        ("An ellipsoid.", "shape", True),
        ("Neither, it is an ellipsoid.", "shape", True),
        ("A sphere or an ellipsoid.", "shape", False),
        ("A sphere.", "shape", False),
        ("Slight, 0.19 mm deep.", "depth", True),
        ("Deep.", "depth", False),
        ("A medium area, 12 %.", "area", True),
        ("It is centered.", "position", True),
        ("In the middle.", "position", True),
        ("In the top left.", "position", False),
        ("Within the band.", "force_band", True),
        ("Below or within the band.", "force_band", False),
        ("Lift it.", "action", True),
        ("Increase the force.", "action", False),
        ("It is right of the middle.", "side_x", True),
        ("The whole of it is on the pad.", "wholeness", True),
        ("It is not cut.", "wholeness", True),
        ("The edge cuts it.", "wholeness", False),
        ("The vertical one.", "worse_axis", True),
    ],
)
def test_a_choice_must_name_the_word_and_no_other(text, truth, is_right):
    assert right(text, "choice", truth) == is_right


def test_a_middle_cell_is_not_the_center():
    for text in ("In the middle-left.", "in the middle left", "It is in the middle-left cell."):
        assert read_answer(text).words("position") == ["middle-left"], text
    assert read_answer("It is in the middle.").words("position") == ["centered"]


def test_very_large_is_not_large():
    assert read_answer("A very large area.").words("area") == ["very large"]
    assert read_answer("very deep").words("depth") == ["very deep"]


def test_several_must_all_be_right_in_their_order():
    truth = "depth_mm; force_n"
    assert right("0.19 mm and 0.83 N.", "text", truth)
    assert not right("0.19 mm.", "text", truth)
    assert not right("0.19 mm, 1.60 N.", "text", truth)
    assert not right("0.19 mm, 0.50 mm and 0.83 N.", "text", truth)
    places = "x_mm; y_mm"
    assert right("x +0.8 mm, y -1.2 mm.", "text", places)
    assert not right("x -1.2 mm, y +0.8 mm.", "text", places, tolerance="0.5")
    assert right("Smooth; yes, it is centered.", "text", "texture; position == 'centered'")
    assert not right("Smooth; no.", "text", "texture; position == 'centered'")


def test_a_reason_is_read_in_words():
    assert right("Because the edge of the pad cuts it.", "text", "reason", scene=ASIDE) == (
        ASIDE.values()["reason"] == "cut off by the pad's edge"
    )
    assert right("Because it is off center.", "text", "reason", scene=ASIDE)
    assert not right("Because it is held too lightly.", "text", "reason", scene=ASIDE)


@pytest.mark.parametrize(
    ("text", "kind", "as_such", "right_kind"),
    [
        ("I can't feel its color.", "unknowable", True, True),
        ("Touch can't tell the price.", "unknowable", True, True),
        ("Unknown.", "unknowable", True, True),
        ("I only answer about touch.", "off_topic", True, True),
        ("That is not about touch.", "off_topic", True, True),
        ("I only answer about touch.", "unknowable", True, False),
        ("I can't feel that.", "off_topic", True, False),
        ("A smooth ellipsoid.", "unknowable", False, False),
        ("No.", "off_topic", False, False),
    ],
)
def test_what_can_not_be_known_must_be_answered_so(text, kind, as_such, right_kind):
    score = score_answer(text, row(kind), HELD)
    assert not score.decidable
    assert (score.right, score.right_kind) == (as_such, right_kind)


def test_a_question_that_lacks_the_contract_is_undecidable():
    score = score_answer(
        "I can't say: no force band is given.", row("yes_no", "force_n > band_high_n"), FREE
    )
    assert (score.decidable, score.right, score.right_kind) == (False, True, True)
    assert not score_answer("No.", row("yes_no", "force_n > band_high_n"), FREE).right
    asked = row("yes_no", "force_n > band_high_n")
    assert not score_answer("I can't say: no force band is given.", asked, HELD).right


def test_where_nothing_touches_saying_so_is_right():
    nothing = "Nothing touches the pad."
    assert right(nothing, "number", "depth_mm", scene=UNTOUCHED)
    assert right(nothing, "choice", "shape", scene=UNTOUCHED)
    assert right("No, nothing touches the pad.", "yes_no", "contact", scene=UNTOUCHED)
    assert not right(nothing, "number", "limit_n", scene=UNTOUCHED)
    assert not right("A sphere.", "choice", "shape", scene=UNTOUCHED)
    assert not right(nothing, "number", "depth_mm")


def test_the_kind_of_a_wrong_answer_can_be_right():
    number = score_answer("0.90 mm.", row("number", "depth_mm"), HELD)
    assert (number.right, number.right_kind) == (False, True)
    force = score_answer("0.90 N.", row("number", "depth_mm"), HELD)
    assert not force.right_kind
    assert score_answer("A sphere.", row("text", "shape"), HELD).right_kind
    assert not score_answer("Goal 1.90 - 3.90 N.", row("yes_no", "force_n > 1"), HELD).right_kind
    assert not score_answer("A sphere.", row("yes_no", "contact"), HELD).right_kind


@pytest.mark.parametrize(
    ("truth", "text", "is_right"),
    [
        ("depth_mm / 0.05", "3.8.", True),
        ("depth_mm / 0.05", "4.8.", False),
        ("force_n / (0.05 * 9.81)", "1.69.", True),
        ("force_n / 9.81 * 1000 / 4", "21.2.", True),
        ("force_n / 9.81 * 1000", "84.6.", False),
        ("mass_g / 1000 * 9.81", "0.25.", False),
        ("mass_g / 1000 * 9.81", "0.25 N.", True),
        ("depth_mm / 2 * 100", "9.5.", False),
        ("depth_mm / 0.05", "0.19 mm.", False),
        ("depth_mm * 1000", "190.", False),
        ("depth_mm / 25.4", "0.0075 in.", True),
        ("force_n / 9.81 * 1000 / 28.35", "2.98 ozf.", True),
        ("area_mm2 * depth_mm", "7.04 mm³.", True),
    ],
)
def test_a_count_needs_no_unit_and_every_unit_counts(truth, text, is_right):
    assert right(text, "number", truth) is is_right


def test_a_truth_that_names_nothing_is_a_number_like_any_other():
    assert scale_of(Expression("20 * 2")) == 1.0
    assert right("40 g.", "number", "20 * 2")
    assert not right("41.5 g.", "number", "20 * 2")
