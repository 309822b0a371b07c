"""The driver of a taxel array, on an array emulated on a pty: fresh touches or a clear error."""

import os
import threading
import time
import tty

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.taxel_packets import TaxelFrame, encode_frame
from sim.emulators.taxels.array import TaxelEmulator
from tacgrasp.drivers.taxels.connect import check, connect_taxels
from tacgrasp.drivers.taxels.intervals import FrameIntervals
from tacgrasp.drivers.taxels.settings import TaxelSettings
from tests.fakes.waiting import is_alive, poll


class Gel:
    """What the array looks at: a level that a test sets, with a little noise."""

    def __init__(self, rows=30, columns=40):
        self.level_mm, self.shape, self.captures = 0.0, (rows, columns), 0
        self._rng = np.random.default_rng(0)

    def height_mm(self):
        self.captures += 1
        return (self.level_mm + self._rng.normal(0, 0.004, self.shape)).astype(np.float32)


@pytest.fixture
def gel():
    return Gel()


@pytest.fixture
def emulator(gel, tmp_path):
    array = TaxelEmulator(gel, link=tmp_path / "taxel-array", rate_hz=60)
    yield array
    array.close()


@pytest.fixture
def settings(emulator):
    return TaxelSettings(port=emulator.port, read_timeout_s=1.0, connect_timeout_s=1.0)


@pytest.fixture
def sensor(settings):
    array = connect_taxels(settings)
    yield array
    array.disconnect()


def frame_at(number, clock_s):
    counts = np.arange(64, dtype=np.int16).reshape(8, 8)
    return TaxelFrame(sequence=number, mark=0, clock_us=round(1e6 * clock_s), counts_um=counts)


def level(cloud):
    return float(np.median(cloud.points_mm[:, 2]))


def raises_within(sensor, seconds, match):
    began = time.monotonic()
    with pytest.raises(TouchError, match=match):
        sensor.read()
    assert time.monotonic() - began < seconds


def test_a_read_gives_what_was_there_after_the_call(sensor, gel):
    for mm in (0.5, -0.1, 0.9):
        time.sleep(0.05)  # frames of the old level are under way
        gel.level_mm = mm
        assert level(sensor.read()) == pytest.approx(mm, abs=0.005)


def test_a_frame_captured_before_the_call_is_never_returned(sensor, gel):
    called = time.monotonic()
    cloud = sensor.read()
    assert cloud.stamp.monotonic_s > called
    captured = gel.captures
    sensor.read()
    assert gel.captures > captured


def test_a_reference_is_of_frames_captured_after_the_call_and_is_subtracted(sensor, gel):
    for mm in (0.5, -0.1, 0.3):
        time.sleep(0.05)  # frames of the old level are under way
        gel.level_mm = mm
        sensor.take_reference()
        assert level(sensor.read()) == pytest.approx(0.0, abs=0.005)
        gel.level_mm = mm + 0.2
        assert level(sensor.read()) == pytest.approx(0.2, abs=0.005)


@pytest.mark.parametrize("fault", ["black", "stall"])
def test_a_reference_that_can_not_be_taken_leaves_the_old_one(sensor, emulator, gel, fault):
    gel.level_mm = 0.3
    sensor.take_reference()
    emulator.inject(fault)
    with pytest.raises(TouchError):
        sensor.take_reference()
    emulator.clear()
    gel.level_mm = 0.5
    assert level(sensor.read()) == pytest.approx(0.2, abs=0.005)


def test_heights_keep_their_place_and_unit(emulator, settings, gel):
    heights = np.zeros(gel.shape, np.float32)
    heights[:5, 30:] = 0.75  # top right
    gel.height_mm = lambda: heights
    array = connect_taxels(settings)
    cloud = array.read()
    array.disconnect()
    x, y, z = cloud.points_mm[cloud.points_mm[:, 2] > 0.7].T
    assert z.max() == pytest.approx(0.75) and x.min() > 4 and y.min() > 4


@pytest.mark.parametrize(
    ("fault", "message"),
    [("black", "all taxels read 0 µm"), ("saturated", "all taxels read 32767")],
)
def test_a_dead_sensing_element_is_named(sensor, emulator, fault, message):
    sensor.read()
    emulator.inject(fault)
    raises_within(sensor, 2, message)
    with pytest.raises(TouchError, match=message):
        sensor.check_alive()
    emulator.clear()
    sensor.read()


def test_a_stall_is_an_error_in_bounded_time_and_not_an_old_touch(sensor, emulator):
    sensor.read()
    emulator.inject("stall")
    raises_within(sensor, 3, "no fresh frame within 1 s")
    emulator.clear()
    sensor.read()


def test_a_stall_is_seen_without_reading(sensor, emulator):
    poll(lambda: is_alive(sensor))
    emulator.inject("stall")
    poll(lambda: not is_alive(sensor))
    assert "no fresh frame within 0." in sensor.check_alive()
    emulator.clear()
    poll(lambda: is_alive(sensor))  # a stall is survived


def test_a_frame_is_stale_after_two_intervals_of_the_array_and_20_ms():
    intervals = FrameIntervals()
    assert intervals.stale_s == pytest.approx(0.12)
    for number in range(10):
        intervals.add(frame_at(number, 0.033 * number), 5.0 + 0.033 * number)
    assert intervals.stale_s == pytest.approx(2 * 0.033 + 0.02, abs=1e-4)


@pytest.mark.parametrize(("pause_s", "stalls", "delays"), [(0.2, 1, 0), (0.0, 0, 1)])
def test_the_arrays_clock_tells_a_stall_from_a_delay_on_this_computer(pause_s, stalls, delays):
    intervals = FrameIntervals()
    for number in range(10):
        intervals.add(frame_at(number, 0.02 * number), 5.0 + 0.02 * number)
    intervals.add(frame_at(10, 0.2 + pause_s), 5.4)
    assert (intervals.stalls, intervals.delays_here) == (stalls, delays)


@pytest.mark.parametrize(
    ("fault", "counted"), [("torn", "damaged"), ("flipped", "damaged"), ("repeated", "repeated")]
)
def test_a_passing_fault_is_counted_and_survived(sensor, emulator, fault, counted):
    sensor.read()
    emulator.inject(fault, count=3)
    for _ in range(3):
        sensor.read()
    poll(lambda: getattr(sensor.counts(), counted) >= 3)
    if fault != "repeated":
        poll(lambda: sensor.counts().missing == 3)


def test_garbage_in_the_middle_is_an_error_and_passes(sensor, emulator):
    sensor.read()
    emulator.inject("garbage")
    raises_within(sensor, 3, "no fresh frame")
    emulator.clear()
    sensor.read()
    assert sensor.counts().garbage_bytes > 0


def test_unplugging_while_reading_is_an_error_at_once_and_for_good(sensor, emulator):
    sensor.read()
    pulled = threading.Timer(0.2, lambda: emulator.inject("unplugged"))
    pulled.start()
    began = time.monotonic()
    with pytest.raises(TouchError, match="unplugged"):
        while time.monotonic() - began < 5:
            sensor.read()
    assert time.monotonic() - began < 3
    pulled.join()
    emulator.clear()
    for call in (sensor.read, sensor.check_alive):
        with pytest.raises(TouchError, match="unplugged"):
            call()


def test_a_port_that_is_closed_in_the_middle_of_a_request_is_an_unplugged_array(
    sensor, monkeypatch
):
    def write(_):
        raise TypeError("argument must be an int, or have a fileno() method.")  # as pyserial does

    monkeypatch.setattr(sensor._port, "write", write)
    for _ in range(2):
        with pytest.raises(TouchError, match="unplugged"):
            sensor.read()


def test_a_replugged_array_is_found_under_the_same_name(emulator, settings):
    emulator.inject("unplugged")
    with pytest.raises(TouchError, match=r"no serial port .*taxel-array"):
        connect_taxels(settings)
    emulator.clear()
    array = connect_taxels(settings)
    array.read()
    array.disconnect()


def test_a_port_that_another_program_has_is_refused(sensor, settings):
    with pytest.raises(TouchError, match="in use by another program"):
        connect_taxels(settings)
    sensor.read()


def test_something_else_at_the_port_is_refused_in_time(emulator, settings):
    emulator.inject("garbage")
    began = time.monotonic()
    with pytest.raises(TouchError, match=r"bytes came .* but no packet.*another device"):
        connect_taxels(settings)
    assert time.monotonic() - began < 3


def test_a_silent_port_and_a_file_are_refused(emulator, settings, tmp_path):
    emulator.inject("stall")
    with pytest.raises(TouchError, match="silent for 1 s"):
        connect_taxels(settings)
    file = tmp_path / "notes.txt"
    file.write_text("no port")
    with pytest.raises(TouchError, match="can't be opened"):
        connect_taxels(settings.model_copy(update={"port": str(file)}))


def test_a_grid_of_another_shape_is_refused(tmp_path):
    square = TaxelEmulator(Gel(32, 32), link=tmp_path / "square")
    try:
        with pytest.raises(TouchError, match="32 × 32 taxels, which doesn't fit"):
            connect_taxels(TaxelSettings(port=square.port))
    finally:
        square.close()


def test_another_version_of_the_packets_is_named(tmp_path):
    from zlib import crc32

    packet = bytearray(
        encode_frame(TaxelFrame(sequence=1, mark=0, clock_us=0, counts_um=np.ones((8, 8), "i2")))
    )
    packet[4] = 3
    packet[26:30] = crc32(packet[:26]).to_bytes(4, "little")
    master, slave = os.openpty()
    tty.setraw(slave)
    writer = threading.Timer(0.2, lambda: os.write(master, bytes(packet)))
    writer.start()
    settings = TaxelSettings(port=os.ttyname(slave), connect_timeout_s=1.0)
    with pytest.raises(TouchError, match="expected version 1 or 2"):
        connect_taxels(settings)
    writer.join()
    os.close(master), os.close(slave)


def test_marks_that_another_program_left_do_not_make_an_old_frame_fresh(settings, gel):
    first = connect_taxels(settings)
    first.read()
    first.disconnect()
    gel.level_mm = 0.4
    second = connect_taxels(settings)
    assert level(second.read()) == pytest.approx(0.4, abs=0.005)
    second.disconnect()


def test_a_check_tells_latency_and_line(emulator, settings):
    findings = check(settings)
    assert [(one.name, one.ok) for one in findings] == [
        ("connection", True), ("fresh frame", True), ("line", True), ("shear", True),
    ]  # fmt: skip
    assert "ms" in findings[1].detail and "0 damaged" in findings[2].detail
    emulator.inject("black")
    (_, reads) = check(settings)
    assert not reads.ok and "dead or dark" in reads.detail
    emulator.inject("unplugged")
    (missing,) = check(settings)
    assert not missing.ok and missing.advice


@pytest.mark.parametrize(
    "wrong", [{"port": ""}, {"port": "x", "baud": 1}, {"port": "x", "read_timeout_s": 0}]
)
def test_settings_out_of_range_are_refused(wrong):
    with pytest.raises(ValueError):
        TaxelSettings(**wrong)
