"""Upper limits, however they are said, end below the force that they name."""

import pytest

from policies.contract import read_contract
from tests.fakes.contracts import terms
from tests.policies.instructions.test_quantities import forces

MOSTS = (
    "1 N must not be exceeded",
    "1 N may not be exceeded",
    "1 N is not to be exceeded",
    "1 N is never to be surpassed",
    "1 N must under no circumstances be passed",
    "so that 1 N is never exceeded",
    "1 N is the force that must not be exceeded",
    "no more then 1 N",
    "not more then 1 N",
    "no more tan 1 N",
    "no harder then a newton",
    "stop short of 1 N",
    "stop just below 1 N",
    "more than 1 N is not necessary",
    "more than 1 N is unnecessary",
    "anything above 1 N is banned",
    "more than 1 N makes no sense",
    "close to 1 N but not over",
    "1 N without going over",
    "1 N but softer",
    "do not, under any circumstances, exceed 1 N",
    "without reaching 1 N",
    "don't get to 1 N",
    "do not let it reach 1 N",
    "a force that never tops 1 N",
    "it must not overshoot 1 N",
    "topping out at 1 N",
    "peaking at 1 N",
    "restricted to 1 N",
    "the force may rise to 1 N",
    "the grip can go up to 1 N",
    "1 N >= force",
    "1 N > F",
    "Fmax 1 N",
    "1 N is the upper limit",
)
FAILURES = (
    "the last one broke at 2 N",
    "it broke at 2 N last time",
    "with 2 N it broke",
    "at 2 N the last one split",
    "2 N was too much last time",
    "2 N was too hard",
    "we tried 2 N and it was too much",
    "2 N is forbidden",
    "2 N is not allowed",
    "2 N is not an option",
    "2 N damages the skin",
    "2 N crushed the last one",
    "2 N left a mark",
)
RANGES = (
    "not below 0.5 N or above 1 N",
    "never above 1 N or below 0.5 N",
    "avoid going below 0.5 N or above 1 N",
    "do not use more than 1 N or less than 0.5 N",
    "not under 0.5 N and not over 1 N",
    "0.5 N lower bound, 1 N upper bound",
    "0.5 N <= F <= 1 N",
    "do not go outside 0.5 to 1 N",
    "between half a newton and one",
    "at least half a newton, at most one",
)


@pytest.mark.parametrize(
    ("text", "most_n"), [*((text, 1.0) for text in MOSTS), *((text, 2.0) for text in FAILURES)]
)
def test_a_stated_upper_limit_is_kept_one_percent_below(text, most_n):
    contract = read_contract(text, terms(), {})
    assert contract.refused == ""
    assert contract.limit_n == pytest.approx(0.99 * most_n)


@pytest.mark.parametrize("text", RANGES)
def test_a_denial_counts_for_both_ends_of_a_range(text):
    assert sorted(forces(text)) == [("least", 0.5), ("most", 1.0)]


def test_a_scale_that_is_said_once_counts_for_both_ends():
    found = sorted(forces("between two and three hundred millinewtons"))
    assert found == [("least", pytest.approx(0.2)), ("most", pytest.approx(0.3))]


@pytest.mark.parametrize(
    "text",
    [
        "no less and no more than 1 N",
        "no more and no less than 1 N",
        "neither more nor less than 1 N",
        "at least 1 N, at most 1 N",
    ],
)
def test_the_same_force_as_most_and_least_is_about_that_force_and_no_more(text):
    contract = read_contract(text, terms(), {})
    assert contract.force_n is not None
    assert (contract.force_n.low, contract.force_n.high) == pytest.approx((0.86, 0.99))
    assert contract.limit_n == pytest.approx(0.99)


@pytest.mark.parametrize(
    "text",
    [
        "not between 0.5 and 1 N",
        "outside of 0.5 to 1 N",
        "never 0.5 to 1 N",
        "not in the range 1 to 2 N",
        "exclude 0.5 to 1 N",
        "by no means use 1 N",
    ],
)
def test_a_range_that_is_only_denied_is_refused(text):
    assert "what not to hold with" in read_contract(text, terms(), {}).refused


@pytest.mark.parametrize(
    "text",
    [
        "hold it at 1 N peak",
        "1 N peak force",
        "1 N (peak)",
        "only 1 N is allowed",
        "permitted force 1 N",
        "not more 1 N please",
        "must not exceed 1 N",
        "1 N is as high as I'd go",
        "stay on the safe side of 1 N",
        "1 N in case it slips",
    ],
)
def test_a_most_in_other_words_is_one(text):
    assert forces(text) == [("most", 1.0)]
    assert read_contract(text, terms(), {}).refused == ""


@pytest.mark.parametrize(
    "text",
    [
        "bring it up to 1 N",
        "raise the force to 1 N",
        "you may hold it with 1 N",
        "1 N is allowed",
        "1 N is needed",
        "1 N is not too much",
        "1 N was right last time",
        "use 1 N, the berry is soft",
        "squeeze to 1 N then lift",
        "press harder, then 1 N",
    ],
)
def test_a_force_that_bounds_nothing_stays_the_target(text):
    assert forces(text) == [("value", 1.0)]


@pytest.mark.parametrize("text", ["do not stop short of 1 N", "0.5 N was not enough"])
def test_a_least_force_stays_one(text):
    assert [kind for kind, _ in forces(text)] == ["least"]


@pytest.mark.parametrize(
    ("text", "low_n", "high_n", "most_n"),
    [
        ("Work in the 0.4-0.8 N band, with a hard stop at 1.5 N.", 0.4, 0.8, 1.5),
        ("1 to 2 newtons, stop at three.", 1, 2, 3),
        ("Between 0.5 and 1 N, never above 1.4 N.", 0.5, 1, 1.4),
        ("Between 0.5 and 1 N, never above 1 N.", 0.5, 0.9, 1),
        ("Between 1 and 2 N, at most 1.5 N.", 1, 1.35, 1.5),
        ("0.4 to 0.8 N; the last one cracked at 1.5 N.", 0.4, 0.72, 0.8),
    ],
)
def test_a_limit_beside_a_range_may_lie_above_it(text, low_n, high_n, most_n):
    contract = read_contract(text, terms(), {}).terms
    assert (contract.force_n.low, contract.force_n.high) == pytest.approx((low_n, high_n))
    assert contract.limit_n == pytest.approx(0.99 * most_n)


@pytest.mark.parametrize(
    "text", ["I do not want you to not exceed 1 N.", "I do not want you to never go over 1 N."]
)
def test_a_bound_that_is_denied_twice_is_refused(text):
    assert "denies a bound twice" in read_contract(text, terms(), {}).refused


@pytest.mark.parametrize(
    "text",
    [
        "If you feel 4 N on the peg you have gone too far.",
        "The moment the peg's force hits 4 N you have overdone it.",
        "You've gone too far if you hit 4 N.",
        "Going beyond 4 N on the peg is going too far.",
        "At 4 N you are squeezing too hard.",
    ],
)
def test_a_force_that_is_too_far_bounds_the_grip(text):
    assert forces(text) == [("most", 4.0)]
