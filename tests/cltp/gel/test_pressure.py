"""Forces out of heights: presses that the simulator solved, and what must not change a force."""

from dataclasses import replace

import numpy as np
import pytest
import torch

from cltp.gel.compliance import GelMaterial, layer_kernel
from cltp.gel.pressure import LEVELS, NOMINAL_GEL, NUM_FEATURES, RINGS, pressure_features
from cltp.tactile.cells import height_grid
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.encoder_input import encoder_input, grid_points
from cltp.tactile.point_layout import GRID
from cltp.tactile.sensors import SENSORS
from sim.gel.layer import ElasticLayer, gel_of

MINI = SENSORS["gelsight_mini"]
PITCH_MM = 2 * MINI.mm_per_px
ROWS, COLUMNS = MINI.rows // 2, MINI.columns // 2
Y, X = np.meshgrid(
    ((ROWS - 1) / 2 - np.arange(ROWS)) * PITCH_MM,
    (np.arange(COLUMNS) - (COLUMNS - 1) / 2) * PITCH_MM,
    indexing="ij",
)
RING = 7
"""Features before those of the rings."""
FIRST = RING + len(RINGS)
"""Features before those of the outlines."""


def forces(points):
    """Forces of the outlines [N], from heights as they are and from the surroundings' height."""
    features = pressure_features(points).astype(np.float64)
    return np.exp(features[FIRST::4]), np.exp(features[FIRST + 3 :: 4])


def points_of(height_mm):
    return encoder_input(cloud_from_heights(height_mm, MINI), GRID)


def pressed(gap_mm, force_n, gel=None):
    layer = ElasticLayer(gel or gel_of(MINI.name), rows=ROWS, columns=COLUMNS, pitch_mm=PITCH_MM)
    return layer.press_to_force(torch.tensor(gap_mm[None], dtype=torch.float32), force_n)


def ball(radius_mm, x_mm=0.0, y_mm=0.0):
    square = (X - x_mm) ** 2 + (Y - y_mm) ** 2
    return radius_mm - np.sqrt(np.clip(radius_mm**2 - square, 0, None))


@pytest.mark.parametrize("force_n", [0.1, 0.5, 2.0, 6.0])
@pytest.mark.parametrize("radius_mm", [5.0, 12.0])
def test_the_force_of_a_ball_is_found_from_its_heights(radius_mm, force_n):
    press = pressed(ball(radius_mm, x_mm=1.3, y_mm=-0.7), force_n)
    found, _ = forces(points_of(press.height_mm[0].numpy()))
    assert found[0] == pytest.approx(force_n, rel=0.06)
    assert found[1] == pytest.approx(force_n, rel=0.06)


def test_the_surface_around_a_contact_tells_a_thick_gel_from_a_thin_one():
    rings = []
    for thickness_mm in (2.3, 3.4, 6.2):
        gel = GelMaterial(thickness_mm=thickness_mm, young_mpa=0.423, poisson=0.47)
        press = pressed(ball(5.0), 2.0, gel)
        features = pressure_features(points_of(press.height_mm[0].numpy()))
        rings.append(features[RING : RING + len(RINGS)])
    assert (np.diff(rings, axis=0)[:, 2] > 0.02).all()  # a thick gel sinks farther around it


def test_rings_beyond_the_pad_tell_nothing():
    pad = replace(MINI, columns=126, rows=126)
    flat = np.full((63, 63), 0.3, np.float32)  # a contact that takes the whole pad
    features = pressure_features(encoder_input(cloud_from_heights(flat, pad), GRID))
    assert (features[RING : RING + len(RINGS)] == 0).all()


@pytest.mark.parametrize("side", [1.5, 3.0])
def test_the_force_of_a_flat_punch_is_found_from_its_heights(side):
    gap = np.where((abs(X) < side) & (abs(Y) < side), 0.0, 5.0)
    press = pressed(gap, 2.0)
    found, _ = forces(points_of(press.height_mm[0].numpy()))
    assert found[2] == pytest.approx(2.0, rel=0.12)


def test_one_pressed_element_needs_its_height_over_its_compliance():
    heights = np.zeros((GRID.rows, GRID.columns), np.float32)
    heights[36:39, 48:51] = 0.2
    rows, columns = GRID.cells_on(MINI.width_mm, MINI.height_mm)
    top, left = (GRID.rows - rows) // 2, (GRID.columns - columns) // 2
    inner = heights[top : top + rows, left : left + columns]
    points = grid_points(inner, MINI, GRID)
    edge_mm = MINI.width_mm / columns
    itself = float(layer_kernel(2, 2, round(3 * edge_mm, 2), NOMINAL_GEL)[0, 0])
    found, _ = forces(points)
    # the element spans several of the grid's or is one of them: at least its own, at most a few
    alone = 0.2 / itself / 1.05 * (3 * edge_mm) ** 2
    assert 0.3 * alone < found[-1] < 1.1 * alone


def test_the_force_grows_with_the_heights():
    height_mm = pressed(ball(8.0), 1.0).height_mm[0].numpy()
    once, twice = (forces(points_of(factor * height_mm))[0] for factor in (1.0, 2.0))
    np.testing.assert_allclose(twice, 2 * once, rtol=1e-3)


def test_a_lost_zero_does_not_change_the_force_over_the_surroundings():
    height_mm = pressed(ball(8.0), 1.0).height_mm[0].numpy()
    _, first = forces(points_of(height_mm))
    raised, over = forces(points_of(height_mm + 0.03))
    np.testing.assert_allclose(over, first, rtol=0.15)
    assert raised[1] > 1.1 * first[1]


def test_the_same_contact_elsewhere_has_the_same_force():
    here, there = (
        forces(points_of(pressed(ball(6.0, x), 1.0).height_mm[0].numpy()))[0] for x in (-2.0, 3.0)
    )
    np.testing.assert_allclose(here, there, rtol=0.05)


def test_untouched_pads_have_finite_features_and_next_to_no_force():
    flat = np.zeros((ROWS, COLUMNS), np.float32)
    assert np.isfinite(pressure_features(points_of(flat))).all()
    assert forces(points_of(flat))[0].max() < 0.01


def test_a_height_that_is_no_number_is_passed_on():
    points = points_of(np.zeros((ROWS, COLUMNS), np.float32)).copy()
    points[3000, 2] = np.nan
    features = pressure_features(points)
    assert features.shape == (NUM_FEATURES,) == (FIRST + 4 * len(LEVELS),)
    assert np.isnan(features).all()


@pytest.mark.parametrize("name", ["gelsight_mini", "digit", "gelstereo", "gelsight_r15", "taxels"])
def test_every_sensor_s_grid_has_features(name):
    sensor = SENSORS[name]
    y = np.linspace(-0.5, 0.5, 60)[:, None] * sensor.height_mm
    x = np.linspace(-0.5, 0.5, 80) * sensor.width_mm
    cap = np.clip(0.4 - (x**2 + y**2) / 60, 0, None).astype(np.float32)
    points = grid_points(height_grid(cloud_from_heights(cap, sensor), GRID), sensor, GRID)
    features = pressure_features(points)
    assert np.isfinite(features).all()
    assert features[0] == pytest.approx(0.4, abs=0.08)
