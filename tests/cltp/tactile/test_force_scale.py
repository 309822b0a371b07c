"""How nominal newtons become newtons, and what a cloud carries of it."""

from dataclasses import replace

import numpy as np
import pytest

from cltp import TouchError
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SENSORS

SENSOR = SENSORS["gelsight_mini"]


def bump():
    y, x = np.mgrid[-7.6:7.6:60j, -10:10:80j]
    return cloud_from_heights(0.5 * np.exp(-(x**2 + y**2) / 8), SENSOR)


def test_the_force_is_the_factor_times_the_nominal_one_and_nothing_else_changes():
    nominal = bump()
    scaled = replace(nominal, force_scale=ForceScale(factor=1.7, spread=0.05, source="unit a"))
    before, after = contact_state(nominal), contact_state(scaled)
    assert after.force_n == pytest.approx(1.7 * before.force_n)
    assert replace(after, force_n=0.0) == replace(before, force_n=0.0)


def test_a_cloud_is_uncalibrated_unless_it_is_said():
    assert bump().force_scale is UNCALIBRATED
    assert not UNCALIBRATED.is_calibrated


def test_only_an_uncalibrated_force_is_marked_and_with_its_spread():
    assert UNCALIBRATED.mark == "uncalibrated, -26 to +35 %"
    assert ForceScale(factor=1.2, spread=0.04, source="unit a, 2026-01-31").mark == ""


@pytest.mark.parametrize(
    ("factor", "spread"), [(0.0, 0.1), (-1.0, 0.1), (11.0, 0.1), (np.nan, 0.1), (1.0, -0.1)]
)
def test_a_scale_that_no_unit_has_is_refused(factor, spread):
    with pytest.raises(TouchError, match="tacgrasp calibrate force"):
        ForceScale(factor=factor, spread=spread, source="x")
