import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensor_noise import (
    MINI_SPREAD,
    NoiseUnit,
    SlowDrift,
    integrated_with_gains,
    smooth_field,
    spread_of,
)
from cltp.tactile.sensors import SENSORS

MINI = SENSORS["gelsight_mini"]
SHAPE = (76, 102)


def bump_mm() -> np.ndarray:
    x, y = grid_axes_mm(MINI, *SHAPE)
    return 0.5 * np.exp(-(x[None, :] ** 2 + y[:, None] ** 2) / 4.0)


def test_a_perfect_unit_only_loses_the_median() -> None:
    rng = np.random.default_rng(0)
    heights = bump_mm()
    noisy = NoiseUnit.draw(rng, level=0.0).apply(heights + 0.2, MINI, rng)
    np.testing.assert_allclose(noisy, heights - np.median(heights), atol=1e-6)


def test_the_unit_scales_every_height_by_its_own_factor() -> None:
    rng = np.random.default_rng(0)
    heights = bump_mm()
    noisy = NoiseUnit(depth_scale=1.1).apply(heights, MINI, rng)
    np.testing.assert_allclose(noisy.max(), 1.1 * (heights.max() - np.median(heights)), atol=1e-5)


def test_a_tilt_has_the_slope_it_names() -> None:
    rng = np.random.default_rng(0)
    noisy = NoiseUnit(tilt_x=0.01, tilt_y=-0.02).apply(np.zeros(SHAPE), MINI, rng)
    rise = noisy[10, -1] - noisy[10, 0]
    assert rise == pytest.approx(0.01 * MINI.width_mm * (SHAPE[1] - 1) / SHAPE[1], rel=1e-4)
    drop = noisy[0, 10] - noisy[-1, 10]  # row 0 is the top, y positive
    assert drop == pytest.approx(-0.02 * MINI.height_mm * (SHAPE[0] - 1) / SHAPE[0], rel=1e-4)


def test_drift_has_its_standard_deviation_and_correlation_length() -> None:
    rng = np.random.default_rng(1)
    fields = np.stack([smooth_field(SHAPE, MINI, 4.0, rng) for _ in range(2000)])
    assert fields.std() == pytest.approx(1.0, abs=0.03)
    pixels = round(4.0 / (MINI.width_mm / SHAPE[1]))
    correlation = (fields[:, 38, 40] * fields[:, 38, 40 + pixels]).mean()
    assert correlation == pytest.approx(np.exp(-1.0), abs=0.07)


def test_two_frames_of_one_unit_differ_and_the_same_seed_repeats() -> None:
    unit = NoiseUnit.draw(np.random.default_rng(2))
    first = unit.apply(bump_mm(), MINI, np.random.default_rng(3))
    again = unit.apply(bump_mm(), MINI, np.random.default_rng(3))
    other = unit.apply(bump_mm(), MINI, np.random.default_rng(4))
    np.testing.assert_array_equal(first, again)
    assert np.abs(first - other).max() > 0.01


@pytest.mark.parametrize(("axis", "gain"), [(1, 1.3), (0, 0.7)])
def test_a_wave_along_one_axis_is_scaled_by_the_gain_of_that_axis(axis: int, gain: float) -> None:
    mode = np.cos(np.pi * 3 * (np.arange(SHAPE[axis]) + 0.5) / SHAPE[axis])
    wave = np.broadcast_to(mode[None, :] if axis == 1 else mode[:, None], SHAPE)
    np.testing.assert_allclose(integrated_with_gains(wave, MINI, 1.3, 0.7), gain * wave, atol=1e-5)


def test_gains_keep_the_mean_and_their_product_is_one() -> None:
    heights = bump_mm()
    noisy = integrated_with_gains(heights, MINI, 1.4, 0.6)
    assert noisy.mean() == pytest.approx(heights.mean(), abs=1e-6)
    unit = NoiseUnit.draw(np.random.default_rng(5), gain_log_ratio=MINI_SPREAD.gain_log_ratio)
    assert unit.gain_x * unit.gain_y == pytest.approx(1.0)
    assert unit.gain_x != unit.gain_y


@pytest.mark.parametrize("level", [-1.0, float("nan"), float("inf")])
def test_a_level_that_is_no_level_is_refused(level: float) -> None:
    with pytest.raises(TouchError, match="levels of 0 or more"):
        NoiseUnit.draw(np.random.default_rng(0), level)


def test_every_sensor_has_a_stated_noise_and_the_mini_s_is_the_one_measured():
    assert {spread_of(sensor).depth_scale for sensor in SENSORS.values()} == {0.15, 0.20, 0.05}
    plain = NoiseUnit.draw(np.random.default_rng(3), gain_log_ratio=0.4)
    named = NoiseUnit.draw(np.random.default_rng(3), gain_log_ratio=0.4, spread=spread_of(MINI))
    assert plain == named
    assert plain.border_mm == plain.marker_mm == plain.marker_loss == 0


def test_a_dead_border_keeps_the_height_of_its_inner_edge():
    heights = np.tile(np.linspace(-1, 1, 320, dtype=np.float32), (240, 1))
    unit = NoiseUnit(border_mm=1.0)
    noisy = unit.apply(heights, MINI, np.random.default_rng(0))
    dead = round(1.0 / MINI.mm_per_px)
    assert (noisy[:, :dead] == noisy[:, dead : dead + 1]).all()
    assert (noisy[:, -dead:] == noisy[:, -dead - 1 : -dead]).all()
    np.testing.assert_allclose(noisy[:, dead:-dead], heights[:, dead:-dead], atol=1e-5)


def test_borders_are_drawn_up_to_the_widest():
    rng = np.random.default_rng(0)
    digit = spread_of(SENSORS["digit"])
    widths = [NoiseUnit.draw(rng, spread=digit).border_mm for _ in range(200)]
    assert 0 <= min(widths) < 0.1
    assert 0.9 < max(widths) <= 1.0


def test_slow_drifts_are_drawn_from_a_calibrated_unit_s_to_the_largest_seen() -> None:
    unit = NoiseUnit.draw(np.random.default_rng(0))
    spreads = [
        float(SlowDrift.draw(np.random.default_rng(seed), SHAPE, MINI, unit).at(0.0).std())
        for seed in range(300)
    ]
    low, middle, high = np.percentile(spreads, [2, 50, 98])
    assert 0.003 < low < 0.015
    assert 0.015 < middle < 0.08
    assert 0.1 < high < 0.5
