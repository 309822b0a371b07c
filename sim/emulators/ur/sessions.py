"""Connections of clients to an emulated controller: RTDE, dashboard and script port.

A session turns received bytes into answers. Not here: sockets and faults of the link
(``sim.emulators.ur.server``).

Source: Universal Robots' RTDE guide and dashboard server documentation (e-Series); what ur_rtde
1.6.5 asks for.
"""

from __future__ import annotations

import re
import struct
from abc import ABC, abstractmethod
from collections.abc import Callable

from sim.emulators.ur import packets as rtde
from sim.emulators.ur.controller import NORMAL, PROTECTIVE, ROBOT_MODES, SAFETY_MODES, Controller

RTDE_PORT, DASHBOARD_PORT, SCRIPT_PORT = 30004, 29999, 30003
PORTS = (DASHBOARD_PORT, SCRIPT_PORT, RTDE_PORT)
LONGEST_TEXT = 1 << 20


class Session(ABC):
    """One connection."""

    @abstractmethod
    def receive(self, data: bytes) -> bytes:
        """Take bytes of the client and return the answer; ``ValueError`` ends the connection."""

    def close(self) -> None:  # noqa: B027 - most sessions hold nothing
        """Release what the connection holds."""


class RtdeSession(Session):
    """RTDE protocol version 2.

    Attributes:
        period_s: Requested time between data packets [s].
        streaming: The client has started the data stream.
    """

    def __init__(
        self, controller: Controller, version: tuple[int, int], taken: dict[str, RtdeSession]
    ) -> None:
        """``taken``: owners of the input variables, shared by all sessions of a controller."""
        self._controller, self._version, self._taken = controller, version, taken
        self._buffer = bytearray()
        self._recipes: list[tuple[list[str], struct.Struct, list[int]]] = []
        self._outputs: list[tuple[str, int]] = []
        self._layout = struct.Struct(">")
        self.period_s = 0.002
        self.streaming = False

    def receive(self, data: bytes) -> bytes:
        self._buffer += data
        return b"".join(self._answer(kind, body) for kind, body in rtde.split(self._buffer))

    def close(self) -> None:
        for name in [name for name, owner in self._taken.items() if owner is self]:
            del self._taken[name]

    def data(self) -> bytes:
        values: list[float] = []
        for name, count in self._outputs:
            current = self._controller.values(name)
            values += current if len(current) == count else [0] * count
        return rtde.packet(rtde.DATA, b"\x01" + self._layout.pack(*values))

    def _answer(self, kind: int, body: bytes) -> bytes:
        if kind == rtde.VERSION:
            (version,) = struct.unpack(">H", body)
            return rtde.packet(kind, bytes([version == 2]))
        if kind == rtde.CONTROLLER_VERSION:
            return rtde.packet(kind, struct.pack(">4I", *self._version, 0, 0))
        if kind in (rtde.OUTPUTS, rtde.INPUTS):
            set_recipe = self._set_outputs if kind == rtde.OUTPUTS else self._set_inputs
            return rtde.packet(kind, set_recipe(body))
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
            self._outputs = list(zip(names, map(rtde.num_values, types), strict=True))
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
        sizes = [rtde.num_values(kind) for kind in types]
        self._recipes.append((names, rtde.layout(types), sizes))
        return bytes([len(self._recipes)]) + ",".join(types).encode()

    def _write(self, body: bytes) -> None:
        if not body or not 1 <= body[0] <= len(self._recipes):
            return
        names, layout, sizes = self._recipes[body[0] - 1]
        if len(body) - 1 != layout.size:
            raise ValueError(f"a data packet of {len(body) - 1} bytes, expected {layout.size}")
        values = list(layout.unpack_from(body, 1))
        for name, size in zip(names, sizes, strict=True):
            if size == 1:
                self._controller.inputs[name] = values[0]
            del values[:size]
        self._controller.on_inputs("input_int_register_0" in names)


class ScriptSession(Session):
    """Port 30003: a program (``def ... end``), or a one-line script. It has no data stream.

    As on a real controller, any script replaces the running program.
    """

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._text = b""

    def receive(self, data: bytes) -> bytes:
        """Take lines; a program starts at its ``end`` at the margin."""
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
            self._controller.stop_program("a one-line script replaced it")
            self._controller.robot.halt(float(stop[1]))
        elif line:
            self._controller.stop_program(f"replaced by {line[:40]!r}")


class DashboardSession(Session):
    """Port 29999: one answer per line."""

    GREETING = b"Connected: Universal Robots Dashboard Server\n"

    def __init__(self, controller: Controller, version: tuple[int, int]) -> None:
        self._controller = controller
        self._text = b""
        self._answers: dict[str, Callable[[], str]] = {
            "polyscopeversion": lambda: "URSoftware {}.{}.0.1100000 (Jan 01 2024)".format(*version),
            "get serial number": lambda: "20210000001",
            "get robot model": lambda: "UR5",
            "is in remote control": lambda: str(controller.remote).lower(),
            "robotmode": lambda: f"Robotmode: {ROBOT_MODES[controller.robot_mode]}",
            "safetystatus": lambda: f"Safetystatus: {SAFETY_MODES[controller.safety_mode]}",
            "safetymode": lambda: f"Safetymode: {SAFETY_MODES[controller.safety_mode]}",
            "running": lambda: f"Program running: {str(controller.program is not None).lower()}",
            "programstate": lambda: (
                "STOPPED <none>" if controller.program is None else "PLAYING rtde_control"
            ),
            "stop": self._stop,
            "unlock protective stop": self._unlock,
            "close safety popup": lambda: "closing safety popup",
            "close popup": lambda: "closing popup",
        }

    def receive(self, data: bytes) -> bytes:
        self._text += data
        *lines, self._text = self._text.split(b"\n")
        if len(self._text) > LONGEST_TEXT:
            raise ValueError("a line without an end")
        return b"".join(self._answer(line.decode("utf-8", "replace").strip()) for line in lines)

    def _answer(self, line: str) -> bytes:
        answer = self._answers.get(line.lower(), lambda: f'could not understand: "{line}"')
        return answer().encode() + b"\n"

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
