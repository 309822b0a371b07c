"""Two contacts are told from one."""

from __future__ import annotations

import numpy as np
import pytest

from cltp.tactile.cloud import TactileCloud, cloud_of_pixels, grid_axes_mm
from cltp.tactile.contact.places_apart import apart_text, gap_mm
from cltp.tactile.sensors import sensor_named

MINI = sensor_named("gelsight_mini")
X, Y = np.meshgrid(*grid_axes_mm(MINI, 75, 100))
NOISE = np.random.default_rng(0).normal(0, 0.004, X.shape)


def pressed(*places: tuple[float, float, float]) -> TactileCloud:
    """A cloud of round contacts: x, y and depth of each [mm]."""
    heights = sum(d * np.exp(-((X - x) ** 2 + (Y - y) ** 2) / 3.0) for x, y, d in places)
    return cloud_of_pixels(np.asarray(heights) + NOISE, MINI)


@pytest.mark.parametrize("apart_mm", [6.0, 10.0])
@pytest.mark.parametrize("other_mm", [0.5, 0.38])
def test_two_contacts_are_told_with_their_gap(apart_mm: float, other_mm: float) -> None:
    cloud = pressed((-apart_mm / 2, 1.0, 0.5), (apart_mm / 2, -1.0, other_mm))
    assert gap_mm(cloud) == pytest.approx(np.hypot(apart_mm, 2.0) - 2.8, abs=0.8)
    assert "of two contacts one between them is read" in apart_text(cloud, "sphere")
    assert apart_text(cloud, "dots") == ""


def test_one_contact_and_none_are_told_as_nothing() -> None:
    for cloud in (pressed((2.0, 1.0, 0.5)), pressed((0.0, 0.0, 0.0)), pressed((9.5, 7.0, 0.9))):
        assert gap_mm(cloud) == 0.0
    assert apart_text(pressed((-4.0, 0.0, 0.5), (4.0, 0.0, 0.1)), "sphere") == ""  # a rough spot
