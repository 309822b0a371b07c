"""Contacts are registered: shift, scale, and the directions along which nothing shows."""

from __future__ import annotations

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud, cloud_from_heights, grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.shift import contact_shift

MINI = SENSORS["gelsight_mini"]
X, Y = np.meshgrid(*grid_axes_mm(MINI, 60, 80))


def bump(x_mm: float, y_mm: float, depth_mm: float = 0.1, width_mm: float = 3.0) -> np.ndarray:
    return depth_mm * np.exp(-((X - x_mm) ** 2 + (Y - y_mm) ** 2) / (2 * width_mm**2))


def seen(heights: np.ndarray, rng: np.random.Generator, noise_mm: float = 0.002) -> TactileCloud:
    noisy = heights + noise_mm * rng.standard_normal(heights.shape)
    return cloud_from_heights(noisy, MINI, rng=rng)


@pytest.mark.parametrize("shift", [(0.0, 0.0), (2.0, 0.0), (-0.7, 1.1), (1.5, -3.0)])
def test_the_shift_of_a_contact_is_measured(shift: tuple[float, float]) -> None:
    rng = np.random.default_rng(0)
    found = contact_shift(seen(bump(0, 1), rng), seen(bump(shift[0], 1 + shift[1]), rng))
    assert (found.x_mm, found.y_mm) == pytest.approx(shift, abs=0.1)
    assert found.spread_mm < 0.15
    assert found.scale == pytest.approx(1.0, abs=0.05)


def test_tilt_broad_drift_and_a_relaxed_grip_are_no_motion() -> None:
    rng = np.random.default_rng(1)
    drift = 0.1 + 0.01 * X - 0.02 * Y + 0.1 * (X / 10) ** 2
    found = contact_shift(seen(bump(1, 0), rng), seen(0.8 * bump(1, 0) + drift, rng))
    assert found.length_mm < 0.15
    assert found.scale == pytest.approx(0.8, abs=0.05)


def test_along_an_axis_where_nothing_changes_the_shift_is_zero() -> None:
    rng = np.random.default_rng(2)
    bar = 0.3 * np.exp(-(X**2) / 8)
    found = contact_shift(seen(bar, rng), seen(0.3 * np.exp(-((X - 1) ** 2) / 8), rng))
    assert (found.x_mm, found.y_mm) == pytest.approx((1.0, 0.0), abs=0.05)


def test_a_contact_that_has_gone_leaves_nothing_of_its_height() -> None:
    rng = np.random.default_rng(3)
    found = contact_shift(seen(bump(0, 0), rng), seen(np.zeros_like(X), rng))
    assert found.scale < 0.1


def test_clouds_may_have_lost_points() -> None:
    rng = np.random.default_rng(4)
    before, after = seen(bump(0, 0), rng), seen(bump(1, 0), rng)
    kept = after.points_mm[rng.random(len(after.points_mm)) > 0.3]
    found = contact_shift(before, TactileCloud(points_mm=kept, sensor=MINI))
    assert (found.x_mm, found.y_mm) == pytest.approx((1.0, 0.0), abs=0.15)


def test_clouds_of_two_sensors_are_refused() -> None:
    rng = np.random.default_rng(5)
    other = cloud_from_heights(bump(0, 0), SENSORS["digit"], rng=rng)
    with pytest.raises(TouchError, match="one sensor"):
        contact_shift(seen(bump(0, 0), rng), other)
