"""The gripper's gain over the grips of a run: what more grips teach, and what they don't."""

import math

import numpy as np
import pytest

from primitives.force_guard import GuardedGripper
from primitives.gain import GRIP_SPREAD, LEAST_FELT_N, NINE_OF_TEN, GainEstimator
from primitives.sense import Interval
from tests.fakes.hidden_gain import HiddenGainGripper

SPREAD = 1.35


def felt(force_n, spread=SPREAD):
    return Interval(value=force_n, low=force_n / spread, high=force_n * spread)


def test_nothing_is_known_before_something_is_clearly_felt():
    gains = GainEstimator(2.0)
    assert gains.estimate is None and gains.bound is None
    gains.feel(felt(0.9 * LEAST_FELT_N), 1.0)
    gains.feel(felt(1.0), 0.0)
    assert gains.estimate is None and gains.bound is None


def test_the_estimate_is_the_geometric_mean_of_the_grips_and_narrows_with_their_number():
    gains = GainEstimator(10.0)
    for k, ratio in enumerate((1.0, 4.0)):
        gains.new_grip()
        gains.feel(felt(ratio), 1.0)
        assert gains.estimate.num_grips == k + 1
    estimate = gains.estimate
    assert estimate.value == pytest.approx(2.0)
    half = NINE_OF_TEN * GRIP_SPREAD / math.sqrt(2)
    assert (estimate.low, estimate.high) == pytest.approx(
        (2.0 * math.exp(-half), 2.0 * math.exp(half))
    )


def test_the_same_grip_read_again_is_no_further_grip():
    gains = GainEstimator(10.0)
    for _ in range(5):
        gains.feel(felt(1.0), 1.0)
    gains.new_grip()
    gains.new_grip()
    gains.feel(felt(4.0), 1.0)
    assert gains.estimate.num_grips == 2
    assert gains.estimate.value == pytest.approx(2.0)


def test_the_bound_is_that_of_the_clearest_reading_however_many_grips_there_are():
    gains = GainEstimator(10.0)
    for ratio in (1.0, 1.1, 0.9, 1.0):
        gains.new_grip()
        gains.feel(felt(ratio), 1.0)
    assert gains.bound.high == pytest.approx(1.0 * SPREAD)
    gains.new_grip()
    gains.feel(felt(3.0, 1.6), 1.0)  # cut by the pad's edge
    assert gains.bound.high == pytest.approx(1.0 * SPREAD)
    assert gains.estimate.num_grips == 5


def test_a_guard_counts_commands_as_grips():
    gripper = HiddenGainGripper(1.5)
    guard = GuardedGripper(gripper, limit_n=10.0, max_gain=2.0)
    for force_n in (0.5, 0.5, 0.8):
        guard.grip(force_n)
        guard.feel(gripper.felt(SPREAD))
        guard.feel(gripper.felt(SPREAD))
    assert guard.gain_estimate.num_grips == 3
    assert guard.gain_estimate.value == pytest.approx(1.5)


@pytest.mark.parametrize(("grips", "limit"), [(2, 0.10), (5, 0.05)])
def test_nine_of_ten_drawn_gains_are_known_as_well_as_is_aimed_at(grips, limit):
    rng, errors, held = np.random.default_rng(0), [], []
    for _ in range(400):
        gain, gains = math.exp(rng.uniform(-0.7, 0.7)), GainEstimator(2.0)
        for _ in range(grips):
            gains.new_grip()
            ratio = gain * math.exp(0.8 * GRIP_SPREAD * rng.standard_normal())
            gains.feel(felt(ratio * 0.7), 0.7)
        errors.append(abs(gains.estimate.value / gain - 1))
        held.append(gains.estimate.low <= gain <= gains.estimate.high)
    assert np.quantile(errors, 0.9) <= limit
    assert np.mean(held) >= 0.88
