"""The reflex beside a motion in real time: its frames, its errors, and every way that it ends."""

import dataclasses
import os
import signal
import threading
import time

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp, grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.shear.field import ShearField
from primitives import RobotError
from tacgrasp.runtime.reflex_thread import beside_motion
from tests.fakes.waiting import poll

PERIOD_S = 0.01
TAXELS = SENSORS["taxels"]


def frame():
    x, y = np.meshgrid(*grid_axes_mm(TAXELS, 12, 12))
    return ShearField(
        positions_mm=np.stack([x.ravel(), y.ravel()], axis=1),
        displacement_mm=np.zeros((144, 3)),
        sensor=TAXELS,
        stamp=Stamp(monotonic_s=time.monotonic(), wall_s=0.0),
    )


class Sensor:
    """Gives the frame that a test has put there."""

    def __init__(self):
        self.field, self.error = None, None

    def newest_shear(self):
        if self.error is not None:
            raise self.error
        return self.field


class Arm:
    """A motion that lasts until it is stopped."""

    def __init__(self):
        self.stops, self._stopped = 0, threading.Event()

    def stop(self):
        self.stops += 1
        self._stopped.set()

    def move(self):
        self._stopped.clear()
        assert self._stopped.wait(5.0), "nobody stopped the arm"
        raise RobotError("the move was cut short by a stop")


@pytest.fixture
def sensor():
    return Sensor()


@pytest.fixture
def arm():
    return Arm()


def running():
    return [each for each in threading.enumerate() if each.name == "reflex"]


def test_each_frame_comes_once_with_the_time_of_its_capture(sensor, arm):
    beats = []
    with beside_motion(sensor, PERIOD_S, lambda *beat: beats.append(beat), arm.stop):
        for _ in range(3):
            sensor.field = frame()
            poll(lambda: beats and beats[-1][0] is sensor.field)
    seen = [field for field, _ in beats if field is not None]
    assert len(seen) == 3
    assert all(field.stamp.monotonic_s == at_s for field, at_s in beats if field is not None)
    assert arm.stops == 0 and not running()


def test_a_sensor_that_falls_silent_or_fails_is_told_again_and_again(sensor, arm):
    beats = []
    with beside_motion(sensor, PERIOD_S, lambda *beat: beats.append(beat), arm.stop):
        poll(lambda: len(beats) > 2)
        assert beats[-1] == (None, None)
        sensor.field = frame()
        poll(lambda: any(field is not None for field, _ in beats))
        poll(lambda: beats[-1] == (None, sensor.field.stamp.monotonic_s))
        sensor.field, sensor.error = frame(), TouchError("dark")
        count = len(beats)
        poll(lambda: len(beats) > count + 2)
        assert all(field is None for field, _ in beats[count:])


def failing(*_):
    raise TouchError("the reflex was blind")


def test_a_frame_that_stays_is_silence_whatever_its_stamp_says(sensor, arm):
    seen = []
    sensor.field = dataclasses.replace(frame(), stamp=Stamp(monotonic_s=1e9, wall_s=0.0))
    with beside_motion(sensor, PERIOD_S, lambda field, _: seen.append(field), arm.stop):
        poll(lambda: seen.count(None) >= 2)
    assert seen[0] is sensor.field


def test_a_reflex_that_fails_stops_the_arm_and_the_motion_ends_with_its_error(sensor, arm):
    with (
        pytest.raises(TouchError, match="blind") as caught,
        beside_motion(sensor, PERIOD_S, failing, arm.stop),
    ):
        arm.move()
    assert isinstance(caught.value.__cause__, RobotError)
    assert not running()


def test_one_that_fails_between_two_motions_stops_the_next_one_too(sensor, arm):
    with (
        pytest.raises(TouchError, match="blind"),
        beside_motion(sensor, PERIOD_S, failing, arm.stop),
    ):
        poll(lambda: arm.stops > 0)
        arm.move()
    assert arm.stops > 1


def test_one_that_fails_while_nothing_moves_ends_the_wait(sensor, arm):
    with (
        pytest.raises(TouchError, match="blind"),
        beside_motion(sensor, PERIOD_S, failing, arm.stop),
    ):
        poll(lambda: arm.stops > 0)


@pytest.mark.parametrize("error", [RobotError("the gripper is gone"), KeyboardInterrupt()])
def test_whatever_ends_the_motion_nothing_is_commanded_afterwards(sensor, arm, error):
    beats = []

    def slow(*_):
        time.sleep(0.05)
        beats.append(time.monotonic())

    with (
        pytest.raises(type(error)) as caught,
        beside_motion(sensor, PERIOD_S, slow, arm.stop),
    ):
        sensor.field = frame()
        time.sleep(0.01)  # the beat is under way
        raise error
    assert caught.value is error
    assert not running()
    count = len(beats)
    time.sleep(0.1)
    assert len(beats) == count


def test_ctrl_c_while_the_thread_starts_ends_it(sensor, arm, monkeypatch):
    start = threading.Thread.start

    def interrupted(thread):
        start(thread)
        raise KeyboardInterrupt

    monkeypatch.setattr(threading.Thread, "start", interrupted)
    with pytest.raises(KeyboardInterrupt), beside_motion(sensor, PERIOD_S, print, arm.stop):
        pytest.fail("the motion has begun")
    assert not running()


def test_a_second_ctrl_c_waits_until_the_thread_has_ended(sensor, arm):
    began, commanded = threading.Event(), []

    def beat(_, __):
        if not began.is_set():
            began.set()
            time.sleep(0.2)  # a write to the gripper
            os.kill(os.getpid(), signal.SIGINT)  # the second one
            time.sleep(0.2)
            commanded.append(True)

    sensor.field = frame()
    with pytest.raises(KeyboardInterrupt), beside_motion(sensor, PERIOD_S, beat, arm.stop):
        assert began.wait(5.0)
        raise KeyboardInterrupt
    assert commanded
    assert not running()
