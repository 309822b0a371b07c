"""Primitives on recording fakes: what goes to which device, in which order."""

import math
from dataclasses import replace
from itertools import count

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from primitives import LimitError, Primitive, RobotError
from primitives.contract import Band
from primitives.devices import GripperState, Pose
from primitives.execution import Executor, PadAxes, force_factor, rotate
from primitives.limits import Limits
from primitives.primitive import PAD_DIRECTION
from primitives.sense import ContactSense, Interval

LIMITS = Limits(
    max_step_mm=4.0,
    workspace_low_m=(0.2, -0.3, 0.05),
    workspace_high_m=(0.6, 0.3, 0.5),
    max_travel_mm=60.0,
    min_force_n=0.2,
    max_force_n=8.0,
    max_speed_m_s=0.1,
)
AXES = PadAxes(x_tcp=(0, 1, 0), y_tcp=(0, 0, -1))  # a pad that looks along the TCP's x
DOWNWARD = np.array([math.pi, 0, 0])  # fingers down: z of the TCP points to the floor
START = Pose(position_m=np.array([0.4, 0.0, 0.2]), rotvec_rad=DOWNWARD)


class FakeArm:
    """Goes where it is told; writes down every call."""

    def __init__(self, log, refuse=None):
        self.at, self.log, self.refuse = START, log, refuse

    def pose(self):
        return self.at

    def move_to(self, pose, *, speed_m_s=0.05, acceleration_m_s2=0.5):
        if self.refuse is not None:
            raise self.refuse
        self.log.append(("move_to", pose, speed_m_s))
        self.at = pose
        return pose

    def stop(self): ...

    def disconnect(self): ...


class FakeGripper:
    """Grips what it is told; writes down every call."""

    def __init__(self, log, closed_width_m):
        self.log, self.now = log, GripperState(width_m=0.04, force_n=0, closed=False)
        self.closed_width_m = closed_width_m

    def state(self):
        return self.now

    def grip(self, force_n):
        self.log.append(("grip", force_n))
        self.now = GripperState(width_m=self.closed_width_m, force_n=force_n, closed=True)
        return self.now

    def open_by(self, clear_m):
        self.log.append(("open_by", clear_m))
        self.now = GripperState(width_m=self.now.width_m + clear_m, force_n=0, closed=False)
        return self.now

    def stop(self): ...

    def disconnect(self): ...


def make(*, limits=LIMITS, refuse=None, log=None, closed_width_m=0.03, **changes):
    log = [] if log is None else log
    ticks = count(100)
    values = {
        "clear_mm": 5.0,
        "move_step_mm": 3.0,
        "first_force_n": 1.0,
        "start_pose": START,
        "pad_axes": AXES,
        "clock": lambda: float(next(ticks)),
    }
    arm = FakeArm(log, refuse)
    return (
        Executor(arm, FakeGripper(log, closed_width_m), limits, **{**values, **changes}),
        arm,
        log,
    )


def test_the_first_grasp_closes_with_the_first_force_and_does_not_move():
    executor, _, log = make()
    done = executor.grasp()
    assert log == [("grip", 1.0)]
    assert (done.primitive, done.force_n, done.opened, done.travel_mm) == (None, 1.0, False, 0.0)
    assert (done.started_s, done.ended_s) == (100.0, 101.0)


@pytest.mark.parametrize(
    ("primitive", "direction"),
    [
        # Half a turn about x leaves the pad's x (TCP y) pointing to -y of the base, and the pad's
        # +y (TCP -z) to +z: up on the pad is up in the room.
        (Primitive.MOVE_UP, (0, 0, 1)),
        (Primitive.MOVE_DOWN, (0, 0, -1)),
        (Primitive.MOVE_RIGHT, (0, -1, 0)),
        (Primitive.MOVE_LEFT, (0, 1, 0)),
    ],
)
def test_a_move_opens_goes_three_millimetres_and_closes_with_the_last_force(primitive, direction):
    executor, _, log = make()
    executor.grasp()
    executor.execute(Primitive.INCREASE_FORCE)
    log.clear()
    done = executor.execute(primitive)
    assert [call[0] for call in log] == ["open_by", "move_to", "grip"]
    assert log[0][1] == pytest.approx(0.005)
    went = log[1][1].position_m - START.position_m
    assert went == pytest.approx(0.003 * np.array(direction), abs=1e-12)
    assert log[1][1].rotvec_rad == pytest.approx(DOWNWARD)
    assert log[1][2] == LIMITS.max_speed_m_s
    assert log[2] == ("grip", 1.5)
    assert done.travel_mm == pytest.approx(3.0)
    assert (done.opened, done.clamped) == (True, ())
    assert "3 mm" in done.sent


def test_force_goes_up_by_half_and_down_to_sixty_five_percent_without_opening():
    executor, _, log = make()
    executor.grasp()
    up = executor.execute(Primitive.INCREASE_FORCE)
    down = executor.execute(Primitive.DECREASE_FORCE)
    assert log == [("grip", 1.0), ("grip", 1.5), ("grip", pytest.approx(0.975))]
    assert (up.opened, down.opened) == (False, False)
    assert executor.force_n == pytest.approx(0.975)


def test_less_force_is_never_more_than_a_reflex_has_left():
    executor, _, log = make()
    executor.grasp()
    executor.correct_force(0.5)
    down = executor.execute(Primitive.DECREASE_FORCE)
    assert (executor.force_n, down.sent) == (0.5, "nothing")
    assert log[-1][1] == 0.5
    assert executor.execute(Primitive.DECREASE_FORCE, force_n=0.65).sent == "0.65 N"  # a replay


def test_a_clamped_force_is_reported_and_one_at_its_limit_sends_nothing():
    executor, _, log = make(limits=replace(LIMITS, max_force_n=1.2))
    executor.grasp()
    first = executor.execute(Primitive.INCREASE_FORCE)
    assert (first.sent, first.asked) == ("1.2 N", "1.5 N")
    assert first.clamped == ("force 1.5 N lowered to max_force_n 1.2",)
    again = executor.execute(Primitive.INCREASE_FORCE)
    assert again.sent == "nothing"
    assert "the force is already at its limit" in again.clamped
    assert log == [("grip", 1.0), ("grip", 1.2)]


def test_a_clamped_step_is_reported():
    executor, _, log = make(move_step_mm=10.0)
    executor.grasp()
    done = executor.execute(Primitive.MOVE_UP)
    assert done.asked == "10 mm"
    assert done.clamped == ("step 10 mm shortened to max_step_mm 4",)
    assert done.travel_mm == pytest.approx(4.0)
    assert log[2][1].position_m[2] == pytest.approx(0.204)


def test_reset_opens_goes_back_and_grasps_with_the_first_force():
    executor, arm, log = make()
    executor.grasp()
    executor.execute(Primitive.MOVE_DOWN)
    executor.execute(Primitive.INCREASE_FORCE)
    log.clear()
    done = executor.execute(Primitive.RESET)
    assert [call[0] for call in log] == ["open_by", "move_to", "grip"]
    assert arm.at is START
    assert log[2] == ("grip", 1.0)
    assert done.travel_mm == pytest.approx(6.0)  # 3 there, 3 back


def test_a_move_out_of_the_workspace_is_refused_before_anything_is_sent():
    low = replace(LIMITS, workspace_low_m=(0.2, -0.3, 0.199))
    executor, _, log = make(limits=low)
    executor.grasp()
    with pytest.raises(LimitError, match="leave the workspace"):
        executor.execute(Primitive.MOVE_DOWN)
    assert log == [("grip", 1.0)]


def test_travel_adds_up_over_an_episode_and_ends_in_a_refusal():
    executor, _, log = make(limits=replace(LIMITS, max_travel_mm=8.0))
    executor.grasp()
    executor.execute(Primitive.MOVE_UP)
    executor.execute(Primitive.MOVE_DOWN)
    before = list(log)
    with pytest.raises(LimitError, match="max_travel_mm"):
        executor.execute(Primitive.MOVE_UP)
    assert log == before
    assert executor.travel_mm == pytest.approx(6.0)


def test_a_pose_that_the_device_refuses_leaves_the_object_gripped():
    executor, _, log = make(refuse=LimitError("joint limit"))
    executor.grasp()
    with pytest.raises(LimitError, match="joint limit"):
        executor.execute(Primitive.MOVE_UP)
    assert log[-1] == ("grip", 1.0)


def test_nothing_more_is_sent_after_a_device_was_lost():
    executor, _, log = make(refuse=RobotError("connection lost"))
    executor.grasp()
    with pytest.raises(RobotError, match="connection lost"):
        executor.execute(Primitive.MOVE_UP)
    assert log[-1][0] == "open_by"


@pytest.mark.parametrize("primitive", list(Primitive))
def test_a_dry_run_sends_nothing_and_says_so(primitive):
    executor, arm, log = make(dry_run=True)
    assert executor.grasp().sent == "nothing"
    done = executor.execute(primitive)
    assert log == []
    assert (done.sent, done.dry_run, done.opened, done.travel_mm) == ("nothing", True, False, 0.0)
    assert done.reached is arm.at


def test_a_dry_run_still_refuses_what_the_limits_refuse():
    low = replace(LIMITS, workspace_low_m=(0.2, -0.3, 0.199))
    executor, _, _ = make(limits=low, dry_run=True)
    executor.grasp()
    with pytest.raises(LimitError):
        executor.execute(Primitive.MOVE_DOWN)


@pytest.mark.parametrize("primitive", list(Primitive))
def test_a_primitive_before_the_first_grasp_is_refused(primitive):
    executor, _, log = make()
    with pytest.raises(LimitError, match="grasp"):
        executor.execute(primitive)
    assert log == []


@given(st.lists(st.sampled_from(list(Primitive)), max_size=25))
def test_no_row_of_primitives_leaves_the_limits(primitives):
    executor, arm, log = make()
    executor.grasp()
    for primitive in primitives:
        try:
            executor.execute(primitive)
        except LimitError:
            break
    forces = [value for name, value, *_ in log if name == "grip"]
    assert all(LIMITS.min_force_n <= f <= LIMITS.max_force_n for f in forces)
    assert executor.travel_mm <= LIMITS.max_travel_mm + 1e-9
    assert (arm.at.position_m >= np.array(LIMITS.workspace_low_m)).all()
    assert (arm.at.position_m <= np.array(LIMITS.workspace_high_m)).all()


@given(st.tuples(*[st.floats(-3.14, 3.14)] * 3), st.sampled_from(list(PAD_DIRECTION)))
def test_a_step_has_its_length_whatever_the_tool_points_at(rotvec, primitive):
    start = Pose(position_m=START.position_m, rotvec_rad=np.array(rotvec))
    executor, arm, _ = make(start_pose=start)
    arm.at = start
    executor.grasp()
    executor.execute(primitive)
    assert 1e3 * np.linalg.norm(arm.at.position_m - start.position_m) == pytest.approx(3.0)


def test_rotation_vectors_turn_as_worked_out_by_hand():
    quarter = np.array([0, 0, math.pi / 2])
    assert rotate(quarter, np.array([1.0, 0, 0])) == pytest.approx(np.array([0, 1, 0]))
    third = 2 * math.pi / 3 / math.sqrt(3) * np.ones(3)  # about the diagonal: x -> y -> z
    assert rotate(third, np.array([1.0, 0, 0])) == pytest.approx(np.array([0, 1, 0]))
    assert rotate(np.zeros(3), np.array([1.0, 2, 3])) == pytest.approx(np.array([1, 2, 3]))


@pytest.mark.parametrize(
    ("x", "y", "message"),
    [
        ((2, 0, 0), (0, 1, 0), "x_tcp"),
        ((1, 0, 0), (0, 1), "y_tcp"),
        ((1, 0, 0), (math.nan, 0, 0), "y_tcp"),
        ((1, 0, 0), (1, 0, 0), "perpendicular"),
    ],
)
def test_axes_that_are_no_axes_are_refused(x, y, message):
    with pytest.raises(LimitError, match=message):
        PadAxes(x_tcp=x, y_tcp=y)


@pytest.mark.parametrize("name", ["clear_mm", "move_step_mm", "first_force_n"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan])
def test_sizes_that_are_not_finite_and_positive_are_refused(name, value):
    with pytest.raises(LimitError):
        make(**{name: value})


def test_a_start_outside_the_workspace_is_refused():
    far = Pose(position_m=np.array([2.0, 0, 0.2]), rotvec_rad=DOWNWARD)
    with pytest.raises(LimitError, match="workspace"):
        make(start_pose=far)


def feeling(touched_at_n, first_force_n, *, closed_width_m=0.03, felt=None, **changes):
    """An executor whose touch is felt from a commanded force on, and its log."""
    log = []
    sense = ContactSense(
        take_reference=lambda: log.append(("reference",)),
        in_contact=lambda: [e[1] for e in log if e[0] == "grip"][-1] >= touched_at_n - 1e-9,
        felt_force=lambda: felt,
    )
    executor, _, devices_log = make(
        sense=sense, first_force_n=first_force_n, log=log, closed_width_m=closed_width_m, **changes
    )
    assert devices_log is log
    return executor, log


def test_an_approach_stops_at_the_first_force_that_is_felt():
    executor, log = feeling(0.33, 0.6)
    executed = executor.grasp()
    assert [e[1] for e in log if e[0] == "grip"] == pytest.approx([0.2, 0.26, 0.338])
    assert log[0] == ("reference",)
    assert executed.force_n == pytest.approx(0.338)
    assert "felt" in executed.sent


def test_an_approach_never_passes_the_first_force():
    executor, log = feeling(99.0, 0.42)
    executed = executor.grasp()
    forces = [e[1] for e in log if e[0] == "grip"]
    assert forces == pytest.approx([0.2, 0.26, 0.338, 0.42])
    assert executed.force_n == pytest.approx(0.42)
    assert "nothing was felt" in executed.sent


def test_a_move_takes_a_new_reference_and_closes_to_the_last_force():
    executor, log = feeling(0.3, 0.6)
    executor.grasp()
    del log[:]
    executor.execute(Primitive.MOVE_UP)
    names = [e[0] for e in log]
    assert names.index("open_by") < names.index("move_to") < names.index("reference")
    assert [e[1] for e in log if e[0] == "grip"] == pytest.approx([0.338])


def test_a_move_after_which_nothing_is_felt_closes_further_in_the_steps_of_an_approach():
    executor, log = feeling(0.2, 0.5)
    executor.grasp()
    del log[:]
    executor._sense = replace(
        executor._sense,
        in_contact=lambda: [e[1] for e in log if e[0] == "grip"][-1] >= 0.3,
    )
    executed = executor.execute(Primitive.MOVE_UP)
    assert [e[1] for e in log if e[0] == "grip"] == pytest.approx([0.2, 0.26, 0.338])
    assert executed.force_n == pytest.approx(0.338)


def test_a_replayed_force_is_commanded_as_recorded():
    executor, log = feeling(0.3, 0.6)
    executor.grasp(0.5)
    executor.execute(Primitive.INCREASE_FORCE, 0.77)
    executor.execute(Primitive.RESET, 0.31)
    assert [e[1] for e in log if e[0] == "grip"] == pytest.approx([0.5, 0.77, 0.31])


@given(
    increase=st.booleans(),
    felt_n=st.floats(0.01, 50),
    low=st.floats(0.1, 10),
    width=st.floats(0.05, 10),
)
def test_a_change_of_force_goes_towards_the_goal_and_never_leaves_it(increase, felt_n, low, width):
    goal = Band(low=low, high=low + width)
    felt = Interval(value=felt_n, low=felt_n / 2, high=felt_n * 2)
    factor = force_factor(increase=increase, felt=felt, goal_n=goal)
    assert 0.5 <= factor <= 2.0
    assert factor >= 1 if increase else factor <= 1
    if felt_n in goal:
        assert goal.low * (1 - 1e-9) <= felt_n * factor <= goal.high * (1 + 1e-9)
    elif increase and felt_n < goal.low:
        assert felt_n * factor <= goal.high * (1 + 1e-9)
    elif not increase and felt_n > goal.high:
        assert felt_n * factor >= goal.low * (1 - 1e-9)


def test_without_a_felt_force_the_factors_are_the_plain_ones():
    assert force_factor(increase=True, felt=None, goal_n=Band(low=1, high=2)) == 1.5
    assert force_factor(increase=False, felt=None, goal_n=Band(low=1, high=2)) == 0.65


@pytest.mark.parametrize("bounds", [(2, 1, 3), (1, 2, 1.5), (math.nan, 1, 2), (1, math.inf, 2)])
def test_an_interval_in_no_order_is_refused(bounds):
    low, value, high = bounds
    with pytest.raises(LimitError):
        Interval(value=value, low=low, high=high)


def test_the_steps_of_an_approach_are_at_least_the_grippers_own():
    executor, log = feeling(99.0, 0.6, force_step_n=0.15)
    executor.grasp()
    forces = [e[1] for e in log if e[0] == "grip"]
    assert forces == pytest.approx([0.2, 0.35, 0.5, 0.6])


def test_fingers_that_close_on_nothing_are_not_closed_further():
    executor, log = feeling(99.0, 0.6, closed_width_m=0.0006)
    executed = executor.grasp()
    assert [e[1] for e in log if e[0] == "grip"] == pytest.approx([0.2])
    assert "nothing was felt" in executed.sent


def test_a_reset_without_contact_opens_as_wide_as_before_the_first_grasp():
    executor, log = feeling(99.0, 0.6, closed_width_m=0.0)
    executor.grasp()
    executor.execute(Primitive.RESET)
    assert [e[1] for e in log if e[0] == "open_by"] == pytest.approx([0.04])


def test_a_reset_with_contact_opens_by_the_clearance_alone():
    felt = Interval(value=0.2, low=0.1, high=0.4)
    executor, log = feeling(0.2, 0.6, felt=felt)
    executor.grasp()
    executor.execute(Primitive.RESET)
    assert [e[1] for e in log if e[0] == "open_by"] == pytest.approx([0.005])
