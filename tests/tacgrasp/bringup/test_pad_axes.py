"""The pad's axes: found from how contacts shift, or as somebody who looked says."""

import numpy as np
import pytest

from cltp import TouchError
from primitives import LimitError
from primitives.limits import Limits
from sim.grasp.devices import SimGripper
from sim.grasp.rig import build
from tacgrasp.base.errors import UsageError
from tacgrasp.bringup.pad_axes import STEP_MM, as_yaml, axes_from_shifts, axes_named, find_pad_axes

STEPS = STEP_MM * np.vstack([np.eye(3), -np.eye(3)])


def limits(low_z_m: float = 0.15) -> Limits:
    return Limits(
        max_step_mm=5,
        workspace_low_m=(0.4, -0.2, low_z_m),
        workspace_high_m=(0.5, 0.0, 0.3),
        max_travel_mm=100,
        min_force_n=0.1,
        max_force_n=5,
        max_speed_m_s=0.4,
    )


def seen_from(x_axis, y_axis):
    return -STEPS @ np.array([x_axis, y_axis], dtype=float).T


@pytest.mark.parametrize(
    ("x_axis", "y_axis"),
    [((1, 0, 0), (0, 0, -1)), ((0, -1, 0), (1, 0, 0)), ((0.6, 0.8, 0), (0, 0, 1))],
)
def test_shifts_of_a_contact_give_the_axes_back(x_axis, y_axis):
    rng = np.random.default_rng(0)
    noisy = seen_from(x_axis, y_axis) + rng.normal(0, 0.05, (6, 2))
    measured = axes_from_shifts(STEPS, noisy)
    assert measured.axes.x_tcp == pytest.approx(x_axis, abs=0.05)
    assert measured.axes.y_tcp == pytest.approx(y_axis, abs=0.05)
    assert 0 < measured.misfit_mm < 0.4


def test_axes_that_are_nearly_square_to_the_tcp_are_made_so():
    tilt = np.radians(4)
    measured = axes_from_shifts(
        STEPS, seen_from((np.cos(tilt), np.sin(tilt), 0), (-np.sin(tilt), np.cos(tilt), 0))
    )
    assert measured.axes.x_tcp == (1.0, 0.0, 0.0)
    assert measured.axes.y_tcp == (0.0, 1.0, 0.0)


def test_an_object_that_came_along_is_refused():
    with pytest.raises(TouchError, match="did the object move along"):
        axes_from_shifts(STEPS, 0.1 * seen_from((1, 0, 0), (0, 0, -1)))
    moved = seen_from((1, 0, 0), (0, 0, -1))
    moved[1] += 3.0
    with pytest.raises(TouchError, match="did not go where a rigid pad takes it"):
        axes_from_shifts(STEPS, moved)


def test_steps_in_a_plane_are_not_enough():
    with pytest.raises(TouchError, match="all three axes"):
        axes_from_shifts(STEPS[[0, 1]], np.zeros((2, 2)))


def test_on_a_rig_the_axes_are_found_and_the_arm_is_back_with_the_gripper_open():
    rig = build("cherry_tomato", 3, start_offset_mm=(0, 0), gripper_force_gain=1.0)
    reports = []
    measured = find_pad_axes(rig, limits(), force_n=1.0, clear_mm=6.0, report=reports.append)
    assert measured.axes.x_tcp == rig.pad_x_in_tcp
    assert measured.axes.y_tcp == rig.pad_y_in_tcp
    assert len(reports) == 7
    assert rig.arm.pose().position_m == pytest.approx(rig.start_pose.position_m)
    assert not rig.gripper.state().closed


def test_without_a_contact_it_says_what_to_put_there():
    rig = build("cherry_tomato", 3, start_offset_mm=(60, 60))
    with pytest.raises(TouchError, match=r"is missing; put something small and firm"):
        find_pad_axes(rig, limits(), force_n=1.0, clear_mm=6.0, report=lambda _: None)


def test_a_step_out_of_the_workspace_is_refused_before_anything_moves():
    rig = build("cherry_tomato", 3, start_offset_mm=(0, 0))
    with pytest.raises(LimitError, match="would leave the workspace"):
        find_pad_axes(rig, limits(0.199), force_n=1.0, clear_mm=6.0, report=lambda _: None)
    assert not rig.gripper.state().closed


@pytest.mark.parametrize("clear_mm", [0.0, -1.0, 4.0, float("nan"), float("inf")])
def test_no_finger_closes_that_is_not_opened_beyond_the_steps(clear_mm):
    rig = build("cherry_tomato", 3, start_offset_mm=(0, 0))
    with pytest.raises(UsageError, match="--clear-mm must be above 4, since the arm steps 2 mm"):
        find_pad_axes(rig, limits(), force_n=1.0, clear_mm=clear_mm, report=lambda _: None)
    assert not rig.gripper.state().closed


def test_a_sensor_that_fails_leaves_the_gripper_open(monkeypatch):
    rig = build("cherry_tomato", 3, start_offset_mm=(0, 0))

    def fail(*_):
        raise TouchError("unplugged")

    monkeypatch.setattr(rig.sensor, "read", fail)
    with pytest.raises(TouchError, match="unplugged"):
        find_pad_axes(rig, limits(), force_n=1.0, clear_mm=6.0, report=lambda _: None)
    assert not rig.gripper.state().closed


def test_ctrl_c_in_a_grip_leaves_the_gripper_open(monkeypatch):
    rig, grip = build("cherry_tomato", 3, start_offset_mm=(0, 0)), SimGripper.grip

    def interrupted(self, force_n):
        grip(self, force_n)
        raise KeyboardInterrupt

    monkeypatch.setattr(SimGripper, "grip", interrupted)
    with pytest.raises(KeyboardInterrupt):
        find_pad_axes(rig, limits(), force_n=1.0, clear_mm=6.0, report=lambda _: None)
    assert rig.truth().force_n == 0.0


def test_named_axes_become_the_lines_of_a_rigs_file():
    assert as_yaml(axes_named("+x", "-z")) == (
        "pad:",
        "  x_axis: [1, 0, 0]",
        "  y_axis: [0, 0, -1]",
    )


@pytest.mark.parametrize(
    ("right", "palm", "expected"),
    [("right", "+y", "one of"), ("x", "-x", "perpendicular"), ("", "y", "one of")],
)
def test_a_wrong_name_of_an_axis_is_refused(right, palm, expected):
    with pytest.raises(UsageError, match=expected):
        axes_named(right, palm)
