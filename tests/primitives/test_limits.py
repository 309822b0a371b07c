"""Limits clamp or refuse, and say so."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from primitives import LimitError
from primitives.devices import Pose
from primitives.limits import (
    Limits,
    check_travel,
    check_workspace,
    clamp_force,
    clamp_step,
    distance_mm,
)

VALUES = {
    "max_step_mm": 4.0,
    "workspace_low_m": (0.2, -0.3, 0.05),
    "workspace_high_m": (0.6, 0.3, 0.5),
    "max_travel_mm": 60.0,
    "min_force_n": 0.2,
    "max_force_n": 8.0,
    "max_speed_m_s": 0.1,
}
LIMITS = Limits(**VALUES)
ANY = st.floats(allow_nan=True, allow_infinity=True)


def pose(x: float, y: float, z: float) -> Pose:
    return Pose(position_m=np.array([x, y, z]), rotvec_rad=np.zeros(3))


@given(ANY)
def test_a_force_is_sent_within_the_range_or_refused(force):
    if not (math.isfinite(force) and force > 0):
        with pytest.raises(LimitError, match="finite force above 0 N"):
            clamp_force(force, LIMITS)
        return
    sent = clamp_force(force, LIMITS)
    assert LIMITS.min_force_n <= sent.value <= LIMITS.max_force_n
    assert (sent.note == "") == (sent.value == force)


@given(ANY)
def test_a_step_is_sent_within_the_limit_or_refused(step):
    if not (math.isfinite(step) and step >= 0):
        with pytest.raises(LimitError, match="finite length"):
            clamp_step(step, LIMITS)
        return
    sent = clamp_step(step, LIMITS)
    assert sent.value == min(step, 4.0)
    assert (sent.note == "") == (sent.value == step)


def test_a_clamp_names_what_was_asked_and_the_limit():
    assert clamp_step(5, LIMITS).note == "step 5 mm shortened to max_step_mm 4"
    assert clamp_force(9, LIMITS).note == "force 9 N lowered to max_force_n 8"
    assert clamp_force(0.1, LIMITS).note == "force 0.1 N raised to min_force_n 0.2"


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1))
def test_a_pose_passes_exactly_when_it_is_in_the_box(x, y, z):
    if 0.2 <= x <= 0.6 and -0.3 <= y <= 0.3 and 0.05 <= z <= 0.5:
        check_workspace(pose(x, y, z), LIMITS)
    else:
        with pytest.raises(LimitError, match="leave the workspace"):
            check_workspace(pose(x, y, z), LIMITS)


def test_the_corners_of_the_box_belong_to_it_and_the_axis_outside_is_named():
    check_workspace(pose(0.2, -0.3, 0.05), LIMITS)
    check_workspace(pose(0.6, 0.3, 0.5), LIMITS)
    with pytest.raises(LimitError, match=r"z = 0\.0400 m"):
        check_workspace(pose(0.3, 0, 0.04), LIMITS)


def test_travel_is_allowed_up_to_its_limit_and_refused_beyond():
    check_travel(57.0, 3.0, LIMITS)
    with pytest.raises(LimitError, match="max_travel_mm"):
        check_travel(57.0, 3.1, LIMITS)


@pytest.mark.parametrize(("gone", "step"), [(math.nan, 1), (1, math.inf), (-1, 1), (1, -1)])
def test_travel_that_is_no_length_is_refused(gone, step):
    with pytest.raises(LimitError):
        check_travel(gone, step, LIMITS)


@pytest.mark.parametrize(
    "name", ["max_step_mm", "max_travel_mm", "min_force_n", "max_force_n", "max_speed_m_s"]
)
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_a_bound_that_is_not_finite_and_positive_is_refused_by_name(name, value):
    with pytest.raises(LimitError, match=name):
        Limits(**{**VALUES, name: value})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"min_force_n": 9.0}, "min_force_n"),
        ({"workspace_low_m": (0.6, 0.3, 0.5)}, "empty along x"),
        ({"workspace_low_m": (0.2, math.nan, 0.05)}, "workspace_low_m"),
        ({"workspace_high_m": (0.6, 0.3)}, "workspace_high_m"),
    ],
)
def test_ranges_that_hold_nothing_are_refused(changes, message):
    with pytest.raises(LimitError, match=message):
        Limits(**{**VALUES, **changes})


def test_distance_is_in_millimetres():
    assert distance_mm(pose(0.3, 0, 0.1), pose(0.303, 0.004, 0.1)) == pytest.approx(5.0)
