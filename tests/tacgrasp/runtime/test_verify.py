"""The comparison of a contact before and after the lift."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cltp.tactile.cloud import Stamp, cloud_from_heights, grid_axes_mm
from cltp.tactile.sensors import SENSORS
from primitives.devices import GripperState
from sim.grasp.devices import PAD_X_IN_TCP, PAD_Y_IN_TCP, START_POSE
from sim.grasp.turned_pad import TURNED_PAD_X_IN_TCP, TURNED_PAD_Y_IN_TCP
from tacgrasp.config.schema import PadConfig, VerifyConfig
from tacgrasp.runtime.steps import Readings
from tacgrasp.runtime.verify import compare, level_axis, lost

SETTINGS = VerifyConfig(min_area_ratio=0.6, min_depth_ratio=0.6)
MINI = SENSORS["gelsight_mini"]
X, Y = np.meshgrid(*grid_axes_mm(MINI, 60, 80))


def reading(x_mm: float = 0.0, depth_mm: float = 0.3, radius_mm: float = 4.0) -> Readings:
    """A round contact; without depth, nothing."""
    heights = depth_mm * np.clip(1 - ((X - x_mm) ** 2 + Y**2) / radius_mm**2, 0, None)
    return Readings(
        cloud=cloud_from_heights(heights, MINI),
        tcp_pose=START_POSE,
        gripper=GripperState(width_m=0.03, force_n=1.0, closed=True),
        stamp=Stamp(monotonic_s=0.0, wall_s=0.0),
        started_s=0.0,
        in_contact=depth_mm > 0,
    )


HELD, NOTHING = reading(), reading(depth_mm=0.0)


def test_an_unchanged_contact_passes() -> None:
    verification = compare(HELD, HELD, SETTINGS, slip_mm=1.0)
    assert verification.passed
    assert verification.shift_mm == pytest.approx(0.0, abs=0.01)
    assert verification.depth_ratio == pytest.approx(1.0, abs=0.01)
    assert verification.area_ratio == 1.0


def test_the_shift_is_the_distance_on_the_pad() -> None:
    verification = compare(HELD, reading(x_mm=0.5), SETTINGS, slip_mm=1.0)
    assert verification.shift_mm == pytest.approx(0.5, abs=0.05)
    assert verification.passed


@pytest.mark.parametrize(
    ("after", "message"),
    [
        (reading(x_mm=2.0), "moved 2.0 mm"),
        (reading(depth_mm=0.15), "50% of its depth"),
        (reading(radius_mm=2.8), "of its area"),
        (NOTHING, "nothing is felt any more"),
    ],
)
def test_a_changed_contact_does_not_pass_and_says_why(after: Readings, message: str) -> None:
    verification = compare(HELD, after, SETTINGS, slip_mm=1.0)
    assert not verification.passed
    assert message in verification.message


def opened(width_mm: float) -> Readings:
    """Closed fingers that are so far open."""
    state = GripperState(width_m=width_mm / 1000, force_n=0.5, closed=True)
    return replace(HELD, gripper=state)


@pytest.mark.parametrize("width_mm", [0.0, 4.0])
def test_an_object_that_left_the_grip_is_gone(width_mm: float) -> None:
    message = lost(opened(38.8), opened(width_mm))
    assert f"38.8 mm open before the lift, and are {width_mm:.1f} mm" in message


@pytest.mark.parametrize("width_mm", [38.8, 40.0, 25.0])
def test_what_may_still_be_held_is_not_called_gone(width_mm: float) -> None:
    assert lost(opened(38.8), opened(width_mm)) == ""


def test_nothing_felt_before_the_lift_does_not_pass() -> None:
    verification = compare(NOTHING, HELD, SETTINGS, slip_mm=1.0)
    assert not verification.passed
    assert math.isnan(verification.shift_mm)


def test_a_shake_is_level_however_the_sensor_is_mounted() -> None:
    upright = PadConfig(x_axis=PAD_X_IN_TCP, y_axis=PAD_Y_IN_TCP)
    mounted = PadConfig(x_axis=TURNED_PAD_X_IN_TCP, y_axis=TURNED_PAD_Y_IN_TCP)
    assert level_axis(START_POSE, upright) == pytest.approx([1.0, 0.0, 0.0])
    assert level_axis(START_POSE, mounted) == pytest.approx([-1.0, 0.0, 0.0])


def test_a_shake_of_a_tilted_pad_is_level_too() -> None:
    sine, cosine = math.sin(0.4), math.cos(0.4)
    x_axis = cosine * np.array(PAD_X_IN_TCP) + sine * np.array(PAD_Y_IN_TCP)
    y_axis = cosine * np.array(PAD_Y_IN_TCP) - sine * np.array(PAD_X_IN_TCP)
    tilted = PadConfig(x_axis=tuple(x_axis), y_axis=tuple(y_axis))
    assert level_axis(START_POSE, tilted) == pytest.approx([1.0, 0.0, 0.0])
