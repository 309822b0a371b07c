"""A pad that is raised all over is neither untouched nor a contact that can be read."""

import numpy as np
import pytest

from cltp.tactile.cloud import TactileCloud, cloud_of_pixels
from cltp.tactile.contact.raised_pad import is_raised, raised_mm, raised_text
from cltp.tactile.sensor_noise import NoiseUnit, SlowDrift, spread_of
from cltp.tactile.sensors import SENSORS, SensorSpec

MINI, TAXELS = SENSORS["gelsight_mini"], SENSORS["taxels"]
Y, X = np.mgrid[-1:1:60j, -1:1:80j]
BUMP = 0.2 * np.exp(-((X / 0.25) ** 2 + (Y / 0.3) ** 2))


def raised(height_mm: float, over: np.ndarray, sensor: SensorSpec = MINI) -> TactileCloud:
    heights = height_mm + over
    return cloud_of_pixels(heights[::5, ::6] if sensor is TAXELS else heights, sensor)


@pytest.mark.parametrize("sensor", [MINI, TAXELS])
@pytest.mark.parametrize("height_mm", [0.1, 0.2, 0.5, 1.0])
def test_a_pad_raised_beyond_drift_is_told_whatever_lies_on_it(height_mm, sensor):
    noise = 0.01 * np.random.default_rng(0).standard_normal(X.shape)
    for over in (np.zeros_like(X), noise, 0.02 * X, BUMP):
        assert is_raised(raised(height_mm, over, sensor))
    assert f"raised by {height_mm:.2f} mm" in raised_text(raised(height_mm, np.zeros_like(X)))


@pytest.mark.parametrize("sensor", [MINI, TAXELS])
def test_drift_and_a_contact_do_not_raise_the_pad(sensor):
    for height_mm in (-0.02, 0.0, 0.02):
        for over in (np.zeros_like(X), 0.02 * X, BUMP, 5 * BUMP):
            assert not is_raised(raised(height_mm, over, sensor))


def test_a_contact_that_leaves_a_rim_free_can_be_read():
    wide = np.where((np.abs(X) < 0.97) & (np.abs(Y) < 0.97), 0.5, -0.1)
    assert raised_mm(raised(0.0, wide)) > 0.1
    assert not is_raised(raised(0.0, wide))


@pytest.mark.parametrize("name", sorted(SENSORS))
def test_the_noise_of_a_sensor_does_not_raise_its_pad(name):
    sensor, spread = SENSORS[name], spread_of(SENSORS[name])
    for seed in range(30):
        rng = np.random.default_rng(seed)
        unit = NoiseUnit.draw(rng, spread=spread)
        heights = BUMP + SlowDrift.draw(rng, X.shape, sensor, unit).at(0.0)
        assert not is_raised(cloud_of_pixels(unit.apply(heights, sensor, rng), sensor))
