"""Contact by test: light presses are felt, and neither noise nor drift nor a turned sign is."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp, cloud_from_heights, heights_at
from cltp.tactile.contact.contact_test import (
    FOLLOWED_MM_S,
    FOLLOWED_TOTAL,
    UntouchedGel,
    touches_alone,
)
from cltp.tactile.sensor_noise import NoiseUnit, smooth_field
from cltp.tactile.sensors import sensor_named

MINI = sensor_named("gelsight_mini")
SHAPE = (76, 102)
Y, X = np.meshgrid(
    np.linspace(MINI.height_mm / 2, -MINI.height_mm / 2, SHAPE[0]),
    np.linspace(-MINI.width_mm / 2, MINI.width_mm / 2, SHAPE[1]),
    indexing="ij",
)


def bump(depth_mm, radius_mm=1.2, x_mm=0.0, y_mm=0.0):
    return depth_mm * np.exp(-((X - x_mm) ** 2 + (Y - y_mm) ** 2) / radius_mm**2)


def frame(rng, heights=0.0, fine_mm=0.01):
    return cloud_from_heights(heights + rng.normal(0, fine_mm, SHAPE), MINI, rng=rng)


@pytest.fixture
def rng():
    return np.random.default_rng(0)


@pytest.mark.parametrize("fine_mm", [0.0005, 0.01, 0.03])
def test_untouched_frames_are_untouched_whatever_the_noise(rng, fine_mm):
    for _ in range(20):
        gel = UntouchedGel([frame(rng, fine_mm=fine_mm) for _ in range(5)])
        assert not any(gel.test(frame(rng, fine_mm=fine_mm)).in_contact for _ in range(25))


@pytest.mark.parametrize("place", [(0, 0), (8.0, 6.0), (-9.5, 0)])
def test_a_light_press_of_six_hundredths_of_a_millimetre_is_felt(rng, place):
    x_mm, y_mm = place
    for _ in range(20):
        gel = UntouchedGel([frame(rng) for _ in range(5)])
        assert gel.test(frame(rng, bump(0.06, 1.5, x_mm=x_mm, y_mm=y_mm))).in_contact


def test_drift_since_long_ago_is_in_the_reference_and_hides_no_contact(rng):
    drift = 0.3 * smooth_field(SHAPE, MINI, 12.0, rng)
    gel = UntouchedGel([frame(rng, drift) for _ in range(5)])
    assert not gel.test(frame(rng, drift)).in_contact
    assert gel.test(frame(rng, drift + bump(0.06, 1.5))).in_contact


def test_broad_drift_during_a_closing_is_no_contact(rng):
    gel = UntouchedGel([frame(rng) for _ in range(5)])
    assert not gel.test(frame(rng, 0.03 * smooth_field(SHAPE, MINI, 15.0, rng))).in_contact


def test_a_turned_sign_is_no_contact(rng):
    gel = UntouchedGel([frame(rng) for _ in range(5)])
    assert not gel.test(frame(rng, -bump(0.4, radius_mm=4.0))).in_contact


def test_a_reference_needs_two_frames_of_one_sensor(rng):
    with pytest.raises(TouchError, match="at least 2 frames"):
        UntouchedGel([frame(rng)])
    other = cloud_from_heights(np.zeros(SHAPE), sensor_named("digit"))
    with pytest.raises(TouchError, match="of one sensor"):
        UntouchedGel([frame(rng), other])
    with pytest.raises(TouchError, match="expected a cloud of gelsight_mini"):
        UntouchedGel([frame(rng), frame(rng)]).test(other)


def test_a_single_frame_tells_a_press_from_drift(rng):
    """Forty untouched frames of forty units, and a press of 0.4 mm in each."""
    for _ in range(40):
        unit = NoiseUnit.draw(rng)
        untouched = cloud_from_heights(unit.apply(np.zeros(SHAPE), MINI, rng), MINI, rng=rng)
        assert not touches_alone(untouched).in_contact
        pressed = unit.apply(bump(0.4), MINI, rng)
        assert touches_alone(cloud_from_heights(pressed, MINI, rng=rng)).in_contact


def stamped(heights, t_s):
    stamp = Stamp(monotonic_s=t_s, wall_s=t_s)
    return cloud_from_heights(heights, MINI, stamp=stamp)


def gel_of_noise(seed):
    rng = np.random.default_rng(seed)
    frames = [stamped(rng.normal(0, 0.01, SHAPE), 0.04 * i) for i in range(5)]
    return UntouchedGel(frames)


@settings(max_examples=12, deadline=None)
@given(
    seconds=st.floats(1, 600),
    radius_mm=st.floats(0.8, 5),
    depth_mm=st.floats(0.02, 0.6),
    x_mm=st.floats(-8, 8),
    y_mm=st.floats(-6, 6),
    seed=st.integers(0, 9),
)
def test_no_press_is_so_slow_that_the_reference_learns_it_away(
    seconds, radius_mm, depth_mm, x_mm, y_mm, seed
):
    followed, fresh = gel_of_noise(seed), gel_of_noise(seed)
    press = bump(depth_mm, radius_mm, x_mm, y_mm)
    for part in np.linspace(0, 1, 40):
        followed.follow(stamped(part * press, 0.2 + part * seconds))
    now = stamped(press, 0.2 + seconds)
    if fresh.test(now).ratio >= 1 + FOLLOWED_TOTAL:
        assert followed.test(now).in_contact


def test_the_reference_follows_broad_drift_and_a_contact_is_found_on_it(rng):
    drift = 0.2 * smooth_field(SHAPE, MINI, 15.0, rng)
    followed, fresh = gel_of_noise(0), gel_of_noise(0)
    for part in np.linspace(0, 1, 300):
        followed.follow(stamped(part * drift, 0.2 + 60 * part))
    now = stamped(drift, 61)
    assert not followed.test(now).in_contact
    left = followed.without_drift(now).points_mm[:, 2] - np.mean(now.points_mm[:, 2])
    assert np.std(left) < 0.5 * np.std(fresh.without_drift(now).points_mm[:, 2])
    assert followed.test(stamped(drift + bump(0.1, 1.5), 61)).in_contact


def test_the_reference_is_still_during_a_contact_and_follows_no_faster_than_its_rate():
    gel = gel_of_noise(0)
    touched = stamped(bump(0.3), 0.4)
    for _ in range(50):
        gel.follow(touched)
    assert gel.without_drift(touched) is touched
    raised = stamped(np.full(SHAPE, 0.5), 0.7)
    gel.follow(raised)
    change = raised.points_mm[:, 2] - gel.without_drift(raised).points_mm[:, 2]
    np.testing.assert_allclose(change, FOLLOWED_MM_S * (0.7 - 0.16), rtol=1e-4)


def held(contact, drift, t_s, rng):
    """A frame of a contact on a gel that has drifted."""
    return stamped(contact + drift + rng.normal(0, 0.002, SHAPE), t_s)


def test_the_reference_follows_drift_around_a_light_contact_and_leaves_the_contact(rng):
    contact, drift = bump(0.06, 2.0, 3.0, -1.0), 0.05 * smooth_field(SHAPE, MINI, 15.0, rng)
    gel, t_s = gel_of_noise(0), 0.2
    for part in np.linspace(0, 1, 10):
        t_s += 0.5
        gel.follow_around(held(contact, part * drift, t_s, rng))
    now = held(contact, drift, t_s, rng)
    x, y, z = gel.without_drift(now).points_mm.T.astype(float)
    true = heights_at(contact, x, y, MINI)
    assert np.std(z - true) < 0.3 * np.std(drift)
    under = true > 0.02
    assert abs((z - true)[under].mean()) < 0.2 * true[under].mean()


def test_a_contact_that_stays_is_never_followed_away(rng):
    contact, gel, t_s = bump(0.06, 2.0, 3.0, -1.0), gel_of_noise(0), 0.2
    for _ in range(40):
        t_s += 0.5
        gel.follow_around(held(contact, 0.0, t_s, rng))
    assert gel.test(held(contact, 0.0, t_s + 0.1, rng)).in_contact


@pytest.mark.parametrize("slid_mm", [0.5, 1.0, 2.0, 3.0, 4.0, 6.0])
def test_a_light_contact_that_slid_away_is_not_taken_for_drift(rng, slid_mm):
    gel, t_s = gel_of_noise(0), 0.2
    for _ in range(5):
        t_s += 0.5
        gel.follow_around(held(bump(0.08, 2.0, 3.0, -1.0), 0.0, t_s, rng))
    slid = bump(0.08, 2.0, 3.0, -1.0 + slid_mm)
    for _ in range(3):
        t_s += 3.0
        now = held(slid, 0.0, t_s, rng)
        gel.follow_around(now)
        x, y, z = gel.without_drift(now).points_mm.T.astype(float)
        true = heights_at(slid, x, y, MINI)
        under = true > 0.03
        assert z[under].mean() == pytest.approx(true[under].mean(), rel=0.2)


def test_a_deep_contact_is_left_as_it_is():
    gel, touched = gel_of_noise(0), stamped(0.2 * np.exp(-(X**2) / 4), 2.2)
    gel.follow_around(touched)
    assert gel.without_drift(touched) is touched
