"""The emulated RTDE port against Universal Robots' RTDE guide, byte by byte."""

import math
import struct

import numpy as np
import pytest

from sim.emulators.ur.controller import Controller
from sim.emulators.ur.options import START_TCP, TCP_OFFSET
from sim.emulators.ur.packets import INPUT_TYPES, OUTPUT_TYPES, StreamLostError
from sim.emulators.ur.rtde_session import RtdeSession

SIZES = {
    "BOOL": 1, "UINT8": 1, "UINT32": 4, "UINT64": 8, "INT32": 4, "DOUBLE": 8, "VECTOR3D": 24,
    "VECTOR6D": 48, "VECTOR6INT32": 24, "VECTOR6UINT32": 24,
}  # fmt: skip
"""Bytes of the guide's data types."""

GUIDE_OUTPUTS = {
    "timestamp": "DOUBLE", "target_q": "VECTOR6D", "target_qd": "VECTOR6D",
    "actual_q": "VECTOR6D", "actual_qd": "VECTOR6D", "actual_current": "VECTOR6D",
    "actual_TCP_pose": "VECTOR6D", "actual_TCP_speed": "VECTOR6D", "actual_TCP_force": "VECTOR6D",
    "target_TCP_pose": "VECTOR6D", "actual_digital_input_bits": "UINT64",
    "joint_temperatures": "VECTOR6D", "actual_execution_time": "DOUBLE", "robot_mode": "INT32",
    "joint_mode": "VECTOR6INT32", "safety_mode": "INT32", "safety_status": "INT32",
    "actual_tool_accelerometer": "VECTOR3D", "speed_scaling": "DOUBLE",
    "target_speed_fraction": "DOUBLE", "actual_momentum": "DOUBLE",
    "actual_digital_output_bits": "UINT64", "runtime_state": "UINT32",
    "robot_status_bits": "UINT32", "safety_status_bits": "UINT32",
    "output_bit_registers0_to_31": "UINT32", "output_int_register_0": "INT32",
    "output_int_register_47": "INT32", "output_double_register_0": "DOUBLE",
    "output_double_register_47": "DOUBLE", "payload": "DOUBLE", "payload_cog": "VECTOR3D",
    "payload_inertia": "VECTOR6D", "tcp_offset": "VECTOR6D", "ft_raw_wrench": "VECTOR6D",
}  # fmt: skip
GUIDE_INPUTS = {
    "speed_slider_mask": "UINT32", "speed_slider_fraction": "DOUBLE",
    "standard_digital_output_mask": "UINT8", "standard_digital_output": "UINT8",
    "configurable_digital_output_mask": "UINT8", "standard_analog_output_mask": "UINT8",
    "standard_analog_output_type": "UINT8", "standard_analog_output_0": "DOUBLE",
    "input_int_register_0": "INT32", "input_int_register_47": "INT32",
    "input_double_register_0": "DOUBLE", "input_double_register_47": "DOUBLE",
    "external_force_torque": "VECTOR6D",
}  # fmt: skip


def frame(kind, body=b""):
    return struct.pack(">H", 3 + len(body)) + kind + body


def unframed(data):
    """(type, payload) of every packet; fails if a size does not fit."""
    packets = []
    while data:
        (size,) = struct.unpack_from(">H", data)
        assert 3 <= size <= len(data)
        packets.append((data[2:3], data[3:size]))
        data = data[size:]
    return packets


class Client:
    """One client of a controller whose clock the test moves."""

    def __init__(self, controller=None, taken=None, version=None):
        self.clock_s = 50.0
        self.controller = controller or Controller(
            np.array(START_TCP), np.array(TCP_OFFSET), None, lambda: self.clock_s
        )
        self.taken = {} if taken is None else taken
        self.session = RtdeSession(self.controller, (5, 12), self.taken)
        if version is not None:
            assert self.ask(b"V", struct.pack(">H", version)) == b"\x01"

    def send(self, kind, body=b""):
        return unframed(self.session.receive(frame(kind, body)))

    def ask(self, kind, body=b""):
        """The one answer of the packet's own type."""
        ((answered, payload),) = self.send(kind, body)
        assert answered == kind
        return payload

    def outputs(self, *names, rate_hz=125.0):
        return self.ask(b"O", struct.pack(">d", rate_hz) + ",".join(names).encode())

    def inputs(self, *names):
        return self.ask(b"I", ",".join(names).encode())

    def message(self, kind, body=b""):
        """Text, source and level of the text message (version 2) that answers a packet."""
        ((answered, payload),) = self.send(kind, body)
        assert answered == b"M"
        length = payload[0]
        text, rest = payload[1 : 1 + length], payload[1 + length :]
        source, level = rest[1 : 1 + rest[0]], rest[1 + rest[0] :]
        assert len(level) == 1
        return text.decode(), source.decode(), level[0]


@pytest.fixture
def client():
    return Client(version=2)


@pytest.mark.parametrize(("version", "accepted"), [(1, 1), (2, 1), (0, 0), (3, 0), (65535, 0)])
def test_versions_1_and_2_are_accepted_and_others_refused(version, accepted):
    assert Client().ask(b"V", struct.pack(">H", version)) == bytes([accepted])


def test_a_refused_version_leaves_the_one_before(client):
    assert client.ask(b"V", b"\x00\x09") == b"\x00"
    assert client.outputs("timestamp") == b"\x01DOUBLE"  # still with a recipe id


def test_the_controller_s_version_is_four_numbers(client):
    assert struct.unpack(">4I", client.ask(b"v")) == (5, 12, 0, 0)


def test_types_of_the_guide_s_outputs(client):
    assert client.outputs(*GUIDE_OUTPUTS) == b"\x01" + ",".join(GUIDE_OUTPUTS.values()).encode()
    assert set(OUTPUT_TYPES.values()) <= SIZES.keys()


def test_types_of_the_guide_s_inputs(client):
    assert client.inputs(*GUIDE_INPUTS) == b"\x01" + ",".join(GUIDE_INPUTS.values()).encode()
    assert set(INPUT_TYPES.values()) <= SIZES.keys()


def test_a_data_packet_has_the_recipe_s_id_order_and_size(client):
    client.outputs(*GUIDE_OUTPUTS)
    assert client.ask(b"S") == b"\x01"
    ((kind, body),) = unframed(client.session.data())
    assert kind == b"U" and body[0] == 1
    assert len(body) == 1 + sum(SIZES[kind] for kind in GUIDE_OUTPUTS.values())


def test_values_are_big_endian_in_the_order_asked(client):
    client.outputs("actual_TCP_pose", "robot_mode", "timestamp", "safety_status_bits")
    client.clock_s += 2.5
    ((_, body),) = unframed(client.session.data())
    *pose, mode, stamp_s, bits = struct.unpack(">6didI", body[1:])
    assert pose == pytest.approx(START_TCP)
    assert (mode, stamp_s, bits) == (7, 2.5, 1)


def test_an_unknown_output_is_not_found_and_the_recipe_before_stays(client):
    client.outputs("timestamp")
    types = client.outputs("timestamp", "no_such")[1:]
    assert types == b"DOUBLE,NOT_FOUND"
    ((_, body),) = unframed(client.session.data())
    assert len(body) == 9


def test_a_start_without_outputs_fails_and_a_pause_stops_the_stream(client):
    assert client.ask(b"S") == b"\x00"
    assert not client.session.streaming
    client.outputs("timestamp")
    assert client.ask(b"S") == b"\x01" and client.session.streaming
    assert client.ask(b"P") == b"\x01" and not client.session.streaming


@pytest.mark.parametrize(
    ("rate_hz", "period_s"),
    [(125.0, 0.008), (500.0, 0.002), (1.0, 1.0), (0.0, 0.002), (math.nan, 0.002), (1e9, 0.002)],
)
def test_the_output_frequency_is_1_to_500_hz(client, rate_hz, period_s):
    client.outputs("timestamp", rate_hz=rate_hz)
    assert client.session.period_s == pytest.approx(period_s)


def test_version_1_has_no_frequency_and_no_recipe_id_of_outputs():
    for client in (Client(version=1), Client()):  # 1 is spoken until another one is asked for
        assert client.ask(b"O", b"timestamp,robot_mode") == b"DOUBLE,INT32"
        ((kind, body),) = unframed(client.session.data())
        assert kind == b"U"
        assert struct.unpack(">di", body)[1] == 7
        assert client.inputs("input_int_register_0") == b"\x01INT32"


def test_input_recipes_are_numbered_and_written_by_their_number(client):
    assert client.inputs("input_int_register_3", "input_double_register_2")[0] == 1
    assert client.inputs("input_int_register_4")[0] == 2
    assert client.send(b"U", b"\x02" + struct.pack(">i", -7)) == []
    assert client.send(b"U", b"\x01" + struct.pack(">id", 9, 0.25)) == []
    registers = client.controller.inputs
    assert registers["input_int_register_4"] == -7
    assert (registers["input_int_register_3"], registers["input_double_register_2"]) == (9, 0.25)


def test_an_unknown_input_gives_no_recipe(client):
    assert client.inputs("input_int_register_0", "no_such") == b"\x00INT32,NOT_FOUND"
    text, _, level = client.message(b"U", b"\x01" + struct.pack(">i", 5))
    assert "no input recipe 1" in text and level == 1
    assert client.controller.inputs["input_int_register_0"] == 0


def test_an_input_of_another_client_is_in_use_until_that_one_disconnects(client):
    assert client.inputs("input_int_register_0", "input_int_register_1")[0] == 1
    other = Client(client.controller, client.taken, version=2)
    assert other.inputs("input_int_register_1", "input_int_register_2") == b"\x00IN_USE,INT32"
    third = Client(client.controller, client.taken, version=2)
    assert third.inputs("input_int_register_2")[0] == 1  # a refused recipe has claimed nothing
    client.session.close()
    assert other.inputs("input_int_register_1") == b"\x01INT32"


def test_there_are_at_most_255_input_recipes(client):
    for number in range(1, 256):
        assert client.inputs("input_int_register_0")[0] == number
    assert client.inputs("input_int_register_0")[0] == 0


@pytest.mark.parametrize(
    ("kind", "body", "text"),
    [
        (b"V", b"", "2 bytes, got 0"),
        (b"V", b"\x00\x02\x00", "2 bytes, got 3"),
        (b"O", b"\x40", "output frequency of 8 bytes, got 1"),
        (b"U", b"", "empty data packet"),
        (b"U", b"\x07\x00", "no input recipe 7"),
        (b"Z", b"", "unknown package type 90"),
        (b"\xff", b"\x00\x01", "unknown package type 255"),
    ],
)
def test_a_payload_that_does_not_fit_is_told_by_a_text_message_and_survived(
    client, kind, body, text
):
    told, source, level = client.message(kind, body)
    assert text in told
    assert (source, level) == ("RTDE", 1)
    assert client.outputs("timestamp") == b"\x01DOUBLE"


def test_a_data_packet_of_the_wrong_length_writes_nothing(client):
    client.inputs("input_int_register_0", "input_double_register_0")
    text, _, _ = client.message(b"U", b"\x01" + struct.pack(">i", 5))
    assert "12 bytes, got 4" in text
    assert client.controller.inputs["input_int_register_0"] == 0


def test_a_text_message_of_version_1_is_level_and_text():
    ((kind, body),) = Client(version=1).send(b"Z")
    assert kind == b"M"
    assert (body[0], body[1:]) == (1, b"unknown package type 90")


def test_a_client_s_own_text_message_is_taken_without_an_answer(client):
    assert client.send(b"M", b"\x02hi\x01x\x03") == []


def test_a_packet_may_come_in_any_pieces(client):
    stream = frame(b"v") + frame(b"P")
    answers = b"".join(client.session.receive(bytes([byte])) for byte in stream)
    assert [kind for kind, _ in unframed(answers)] == [b"v", b"P"]


@pytest.mark.parametrize("size", [0, 1, 2, 65535])
def test_a_size_that_no_packet_has_ends_the_connection(client, size):
    with pytest.raises(StreamLostError, match=f"packet of {size} bytes"):
        client.session.receive(struct.pack(">HB", size, 86))


# the script's arguments, as RTDE brings them


COMMANDS = {
    "moveL": 3, "forceMode": 6, "speedJ": 9, "speedL": 10, "servoJ": 11, "payload": 17,
    "servoL": 24, "TCP": 29, "stopL": 33,
}  # fmt: skip


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e308])
@pytest.mark.parametrize("name", COMMANDS)
def test_arguments_that_no_arm_can_take_end_the_script_or_stop_the_arm(client, name, value):
    client.inputs(*[f"input_int_register_{i}" for i in range(8)],
                  *[f"input_double_register_{i}" for i in range(18)])  # fmt: skip
    client.controller.start_program()
    numbers = [COMMANDS[name], 1, *([1] * 6)], [value] * 18
    client.send(b"U", b"\x01" + struct.pack(">8i18d", *numbers[0], *numbers[1]))
    for _ in range(5):
        client.clock_s += 0.1
        client.controller.advance()
    controller = client.controller
    assert controller.program is None or controller.safety_mode == 3
    assert controller.robot.speed_m_s == 0
    assert np.isfinite(controller.values("actual_TCP_pose")).all()


def test_an_arm_led_out_of_its_reach_gets_a_protective_stop_within_it(client):
    client.inputs(*[f"input_int_register_{i}" for i in range(8)],
                  *[f"input_double_register_{i}" for i in range(18)])  # fmt: skip
    client.controller.start_program()
    speed = [0.5, 0, 0, 0, 0, 0, 1.0, *([0] * 11)]
    client.send(b"U", b"\x01" + struct.pack(">8i18d", 10, *([0] * 7), *speed))
    for _ in range(60):
        client.clock_s += 0.1
        client.controller.advance()
        client.controller.values("actual_q")
    assert client.controller.safety_mode == 3
    assert client.controller.robot.speed_m_s == 0
    assert 0.6 < client.controller.robot.tool.position_m[0] < 1.4
    assert np.isfinite(client.controller.values("actual_q")).all()
