"""The control channel of an emulator: inject faults, clear them, read the true state.

JSON lines over TCP on 127.0.0.1, one request and one answer at a time. The channel is separate
from the emulated wire protocols. No driver uses it, only tests, benchmarks and records.
"""

from __future__ import annotations

import json
import socket
import socketserver
import threading
from collections.abc import Mapping
from typing import Any, Protocol

from primitives.errors import RobotError

_TIMEOUT_S = 5.0

Facts = Mapping[str, float | str | bool | None]


class Emulated(Protocol):
    """An emulated device, as the control channel uses it from threads of its own."""

    def inject(self, fault: str, **details: float | str) -> None:
        """Start a fault now; ``ValueError`` lists the known names."""

    def clear(self) -> None:
        """End all faults."""

    def facts(self) -> Facts:
        """The true state now, units in the names; a device with faults adds ``injected_ago_ms``."""


class ControlServer:
    """Answers requests about emulated devices, each by its name, in threads of its own.

    Attributes:
        port: TCP port on 127.0.0.1.
    """

    def __init__(self, emulated: Mapping[str, Emulated]) -> None:
        server = _Server(("127.0.0.1", 0), _Requests)
        server.emulated = emulated
        self._server = server
        self.port: int = server.server_address[1]
        self._thread = threading.Thread(
            target=server.serve_forever, kwargs={"poll_interval": 0.05}, daemon=True
        )
        self._thread.start()

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()
        self._thread.join(timeout=2)


class _Server(socketserver.ThreadingTCPServer):
    daemon_threads = True
    allow_reuse_address = True
    emulated: Mapping[str, Emulated]


class _Requests(socketserver.StreamRequestHandler):
    server: _Server

    def handle(self) -> None:
        for line in self.rfile:
            self.wfile.write(json.dumps(self._answer(line)).encode() + b"\n")

    def _answer(self, line: bytes) -> dict[str, Any]:
        try:
            request = json.loads(line)
            device, action = request["device"], request["do"]
            if device not in self.server.emulated:
                known = ", ".join(self.server.emulated)
                raise ValueError(f"no emulated device {device!r} here; known: {known}")
            emulated = self.server.emulated[device]
            if action == "inject":
                emulated.inject(request["fault"], **request["details"])
            elif action == "clear":
                emulated.clear()
            elif action == "facts":
                return {"facts": dict(emulated.facts())}
            else:
                raise ValueError(f"expected inject, clear or facts, got {action!r}")
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
            return {"error": f"{error}"}
        return {}


class ControlClient:
    """Client of an emulator's control channel; every call is bounded in time."""

    def __init__(self, port: int) -> None:
        """Connect.

        Raises:
            RobotError: Nothing answers at this port.
        """
        self._lock = threading.Lock()
        try:
            self._socket = socket.create_connection(("127.0.0.1", port), timeout=_TIMEOUT_S)
        except OSError as error:
            raise RobotError(f"no emulator's control channel at port {port}: {error}") from None
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._answers = self._socket.makefile("rb")

    def inject(self, device: str, fault: str, **details: float | str) -> None:
        """Start a fault of a device now.

        Raises:
            ValueError: No such device or fault; the message lists the known ones.
            RobotError: The emulator does not answer.
        """
        self._request({"do": "inject", "device": device, "fault": fault, "details": details})

    def clear(self, device: str) -> None:
        """End all faults of a device. Raises as ``inject``."""
        self._request({"do": "clear", "device": device})

    def facts(self, device: str) -> dict[str, float | str | bool | None]:
        """The true state of a device now. Raises as ``inject``."""
        return dict(self._request({"do": "facts", "device": device})["facts"])

    def close(self) -> None:
        self._answers.close()
        self._socket.close()

    def _request(self, request: Mapping[str, object]) -> dict[str, Any]:
        with self._lock:
            try:
                self._socket.sendall(json.dumps(request).encode() + b"\n")
                line = self._answers.readline()
            except (OSError, ValueError) as error:
                raise RobotError(f"the emulator's control channel failed: {error}") from None
        if not line:
            raise RobotError("the emulator hung up its control channel: its process has ended")
        answer: dict[str, Any] = json.loads(line)
        if "error" in answer:
            raise ValueError(answer["error"])
        return answer
