"""Levels of noise: one by one, and drawn from wide ranges, each by itself."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud, cloud_from_heights
from cltp.tactile.contact.contact_test import UntouchedGel
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.measure import contact_state
from cltp.tactile.noise_levels import WIDE, NoiseLevels, NoiseRange
from cltp.tactile.sensor_noise import MINI_SPREAD, NoiseUnit
from cltp.tactile.sensors import SENSORS

MINI = SENSORS["gelsight_mini"]
SHAPE = (76, 102)


def unit(level, seed=3):
    return NoiseUnit.draw(np.random.default_rng(seed), level)


def bump_mm() -> np.ndarray:
    x = np.linspace(-MINI.width_mm / 2, MINI.width_mm / 2, SHAPE[1])
    y = np.linspace(MINI.height_mm / 2, -MINI.height_mm / 2, SHAPE[0])
    return 0.5 * np.exp(-(((x[None] - 2) / 3) ** 2) - ((y[:, None] + 1) / 2) ** 2)


def test_each_level_scales_its_own_error_alone():
    nominal = unit(1.0)
    assert unit(NoiseLevels()) == nominal
    assert unit(NoiseLevels(fine=3)).fine_mm == pytest.approx(3 * nominal.fine_mm)
    assert unit(NoiseLevels(fine=3)).drift_mm == nominal.drift_mm
    assert unit(NoiseLevels(drift=0)).drift_mm == 0
    tilted = unit(NoiseLevels(tilt=2))
    assert (tilted.tilt_x, tilted.tilt_y) == (2 * nominal.tilt_x, 2 * nominal.tilt_y)
    scaled = unit(NoiseLevels(scale=2))
    assert scaled.depth_scale - 1 == pytest.approx(2 * (nominal.depth_scale - 1))
    assert scaled.tilt_x == nominal.tilt_x


def test_wide_levels_cover_at_least_three_times_what_is_measured_log_uniformly():
    rng = np.random.default_rng(0)
    drawn = [WIDE.draw(rng) for _ in range(4000)]
    for name in ("fine", "drift", "tilt"):
        logs = np.log([getattr(levels, name) for levels in drawn])
        assert np.exp(logs.min()) == pytest.approx(0.05, rel=0.02)
        assert np.exp(logs.max()) == pytest.approx(4.0, rel=0.02)
        assert np.median(logs) == pytest.approx((logs.min() + logs.max()) / 2, abs=0.1)
    assert {levels.scale for levels in drawn} == {1.0}
    missing = np.array([levels.missing for levels in drawn])
    assert np.mean(missing == 0) == pytest.approx(0.5, abs=0.03)
    assert missing.max() == pytest.approx(0.3, abs=0.01)


def test_wide_levels_are_drawn_independently_of_each_other():
    rng = np.random.default_rng(1)
    drawn = [WIDE.draw(rng) for _ in range(4000)]
    columns = np.array(
        [[np.log(d.fine), np.log(d.drift), np.log(d.tilt), d.missing] for d in drawn]
    )
    correlation = np.corrcoef(columns.T)
    assert np.abs(correlation - np.eye(4)).max() < 0.06


def test_wide_levels_repeat_with_their_seed():
    one, two = (WIDE.draw(np.random.default_rng(5)) for _ in range(2))
    assert one == two
    assert one != WIDE.draw(np.random.default_rng(6))


@pytest.mark.parametrize(
    "make",
    [
        lambda: NoiseLevels(fine=-1),
        lambda: NoiseLevels(drift=float("nan")),
        lambda: NoiseLevels(missing=1.0),
        lambda: NoiseRange(factor=(0.0, 2.0)),
        lambda: NoiseRange(factor=(3.0, 2.0)),
        lambda: NoiseRange(missing=1.5),
        lambda: unit(-0.5),
    ],
)
def test_levels_that_no_noise_has_are_refused(make):
    with pytest.raises(TouchError, match="noise needs"):
        make()


def test_a_frame_loses_the_fraction_of_points_that_its_unit_names():
    points = np.zeros((20_000, 3), np.float32)
    kept = NoiseUnit(point_loss=0.3).received(points, np.random.default_rng(0))
    assert len(kept) == pytest.approx(14_000, abs=200)
    assert NoiseUnit().received(points, np.random.default_rng(0)) is points


def test_shuffled_points_are_to_the_encoder_and_the_measurement_what_they_were():
    cloud = cloud_from_heights(bump_mm(), MINI, rng=np.random.default_rng(1))
    received = NoiseUnit(shuffled=True).received(cloud.points_mm, np.random.default_rng(2))
    shuffled = TactileCloud(points_mm=received, sensor=MINI)
    assert not np.array_equal(shuffled.points_mm, cloud.points_mm)
    np.testing.assert_array_equal(encoder_input(shuffled), encoder_input(cloud))
    one, two = contact_state(shuffled), contact_state(cloud)
    assert (one.depth, one.position, one.area) == (two.depth, two.position, two.area)
    assert one.force_n == pytest.approx(two.force_n, rel=1e-6)


def test_a_third_of_the_points_missing_changes_the_measured_force_little():
    cloud = cloud_from_heights(bump_mm(), MINI, rng=np.random.default_rng(1))
    whole = contact_state(cloud)
    for seed in range(5):
        received = NoiseUnit(point_loss=0.3).received(cloud.points_mm, np.random.default_rng(seed))
        state = contact_state(TactileCloud(points_mm=received, sensor=MINI))
        assert state.force_n == pytest.approx(whole.force_n, rel=0.1)
        assert state.area_fraction == pytest.approx(whole.area_fraction, rel=0.15)
        assert state.depth_mm == pytest.approx(whole.depth_mm, abs=0.03)


def test_frames_with_ever_other_points_missing_show_contacts_and_no_others():
    rng = np.random.default_rng(4)
    lossy = NoiseUnit(fine_mm=MINI_SPREAD.fine_mm, point_loss=0.3)

    def frame(heights):
        cloud = cloud_from_heights(lossy.apply(heights, MINI, rng), MINI, rng=rng)
        return TactileCloud(points_mm=lossy.received(cloud.points_mm, rng), sensor=MINI)

    untouched = np.zeros(SHAPE)
    for _ in range(10):
        gel = UntouchedGel([frame(untouched) for _ in range(5)])
        assert not any(gel.test(frame(untouched)).in_contact for _ in range(20))
        assert gel.test(frame(0.3 * bump_mm())).in_contact
