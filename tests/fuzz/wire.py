"""Parsers of bytes from a wire, driver side and emulator side, under mutated streams.

A case is one byte that selects side and scenario, then the stream. Emulators are read without their
sockets, ptys and threads: below the nets that would hide an error of theirs.
"""

from __future__ import annotations

import struct
import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from random import Random

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.sensing.taxel_packets import (
    PacketParser,
    SequenceCount,
    TaxelFrame,
    TaxelMark,
    encode_frame,
    encode_mark,
)
from sim.emulators.dynamixel import packets as dxl
from sim.emulators.dynamixel.bus import ServoBus
from sim.emulators.dynamixel.control_table import MODELS
from sim.emulators.dynamixel.fingers import Fingers, Linkage, SpringLoad
from sim.emulators.dynamixel.servo import EmulatedServo
from sim.emulators.ur import packets as rtde
from sim.emulators.ur.controller import Controller
from sim.emulators.ur.dashboard_session import DashboardSession
from sim.emulators.ur.kinematics import READY_Q, as_frame, base_from_flange, rotvec
from sim.emulators.ur.options import TCP_OFFSET
from sim.emulators.ur.packets import StreamLostError
from sim.emulators.ur.rtde_session import RtdeSession
from sim.emulators.ur.sessions import ScriptSession, Session
from tests.fuzz.target import FuzzTarget

VERSION = (5, 12)
BAUD = 1_000_000
LONGEST = 1 << 16
"""Bytes of a case: more than the buffer of any port holds."""

MOST_PIECES = 500
"""Steps of emulated time in a case of servos, each of which moves the fingers."""

_EXTREMES = (0, 1, 2, 3, 0x7F, 0x80, 0xFD, 0xFE, 0xFF)
_NUMBERS = (0.0, -0.0, 1.0, 0.1, -3.2, 1e-320, 1e-9, 1e6, 1e150, 1e308, float("inf"), float("nan"))


def mutated(rng: Random, packets: Sequence[bytes]) -> bytes:
    """A stream of packets, a few of them damaged, doubled, left out, moved or spliced."""
    stream = list(packets)
    for _ in range(rng.choice((0, 1, 1, 2, 4))):
        at = rng.randrange(len(stream))
        kind = rng.randrange(8)
        if kind == 0:
            stream[at] = _flipped(rng, stream[at])
        elif kind == 1:
            stream[at] = stream[at][: rng.randrange(len(stream[at]) + 1)]
        elif kind == 2:
            stream[at] = (stream[at] * rng.choice((2, 2, 3, 40)))[:LONGEST]
        elif kind == 3:
            other = rng.choice(stream)
            stream[at] = stream[at][: len(stream[at]) // 2] + other[len(other) // 2 :]
        elif kind == 4:
            header = bytearray(stream[at])
            for i in range(min(len(header), rng.choice((1, 2, 3, 8, 30)))):
                header[i] = rng.choice((header[i], rng.choice(_EXTREMES)))
            stream[at] = bytes(header)
        elif kind == 5:
            stream.insert(at, rng.randbytes(rng.choice((1, 3, 20, 300))))
        elif kind == 6:
            stream[at], stream[0] = stream[0], stream[at]
        else:
            stream[at] = stream[at] + stream[at][-rng.randrange(1, 9) :]
    data = b"".join(stream)[:LONGEST]
    return data[: rng.randrange(len(data) + 1)] if rng.random() < 0.1 else data


def _flipped(rng: Random, data: bytes) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 8)) if changed else 0):
        changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def pieces(data: bytes, size: int) -> Iterator[bytes]:
    """The stream in pieces, as a port gives it."""
    for start in range(0, len(data), size):
        yield data[start : start + size]


# taxels


def _taxel_case(rng: Random) -> bytes:
    frames = []
    for i in range(rng.randrange(1, 4)):
        shape = rng.choice(((8, 8), (3, 40), (1, 1), (20, 30)))
        counts = np.frombuffer(rng.randbytes(2 * shape[0] * shape[1]), "<i2").reshape(shape)
        along = np.frombuffer(rng.randbytes(4 * counts.size), "<i2").reshape(*shape, 2)
        frame = TaxelFrame(
            sequence=(rng.choice((0, 7, 2**32 - 2)) + i) % 2**32,
            mark=rng.choice((0, 1, 2**32 - 1)),
            clock_us=rng.choice((0, 5, 2**64 - 1)),
            counts_um=counts.astype(np.int16),
            along_um=rng.choice((None, along.astype(np.int16))),
        )
        frames += [encode_frame(frame), encode_mark(rng.randrange(1, 2**32))]
    return bytes([rng.randrange(256)]) + mutated(rng, frames)


def _read_taxels(data: bytes) -> object:
    """As the driver takes frames and as the emulator takes marks: one parser for both."""
    parser, numbers, mark, new = PacketParser(), SequenceCount(), 0, 0
    for piece in pieces(data[1:], 1 + data[0] * 7):
        for packet in parser.feed(piece):
            if isinstance(packet, TaxelMark):
                mark = packet.mark
            elif numbers.is_new(packet.sequence):
                new += int(np.isfinite(packet.height_mm).all())
                new += 0 if packet.along_mm is None else int(np.isfinite(packet.along_mm).all())
    answer = TaxelFrame(sequence=1, mark=mark, clock_us=0, counts_um=np.zeros((8, 8), np.int16))
    return encode_frame(answer), new, parser.counts


# Dynamixel


@dataclass(slots=True)
class _RecordedPort:
    """A port under the SDK whose servo has said all that it will say."""

    received: bytes
    at: int = 0
    is_using: bool = False
    sent: list[bytes] = field(default_factory=list)

    def clearPort(self) -> None:  # noqa: N802 - the SDK's names
        """Keep what was received: it is the answer."""

    def writePort(self, packet: Sequence[int]) -> int:  # noqa: N802
        self.sent.append(bytes(packet))
        return len(packet)

    def readPort(self, length: int) -> bytes:  # noqa: N802
        data = self.received[self.at : self.at + max(0, length)]
        self.at += len(data)
        return data

    def setPacketTimeout(self, length: int) -> None:  # noqa: N802
        """Nothing to wait for."""

    setPacketTimeoutMillis = setPacketTimeout  # noqa: N815

    def isPacketTimeout(self) -> bool:  # noqa: N802
        return self.at >= len(self.received)


def _dynamixel_case(rng: Random) -> bytes:
    side = rng.randrange(256)
    if side & 1:
        packets = [
            dxl.status(rng.choice((1, 1, 1, 2, 252)), rng.choice((0, 0, 3, 128, 255)), data)
            for data in (rng.randbytes(rng.choice((0, 2, 3, 4, 25))) for _ in range(3))
        ]
        return bytes([side]) + mutated(rng, [rng.choice(packets), *packets[: rng.randrange(3)]])
    return bytes([side]) + mutated(rng, [_instruction(rng) for _ in range(rng.randrange(1, 9))])


def _instruction(rng: Random) -> bytes:
    code = rng.choice(
        (dxl.PING, dxl.READ, dxl.WRITE, dxl.WRITE, dxl.WRITE, dxl.REG_WRITE, dxl.ACTION,
         dxl.FACTORY_RESET, dxl.REBOOT, dxl.CLEAR, dxl.SYNC_READ, dxl.SYNC_WRITE,
         dxl.FAST_SYNC_READ, dxl.BULK_READ, dxl.BULK_WRITE, dxl.FAST_BULK_READ, 0x55, 0x77)
    )  # fmt: skip
    address = rng.choice((0, 7, 8, 10, 11, 38, 63, 64, 68, 98, 102, 112, 116, 126, 132, 146, 65535))
    size = rng.choice((1, 1, 2, 4, 4, 18, 0))
    value = rng.choice((0, 1, 3, 5, 100, 2**31 - 1, 2**32 - 1, rng.randrange(2**32)))
    data = value.to_bytes(18, "little")[:size]
    head = struct.pack("<H", address)
    if code in (dxl.SYNC_READ, dxl.FAST_SYNC_READ):
        body = head + struct.pack("<H", size) + bytes((1, 2, rng.choice((1, 3))))
    elif code == dxl.SYNC_WRITE:
        body = head + struct.pack("<H", size) + b"\x01" + data + b"\x02" + data
    elif code in (dxl.BULK_READ, dxl.FAST_BULK_READ):
        body = b"\x01" + head + struct.pack("<H", size) + b"\x02" + head + b"\x01\x00"
    elif code == dxl.BULK_WRITE:
        body = b"\x01" + head + struct.pack("<H", size) + data + b"\x02" + head + b"\x01\x00\x01"
    elif code == dxl.READ:
        body = head + struct.pack("<H", size)
    else:
        body = {dxl.FACTORY_RESET: b"\x01", dxl.CLEAR: b'\x01DXL"'}.get(code, head + data)
    return dxl.packet(rng.choice((1, 1, 1, 2, dxl.BROADCAST)), bytes([code]) + body)


def _read_dynamixel(data: bytes) -> object:
    return _read_status(data) if data[0] & 1 else _read_instructions(data)


@cache
def _bus_error() -> type[Exception]:
    from tacgrasp.drivers.dynamixel.errors import BusError

    return BusError


def _read_status(data: bytes) -> object:
    """One transaction of the driver, with the SDK, on a port that holds these bytes."""
    from dynamixel_sdk import Protocol2PacketHandler

    from tacgrasp.drivers.dynamixel.bus import Bus
    from tacgrasp.drivers.dynamixel.settings import DynamixelSettings, ServoSettings

    bus = Bus(
        DynamixelSettings(
            port="fuzz", unit="fuzz", model="XC330-T288", open_width_mm=110, max_current_ma=900,
            servos=(ServoSettings(id=1, open_ticks=2496, closed_ticks=1600),),
        )
    )  # fmt: skip
    bus._port, bus._sdk = _RecordedPort(data[1:]), Protocol2PacketHandler()
    code, body, length = ((1, b"", 3), (2, b"\x7a\x00\x19\x00", 25), (3, b"\x40\x00\x01", 0))[
        (data[0] >> 1) % 3
    ]
    try:
        return bus._transact(1, code, body, length)
    except _bus_error():
        return None


def _read_instructions(data: bytes) -> object:
    """Servos, fingers and a load under a stream of instructions, in emulated time."""
    side, linkage = data[0], Linkage()
    model = list(MODELS.values())[(side >> 1) % len(MODELS)]
    servos = [
        EmulatedServo(model, i, baud=BAUD, mode=(5, 3)[side >> 4 & 1], friction_ma=12.0)
        for i in (1, 2)
    ]
    fingers = Fingers(servos, linkage, SpringLoad(width_m=0.08), threading.RLock())
    now = [fingers._now_s]
    bus = ServoBus(servos, lambda _: False, fingers.on_written, lambda: now[0])
    reader, answers = dxl.PacketReader(), 0
    try:
        for piece in pieces(data[1:], max(1 + side, len(data) // MOST_PIECES)):
            for instruction in reader.feed(piece):
                answers += sum(map(len, bus.execute(instruction, BAUD)))
            now[0] += 0.01
            fingers.step(now[0])
            for servo in servos:
                servo.check_watchdog(now[0])
        for servo in servos:
            servo.publish()
        return answers, fingers.width_m, fingers.force_n
    finally:
        fingers.close()


# UR


def _rtde_case(rng: Random) -> bytes:
    outputs = rng.sample(sorted(rtde.OUTPUT_TYPES), rng.randrange(1, 6))
    if rng.random() < 0.3:
        outputs.append("actual_q")
    inputs = [f"input_int_register_{i}" for i in range(8)]
    inputs += [f"input_double_register_{i}" for i in range(18)]
    command = "input_int_register_0"
    stream = [
        rtde.packet(rtde.VERSION, struct.pack(">H", rng.choice((2, 2, 2, 1, 0, 65535)))),
        rtde.packet(rtde.CONTROLLER_VERSION),
        rtde.packet(rtde.OUTPUTS, struct.pack(">d", _number(rng)) + ",".join(outputs).encode()),
        rtde.packet(rtde.INPUTS, ",".join(inputs).encode()),
        rtde.packet(rtde.INPUTS, f"{command},no_such"[: rng.choice((20, 99))].encode()),
        rtde.packet(rtde.START),
        rtde.packet(rng.choice((rtde.PAUSE, rtde.START, rtde.MESSAGE, 7, 255)), b"x"),
    ]
    commands = (0, 3, 6, 7, 8, 9, 10, 11, 15, 16, 17, 24, 28, 29, 31, 33, 34, 35, 40, 47, 255, 99)
    for _ in range(rng.randrange(4)):
        ints = [rng.choice(commands), rng.choice((0, 1, -1)), *([1] * 6)]
        doubles = [_number(rng) for _ in range(18)]
        stream.append(rtde.packet(rtde.DATA, b"\x01" + struct.pack(">8i18d", *ints, *doubles)))
        if rng.random() < 0.5:
            stream.append(rtde.packet(rtde.DATA, b"\x01" + struct.pack(">8i18d", *([0] * 26))))
    return bytes([rng.randrange(256)]) + mutated(rng, stream)


def _number(rng: Random) -> float:
    if rng.random() < 0.7:
        return rng.uniform(-0.6, 0.6)
    return rng.choice((*_NUMBERS, struct.unpack(">d", rng.randbytes(8))[0]))


@cache
def _start() -> NDArray[np.float64]:
    """TCP of a posture that is known, so that a case does not begin with solving it."""
    tcp = base_from_flange(READY_Q) @ as_frame(np.array(TCP_OFFSET))
    return np.concatenate([tcp[:3, 3], rotvec(tcp[:3, :3])])


def _serve(data: bytes, session_of: Callable[[Controller], Session]) -> object:
    """A connection's bytes, while the emulated controller goes on and streams."""
    now = [100.0]
    controller = Controller(_start(), np.array(TCP_OFFSET), None, lambda: now[0])
    if data[0] & 1:
        controller.start_program()
    session, answers = session_of(controller), 0
    for piece in pieces(data[1:], 16 + 8 * data[0]):
        answers += len(session.receive(piece))
        now[0] += 0.02
        controller.advance()
        if isinstance(session, RtdeSession) and session.streaming:
            answers += len(session.data())
    session.close()
    now[0] += 1.0
    controller.advance()
    pose = controller.robot.tcp_pose()
    if not np.isfinite([*pose, *controller.values("actual_q")]).all():
        raise ArithmeticError(f"the arm is nowhere: {pose}")
    return answers


def _read_rtde(data: bytes) -> object:
    return _serve(data, lambda controller: RtdeSession(controller, VERSION, {}))


def _text_case(lines: Sequence[bytes]) -> Callable[[Random], bytes]:
    def make(rng: Random) -> bytes:
        chosen = [rng.choice(lines) for _ in range(rng.randrange(1, 8))]
        return bytes([rng.randrange(256)]) + mutated(rng, chosen)

    return make


_SCRIPTS = (
    b"def f():\n  movel(p[0.4,0,0.2,0,3.1,0], a=0.5, v=0.1)\nend\n",
    b"def rtde_control():\n" + b"  x = 1\n" * 40 + b"end\n",
    b"sec g():\n  set_digital_out(0, True)\nend\n",
    b"stopl(2.0)\n", b"stopj(a=1e3)\n", b"stopl(1.2.3)\n", b"stopl(1e999)\n", b"stopl(-1)\n",
    b"  \t\r\n\n", b"popup(\"\xff\xfe\")\n", b"def f(): end\n", b"end\n",
)  # fmt: skip
_LINES = (
    b"PolyscopeVersion\n", b"get serial number\n", b"is in remote control\n", b"robotmode\n",
    b"safetystatus\n", b"running\n", b"programState\n", b"stop\n", b"play\n", b"pause\n",
    b"power off\n", b"power on\n", b"brake release\n", b"unlock protective stop\n", b"quit\n",
    b"load {}\n", b"popup {0}{x}\n", b"addToLog \xff\n", b"\n", b"load installation a\n",
)  # fmt: skip

TARGETS: tuple[FuzzTarget, ...] = (
    FuzzTarget(name="taxels", make_case=_taxel_case, read=_read_taxels, documented=(TouchError,)),
    FuzzTarget(name="dynamixel", make_case=_dynamixel_case, read=_read_dynamixel, documented=()),
    FuzzTarget(name="rtde", make_case=_rtde_case, read=_read_rtde, documented=(StreamLostError,)),
    FuzzTarget(
        name="urscript",
        make_case=_text_case(_SCRIPTS),
        read=lambda data: _serve(data, ScriptSession),
        documented=(StreamLostError,),
    ),
    FuzzTarget(
        name="dashboard",
        make_case=_text_case(_LINES),
        read=lambda data: _serve(data, lambda machine: DashboardSession(machine, VERSION)),
        documented=(StreamLostError,),
    ),
)
