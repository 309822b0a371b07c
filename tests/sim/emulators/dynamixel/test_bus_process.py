"""The emulated Dynamixel bus against the unmodified SDK and against hand-made packets."""

import os
import termios
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.dynamixel.fingers import Linkage, SpringLoad
from sim.emulators.dynamixel.options import ServoOptions
from sim.emulators.dynamixel.packets import PacketReader, crc16, packet, status
from sim.emulators.process.spawn import EmulatorProcess

sdk = pytest.importorskip("dynamixel_sdk")

TIMEOUT, CORRUPT = -3001, -3002


class SlowLoad:
    """A block of 40 mm that takes its time to answer, and notes what it was asked."""

    def __init__(self, seconds: float = 0.0) -> None:
        self.seconds = seconds
        self.events: list[object] = []

    def width_under(self, force_n: float) -> float:
        time.sleep(self.seconds)
        self.events.append(round(force_n, 4))
        return 0.040

    def release(self) -> None:
        self.events.append("released")


class PatientPort(sdk.PortHandler):
    """The SDK's port with a longer time-out: on a busy computer 34 ms end without a fault.

    Tests that wait for silence ask for less patience.
    """

    patience_ms = 2000.0

    def setPacketTimeout(self, packet_length: int) -> None:  # noqa: N802 - the SDK's name
        super().setPacketTimeout(packet_length)
        self.packet_timeout += self.patience_ms


class Line:
    """The SDK on the emulator's port."""

    def __init__(self, port: str, baud: int = 1_000_000) -> None:
        self.port, self.packets = PatientPort(port), sdk.PacketHandler(2.0)
        assert self.port.setBaudRate(baud)

    def read(self, address: int, length: int, servo: int = 1):
        return self.packets.readTxRx(self.port, servo, address, length)

    def value(self, address: int, length: int, servo: int = 1) -> int:
        data, result, error = self.read(address, length, servo)
        assert (result, error) == (0, 0)
        return int.from_bytes(bytes(data), "little", signed=True)

    def write(self, address: int, length: int, value: int, servo: int = 1):
        data = list(value.to_bytes(length, "little", signed=value < 0))
        return self.packets.writeTxRx(self.port, servo, address, length, data)

    def close_on(self, current: int, goal: int = 1600) -> None:
        assert self.write(at.TORQUE, 1, 1) == (0, 0)
        assert self.write(at.GOAL_CURRENT, 2, current) == (0, 0)
        assert self.write(at.GOAL_POSITION, 4, goal) == (0, 0)

    def settle(self) -> None:
        """Wait until the servo says that it does not move any more."""
        end = time.monotonic() + 5
        still = 0
        while still < 5 and time.monotonic() < end:
            still = 0 if self.value(at.MOVING, 1) else still + 1
            time.sleep(0.01)
        assert still == 5


@pytest.fixture
def bus():
    """Start emulators with ``bus(load, **options)``; gives (emulator, line)."""
    started = []

    def start(load=None, linkage=None, **options):
        emulator = DynamixelEmulator(load, ServoOptions(**options), linkage)
        line = Line(emulator.serial_port, options.get("baud", 1_000_000))
        started.extend([line.port.closePort, emulator.close])
        return emulator, line

    yield start
    for close in started:
        close()


def eventually(condition, seconds: float = 3.0) -> bool:
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    return condition()


# packets


def test_the_crc_is_that_of_the_manual_s_example():
    # Source: ROBOTIS e-Manual, CRC calculation: ping to id 1 ends with 19 4E
    assert packet(1, b"\x01") == bytes.fromhex("fffffd0001030001194e")


def test_the_crc_is_the_sdk_s():
    data = bytes(range(200))
    theirs = sdk.PacketHandler(2.0).updateCRC(0, list(data), len(data))
    assert crc16(data) == theirs


@given(st.integers(0, 252), st.binary(max_size=40), st.binary(max_size=20))
def test_what_is_packed_is_read_again_whatever_stands_before_it(servo, body, rubbish):
    reader = PacketReader()
    instructions = reader.feed(rubbish.replace(b"\xff", b"\x00") + packet(servo, b"\x02" + body))
    assert [(p.servo_id, p.code, p.parameters, p.intact) for p in instructions] == [
        (servo, 2, body, True)
    ]


@given(st.lists(st.integers(1, 30), max_size=10))
def test_a_packet_may_come_in_any_pieces(sizes):
    stream, reader, instructions = packet(3, b"\x02\xff\xff\xfd\x01") * 3, PacketReader(), []
    for size in [*sizes, len(stream)]:
        instructions += reader.feed(stream[:size])
        stream = stream[size:]
    assert [p.parameters for p in instructions] == [b"\xff\xff\xfd\x01"] * 3


@given(st.binary(max_size=60))
def test_rubbish_raises_nothing(data):
    PacketReader().feed(data)


def test_a_status_packet_of_another_servo_is_no_instruction():
    assert PacketReader().feed(status(1, 0, b"abc")) == []


# instructions


def test_ping_tells_model_and_broadcast_ping_every_servo(bus):
    _, line = bus(num_servos=2)
    assert line.packets.ping(line.port, 1) == (1220, 0, 0)
    assert line.packets.broadcastPing(line.port) == ({1: [1220, 46], 2: [1220, 46]}, 0)


def test_sync_read_and_fast_sync_read_give_both_servos_and_fail_when_one_is_silent(bus):
    emulator, line = bus(num_servos=2)
    group = sdk.GroupSyncRead(line.port, line.packets, at.PRESENT_POSITION, 4)
    assert group.addParam(1) and group.addParam(2)
    for read in (group.txRxPacket, group.fastSyncRead):
        assert read() == 0
        assert [group.getData(i, at.PRESENT_POSITION, 4) for i in (1, 2)] == [2496, 1600]
    emulator.inject("silence", id=1)
    line.port.patience_ms = 100.0
    assert group.txRxPacket() == TIMEOUT
    assert group.fastSyncRead() == TIMEOUT


def test_sync_write_reaches_both_and_says_nothing_of_a_refusal(bus):
    _, line = bus(num_servos=2)
    group = sdk.GroupSyncWrite(line.port, line.packets, at.GOAL_CURRENT, 2)
    group.addParam(1, list((55).to_bytes(2, "little")))
    group.addParam(2, list((5000).to_bytes(2, "little")))
    assert group.txPacket() == 0
    assert line.value(at.GOAL_CURRENT, 2, 1) == 55
    assert line.value(at.GOAL_CURRENT, 2, 2) == 910  # beyond its limit: as it was


@pytest.mark.parametrize(
    ("address", "length", "value", "error"),
    [
        (at.MODEL, 2, 5, 7),  # read only
        (at.GOAL_CURRENT, 2, 911, 6),  # beyond the current limit
        (at.BAUD, 1, 9, 4),  # out of range
        (at.GOAL_POSITION, 2, 5, 5),  # half of a register
        (200, 1, 0, 7),  # no such register
    ],
)
def test_a_wrong_write_is_refused_as_the_manual_says(bus, address, length, value, error):
    _, line = bus()
    assert line.write(address, length, value) == (0, error)


def test_the_eeprom_can_not_be_written_while_torque_is_on(bus):
    _, line = bus()
    line.write(at.TORQUE, 1, 1)
    assert line.write(at.MODE, 1, 3) == (0, 7)
    line.write(at.TORQUE, 1, 0)
    assert line.write(at.MODE, 1, 3) == (0, 0)


def test_an_xl430_has_no_current_control(bus):
    _, line = bus(model="XL430-W250")
    assert line.packets.ping(line.port, 1)[0] == 1060
    assert line.write(at.GOAL_CURRENT, 2, 10) == (0, 7)


def test_an_instruction_with_a_wrong_crc_is_answered_with_error_3(bus):
    _, line = bus()
    sent = packet(1, b"\x01")
    line.port.writePort(sent[:-1] + bytes([sent[-1] ^ 1]))
    line.port.setPacketTimeoutMillis(1000)
    answer, result = line.packets.rxPacket(line.port, False)
    assert (result, answer[8]) == (0, 3)


def test_torque_on_keeps_the_position_as_goal(bus):
    _, line = bus()
    line.write(at.GOAL_POSITION, 4, 1600)
    line.write(at.TORQUE, 1, 1)
    assert line.value(at.GOAL_POSITION, 4) == line.value(at.PRESENT_POSITION, 4) == 2496


# fingers


def test_a_force_reaches_the_load_through_the_current_and_the_fingers_stop_where_it_says(bus):
    load = SlowLoad()
    emulator, line = bus(load)
    line.close_on(82)
    line.settle()
    assert load.events == [pytest.approx((82 - 12) * 0.0144, abs=1e-4)]
    assert line.value(at.PRESENT_POSITION, 4) == round(1600 + 0.040 / 0.11 * 896)
    assert line.value(at.PRESENT_CURRENT, 2) == -82
    assert emulator.facts()["force_n"] == pytest.approx(70 * 0.0144, rel=0.01)


def test_the_fingers_stand_and_say_that_they_move_while_the_load_is_solved(bus):
    emulator, line = bus(SlowLoad(0.4))
    line.close_on(82)
    began = time.monotonic()
    while time.monotonic() - began < 0.2:
        assert (line.value(at.MOVING, 1), line.value(at.PRESENT_POSITION, 4)) == (1, 2496)
    line.settle()
    assert emulator.facts()["width_m"] == pytest.approx(0.040, abs=1e-4)


def test_the_profile_limits_the_speed(bus):
    _, line = bus(SlowLoad())
    line.write(at.PROFILE_VELOCITY, 4, 30)
    line.close_on(82)
    speeds = []
    end = time.monotonic() + 10
    while min(speeds, default=0) >= -10 or line.value(at.MOVING, 1):  # its threshold
        speeds.append(line.value(at.PRESENT_VELOCITY, 4))
        assert time.monotonic() < end, "the fingers never moved"
    assert min(speeds) == -30


def test_opening_releases_once_and_the_same_grip_again_asks_again(bus):
    load = SlowLoad()
    emulator, line = bus(load)
    line.close_on(112)
    line.settle()
    line.write(at.GOAL_CURRENT, 2, 112)
    line.settle()
    line.write(at.GOAL_POSITION, 4, 2000)
    line.settle()
    line.write(at.GOAL_POSITION, 4, 2100)
    line.settle()
    assert eventually(lambda: len(load.events) == 3)
    assert load.events == [1.44, 1.44, "released"]
    assert (emulator.facts()["squeezes"], emulator.facts()["releases"]) == (2, 1)


@pytest.mark.parametrize("how", ["torque off", "reboot", "overload"])
def test_torque_off_drops_what_is_held(bus, how):
    load = SlowLoad()
    emulator, line = bus(load)
    line.close_on(82)
    line.settle()
    if how == "torque off":
        line.write(at.TORQUE, 1, 0)
    elif how == "reboot":
        line.packets.reboot(line.port, 1)
    else:
        emulator.inject("overload")
    assert eventually(lambda: load.events[-1] == "released")
    assert emulator.facts()["force_n"] == 0


def test_a_current_below_friction_moves_nothing(bus):
    load = SlowLoad()
    _, line = bus(load, Linkage(friction_ma=30))
    line.close_on(25)
    time.sleep(0.1)
    assert line.value(at.PRESENT_POSITION, 4) == 2496
    assert load.events == []


def test_two_servos_close_together(bus):
    _, line = bus(SpringLoad(width_m=0.02, stiffness_n_m=1000), num_servos=2)
    for servo in (1, 2):
        line.write(at.TORQUE, 1, 1, servo)
    group = sdk.GroupSyncWrite(line.port, line.packets, at.GOAL_CURRENT, 18)
    for servo, goal in ((1, 1600), (2, 2496)):
        block = (112).to_bytes(2, "little") + bytes(12) + goal.to_bytes(4, "little")
        group.addParam(servo, list(block))
    group.txPacket()
    line.settle()
    first, second = (line.value(at.PRESENT_POSITION, 4, servo) for servo in (1, 2))
    assert first + second == 4096
    assert (first - 1600) / 896 * 0.11 == pytest.approx(0.02 - 1.44 / 1000, abs=2e-4)


# faults, as the notes say that the SDK answers them


def test_a_wrong_crc_is_one_corrupt_answer(bus):
    emulator, line = bus()
    emulator.inject("bad_crc")
    assert line.read(at.PRESENT_POSITION, 4)[1] == CORRUPT
    assert line.read(at.PRESENT_POSITION, 4)[1] == 0


def test_silence_is_a_timeout_until_it_is_cleared(bus):
    emulator, line = bus()
    emulator.inject("silence")
    line.port.patience_ms = 100.0
    assert line.read(at.PRESENT_POSITION, 4)[1] == TIMEOUT
    emulator.clear()
    line.port.patience_ms = PatientPort.patience_ms
    assert line.read(at.PRESENT_POSITION, 4)[1] == 0


def test_a_partial_answer_is_corrupt_after_the_timeout(bus):
    emulator, line = bus()
    emulator.inject("partial_reply")
    line.port.patience_ms = 100.0
    assert line.read(at.PRESENT_POSITION, 4)[1] == CORRUPT


def test_a_late_answer_comes_as_the_answer_to_the_next_read(bus):
    emulator, line = bus()
    line.port.patience_ms = 0.0
    emulator.inject("late_reply", delay_ms=45)
    assert line.read(at.MODEL, 2)[1] == TIMEOUT
    while emulator.facts()["injected_ago_ms"] < 40:
        pass
    emulator.inject("silence")  # so that only the late one can come
    data, result, _ = line.read(at.VOLTAGE, 2)
    # the old register's value with success, unless this machine was slow and it came before
    assert (result, data) in [(0, [1220 % 256, 1220 // 256]), (TIMEOUT, [])]


@pytest.mark.parametrize(("garbage", "results"), [(0, [TIMEOUT]), (1, [TIMEOUT, CORRUPT])])
def test_at_another_baud_rate_nothing_is_understood(bus, garbage, results):
    emulator, line = bus()
    emulator.inject("wrong_baud", garbage=garbage)
    line.port.patience_ms = 100.0
    assert line.packets.ping(line.port, 1)[1] in results
    line.port.patience_ms = PatientPort.patience_ms
    line.port.setBaudRate(57600)
    assert line.packets.ping(line.port, 1) == (1220, 0, 0)


def test_an_alert_is_told_on_single_reads_and_dropped_by_a_sync_read(bus):
    emulator, line = bus()
    emulator.inject("alert")
    data, result, error = line.read(at.HARDWARE_ERROR, 1)
    assert (data, result, error) == ([8], 0, 128)
    group = sdk.GroupSyncRead(line.port, line.packets, at.PRESENT_POSITION, 4)
    group.addParam(1)
    assert group.txRxPacket() == 0


def test_after_a_shutdown_torque_stays_off_until_a_reboot(bus):
    emulator, line = bus()
    line.write(at.TORQUE, 1, 1)
    emulator.inject("overload")
    assert line.read(at.TORQUE, 1)[0] == [0]
    assert line.write(at.TORQUE, 1, 1) == (0, 135)
    assert line.packets.reboot(line.port, 1) == (0, 0)
    assert line.write(at.TORQUE, 1, 1) == (0, 0)


def test_too_hot_shows_in_register_146_and_lets_go(bus):
    emulator, line = bus()
    line.write(at.TORQUE, 1, 1)
    emulator.inject("over_temperature", celsius=82)
    assert line.read(at.TEMPERATURE, 1)[::2] == ([82], 128)
    assert line.read(at.TORQUE, 1)[0] == [0]


def test_the_bus_watchdog_trips_makes_goals_read_only_and_is_cleared_by_0(bus):
    emulator, line = bus()
    line.write(at.TORQUE, 1, 1)
    line.write(at.WATCHDOG, 1, 3)
    assert eventually(lambda: emulator.facts()["bus_watchdog"] == 0xFF)
    assert line.write(at.GOAL_POSITION, 4, 2000) == (0, 4)  # the manual: a range error
    assert line.write(at.WATCHDOG, 1, 0) == (0, 0)
    assert line.write(at.GOAL_POSITION, 4, 2000) == (0, 0)


def test_what_is_said_on_the_bus_keeps_the_watchdog_content(bus):
    _, line = bus()
    line.write(at.TORQUE, 1, 1)
    line.write(at.WATCHDOG, 1, 25)
    end = time.monotonic() + 0.7
    while time.monotonic() < end:
        assert line.value(at.WATCHDOG, 1) == 25
        time.sleep(0.01)


def test_unplugged_is_an_exception_and_the_port_can_be_opened_again(bus):
    emulator, line = bus()
    emulator.inject("unplug")
    assert eventually(lambda: not os.path.exists(emulator.serial_port))  # noqa: PTH110
    with pytest.raises((OSError, termios.error)):
        line.packets.ping(line.port, 1)
    assert line.packets.ping(line.port, 1)[1] == -1000  # is_using is stuck
    emulator.clear()
    assert eventually(lambda: os.path.exists(emulator.serial_port))  # noqa: PTH110
    again = Line(emulator.serial_port)
    assert again.packets.ping(again.port, 1) == (1220, 0, 0)
    again.port.closePort()


def test_an_unknown_fault_is_refused_with_those_that_are_known(bus):
    emulator, _ = bus()
    with pytest.raises(ValueError, match=r"no fault 'fire'; known: .*over_temperature"):
        emulator.inject("fire")


def test_it_runs_as_a_process_and_is_controlled_from_outside():
    with EmulatorProcess("dynamixel", "--model", "XM430-W350", "--baud", "57600") as process:
        line = Line(str(process.ready["serial_port"]), 57600)
        assert line.packets.ping(line.port, 1) == (1020, 0, 0)
        process.control.inject("dynamixel", "register", address=at.FIRMWARE, value=30)
        assert line.value(at.FIRMWARE, 1) == 30
        assert process.control.facts("dynamixel")["injected_ago_ms"] >= 0
        line.port.closePort()
