"""Depth, position, area and force computed from clouds of known shape."""

import numpy as np
import pytest

from cltp.tactile.cloud import TactileCloud, cloud_from_heights, cloud_of_pixels, grid_axes_mm
from cltp.tactile.measure import STIFFNESS_N_PER_MM3, contact_state
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import Area, Depth, Position, Side

SENSOR = sensor_named("gelsight_mini")
X, Y = grid_axes_mm(SENSOR, 240, 320)


def bump(x_mm: float, y_mm: float, depth_mm: float, radius_mm: float = 3.0) -> np.ndarray:
    """A paraboloid of the given depth and foot radius."""
    square = (X - x_mm) ** 2 + (Y[:, None] - y_mm) ** 2
    return depth_mm * np.clip(1 - square / radius_mm**2, 0, None)


@pytest.mark.parametrize("num_points", [256, 1024, 4096, 20_000])
@pytest.mark.parametrize("position", [(0.0, 0.0), (5.0, -3.0), (-4.0, 2.5)])
def test_position_and_depth_of_a_bump_do_not_depend_on_how_it_is_sampled(num_points, position):
    cloud = cloud_from_heights(bump(*position, 0.5), SENSOR, num_points=num_points)
    state = contact_state(cloud)
    assert (state.x_mm, state.y_mm) == pytest.approx(position, abs=0.15)
    assert state.depth_mm == pytest.approx(0.5, abs=0.05)


def test_area_is_the_fraction_that_lies_deeper_than_a_quarter():
    state = contact_state(cloud_from_heights(bump(0, 0, 0.5), SENSOR, num_points=4096))
    fraction = np.pi * 3.0**2 * 0.75 / SENSOR.area_mm2
    assert state.area_fraction == pytest.approx(fraction, rel=0.08)


def test_force_is_the_stiffness_times_the_volume_above_a_fifth():
    state = contact_state(cloud_from_heights(bump(0, 0, 0.5), SENSOR, num_points=4096))
    volume = np.pi * 3.0**2 / 2 * 0.5 * 0.8**2  # of a paraboloid's top four fifths
    assert state.force_n == pytest.approx(STIFFNESS_N_PER_MM3 * volume, rel=0.05)


def test_words_follow_the_numbers():
    state = contact_state(cloud_from_heights(bump(0, -5, 0.7, 2.0), SENSOR))
    assert state.depth is Depth.DEEP
    assert state.position is Position.BOTTOM_CENTER
    assert state.area is Area.SMALL
    assert state.shape is None and state.texture is None


def test_an_untouched_gel_is_no_contact():
    state = contact_state(cloud_from_heights(np.zeros((240, 320)), SENSOR))
    assert not state.in_contact
    assert (state.depth_mm, state.area_fraction, state.force_n) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("position", "sides"),
    [
        ((0, 0), set()),
        ((9.5, 0), {Side.RIGHT}),
        ((-9.5, 0), {Side.LEFT}),
        ((0, 7), {Side.TOP}),
        ((9.5, -7), {Side.RIGHT, Side.BOTTOM}),
    ],
)
def test_the_sides_that_cut_a_contact_are_named(position, sides):
    assert contact_state(cloud_from_heights(bump(*position, 0.5), SENSOR)).cut == sides


def test_a_second_shallower_bump_does_not_move_the_contact():
    drift = bump(0, 0, 0.5) + bump(8, 5, 0.3, 1.2)
    state = contact_state(cloud_from_heights(drift, SENSOR))
    assert (state.x_mm, state.y_mm) == pytest.approx((0.0, 0.0), abs=0.2)


def test_a_cloud_without_points_in_some_positions_is_measured_all_the_same():
    points = cloud_from_heights(bump(2, 1, 0.5), SENSOR).points_mm
    kept = points[np.random.default_rng(0).random(len(points)) < 0.5]
    state = contact_state(TactileCloud(points_mm=kept, sensor=SENSOR))
    assert (state.x_mm, state.y_mm) == pytest.approx((2.0, 1.0), abs=0.4)


def test_the_same_cloud_is_measured_once_and_another_one_anew(monkeypatch):
    from cltp.tactile import measure

    calls = []
    wrapped = measure._measure
    monkeypatch.setattr(measure, "_measure", lambda *given: calls.append(given) or wrapped(*given))
    one, equal = (cloud_from_heights(bump(0, 0, 0.5), SENSOR) for _ in range(2))
    states = [measure.contact_state(one) for _ in range(3)]
    assert len(calls) == 1
    assert states[0] == states[2] == measure.contact_state(equal)
    assert len(calls) == 2  # equal points, but another cloud
    assert not measure.contact_state(one, in_contact=False).in_contact
    assert measure.contact_state(one).in_contact


def test_a_contact_that_was_tested_is_measured_though_drift_has_lowered_the_pad():
    y, x = np.mgrid[-1:1:60j, -1:1:80j]
    bump_mm = 0.05 * np.exp(-((x / 0.2) ** 2 + (y / 0.25) ** 2))
    drift_mm = -0.08 - 0.02 * x + 0.015 * x * y
    clean, lowered = (
        contact_state(cloud_of_pixels(heights, SENSOR), in_contact=True)
        for heights in (bump_mm, bump_mm + drift_mm)
    )
    assert lowered.in_contact
    assert lowered.depth_mm == pytest.approx(clean.depth_mm, abs=0.004)
    assert lowered.force_n == pytest.approx(clean.force_n, rel=0.1)
    assert (lowered.x_mm, lowered.y_mm) == pytest.approx((clean.x_mm, clean.y_mm), abs=0.2)


def test_drift_as_high_as_the_foot_of_a_light_contact_beside_it_is_no_part_of_the_contact():
    light = bump(-1.0, -1.0, 0.27, 1.4)
    drift = 0.13 * np.exp(-((X - 4) ** 2 / 30 + (Y[:, None] - 3) ** 2 / 16))
    assert drift[np.abs(Y + 1).argmin(), np.abs(X + 1).argmin()] > 0.2 * 0.1  # they adjoin
    clean, drifted = (
        contact_state(cloud_of_pixels(heights, SENSOR), in_contact=True)
        for heights in (light, light + drift)
    )
    assert drifted.area is clean.area is Area.TINY
    assert drifted.area_fraction == pytest.approx(clean.area_fraction, rel=0.25)
    assert drifted.force_n == pytest.approx(clean.force_n, rel=0.3)
    assert (drifted.x_mm, drifted.y_mm) == pytest.approx((-1.0, -1.0), abs=0.2)
