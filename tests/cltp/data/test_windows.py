"""Labels of contacts that a smaller pad sees, against the same body labelled on that pad."""

import dataclasses

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from cltp import TouchError
from cltp.data.windows import (
    LEAST_LEFT,
    LEAST_SIDE,
    MOST_COVERED,
    Window,
    crop,
    draw_window,
)
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import NO_CONTACT_STATE, Shape, Side, Texture
from sim.tcl3d.labels import label

MINI = SENSORS["gelsight_mini"]
ROWS, COLUMNS = 96, 128
PITCH_MM = MINI.width_mm / COLUMNS
X, Y = np.meshgrid(*grid_axes_mm(MINI, ROWS, COLUMNS))


def cap(x, y, x_mm, y_mm, sensor, radius_mm=2.5, depth_mm=0.7):
    """A round cap on a pad whose pixels lie at x and y [mm], and its labels there."""
    squared = ((x - x_mm) ** 2 + (y - y_mm) ** 2) / radius_mm**2
    heights = (depth_mm * (1 - squared).clip(0)).astype(np.float32)
    state = label(
        height_mm=heights,
        pressure_kpa=heights,
        touching=squared < 1,
        force_n=float(heights.sum()),
        sensor=sensor,
        shape=Shape.SPHERE,
        texture=Texture.SMOOTH,
    )
    return heights, state


windows = st.builds(
    lambda top, left, height, width: Window(
        top=top, bottom=min(top + height, ROWS), left=left, right=min(left + width, COLUMNS)
    ),
    st.integers(0, ROWS // 2),
    st.integers(0, COLUMNS // 2),
    st.integers(ROWS // 3, ROWS),
    st.integers(COLUMNS // 3, COLUMNS),
)


@settings(max_examples=80)
@given(st.floats(-9, 9), st.floats(-7, 7), windows)
def test_the_label_in_a_window_is_that_of_the_body_on_the_smaller_pad(x_mm, y_mm, window):
    heights, state = cap(X, Y, x_mm, y_mm, MINI)
    u = x_mm - (window.left + window.right - COLUMNS) / 2 * PITCH_MM
    v = y_mm - (ROWS - window.top - window.bottom) / 2 * PITCH_MM
    half_x, half_y = window.width * PITCH_MM / 2, window.height * PITCH_MM / 2
    assume(abs(u) < half_x - 0.5 and abs(v) < half_y - 0.5)
    seen = crop(heights, state, MINI, window)
    assert (seen.sensor.width_mm, seen.sensor.height_mm) == pytest.approx((2 * half_x, 2 * half_y))
    truth_heights, truth = cap(
        *np.meshgrid(*grid_axes_mm(seen.sensor, *seen.height_mm.shape)), u, v, seen.sensor
    )
    np.testing.assert_allclose(seen.height_mm, truth_heights, atol=1e-4)
    assert seen.state.depth_mm == pytest.approx(truth.depth_mm, abs=0.01)
    assert seen.state.x_mm == pytest.approx(truth.x_mm, abs=0.15)
    assert seen.state.y_mm == pytest.approx(truth.y_mm, abs=0.15)
    assert seen.state.area_fraction == pytest.approx(truth.area_fraction, rel=0.03, abs=0.003)
    assert seen.state.force_n == pytest.approx(truth.force_n, rel=0.05)
    assert truth.cut <= seen.state.cut | state.cut


def test_a_side_that_only_the_window_cuts_is_a_cut_side():
    heights, state = cap(X, Y, 0.0, 0.0, MINI)
    assert not state.cut
    seen = crop(heights, state, MINI, Window(top=0, bottom=ROWS, left=0, right=COLUMNS // 2 + 4))
    assert seen.state.cut == {Side.RIGHT}


def test_the_whole_pad_changes_nothing():
    heights, state = cap(X, Y, 1.0, -2.0, MINI)
    seen = crop(heights, state, MINI, Window(top=0, bottom=ROWS, left=0, right=COLUMNS))
    assert seen.state == state
    np.testing.assert_array_equal(seen.height_mm, heights)


def test_without_a_contact_there_is_none_in_a_window():
    empty = np.zeros((ROWS, COLUMNS), np.float32)
    seen = crop(empty, NO_CONTACT_STATE, MINI, Window(top=5, bottom=60, left=0, right=50))
    assert seen.state == NO_CONTACT_STATE
    assert seen.height_mm.shape == (55, 50)


def test_windows_that_can_t_be_are_refused():
    heights, state = cap(X, Y, 0.0, 0.0, MINI)
    with pytest.raises(TouchError, match="at least 2 rows"):
        Window(top=3, bottom=4, left=0, right=9)
    with pytest.raises(TouchError, match="beyond 96 rows"):
        crop(heights, state, MINI, Window(top=0, bottom=ROWS + 1, left=0, right=9))
    with pytest.raises(TouchError, match="whole contact"):
        crop(heights, state, MINI, Window(top=0, bottom=20, left=0, right=20))


def test_drawn_windows_leave_the_contact_and_have_many_proportions():
    rng = np.random.default_rng(0)
    ratios = []
    for _ in range(200):
        x_mm, y_mm = rng.uniform(-6, 6), rng.uniform(-4, 4)
        heights, state = cap(X, Y, x_mm, y_mm, MINI)
        window = draw_window(heights, state, MINI, rng)
        seen = crop(heights, state, MINI, window)
        kept = (seen.height_mm > 0).sum() / (heights > 0).sum()
        assert kept >= LEAST_LEFT - 0.05
        assert seen.state.area_fraction <= MOST_COVERED
        assert min(window.height / ROWS, window.width / COLUMNS) > LEAST_SIDE - 0.01
        ratios.append(window.width / window.height)
    low, high = np.quantile(ratios, [0.05, 0.95])
    assert low < 0.9 and high > 2.0


def test_a_disc_is_never_seen_so_near_that_it_would_be_a_plane():
    rng = np.random.default_rng(1)
    heights, state = cap(X, Y, 0.0, 0.0, MINI, radius_mm=6.0)
    disc = dataclasses.replace(state, shape=Shape.DISC)
    for _ in range(100):
        seen = crop(heights, disc, MINI, draw_window(heights, disc, MINI, rng))
        assert seen.state.area_fraction <= MOST_COVERED


def test_a_pad_of_markers_is_seen_whole():
    stereo = SENSORS["gelstereo"]
    heights = np.zeros((60, 60), np.float32)
    window = draw_window(heights, NO_CONTACT_STATE, stereo, np.random.default_rng(0))
    assert (window.height, window.width) == heights.shape
