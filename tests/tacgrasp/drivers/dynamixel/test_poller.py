"""A job that its caller has given up is not carried out later."""

import time
from types import SimpleNamespace

import pytest

from primitives import RobotError
from tacgrasp.drivers.dynamixel import poller
from tacgrasp.drivers.dynamixel.poller import ServoPoller
from tacgrasp.drivers.dynamixel.servo_state import ServoCommand


class SlowBus:
    """Answers every read after ``wait_s``."""

    wait_s = 0.0

    def read(self, servo, address, length):
        time.sleep(self.wait_s)
        data = bytes([5]) if length == 1 else bytes([1]) + bytes(length - 1)
        return SimpleNamespace(data=data, alert=False)


def test_a_job_that_did_not_begin_in_time_never_does(monkeypatch):
    monkeypatch.setattr(poller, "CALL_S", 0.2)
    bus, done = SlowBus(), []
    settings = SimpleNamespace(
        model="XM430-W350", poll_ms=5.0, ids=(1,), max_temperature_c=65, stale_s=0.05
    )
    command = ServoCommand(torque=1, mode=5, watchdog=0, goal_current=0, goal_position=0)
    servos = ServoPoller(bus, settings, {1: command})
    try:
        bus.wait_s = 0.3
        time.sleep(0.05)  # a poll has begun
        with pytest.raises(RobotError, match="did not answer"):
            servos.call(lambda _: done.append("late"))
        bus.wait_s = 0.0
        time.sleep(0.8)
        assert done == []
        assert servos.call(lambda _: "in time") == "in time"
    finally:
        servos.close()
