import dataclasses
import math

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from cltp.data.sampler import sampled
from cltp.encoder.class_token import height_quantiles
from cltp.encoder.encoder import VARIANTS, EncoderConfig, TactileEncoder
from cltp.encoder.tokenizers import grid_channels, grid_maps, log_cell_edge
from cltp.errors import TouchError
from cltp.tactile.cells import height_grid, resampled, without_holes
from cltp.tactile.cloud import TactileCloud, cloud_of_pixels, grid_axes_mm
from cltp.tactile.encoder_input import OUTSIDE, encoder_input, lattice_points, unscaled
from cltp.tactile.markers import marker_cloud
from cltp.tactile.point_layout import EVEN, GRID, PointLayout
from cltp.tactile.sensors import SENSORS, SensorSpec

MINI = SENSORS["gelsight_mini"]
ROWS, COLUMNS = 240, 320


def dent(
    sensor=MINI, x_mm: float = 4.0, y_mm: float = -3.0, rows: int = ROWS, columns: int = COLUMNS
) -> np.ndarray:
    """A smooth dent of 0.8 mm, 2 mm wide."""
    x, y = grid_axes_mm(sensor, rows, columns)
    squared = (x[None, :] - x_mm) ** 2 + (y[:, None] - y_mm) ** 2
    return (0.8 * np.exp(-squared / (2 * 2.0**2))).astype(np.float32)


def cells_of(sensor=MINI, x_mm: float = 4.0, y_mm: float = -3.0) -> np.ndarray:
    """The dent in the cells that the sensor's pad takes of the grid."""
    return dent(sensor, x_mm, y_mm, *GRID.cells_on(sensor.width_mm, sensor.height_mm))


@pytest.mark.parametrize("bad", [{"rows": 1, "columns": 8}, {"rows": 8, "columns": 0}])
def test_a_layout_out_of_range_is_refused(bad: dict[str, int]) -> None:
    with pytest.raises(TouchError, match="at least 2 rows"):
        PointLayout(**bad)


def test_even_sampling_is_that_of_live_clouds() -> None:
    points = sampled(dent(), MINI, EVEN, np.random.default_rng(0)).astype(np.float32)
    cloud = TactileCloud(points_mm=points, sensor=MINI)
    np.testing.assert_array_equal(lattice_points(cloud), points)


@pytest.mark.parametrize("sensor", SENSORS.values(), ids=lambda sensor: sensor.name)
@pytest.mark.parametrize(("rows", "columns"), [(75, 100), (240, 320), (48, 64), (129, 129)])
def test_a_grid_of_any_pixels_is_the_same_surface(sensor, rows: int, columns: int) -> None:
    pixels = dent(sensor, 2.0, -1.5, rows, columns)
    grid = height_grid(cloud_of_pixels(pixels, sensor), GRID)
    np.testing.assert_allclose(grid, cells_of(sensor, 2.0, -1.5), atol=0.02)
    assert grid.max() == pytest.approx(0.8, abs=0.02)


def test_fine_pixels_are_averaged_by_area_and_none_is_dropped() -> None:
    spike = np.zeros((ROWS, COLUMNS), np.float32)
    spike[100, 200] = 1.0
    grid = resampled(spike, GRID.rows, GRID.columns)
    cells_of_pixel = (GRID.num_points) / (ROWS * COLUMNS)
    assert grid.sum() == pytest.approx(cells_of_pixel, rel=1e-4)
    noise = np.random.default_rng(0).standard_normal((ROWS, COLUMNS)).astype(np.float32)
    assert resampled(noise, GRID.rows, GRID.columns).std() < 0.4  # over ten pixels in a cell


@pytest.mark.parametrize("missing", [0.1, 0.3])
@pytest.mark.parametrize("shape", [(240, 320), (75, 100)])
def test_missing_pixels_in_any_order_change_little(shape: tuple[int, int], missing: float) -> None:
    rng = np.random.default_rng(0)
    whole = cloud_of_pixels(dent(rows=shape[0], columns=shape[1]), MINI)
    kept = whole.points_mm[rng.random(len(whole.points_mm)) >= missing]
    partial = TactileCloud(points_mm=rng.permutation(kept), sensor=MINI)
    assert partial.grid is None
    np.testing.assert_allclose(height_grid(partial, GRID), height_grid(whole, GRID), atol=0.08)


def test_loose_points_are_interpolated_honestly_worse() -> None:
    points = sampled(dent(), MINI, EVEN, np.random.default_rng(0)).astype(np.float32)
    loose = TactileCloud(points_mm=points, sensor=MINI)
    error = np.abs(height_grid(loose, GRID) - cells_of())
    assert 0.005 < error.max() < 0.06
    deepest = points[points[:, 2].argmax()]
    assert height_grid(loose, GRID).max() == pytest.approx(deepest[2], abs=0.02)


def test_markers_are_a_smooth_surface() -> None:
    sensor = SENSORS["gelstereo"]
    grid = height_grid(marker_cloud(dent(sensor), sensor), GRID)
    error = np.abs(grid - cells_of(sensor))  # markers are 1.1 mm apart
    assert error.max() < 0.08
    assert error.mean() < 0.005


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**16), st.floats(0.02, 0.98))
def test_holes_are_filled_between_the_lowest_and_the_highest_neighbour(
    seed: int, part: float
) -> None:
    rng = np.random.default_rng(seed)
    heights = rng.standard_normal((20, 30)).astype(np.float32)
    known = rng.random((20, 30)) < part
    known[3, 4] = True
    filled = without_holes(heights, known)
    np.testing.assert_array_equal(filled[known], heights[known])
    assert heights[known].min() - 1e-5 <= filled.min()
    assert filled.max() <= heights[known].max() + 1e-5


def test_a_level_surface_with_holes_stays_level() -> None:
    known = np.random.default_rng(1).random((75, 100)) < 0.1
    np.testing.assert_allclose(without_holes(np.full((75, 100), 0.3), known), 0.3, atol=1e-6)


@pytest.mark.parametrize("sensor", SENSORS.values(), ids=lambda sensor: sensor.name)
def test_scaled_points_of_a_grid_are_undone(sensor) -> None:
    points = encoder_input(cloud_of_pixels(cells_of(sensor), sensor), GRID)
    assert points.shape == (GRID.num_points, 3)
    inside = points[points[:, 2] > OUTSIDE]
    assert inside[:, 0].max() == pytest.approx(sensor.width_mm / 20, rel=0.02)  # units of 10 mm
    cloud = unscaled(points, sensor, GRID)
    assert cloud.grid == GRID.cells_on(sensor.width_mm, sensor.height_mm)
    np.testing.assert_allclose(height_grid(cloud, GRID), cells_of(sensor), atol=1e-5)


def test_channels_hold_indentation_relief_and_position() -> None:
    points = torch.from_numpy(encoder_input(cloud_of_pixels(cells_of(), MINI), GRID))[None]
    channels = grid_channels(grid_maps(points))
    assert channels.shape == (1, 5, GRID.rows, GRID.columns)
    assert (channels[:, 4] == 1).all()
    assert channels[0, 0].max() == pytest.approx(5 * 0.8 / MINI.max_depth_mm, rel=0.01)
    # The curvature of the dent is 0.8 / 2² mm per mm²: a mean over 3 × 3 cells is lower by
    # (2/3) 0.2² times that.
    drop = (2 / 3) * 0.2**2 * 0.8 / 2.0**2
    assert channels[0, 1].max() == pytest.approx(50 * drop / MINI.max_depth_mm, rel=0.1)
    assert channels[0, 2, 0].diff().min() > 0 > channels[0, 3, :, 0].diff().max()


def other_pad(columns: int, rows: int, mm_per_px: float = 0.1) -> SensorSpec:
    return dataclasses.replace(MINI, columns=columns, rows=rows, mm_per_px=mm_per_px)


@settings(max_examples=40, deadline=None)
@given(st.integers(20, 400), st.integers(20, 400))
def test_cells_are_square_and_the_pad_lies_in_the_middle(columns: int, rows: int) -> None:
    sensor = other_pad(columns, rows)
    taken = GRID.cells_on(sensor.width_mm, sensor.height_mm)
    points = encoder_input(cloud_of_pixels(np.zeros((rows, columns)), sensor), GRID)
    grid = points.reshape(GRID.rows, GRID.columns, 3)
    inside = grid[..., 2] > OUTSIDE
    assert taken == (inside.any(axis=1).sum(), inside.any(axis=0).sum())
    np.testing.assert_array_equal(inside, inside[::-1, ::-1])
    np.testing.assert_allclose(grid[inside].mean(axis=0)[:2], 0.0, atol=1e-4)
    edges_mm = [sensor.width_mm / taken[1], sensor.height_mm / taken[0]]
    assert min(edges_mm) > 0.9 * GRID.pitch_mm or min(taken) <= 3
    # Either count may be one off what its side holds, in opposite ways: cells lie symmetrically.
    assert edges_mm[0] / edges_mm[1] == pytest.approx(1, rel=2.2 / min(taken))
    log_edge = log_cell_edge(torch.from_numpy(points)[None])
    assert 0.2 * float(log_edge.exp()) == pytest.approx(edges_mm[0], rel=1e-3)


def test_channels_are_nothing_beyond_the_pad() -> None:
    sensor = other_pad(120, 100)
    heights = dent(sensor, 0.0, 0.0, *GRID.cells_on(sensor.width_mm, sensor.height_mm)) + 0.1
    maps = grid_maps(torch.from_numpy(encoder_input(cloud_of_pixels(heights, sensor), GRID))[None])
    beyond = maps.inside == 0
    assert beyond.any()
    channels = grid_channels(maps)[0]
    assert (channels[:2, beyond[0]] == 0).all()
    # at the pad's edge the mean is of the cells inside alone: a level surface has no relief there
    level = encoder_input(cloud_of_pixels(np.full_like(heights, 0.3), sensor), GRID)
    relief = grid_channels(grid_maps(torch.from_numpy(level)[None]))[0, 1]
    torch.testing.assert_close(relief, torch.zeros_like(relief), atol=1e-5, rtol=0)


def test_height_quantiles_leave_out_what_lies_beyond_the_pad() -> None:
    sensor = other_pad(100, 100)
    heights = dent(sensor, 0.0, 0.0, *GRID.cells_on(sensor.width_mm, sensor.height_mm))
    points = torch.from_numpy(encoder_input(cloud_of_pixels(heights, sensor), GRID))[None]
    quantiles = height_quantiles(points, 64)[0]
    assert quantiles[-1] == pytest.approx(heights.min() / sensor.max_depth_mm, abs=1e-6)


def test_height_quantiles_of_a_grid_span_all_heights() -> None:
    points = torch.from_numpy(encoder_input(cloud_of_pixels(cells_of(), MINI), GRID))[None]
    quantiles = height_quantiles(points, 64)[0]
    assert (quantiles.diff() <= 0).all()
    assert quantiles[0] == points[0, :, 2].max() and quantiles[-1] == points[0, :, 2].min()


@pytest.mark.parametrize("tokenizer", [name for name, v in VARIANTS.items() if v.groups])
def test_every_variant_gives_a_token_for_each_group(tokenizer: str) -> None:
    variant = VARIANTS[tokenizer]
    config = EncoderConfig(
        tokenizer=tokenizer, dim=24, depth=1, heads=2, stem_dim=8, num_groups=variant.groups or 0
    )
    shape = (3, 64, 64) if variant.takes_images else (variant.layout.num_points, 3)
    out = TactileEncoder(config)(torch.rand(2, *shape))
    assert out.tokens.shape == (2, config.num_groups + 1, 24)
    with pytest.raises(TouchError, match="groups, got 7"):
        EncoderConfig(tokenizer=tokenizer, num_groups=7)


def test_area_is_told_whatever_the_sensor_s_size() -> None:
    """The same body is as large, in scaled points, on any sensor."""
    widths = []
    for sensor in SENSORS.values():
        points = encoder_input(cloud_of_pixels(cells_of(sensor, 0.0, 0.0), sensor), GRID)
        deep = points[points[:, 2] > 0.4 / sensor.max_depth_mm]
        widths.append(np.ptp(deep[:, 0]))
    assert max(widths) / min(widths) < 1.15
    assert widths[0] == pytest.approx(2 * 2.0 * math.sqrt(2 * math.log(2)) / 10, rel=0.1)
