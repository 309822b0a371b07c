"""An arm is stopped when another device of its rig fails while it moves."""

import threading

import numpy as np
import pytest

from cltp import TouchError
from primitives import RobotError
from primitives.devices import Pose
from tacgrasp.rig.guard import GuardedArm

HERE = Pose(position_m=np.array([0.4, 0.0, 0.2]), rotvec_rad=np.array([np.pi, 0.0, 0.0]))


class SlowArm:
    """Moves until it is stopped or told that it has arrived; a later move arrives at once."""

    def __init__(self):
        self.started, self.ended = threading.Event(), threading.Event()
        self.stops = self.moves = 0
        self.error = None

    def pose(self):
        return HERE

    def move_to(self, pose, *, speed_m_s=0.05, acceleration_m_s2=0.5):
        self.moves += 1
        if self.stops:
            return pose
        self.started.set()
        assert self.ended.wait(20)
        if self.error is not None:
            raise self.error
        return pose

    def stop(self):
        self.stops += 1
        self.error = RobotError("the move was cut short by a stop")
        self.ended.set()

    def disconnect(self):
        pass


class Device:
    """Fails, or is silent, when it is told to."""

    def __init__(self):
        self.error, self.stale = None, ""

    def check(self):
        if self.error is not None:
            raise self.error
        return self.stale


@pytest.fixture
def arm():
    return SlowArm()


@pytest.fixture
def device():
    return Device()


@pytest.fixture
def guarded(arm, device):
    guarded = GuardedArm(arm, [device.check])
    yield guarded
    guarded.disconnect()


@pytest.mark.parametrize(
    "error", [RobotError("no answer"), TouchError("no frame"), OSError("of a plugin")]
)
def test_a_device_that_fails_during_a_move_stops_the_arm_and_is_named(guarded, arm, device, error):
    def fail():
        arm.started.wait(20)
        device.error = error

    threading.Thread(target=fail).start()
    with pytest.raises(RobotError, match=rf"{error}; the arm was stopped"):
        guarded.move_to(HERE)
    assert arm.stops == 1


@pytest.mark.parametrize("error", [TouchError("no frame"), AttributeError("no frame")])
def test_with_a_failed_device_no_move_begins(guarded, arm, device, error):
    device.error = error
    with pytest.raises(RobotError, match="no frame; the arm was not moved"):
        guarded.move_to(HERE)
    assert arm.moves == arm.stops == 0


def test_a_move_with_all_well_arrives_and_nothing_is_stopped(guarded, arm):
    arm.ended.set()
    assert guarded.move_to(HERE) is HERE
    assert arm.stops == 0


def test_the_arms_own_fault_is_raised_as_it_is(guarded, arm):
    arm.error = RobotError("protective stop")
    arm.ended.set()
    with pytest.raises(RobotError, match=r"^protective stop$"):
        guarded.move_to(HERE)


def test_a_device_that_fails_between_moves_stops_nothing(guarded, arm, device):
    arm.ended.set()
    guarded.move_to(HERE)
    device.error = RobotError("gone")
    threading.Event().wait(0.05)
    assert arm.stops == 0


def silence_after_start(arm, device, seconds):
    def be_silent():
        arm.started.wait(20)
        device.stale = "the last frame is 61 ms old"
        if seconds is not None:
            threading.Event().wait(seconds)
            device.stale = ""

    threading.Thread(target=be_silent, daemon=True).start()


def test_a_device_that_is_silent_for_60_ms_holds_the_arm_which_then_arrives(guarded, arm, device):
    silence_after_start(arm, device, 0.06)
    assert guarded.move_to(HERE) is HERE
    assert (arm.stops, arm.moves, guarded.num_holds) == (1, 2, 1)


def test_a_device_that_stays_silent_is_a_fault_at_the_deadline_of_the_motion(guarded, arm, device):
    silence_after_start(arm, device, None)
    with pytest.raises(
        RobotError, match=r"61 ms old; nothing newer came within 1\.0 s; the arm was stopped"
    ):
        guarded.move_to(HERE)
    assert (arm.stops, arm.moves) == (1, 1)


def test_a_device_that_fails_while_the_arm_is_held_ends_the_hold_at_once(guarded, arm, device):
    silence_after_start(arm, device, None)
    threading.Timer(0.1, lambda: setattr(device, "error", RobotError("unplugged"))).start()
    with pytest.raises(RobotError, match="unplugged; the arm was stopped"):
        guarded.move_to(HERE)
    assert arm.moves == 1


def test_a_stop_ends_a_hold_and_the_move_does_not_go_on(guarded, arm, device):
    silence_after_start(arm, device, 0.3)
    threading.Timer(0.1, guarded.stop).start()
    with pytest.raises(RobotError, match="cut short by a stop"):
        guarded.move_to(HERE)
    assert arm.moves == 1


def test_a_stale_device_before_a_move_is_waited_for(guarded, arm, device):
    device.stale = "old"
    arm.ended.set()
    threading.Timer(0.05, lambda: setattr(device, "stale", "")).start()
    assert guarded.move_to(HERE) is HERE
    assert arm.stops == 0


def test_a_line_that_holds_the_arm_again_and_again_is_a_fault(guarded, arm, device, monkeypatch):
    def stopped(pose, **_):
        device.stale = "old"
        assert arm.ended.wait(20)
        arm.ended.clear()
        device.stale = ""
        raise RobotError("the move was cut short by a stop")

    monkeypatch.setattr(arm, "move_to", stopped)
    with pytest.raises(RobotError, match="held 30 times in one move, the last time because old"):
        guarded.move_to(HERE)
