"""The growth of a held contact: of its force, and not of the gel's drift."""

import numpy as np
import pytest

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.held_volume import HeldVolume

TAXELS = SENSORS["taxels"]
X, Y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(TAXELS, 12, 12)))
BUMP_MM = 0.08 * np.exp(-(X**2 + Y**2) / 8.0)
DRIFT_MM = 0.02 + 0.002 * X - 0.001 * Y + 0.0003 * X * Y


def frame(height_mm, keep=slice(None)):
    moved = np.zeros((len(X), 3))
    moved[:, 2] = height_mm
    positions = np.stack([X, Y], axis=1)
    return ShearField(
        positions_mm=positions[keep], displacement_mm=moved[keep], sensor=TAXELS, stamp=None
    )


def growth(height_mm, rest_mm=BUMP_MM):
    volume = HeldVolume([frame(rest_mm)] * 10)
    volume.renew()
    return volume.growth(frame(height_mm))


def test_a_contact_that_stays_has_not_grown():
    assert growth(BUMP_MM) == pytest.approx(1.0)


def test_drift_that_is_smooth_is_not_taken_for_force():
    assert growth(BUMP_MM + DRIFT_MM) == pytest.approx(1.0, abs=0.02)
    assert growth(BUMP_MM - DRIFT_MM) == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("factor", [0.5, 0.8, 1.3, 2.0])
def test_a_deeper_contact_has_grown_with_and_without_drift(factor):
    assert growth(factor * BUMP_MM) == pytest.approx(factor, rel=0.12)
    assert growth(factor * BUMP_MM + DRIFT_MM) == pytest.approx(growth(factor * BUMP_MM), rel=0.03)


def test_a_new_frame_weighs_a_tenth_until_the_force_changes():
    volume = HeldVolume([frame(BUMP_MM)] * 10)
    assert volume.growth(frame(2 * BUMP_MM)) == pytest.approx(1.1, abs=0.02)
    volume.renew()
    assert volume.growth(frame(2 * BUMP_MM)) == pytest.approx(growth(2 * BUMP_MM))


def test_points_that_a_frame_misses_keep_their_last_height():
    volume = HeldVolume([frame(BUMP_MM)] * 10)
    volume.renew()
    assert volume.growth(frame(BUMP_MM, keep=slice(0, 100))) == pytest.approx(1.0)


def test_a_contact_that_fills_the_pad_is_followed_without_taking_drift_away():
    wide = 0.08 - 0.00005 * (X**2 + Y**2)
    assert growth(1.5 * wide, rest_mm=wide) == pytest.approx(1.5, rel=0.05)


def test_nothing_indented_at_rest_has_no_growth():
    assert growth(BUMP_MM, rest_mm=np.zeros_like(X)) is None
