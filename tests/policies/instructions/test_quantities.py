"""Forces in a sentence: what they come to in newtons, and whether they bound it."""

from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from policies.contract import read_contract
from policies.instructions.quantities.force_units import GRAM_N
from policies.instructions.reader import read_request
from tests.fakes.contracts import terms
from tests.policies.instructions.number_words import decimal_in_words, in_words

UNITS = {
    "N": 1.0,
    "newtons": 1.0,
    "Newton": 1.0,
    "mN": 1e-3,
    "millinewtons": 1e-3,
    "gf": GRAM_N,
    "grams of force": GRAM_N,
    "gram-force": GRAM_N,
    "kgf": 1000 * GRAM_N,
    "kilograms of force": 1000 * GRAM_N,
    "kp": 1000 * GRAM_N,
    "uN": 1e-6,
    "µN": 1e-6,
    "daN": 10.0,
    "dyn": 1e-5,
}
SENTENCES = (
    "Hold it with {}.",
    "Pick the strawberry, {}.",
    "Please, robot, grip the ripe red berry from the bowl with {}, and keep it there.",
    "I would like you to grasp the fruit now; {}.",
    "Use {} of force to lift it, would you?",
    "{}, hold it.",
)
MOSTS = (
    "at most {}",
    "no more than {}",
    "not more than {}",
    "never more than {}",
    "never above {}",
    "not above {}",
    "below {}",
    "under {}",
    "less than {}",
    "up to {}",
    "without exceeding {}",
    "a maximum of {}",
    "{} at most",
    "{} or less",
    "{} max",
)
LEASTS = (
    "at least {}",
    "no less than {}",
    "not less than {}",
    "never less than {}",
    "not below {}",
    "never below {}",
    "never under {}",
    "above {}",
    "over {}",
    "more than {}",
    "a minimum of {}",
    "{} at least",
    "{} or more",
)
RANGES = (
    "between {} and {} N",
    "{} to {} newtons",
    "{}-{} N",
    "{} – {} N",
    "from {} N to {} N",
    "at least {} N but at most {} N",
    "no less than {} N and no more than {} N",
)

sentences = st.sampled_from(SENTENCES)
hundredths = st.integers(1, 2000)


def forces(text: str) -> list[tuple[str, float]]:
    return [(force.kind, force.value_n) for force in read_request(text).numbers.forces]


def written(hundredth: int, unit: str) -> tuple[str, float]:
    """A number near the force in the unit, and the force that it means [N]."""
    size = UNITS[unit]
    number = f"{Decimal(f'{hundredth / 100 / size:.4g}'):f}"
    return number, float(number) * size


@given(sentence=sentences, hundredth=hundredths, unit=st.sampled_from(list(UNITS)))
def test_a_number_with_a_unit_of_force_means_that_force(sentence, hundredth, unit):
    number, force_n = written(hundredth, unit)
    assert forces(sentence.format(f"{number} {unit}")) == [("value", pytest.approx(force_n))]


@given(sentence=sentences, hundredth=hundredths)
def test_a_decimal_comma_and_a_missing_space_change_nothing(sentence, hundredth):
    number = f"{hundredth / 100:g}"
    expected = [("value", pytest.approx(hundredth / 100))]
    assert forces(sentence.format(f"{number}N")) == expected
    assert forces(sentence.format(f"{number.replace('.', ',')} N")) == expected


@given(sentence=sentences, whole=st.integers(0, 40), digits=st.sampled_from(["", "5", "25", "05"]))
def test_a_number_in_words_means_the_same_as_in_digits(sentence, whole, digits):
    said = decimal_in_words(whole, digits) if digits else in_words(whole)
    assert forces(sentence.format(f"{said} newtons")) == [
        ("value", pytest.approx(float(f"{whole}.{digits or 0}")))
    ]


@given(sentence=sentences, most=st.sampled_from(MOSTS), hundredth=hundredths)
def test_every_way_to_say_at_most_bounds_from_above(sentence, most, hundredth):
    text = sentence.format(most.format(f"{hundredth / 100:g} N"))
    assert forces(text) == [("most", pytest.approx(hundredth / 100))], text


@given(sentence=sentences, least=st.sampled_from(LEASTS), hundredth=hundredths)
def test_every_way_to_say_at_least_bounds_from_below(sentence, least, hundredth):
    text = sentence.format(least.format(f"{hundredth / 100:g} N"))
    assert forces(text) == [("least", pytest.approx(hundredth / 100))], text


@given(
    sentence=sentences,
    words=st.sampled_from(RANGES),
    low=st.integers(1, 900),
    wide=st.integers(5, 900),
)
def test_a_range_is_a_least_and_a_most(sentence, words, low, wide):
    text = sentence.format(words.format(f"{low / 100:g}", f"{(low + wide) / 100:g}"))
    expected = [low / 100, (low + wide) / 100]
    found = sorted(forces(text))
    assert [kind for kind, _ in found] == ["least", "most"], text
    assert [value for _, value in found] == pytest.approx(expected)


UNIT_SAID_ONCE = (
    "between {} N and {}",
    "from {} N to {}",
    "at least {} N but at most {}",
    "no less than {}, no more than {} N",
    "over {} and under {} N",
    "above {} N, never above {}",
    "{} N minimum and {} maximum",
)


@given(
    sentence=st.sampled_from(SENTENCES[:3]),
    words=st.sampled_from(UNIT_SAID_ONCE),
    low=st.integers(1, 900),
    wide=st.integers(5, 900),
)
def test_a_unit_that_is_said_once_counts_for_both_numbers(sentence, words, low, wide):
    text = sentence.format(words.format(f"{low / 100:g}", f"{(low + wide) / 100:g}"))
    found = sorted(forces(text))
    assert [kind for kind, _ in found] == ["least", "most"], text
    assert [value for _, value in found] == pytest.approx([low / 100, (low + wide) / 100])


@given(
    sentence=st.sampled_from(SENTENCES[:3]),
    said=st.sampled_from(
        [
            ("half of {} N", 0.5),
            ("twice {} N", 2),
            ("a third of {} newtons", 1 / 3),
            ("1.5 times {} N", 1.5),
            ("80 % of {} N", 0.8),
            ("20 % more than {} N", 1.2),
            ("10 percent below {} N", 0.9),
            ("twice as much as {} N", 2),
            ("3 times more than {} N", 3),
            ("a quarter less than {} N", 0.75),
            ("10 % off {} N", 0.9),
        ]
    ),
    hundredth=hundredths,
)
def test_a_multiple_of_a_force_is_that_force(sentence, said, hundredth):
    words, factor = said
    text = sentence.format(words.format(f"{hundredth / 100:g}"))
    expected = pytest.approx(factor * hundredth / 100, rel=1e-4)
    assert forces(text) == [("value", expected)], text


@given(hundredth=hundredths)
def test_a_number_of_another_quantity_gets_no_unit_of_force(hundredth):
    slip = f"{hundredth / 1000:g}"
    assert forces(f"Hold it with 1 N, slip at most {slip} mm.") == [("value", 1.0)]
    assert forces(f"Hold it with 1 N, slip at most 0.3 mm, never above {slip}.") == [("value", 1.0)]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Never hold it with 0.5 N.", "0.5 n"),
        ("Don't go over 2 N.", ""),
        ("Don't use 2 N, use 0.5 N.", ""),
        ("Don't let it slip, 0.5 N should do.", ""),
        ("Don't hesitate to use 0.5 N.", ""),
    ],
)
def test_a_force_that_is_only_denied_is_reported(text, words):
    assert read_request(text).numbers.denied == words


def test_a_negative_force_keeps_its_sign_in_the_words():
    assert read_request("Pick it up with -1 N.").numbers.forces[0].words == "-1 n"


@pytest.mark.parametrize(
    ("text", "factor"),
    [
        ("Hold it half as hard.", 0.5),
        ("Grip it twice as hard.", 2.0),
        ("Hold it, no more than twice the usual force.", 1.0),
        ("Squeeze it up to three times as hard.", 1.0),
        ("Hold it with no more than half the usual force.", 0.5),
        ("Squeeze it three times as hard as usual.", 3.0),
    ],
)
def test_a_factor_on_the_usual_force_is_read_as_one(text, factor):
    assert read_request(text).numbers.factor == pytest.approx(factor)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("It must not be gripped twice as hard.", "twice as hard"),
        ("Never hold it 30 % harder than usual.", "30 % harder"),
        ("Do not hesitate to grip it twice as hard.", ""),
        ("Never let it slip and grip it twice as hard.", ""),
        ("Do not drop it, grip it twice as hard.", ""),
    ],
)
def test_a_factor_that_is_only_denied_is_reported(text, words):
    assert read_request(text).numbers.denied == words


@pytest.mark.parametrize(
    ("text", "factor"),
    [
        ("Two times harder.", 2.0),
        ("Squeeze it three times harder.", 3.0),
        ("Twice firmer than usual.", 2.0),
        ("Four times softer.", 0.25),
    ],
)
def test_a_multiple_keeps_its_number(text, factor):
    assert read_request(text).numbers.factor == pytest.approx(factor)


@pytest.mark.parametrize(
    ("text", "force_n"),
    [
        ("1 N minus 10 %", 0.9),
        ("Hold it with 1 N plus 20 percent.", 1.2),
        ("2 N less 0.4 N", 1.6),
        ("0.8 N plus 0.3 N plus 0.1 N", 1.2),
    ],
)
def test_a_sum_of_forces_or_percent_is_worked_out(text, force_n):
    assert forces(text) == [("value", pytest.approx(force_n))]


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("Hold it with 1 Nm.", "'nm' is no unit of force; say N"),
        ("Hold it with 2 kips.", "'kips' is no unit of force; say N"),
        ("Hold it with 0.8 M.", "'m' is no unit of force; say N"),
        ("At most 0.8 M of force", "'m' is no unit of force; say N"),
        ("Grab it with 10 Hz", "'hz' is no unit of force; say N"),
        ("At most 3 poundals.", "'poundals' is no unit of force; say N"),
        ("Apply 1.5 joules.", "'joules' is no unit of force; say N"),
        ("Hold it with 1O N.", "'o' is no unit of force; say N"),
        ("Raise it slowly by 0.2 N/s.", "'n/s' is no unit of force; say N"),
        ("Hold it with 1.2.3 N.", "'1.2.3' is no number"),
        ("Hold it with 1.2.3.", "'1.2.3' is no number"),
        ("2^2 N", "'2^2 n' is a formula"),
        ("Hold it with 0.5² N.", "is a formula"),
        ("sqrt(2) N", "is a formula"),
        ("1/0.5 N", "is a formula"),
        ("2 N * 0.5", "is a formula"),
        ("2*3 N", "is a formula"),
        ("(1+1) N", "is a formula"),
        ("√2 N", "is a formula"),
        ("2 x 3 N", ""),
        ("1e99999 N", "is no force"),
        ("Hold it with 1/2 N.", ""),
        ("Hold it with 1e3 mN.", ""),
        ("Hold it with 2 fingers.", ""),
        ("Try at most 3 attempts, with 1 N.", ""),
        ("Come at 3 o'clock and hold it with 1 N.", ""),
        ("Hold it with two thirds of the usual force.", ""),
    ],
)
def test_a_number_of_an_unknown_unit_or_a_malformed_one_is_reported(text, named):
    unread = read_request(text).numbers.unread
    assert (named in unread) if named else unread == ""


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("grip strength 5", "5"),
        ("Grip strength: 5", "5"),
        ("strength of 0.5", "0.5"),
        ("Hold it at level 3.", "3"),
        ("Set the intensity to 4.", "4"),
        ("Grip it at 7 out of 10.", "7"),
        ("Hold it with 3/10.", "3"),
        ("Hold it at 5.", "5"),
        ("Pick berry 3.", ""),
        ("Use 1 N, berry 2.", ""),
        ("Hold it with 1 N, 3 times.", ""),
        ("Hold it with 1 N for 2.5 s.", ""),
        ("Hold it with 1 N, 0.3 mm of slip at most.", ""),
        ("The last one slid at 0.4, so take 0.7 N.", ""),
        ("Not 2.6, I said 1.6 N.", ""),
        ("Grip strength 1 N.", ""),
    ],
)
def test_a_number_on_a_scale_of_its_own_is_reported(text, number):
    assert read_request(text).numbers.unitless == number


@pytest.mark.parametrize("text", ["1e100 mN", "1e400 N", "1e-400 N"])
def test_no_part_of_a_number_with_a_long_exponent_is_read_as_a_force(text):
    assert read_contract(text, terms(), {}).refused


@pytest.mark.parametrize("text", ["100 grams", "12 oz, please.", "3 ounces!"])
def test_a_mass_that_is_all_that_is_said_is_a_force(text):
    assert [kind for kind, _ in forces(text)] == ["value"]


def test_a_full_stop_within_a_force_ends_nothing():
    assert forces("Hold it with 5. N") == [("value", 5.0)]


def test_a_pressure_and_a_number_without_unit_are_no_forces():
    assert read_request("Hold it at 20 kPa.").numbers.pressure == "20 kpa"
    assert read_request("Hold it with 2.").numbers.unitless == "2"
    assert not forces("Hold it at 20 kPa.")
    assert not forces("Hold it with 2.")


def test_the_weight_of_the_object_is_no_force_to_hold_it_with():
    assert not forces("Pick the 20 g strawberry gently.")
    assert not forces("Hold the berry, it weighs 25 grams.")


def test_slip_depth_and_area_are_read_beside_the_force():
    text = "Hold it with 1.5 N, at most 0.4 mm deep, over 10 % of the pad."
    numbers = read_request(text).numbers
    assert forces(text) == [("value", 1.5)]
    assert numbers.depth_mm == pytest.approx(0.4)
    assert numbers.area_fraction == pytest.approx(0.1)
    assert read_request("Hold it, and let it slip no more than 0.5 mm.").numbers.slip_mm == 0.5


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Hold it with 2 N, at most 2.2 N.", [("value", 2.0), ("most", 2.2)]),
        ("Hold it with 2 N, at least 1.8 N.", [("value", 2.0), ("least", 1.8)]),
        ("Hold it with 1.5 N, no more than 0.4 mm deep.", [("value", 1.5)]),
        ("Hold it with 1.5 N, slipping at most 0.5 mm.", [("value", 1.5)]),
        ("Hold it with 2 N for at least 5 seconds.", [("value", 2.0)]),
        ("1 N minimum, 2 N maximum, hold it.", [("least", 1.0), ("most", 2.0)]),
        ("2 N or less, hold it for 3 seconds.", [("most", 2.0)]),
    ],
)
def test_a_bound_goes_to_its_own_number(text, expected):
    assert sorted(forces(text)) == sorted(expected)
