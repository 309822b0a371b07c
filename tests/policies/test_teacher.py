"""The teacher: one hand-made contact for each rule, and the order between rules."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import ContactState, Side, area_word, depth_word, position_word
from policies.goal import Goal
from policies.teacher import LESSON_MOVE_STEP_MM, SLIVER_FRACTION, Advice, Reason, teacher
from primitives import Primitive
from primitives.contract import Band
from primitives.execution import INCREASE_FACTOR
from primitives.primitive import PAD_DIRECTION

GOAL = Goal(
    force_n=Band(low=1.0, high=2.0),
    depth_mm=Band(low=0.1, high=0.6),
    area_fraction=Band(low=0.05, high=0.6),
    x_mm=Band(low=-2.5, high=2.5),
    y_mm=Band(low=-2.0, high=2.0),
)
STEP_MM = LESSON_MOVE_STEP_MM
NOTHING = ContactState(
    depth_mm=0, x_mm=0, y_mm=0, area_fraction=0, force_n=0, depth=None, position=None, area=None
)


def touch(*, x=0.0, y=0.0, depth=0.3, share=0.1, force=1.5, cut=()) -> ContactState:
    return ContactState(
        depth_mm=depth,
        x_mm=x,
        y_mm=y,
        area_fraction=share,
        force_n=force,
        depth=depth_word(depth),
        position=position_word(x, y, sensor_named("gelsight_mini")),
        area=area_word(share),
        cut=frozenset(cut),
    )


def advise(state: ContactState, goal: Goal) -> Advice:
    return teacher(state, goal, move_step_mm=STEP_MM)


TOUCHES = st.builds(
    touch,
    x=st.floats(-10, 10),
    y=st.floats(-7.5, 7.5),
    depth=st.floats(0.05, 1.4),
    share=st.floats(0.001, 0.9),
    force=st.floats(0.05, 10),
    cut=st.sets(st.sampled_from(list(Side))),
)


@pytest.mark.parametrize(
    ("state", "action", "reason"),
    [
        (NOTHING, Primitive.RESET, Reason.NO_CONTACT),
        (touch(y=-7, share=0.003, cut=[Side.BOTTOM]), Primitive.RESET, Reason.OVER_THE_EDGE),
        (touch(y=-7, share=0.005, cut=[Side.BOTTOM]), Primitive.MOVE_DOWN, Reason.OFF_CENTER),
        (touch(y=-5), Primitive.MOVE_DOWN, Reason.OFF_CENTER),
        (touch(y=5), Primitive.MOVE_UP, Reason.OFF_CENTER),
        (touch(x=-5), Primitive.MOVE_LEFT, Reason.OFF_CENTER),
        (touch(x=5), Primitive.MOVE_RIGHT, Reason.OFF_CENTER),
        # Excess over half-width: x (5 - 2.5) / 2.5 = 1, y (4.5 - 2) / 2 = 1.25.
        (touch(x=5, y=4.5), Primitive.MOVE_UP, Reason.OFF_CENTER),
        (touch(x=6, y=4.5), Primitive.MOVE_RIGHT, Reason.OFF_CENTER),
        (touch(force=2.1), Primitive.DECREASE_FORCE, Reason.TOO_FIRM),
        (touch(depth=0.61), Primitive.DECREASE_FORCE, Reason.TOO_FIRM),
        (touch(share=0.61), Primitive.DECREASE_FORCE, Reason.TOO_FIRM),
        (touch(force=0.9), Primitive.INCREASE_FORCE, Reason.TOO_LIGHT),
        (touch(share=0.04, force=1.2), Primitive.INCREASE_FORCE, Reason.TOO_LIGHT),
        (touch(depth=0.09, force=1.2), Primitive.INCREASE_FORCE, Reason.TOO_LIGHT),
        (touch(y=1.8, cut=[Side.TOP]), Primitive.MOVE_UP, Reason.CUT),
        (touch(x=-2, cut=[Side.LEFT]), Primitive.MOVE_LEFT, Reason.CUT),
    ],
)
def test_each_contact_gets_the_advice_worked_out_by_hand(state, action, reason):
    advice = advise(state, GOAL)
    assert (advice.action, advice.success, advice.reason) == (action, False, reason)


def test_a_contact_inside_every_band_is_success_without_action():
    advice = advise(touch(), GOAL)
    assert (advice.action, advice.success, advice.reason) == (None, True, Reason.GOOD)


def test_the_papers_example_is_followed():
    first = advise(touch(y=-5, force=1.5), GOAL)  # 'bottom-center' -> down
    second = advise(touch(force=2.5), GOAL)  # 'centered but too firm' -> less force
    assert [first.action, second.action] == [Primitive.MOVE_DOWN, Primitive.DECREASE_FORCE]
    assert advise(touch(), GOAL).success


def test_too_firm_comes_before_moving_and_moving_before_too_light():
    assert advise(touch(x=8, force=3), GOAL).action is Primitive.DECREASE_FORCE
    assert advise(touch(x=8, force=0.3), GOAL).action is Primitive.MOVE_RIGHT


def test_an_increase_that_would_overshoot_is_not_advised():
    narrow = replace(GOAL, force_n=Band(low=1.0, high=1.2))
    advice = advise(touch(force=1.1, depth=0.05), narrow)  # too shallow, 1.1 * 1.5 = 1.65 > 1.2
    assert (advice.action, advice.success, advice.reason) == (
        None,
        False,
        Reason.BAND_TOO_NARROW,
    )
    deep = touch(force=0.9, depth=0.47)  # 0.47 * 1.5^(2/3) = 0.616 > 0.6
    assert advise(deep, GOAL).reason is Reason.BAND_TOO_NARROW


def test_a_band_narrower_than_a_step_is_reached_by_the_executors_own_step_into_it():
    narrow = replace(GOAL, force_n=Band(low=1.0, high=1.2))
    for force_n in (0.3, 0.79, 0.95):  # to 0.45, 1.1 and 1.1 N
        assert advise(touch(force=force_n), narrow).action is Primitive.INCREASE_FORCE
    assert advise(touch(force=0.0), narrow).action is Primitive.INCREASE_FORCE  # not felt at all


def test_a_move_that_would_not_come_nearer_is_not_advised():
    narrow = replace(GOAL, x_mm=Band(low=-1, high=1))
    assert advise(touch(x=1.4), narrow).reason is Reason.BAND_TOO_NARROW  # would come to -1.6
    assert advise(touch(x=1.6), narrow).action is Primitive.MOVE_RIGHT  # comes to -1.4


def test_a_contact_cut_on_both_sides_is_too_large_for_the_pad_not_off_centre():
    assert advise(touch(y=1.8, cut=[Side.TOP, Side.BOTTOM]), GOAL).success


@given(TOUCHES)
def test_a_move_always_brings_the_contact_nearer_to_its_band(state):
    advice = advise(state, GOAL)
    if advice.action not in PAD_DIRECTION:
        return
    dx, dy = PAD_DIRECTION[advice.action]
    middle = np.zeros(2)  # both bands are symmetric
    here = np.array([state.x_mm, state.y_mm])
    then = here - STEP_MM * np.array([dx, dy])
    assert np.linalg.norm(then - middle) < np.linalg.norm(here - middle)


@given(TOUCHES)
def test_success_means_every_band_and_an_action_means_no_success(state):
    advice = advise(state, GOAL)
    inside = (
        state.force_n in GOAL.force_n
        and state.depth_mm in GOAL.depth_mm
        and state.area_fraction in GOAL.area_fraction
        and state.x_mm in GOAL.x_mm
        and state.y_mm in GOAL.y_mm
    )
    assert not advice.success or (inside and advice.action is None)
    if inside and not state.cut:
        assert advice.success


@given(TOUCHES)
def test_the_force_never_goes_up_into_a_limit(state):
    if advise(state, GOAL).action is Primitive.INCREASE_FORCE:
        assert state.force_n * INCREASE_FACTOR <= GOAL.force_n.high


@given(st.floats(-7.5, 7.5), st.sets(st.sampled_from([Side.TOP, Side.BOTTOM])))
def test_two_moves_never_undo_each_other(y, cut):
    first = advise(touch(y=y, cut=cut), GOAL)
    if first.action not in (Primitive.MOVE_UP, Primitive.MOVE_DOWN):
        return
    step = STEP_MM if first.action is Primitive.MOVE_UP else -STEP_MM
    back = {Primitive.MOVE_UP: Primitive.MOVE_DOWN, Primitive.MOVE_DOWN: Primitive.MOVE_UP}
    for then_cut in ([], [Side.TOP], [Side.BOTTOM]):
        second = advise(touch(y=y - step, cut=then_cut), GOAL)
        assert second.action is not back[first.action]


def test_the_sliver_is_a_millimetre_or_so_of_a_gelsight_mini():
    assert SLIVER_FRACTION * sensor_named("gelsight_mini").area_mm2 == pytest.approx(1.2, abs=0.1)


def test_the_length_of_a_step_decides_whether_a_move_helps():
    narrow = replace(GOAL, x_mm=Band(low=-1.5, high=1.5))
    state = touch(x=2.0)  # 3 mm bring it to -1.0, 5 mm to -3.0, 4 mm to -2.0: as far off as before
    assert teacher(state, narrow, move_step_mm=3.0).action is Primitive.MOVE_RIGHT
    for step_mm in (4.0, 5.0):
        advice = teacher(state, narrow, move_step_mm=step_mm)
        assert (advice.action, advice.reason) == (None, Reason.BAND_TOO_NARROW)
