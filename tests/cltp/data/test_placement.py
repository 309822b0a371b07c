"""Labels of moved contacts, against the same body pressed where the contact was moved to."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from cltp import TouchError
from cltp.data.placement import (
    HALF_TURN,
    LEAST_LEFT,
    Placement,
    draw_placement,
    move,
)
from cltp.data.sampler import mirrored, sampled
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.point_layout import PointLayout
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import (
    AREA_LIMITS,
    DEPTH_LIMITS_MM,
    NO_CONTACT_STATE,
    Shape,
    Side,
    Texture,
)
from sim.tcl3d.labels import label

MINI = SENSORS["gelsight_mini"]
FINE = PointLayout(rows=64, columns=64, is_sampled=True)
ROWS, COLUMNS = 96, 128
PITCH_MM = MINI.width_mm / COLUMNS
X, Y = np.meshgrid(*grid_axes_mm(MINI, ROWS, COLUMNS))


def pressed(x_mm, y_mm, turn_rad=0.0, depth_mm=0.7, long_mm=3.0, short_mm=2.0):
    """An oval cap anywhere, on the pad or partly beside it, and its labels."""
    cos, sin = math.cos(turn_rad), math.sin(turn_rad)
    u, v = cos * (X - x_mm) + sin * (Y - y_mm), cos * (Y - y_mm) - sin * (X - x_mm)
    squared = (u / long_mm) ** 2 + (v / short_mm) ** 2
    heights = (depth_mm * (1 - squared).clip(0)).astype(np.float32)
    state = label(
        height_mm=heights,
        pressure_kpa=heights,
        touching=squared < 1,
        force_n=float(heights.sum()),
        sensor=MINI,
        shape=Shape.ELLIPSOID,
        texture=Texture.SMOOTH,
    )
    return heights, state


inside_x, inside_y = st.floats(-6.5, 6.5), st.floats(-4.0, 4.0)
turns = st.floats(-math.pi, math.pi)


def near_a_limit(value, limits, within):
    return any(abs(value - limit) < within for limit in limits)


@settings(max_examples=80)
@example(x=0.0, y=0.0, t=0.0, dx=0.0, dy=7.53125, turn=0.0)
@given(inside_x, inside_y, turns, st.floats(-11, 11), st.floats(-8, 8), turns)
def test_the_label_of_a_moved_contact_is_that_of_the_body_pressed_there(x, y, t, dx, dy, turn):
    heights, state = pressed(x, y, t)
    placement = Placement(x_mm=dx, y_mm=dy, turn_rad=turn)
    at_x, at_y = placement.moved(x, y)
    assume(abs(at_x) < MINI.width_mm / 2 and abs(at_y) < MINI.height_mm / 2)
    truth_heights, truth = pressed(at_x, at_y, t + turn)
    moved = move(heights, state, MINI, placement)
    np.testing.assert_allclose(moved.height_mm, truth_heights, atol=0.08)
    state_after = moved.state
    assert state_after.depth_mm == pytest.approx(truth.depth_mm, abs=0.01)
    assert state_after.x_mm == pytest.approx(truth.x_mm, abs=0.1)
    assert state_after.y_mm == pytest.approx(truth.y_mm, abs=0.1)
    assert state_after.area_fraction == pytest.approx(truth.area_fraction, abs=0.003)
    # Both forces are sums over rows and columns, and the pad's edge may fall between two of them.
    half_a_line = float(max(heights.sum(axis=0).max(), heights.sum(axis=1).max())) / 2
    assert state_after.force_n == pytest.approx(truth.force_n, rel=0.05, abs=1.0 + half_a_line)
    assert (state_after.shape, state_after.texture) == (state.shape, state.texture)
    if not near_a_limit(state_after.depth_mm, DEPTH_LIMITS_MM, 0.02):
        assert state_after.depth is truth.depth
    if not near_a_limit(state_after.area_fraction, AREA_LIMITS, 0.005):
        assert state_after.area is truth.area
    thirds_x, thirds_y = MINI.width_mm / 6, MINI.height_mm / 6
    if not near_a_limit(abs(state_after.x_mm), [thirds_x], 0.15) and not near_a_limit(
        abs(state_after.y_mm), [thirds_y], 0.15
    ):
        assert state_after.position is truth.position


@settings(max_examples=40)
@given(inside_x, inside_y, turns, st.floats(-3, 3), st.floats(-3, 3))
def test_what_stays_on_the_pad_keeps_depth_area_and_force_exactly(x, y, t, dx, dy):
    assume(max(abs(x), abs(x + dx)) < 6.8 and max(abs(y), abs(y + dy)) < 4.3)
    heights, state = pressed(x, y, t)
    state_after = move(heights, state, MINI, Placement(x_mm=dx, y_mm=dy)).state
    assert (state_after.x_mm, state_after.y_mm) == (state.x_mm + dx, state.y_mm + dy)
    for name in ("depth_mm", "area_fraction", "force_n", "depth", "area", "cut"):
        assert getattr(state_after, name) == getattr(state, name)


@settings(max_examples=30)
@given(st.floats(-11, 11), st.floats(-8, 8), turns)
def test_half_a_turn_is_a_mirror_along_both_axes_for_every_contact(x, y, t):
    heights, state = pressed(x, y, t)
    assume(state.area_fraction > 0.005)
    moved = move(heights, state, MINI, HALF_TURN)
    np.testing.assert_allclose(moved.height_mm, heights[::-1, ::-1], atol=1e-5)
    twin = mirrored(state, MINI, along_x=True, along_y=True)
    assert moved.state.cut == twin.cut
    assert moved.state.x_mm == pytest.approx(twin.x_mm)
    assert moved.state.y_mm == pytest.approx(twin.y_mm)
    assert moved.state.area_fraction == twin.area_fraction


def test_no_move_changes_nothing():
    heights, state = pressed(9.0, 5.0)
    moved = move(heights, state, MINI, Placement())
    assert moved.state == state
    np.testing.assert_allclose(moved.height_mm, heights, atol=1e-6)


def test_a_cut_contact_can_t_be_moved_inwards_but_further_out():
    heights, state = pressed(9.5, 0.0)
    assert state.cut == {Side.RIGHT}
    with pytest.raises(TouchError, match="never measured"):
        move(heights, state, MINI, Placement(x_mm=-3.0))
    with pytest.raises(TouchError, match="never measured"):
        move(heights, state, MINI, Placement(turn_rad=0.5))
    further = move(heights, state, MINI, Placement(x_mm=1.0)).state
    assert further.area_fraction < state.area_fraction
    assert further.cut == {Side.RIGHT}


def test_a_contact_that_would_leave_the_pad_altogether_is_refused():
    heights, state = pressed(0.0, 0.0)
    with pytest.raises(TouchError, match="whole contact would leave"):
        move(heights, state, MINI, Placement(x_mm=15.0))


def test_an_untouched_gel_stays_untouched():
    placement = Placement(x_mm=3.0, turn_rad=1.0)
    moved = move(np.zeros((ROWS, COLUMNS)), NO_CONTACT_STATE, MINI, placement)
    assert moved.state == NO_CONTACT_STATE
    assert not moved.height_mm.any()


@settings(max_examples=40)
@given(st.floats(-9, 9), st.floats(-6, 6), turns, st.integers(0, 1000))
def test_drawn_moves_are_always_possible_and_leave_enough(x, y, t, seed):
    heights, state = pressed(x, y, t)
    placement = draw_placement(heights, state, MINI, np.random.default_rng(seed))
    state_after = move(heights, state, MINI, placement).state
    assert state_after.area_fraction >= (LEAST_LEFT - 0.05) * state.area_fraction
    assert placement == draw_placement(heights, state, MINI, np.random.default_rng(seed))


def test_drawn_moves_reach_all_over_the_pad():
    heights, state = pressed(0.0, 0.0)
    rng = np.random.default_rng(0)
    drawn = [draw_placement(heights, state, MINI, rng) for _ in range(200)]
    states = [move(heights, state, MINI, placement).state for placement in drawn]
    assert len({each.position for each in states}) == 9
    assert 20 < sum(bool(each.cut) for each in states) < 180
    assert 50 < sum(placement.turn_rad != 0 for placement in drawn) < 150


def test_sampled_points_lie_on_the_surface_and_are_never_centred_or_scaled():
    heights, state = pressed(4.0, 2.0)
    points = sampled(heights, MINI, FINE, np.random.default_rng(0))
    np.testing.assert_allclose(points[points[:, 2].argmax()], [4.0, 2.0, 0.7], atol=0.3)
    assert np.abs(points[:, :2].mean(axis=0)).max() < 0.3
    assert (points[:, 2] > 0).mean() == pytest.approx(state.area_fraction, abs=0.015)
    other = sampled(heights, MINI, FINE, np.random.default_rng(1))
    assert not np.array_equal(points, other)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_placement_must_be_finite(value):
    with pytest.raises(TouchError, match="finite"):
        Placement(x_mm=value)
