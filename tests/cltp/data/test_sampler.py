"""Batches of noisy clouds: what training draws is what a live encoder is given."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, MOST_COARSE, NOISY, Augmentation, Sampler, sampled
from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.noise_levels import WIDE, NoiseLevels
from cltp.tactile.point_layout import EVEN, GRID, LATTICE
from cltp.tactile.sensor_noise import NoiseUnit
from cltp.tactile.sensors import SENSORS
from tests.fakes.fake_contacts import write_contacts

MINI = SENSORS["gelsight_mini"]
LOSSY = NoiseLevels(missing=0.3, shuffled=True)


@pytest.fixture(scope="module")
def data(tmp_path_factory) -> ContactDataset:
    folder: Path = tmp_path_factory.mktemp("contacts")
    write_contacts(folder, {Split.TRAIN: range(6)})
    return ContactDataset(folder)


def sampler_of(data: ContactDataset, level, **changes) -> Sampler:
    return Sampler(
        data, Augmentation(noise_level=level, uncalibrated=0.0, mirror=False), seed=1, **changes
    )


def test_a_sample_with_missing_and_shuffled_points_is_what_the_live_encoder_gets(data):
    height_mm = data.height_mm(2)
    drawn = sampler_of(data, LOSSY).cloud(height_mm, MINI, np.random.default_rng(9))

    rng = np.random.default_rng(9)
    rng.random()  # whether the unit is calibrated
    unit = NoiseUnit.draw(rng, LOSSY)
    points = sampled(unit.apply(height_mm, MINI, rng), MINI, EVEN, rng)
    live = TactileCloud(points_mm=unit.received(points, rng), sensor=MINI)
    assert len(live.points_mm) < 0.8 * len(points)
    np.testing.assert_array_equal(drawn, encoder_input(live))


def test_missing_points_are_filled_in_cell_by_cell(data):
    whole, lossy = (
        sampler_of(data, NoiseLevels(fine=0, drift=0, tilt=0, scale=0, missing=missing))
        for missing in (0.0, 0.3)
    )
    for index in range(6):
        full, batch = (
            each.cloud(data.height_mm(index), MINI, np.random.default_rng(index))
            for each in (whole, lossy)
        )
        assert batch.shape == full.shape == (LATTICE**2, 3)
        assert (batch != full).any(axis=1).mean() == pytest.approx(0.3, abs=0.05)
        assert np.corrcoef(batch[:, 2], full[:, 2])[0, 1] > 0.9


def test_wide_noise_gives_every_sample_noise_of_its_own_strength(data):
    sampler, rng, flat = sampler_of(data, WIDE), np.random.default_rng(0), np.zeros((76, 102))
    depths = np.array([sampler.cloud(flat, MINI, rng)[:, 2] for _ in range(200)])
    roughness = np.abs(np.diff(depths, axis=1)).mean(axis=1)
    assert np.percentile(roughness, 90) > 4 * np.percentile(roughness, 10)


def test_the_same_seed_draws_the_same_wide_noise(data):
    one, two = (sampler_of(data, WIDE).batch(np.arange(6), 4).points for _ in range(2))
    np.testing.assert_array_equal(one, two)


def test_every_value_is_in_the_name_of_a_noise_and_the_default_is_named_as_it_always_was():
    # stages compare this text with the one of an earlier checkpoint
    usual = "Augmentation(noise_level=1.0, uncalibrated=0.0, mirror=False, clean=0.0)"
    assert NOISY.identity == usual
    names = ("loose", "windows", "clean", "coarse")
    others = [dataclasses.replace(NOISY, **{name: 0.125}) for name in names]
    assert len({usual, *(each.identity for each in others)}) == 5


@pytest.mark.parametrize("value", [-0.1, 5.0, float("nan")])
@pytest.mark.parametrize("name", ["uncalibrated", "clean", "loose", "windows", "coarse"])
def test_a_fraction_of_samples_is_one(name, value):
    with pytest.raises(TouchError, match=f"{name} must be a fraction from 0 to 1, got {value}"):
        Augmentation(**{name: value})


def test_a_coarse_sensor_blurs_what_it_feels_where_it_is(data):
    every = Augmentation(noise_level=0.0, mirror=False, coarse=1.0)
    fine, coarse = (
        Sampler(data, noise, layout=GRID).batch(np.arange(6), 0)
        for noise in (dataclasses.replace(every, coarse=0.0), every)
    )
    assert fine.states == coarse.states
    steps = [
        np.abs(np.diff(each.points[..., 2].reshape(-1, GRID.rows, GRID.columns), 2)).max()
        for each in (fine, coarse)
    ]
    assert steps[1] < 0.7 * steps[0]
    for before, after in zip(fine.points[..., 2], coarse.points[..., 2], strict=True):
        assert np.corrcoef(before, after)[0, 1] > 0.5


def test_some_samples_are_seen_by_smaller_pads_with_labels_to_fit(data):
    seen, usual = (
        Sampler(data, Augmentation(noise_level=0.0, mirror=False, windows=part), layout=GRID).batch(
            np.arange(6), 0
        )
        for part in (1.0, 0.0)
    )
    assert seen.points.shape == usual.points.shape
    smaller = [s.area_mm2 < u.area_mm2 for s, u in zip(seen.sensors, usual.sensors, strict=True)]
    assert sum(smaller) >= 3
    np.testing.assert_array_equal(seen.moved, smaller)
    for row, state in enumerate(seen.states):
        extent = np.abs(seen.cloud(row).points_mm[:, :2]).max(axis=0) * 2
        assert extent[0] <= seen.sensors[row].width_mm
        assert extent[1] <= seen.sensors[row].height_mm
        assert abs(state.x_mm) <= seen.sensors[row].width_mm / 2
        if state.in_contact:
            assert seen.height_mm[row].max() == pytest.approx(state.depth_mm, abs=0.06)


def test_some_smaller_pads_are_seen_in_larger_cells(data):
    every = Augmentation(noise_level=0.0, mirror=False, windows=1.0)
    seen = Sampler(data, every, layout=GRID).batch(np.arange(6).repeat(8), 0)
    points = seen.points.reshape(-1, GRID.rows, GRID.columns, 3)
    edges_mm = 10 * (points[:, 0, 1, 0] - points[:, 0, 0, 0])
    usual_mm = 10 * (points[:, 0, 0, 1] - points[:, 1, 0, 1])
    np.testing.assert_allclose(edges_mm, usual_mm, rtol=0.1)  # square, but for rounding
    smaller = edges_mm[seen.moved]
    assert smaller.min() < 1.1 * GRID.pitch_mm < 1.3 * GRID.pitch_mm < smaller.max()
    assert smaller.max() <= 1.1 * MOST_COARSE * GRID.pitch_mm


def test_a_grid_without_some_pixels_is_nearly_the_whole_one(data):
    lossy, whole = (sampler_of(data, level, layout=GRID) for level in (LOSSY, 1.0))
    points = [each.batch(np.arange(6), 0).points for each in (lossy, whole)]
    assert points[0].shape == points[1].shape == (6, GRID.num_points, 3)
    difference = np.abs(points[0] - points[1])[..., 2]
    assert 0 < np.median(difference.max(axis=1)) < 0.2  # in depths of 1.5 mm


def test_a_grid_of_loose_points_is_smoother_than_that_of_all(data):
    all_points, loose = (
        Sampler(data, Augmentation(noise_level=0.0, mirror=False, loose=part), layout=GRID)
        for part in (0.0, 1.0)
    )
    exact, rough = (each.batch(np.arange(6), 0) for each in (all_points, loose))
    assert exact.points.shape == rough.points.shape
    np.testing.assert_array_equal(exact.points[..., :2], rough.points[..., :2])
    error_mm = 1.5 * np.abs(exact.points - rough.points)[..., 2]
    assert error_mm.max() > 0
    assert error_mm.mean() < 0.01
    cloud = exact.cloud(0)
    assert cloud.grid == (GRID.rows, GRID.columns)
    np.testing.assert_allclose(encoder_input(cloud, GRID), exact.points[0], atol=1e-6)


@pytest.fixture(scope="module")
def mixed(tmp_path_factory) -> ContactDataset:
    """Thirty contacts, and after them four of one's own and one that is held out."""
    first, own = tmp_path_factory.mktemp("first"), tmp_path_factory.mktemp("own")
    write_contacts(first, {Split.TRAIN: range(30)})
    write_contacts(own, {Split.TRAIN: range(40, 44), Split.TEST: range(50, 51)})
    return ContactDataset(first, split=Split.TRAIN, also=[own])


def test_a_fraction_of_each_batch_comes_from_the_further_set(mixed):
    sampler = Sampler(mixed, CLEAN, seed=3, also_fraction=0.25)
    assert (len(mixed), mixed.num_also) == (34, 4)
    batches = [sampler.numbered(8, step).index for step in range(5)]
    assert [int((batch >= 30).sum()) for batch in batches] == [2] * 5
    first = np.concatenate([batch[batch < 30] for batch in batches])
    assert sorted(first) == list(range(30))  # an epoch of ours
    also = np.concatenate([batch[batch >= 30] for batch in batches])
    assert sorted(also[:4]) == sorted(also[4:8]) == [30, 31, 32, 33]  # two of one's own


@pytest.mark.parametrize(("fraction", "size", "also"), [(0.02, 16, 1), (0.1, 4, 1), (0.98, 16, 15)])
def test_neither_set_is_left_out_however_small_its_fraction(mixed, fraction, size, also):
    batch = Sampler(mixed, CLEAN, also_fraction=fraction).numbered(size, 0)
    assert int((batch.index >= 30).sum()) == also


def test_a_batch_of_one_contact_is_not_mixed(mixed):
    with pytest.raises(TouchError, match="a batch of one contact can't be mixed"):
        Sampler(mixed, CLEAN, also_fraction=0.5).numbered(1, 0)


def test_a_step_draws_the_same_contacts_whatever_was_drawn_before(mixed):
    sampler = Sampler(mixed, CLEAN, seed=3, also_fraction=0.25)
    later = sampler.numbered(8, 40).index
    sampler.numbered(8, 0)
    np.testing.assert_array_equal(sampler.numbered(8, 40).index, later)


def test_without_a_fraction_every_contact_comes_equally_often(mixed):
    sampler = Sampler(mixed, CLEAN, seed=3)
    drawn = np.concatenate([sampler.numbered(17, step).index for step in range(2)])
    assert sorted(drawn) == list(range(34))


def test_a_fraction_of_nothing_is_refused(data, mixed):
    with pytest.raises(TouchError, match="0 of 6 contacts"):
        Sampler(data, CLEAN, also_fraction=0.5)
    for fraction in (0.0, 1.0, -0.1):
        with pytest.raises(TouchError, match="between 0 and 1"):
            Sampler(mixed, CLEAN, also_fraction=fraction)
