"""The control channel of an emulator: inject faults, take them back, ask for the truth.

JSON lines over TCP on 127.0.0.1, a request and an answer at a time. It is beside the emulated wire
protocols and no driver knows of it: only tests, benchmarks and records use it.
"""

from __future__ import annotations

import json
import socket
import socketserver
import threading
from collections.abc import Mapping
from typing import Any, Protocol

from primitives.errors import RobotError

Facts = Mapping[str, float | str | bool | None]


class Emulated(Protocol):
    """What each emulator implements. Called from threads of the control channel."""

    def inject(self, fault: str, **details: float | str) -> None:
        """Let a fault happen now; ``ValueError`` lists the names that are known."""
        ...

    def clear(self) -> None:
        """Take all faults away."""
        ...

    def facts(self) -> Facts:
        """What is true now, units in the names; ``injected_ago_ms`` among it."""
        ...


class ControlServer:
    """Answers requests about some emulated devices, each by its name, in threads of its own.

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
        """Answer no more. Idempotent."""
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
            device, what = request["device"], request["do"]
            if device not in self.server.emulated:
                known = ", ".join(self.server.emulated)
                raise ValueError(f"no emulated device {device!r} here; known: {known}")
            emulated = self.server.emulated[device]
            if what == "inject":
                emulated.inject(request["fault"], **request["details"])
            elif what == "clear":
                emulated.clear()
            elif what == "facts":
                return {"facts": dict(emulated.facts())}
            else:
                raise ValueError(f"expected inject, clear or facts, got {what!r}")
        except (ValueError, KeyError, TypeError) as error:
            return {"error": f"{error}"}
        return {}


class ControlClient:
    """Asks an emulator's control channel; every call is bounded in time."""

    def __init__(self, port: int, timeout_s: float = 5.0) -> None:
        """Connect.

        Raises:
            RobotError: Nothing answers at this port.
        """
        self.port = port
        self._lock = threading.Lock()
        try:
            self._socket = socket.create_connection(("127.0.0.1", port), timeout=timeout_s)
        except OSError as error:
            raise RobotError(f"no emulator's control channel at port {port}: {error}") from None
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._answers = self._socket.makefile("rb")

    def inject(self, device: str, fault: str, **details: float | str) -> None:
        """Let a fault of a device happen now.

        Raises:
            ValueError: No such device or fault; the message lists those that are known.
            RobotError: The emulator does not answer.
        """
        self._ask({"do": "inject", "device": device, "fault": fault, "details": details})

    def clear(self, device: str) -> None:
        """Take all faults of a device away. Raises as ``inject``."""
        self._ask({"do": "clear", "device": device})

    def facts(self, device: str) -> dict[str, float | str | bool | None]:
        """What is true of a device now. Raises as ``inject``."""
        facts: dict[str, float | str | bool | None] = self._ask({"do": "facts", "device": device})[
            "facts"
        ]
        return facts

    def close(self) -> None:
        """Hang up. Idempotent."""
        self._answers.close()
        self._socket.close()

    def _ask(self, request: Mapping[str, object]) -> dict[str, Any]:
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
