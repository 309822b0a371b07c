"""The matched filter: light bumps beside drift are found, drift alone is not, deep ones stay."""

import numpy as np
import pytest

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.contact.contact_test import LEAST_GAIN
from cltp.tactile.contact.matched_filter import MatchedFilter, filter_noise_mm
from cltp.tactile.sensor_noise import smooth_field
from cltp.tactile.sensors import sensor_named

TAXELS, N, NOISE_MM = sensor_named("taxels"), 12, 0.001
X, Y = np.meshgrid(*grid_axes_mm(TAXELS, N, N))


def bump(depth_mm, x_mm=0.0, y_mm=0.0, width_mm=1.8):
    return depth_mm * np.exp(-((X - x_mm) ** 2 + (Y - y_mm) ** 2) / (2 * width_mm**2))


def heights(rng, drift_mm=0.0, contact=0.0):
    drift = drift_mm * smooth_field((N, N), TAXELS, rng.uniform(10, 20), rng)
    return drift + contact + rng.normal(0, NOISE_MM, (N, N))


@pytest.fixture
def rng():
    return np.random.default_rng(0)


@pytest.fixture(scope="module")
def test():
    return MatchedFilter(TAXELS, N, NOISE_MM)


@pytest.mark.parametrize("drift_mm", [0.0, 0.003, 0.03])
def test_drift_alone_is_no_contact_however_strong(rng, test, drift_mm):
    gains = [test.fit(heights(rng, drift_mm)).gain for _ in range(60)]
    assert max(gains) < LEAST_GAIN


@pytest.mark.parametrize("place_mm", [(0, 0), (8.5, 6.5), (-10.5, 3.0)])
@pytest.mark.parametrize(("drift_mm", "depth_mm"), [(0.0, 0.025), (0.003, 0.025), (0.03, 0.06)])
def test_a_bump_is_found_beside_drift(rng, test, drift_mm, depth_mm, place_mm):
    for _ in range(20):
        fit = test.fit(heights(rng, drift_mm, bump(depth_mm, *place_mm)))
        assert fit.gain > LEAST_GAIN
        assert fit.gain > fit.raised_gain


def test_what_rises_is_told_from_what_is_pressed_in(rng, test):
    fit = test.fit(heights(rng, contact=-bump(0.05)))
    assert fit.raised_gain > 4 * fit.gain


@pytest.mark.parametrize("depth_mm", [0.05, 0.2, 0.8])
def test_a_contact_of_another_shape_stays_one_however_deep(rng, test, depth_mm):
    flat = depth_mm * (np.hypot(X - 1, Y + 1) < 4.0)
    assert test.fit(heights(rng, contact=flat)).gain > LEAST_GAIN


def test_the_drift_under_a_contact_is_told_from_around_it(rng, test):
    errors, drifts = [], []
    for _ in range(30):
        drift = 0.02 * smooth_field((N, N), TAXELS, 14.0, rng)
        seen = drift + bump(0.04, 2, -1) + rng.normal(0, NOISE_MM, (N, N))
        left = test.drift_under(seen, test.region(test.fit(seen))) - drift
        under = bump(1.0, 2, -1) > 0.3
        errors.append(np.abs(left[under]).mean())
        drifts.append(np.abs(drift[under]).mean())
    assert np.median(errors) < 0.25 * np.median(drifts)


def test_a_contact_across_the_pad_is_not_taken_for_drift(test):
    ridge = 0.1 * np.exp(-(X**2) / 2)
    assert not test.drift_under(ridge, bump(1.0) > 0.5).any()


def test_a_contact_that_leaves_too_little_around_it_tells_no_drift(rng, test):
    region = np.ones((N, N), dtype=bool)
    region[0] = False
    assert not test.drift_under(heights(rng, 0.02), region).any()


def test_noise_in_common_counts_for_more_than_that_of_a_cell(rng):
    white = [rng.normal(0, NOISE_MM, (N, N)) for _ in range(16)]
    common = [NOISE_MM * smooth_field((N, N), TAXELS, 4.0, rng) for _ in range(16)]
    assert filter_noise_mm(white, TAXELS) == pytest.approx(NOISE_MM, rel=0.15)
    assert filter_noise_mm(common, TAXELS) > 2 * NOISE_MM
