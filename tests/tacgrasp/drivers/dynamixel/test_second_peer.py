"""The gripper's driver against a second servo, which shares no code with the emulator.

The same packets are also given to servo and emulator: where both know an instruction, both give the
same bytes. Left out by the peer: see its docstring.
"""

from random import Random

import pytest

from primitives.errors import LimitError, RobotError
from sim.emulators.dynamixel.bus import ServoBus
from sim.emulators.dynamixel.control_table import MODELS
from sim.emulators.dynamixel.packets import PacketReader
from sim.emulators.dynamixel.servo import EmulatedServo
from tacgrasp.drivers.dynamixel.gripper import check, connect_gripper
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tests.fakes.emulated_servos import emulated_gripper, eventually
from tests.fakes.peers.dynamixel_peer import ServoPeer, checksum

pytest.importorskip("dynamixel_sdk")


@pytest.fixture
def servo():
    servo = ServoPeer()
    yield servo
    servo.close()


@pytest.fixture
def settings(servo, tmp_path):
    given = emulated_gripper(servo.port, tmp_path).model_dump()
    # The longest wait that the settings allow: a busy computer must fail no test.
    return DynamixelSettings(**given | {"reply_timeout_ms": 100.0})


@pytest.fixture
def gripper(settings, tmp_path):
    gripper = connect_gripper(settings, folder=tmp_path)
    yield gripper
    gripper.disconnect()


def test_the_doctor_finds_nothing_wrong(settings, tmp_path):
    wrong = [each for each in check(settings, folder=tmp_path) if not each.ok]
    assert [each for each in wrong if each.name != "latency"] == []  # on a busy computer


def test_it_connects_grips_holds_opens_and_disconnects(servo, gripper):
    assert (servo["torque"], servo["watchdog"]) == (1, 25)
    assert gripper.state().width_m == pytest.approx(0.110, abs=1e-3)
    state = gripper.grip(1.0)
    assert state.closed and state.force_n == 1.0
    assert state.width_m == pytest.approx(0.110 * (2000 - 1600) / 896, abs=1e-3)
    assert servo["current"] == -servo["goal current"] < 0
    held = gripper.grip(0.5)  # adjusted while it holds
    assert held.width_m == pytest.approx(state.width_m, abs=1e-4)
    opened = gripper.open_by(0.02)
    assert opened.width_m == pytest.approx(state.width_m + 0.02, abs=1e-3)
    assert not opened.closed
    gripper.disconnect()
    assert (servo["torque"], servo["watchdog"]) == (1, 0)  # what it holds stays held


def test_without_an_object_the_fingers_close(servo, gripper):
    servo.object_ticks = None
    assert gripper.grip(1.0).width_m == pytest.approx(0.0, abs=1e-3)


def test_a_force_beyond_the_calibration_sends_nothing(servo, gripper):
    before = servo["goal current"]
    with pytest.raises(LimitError):
        gripper.grip(1000.0)
    assert servo["goal current"] == before


@pytest.mark.parametrize(
    "damage",
    [
        lambda line: line[:-1] + bytes([line[-1] ^ 0x10]),
        lambda line: line[: len(line) // 2],
        lambda line: b"",
        lambda line: b"\xff\xff" + line,
        lambda line: line + line,
    ],
    ids=["wrong CRC", "half", "none", "noise before", "twice"],
)
def test_one_damaged_answer_is_survived(servo, gripper, damage):
    for _ in range(3):
        servo.damage = damage
        assert eventually(lambda: servo.damage is None)
        assert gripper.state().width_m == pytest.approx(0.110, abs=1e-3)
    assert gripper.fault == ""


@pytest.mark.parametrize(
    ("happens", "reason"),
    [
        (lambda servo: setattr(servo, "mute", True), "does not answer"),
        (lambda servo: servo.fail(0x20), "overloaded"),
        (lambda servo: servo.fail(0x08), "motor encoder failed"),
        (lambda servo: servo.__setitem__("temperature", 90), "90 °C"),
        (lambda servo: servo.restart(), "restart"),
        (lambda servo: servo.__setitem__("torque", 0), "torque"),
    ],
    ids=["mute", "overload", "encoder", "hot", "restart", "torque off"],
)
def test_a_fault_while_it_holds_is_latched_with_its_reason(servo, gripper, happens, reason):
    gripper.grip(1.0)
    happens(servo)
    assert eventually(lambda: gripper.fault)
    assert reason in gripper.fault
    for call in (gripper.state, lambda: gripper.grip(1.0), lambda: gripper.open_by(0.01)):
        with pytest.raises(RobotError):
            call()


def test_a_tripped_watchdog_is_a_fault_until_the_next_connection(servo, settings, tmp_path):
    gripper = connect_gripper(settings, folder=tmp_path)
    servo["watchdog"] = 0xFF
    assert eventually(lambda: gripper.fault)
    assert "watchdog" in gripper.fault
    gripper.disconnect()
    again = connect_gripper(settings, folder=tmp_path)
    assert again.grip(1.0).closed
    again.disconnect()


def packet(servo_id, *body):
    data = b"".join(bytes([part]) if isinstance(part, int) else part for part in body)
    data = data.replace(b"\xff\xff\xfd", b"\xff\xff\xfd\xfd")
    line = b"\xff\xff\xfd\x00" + bytes([servo_id]) + (len(data) + 2).to_bytes(2, "little") + data
    return line + checksum(line).to_bytes(2, "little")


def random_instruction(rng):
    """An instruction that both know, to registers that time does not change."""
    address = rng.choice((0, 6, 7, 11, 38, 63, 64, 68, 69, 98, 100, 102, 104, 112, 146, 147, 400))
    size = rng.choice((1, 1, 2, 2, 4, 8, 0))
    value = rng.choice((0, 1, 2, 5, 25, 127, 128, 255, 800, 911, 0xFFFF, rng.randrange(2**32)))
    size = min(size, 4) if address == 38 else size  # the peer lacks the limits behind
    head, data = address.to_bytes(2, "little"), value.to_bytes(8, "little")[:size]
    if address == 7 or (address == 68 and value != 2):
        return packet(1, 2, head, bytes([1, 0]))  # ids stay; the peer answers everything
    code = rng.choice((1, 2, 2, 3, 3, 3, 3, 0x77, 8))
    bodies = {1: b"", 2: head + size.to_bytes(2, "little"), 3: head + data, 0x77: data, 8: b""}
    line = packet(rng.choice((1, 1, 1, 1, 0xFE, 9)), code, bodies[code])
    return line if rng.random() < 0.95 else line[:-1] + bytes([line[-1] ^ 1])


def test_peer_and_emulator_give_the_same_bytes_to_the_same_packets(servo):
    model = MODELS["XC330-T288"]
    emulated = EmulatedServo(model, 1, baud=1_000_000, mode=5, friction_ma=12.0)
    emulated.table[6], emulated.position = servo["firmware"], 2496.0
    emulated.table[146], emulated.table[144] = servo["temperature"], servo["voltage"]
    bus, reader = ServoBus([emulated], lambda _: False, lambda _: None), PacketReader()
    answers = []
    servo._say = lambda error, data=b"": answers.append((error | _alert(servo), data))
    rng, number = Random(17), 0
    with servo._lock:
        for number in range(3000):
            line = random_instruction(rng)
            answers.clear()
            servo._hear(line)
            theirs = [
                (status[8], status[9:-2].replace(b"\xff\xff\xfd\xfd", b"\xff\xff\xfd"))
                for instruction in reader.feed(line)
                for status in bus.execute(instruction, 1_000_000)
            ]
            assert answers == theirs, f"packet {number}: {line.hex()}"
            if number % 200 == 199:  # a hardware error, later ended by a reboot
                servo.fail(0x20)
                emulated.fail(0x20)


def _alert(servo):
    return 0x80 if servo["hardware error"] else 0
