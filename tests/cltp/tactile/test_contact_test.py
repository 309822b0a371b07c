"""Contact by test: light presses are felt, and neither noise nor drift nor a turned sign is."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.contact_test import UntouchedGel, touches_alone
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
