"""Cells of a cloud: means of pixels by area, of loose points, and what is computed on them."""

import numpy as np
import pytest

from cltp.tactile.cells import cell_means, cells_of, filled, quadratic_basis, smoothed
from cltp.tactile.cloud import TactileCloud, cloud_from_heights, cloud_of_pixels
from cltp.tactile.encoder_input import cell_centres, encoder_input, in_lattice, lattice_points
from cltp.tactile.sensors import sensor_named

MINI = sensor_named("gelsight_mini")


def ball(rows, columns):
    y, x = np.mgrid[0:rows, 0:columns]
    u, v = (x + 0.5) / columns - 0.5, (y + 0.5) / rows - 0.5
    return 0.5 * np.exp(-((u / 0.2) ** 2 + (v / 0.25) ** 2))


@pytest.mark.parametrize("grid", [(60, 80), (240, 320), (12, 16)])
def test_a_cloud_of_pixels_knows_its_grid(grid):
    cloud = cloud_of_pixels(ball(*grid), MINI)
    assert cloud.grid == grid
    np.testing.assert_allclose(cloud.points_mm[:, 2].reshape(grid), ball(*grid), atol=1e-6)


def test_loose_points_have_no_grid():
    cloud = cloud_of_pixels(ball(60, 80), MINI)
    points = cloud.points_mm
    assert TactileCloud(points_mm=points[1:], sensor=MINI).grid is None
    assert TactileCloud(points_mm=points[::-1], sensor=MINI).grid is None
    assert TactileCloud(points_mm=points * [0.5, 0.5, 1.0], sensor=MINI).grid is None
    jittered = cloud_from_heights(ball(60, 80), MINI, rng=np.random.default_rng(0))
    assert jittered.grid is None


def test_cells_of_pixels_are_means_by_area():
    rng = np.random.default_rng(0)
    heights = rng.random((60, 80))
    means = cell_means(cloud_of_pixels(heights, MINI), 20)
    np.testing.assert_allclose(means, heights.reshape(20, 3, 20, 4).mean(axis=(1, 3)), atol=1e-6)
    whole = cell_means(cloud_of_pixels(heights, MINI), 32)
    assert whole.mean() == pytest.approx(heights.mean(), abs=1e-6)
    coarse = cell_means(cloud_of_pixels(np.full((12, 16), 0.3), MINI), 32)
    np.testing.assert_allclose(coarse, 0.3, atol=1e-6)


def test_cells_of_loose_points_agree_with_those_of_pixels():
    pixels = cloud_of_pixels(ball(240, 320), MINI)
    order = np.random.default_rng(1).permutation(len(pixels.points_mm))
    loose = TactileCloud(points_mm=pixels.points_mm[order], sensor=MINI)
    assert loose.grid is None and cells_of(loose) == cells_of(pixels) == 32
    np.testing.assert_allclose(cell_means(loose), cell_means(pixels), atol=0.01)


def test_smoothing_keeps_a_plane_and_passes_over_unknown_cells():
    cells = np.full((32, 32), 0.2)
    cells[3:6, 4:9] = np.nan
    np.testing.assert_allclose(smoothed(cells, MINI, 1.0), 0.2)
    assert np.isfinite(filled(cells)).all()


def test_the_basis_holds_every_quadratic_surface():
    basis = quadratic_basis(32, MINI)
    y, x = np.mgrid[0:32, 0:32]
    surface = (0.1 + 0.02 * x - 0.01 * y + 0.001 * x * y + 0.002 * x**2).ravel()
    weights, *_ = np.linalg.lstsq(basis, surface, rcond=None)
    np.testing.assert_allclose(basis @ weights, surface, atol=1e-9)


@pytest.mark.parametrize("grid", [(60, 80), (240, 320), (75, 100)])
def test_an_encoder_is_given_the_same_pixels_whatever_their_order(grid):
    cloud = cloud_of_pixels(ball(*grid), MINI)
    np.testing.assert_array_equal(lattice_points(cloud), in_lattice(cloud.points_mm, MINI))
    shuffled = np.random.default_rng(2).permutation(cloud.points_mm)
    loose = TactileCloud(points_mm=shuffled, sensor=MINI)
    np.testing.assert_allclose(encoder_input(loose)[:, 2], encoder_input(cloud)[:, 2], atol=0.02)


def test_a_coarse_grid_is_interpolated_for_the_encoder():
    points = lattice_points(cloud_of_pixels(ball(12, 16), MINI))
    np.testing.assert_allclose(points[:, :2], cell_centres(MINI))
    fine = lattice_points(cloud_of_pixels(ball(60, 80), MINI))
    assert np.abs(points[:, 2] - fine[:, 2]).max() < 0.08
