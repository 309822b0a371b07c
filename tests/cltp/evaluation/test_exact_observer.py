"""An observer with exact heights: right without errors, wrong by the errors that it believes."""

import numpy as np
import pytest

from cltp.evaluation.exact_observer import observed_state
from cltp.tactile.sensor_noise import NoiseUnit
from cltp.tactile.states import Depth, Position
from tests.fakes.tiny_weights import MINI, bump, state

X_MM, Y_MM, DEPTH_MM = 2.0, -1.0, 0.58
HEIGHTS = bump(X_MM, Y_MM, DEPTH_MM)
TRUTH = state(X_MM, Y_MM, DEPTH_MM, 2.0)


def observed(**errors: float):
    rng = np.random.default_rng(0)
    return observed_state(HEIGHTS, TRUTH, MINI, NoiseUnit(**errors), rng)


def test_a_perfect_sensor_shows_the_truth():
    state = observed()
    assert (state.depth, state.position, state.area) == (
        TRUTH.depth,
        TRUTH.position,
        TRUTH.area,
    )
    assert state.depth_mm == pytest.approx(DEPTH_MM, abs=1e-5)
    assert state.force_n == pytest.approx(2.0, rel=0.01)
    assert (state.x_mm, state.y_mm) == pytest.approx((X_MM, Y_MM), abs=0.01)


def test_fine_noise_and_missing_points_cost_the_observer_nothing():
    assert observed(fine_mm=0.05, point_loss=0.3) == observed()


def test_a_depth_scale_takes_the_depth_into_the_next_class():
    scaled = observed(depth_scale=1.1)
    assert TRUTH.depth is Depth.MODERATE and scaled.depth is Depth.DEEP
    assert scaled.depth_mm == pytest.approx(1.1 * DEPTH_MM, abs=0.002)
    assert 1.1 < scaled.force_n / 2.0 < 1.4  # the rim stands out of the dent's foot as well


def test_a_tilt_moves_the_centre_of_the_load_uphill_and_adds_its_height():
    up, down = observed(tilt_x=0.01), observed(tilt_x=-0.01)
    # either tilt changes the lost zero alike, so that it cancels in the difference
    assert up.depth_mm - down.depth_mm == pytest.approx(2 * 0.01 * X_MM, abs=0.005)
    assert up.x_mm > X_MM + 0.02 > X_MM - 0.02 > down.x_mm
    assert up.y_mm == pytest.approx(down.y_mm, abs=0.05)


def test_a_contact_that_drift_swallows_is_read_without_force():
    rng = np.random.default_rng(0)
    shallow = state(X_MM, Y_MM, 0.02, 0.3)
    unit = NoiseUnit(depth_scale=0.05)
    lost = observed_state(bump(X_MM, Y_MM, 0.02), shallow, MINI, unit, rng)
    assert lost.force_n == 0.0 and lost.area_fraction == 0.0
    assert lost.position is Position.CENTERED
