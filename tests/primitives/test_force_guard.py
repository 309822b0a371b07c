"""The hard limit where commands are written: no true force above it, whatever the hidden gain."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from primitives import LimitError
from primitives.force_guard import GuardedGripper
from primitives.gain import LEAST_FELT_N, LOST
from primitives.sense import Interval
from tests.fakes.hidden_gain import HiddenGainGripper

MAX_GAIN = 2.0
gains = st.floats(0.5, MAX_GAIN)


def guarded(
    gain: float = 1.0, *, limit_n: float = 2.0, max_gain: float = MAX_GAIN
) -> tuple[GuardedGripper, HiddenGainGripper]:
    gripper = HiddenGainGripper(gain)
    return GuardedGripper(gripper, limit_n=limit_n, max_gain=max_gain), gripper


commands = st.tuples(st.just("grip"), st.floats(0.05, 40.0))
readings = st.tuples(st.just("feel"), st.floats(1.0, 2.0), st.floats(-1.0, 1.0))
openings = st.tuples(st.just("open"))


@given(
    gain=gains,
    limit_n=st.floats(0.3, 12.0),
    course=st.lists(st.one_of(commands, readings, openings), max_size=30),
)
def test_no_course_of_commands_and_honest_readings_passes_the_limit(gain, limit_n, course):
    guard, gripper = guarded(gain, limit_n=limit_n)
    for name, *values in course:
        if name == "grip":
            guard.grip(values[0])
        elif name == "open":
            guard.open_by(0.005)
        elif gripper.state().closed:
            spread, side = values
            guard.feel(gripper.felt(spread, bias=spread**side))
        assert gripper.peak_n <= limit_n * (1 + 1e-6)


@given(gain=gains, spread=st.floats(1.05, 1.4))
def test_a_force_that_is_clearly_felt_takes_the_place_of_the_stated_bound(gain, spread):
    guard, gripper = guarded(gain, limit_n=4.0)
    assert guard.most_n == pytest.approx(4.0 / MAX_GAIN)
    guard.grip(1.1)
    guard.feel(gripper.felt(spread))
    most = max(gain * spread, min(MAX_GAIN, LOST * gain))
    assert guard.most_n == pytest.approx(4.0 / most)
    guard.grip(100.0)
    assert gripper.peak_n == pytest.approx(4.0 * gain / most)


@given(gain=gains, felt_part=st.floats(1 / LOST, 1.0))
def test_a_sensor_that_feels_too_little_does_not_lead_beyond_the_limit(gain, felt_part):
    guard, gripper = guarded(gain, limit_n=2.0)
    for _ in range(5):
        guard.grip(100.0)
        guard.feel(gripper.felt(1.2, bias=felt_part))
    assert gripper.peak_n <= 2.0 * (1 + 1e-6)


def test_a_ratio_that_grows_without_a_command_is_heard_of_at_once():
    guard, gripper = guarded(0.5, limit_n=4.0)
    guard.grip(1.1)
    guard.feel(gripper.felt(1.2))
    before_n = guard.most_n
    guard.feel_growth(1.2 * 0.5 * 1.1, 1.1)  # a noisy frame
    assert guard.most_n == before_n
    gripper.gain = 2.0
    guard.feel_growth(2.0 * 1.1, 1.1)
    guard.grip(100.0)
    assert gripper.commands_n[-1] * 2.0 <= 4.0


def test_of_a_contact_that_leaves_the_pad_no_lower_ratio_is_believed():
    guard, gripper = guarded(1.0, limit_n=4.0)
    guard.grip(1.0)
    guard.feel(gripper.felt(1.2))
    before_n = guard.most_n
    for bias in (0.7, 0.3, 0.1):
        guard.grip(1.0)
        guard.feel(gripper.felt(1.2, bias=bias))
        assert guard.most_n == before_n


def test_a_ratio_above_the_stated_bound_is_believed_of_a_clear_force_alone():
    guard, gripper = guarded(limit_n=4.0)
    for command_n, highest in ((0.12, MAX_GAIN), (0.25, 3.0 * 1.2)):
        gripper.gain = 3.0  # a gripper out of its bound
        guard.grip(command_n)
        guard.feel(gripper.felt(1.2))
        assert guard.gain is not None
        assert guard.gain.high == pytest.approx(highest)


def test_a_command_within_the_limit_is_sent_as_it_is():
    guard, gripper = guarded(limit_n=4.0)
    state = guard.grip(1.5)
    assert gripper.commands_n == [1.5]
    assert state.clamped == ""


def test_a_lowered_command_says_from_what_to_what_and_why():
    guard, gripper = guarded(limit_n=4.0)
    state = guard.grip(5.0)
    assert gripper.commands_n == [2.0]
    assert state.force_n == 2.0
    for part in ("5 N", "lowered to 2 N", "contract's limit of 4 N"):
        assert part in state.clamped
    assert guard.state().clamped == ""  # only of the last command


def test_why_no_more_is_sent_names_what_holds_it_back():
    guard, _ = guarded(limit_n=4.0)
    assert "gripper.max_force_gain" in guard.why_no_more
    guard.grip(1.0)
    guard.feel(Interval(value=1.9, low=1.0, high=3.2))
    assert guard.most_n == pytest.approx(4.0 / 3.2)
    assert "felt to within a factor of 1.7" in guard.why_no_more


@pytest.mark.parametrize("force_n", [0.0, -1.0, math.nan, math.inf, -math.inf])
def test_a_command_that_is_no_force_is_refused_and_nothing_is_sent(force_n):
    guard, gripper = guarded()
    with pytest.raises(LimitError, match="finite force above 0 N"):
        guard.grip(force_n)
    assert gripper.commands_n == []


@pytest.mark.parametrize(
    ("limit_n", "max_gain"),
    [(0.0, 2.0), (-1.0, 2.0), (math.nan, 2.0), (1.0, 0.0), (1.0, math.nan), (1.0, math.inf)],
)
def test_a_guard_without_a_limit_or_a_bound_is_refused(limit_n, max_gain):
    with pytest.raises(LimitError, match="guard needs"):
        guarded(limit_n=limit_n, max_gain=max_gain)


def test_a_baseline_without_a_contract_is_not_held_back():
    guard, gripper = guarded(limit_n=math.inf)
    guard.grip(50.0)
    assert gripper.commands_n == [50.0]


def test_the_gain_is_learned_from_clear_contact_under_a_grip_alone():
    guard, gripper = guarded()
    guard.feel(Interval(value=1.0, low=0.8, high=1.2))  # open
    assert guard.gain is None
    guard.grip(0.15)
    guard.feel(None)
    assert guard.gain is None
    guard.feel(Interval(value=0.9 * LEAST_FELT_N, low=0.1, high=0.3))
    assert guard.gain is None
    guard.grip(1.0)
    guard.feel(gripper.felt(1.2))
    assert guard.gain is not None
    assert guard.gain.value == pytest.approx(1.0)
    assert guard.gain.low == pytest.approx(1 / 1.2)
    assert guard.gain.high == pytest.approx(1.2)


def test_the_narrowest_interval_is_kept_and_a_later_one_of_equals():
    guard, gripper = guarded(limit_n=4.0)
    guard.grip(1.0)
    guard.feel(gripper.felt(1.2))
    guard.feel(gripper.felt(1.6, bias=1.3))  # on the edge of the pad
    assert guard.gain is not None
    assert guard.gain.value == pytest.approx(1.0)
    guard.feel(gripper.felt(1.2, bias=1.1))
    assert guard.gain.value == pytest.approx(1.1)


def test_a_lower_limit_holds_from_the_next_command_on():
    guard, gripper = guarded(limit_n=8.0)
    guard.grip(4.0)
    guard.keep_to(2.0, 0.0)
    assert guard.limit_n == 2.0
    guard.grip(4.0)
    assert gripper.commands_n == [4.0, 1.0]


def test_everything_but_the_grip_reaches_the_gripper_as_it_is():
    guard, gripper = guarded()
    guard.grip(1.0)
    assert guard.open_by(0.01) == gripper.state()
    guard.stop()
    guard.disconnect()
    assert gripper.calls == ["stop", "disconnect"]
