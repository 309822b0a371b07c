"""The target of a step: the part of the contract's band that the felt object needs."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from policies import Observation
from policies.contract import read_contract
from policies.contract_steps import TARGET_FACTOR, TargetTracker, needed
from policies.force_terms import FIRMEST
from policies.needs import FeltNeed
from primitives.sense import Interval
from tests.fakes.contracts import BERRY, contract, terms
from tests.fakes.loop_fakes import touch

TASK = replace(terms(), force=BERRY)
OWN = read_contract(TASK.instruction, TASK, {})


def need(least_n: float, most_n: float) -> FeltNeed:
    return FeltNeed(size_mm=30.0, young_mpa=0.2, least_n=least_n, most_n=most_n)


def test_the_target_lies_between_what_holds_and_what_bruises():
    target = needed(OWN, need(0.4, 0.9))
    assert 0.4 < target.low < target.high < 0.9


def test_manner_places_the_target_and_never_beyond_either_end():
    wordings = ("very gently", "gently", "firmly", "very firmly")
    middles = [
        needed(read_contract(f"Hold it {words}.", TASK, {}), need(0.4, 0.9)).middle
        for words in wordings
    ]
    neutral = needed(OWN, need(0.4, 0.9)).middle
    assert middles == sorted(middles)
    assert 0.4 < middles[0] < middles[1] < neutral < middles[2] < middles[3] < 0.9


@given(
    least_n=st.floats(0.02, 10.0),
    ratio=st.floats(1.0, 4.0),
    text=st.sampled_from(
        ["Hold it.", "Hold it firmly.", "Hold it half as hard.", "At most 0.5 N.", "At least 1 N."]
    ),
)
def test_the_contract_bounds_the_target_whatever_is_felt(least_n, ratio, text):
    held = read_contract(text, TASK, {})
    target = needed(held, need(least_n, ratio * least_n))
    assert target.within(held.terms.force_n)
    assert target.high <= held.terms.limit_n
    assert target.high <= TARGET_FACTOR**2 * target.low * (1 + 1e-9)


@given(reach_n=st.floats(0.05, 3.0))
def test_a_target_goes_no_further_than_the_limit_lets_through_unless_less_does_not_hold(reach_n):
    full, target = needed(OWN, need(0.4, 0.9)), needed(OWN, need(0.4, 0.9), reach_n)
    assert target.middle <= full.middle
    assert target.high <= max(reach_n, 0.4 * TARGET_FACTOR) * (1 + 1e-9)
    assert target.middle >= min(full.middle, 0.4) * (1 - 1e-9)
    if reach_n >= full.high:
        assert target == full


@pytest.mark.parametrize("text", ["Hold it with 1 N.", "Hold it with 0.5 to 1 N."])
def test_a_force_that_is_named_is_itself_the_target(text):
    assert read_contract(text, TASK, {}).needs == ""


def test_a_configured_band_is_itself_the_target():
    assert read_contract(TASK.instruction, TASK, {"force_n": BERRY.force_n}).needs == ""


def test_what_words_or_configuration_bound_is_still_placed_by_touch():
    assert read_contract("Hold it with at most 0.5 N.", TASK, {}).needs == "strawberry"
    assert read_contract(TASK.instruction, TASK, {"limit_n": 2.0}).needs == "strawberry"


def felt_grip(felt_n: float | None) -> Observation:
    felt = None if felt_n is None else Interval(value=felt_n, low=felt_n / 1.4, high=felt_n * 1.4)
    return Observation(
        cloud=touch(), in_contact=True, width_m=0.03, commanded_force_n=0.3, felt_force_n=felt
    )


def test_an_aim_narrows_the_band_and_leaves_the_limit():
    aimed, words = TargetTracker().contract_at(OWN, felt_grip(0.3))
    assert aimed.terms.force_n.within(OWN.terms.force_n)
    assert aimed.terms.limit_n == OWN.terms.limit_n
    assert "mm wide" in words


def test_without_a_kind_or_a_felt_force_the_contract_is_the_target():
    plain = contract(1.0, 2.0, 2.5)
    assert TargetTracker().contract_at(plain, felt_grip(0.3)) == (plain, "")
    assert TargetTracker().contract_at(OWN, felt_grip(None)) == (OWN, "")


@pytest.mark.parametrize(
    ("origin", "reach_n", "low_n"),
    [
        ("very firm: your words: very firmly", 5.8, 5.8 / TARGET_FACTOR),
        ("very firm: your words: very firmly", 4.0, FIRMEST * 9.0),
        ("very firm: your words: very firmly", 9.0, 5.9),
        ("very firm: your words: very firmly", None, 5.9),
        ("your words: 6 N", 5.8, 5.9),
        ("gentle: your words: gently", 5.8, 5.9),
        ("the task", 5.8, 5.9),
    ],
)
def test_a_firm_manner_yields_to_what_the_limit_lets_through(
    origin: str, reach_n: float | None, low_n: float
):
    firm = contract(5.9, 8.3, 9.0)
    firm = replace(firm, origins={**firm.origins, "force_n": origin}, needs="")
    aimed, words = TargetTracker().contract_at(firm, felt_grip(0.3), reach_n)
    assert (aimed.terms.force_n.low, aimed.terms.force_n.high) == pytest.approx((low_n, 8.3))
    assert aimed.limit_n == 9.0
    assert bool(words) == (low_n < 5.9)
