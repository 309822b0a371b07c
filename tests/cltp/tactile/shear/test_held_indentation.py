"""What a held contact has grown and moved by: with its force and object, not the gel's drift."""

import numpy as np
import pytest

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.held_indentation import MEAN_FRAMES, HeldIndentation

TAXELS = SENSORS["taxels"]
X, Y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(TAXELS, 12, 12)))


def bump_mm(x_mm, y_mm=0.0):
    return 0.08 * np.exp(-((X - x_mm) ** 2 + (Y - y_mm) ** 2) / 8.0)


BUMP_MM = bump_mm(0.0)
DRIFT_MM = 0.02 + 0.002 * X - 0.001 * Y + 0.0003 * X * Y


def frame(height_mm, keep=slice(None)):
    moved = np.zeros((len(X), 3))
    moved[:, 2] = height_mm
    positions = np.stack([X, Y], axis=1)
    return ShearField(
        positions_mm=positions[keep], displacement_mm=moved[keep], sensor=TAXELS, stamp=None
    )


def growth(height_mm, rest_mm=BUMP_MM):
    held = HeldIndentation([frame(rest_mm)] * 10)
    held.renew()
    held.see(frame(height_mm))
    return held.growth


def way_mm(*heights_mm):
    """Way after ``MEAN_FRAMES`` of each height."""
    held = HeldIndentation([frame(BUMP_MM)] * 10)
    for height_mm in heights_mm:
        for _ in range(5 * MEAN_FRAMES):
            held.see(frame(height_mm))
    return held.way_mm


def test_a_contact_that_stays_has_not_grown():
    assert growth(BUMP_MM) == pytest.approx(1.0)


def test_drift_that_is_smooth_is_not_taken_for_force():
    assert growth(BUMP_MM + DRIFT_MM) == pytest.approx(1.0, abs=0.02)
    assert growth(BUMP_MM - DRIFT_MM) == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("factor", [0.5, 0.8, 1.3, 2.0])
def test_a_deeper_contact_has_grown_with_and_without_drift(factor):
    assert growth(factor * BUMP_MM) == pytest.approx(factor, rel=0.12)
    assert growth(factor * BUMP_MM + DRIFT_MM) == pytest.approx(growth(factor * BUMP_MM), rel=0.03)


def cap_mm(x_mm, depth_mm, radius_mm):
    return depth_mm * np.clip(1 - ((X - x_mm) ** 2 + Y**2) / radius_mm**2, 0.0, None)


@pytest.mark.parametrize("x_mm", [0.0, 3.0])
def test_a_wide_contact_that_grows_wider_is_not_taken_for_drift(x_mm):
    rest, wider = cap_mm(x_mm, 0.13, 4.5), cap_mm(x_mm, 0.26, 6.3)
    alone = wider.sum() / rest.sum()
    assert growth(wider, rest_mm=rest) == pytest.approx(alone, rel=0.1)
    assert growth(wider + DRIFT_MM, rest_mm=rest) == pytest.approx(alone, rel=0.1)


def test_a_new_frame_weighs_a_tenth_until_the_force_changes():
    held = HeldIndentation([frame(BUMP_MM)] * 10)
    held.see(frame(2 * BUMP_MM))
    assert held.growth == pytest.approx(1.1, abs=0.02)
    held.renew()
    held.see(frame(2 * BUMP_MM))
    assert held.growth == pytest.approx(growth(2 * BUMP_MM))


def test_points_that_a_frame_misses_keep_their_last_height():
    held = HeldIndentation([frame(BUMP_MM)] * 10)
    held.renew()
    held.see(frame(BUMP_MM, keep=slice(0, 100)))
    assert held.growth == pytest.approx(1.0)


def test_a_contact_that_fills_the_pad_is_followed_without_taking_drift_away():
    wide = 0.08 - 0.00005 * (X**2 + Y**2)
    assert growth(1.5 * wide, rest_mm=wide) == pytest.approx(1.5, rel=0.05)


def test_nothing_indented_at_rest_has_no_growth():
    assert growth(BUMP_MM, rest_mm=np.zeros_like(X)) is None


@pytest.mark.parametrize("drift_mm", [0.0, DRIFT_MM, -DRIFT_MM])
def test_an_object_that_creeps_has_moved_and_drift_has_not(drift_mm):
    assert way_mm(BUMP_MM + drift_mm) == pytest.approx(0.0, abs=0.05)
    crept_mm = way_mm(bump_mm(0.2) + drift_mm, bump_mm(0.4) + drift_mm, bump_mm(0.6) + drift_mm)
    assert crept_mm == pytest.approx(0.6, abs=0.1)


def test_a_way_is_measured_from_where_the_contact_is_once_the_force_has_changed():
    held = HeldIndentation([frame(BUMP_MM)] * 10)
    held.renew()
    for _ in range(2 * MEAN_FRAMES):
        held.see(frame(1.5 * bump_mm(0.5)))
    assert held.way_mm == pytest.approx(0.0, abs=0.01)
    for _ in range(5 * MEAN_FRAMES):
        held.see(frame(1.5 * bump_mm(0.5, 0.4)))
    assert held.way_mm == pytest.approx(0.4, abs=0.05)


def test_a_contact_that_is_gone_has_not_moved():
    assert way_mm(np.zeros_like(X)) == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("depth", [1.0, 0.4])
def test_the_spread_of_the_way_is_that_of_its_noise(depth):
    rng, noise_mm, ways_mm, spreads_mm = np.random.default_rng(0), 0.008, [], []
    for _ in range(200):
        quiet = [frame(depth * BUMP_MM + noise_mm * rng.normal(size=len(X))) for _ in range(10)]
        held = HeldIndentation(quiet, noise_mm)
        for _ in range(30):
            held.see(frame(depth * BUMP_MM + noise_mm * rng.normal(size=len(X))))
        ways_mm.append(held.way_mm)
        spreads_mm.append(held.spread_mm)
    measured_mm = np.sqrt(np.mean(np.square(ways_mm)))
    assert np.mean(spreads_mm) == pytest.approx(measured_mm, rel=0.35)
