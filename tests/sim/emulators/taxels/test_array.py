"""The emulated taxel array: what it sends over its pty, as a process and with faults."""

import os
import select
import time

import numpy as np
import pytest

from cltp.sensing.taxel_packets import PacketParser, TaxelFrame, encode_mark
from sim.emulators.process.spawn import EmulatorProcess
from sim.emulators.taxels.array import FAULTS, TaxelEmulator
from sim.emulators.taxels.ball import PressedBall


class Host:
    """Reads an array's port, bytes as they come."""

    def __init__(self, path):
        self.fd = os.open(path, os.O_RDWR | os.O_NOCTTY)
        self.parser = PacketParser()

    def frames(self, count, seconds=5.0):
        frames, end = [], time.monotonic() + seconds
        while len(frames) < count and time.monotonic() < end:
            if select.select([self.fd], [], [], 0.1)[0]:
                packets = self.parser.feed(os.read(self.fd, 65536))
                frames += [p for p in packets if isinstance(p, TaxelFrame)]
        return frames

    def close(self):
        os.close(self.fd)


@pytest.fixture
def array(tmp_path):
    emulator = TaxelEmulator(PressedBall(30, 40), link=tmp_path / "array", rate_hz=50)
    yield emulator
    emulator.close()


@pytest.fixture
def host(array):
    one = Host(array.port)
    yield one
    one.close()


def test_frames_are_numbered_and_later_ones_have_later_clocks(host):
    frames = host.frames(6)
    steps = np.diff([f.sequence for f in frames])
    assert len(frames) >= 6 and (steps == 1).all()
    assert (np.diff([float(f.clock_us) for f in frames]) > 0).all()


def test_a_mark_is_repeated_by_the_frames_after_it_only(host):
    assert {f.mark for f in host.frames(3)} == {0}
    os.write(host.fd, encode_mark(41))
    marks = [f.mark for f in host.frames(10)]
    assert marks == sorted(marks) and marks[-1] == 41


def test_a_ball_is_pressed_in_the_middle():
    heights = PressedBall(60, 80, clock=iter([0.0, 1.0]).__next__).height_mm()
    assert heights.max() == pytest.approx(0.9, abs=0.03)  # a quarter of the period: deepest
    assert np.unravel_index(heights.argmax(), heights.shape) == pytest.approx((30, 40), abs=3)
    assert np.abs(heights[:10]).max() < 0.03


def test_a_reader_that_sleeps_misses_frames_but_gets_whole_ones(host, array):
    host.frames(2)
    time.sleep(0.5)
    assert len(host.frames(5)) >= 5
    assert host.parser.counts.damaged == 0


def test_unknown_faults_and_details_are_refused(array):
    with pytest.raises(ValueError, match="known: unplugged, stall"):
        array.inject("melted")
    for details in ({"count": 0}, {"depth": 3.0}, {"count": "many"}):
        with pytest.raises(ValueError, match="count"):
            array.inject("torn", **details)
    with pytest.raises(ValueError, match="count"):
        array.inject("stall", count=2.0)


def test_facts_say_what_is_injected_and_since_when(array):
    assert array.facts()["injected_ago_ms"] is None
    array.inject("stall")
    facts = array.facts()
    assert facts["faults"] == "stall" and 0 <= facts["injected_ago_ms"] < 5000
    sent = facts["frames_sent"]
    time.sleep(0.1)
    assert array.facts()["frames_sent"] == sent
    array.clear()
    assert array.facts()["faults"] == "none"


def test_unplugging_takes_the_link_and_plugging_brings_it_back_from_the_start(array, host):
    host.frames(3)
    array.inject("unplugged")
    assert not os.path.lexists(array.port) and array.facts()["plugged"] is False
    array.clear()
    again = Host(array.port)
    assert again.frames(1)[0].sequence <= 3
    again.close()


def test_every_fault_can_be_injected_and_cleared(array):
    for fault in FAULTS:
        array.inject(fault)
    array.clear()
    host = Host(array.port)
    assert host.frames(2)
    host.close()


def test_it_ends_and_takes_its_link_away(tmp_path):
    array = TaxelEmulator(PressedBall(8, 8), link=tmp_path / "array")
    array.close()
    array.close()
    assert not os.path.lexists(array.port)
    array.clear()
    with pytest.raises(ValueError, match="1 to 200"):
        TaxelEmulator(PressedBall(8, 8), link=tmp_path / "array", rate_hz=0)


def test_a_process_carries_a_grid_of_75_by_100_at_its_rate():
    with EmulatorProcess("taxels", "--rows", "75", "--columns", "100") as process:
        host = Host(process.ready["serial_port"])
        host.frames(5)
        frames = host.frames(31, seconds=20)
        seconds = (frames[30].clock_us - frames[0].clock_us) / 1e6
        process.control.inject("taxels", "torn")
        host.frames(3)
        facts = process.control.facts("taxels")
        host.close()
    assert frames[0].counts_um.shape == (75, 100)
    missing = np.diff([f.sequence for f in frames]) - 1
    assert missing.sum() == 0  # every frame came, at 30 Hz but for a busy machine
    assert 0.9 < seconds < 5
    assert host.parser.counts.damaged == 1 and facts["injected_ago_ms"] > 0
    assert not os.path.lexists(process.ready["serial_port"])
