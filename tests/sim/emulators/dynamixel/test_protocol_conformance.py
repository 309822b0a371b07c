"""The emulated bus against ROBOTIS' e-Manual, 'DYNAMIXEL Protocol 2.0', packet by packet.

Bytes marked 'e-Manual' are the manual's own examples. CRC and stuffing are computed here a second
time, bit by bit, so that a wrong table in the emulator can't hide.
"""

import struct

import pytest

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel.bus import ServoBus
from sim.emulators.dynamixel.control_table import MODELS
from sim.emulators.dynamixel.packets import PacketReader
from sim.emulators.dynamixel.servo import EmulatedServo

PING, READ, WRITE, REG_WRITE, ACTION, FACTORY_RESET, REBOOT, CLEAR = 1, 2, 3, 4, 5, 6, 8, 0x10
SYNC_READ, SYNC_WRITE, FAST_SYNC_READ = 0x82, 0x83, 0x8A
BULK_READ, BULK_WRITE, FAST_BULK_READ = 0x92, 0x93, 0x9A
FAILED, INSTRUCTION, CRC, RANGE, LENGTH, LIMIT, ACCESS, ALERT = 1, 2, 3, 4, 5, 6, 7, 0x80
ALL = 0xFE
BAUD = 1_000_000


def crc(data):
    """x^16 + x^15 + x^2 + 1, start 0, most significant bit first."""
    register = 0
    for byte in data:
        for bit in range(7, -1, -1):
            top = (register >> 15 & 1) ^ (byte >> bit & 1)
            register = (register << 1 & 0xFFFF) ^ (0x8005 if top else 0)
    return register


def packet(servo_id, *body):
    """Instruction and parameters (numbers or bytes) as a whole packet."""
    data = b"".join(bytes([part]) if isinstance(part, int) else part for part in body)
    data = data.replace(b"\xff\xff\xfd", b"\xff\xff\xfd\xfd")
    head = b"\xff\xff\xfd\x00" + struct.pack("<BH", servo_id, len(data) + 2) + data
    return head + struct.pack("<H", crc(head))


def u16(value):
    return struct.pack("<H", value)


class Bus:
    """Two servos, ids 1 and 2, on a clock that the test moves."""

    def __init__(self, model="XM430-W350", count=2):
        self.clock_s = 0.0
        self.servos = [
            EmulatedServo(MODELS[model], i, baud=BAUD, mode=5, friction_ma=10.0)
            for i in range(1, count + 1)
        ]
        self.silent = set()
        self.bus = ServoBus(
            self.servos, lambda i: i in self.silent, lambda written: None, lambda: self.clock_s
        )
        self.reader = PacketReader()

    def send(self, data, baud=BAUD):
        """All bytes that come back."""
        instructions = self.reader.feed(data)
        return b"".join(b"".join(self.bus.execute(each, baud)) for each in instructions)

    def ask(self, servo_id, *body):
        """Error and data of the one status packet of a servo."""
        ((sender, error, data),) = statuses(self.send(packet(servo_id, *body)))
        assert sender == servo_id
        return error, data

    def number(self, address, size, servo_id=1):
        error, data = self.ask(servo_id, READ, u16(address), u16(size))
        assert error == 0
        return int.from_bytes(data, "little", signed=True)

    def write(self, address, data, servo_id=1):
        return self.ask(servo_id, WRITE, u16(address), data)

    def wait(self, seconds):
        self.clock_s += seconds
        for servo in self.servos:
            servo.check_watchdog(self.clock_s)


def statuses(line):
    """(id, error, data) of every status packet; fails if anything else is on the line."""
    packets = []
    while line:
        assert line[:4] == b"\xff\xff\xfd\x00"
        servo_id, length = struct.unpack_from("<BH", line, 4)
        whole, line = line[: 7 + length], line[7 + length :]
        assert crc(whole[:-2]) == struct.unpack("<H", whole[-2:])[0]
        body = whole[7:-2].replace(b"\xff\xff\xfd\xfd", b"\xff\xff\xfd")
        assert body[0] == 0x55
        packets.append((servo_id, body[1], body[2:]))
    return packets


@pytest.fixture
def bus():
    return Bus()


def test_ping_and_answer_are_the_manual_s_bytes(bus):
    bus.servos[0].table[at.MODEL], bus.servos[0].table[at.FIRMWARE] = 1030, 38
    answer = bus.send(bytes.fromhex("FFFFFD000103000119 4E"))  # e-Manual
    assert answer == bytes.fromhex("FFFFFD00010700550006 0426655D")  # e-Manual


def test_a_broadcast_ping_is_answered_by_all_in_the_order_of_their_ids(bus):
    for servo in bus.servos:
        servo.table[at.MODEL], servo.table[at.FIRMWARE] = 1030, 38
    answer = bus.send(bytes.fromhex("FFFFFD00FE0300013142"))  # e-Manual
    assert answer == bytes.fromhex(
        "FFFFFD000107005500060426655D FFFFFD0002070055000604266F6D"  # e-Manual
    )
    bus.write(at.ID, b"\x05", servo_id=1)
    assert [sender for sender, *_ in statuses(bus.send(packet(ALL, PING)))] == [2, 5]


def test_read_write_and_sync_read_are_the_manual_s_bytes(bus):
    for servo, ticks in zip(bus.servos, (166, 2079), strict=True):
        servo.position = ticks
        servo.publish()
    assert bus.send(bytes.fromhex("FFFFFD0001070002840004001D15")) == bytes.fromhex(
        "FFFFFD000108005500A60000008CC0"
    )  # e-Manual: present position 166
    assert bus.send(bytes.fromhex("FFFFFD000109000374000002 0000CA89")) == bytes.fromhex(
        "FFFFFD0001040055 00A10C"
    )  # e-Manual: goal position 512
    assert bus.number(at.GOAL_POSITION, 4) == 512
    assert bus.send(bytes.fromhex("FFFFFD00FE09008284000400 0102CEFA")) == bytes.fromhex(
        "FFFFFD000108005500A60000008CC0 FFFFFD0002080055001F080000BABE"
    )  # e-Manual: 166 and 2079


def test_sync_write_is_the_manual_s_and_nobody_answers(bus):
    line = bytes.fromhex("FFFFFD00FE11008374000400 0196000000 02AA000000 8287")  # e-Manual
    assert bus.send(line) == b""
    assert [bus.number(at.GOAL_POSITION, 4, servo) for servo in (1, 2)] == [150, 170]


def test_registered_write_and_action_are_the_manual_s(bus):
    accepted = bytes.fromhex("FFFFFD000104005500A10C")
    assert bus.send(bytes.fromhex("FFFFFD00010900046800C8000000AE8E")) == accepted  # e-Manual
    assert (bus.number(at.GOAL_VELOCITY, 4), bus.number(at.REGISTERED, 1)) == (0, 1)
    assert bus.send(bytes.fromhex("FFFFFD000103000502CE")) == accepted  # e-Manual
    assert (bus.number(at.GOAL_VELOCITY, 4), bus.number(at.REGISTERED, 1)) == (200, 0)


def test_an_action_without_a_registered_write_is_an_instruction_error(bus):
    assert bus.ask(1, ACTION) == (INSTRUCTION, b"")


def test_a_broadcast_action_moves_all_at_once_without_an_answer(bus):
    for servo in (1, 2):
        assert bus.ask(servo, REG_WRITE, u16(at.GOAL_POSITION), struct.pack("<i", 77)) == (0, b"")
    assert bus.send(packet(ALL, ACTION)) == b""
    assert [bus.number(at.GOAL_POSITION, 4, servo) for servo in (1, 2)] == [77, 77]


def test_bulk_read_is_the_manual_s(bus):
    bus.servos[0].table[at.VOLTAGE], bus.servos[1].table[at.TEMPERATURE] = 119, 36
    line = bytes.fromhex("FFFFFD00FE0D0092 0190000200 0292000100 1A05")  # e-Manual
    assert bus.send(line) == bytes.fromhex(
        "FFFFFD0001060055007700C369 FFFFFD000205005500248BA9"  # e-Manual
    )


def test_a_bulk_write_reaches_different_registers(bus):
    parts = b"\x01" + u16(at.GOAL_CURRENT) + u16(2) + u16(55)
    parts += b"\x02" + u16(at.GOAL_POSITION) + u16(4) + struct.pack("<i", -9)
    assert bus.send(packet(ALL, BULK_WRITE, parts)) == b""
    assert bus.number(at.GOAL_CURRENT, 2, 1) == 55
    assert bus.number(at.GOAL_POSITION, 4, 2) == -9


@pytest.mark.parametrize("code", [SYNC_READ, BULK_READ])
def test_servos_after_a_missing_one_stay_silent_and_an_id_answers_once(bus, code):
    def read(*ids):
        block = u16(at.TEMPERATURE) + u16(1)
        body = (
            block + bytes(ids) if code == SYNC_READ else b"".join(bytes([i]) + block for i in ids)
        )
        return [sender for sender, *_ in statuses(bus.send(packet(ALL, code, body)))]

    assert read(2, 1) == [2, 1]
    assert read(1, 9, 2) == [1]
    assert read(9, 1) == []
    assert read(1, 1, 2) == [1]
    bus.silent.add(1)
    assert read(2, 1) == [2]


@pytest.mark.parametrize("code", [FAST_SYNC_READ, FAST_BULK_READ])
def test_a_fast_read_is_one_packet_and_breaks_off_at_a_missing_servo(bus, code):
    block = u16(at.TEMPERATURE) + u16(1)

    def read(*ids):
        body = b"".join(bytes([i]) + block for i in ids)
        return bus.send(packet(ALL, code, block + bytes(ids) if code == FAST_SYNC_READ else body))

    line = read(1, 2)
    first = b"\xff\xff\xfd\x00\xfe" + u16(1 + 2 * 5) + b"\x55\x00\x01\x22"
    first += u16(crc(first))
    second = first + b"\x00\x02\x22"
    assert line == second + u16(crc(second))
    assert read(1, 7) == first
    assert read(7, 1) == b""


def test_error_numbers_of_refused_writes(bus):
    refused = {
        (at.MODEL, b"\x01\x00"): ACCESS,  # read only
        (200, b"\x00"): ACCESS,  # not defined
        (at.GOAL_POSITION, b"\x00\x00"): LENGTH,  # shorter than the register
        (at.BAUD, b"\x09"): RANGE,
        (at.MODE, b"\x02"): RANGE,
        (at.ID, b"\xfd"): RANGE,
        (at.GOAL_CURRENT, u16(1194)): LIMIT,  # beyond the current limit, 1193
    }
    assert {key: bus.write(*key)[0] for key in refused} == refused
    assert bus.write(at.TORQUE, b"\x01") == (0, b"")
    assert bus.write(at.MODE, b"\x03")[0] == ACCESS  # the EEPROM is locked while torque is on


def test_a_write_over_several_registers_is_all_or_nothing(bus):
    before = bus.number(at.GOAL_CURRENT, 2)
    block = u16(20) + struct.pack("<iii", 0, 0, 0) + b"\x00\x00"
    assert bus.write(at.GOAL_CURRENT, block)[0] == LENGTH
    assert bus.number(at.GOAL_CURRENT, 2) == before


@pytest.mark.parametrize(("address", "length"), [(147, 1), (140, 8), (65535, 1), (0, 65535)])
def test_a_read_beyond_the_table_is_an_access_error(bus, address, length):
    assert bus.ask(1, READ, u16(address), u16(length)) == (ACCESS, b"")


@pytest.mark.parametrize(
    ("body", "error"),
    [
        ((READ,), LENGTH),
        ((READ, u16(0)), LENGTH),
        ((READ, u16(0), u16(0)), LENGTH),
        ((WRITE, u16(64)), LENGTH),
        ((WRITE,), LENGTH),
        ((REG_WRITE, u16(64)), LENGTH),
        ((0x77,), INSTRUCTION),
        ((0x20, b"\x01CTRL"), INSTRUCTION),  # backup: of later firmware
        ((FACTORY_RESET, b"\x07"), RANGE),
        ((CLEAR, b"\x01\x00\x00\x00\x00"), RANGE),
    ],
)
def test_an_instruction_that_can_not_be_carried_out_says_why(bus, body, error):
    assert bus.ask(1, *body) == (error, b"")


def test_a_wrong_crc_is_answered_by_the_addressed_servo_and_by_none_of_a_broadcast(bus):
    for servo_id, answers in ((1, [(1, CRC, b"")]), (ALL, []), (9, [])):
        line = packet(servo_id, PING)
        assert statuses(bus.send(line[:-1] + bytes([line[-1] ^ 1]))) == answers


def test_a_header_inside_data_is_stuffed_both_ways(bus):
    bus.write(at.GOAL_POSITION, struct.pack("<i", 0x00FDFFFF))  # beyond its range: refused
    data = b"\xff\xff\xfd\xff"  # -131073, within the range
    assert bus.write(at.GOAL_POSITION, data) == (0, b"")
    line = bus.send(packet(1, READ, u16(at.GOAL_POSITION), u16(4)))
    assert b"\xff\xff\xfd\xfd\xff" in line[7:]
    assert statuses(line) == [(1, 0, data)]


def test_a_status_packet_and_ids_that_no_servo_has_are_ignored(bus):
    assert bus.send(packet(1, 0x55, 0)) == b""
    for servo_id in (0xFD, 0xFF, 0):
        assert bus.send(packet(servo_id, PING)) == b""
    assert bus.ask(1, PING)[0] == 0


def test_a_broadcast_read_is_not_answered_and_a_broadcast_write_is_carried_out(bus):
    assert bus.send(packet(ALL, READ, u16(0), u16(2))) == b""
    assert bus.send(packet(ALL, WRITE, u16(at.TORQUE), 1)) == b""
    assert [bus.number(at.TORQUE, 1, servo) for servo in (1, 2)] == [1, 1]


@pytest.mark.parametrize(("level", "answered"), [(0, (PING,)), (1, (PING, READ))])
def test_the_status_return_level_chooses_who_is_answered(bus, level, answered):
    bus.write(at.STATUS_RETURN, bytes([level]))
    bodies = {
        PING: (PING,), READ: (READ, u16(0), u16(2)), WRITE: (WRITE, u16(at.TORQUE), 1),
        REG_WRITE: (REG_WRITE, u16(at.TORQUE), 0), REBOOT: (0x77,),
    }  # fmt: skip
    assert tuple(c for c, body in bodies.items() if bus.send(packet(1, *body))) == answered
    assert bus.servos[0].torque  # the write has been carried out all the same


def test_the_alert_bit_is_in_every_answer_until_a_reboot(bus):
    bus.write(at.TORQUE, b"\x01")
    bus.servos[0].fail(0x20)
    assert bus.ask(1, PING)[0] == ALERT
    assert bus.ask(1, READ, u16(at.HARDWARE_ERROR), u16(1)) == (ALERT, b"\x20")
    assert bus.write(at.TORQUE, b"\x01")[0] == ALERT | ACCESS
    assert bus.write(at.SHUTDOWN, b"\x34\x01")[0] == ALERT | ACCESS  # nor over two registers
    assert bus.ask(1, READ, u16(at.TORQUE), u16(1)) == (ALERT, b"\x00")
    assert bus.ask(1, REBOOT)[0] == 0
    assert bus.write(at.TORQUE, b"\x01") == (0, b"")


def test_a_reboot_resets_what_is_volatile_and_keeps_what_is_not(bus):
    bus.write(at.MODE, b"\x03")
    bus.write(at.TORQUE, b"\x01")
    bus.write(at.WATCHDOG, b"\x05")
    bus.servos[0].position = 5000.0
    assert bus.send(packet(1, REBOOT)) == bytes.fromhex("FFFFFD000104005500A10C")  # e-Manual
    bus.servos[0].publish()
    volatile = [bus.number(address, 1) for address in (at.TORQUE, at.WATCHDOG)]
    assert volatile == [0, 0]
    assert bus.number(at.MODE, 1) == 3
    assert bus.number(at.PRESENT_POSITION, 4) == 904  # the turn count is lost


def test_the_watchdog_trips_only_under_torque_and_any_instruction_feeds_it(bus):
    bus.write(at.WATCHDOG, b"\x05")  # 100 ms
    bus.wait(1.0)
    assert bus.number(at.WATCHDOG, 1) == 5
    bus.write(at.TORQUE, b"\x01")
    for _ in range(5):
        bus.wait(0.09)
        bus.send(packet(2, PING))  # communication on the bus, not with this servo
    assert bus.number(at.WATCHDOG, 1) == 5
    bus.wait(0.11)
    assert bus.number(at.WATCHDOG, 1) == -1


def test_damaged_instructions_do_not_feed_the_watchdog(bus):
    bus.write(at.TORQUE, b"\x01")
    bus.write(at.WATCHDOG, b"\x05")
    for _ in range(3):
        bus.wait(0.05)
        bus.send(packet(1, PING)[:-1] + b"\x00")
    assert bus.number(at.WATCHDOG, 1) == -1


def test_a_tripped_watchdog_refuses_goals_with_a_range_error_and_only_0_clears_it(bus):
    bus.write(at.TORQUE, b"\x01")
    bus.write(at.WATCHDOG, b"\x05")
    bus.wait(0.2)
    goals = {at.GOAL_PWM: 2, at.GOAL_CURRENT: 2, at.GOAL_VELOCITY: 4, at.GOAL_POSITION: 4}
    for address, size in goals.items():
        assert bus.write(address, bytes(size))[0] == RANGE
    assert bus.write(at.PROFILE_VELOCITY, bytes(4))[0] == 0  # not a goal
    for value in (5, 127, 255):
        assert bus.write(at.WATCHDOG, bytes([value]))[0] == RANGE
    bus.write(at.TORQUE, b"\x00")
    bus.write(at.TORQUE, b"\x01")
    assert bus.number(at.WATCHDOG, 1) == -1  # torque does not clear it
    assert bus.write(at.WATCHDOG, b"\x00")[0] == 0
    assert bus.write(at.GOAL_POSITION, bytes(4))[0] == 0
    bus.write(at.WATCHDOG, b"\x05")
    bus.wait(0.2)
    assert bus.ask(1, REBOOT)[0] == 0
    assert bus.number(at.WATCHDOG, 1) == 0


def test_clear_takes_off_whole_turns_of_a_servo_at_rest(bus):
    bus.servos[0].position = 3 * 4096 + 12.0
    line = bytes.fromhex("FFFFFD0001080010014458 4C22B1DC")  # e-Manual
    assert bus.send(line) == bytes.fromhex("FFFFFD000104005500A10C")
    assert bus.servos[0].position == 12
    bus.servos[0].waiting = True  # moving
    assert statuses(bus.send(line)) == [(1, FAILED, b"")]


def test_a_factory_reset_keeps_what_its_option_says(bus):
    bus.write(at.BAUD, b"\x03")
    bus.write(at.ID, b"\x08", servo_id=2)
    assert bus.ask(8, FACTORY_RESET, b"\x02") == (0, b"")
    assert bus.number(at.MODE, 1, 8) == 3  # position control, as from the factory
    assert bus.ask(8, FACTORY_RESET, b"\x01") == (0, b"")
    assert bus.send(packet(8, PING)) == b""  # its baud rate is the factory's now
    assert statuses(bus.send(packet(8, PING), baud=57600))[0][0] == 8
    assert bus.send(packet(ALL, FACTORY_RESET, b"\xff"), baud=57600) == b""
    assert statuses(bus.send(packet(8, PING), baud=57600))[0][0] == 8  # a broadcast resets no id


def test_a_new_id_and_a_new_baud_rate_hold_from_the_next_packet_on(bus):
    assert bus.write(at.ID, b"\x07") == (0, b"")
    assert bus.send(packet(1, PING)) == b""
    assert bus.write(at.BAUD, b"\x01", servo_id=7) == (0, b"")
    assert bus.send(packet(7, PING)) == b""
    assert statuses(bus.send(packet(7, PING), baud=57600))[0][0] == 7


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("mode", [0, 1, 3, 4, 16])
def test_in_every_mode_the_current_stays_a_number_of_its_register(model, mode):
    bus = Bus(model, count=1)
    servo = bus.servos[0]
    assert bus.write(at.MODE, bytes([mode])) == (0, b"")
    bus.write(at.TORQUE, b"\x01")
    servo.closing, servo.stop = 1, 0.0  # at an object
    bus.write(at.GOAL_POSITION, struct.pack("<i", 500))
    for _ in range(200):
        servo.step(0.002)
    assert 0 < bus.number(at.PRESENT_CURRENT, 2) < 2048
