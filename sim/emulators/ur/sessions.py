"""What one client of an emulated controller says and hears: RTDE, dashboard, script port.

Bytes in, bytes out; sockets and faults of the link are elsewhere (``ur_server``).

Source: Universal Robots' RTDE guide and dashboard server documentation (e-Series); what ur_rtde
1.6.5 asks for.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from typing import Protocol

from sim.emulators.ur import packets as rtde
from sim.emulators.ur.controller import NORMAL, PROTECTIVE, ROBOT_MODES, SAFETY_MODES, Controller

RTDE_PORT, DASHBOARD_PORT, SCRIPT_PORT = 30004, 29999, 30003
LONGEST_TEXT = 1 << 20


class Session(Protocol):
    """One connection."""

    def heard(self, data: bytes) -> bytes:
        """Take what the client sent; the answer. ``ValueError``: hang up."""
        ...

    def closed(self) -> None:
        """The connection is gone."""
        ...


class RtdeSession:
    """RTDE protocol version 2.

    Attributes:
        period_s: Time between data packets that the client asked for [s].
        streaming: Data packets are wanted.
    """

    def __init__(
        self, controller: Controller, version: tuple[int, int], taken: dict[str, RtdeSession]
    ) -> None:
        """``taken``: input variables in use, shared by all sessions of a controller."""
        self._controller, self._version, self._taken = controller, version, taken
        self._buffer = bytearray()
        self._recipes: list[tuple[list[str], struct.Struct, list[int]]] = []
        self._outputs: list[tuple[str, int]] = []
        self._layout = struct.Struct(">")
        self.period_s = 0.002
        self.streaming = False

    def heard(self, data: bytes) -> bytes:
        """Answers to all whole packets."""
        self._buffer += data
        return b"".join(self._answer(kind, body) for kind, body in rtde.split(self._buffer))

    def closed(self) -> None:
        """Free the inputs that it had."""
        for name in [name for name, owner in self._taken.items() if owner is self]:
            del self._taken[name]

    def data(self) -> bytes:
        """One data packet with what is true now."""
        values: list[float] = []
        for name, count in self._outputs:
            now = self._controller.values(name)
            values += now if len(now) == count else [0] * count
        return rtde.packet(rtde.DATA, b"\x01" + self._layout.pack(*values))

    def _answer(self, kind: int, body: bytes) -> bytes:
        if kind == rtde.VERSION:
            (asked,) = struct.unpack(">H", body)
            return rtde.packet(kind, bytes([asked == 2]))
        if kind == rtde.CONTROLLER_VERSION:
            return rtde.packet(kind, struct.pack(">4I", *self._version, 0, 0))
        if kind == rtde.OUTPUTS:
            return rtde.packet(kind, self._set_outputs(body))
        if kind == rtde.INPUTS:
            return rtde.packet(kind, self._set_inputs(body))
        if kind == rtde.DATA:
            self._write(body)
            return b""
        if kind in (rtde.START, rtde.PAUSE):
            self.streaming = kind == rtde.START and bool(self._outputs)
            return rtde.packet(kind, b"\x01")
        return b""

    def _set_outputs(self, body: bytes) -> bytes:
        (rate_hz,) = struct.unpack_from(">d", body)
        if 1.0 <= rate_hz <= 500.0:
            self.period_s = 1.0 / rate_hz
        names = rtde.names_in(body[8:])
        types = rtde.types_of(names, rtde.OUTPUT_TYPES)
        if "NOT_FOUND" not in types:
            self._layout = rtde.layout(types)
            sizes = [len(rtde.layout([kind]).unpack(bytes(rtde.layout([kind]).size)))
                     for kind in types]  # fmt: skip
            self._outputs = list(zip(names, sizes, strict=True))
        return b"\x01" + ",".join(types).encode()

    def _set_inputs(self, body: bytes) -> bytes:
        names = rtde.names_in(body)
        types = rtde.types_of(names, rtde.INPUT_TYPES)
        for i, name in enumerate(names):
            if self._taken.get(name, self) is not self:
                types[i] = "IN_USE"
        if "IN_USE" in types or "NOT_FOUND" in types:
            return b"\x00" + ",".join(types).encode()
        for name in names:
            self._taken[name] = self
        sizes = [len(rtde.layout([kind]).unpack(bytes(rtde.layout([kind]).size))) for kind in types]
        self._recipes.append((names, rtde.layout(types), sizes))
        return bytes([len(self._recipes)]) + ",".join(types).encode()

    def _write(self, body: bytes) -> None:
        if not body or not 1 <= body[0] <= len(self._recipes):
            return
        names, layout, sizes = self._recipes[body[0] - 1]
        if len(body) - 1 != layout.size:
            raise ValueError(f"a data packet of {len(body) - 1} bytes where {layout.size} belong")
        values = list(layout.unpack_from(body, 1))
        for name, size in zip(names, sizes, strict=True):
            if size == 1:
                self._controller.inputs[name] = values[0]
            del values[:size]
        self._controller.written("input_int_register_0" in names)


class ScriptSession:
    """Port 30003: a program (``def ... end``), or a one-line script. Its data stream is left out.

    As on a real controller, whatever comes replaces the program that runs.
    """

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._text = b""

    def heard(self, data: bytes) -> bytes:
        """Take lines; a program starts when its ``end`` at the margin has come."""
        self._text += data
        if len(self._text) > LONGEST_TEXT:
            raise ValueError("a script without an end")
        while True:
            head = self._text.lstrip()
            if head.startswith(b"def "):
                end = re.search(rb"\nend[ \t\r]*\n", head)
                if end is None:
                    return b""
                self._text = head[end.end() :]
                self._controller.start_program()
            elif b"\n" in head:
                line, _, self._text = head.partition(b"\n")
                self._line(line.decode("utf-8", "replace").strip())
            else:
                return b""

    def _line(self, line: str) -> None:
        if not self._controller.remote:
            return
        stop = re.fullmatch(r"stop[lj]\(\s*(?:a\s*=\s*)?([0-9.]+)\s*\)", line)
        if stop is not None and float(stop[1]) > 0:
            self._controller.stop_line(float(stop[1]))
        elif line:
            self._controller.stop_program(f"replaced by {line[:40]!r}")

    def closed(self) -> None:
        """Nothing is kept of it."""


class DashboardSession:
    """Port 29999: a line, an answer."""

    GREETING = b"Connected: Universal Robots Dashboard Server\n"

    def __init__(self, controller: Controller, version: tuple[int, int]) -> None:
        self._controller, self._version = controller, version
        self._text = b""
        self._answers: dict[str, Callable[[], str]] = {
            "polyscopeversion": self._polyscope,
            "get serial number": lambda: "20210000001",
            "get robot model": lambda: "UR5",
            "is in remote control": lambda: str(controller.remote).lower(),
            "robotmode": lambda: f"Robotmode: {ROBOT_MODES[controller.robot_mode]}",
            "safetystatus": lambda: f"Safetystatus: {SAFETY_MODES[controller.safety_mode]}",
            "safetymode": lambda: f"Safetymode: {SAFETY_MODES[controller.safety_mode]}",
            "running": lambda: f"Program running: {str(controller.program is not None).lower()}",
            "programstate": self._program_state,
            "stop": self._stop,
            "unlock protective stop": self._unlock,
            "close safety popup": lambda: "closing safety popup",
            "close popup": lambda: "closing popup",
        }

    def heard(self, data: bytes) -> bytes:
        """Answer each line."""
        self._text += data
        *lines, self._text = self._text.split(b"\n")
        if len(self._text) > LONGEST_TEXT:
            raise ValueError("a line without an end")
        return b"".join(self._answer(line.decode("utf-8", "replace").strip()) for line in lines)

    def closed(self) -> None:
        """Nothing is kept of it."""

    def _answer(self, line: str) -> bytes:
        answer = self._answers.get(line.lower())
        said = answer() if answer is not None else f'could not understand: "{line}"'
        return said.encode() + b"\n"

    def _polyscope(self) -> str:
        major, minor = self._version
        return f"URSoftware {major}.{minor}.0.1100000 (Jan 01 2024)"

    def _program_state(self) -> str:
        return "PLAYING rtde_control" if self._controller.program is not None else "STOPPED <none>"

    def _stop(self) -> str:
        if not self._controller.remote:
            return "Failed to execute: stop"
        self._controller.stop_program("dashboard: stop")
        return "Stopped"

    def _unlock(self) -> str:
        if self._controller.safety_mode not in (NORMAL, PROTECTIVE):
            return "Cannot unlock: this is no protective stop"
        self._controller.unlock()
        return "Protective stop releasing"
