import dataclasses
import math

import pytest

from tacgrasp.lessons.dialogue.expression import Expression
from tests.fakes.question_scenes import ASIDE, FREE, HELD, UNTOUCHED


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("depth_mm", 0.19),
        ("force_n > 0.8", True),
        ("band_low_n <= force_n <= band_high_n", True),
        ("not force_n < 1 and depth_mm < 1", False),
        ("shape == 'ellipsoid'", True),
        ("shape == sphere or texture == smooth", True),
        ("depth >= 'moderate'", False),
        ("area < large", True),
        ("contact", True),
        ("abs(y_mm) + 2 * 3 - 1", 6.2),
        ("hypot(x_mm, y_mm)", math.hypot(0.8, 1.2)),
        ("max(x_mm, -y_mm) / 2", 0.6),
        ("-x_mm", -0.8),
        ("force_n >= 0.0205 * mass_g", True),
        ("limit_n - force_n", 1.3 - 0.83),
        ("force_band", "within"),
        ("action", "lift"),
        ("holds_g", 0.83 / 0.0205),
        ("(x_mm ** 2 + y_mm ** 2) ** 0.5", math.hypot(0.8, 1.2)),
        ("sqrt(x_mm * x_mm)", 0.8),
        ("shape in ('ring', 'ellipsoid')", True),
        ("shape not in [ring, ellipsoid]", False),
        ("'low' if force_n < 0.5 else 'high' if force_n > 0.6 else 'middle'", "high"),
        ("limit_n - force_n if force_n < limit_n else 0", 1.3 - 0.83),
    ],
)
def test_an_expression_has_its_value(text, value):
    result = Expression(text).evaluate(HELD.values()).value
    assert result == (pytest.approx(value) if isinstance(value, float) else value)


def test_what_has_no_value_makes_the_whole_undefined():
    assert Expression("force_n < band_low_n").evaluate(FREE.values()).value is None
    assert Expression("shape == 'ring'").evaluate(FREE.values()).value is None
    assert Expression("mass_g").evaluate(FREE.values()).value is None
    assert Expression("position").evaluate(UNTOUCHED.values()).value is None


def test_what_is_divided_by_nothing_has_no_value():
    assert Expression("depth_mm / (x_mm - 0.8)").evaluate(HELD.values()).value is None


def test_the_margin_is_the_least_distance_of_compared_numbers():
    assert Expression("0.1 <= depth_mm <= 0.3").evaluate(HELD.values()).margin == pytest.approx(
        0.09
    )
    assert Expression("shape == 'ring'").evaluate(HELD.values()).margin == math.inf


def test_the_names_of_an_expression_are_known():
    assert Expression("abs(x_mm) > 2 * force_n and shape == ring").names == (
        "x_mm",
        "force_n",
        "shape",
    )


@pytest.mark.parametrize(
    "text",
    [
        "",
        "depth_mm >",
        "__import__('os').system('true')",
        "depth_mm.real",
        "weight > 3",
        "[depth_mm]",
        "depth_mm ** 9",
        "lambda: 1",
        "max(1)",
        "open('x')",
        "depth_mm ** force_n",
        "2 ** -1",
        "shape in 'ring'",
        "depth_mm if contact else open('x')",
        "(x_mm := 3)",
        "f'{x_mm}'",
        "x_mm" + " + 1" * 300,
    ],
)
def test_anything_else_is_refused(text):
    with pytest.raises(ValueError, match=r"truth|expression|name"):
        Expression(text)


@pytest.mark.parametrize(
    "text",
    ["shape > 'ring'", "shape + 1", "shape == 3", "sqrt(-2)", "(0 - 2) ** 0.5"],
)
def test_what_can_not_be_evaluated_is_named(text):
    with pytest.raises(ValueError, match="can't be evaluated"):
        Expression(text).evaluate(HELD.values())


def test_sides_and_the_cut_are_words():
    values = ASIDE.values()
    assert (values["side_x"], values["side_y"]) == ("left", "palm")
    assert (values["wholeness"], values["worse_axis"]) == ("cut", "horizontal")


def test_a_mass_or_a_refused_contract_that_answers_nothing_is_refused():
    with pytest.raises(ValueError, match="mass"):
        dataclasses.replace(HELD, mass_g=0.0)
    refused = dataclasses.replace(HELD.contract, force_n=None, limit_n=None, refused="drop it")
    with pytest.raises(ValueError, match="drop it"):
        dataclasses.replace(HELD, contract=refused)
