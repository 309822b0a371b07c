import math
from dataclasses import replace

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.calculations.calculated import calculated
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import AnswerKind, kind_of
from tacgrasp.lessons.dialogue.query import query_of, read_query
from tacgrasp.lessons.read_question import ReadQuestion
from tests.fakes.question_scenes import FREE, HELD, UNTOUCHED

NUMBERS = [
    ("What is the force minus 2 N plus 1 N?", "force_n - 2 + 1", "N"),
    ("Ratio of force to depth in mN/µm?", "force_n / depth_mm", "mN/µm"),
    ("If the area rose by 5 %, what would it be?", "(1 + 5 / 100) * area_percent", "%"),
    ("What is 40 % of the limit?", "0.4 * limit_n", "N"),
    ("Half the limit, in millinewtons?", "0.5 * limit_n", "mN"),
    ("What percentage of 2 mm is the depth?", "100 * depth_mm / 2", "%"),
    (
        "The lower end of the band is how many percent of the limit?",
        "100 * band_low_n / limit_n",
        "%",
    ),
    ("How much of the limit is still unused?", "100 - 100 * force_n / limit_n", "%"),
    ("How much is missing until the depth reaches 1 mm?", "1 - depth_mm", "mm"),
    ("How many newtons are we short of the limit?", "limit_n - force_n", "N"),
    ("By how much does the limit exceed the force?", "limit_n - force_n", "N"),
    ("How far above the band is the force?", "force_n - band_high_n", "N"),
    ("How far below the band is the force?", "band_low_n - force_n", "N"),
    ("How far is the depth from 0.5 mm?", "abs(depth_mm - 0.5)", "mm"),
    ("How many N is it below 2 N? Say zero if it is not.", "max(0, 2 - force_n)", "N"),
    ("Subtract the force from 5 N.", "5 - force_n", "N"),
    ("Add 0.2 mm to the depth: what do you get?", "depth_mm + 0.2", "mm"),
    ("Divide the limit by the force.", "limit_n / force_n", ""),
    ("What is the object's weight in newtons?", "0.00980665 * mass_g", "N"),
    ("What is the force minus the weight of the object?", "force_n - 0.00980665 * mass_g", "N"),
    (
        "How far is the contact from the point x = 3 mm, y = -2 mm?",
        "hypot(x_mm - 3, y_mm - -2)",
        "mm",
    ),
    ("If the force dropped by 20 %, how much would remain?", "(1 - 20 / 100) * force_n", "N"),
    ("What would the force be if it rose by 10 percent?", "(1 + 10 / 100) * force_n", "N"),
    ("How far below the limit would we be if the force doubled?", "limit_n - 2 * force_n", "N"),
    ("If I put a 50 g label on the object, what would the total mass be?", "mass_g + 50", "g"),
    (
        "If two fingers share the weight equally, how many N does each carry?",
        "0.00980665 * mass_g / 2",
        "N",
    ),
    ("If I eased off by 0.2 N, what would the force be?", "force_n - 0.2", "N"),
    ("Suppose another 0.3 N came on top: what would it be?", "force_n + 0.3", "N"),
    ("If the object slid 2 mm to the right, what would x be?", "x_mm + 2", "mm"),
    ("What is the ratio of force to depth, in N/mm?", "force_n / depth_mm", "N/mm"),
    ("Average psi under the thing you're touching?", "force_n / area_mm2", "psi"),
    (
        "How many newtons fall on each square centimetre of the contact?",
        "force_n / area_mm2",
        "N/cm²",
    ),
    ("Newtons per millimetre of indentation, please.", "force_n / depth_mm", "N/mm"),
    ("How far is the contact from the right edge?", "pad_width_mm / 2 - x_mm", "mm"),
    (
        "The pad is 20.3 mm wide. How many millimetres lie between the touch point and the "
        "left-hand border?",
        "pad_width_mm / 2 + x_mm",
        "mm",
    ),
    ("How much clearance is there to the top rim of the pad?", "pad_height_mm / 2 - y_mm", "mm"),
    ("How high is the pad?", "pad_height_mm", "mm"),
    ("The limit is how many times as big as the force?", "limit_n / force_n", ""),
    ("Of every hundred parts of the pad, how many are touched?", "area_percent", "%"),
    ("Of every ten parts of the pad, how many are touched?", "10 * area_percent / 100", ""),
    ("Force divided by the weight of the object?", "force_n / (0.00980665 * mass_g)", ""),
    ("If the gel were 4 mm thick, what percentage of it is pressed in?", "100 * depth_mm / 4", "%"),
    (
        "What is the least change of force that would bring us into the band?",
        "max(0, band_low_n - force_n, force_n - band_high_n)",
        "N",
    ),
    ("What is the force minus 2 N? Negative if it is less.", "force_n - 2", "N"),
    ("How far is the depth from 1 mm, either way?", "abs(abs(depth_mm - 1))", "mm"),
    ("What mass weighs as much as the force?", "force_n / 0.00980665", "g"),
    ("What would two of them weigh?", "2 * mass_g", "g"),
]
CHECKS = [
    (
        "Is at least one of force and weight above the limit?",
        "force_n > limit_n or 0.00980665 * mass_g > limit_n",
    ),
    ("If the limit doubled, would we be over it?", "force_n > 2 * limit_n"),
    ("Would we exceed the limit if the limit fell by 20 %?", "force_n > (1 - 20 / 100) * limit_n"),
    ("If the mass doubled, would the weight be over 1 N?", "0.00980665 * 2 * mass_g > 1"),
    ("If x doubled, would the distance to the middle exceed 9 mm?", "hypot((2 * x_mm), y_mm) > 9"),
    ("Is the limit more than twice as high as the force?", "limit_n > 2 * force_n"),
    ("Would 100 g be heavier than the object?", "100 > mass_g"),
    ("Does the force exceed the limit by more than 1 N?", "force_n - limit_n > 1"),
    ("Is the limit more than 20 % above the force?", "limit_n - force_n > 20 / 100 * force_n"),
    ("Is minus x above 3 mm?", "-1 * x_mm > 3"),
    ("Would 20 g more be over 100 g?", "mass_g + 20 > 100"),
    ("Is y closer to zero than x?", "abs(y_mm - 0) < abs(x_mm - 0)"),
    ("Are we within 0.2 N of the limit?", "abs(force_n - limit_n) <= 0.2"),
    ("Is the force more than two thirds of the limit?", "force_n > 0.667 * limit_n"),
    ("Is the limit at least twice the force?", "limit_n >= 2 * force_n"),
    ("Is the weight of the object greater than the force?", "0.00980665 * mass_g > force_n"),
    ("Are x and y both above zero?", "x_mm > 0 and y_mm > 0"),
    (
        "Does at least one hold: force above 8 N, or depth above 1 mm?",
        "(force_n > 8) or (depth_mm > 1)",
    ),
    (
        "Is the area over 10 % and the depth below 0.5 mm?",
        "(area_percent > 10) and (depth_mm < 0.5)",
    ),
    ("Do we have more than half of the limit in reserve?", "limit_n - force_n > 0.5 * limit_n"),
    ("If the force doubled, would it exceed the limit?", "2 * force_n > limit_n"),
    ("If the limit were halved, would the present force violate it?", "force_n > 0.5 * limit_n"),
    ("Suppose you pushed 1 N harder: would we be above the band?", "force_n + 1 > band_high_n"),
    ("Would another 0.5 N put us over the limit?", "force_n + 0.5 > limit_n"),
    ("If the force rose to 2 N, would it exceed the limit?", "2 > limit_n"),
    (
        "If you pressed 0.3 N softer, would we still be within the band?",
        "band_low_n <= (force_n - 0.3) <= band_high_n",
    ),
    ("Is the area above 30 mm²?", "area_mm2 > 30"),
    ("Has the depth failed to reach 0.4 mm?", "depth_mm < 0.4"),
    ("Is the depth between 200 and 700 microns?", "min(0.2, 0.7) <= depth_mm <= max(0.2, 0.7)"),
    ("Is the depth, in microns, more than 400?", "depth_mm > 0.4"),
    ("Is the whole band below the limit?", "band_high_n < limit_n"),
    (
        "If I backed off 0.5 N, would we be in the band?",
        "band_low_n <= (force_n - 0.5) <= band_high_n",
    ),
    ("If it slid 3 mm to the left, would it be left of the middle?", "x_mm - 3 < 0"),
    ("Can I add another newton without exceeding the limit?", "force_n + 1 <= limit_n"),
    ("Is it more than 5 mm away from the lower edge?", "pad_height_mm / 2 + y_mm > 5"),
    (
        "Do fewer than three millimetres remain from the contact to the left border?",
        "pad_width_mm / 2 + x_mm < 3",
    ),
    ("Are we past the halfway mark to the limit?", "force_n > 0.5 * limit_n"),
    ("Does the patch fit inside ten percent of the sensing area?", "area_percent <= 0.1 * 100"),
    ("Is x smaller than y, leaving signs aside?", "abs(x_mm) < abs(y_mm)"),
    ("Has the force yet to get past 500 mN?", "not (force_n > 0.5)"),
    (
        "Isn't the force, one way or the other, outside of what was agreed?",
        "not (band_low_n <= force_n <= band_high_n)",
    ),
    (
        "Is it true that neither the force exceeds 2 N nor the depth exceeds 1 mm?",
        "not (force_n > 2) and not (depth_mm > 1)",
    ),
    (
        "Is the force closer to zero than it is to the limit?",
        "abs(force_n - 0) < abs(force_n - limit_n)",
    ),
    ("Does the push make for more than 40 kPa?", "force_n / area_mm2 > 0.04"),
    (
        "Is the force nearer to the lower end of the band than to the upper one?",
        "abs(force_n - band_low_n) < abs(force_n - band_high_n)",
    ),
]
CHOICES = [
    ("Is more of the pad covered or free?", "'covered' if area_percent > 50 else 'free'"),
    ("Is it in the upper or the lower half of the pad?", "'upper' if y_mm > 0 else 'lower'"),
    ("Which is greater, the force or the limit?", "'force' if force_n > limit_n else 'limit'"),
    (
        "Is the force nearer to 1 N or to 2 N?",
        "'1 N' if abs(force_n - 1) < abs(force_n - 2) else '2 N'",
    ),
    ("Over or under 4 N?", "'over' if force_n > 4 else 'under'"),
    (
        "Of the two, the limit and the force, which is the greater?",
        "'limit' if limit_n > force_n else 'force'",
    ),
    (
        "One newton or five newtons: to which of these is the force closer?",
        "'1 N' if abs(force_n - 1) < abs(force_n - 5) else '5 N'",
    ),
    (
        "To get into the band, should I loosen, hold or tighten?",
        "'tighten' if force_n < band_low_n else 'loosen' if force_n > band_high_n else 'hold'",
    ),
    (
        "Which end of the band is the force nearer to, the lower or the upper?",
        "'lower' if abs(force_n - band_low_n) < abs(force_n - band_high_n) else 'upper'",
    ),
]


@pytest.mark.parametrize(("question", "truth", "unit"), NUMBERS)
def test_a_number_is_calculated_as_it_is_asked(question, truth, unit):
    meaning = calculated(question)
    assert meaning is not None
    assert (meaning.truth, meaning.unit) == (truth, unit)
    assert kind_of(meaning) is AnswerKind.NUMBER


@pytest.mark.parametrize(("question", "truth"), CHECKS)
def test_a_condition_is_calculated_as_it_is_asked(question, truth):
    meaning = calculated(question)
    assert meaning is not None
    assert (meaning.truth, meaning.unit) == (truth, None)
    assert kind_of(meaning) is AnswerKind.YES_NO


@pytest.mark.parametrize(("question", "truth"), CHOICES)
def test_a_choice_is_calculated_as_it_is_asked(question, truth):
    meaning = calculated(question)
    assert meaning is not None
    assert meaning.truth == truth
    assert kind_of(meaning) is AnswerKind.CHOICE


@pytest.mark.parametrize(
    "question",
    [
        "How deep is it?",
        "What is the force?",
        "What shape is it?",
        "Is it round?",
        "Is it safe to lift?",
        "What percentage of the price is tax?",
        "Is the price above 3 N?",
        "If it rains, will the force change?",
        "Is 2 more than 1?",
        "Subtract 2 N from 5 N.",
        "How far is the moon from the earth?",
        "What's the air pressure in here, in hPa?",
        "What is the tyre pressure of my car in psi?",
        "Is the average air pressure above 1000 hPa?",
        "How far over the left edge does it hang?",
        "How close is it to the edge?",
        "Is the depth more than the force?",
        "Which is greater, 2 N or 1 N?",
        "If the depth doubled, what would the force be?",
        "If we pressed 1 N harder, how deep would it be?",
        "If I pressed 2 mm deeper, would the force exceed the limit?",
        "Is the force more than 5 N per mm?",
        "Is the truck's weight above the limit?",
        "What is half the weight of the robot?",
        "Which is greater, the weight or the mass?",
        "What percent of the force is one?",
        "",
    ],
)
def test_what_calculates_nothing_is_left_to_others(question):
    assert calculated(question) is None


@pytest.mark.parametrize("question", [row[0] for row in (*NUMBERS, *CHECKS, *CHOICES)])
def test_a_calculation_comes_back_from_its_query(question):
    meaning = calculated(question)
    assert meaning is not None
    assert read_query(query_of(meaning)) == meaning


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("Subtract the force from 5 N.", "4.17 N."),
        ("How many mN is the force short of the limit?", "470 mN."),
        ("What percentage of 2 mm is the depth?", "9.5 %."),
        ("Divide the limit by the force.", "1.57."),
        ("Is the limit at least twice the force?", "No, the limit is 1.30 N, the force is 0.83 N."),
        ("Which is greater, the force or the limit?", "Limit."),
    ],
)
def test_a_calculation_is_answered(question, text):
    assert answer(calculated(question), HELD).text == text


def test_what_nobody_gave_or_nothing_touches_is_said():
    without = answer(calculated("What is 40 % of the limit?"), FREE)
    assert (without.decidable, without.text) == (False, "I can't say: no limit is given.")
    assert "Nothing touches" in answer(calculated("Subtract the force from 5 N."), UNTOUCHED).text


def test_every_truth_can_be_evaluated():
    values = HELD.values()
    rows = [truth for _, truth, _ in NUMBERS] + [truth for _, truth in CHECKS + CHOICES]
    for truth in rows:
        Expression(truth).evaluate({**values, "mass_g": 30.0})


def test_what_would_be_divided_by_nothing_is_not_told():
    weightless = replace(HELD, state=replace(HELD.state, force_n=0.0))
    asked = ReadQuestion("", calculated("Divide the limit by the force."), 1.0)
    told = answered(asked, weightless, {}, {"force_n": (0.0, 0.1)})
    assert (told.answer.decidable, told.answer.value, told.interval) == (False, None, None)


def test_an_interval_leaves_out_what_would_be_divided_by_nothing():
    asked = ReadQuestion("", calculated("Divide the limit by the force."), 1.0)
    low, high = answered(asked, HELD, {}, {"force_n": (0.0, 1.2)}).interval
    assert 1.0 < low < 1.3 / 0.83 < high < math.inf
