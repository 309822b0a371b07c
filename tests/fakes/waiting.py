"""Waiting for a condition of another thread or process."""

import time

from cltp.errors import TouchError


def poll(condition, seconds=5.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "did not come about"
        time.sleep(0.01)


def is_alive(sensor):
    try:
        return sensor.check_alive() == ""
    except TouchError:
        return False
