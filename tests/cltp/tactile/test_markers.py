"""A sensor that tracks markers: sparse clouds, and 1024 points on the surface through them."""

import dataclasses
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import LinearNDInterpolator
from threadpoolctl import threadpool_info

from cltp.errors import TouchError
from cltp.tactile.cloud import NUM_POINTS, TactileCloud, grid_axes_mm
from cltp.tactile.encoder_input import encoder_input, lattice_points
from cltp.tactile.markers import densified, interpolated, marker_cloud, marker_positions_mm
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SENSORS

STEREO = SENSORS["gelstereo"]


def dent(at_x=0.0, at_y=0.0, depth=0.6, width=3.0):
    x, y = np.meshgrid(*grid_axes_mm(STEREO, 240, 240))
    return depth * np.exp(-((x - at_x) ** 2 + (y - at_y) ** 2) / (2 * width**2))


def test_markers_lie_in_equal_cells_from_the_top_left():
    positions = marker_positions_mm(STEREO)
    assert positions.shape == (23 * 23, 2)
    pitch = STEREO.width_mm / 23
    np.testing.assert_allclose(positions[0], [-11 * pitch, 11 * pitch])
    np.testing.assert_allclose(positions[1] - positions[0], [pitch, 0], atol=1e-9)
    np.testing.assert_allclose(positions[23] - positions[0], [0, -pitch], atol=1e-9)


def test_a_marker_reports_the_height_where_it_is():
    cloud = marker_cloud(dent(4.0, -5.0), STEREO)
    x, y, z = cloud.points_mm.T
    truth = 0.6 * np.exp(-((x - 4) ** 2 + (y + 5) ** 2) / 18)
    np.testing.assert_allclose(z - z.min(), truth - truth.min(), atol=1e-3)
    assert np.median(z) == pytest.approx(0, abs=1e-6)


def test_without_noise_the_surface_between_markers_is_met():
    points = densified(marker_cloud(dent(width=2.0), STEREO)).points_mm
    truth = 0.6 * np.exp(-(points[:, 0] ** 2 + points[:, 1] ** 2) / 8)
    error = points[:, 2] - truth
    assert np.abs(error - np.median(error)).max() < 0.02
    assert points[:, 2].max() == pytest.approx(0.6, abs=0.03)


def test_the_smooth_surface_is_nearer_to_the_truth_than_nearest_markers():
    sparse = marker_cloud(dent(1.3, 0.4, width=1.5), STEREO)

    def rmse(points):
        truth = 0.6 * np.exp(-((points[:, 0] - 1.3) ** 2 + (points[:, 1] - 0.4) ** 2) / 4.5)
        return float(np.sqrt(np.mean((points[:, 2] - truth) ** 2)))

    assert rmse(densified(sparse).points_mm) < 0.5 * rmse(lattice_points(sparse))


def test_an_encoder_takes_1024_points_as_they_are():
    cloud = densified(marker_cloud(dent(), STEREO), rng=np.random.default_rng(0))
    assert len(cloud.points_mm) == NUM_POINTS
    assert encoder_input(cloud).shape == (NUM_POINTS, 3)
    np.testing.assert_array_equal(lattice_points(cloud), cloud.points_mm)


def test_noise_is_of_the_stated_size_and_markers_get_lost():
    rng = np.random.default_rng(1)
    unit = NoiseUnit(fine_mm=0.027, marker_mm=0.004, marker_loss=0.03)
    counts, errors, shifts = [], [], []
    for _ in range(30):
        cloud = marker_cloud(np.zeros((240, 240)), STEREO, unit=unit, rng=rng)
        counts.append(len(cloud.points_mm))
        errors.append(cloud.points_mm[:, 2])
        pitch = STEREO.width_mm / 23
        place = cloud.points_mm[:, 0] / pitch
        shifts.append((place - np.round(place)) * pitch)
    assert np.mean(counts) / 529 == pytest.approx(0.97, abs=0.005)
    assert np.std(np.concatenate(errors)) == pytest.approx(0.027, rel=0.03)
    assert np.std(np.concatenate(shifts)) == pytest.approx(0.004, rel=0.03)


def test_a_unit_s_scale_reaches_every_marker():
    unit = NoiseUnit(depth_scale=1.2)
    plain = marker_cloud(dent(), STEREO).points_mm
    scaled = marker_cloud(dent(), STEREO, unit=unit, rng=np.random.default_rng(0)).points_mm
    np.testing.assert_allclose(np.ptp(scaled[:, 2]), 1.2 * np.ptp(plain[:, 2]), rtol=1e-4)


@settings(max_examples=15)
@given(seed=st.integers(0, 2**32 - 1), level=st.floats(0.1, 2.0))
def test_any_unit_gives_a_whole_cloud(seed, level):
    rng = np.random.default_rng(seed)
    unit = NoiseUnit.draw(rng, level, spread=spread_of(STEREO))
    cloud = densified(marker_cloud(dent(), STEREO, unit=unit, rng=rng), rng=rng)
    assert cloud.points_mm.shape == (NUM_POINTS, 3)
    assert np.isfinite(cloud.points_mm).all()


def test_what_can_t_be_tracked_is_refused():
    with pytest.raises(TouchError, match="has no markers"):
        marker_cloud(np.zeros((240, 320)), SENSORS["gelsight_mini"])
    with pytest.raises(TouchError, match="height map"):
        marker_cloud(np.full((240, 240), np.nan), STEREO)
    with pytest.raises(TouchError, match="generator"):
        marker_cloud(dent(), STEREO, unit=NoiseUnit())
    blind = NoiseUnit(marker_loss=1.0)
    with pytest.raises(TouchError, match="empty"):
        marker_cloud(dent(), STEREO, unit=blind, rng=np.random.default_rng(0))
    line = np.stack([np.linspace(-10, 10, 80), np.zeros(80), np.zeros(80)], axis=1)
    with pytest.raises(TouchError, match="line"):
        densified(TactileCloud(points_mm=line, sensor=STEREO))


def test_no_noise_is_known_of_a_sensor_that_nobody_described():
    with pytest.raises(TouchError, match="gelsight_mini"):
        spread_of(dataclasses.replace(STEREO, name="skin"))


def test_triangles_are_solved_on_one_thread_and_others_keep_theirs():
    def blas_threads():
        return [each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas"]

    class Watching(LinearNDInterpolator):
        seen: ClassVar[list[int]] = []

        def __call__(self, *positions):
            self.seen.extend(blas_threads())
            return super().__call__(*positions)

    cloud = marker_cloud(np.zeros((60, 80)), SENSORS["gelstereo"])
    before = blas_threads()
    interpolated(cloud, np.zeros(3), np.zeros(3), Watching)
    assert len(Watching.seen) >= 2  # numpy and scipy have a library each
    assert set(Watching.seen) == {1}
    assert blas_threads() == before
