"""A second Dynamixel servo on a pty, written from ROBOTIS' e-Manual alone.

It shares no code with ``sim.emulators``: a table of registers by name over one memory, a table of
instructions, CRC bit by bit, a motion of constant speed towards an object of fixed width.

Left out: bulk and fast reads, registered writes, reset, clear, modes other than 5, acceleration,
compliant objects, baud rates (any is understood), status return levels.
"""

from __future__ import annotations

import contextlib
import os
import pty
import select
import threading
import time
import tty
from collections.abc import Callable, Iterator
from dataclasses import dataclass

TICKS_PER_UNIT_S = 0.229 * 4096 / 60
READ_ONLY, LOCKED, FREE = "R", "E", "W"


@dataclass(frozen=True, slots=True)
class Field:
    """A register: first address, bytes, access, factory value, lowest and highest value."""

    at: int
    size: int
    access: str
    value: int = 0
    low: int = 0
    high: int = 2**31


FIELDS = {
    "model": Field(0, 2, READ_ONLY, 1220),
    "model information": Field(2, 4, READ_ONLY),
    "firmware": Field(6, 1, READ_ONLY, 47),
    "id": Field(7, 1, LOCKED, 1, 0, 252),
    "baud": Field(8, 1, LOCKED, 3, 0, 6),
    "drive mode": Field(10, 1, LOCKED, 0, 0, 13),
    "mode": Field(11, 1, LOCKED, 5, 0, 16),
    "shadow id": Field(12, 1, LOCKED, 255, 0, 255),
    "protocol": Field(13, 1, LOCKED, 2, 1, 22),
    "max voltage": Field(32, 2, LOCKED, 140, 31, 160),
    "min voltage": Field(34, 2, LOCKED, 55, 31, 160),
    "current limit": Field(38, 2, LOCKED, 910, 0, 910),
    "shutdown": Field(63, 1, LOCKED, 0x35, 0, 255),
    "torque": Field(64, 1, FREE, 0, 0, 1),
    "led": Field(65, 1, FREE, 0, 0, 1),
    "status return": Field(68, 1, FREE, 2, 0, 2),
    "registered": Field(69, 1, READ_ONLY),
    "hardware error": Field(70, 1, READ_ONLY),
    "watchdog": Field(98, 1, FREE, 0, 0, 127),
    "goal pwm": Field(100, 2, FREE, 885, -885, 885),
    "goal current": Field(102, 2, FREE, 910, -910, 910),
    "goal velocity": Field(104, 4, FREE, 0, -2047, 2047),
    "profile acceleration": Field(108, 4, FREE, 0, 0, 32767),
    "profile velocity": Field(112, 4, FREE, 0, 0, 32767),
    "goal position": Field(116, 4, FREE, 0, -1048575, 1048575),
    "tick": Field(120, 2, READ_ONLY),
    "moving": Field(122, 1, READ_ONLY),
    "moving status": Field(123, 1, READ_ONLY),
    "pwm": Field(124, 2, READ_ONLY),
    "current": Field(126, 2, READ_ONLY),
    "velocity": Field(128, 4, READ_ONLY),
    "position": Field(132, 4, READ_ONLY),
    "velocity trajectory": Field(136, 4, READ_ONLY),
    "position trajectory": Field(140, 4, READ_ONLY),
    "voltage": Field(144, 2, READ_ONLY, 111),
    "temperature": Field(146, 1, READ_ONLY, 31),
}
MODES = {0, 1, 3, 4, 5, 16}
GOALS = ("goal pwm", "goal current", "goal velocity", "goal position")
VOLATILE = [name for name, field in FIELDS.items() if field.at >= 64]
_AT = {field.at: name for name, field in FIELDS.items()}


def checksum(data: bytes) -> int:
    """CRC-16 of the e-Manual: polynomial 8005, from 0, highest bit first."""
    total = 0
    for byte in data:
        total ^= byte << 8
        for _ in range(8):
            total = (total << 1 ^ 0x8005 if total & 0x8000 else total << 1) & 0xFFFF
    return total


class ServoPeer:
    """A servo whose thread answers on ``port``; close it at the end.

    Attributes:
        port: Path of the pty.
        object_ticks: Position at which a closing finger meets the object; None without one.
        mute: It hears and does not answer.
        damage: Changes the next answer; None leaves it.
    """

    def __init__(self, position: int = 2496, object_ticks: int | None = 2000) -> None:
        self.object_ticks = object_ticks
        self.mute = False
        self.damage: Callable[[bytes], bytes] | None = None
        self._memory = bytearray(147)
        for name, field in FIELDS.items():
            self[name] = field.value
        self._ticks, self._now_s = float(position), time.monotonic()
        self._heard_s = self._now_s
        self._lock = threading.RLock()
        self._host, self._servo = pty.openpty()
        tty.setraw(self._servo)
        self.port = os.ttyname(self._servo)
        self._end_out, self._end_in = os.pipe()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def __getitem__(self, name: str) -> int:
        field = FIELDS[name]
        raw = self._memory[field.at : field.at + field.size]
        return int.from_bytes(raw, "little", signed=field.size > 1 and name != "model")

    def __setitem__(self, name: str, value: int) -> None:
        field = FIELDS[name]
        raw = (value % (1 << 8 * field.size)).to_bytes(field.size, "little")
        self._memory[field.at : field.at + field.size] = raw

    def restart(self) -> None:
        """Start up anew, as after a dip of the supply: torque off, volatile registers reset."""
        with self._lock:
            for name in VOLATILE:
                self[name] = FIELDS[name].value
            self["goal current"] = self["current limit"]
            self._ticks %= 4096
            self["goal position"] = round(self._ticks)

    def fail(self, bits: int) -> None:
        """Set a hardware error; torque goes off where the shutdown mask says so."""
        with self._lock:
            self["hardware error"] |= bits
            if bits & self["shutdown"]:
                self["torque"] = 0

    def close(self) -> None:
        os.write(self._end_in, b"!")
        self._thread.join(5)
        for descriptor in (self._host, self._servo, self._end_in, self._end_out):
            os.close(descriptor)

    def _run(self) -> None:
        with contextlib.suppress(OSError):  # a servo does not wait for other work
            os.sched_setscheduler(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(5))
        unread = b""
        while True:
            ready, _, _ = select.select([self._host, self._end_out], [], [], 0.005)
            if self._end_out in ready:
                return
            with self._lock:
                self._pass_time()
                if self._host in ready:
                    unread += os.read(self._host, 4096)
                    *packets, unread = _packets(unread)
                    for packet in packets:
                        self._hear(packet)

    def _pass_time(self) -> None:
        now_s = time.monotonic()
        passed_s, self._now_s = now_s - self._now_s, now_s
        watch = self["watchdog"]
        if self["torque"] and 0 < watch < 128 and now_s - self._heard_s > 0.02 * watch:
            self["watchdog"] = 0xFF
        goal = self["goal position"] if self["torque"] else self._ticks
        at_object = self.object_ticks is not None and goal < self.object_ticks <= self._ticks + 0.5
        if at_object and self.object_ticks is not None:
            goal = self.object_ticks
        way = goal - self._ticks
        fastest = (self["profile velocity"] or 300) * TICKS_PER_UNIT_S
        step = max(-fastest * passed_s, min(fastest * passed_s, way))
        self._ticks += step
        moving = abs(way) > abs(step)
        self["moving"] = int(moving)
        self["velocity"] = round((step / passed_s if moving else 0.0) / TICKS_PER_UNIT_S)
        pressing = self["torque"] and at_object and not moving
        self["current"] = -self["goal current"] if pressing else 0
        self["position"] = round(self._ticks)

    def _hear(self, packet: bytes) -> None:
        servo, body, received = packet[4], packet[7:-2], int.from_bytes(packet[-2:], "little")
        if body[0] == 0x55:
            return
        if checksum(packet[:-2]) != received:
            if servo == self["id"]:
                self._say(3)
            return
        self._heard_s = time.monotonic()
        body = body.replace(b"\xff\xff\xfd\xfd", b"\xff\xff\xfd")
        if servo == self["id"]:
            answer = _ANSWERS.get(body[0])
            self._say(*((2, b"") if answer is None else answer(self, body[1:])))
        elif servo == 0xFE:
            for error, data in _broadcast(self, body):
                self._say(error, data)

    def _say(self, error: int, data: bytes = b"") -> None:
        alert = 0x80 if self["hardware error"] else 0
        body = bytes([0x55, error | alert]) + data
        body = body.replace(b"\xff\xff\xfd", b"\xff\xff\xfd\xfd")
        line = b"\xff\xff\xfd\x00" + bytes([self["id"]]) + (len(body) + 2).to_bytes(2, "little")
        line += body
        line += checksum(line).to_bytes(2, "little")
        if self.damage is not None:
            line, self.damage = self.damage(line), None
        if not self.mute and line:
            os.write(self._host, line)

    def read(self, parameters: bytes) -> tuple[int, bytes]:
        if len(parameters) != 4:
            return 5, b""
        at, size = (int.from_bytes(parameters[i : i + 2], "little") for i in (0, 2))
        if size == 0 or at + size > len(self._memory):
            return 7 if size else 5, b""
        return 0, bytes(self._memory[at : at + size])

    def write(self, parameters: bytes) -> tuple[int, bytes]:
        at, data = int.from_bytes(parameters[:2], "little"), parameters[2:]
        if len(parameters) < 3:
            return 5, b""
        values: dict[str, int] = {}
        while data:
            name = _AT.get(at)
            if name is None:
                return 7, b""
            size = FIELDS[name].size
            if len(data) < size:
                return 5, b""
            values[name] = int.from_bytes(data[:size], "little", signed=FIELDS[name].low < 0)
            at, data = at + size, data[size:]
        for name, value in values.items():
            if error := self._refusal(name, value):
                return error, b""
        if values.get("torque") and not self["torque"]:
            values.setdefault("goal position", round(self._ticks))
        for name, value in values.items():
            self[name] = value
        return 0, b""

    def _refusal(self, name: str, value: int) -> int:
        field = FIELDS[name]
        if field.access == READ_ONLY or (field.access == LOCKED and self["torque"]):
            return 7
        if name == "torque" and value == 1 and self["hardware error"] & self["shutdown"]:
            return 7
        if name == "goal current" and abs(value) > self["current limit"]:
            return 6  # the one limit that a register of its own sets
        if not field.low <= value <= field.high:
            return 4
        if name == "mode" and value not in MODES:
            return 4
        tripped = self["watchdog"] == 0xFF
        return 4 if tripped and (name in GOALS or (name == "watchdog" and value)) else 0

    def ping(self, parameters: bytes) -> tuple[int, bytes]:
        return 0, bytes(self._memory[0:2]) + bytes([self["firmware"]])

    def reboot(self, parameters: bytes) -> tuple[int, bytes]:
        self.restart()
        return 0, b""


_ANSWERS: dict[int, Callable[[ServoPeer, bytes], tuple[int, bytes]]] = {
    1: ServoPeer.ping, 2: ServoPeer.read, 3: ServoPeer.write, 8: ServoPeer.reboot,
}  # fmt: skip


def _broadcast(servo: ServoPeer, body: bytes) -> Iterator[tuple[int, bytes]]:
    """Carry out a broadcast; gives the answers of this one servo."""
    code, head, rest = body[0], body[1:5], body[5:]
    size = int.from_bytes(head[2:4], "little")
    if code == 1:
        yield servo.ping(b"")
    elif code == 0x82 and rest[:1] == bytes([servo["id"]]):
        yield servo.read(head)
    elif code == 0x83:
        for start in range(0, len(rest) - size, size + 1):
            if rest[start] == servo["id"]:
                servo.write(head[:2] + rest[start + 1 : start + 1 + size])
    elif code in (3, 8):
        _ANSWERS[code](servo, body[1:])


def _packets(data: bytes) -> Iterator[bytes]:
    """The whole packets in what was received, and at last what is left of it."""
    while True:
        start = data.find(b"\xff\xff\xfd")
        if start < 0:
            break
        data = data[start:]
        size = 7 + int.from_bytes(data[5:7], "little")
        if len(data) < 7 or (10 <= size <= 200 and len(data) < size):
            break
        if data[3] != 0 or not 10 <= size <= 200:
            data = data[3:]
            continue
        yield data[:size]
        data = data[size:]
    yield data[-200:]
