"""RTDE on the controller's side: packets, and types of the variables.

Big-endian; a u16 size that includes the three bytes of header, a u8 type, the payload. Not here:
connections (``sim.emulators.ur.rtde_session``), values (``sim.emulators.ur.controller``).

Source: universal-robots.com, 'Real-Time Data Exchange (RTDE) Guide', protocol versions 1 and 2.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence

VERSION, CONTROLLER_VERSION, MESSAGE = ord("V"), ord("v"), ord("M")
OUTPUTS, INPUTS, DATA, START, PAUSE = ord("O"), ord("I"), ord("U"), ord("S"), ord("P")

HEADER = struct.Struct(">HB")
LARGEST = 4096
"""Longest accepted packet [bytes]. Our choice: the guide allows 2048 bytes of variables' names."""

ERROR_LEVEL = 1
"""Level of a text message: 0 exception, 1 error, 2 warning, 3 information."""

FORMATS = {
    "BOOL": "?",
    "UINT8": "B",
    "UINT32": "I",
    "UINT64": "Q",
    "INT32": "i",
    "DOUBLE": "d",
    "VECTOR3D": "3d",
    "VECTOR6D": "6d",
    "VECTOR6INT32": "6i",
    "VECTOR6UINT32": "6I",
}

_SIX = [
    "target_q", "target_qd", "target_qdd", "target_current", "target_moment", "actual_q",
    "actual_qd", "actual_qdd", "actual_current", "actual_current_as_torque", "actual_moment",
    "joint_control_output", "joint_temperatures", "actual_joint_voltage", "actual_TCP_pose",
    "actual_TCP_speed", "actual_TCP_force", "target_TCP_pose", "target_TCP_speed",
    "ft_raw_wrench", "payload_inertia", "tcp_offset",
]  # fmt: skip
_DOUBLES = [
    "timestamp", "actual_execution_time", "speed_scaling", "target_speed_fraction",
    "actual_momentum", "actual_main_voltage", "actual_robot_voltage", "actual_robot_current",
    "standard_analog_input0", "standard_analog_input1", "standard_analog_output0",
    "standard_analog_output1", "payload",
]  # fmt: skip

_INT32 = ["robot_mode", "safety_mode", "safety_status"]
_UINT32 = [
    "runtime_state", "robot_status_bits", "safety_status_bits", "output_bit_registers0_to_31",
    "output_bit_registers32_to_63",
]  # fmt: skip
_BYTE_INPUTS = [
    "standard_digital_output_mask", "standard_digital_output", "configurable_digital_output_mask",
    "configurable_digital_output", "tool_digital_output_mask", "tool_digital_output",
    "standard_analog_output_mask", "standard_analog_output_type",
]  # fmt: skip

OUTPUT_TYPES: Mapping[str, str] = {
    **dict.fromkeys(_SIX, "VECTOR6D"),
    **dict.fromkeys(_DOUBLES, "DOUBLE"),
    **dict.fromkeys(_INT32, "INT32"),
    **dict.fromkeys(_UINT32, "UINT32"),
    "joint_mode": "VECTOR6INT32",
    "actual_digital_input_bits": "UINT64",
    "actual_digital_output_bits": "UINT64",
    "actual_tool_accelerometer": "VECTOR3D",
    "payload_cog": "VECTOR3D",
    **{f"output_int_register_{i}": "INT32" for i in range(48)},
    **{f"output_double_register_{i}": "DOUBLE" for i in range(48)},
}

INPUT_TYPES: Mapping[str, str] = {
    **{f"input_int_register_{i}": "INT32" for i in range(48)},
    **{f"input_double_register_{i}": "DOUBLE" for i in range(48)},
    **dict.fromkeys(_BYTE_INPUTS, "UINT8"),
    "external_force_torque": "VECTOR6D",
    "speed_slider_mask": "UINT32",
    "speed_slider_fraction": "DOUBLE",
    "standard_analog_output_0": "DOUBLE",
    "standard_analog_output_1": "DOUBLE",
}


class StreamLostError(ValueError):
    """A client sent bytes after which its next command can't be found; it is disconnected."""


def packet(kind: int, payload: bytes = b"") -> bytes:
    """A complete packet."""
    return HEADER.pack(HEADER.size + len(payload), kind) + payload


def split(buffer: bytearray) -> list[tuple[int, bytes]]:
    """Remove all complete packets from a buffer; returns (type, payload) of each.

    Raises:
        StreamLostError: An impossible size.
    """
    packets = []
    while len(buffer) >= HEADER.size:
        size, kind = HEADER.unpack_from(buffer)
        if not HEADER.size <= size <= LARGEST:
            raise StreamLostError(f"an RTDE packet of {size} bytes")
        if len(buffer) < size:
            break
        packets.append((kind, bytes(buffer[HEADER.size : size])))
        del buffer[:size]
    return packets


def text_message(version: int, text: str, level: int = ERROR_LEVEL) -> bytes:
    """A text message to the client, in the layout of a protocol version.

    Version 1: level, text. Version 2: length and text, length and source, level.
    """
    line = text.encode("ascii", "replace")[:255]
    if version == 1:
        return packet(MESSAGE, bytes([level]) + line)
    source = b"RTDE"
    body = bytes([len(line)]) + line + bytes([len(source)]) + source + bytes([level])
    return packet(MESSAGE, body)


def names_in(payload: bytes) -> list[str]:
    """Comma-separated names; a trailing comma adds none."""
    return [name for name in payload.decode("ascii", "replace").split(",") if name]


def types_of(names: Sequence[str], known: Mapping[str, str]) -> list[str]:
    """Type of each name, NOT_FOUND for an unknown one."""
    return [known.get(name, "NOT_FOUND") for name in names]


def layout(types: Sequence[str]) -> struct.Struct:
    """Layout of a data packet with these types."""
    return struct.Struct(">" + "".join(FORMATS[kind] for kind in types))


def num_values(kind: str) -> int:
    """Number of values of a type."""
    return int(FORMATS[kind][:-1] or 1)
