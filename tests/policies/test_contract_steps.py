"""A step under the contract: its target, what goes beyond, and the objection of a soft contact."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cltp.tactile.states import Area, ContactState, Depth, Position
from policies.contract_steps import CLEARLY, beyond, pressed_too_far, softened, target_of
from primitives import LimitError, Primitive
from primitives.contract import Band, Contract
from primitives.sense import Interval
from tests.fakes.contracts import STRAWBERRY, contract, refused_contract

HELD = ContactState(
    depth_mm=0.3,
    x_mm=0.0,
    y_mm=0.0,
    area_fraction=0.1,
    force_n=1.2,
    depth=Depth.MODERATE,
    position=Position.CENTERED,
    area=Area.MEDIUM,
)
NARROW = replace(
    contract(0.95, 1.9, 2.375),
    x_mm=Band(low=-4.0, high=4.0),
    y_mm=Band(low=-3.0, high=3.0),
    depth_mm=Band(low=0.05, high=0.7),
    area_fraction=Band(low=0.02, high=0.8),
)
HARD = contract(3.6, 7.2, 9.0, soft=STRAWBERRY)


def felt(force_n: float) -> Interval:
    return Interval(value=force_n, low=force_n / 1.3, high=force_n * 1.3)


def why(
    action: Primitive | None,
    *,
    success: bool = False,
    force_n: float | None = 1.2,
    state: ContactState | None = HELD,
    of: Contract = NARROW,
) -> str:
    reading = None if force_n is None else felt(force_n)
    return beyond(of, action, success=success, felt=reading, state=state)


def test_the_target_of_a_step_is_a_part_of_the_contract():
    target = target_of(NARROW)
    assert target.force_n.within(NARROW.terms.force_n)
    assert (target.x_mm, target.y_mm) == (NARROW.x_mm, NARROW.y_mm)
    assert (target.depth_mm, target.area_fraction) == (NARROW.depth_mm, NARROW.area_fraction)
    with pytest.raises(LimitError, match="refused"):
        target_of(refused_contract())


@given(force_n=st.floats(0.05, 20.0), action=st.none() | st.sampled_from(list(Primitive)))
def test_a_decision_is_beyond_exactly_when_it_goes_against_what_is_clearly_felt(force_n, action):
    band = NARROW.terms.force_n
    above, below = force_n / CLEARLY > band.high, force_n * CLEARLY < band.low
    expected = {
        Primitive.INCREASE_FORCE: above,
        Primitive.DECREASE_FORCE: below,
        None: above or below,
    }.get(action, False)
    assert bool(why(action, success=action is None, force_n=force_n)) is expected


@pytest.mark.parametrize("action", list(Primitive))
def test_without_a_felt_force_no_action_is_beyond(action):
    assert why(action, force_n=None) == ""


def test_a_text_without_action_or_success_is_left_to_the_loop():
    assert why(None, success=False, force_n=9.0) == ""


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"x_mm": 6.0}, "x is 6.00"),
        ({"y_mm": -4.5}, "y is -4.50"),
        ({"depth_mm": 1.2}, "depth is 1.20"),
        ({"area_fraction": 0.005}, "area is 0.01"),
    ],
)
def test_a_success_outside_any_band_is_beyond_and_names_it(changes, named):
    assert named in why(None, success=True, state=replace(HELD, **changes))
    assert why(Primitive.MOVE_UP, state=replace(HELD, **changes)) == ""


def test_a_success_within_the_margin_of_the_measurement_stands():
    assert why(None, success=True, state=replace(HELD, x_mm=4.9, depth_mm=0.9)) == ""


def test_a_soft_contact_holds_a_hard_contract_to_the_terms_of_soft_ones():
    held = softened(HARD)
    assert held.terms == STRAWBERRY
    assert held.soft is None
    assert held.origins["force_n"] == held.origins["limit_n"] == "what is felt"
    assert held.assumed[-1] == "what is felt is soft: held to 0.95-1.90 N"
    assert softened(held) is held


def test_a_soft_contact_never_raises_the_limit():
    named = replace(HARD, force_n=Band(low=1.5, high=1.9), limit_n=1.95)
    held = softened(named)
    assert held.terms == replace(STRAWBERRY, limit_n=1.95)
    assert held.origins == {**named.origins, "force_n": "what is felt"}


def test_where_nothing_may_object_the_contract_stays():
    assert softened(NARROW) is NARROW


@pytest.mark.parametrize(
    ("changed", "force_n", "said"),
    [
        ({"depth_mm": 1.0}, 1.2, "1.00 mm deep, the contract has 0.70 mm"),
        ({"depth_mm": 1.0}, None, "1.00 mm deep"),
        ({"depth_mm": 0.8}, 1.2, ""),  # within what the measurement errs
        ({"depth_mm": 1.0}, 2.5, ""),  # too firm, which the force tells
        ({"depth_mm": 1.0}, 0.5, ""),
        ({}, 1.2, ""),
    ],
)
def test_too_deep_a_contact_of_the_right_force_is_known(changed, force_n, said):
    reading = None if force_n is None else felt(force_n)
    found = pressed_too_far(NARROW, reading, replace(HELD, **changed))
    assert (said in found) if said else found == ""


def test_too_large_a_contact_of_the_right_force_is_known():
    small = replace(NARROW, area_fraction=Band(low=0.0, high=0.05))
    assert "10 % of the pad, the contract has 5 %" in pressed_too_far(small, felt(1.2), HELD)
