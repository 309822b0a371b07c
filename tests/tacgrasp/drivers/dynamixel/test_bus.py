"""Transactions over the real SDK: each row of the notes' fault table, and nothing made up."""

import os
import pty
import threading
import time

import pytest

from primitives import RobotError
from sim.emulators.dynamixel.packets import status
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.errors import BusError, BusFault
from tests.fakes.emulated_servos import EmulatedServos, eventually

pytest.importorskip("dynamixel_sdk")

MODEL = (1220).to_bytes(2, "little")


@pytest.fixture
def servos(tmp_path):
    servos = EmulatedServos(tmp_path, num_servos=2)
    yield servos
    servos.close()


@pytest.fixture
def bus(servos):
    bus = Bus(servos.settings)
    bus.open()
    yield bus
    bus.close()


def test_registers_are_read_and_written(bus):
    assert bus.ping(1) == 1220
    bus.write(1, reg.GOAL_CURRENT, (77).to_bytes(2, "little"))
    assert bus.read_number(1, reg.GOAL_CURRENT, 2) == 77


@pytest.mark.parametrize("fault", ["bad_crc", "partial_reply"])
def test_one_corrupt_answer_is_read_again_and_counted(bus, servos, fault):
    servos.emulator.inject(fault)
    assert bus.read(1, reg.MODEL, 2).data == MODEL
    assert (bus.counts.corrupt, bus.counts.silent) == (1, 0)


def test_a_late_answer_is_never_taken_for_the_next_one(bus, servos):
    servos.emulator.inject("late_reply", delay_ms=45)
    assert bus.read(1, reg.TORQUE, 83).data[0] == 0
    # on a busy computer it may still have been in time
    assert (bus.counts.silent, bus.counts.late) in [(1, 1), (1, 2), (0, 0)]
    assert bus.read(1, reg.MODEL, 2).data == MODEL


@pytest.mark.parametrize("delay_ms", [26, 30, 50, 70])
def test_however_late_an_answer_is_the_next_reads_are_true(bus, servos, delay_ms):
    servos.emulator.inject("late_reply", delay_ms=delay_ms)
    for _ in range(3):
        assert bus.read(1, reg.MODEL, 2).data == MODEL
        assert bus.read(1, reg.VOLTAGE, 2).data == (111).to_bytes(2, "little")
        assert bus.read_number(1, reg.GOAL_CURRENT, 2) == 910


def test_stray_answers_do_not_use_up_the_second_try(bus, servos, monkeypatch):
    port, write, lag = bus._port, bus._port.writePort, []

    def first_stray(sent):
        """The answers to three earlier questions, later than any drain, come before this one's."""
        if not lag:
            lag.append(True)
            for body in (bytes(3), bytes(25), bytes(3)):
                servos.emulator._wire.write(status(1, 0, body))
        return write(sent)

    monkeypatch.setattr(port, "writePort", first_stray)
    assert bus.read(1, reg.MODEL, 2).data == MODEL
    assert (bus.counts.late, bus.counts.corrupt, bus.counts.silent) == (3, 0, 0)


@pytest.mark.parametrize("fault", ["bad_crc", "partial_reply"])
def test_a_series_of_corrupt_answers_is_waited_out(bus, servos, fault):
    servos.emulator.inject(fault, count=5)
    assert bus.read(1, reg.MODEL, 2).data == MODEL
    assert bus.counts.corrupt >= 2


def test_two_corrupt_answers_without_patience_are_an_error_and_no_value(bus, servos):
    bus.patience_s = 0.0
    servos.emulator.inject("bad_crc", count=3)  # read, ping, read
    with pytest.raises(BusError, match="wrong CRC") as error:
        bus.read(1, reg.MODEL, 2)
    assert error.value.kind is BusFault.CORRUPT


def test_silence_is_known_after_two_timeouts_and_says_what_to_check(bus, servos):
    bus.patience_s = 0.0
    servos.emulator.inject("silence")
    began = time.monotonic()
    with pytest.raises(BusError, match="does not answer within 25 ms: check power") as error:
        bus.read(1, reg.MODEL, 2)
    assert error.value.kind is BusFault.SILENT
    assert time.monotonic() - began < 1.0  # 50 ms when nothing else runs


def test_a_silent_emulator_is_called_what_it_is(servos):
    emulated = servos.settings.for_emulator()
    assert emulated.is_emulated and not servos.settings.is_emulated
    bus = Bus(emulated)
    bus.patience_s = 0.0
    bus.open()
    servos.emulator.inject("silence")
    try:
        with pytest.raises(BusError, match="within 25 ms: it is an emulator on this computer"):
            bus.read(1, reg.MODEL, 2)
    finally:
        bus.close()


def test_a_pause_is_waited_out(bus, servos):
    servos.emulator.inject("silence")
    threading.Timer(0.15, servos.emulator.clear).start()
    assert bus.read(1, reg.MODEL, 2).data == MODEL
    assert bus.counts.silent == 1


def test_after_a_pause_the_answers_to_all_that_was_asked_meanwhile_are_thrown_away(bus, servos):
    with servos.emulator._lock:  # the emulated servos stand still, the questions queue up
        thread = threading.Timer(0.0, lambda: models.append(bus.read(1, reg.MODEL, 2).data))
        models: list[bytes] = []
        thread.start()
        time.sleep(0.2)
    thread.join()
    assert models == [MODEL]
    assert bus.read(1, reg.VOLTAGE, 2).data == (111).to_bytes(2, "little")


def test_patience_ends(bus, servos):
    servos.emulator.inject("silence")
    began = time.monotonic()
    with pytest.raises(BusError, match="does not answer"):
        bus.read(1, reg.MODEL, 2)
    assert 1.0 <= time.monotonic() - began < 3.0


def test_an_answer_that_came_while_this_thread_did_not_run_is_taken(bus, servos, monkeypatch):
    port, read = bus._port, bus._port.readPort

    def starved(length):
        monkeypatch.setattr(port, "readPort", read)
        time.sleep(0.08)  # the answer comes meanwhile; the time for it is over
        return b""

    monkeypatch.setattr(port, "readPort", starved)
    assert bus.read(1, reg.MODEL, 2).data == MODEL
    assert (bus.counts.silent, bus.counts.corrupt) == (0, 0)


def test_a_silent_servo_does_not_silence_the_other(bus, servos):
    servos.emulator.inject("silence", id=2)
    assert bus.ping(1) == 1220
    with pytest.raises(BusError, match="servo 2"):
        bus.ping(2)


@pytest.mark.parametrize("garbage", [0, 1])
def test_at_another_baud_rate_there_is_no_answer(bus, servos, garbage):
    servos.emulator.inject("wrong_baud", garbage=garbage)
    with pytest.raises(BusError):
        bus.ping(1)


def test_an_alert_is_passed_on_with_the_data(bus, servos):
    assert not bus.read(1, reg.MODEL, 2).alert
    servos.emulator.inject("alert")
    answer = bus.read(1, reg.MODEL, 2)
    assert (answer.data, answer.alert) == (MODEL, True)


def test_a_refusal_says_why(bus, servos):
    servos.emulator.inject("overload")
    with pytest.raises(BusError, match=r"refused: it can't be written now") as error:
        bus.write(1, reg.TORQUE, b"\1")
    assert error.value.kind is BusFault.REFUSED
    bus._transact(1, 8, b"", 0)  # reboot
    bus.write(1, reg.TORQUE, b"\1")


@pytest.mark.parametrize("fault", ["bad_crc", "partial_reply", "late_reply"])
def test_a_write_whose_answer_is_lost_is_read_back_and_not_repeated(bus, servos, fault):
    servos.emulator.inject(fault, delay_ms=45)
    before = servos.emulator.facts()["instructions"]
    bus.write(1, reg.GOAL_CURRENT, (77).to_bytes(2, "little"))
    assert bus.read_number(1, reg.GOAL_CURRENT, 2) == 77
    assert bus.counts.rewritten == 0
    # write, ping, read back, read; on a busy computer the late answer may still have been in time
    assert servos.emulator.facts()["instructions"] - before in (4, 2)


def test_a_sync_write_that_a_servo_refuses_is_noticed(bus):
    good, bad = (50).to_bytes(2, "little"), (950).to_bytes(2, "little")
    with pytest.raises(BusError, match=r"servo 2 .* refused: the value is beyond a limit"):
        bus.write_all(reg.GOAL_CURRENT, {1: good, 2: bad})


def test_unplugged_is_an_error_and_the_port_can_be_built_again(bus, servos):
    servos.emulator.inject("unplug")
    assert eventually(lambda: not os.path.exists(bus.path))  # noqa: PTH110
    with pytest.raises(BusError, match="is gone") as error:
        bus.ping(1)
    assert error.value.kind is BusFault.LOST
    with pytest.raises(BusError, match="not open"):
        bus.ping(1)
    with pytest.raises(RobotError, match="no serial port"):
        bus.open()
    servos.emulator.clear()
    assert eventually(lambda: os.path.exists(servos.emulator.serial_port))  # noqa: PTH110
    bus.open()
    assert bus.ping(1) == 1220


def test_a_port_that_the_sdk_left_stuck_is_rebuilt(bus):
    bus._port.is_using = True
    assert bus.ping(1) == 1220
    assert bus.counts.rebuilt == 1


def test_a_port_is_opened_by_one_only(bus, servos):
    with pytest.raises(RobotError, match="in use by another program"):
        Bus(servos.settings).open()


def test_a_port_that_another_program_has_is_refused(servos):
    servos.emulator.inject("port_taken")
    with pytest.raises(RobotError, match="in use by another program; end that one first"):
        Bus(servos.settings).open()


def test_something_else_on_the_port_is_no_servo(servos):
    master, slave = pty.openpty()
    ended = threading.Event()

    def talk():
        while not ended.wait(0.005):
            os.write(master, b"ok\r\n\xff\xff\xfd\x00garbage")

    talker = threading.Thread(target=talk)
    talker.start()
    bus = Bus(servos.setting(port=os.ttyname(slave)))
    try:
        bus.open()
        with pytest.raises(BusError):
            bus.ping(1)
    finally:
        bus.close()
        ended.set()
        talker.join()
        os.close(slave)
        os.close(master)


def test_three_bytes_are_never_read(bus):
    with pytest.raises(ValueError, match="ping"):
        bus.read(1, reg.MODEL, 3)
