"""The comparison of a contact before and after the lift."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from cltp.tactile.states import Area, ContactState, Depth, Position
from sim.grasp.devices import PAD_X_IN_TCP, PAD_Y_IN_TCP, START_POSE
from sim.grasp.turned_pad import TURNED_PAD_X_IN_TCP, TURNED_PAD_Y_IN_TCP
from tacgrasp.config.schema import PadConfig, VerifyConfig
from tacgrasp.runtime.verify import compare, level_axis

SETTINGS = VerifyConfig(min_area_ratio=0.6, min_depth_ratio=0.6)
HELD = ContactState(
    depth_mm=0.5,
    x_mm=0.0,
    y_mm=0.0,
    area_fraction=0.1,
    force_n=1.0,
    depth=Depth.MODERATE,
    position=Position.CENTERED,
    area=Area.MEDIUM,
)
NOTHING = replace(HELD, depth_mm=0.0, area_fraction=0.0, depth=None, position=None, area=None)


def test_an_unchanged_contact_passes() -> None:
    verification = compare(HELD, HELD, SETTINGS, slip_mm=1.0)
    assert verification.passed
    assert (verification.shift_mm, verification.area_ratio) == (0.0, 1.0)


def test_the_shift_is_the_distance_on_the_pad() -> None:
    verification = compare(HELD, replace(HELD, x_mm=0.3, y_mm=-0.4), SETTINGS, slip_mm=1.0)
    assert verification.shift_mm == pytest.approx(0.5)
    assert verification.passed


@pytest.mark.parametrize(
    ("after", "message"),
    [
        (replace(HELD, x_mm=0.8, y_mm=0.8), "moved 1.1 mm"),
        (replace(HELD, area_fraction=0.05), "50% of its area"),
        (replace(HELD, depth_mm=0.25), "50% of its depth"),
        (NOTHING, "nothing is felt any more"),
    ],
)
def test_a_changed_contact_does_not_pass_and_says_why(after: ContactState, message: str) -> None:
    verification = compare(HELD, after, SETTINGS, slip_mm=1.0)
    assert not verification.passed
    assert message in verification.message


def test_nothing_felt_before_the_lift_does_not_pass() -> None:
    verification = compare(NOTHING, HELD, SETTINGS, slip_mm=1.0)
    assert not verification.passed
    assert math.isnan(verification.shift_mm)


def test_a_shake_is_level_however_the_sensor_is_mounted() -> None:
    upright = PadConfig(x_axis=PAD_X_IN_TCP, y_axis=PAD_Y_IN_TCP)
    mounted = PadConfig(x_axis=TURNED_PAD_X_IN_TCP, y_axis=TURNED_PAD_Y_IN_TCP)
    assert level_axis(START_POSE, upright) == pytest.approx([1.0, 0.0, 0.0])
    assert level_axis(START_POSE, mounted) == pytest.approx([-1.0, 0.0, 0.0])
