"""A second UR controller, written from the protocol documents: RTDE 2, dashboard, script port.

It shares no code with ``sim.emulators``: asyncio protocols, a table of variables, one of commands,
motions integrated in steps (``ur_cell``). The uploaded script is not run; its registers are
answered as it would.

Left out: protocol version 1, joints, rotation (the orientation of a target is taken at once),
acknowledged synchronous moves other than stops, force mode, servoing, pausing, several programs,
clients that do not read. ``python -m tests.fakes.peers.ur_peer HOST`` runs it until its standard
input closes; a line there is a fault, and every line is answered with the state as JSON.

Source: Universal Robots, 'RTDE Guide' and 'Dashboard Server e-Series'; ur_rtde's use of registers.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import os
import struct
import subprocess
import sys
from collections.abc import Callable
from typing import Any, ClassVar

from tests.fakes.peers.ur_cell import Cell
from tests.paths import ROOT

PORTS = {"dashboard": 29999, "script": 30003, "rtde": 30004}
TICK_S = 0.002

_SHAPES = {"DOUBLE": "d", "UINT32": "I", "INT32": "i", "VECTOR6D": "6d", "VECTOR3D": "3d"}


class RtdeProtocol(asyncio.Protocol):
    """One RTDE client."""

    def __init__(self, cell: Cell) -> None:
        self.cell, self.unread = cell, b""
        self.recipes: dict[int, list[str]] = {}
        self.streamed: list[str] = []
        self.period_s, self.due_s = 0.008, math.inf
        self.transport: Any = None

    def connection_made(self, transport: Any) -> None:
        self.transport = transport
        CLIENTS.add(self)

    def connection_lost(self, exc: Exception | None) -> None:
        CLIENTS.discard(self)
        for name in [n for n, owner in self.cell.owner.items() if owner is self]:
            del self.cell.owner[name]

    def data_received(self, data: bytes) -> None:
        self.unread += data
        while len(self.unread) >= 3:
            size = int.from_bytes(self.unread[:2], "big")
            if size < 3:
                self.transport.abort()
                return
            if len(self.unread) < size:
                return
            kind, body = self.unread[2:3], self.unread[3:size]
            self.unread = self.unread[size:]
            answer = self._ANSWERS.get(kind)
            payload = None if answer is None else answer(self, body)
            if payload is not None:
                self._say(kind, payload)

    def _say(self, kind: bytes, payload: bytes) -> None:
        if not self.cell.frozen:
            self.transport.write(struct.pack(">H", 3 + len(payload)) + kind + payload)

    def _version(self, body: bytes) -> bytes:
        return b"\x01" if body == b"\x00\x02" else b"\x00"

    def _controller_version(self, body: bytes) -> bytes:
        return struct.pack(">IIII", 5, 12, 0, 0)

    def _outputs(self, body: bytes) -> bytes:
        (rate_hz,) = struct.unpack(">d", body[:8])
        known = self.cell.variables()
        names = [name for name in body[8:].decode().split(",") if name]
        types = [known[name][0] if name in known else "NOT_FOUND" for name in names]
        if "NOT_FOUND" not in types:
            self.streamed, self.period_s = names, 1.0 / rate_hz
        return b"\x01" + ",".join(types).encode()

    def _inputs(self, body: bytes) -> bytes:
        names = [name for name in body.decode().split(",") if name]
        types = []
        for name in names:
            side, kind, _, number = [*name.split("_"), "", "", "", ""][:4]
            known = side == "input" and kind in ("int", "double") and number.isdigit()
            is_free = self.cell.owner.get(name, self) is self
            kind_name = {"int": "INT32", "double": "DOUBLE"}.get(kind, "")
            if name == "external_force_torque":
                known, kind_name = True, "VECTOR6D"
            types.append((kind_name if is_free else "IN_USE") if known else "NOT_FOUND")
        if {"IN_USE", "NOT_FOUND"} & set(types):
            return b"\x00" + ",".join(types).encode()
        self.cell.owner.update(dict.fromkeys(names, self))
        self.recipes[len(self.recipes) + 1] = names
        return bytes([len(self.recipes)]) + ",".join(types).encode()

    def _start(self, body: bytes) -> bytes:
        self.due_s = self.cell.now_s if self.streamed else math.inf
        return b"\x01" if self.streamed else b"\x00"

    def _pause(self, body: bytes) -> bytes:
        self.due_s = math.inf
        return b"\x01"

    def _data(self, body: bytes) -> None:
        names, at = self.recipes.get(body[0], []), 1
        for name in names:
            shape = "i" if "_int_" in name else "6d" if name.startswith("external") else "d"
            values = struct.unpack_from(">" + shape, body, at)
            at += struct.calcsize(">" + shape)
            if shape != "6d":
                registers = self.cell.ints if shape == "i" else self.cell.doubles
                registers[int(name.rsplit("_", 1)[1])] = values[0]
        self.cell.inputs_written(names)

    def stream(self) -> None:
        if self.cell.now_s < self.due_s:
            return
        self.due_s = max(self.due_s + self.period_s, self.cell.now_s)
        known, payload = self.cell.variables(), b"\x01"
        for name in self.streamed:
            kind, value = known[name]
            number = value()
            numbers = number if isinstance(number, list) else [number]
            payload += struct.pack(">" + _SHAPES[kind], *numbers)
        self._say(b"U", payload)

    _ANSWERS: ClassVar[dict[bytes, Callable[[RtdeProtocol, bytes], bytes | None]]] = {
        b"V": _version, b"v": _controller_version, b"O": _outputs, b"I": _inputs, b"S": _start,
        b"P": _pause, b"U": _data,
    }  # fmt: skip


CLIENTS: set[RtdeProtocol] = set()


class DashboardProtocol(asyncio.Protocol):
    """One dashboard client; a line gets a line."""

    def __init__(self, cell: Cell) -> None:
        self.cell, self.unread = cell, ""

    def connection_made(self, transport: Any) -> None:
        self.transport = transport
        transport.write(b"Connected: Universal Robots Dashboard Server\n")

    def data_received(self, data: bytes) -> None:
        *lines, self.unread = (self.unread + data.decode(errors="replace")).split("\n")
        for line in lines:
            self.transport.write(self._answer(line.strip()).encode() + b"\n")

    def _answer(self, line: str) -> str:
        cell = self.cell
        if line == "stop":
            cell.end_program()
        if line == "unlock protective stop":
            cell.end_program()
            cell.safety = "NORMAL"
        return {
            "PolyscopeVersion": "URSoftware 5.12.4.1101661 (Sep 07 2022)",
            "get serial number": "20225500001",
            "is in remote control": "true",
            "robotmode": "Robotmode: RUNNING",
            "safetystatus": f"Safetystatus: {cell.safety}",
            "running": f"Program running: {str(cell.playing).lower()}",
            "stop": "Stopped",
            "unlock protective stop": "Protective stop releasing",
        }.get(line, f'could not understand: "{line}"')


class ScriptProtocol(asyncio.Protocol):
    """One client of the script port: an uploaded program counts when its last line is there."""

    def __init__(self, cell: Cell) -> None:
        self.cell, self.text = cell, ""

    def data_received(self, data: bytes) -> None:
        self.text += data.decode(errors="replace")
        lines = self.text.split("\n")
        if lines[0].startswith("def "):
            if "end" in [line.rstrip() for line in lines[1:-1]]:
                self.text = ""
                self.cell.start_program()
        elif len(lines) > 1:
            self.text = ""
            self.cell.end_program()


def _apply(cell: Cell, fault: str) -> None:
    name, _, number = fault.partition(" ")
    if name == "protective":
        cell.protective_stop()
    elif name == "end":
        cell.end_program()
    elif name == "freeze":
        cell.frozen = True
    elif name == "force":
        cell.force = [0.0, 0.0, float(number), 0.0, 0.0, 0.0]
    elif name == "drop":
        for client in list(CLIENTS):
            client.transport.abort()


def _tell(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


async def _run(host: str) -> None:
    with contextlib.suppress(OSError):  # a controller does not wait for other work
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(5))
    loop, cell = asyncio.get_running_loop(), Cell()
    protocols: dict[str, Callable[[], asyncio.Protocol]] = {
        "dashboard": lambda: DashboardProtocol(cell),
        "script": lambda: ScriptProtocol(cell),
        "rtde": lambda: RtdeProtocol(cell),
    }
    for name, factory in protocols.items():
        await loop.create_server(factory, host, PORTS[name])
    faults: asyncio.Queue[bytes] = asyncio.Queue()
    reader = asyncio.StreamReader()
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), sys.stdin)

    async def listen() -> None:
        while line := await reader.readline():
            await faults.put(line)
        await faults.put(b"")

    listening = asyncio.create_task(listen())
    _tell("ready")
    due_s = loop.time()
    while True:
        due_s = max(due_s + TICK_S, loop.time() - 0.02)
        await asyncio.sleep(max(0.0, due_s - loop.time()))
        cell.tick(TICK_S)
        for client in list(CLIENTS):
            client.stream()
        if not faults.empty():
            line = faults.get_nowait()
            if not line:
                break
            _apply(cell, line.decode().strip())
            state = {"playing": cell.playing, "pose": cell.pose, "speed": cell.speed(),
                     "payload": cell.payload, "scripts": cell.num_scripts}  # fmt: skip
            _tell(json.dumps(state))
    listening.cancel()


class UrPeer:
    """A running peer; ``state`` asks for its true state, after a fault if one is named."""

    def __init__(self, host: str) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-m", "tests.fakes.peers.ur_peer", host],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self._line()

    def state(self, fault: str = "") -> dict[str, Any]:
        stdin = self._process.stdin
        if stdin is None:
            raise RuntimeError("the peer has no input")
        stdin.write(fault + "\n")
        stdin.flush()
        state: dict[str, Any] = json.loads(self._line())
        return state

    def _line(self) -> str:
        line = "" if self._process.stdout is None else self._process.stdout.readline()
        if not line:
            raise RuntimeError(f"the peer has ended with {self._process.wait(5)}")
        return line

    def close(self) -> None:
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()
        try:
            self._process.wait(5)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait(5)


if __name__ == "__main__":
    asyncio.run(_run(sys.argv[1]))
