"""A pad of which part is not measured is told; whole ones, of few points too, are not."""

from __future__ import annotations

import numpy as np
import pytest

from cltp.tactile.cloud import TactileCloud, cloud_from_heights, cloud_of_pixels, grid_axes_mm
from cltp.tactile.contact.partial_pad import (
    covered_part,
    cut_off_part,
    dead_part,
    is_partial,
    partial_text,
)
from cltp.tactile.markers import marker_cloud
from cltp.tactile.noise_levels import WIDE
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SENSORS, SensorSpec, sensor_named

MINI = sensor_named("gelsight_mini")
X, Y = np.meshgrid(*grid_axes_mm(MINI, 120, 160))
SMOOTH = 0.5 * np.exp(-((X - 4.0) ** 2 + (Y + 2.0) ** 2) / 5.0) + 0.002 * X + 0.0037 * Y - 0.02
HEIGHTS = SMOOTH + np.random.default_rng(0).normal(0, 0.01, X.shape)
PIXELS = cloud_of_pixels(HEIGHTS, MINI).points_mm
EVEN = cloud_from_heights(HEIGHTS, MINI, rng=np.random.default_rng(1)).points_mm
FEW = np.random.default_rng(2).permutation(PIXELS)
NEAR = np.hypot(PIXELS[:, 0] - 4.0, PIXELS[:, 1] + 2.0) < 2.0


@pytest.mark.parametrize(
    ("points", "sensor", "covered"),
    [
        (PIXELS[PIXELS[:, 0] < 0], MINI, 0.5),
        (PIXELS[PIXELS[:, 0] < 3], MINI, 0.65),
        (PIXELS[~NEAR], MINI, 0.97),
        (EVEN * np.float32([0.5, 0.5, 1]), MINI, 0.25),
        (FEW[:64] * np.float32([0.5, 0.5, 1]), MINI, 0.25),
        (EVEN, SENSORS["gelstereo"], 0.45),
    ],
)
def test_points_on_part_of_the_pad_are_told(
    points: np.ndarray, sensor: SensorSpec, covered: float
) -> None:
    cloud = TactileCloud(points_mm=points, sensor=sensor)
    assert covered_part(cloud) == pytest.approx(covered, abs=0.04)
    assert is_partial(cloud)
    assert partial_text(cloud).startswith(f"points cover {covered_part(cloud):.0%} of the pad")


@pytest.mark.parametrize("count", [64, 100, 200, 500, 5000])
def test_a_whole_pad_may_have_few_points(count: int) -> None:
    for seed in range(20):
        points = np.random.default_rng(seed).permutation(PIXELS)[:count]
        assert not is_partial(TactileCloud(points_mm=points, sensor=MINI))


@pytest.mark.parametrize("name", SENSORS)
def test_no_noise_makes_a_pad_partial(name: str) -> None:
    sensor = SENSORS[name]
    for seed in range(20):
        rng = np.random.default_rng(seed)
        unit = NoiseUnit.draw(rng, WIDE.draw(rng), spread=spread_of(sensor))
        if sensor.markers is not None:
            made = [marker_cloud(SMOOTH, sensor, unit=unit, rng=rng)]
        else:
            noisy = unit.apply(SMOOTH, sensor, rng)
            made = [cloud_of_pixels(noisy, sensor), cloud_from_heights(noisy, sensor)]
        for cloud in made:
            points = unit.received(cloud.points_mm, rng)
            assert not is_partial(cloud)
            assert not is_partial(TactileCloud(points_mm=points, sensor=sensor))


def test_a_dead_block_is_told_and_a_cut_off_or_a_coarse_count_is_none() -> None:
    def dead(heights: np.ndarray, value: float, columns: slice) -> np.ndarray:
        changed = heights.copy()
        changed[:, columns] = value
        return changed

    for heights in (HEIGHTS, SMOOTH):
        for value, columns in ((0.0, slice(100, 110)), (0.0, slice(80, None)), (0.1, slice(9))):
            for make in (cloud_of_pixels, cloud_from_heights):
                cloud = make(dead(heights, value, columns), MINI)
                assert dead_part(cloud) > 0.03
                assert "of the points are exactly alike" in partial_text(cloud)
    rounded = np.round(HEIGHTS, 3), np.round(SMOOTH, 3), np.round(0.1 * HEIGHTS, 3)
    for heights in (*rounded, np.maximum(HEIGHTS, 0), np.minimum(SMOOTH, 0.2), 0 * HEIGHTS):
        assert not is_partial(cloud_of_pixels(heights, MINI))


def test_many_isolated_points_make_a_pad_partial() -> None:
    points = PIXELS.copy()
    points[::50, 2] = 1.0
    cloud = TactileCloud(points_mm=points, sensor=MINI)
    assert partial_text(cloud).startswith("384 of 19200 points stand far from all others")


def test_heights_that_are_cut_off_above_are_told() -> None:
    cloud = cloud_of_pixels(np.minimum(HEIGHTS, 0.25), MINI)
    part = cut_off_part(cloud)
    assert 0.02 < part < 0.1
    assert partial_text(cloud).startswith(f"the highest {part:.0%} of the points are exactly alike")


def test_a_flat_body_is_not_cut_off_and_neither_are_heights_counted_in_steps() -> None:
    rng = np.random.default_rng(0)
    flat = np.minimum(SMOOTH, 0.25)
    noisy = flat + rng.normal(0, 0.004, flat.shape)
    few = noisy[::10, ::14]
    upside_down = -np.clip(SMOOTH - 0.05, 0, None)
    for heights in (flat, noisy, np.round(noisy, 3), np.round(noisy, 2), few, upside_down):
        assert cut_off_part(cloud_of_pixels(heights, MINI)) == 0.0
