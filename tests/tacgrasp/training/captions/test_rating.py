"""The rating of captions by the rule: hand-made texts with known ratings."""

from dataclasses import replace

import pytest

from cltp.tactile.states import NO_CONTACT_STATE, Position
from policies.llm.text import caption_text
from tacgrasp.training.captions.rating import rate_caption, words_of
from tests.fakes.tiny_weights import state

TRUTH = replace(state(4.0, -3.0, 0.6, 2.0), area_fraction=0.12)
WORDS = (
    f"a smooth sphere object, pressed {TRUTH.depth} in {TRUTH.position} with {TRUTH.area} "
    "contact area."
)
NUMBERS = "0.60 mm, 2.00 N, 12 %, x +4.0, y -3.0."


def rating(text: str) -> float:
    return rate_caption(text, TRUTH).rating


def test_the_reference_is_right_in_all() -> None:
    assert rating(caption_text(TRUTH)) == 5.0
    assert rating(f"{WORDS} {NUMBERS}") == 5.0
    assert rating(WORDS) == 5.0


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (f"{WORDS} {NUMBERS}".replace("sphere", "cuboid"), 1 + 4 * 9 / 10),
        (f"{WORDS} {NUMBERS}".replace("smooth sphere", "rough cuboid"), 1 + 4 * 8 / 10),
        (WORDS.replace("smooth ", ""), 1 + 4 * 4 / 5),  # a word that is left out is wrong
        (f"{WORDS} {NUMBERS}".replace("2.00 N", "5.00 N"), 1 + 4 * 9 / 10),
        (f"{WORDS} 0.60 mm, 5.00 N.", 1 + 4 * 6 / 7),  # the numbers that are said alone
        ("no contact. 0.00 mm, 0.00 N.", 1.0),
    ],
)
def test_a_rating_is_one_and_four_times_the_fraction_of_right_words_and_numbers(
    text: str, expected: float
) -> None:
    assert rating(text) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("said", "is_right"),
    [
        ("0.66 mm, 2.00 N", True),  # 10 % of 0.60
        ("0.67 mm, 2.00 N", False),
        ("0.60 mm, 2.20 N", True),  # 10 % of 2.00
        ("0.60 mm, 2.21 N", False),
        ("0.60 mm, 2.00 N, 13.2 %", True),
        ("0.60 mm, 2.00 N, 13.3 %", False),
        ("0.60 mm, 2.00 N, 12 %, x +4.5, y -3.0", True),  # 0.5 mm
        ("0.60 mm, 2.00 N, 12 %, x +4.6, y -3.0", False),
        ("0.60 mm, 2.00 N, 12 %, x +4.0, y -2.4", False),
    ],
)
def test_a_number_is_right_within_its_margin(said: str, is_right: bool) -> None:
    rated = rate_caption(f"{WORDS} {said}.", TRUTH)
    assert len(rated.numbers) == 2 + ("%" in said) + 2 * ("x" in said)
    assert sum(not right for right in rated.numbers.values()) == (0 if is_right else 1)


def test_an_interval_counts_neither_way_and_is_held_against_the_truth() -> None:
    rated = rate_caption(f"{WORDS} 0.50-0.70 mm, 2.20-3.00 N, 8.0-14 %, x +4.0, y -3.0.", TRUTH)
    assert rated.rating == 5.0
    assert rated.numbers == {"x_mm": True, "y_mm": True}
    assert rated.ranges == {"depth_mm": True, "force_n": False, "area_fraction": True}
    assert words_of(f"{WORDS} {NUMBERS}") == WORDS


@pytest.mark.parametrize(
    ("light", "is_right"), [("0.06 mm, 0.13 N", True), ("0.07 mm, 0.05 N", False)]
)
def test_small_numbers_have_a_margin_of_their_own(light: str, is_right: bool) -> None:
    truth = replace(TRUTH, depth_mm=0.015, force_n=0.04)
    assert all(rate_caption(f"{WORDS} {light}.", truth).numbers.values()) == is_right


@pytest.mark.parametrize(
    "text",
    [
        "",
        "It is round and smooth.",
        WORDS.replace("sphere", "banana"),
        "0.60 mm, 2.00 N, 12 %, x +4.0, y -3.0.",
        f"{WORDS} The robot should move down.",
        f"{WORDS} {NUMBERS} {WORDS}",
    ],
)
def test_a_text_that_is_no_caption_is_rated_one(text: str) -> None:
    rated = rate_caption(text, TRUTH)
    assert rated.rating == 1.0
    assert rated.is_malformed


def test_without_contact_right_is_to_say_so() -> None:
    assert rate_caption("no contact. 0.00 mm, 0.00 N.", NO_CONTACT_STATE).rating == 5.0
    wrong = rate_caption(f"{WORDS} {NUMBERS}", NO_CONTACT_STATE)
    assert wrong.rating == 1.0
    assert not wrong.is_malformed


def test_a_word_that_the_contact_has_none_of_does_not_count() -> None:
    truth = replace(TRUTH, texture=None)
    assert len(rate_caption(WORDS, truth).words) == 4
    assert rate_caption(WORDS.replace("sphere", "cuboid"), truth).rating == 1 + 4 * 3 / 4


def test_cut_sides_may_be_said_and_do_not_count() -> None:
    assert rating(f"{WORDS} {NUMBERS.removesuffix('.')}, cut left top.") == 5.0


def test_the_truth_has_the_words_of_its_numbers() -> None:
    assert TRUTH.position is not Position.CENTERED
