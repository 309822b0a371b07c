"""A single cloud with a wrong sign or without its zero is told as such."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud, cloud_of_pixels, grid_axes_mm
from cltp.tactile.contact.single_cloud import is_lowered, is_touched, lowered_text, unseen_mm
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SENSORS

MINI = SENSORS["gelsight_mini"]
X, Y = np.meshgrid(*grid_axes_mm(MINI, 60, 80))


def pressed(depth_mm: float, radius_mm: float = 15.0, zero_mm: float = 0.0) -> TactileCloud:
    """A ball in the middle of the pad."""
    heights = np.clip(depth_mm - (X**2 + Y**2) / (2 * radius_mm), 0, None)
    return cloud_of_pixels(heights + zero_mm, MINI)


def test_a_pad_that_is_lowered_beyond_drift_is_told_with_and_without_a_contact() -> None:
    for cloud in (pressed(0.0, zero_mm=-0.3), pressed(0.45, zero_mm=-0.3)):
        assert is_lowered(cloud)
        assert "lies 0.30 mm below zero" in lowered_text(cloud)


def test_a_pad_within_its_drift_is_not_lowered() -> None:
    for zero_mm in (-0.1, 0.0, 0.1):
        assert not is_lowered(pressed(0.45, zero_mm=zero_mm))


def test_gel_that_bulges_around_a_deep_contact_is_not_lowered() -> None:
    cloud = pressed(1.8, radius_mm=4.0, zero_mm=-0.2)
    assert not is_lowered(cloud)


def test_a_contact_that_took_the_zero_with_it_is_told() -> None:
    """A sensor that loses the zero has its median at 0, and so within a contact this large."""
    heights = np.clip(2.0 - (X**2 + Y**2) / 60, 0, None)
    assert is_lowered(cloud_of_pixels(heights - np.median(heights), MINI))
    assert not is_lowered(cloud_of_pixels(heights, MINI))


@pytest.mark.parametrize("name", sorted(SENSORS))
def test_the_noise_of_a_sensor_does_not_lower_its_pad(name: str) -> None:
    sensor, spread = SENSORS[name], spread_of(SENSORS[name])
    for seed in range(30):
        rng = np.random.default_rng(seed)
        unit = NoiseUnit.draw(rng, spread=spread)
        heights = 0.3 * np.exp(-((X / 2.5) ** 2) - (Y / 2.5) ** 2)
        assert not is_lowered(cloud_of_pixels(unit.apply(heights, sensor, rng), sensor))


def test_a_wrong_sign_is_refused_and_the_right_one_is_touched() -> None:
    assert is_touched(pressed(0.45))
    flipped = pressed(0.45).points_mm * np.float32([1, 1, -1])
    with pytest.raises(TouchError, match="wrong sign"):
        is_touched(TactileCloud(points_mm=flipped, sensor=MINI))


@pytest.mark.parametrize("radius_mm", [4.0, 7.5, 15.0, 60.0])
@pytest.mark.parametrize("drift_mm", [0.0, 0.04])
def test_a_press_deeper_than_what_may_be_drift_is_told(radius_mm: float, drift_mm: float) -> None:
    """A cloud without noise shows its lightest presses; beside drift they have to be deeper."""
    far = np.hypot(X, Y) > 6
    ripple = drift_mm * np.where(far, np.sin(X) * np.sin(Y), 0.0)  # around the contact alone

    def touched(depth_mm: float) -> bool:
        heights = np.clip(depth_mm - (X**2 + Y**2) / (2 * radius_mm), 0, None)
        return is_touched(cloud_of_pixels(heights + ripple, MINI))

    unseen = unseen_mm(cloud_of_pixels(ripple, MINI))
    assert unseen == pytest.approx(0.17 if drift_mm else 0.065, abs=0.001)
    assert touched(unseen)
    assert not touched(0.02 if drift_mm else 0.005)


@pytest.mark.parametrize("level", [0.02, 0.15, 1.0])
def test_drift_of_any_size_is_no_press(level: float) -> None:
    for seed in range(40):
        rng = np.random.default_rng(seed)
        unit = NoiseUnit.draw(rng, level)
        assert not is_touched(cloud_of_pixels(unit.apply(np.zeros(X.shape), MINI, rng), MINI))
