"""Numbers in words come back as the same numbers in digits."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from policies.instructions.quantities.numerals import in_digits
from tests.policies.instructions.number_words import decimal_in_words, in_words


@given(
    number=st.integers(0, 9999),
    link=st.sampled_from([" ", " and "]),
    dash=st.sampled_from([" ", "-"]),
)
def test_every_whole_number_in_words_is_read_as_that_number(number, link, dash):
    said = in_words(number, link=link, dash=dash)
    assert in_digits(f"{said} newtons") == f"{number} newtons"


@given(whole=st.integers(0, 120), digits=st.from_regex(r"[0-9]{1,4}", fullmatch=True))
def test_every_decimal_in_words_is_read_as_that_decimal(whole, digits):
    assert in_digits(f"{decimal_in_words(whole, digits)} newtons") == f"{whole}.{digits} newtons"


@pytest.mark.parametrize(
    ("said", "digits"),
    [
        ("half a newton", "0.5 newton"),
        ("a quarter of a newton", "0.25 newton"),
        ("three quarters of a newton", "0.75 newton"),
        ("two and a half newtons", "2.5 newtons"),
        ("a newton and a half", "1.5 newtons"),
        ("one and three quarters newtons", "1.75 newtons"),
        ("point five newtons", "0.5 newtons"),
        ("zero point oh five newtons", "0.05 newtons"),
        ("twelve hundred millinewtons", "1200 millinewtons"),
        ("a hundred and twenty grams of force", "120 grams of force"),
        ("two to three hundred millinewtons", "200 to 300 millinewtons"),
        ("twenty two to three hundred millinewtons", "22 to 300 millinewtons"),
        ("five to one hundred millinewtons", "5 to 100 millinewtons"),
    ],
)
def test_fractions_and_colloquial_numbers_are_read_as_people_mean_them(said, digits):
    assert in_digits(said) == digits


@given(number=st.integers(0, 99999), places=st.integers(0, 3))
def test_digits_stay_as_they_are(number, places):
    text = f"hold it with {number / 10**places:.{places}f} newtons"
    assert in_digits(text) == text


@pytest.mark.parametrize("text", ["this one", "pick the one on the left", "no one", "the first"])
def test_words_that_only_look_like_numbers_stay(text):
    assert in_digits(text) == text
