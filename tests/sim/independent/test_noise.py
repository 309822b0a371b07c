import numpy as np

from cltp.tactile.sensors import sensor_named
from sim.independent.noise import DRIFT_MM, WHITE_MM, disturbed

MINI = sensor_named("gelsight_mini")


def test_noise_has_blind_spots_a_median_of_0_and_the_size_that_is_stated():
    blinds, spreads = [], []
    for seed in range(20):
        noisy, blind = disturbed(np.zeros((120, 160)), MINI, np.random.default_rng(seed))
        assert abs(np.median(noisy[~blind])) < 1e-6
        blinds.append(blind.mean())
        spreads.append(noisy.std())
    assert 0.005 < np.mean(blinds) < 0.1
    assert min(spreads) > WHITE_MM[0]
    assert max(spreads) < DRIFT_MM[1] + 2 * WHITE_MM[1]


def test_blind_points_have_the_height_of_their_neighbours():
    heights = np.zeros((120, 160))
    heights[:, 80:] = 1.0
    noisy, blind = disturbed(heights, MINI, np.random.default_rng(2))
    assert blind.any()
    assert set(noisy[blind]) <= set(noisy[~blind])


def test_the_same_generator_gives_the_same_noise():
    first, again = (disturbed(np.zeros((9, 12)), MINI, np.random.default_rng(4)) for _ in range(2))
    assert np.array_equal(first[0], again[0])
    assert np.array_equal(first[1], again[1])
