"""A UR controller's dashboard and RTDE ports in plain Python, every wait bounded.

Used before the library is loaded, and to stop an arm that the library has lost. The library holds
the interpreter while it connects: a controller that accepts a connection and stays silent would
freeze this process.

Source: Universal Robots' dashboard server documentation and RTDE guide, protocol version 2.
"""

from __future__ import annotations

import math
import socket
import struct
from collections.abc import Sequence
from contextlib import closing, suppress
from itertools import islice

from primitives.errors import RobotError

DASHBOARD_PORT, SCRIPT_PORT, RTDE_PORT = 29999, 30003, 30004
TIMEOUT_S, URGENT_S = 0.4, 0.15
"""Longest wait for an answer: in a check, and for a stop from outside [s]."""

GREETING = "Universal Robots Dashboard Server"

INPUTS = (
    *(f"input_int_register_{i}" for i in range(8)),
    *(f"input_double_register_{i}" for i in range(18)),
)
"""Registers claimed by the control library."""

CONFIRMED = "dashboard stop"
"""Result of ``stop_from_outside`` after a confirmed stop."""

_LENGTHS = {"DOUBLE": "d", "INT32": "i", "UINT32": "I", "VECTOR3D": "3d", "VECTOR6D": "6d"}


class _Connection:
    """A TCP connection with a time-out for every wait."""

    def __init__(self, host: str, port: int, name: str, timeout_s: float) -> None:
        self._name, self._address = name, f"{host}:{port}"
        try:
            self._socket = socket.create_connection((host, port), timeout=timeout_s)
        except (OSError, UnicodeError) as error:  # UnicodeError: not a possible host name
            raise RobotError(
                f"no {name} at {self._address}: {error}; check that the controller is on, the "
                "cable in, and the address right"
            ) from None
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket.settimeout(timeout_s)

    def send(self, data: bytes) -> None:
        try:
            self._socket.sendall(data)
        except OSError as error:
            raise RobotError(f"the {self._name} at {self._address} is lost: {error}") from None

    def receive(self) -> bytes:
        try:
            data = self._socket.recv(65536)
        except OSError as error:
            wait_s = self._socket.gettimeout()
            silent = isinstance(error, TimeoutError)
            problem = f"said nothing for {wait_s} s" if silent else f"{error}"
            raise RobotError(
                f"the {self._name} at {self._address} {problem}; restart the controller"
            ) from None
        if not data:
            raise RobotError(
                f"the {self._name} at {self._address} hung up; check the address, or restart the "
                "controller"
            )
        return data

    def close(self) -> None:
        with suppress(OSError):
            self._socket.shutdown(socket.SHUT_WR)
        self._socket.close()


class Dashboard:
    """A client of the dashboard server, which answers each line with a line.

    Raises ``RobotError`` for a missing or wrong answer, and for a lost connection.
    """

    def __init__(self, host: str, timeout_s: float = TIMEOUT_S) -> None:
        self._connection = _Connection(host, DASHBOARD_PORT, "UR dashboard", timeout_s)
        self._text = b""
        try:
            greeting = self._read()
            if GREETING not in greeting:
                raise RobotError(
                    f"{host}:{DASHBOARD_PORT} is no UR dashboard: expected a line with "
                    f"{GREETING!r}, got {greeting[:60]!r}. Check the address"
                )
        except RobotError:
            self.close()
            raise

    def ask(self, line: str) -> str:
        self._connection.send(line.encode() + b"\n")
        return self._read()

    def stops_program(self) -> bool:
        """End the program; returns whether the controller confirms it."""
        return self.ask("stop").lower().startswith("stopped")

    def close(self) -> None:
        self._connection.close()

    def _read(self) -> str:
        while b"\n" not in self._text:
            if len(self._text) > 4096:
                raise RobotError("the UR dashboard sent 4096 bytes without an end of line")
            self._text += self._connection.receive()
        line, _, self._text = self._text.partition(b"\n")
        return line.decode("utf-8", "replace").strip()


class Rtde:
    """A client of the RTDE port.

    Every method raises ``RobotError`` for a missing or malformed answer.
    """

    def __init__(self, host: str) -> None:
        self._connection = _Connection(host, RTDE_PORT, "UR RTDE port", TIMEOUT_S)
        self._buffer = bytearray()
        self._layout = struct.Struct(">")
        self._sizes: dict[str, int] = {}
        try:
            if self._ask("V", struct.pack(">H", 2)) != b"\x01":
                raise RobotError("the controller does not speak version 2 of RTDE; update it")
        except RobotError:
            self.close()
            raise

    def version(self) -> tuple[int, int]:
        """Major and minor version of the controller."""
        answer = self._ask("v", b"")
        if len(answer) != 16:
            raise RobotError(f"the controller stated its version in {len(answer)} bytes, not 16")
        major, minor, _, _ = struct.unpack(">4I", answer)
        return major, minor

    def inputs_in_use(self) -> list[str]:
        """Those of ``INPUTS`` in use by another client; the free ones are ours until ``close``."""
        types = self._ask_types("I", ",".join(INPUTS).encode())
        return [name for name, kind in zip(INPUTS, types, strict=False) if kind == "IN_USE"]

    def subscribe(self, names: Sequence[str], rate_hz: float) -> list[str]:
        """Request a stream of variables; returns those that the controller does not have."""
        request = struct.pack(">d", rate_hz) + ",".join(names).encode()
        types = self._ask_types("O", request)
        available = [(n, t) for n, t in zip(names, types, strict=False) if t != "NOT_FOUND"]
        if len(types) != len(names) or any(kind not in _LENGTHS for _, kind in available):
            raise RobotError(f"the controller answered {len(names)} variables with {types}")
        self._layout = struct.Struct(">" + "".join(_LENGTHS[kind] for _, kind in available))
        self._sizes = {name: int(_LENGTHS[kind][:-1] or 1) for name, kind in available}
        return [name for name in names if name not in self._sizes]

    def start(self) -> None:
        if self._ask("S", b"") != b"\x01":
            raise RobotError("the controller does not start its RTDE stream")

    def sample(self) -> dict[str, tuple[float, ...]]:
        """Wait for the next sample: the numbers of each variable."""
        body = self._next("U")[1:]
        if len(body) != self._layout.size:
            raise RobotError(f"an RTDE sample of {len(body)} bytes, expected {self._layout.size}")
        values = self._layout.unpack(body)
        if not all(map(math.isfinite, values)):
            raise RobotError(
                "the controller sends a number that is not finite: a sensor or its cable is "
                "damaged; see the controller's log, and restart it"
            )
        numbers = iter(values)
        return {name: tuple(islice(numbers, size)) for name, size in self._sizes.items()}

    def close(self) -> None:
        self._connection.close()

    def _ask_types(self, kind: str, body: bytes) -> list[str]:
        return self._ask(kind, body)[1:].decode("ascii", "replace").split(",")

    def _ask(self, kind: str, body: bytes) -> bytes:
        self._connection.send(struct.pack(">HB", 3 + len(body), ord(kind)) + body)
        return self._next(kind)

    def _next(self, kind: str) -> bytes:
        for _ in range(50):  # packets of other kinds are messages or late data
            packet_kind, body = self._packet()
            if packet_kind == ord(kind):
                return body
        raise RobotError(f"the controller did not answer a packet {kind!r} of RTDE")

    def _packet(self) -> tuple[int, bytes]:
        while True:
            if len(self._buffer) >= 3:
                size, kind = struct.unpack_from(">HB", self._buffer)
                if not 3 <= size <= 4096:
                    raise RobotError(
                        f"what answers on the RTDE port does not speak RTDE (a packet of {size} "
                        "bytes); check the address"
                    )
                if len(self._buffer) >= size:
                    body = bytes(self._buffer[3:size])
                    del self._buffer[:size]
                    return kind, body
            self._buffer += self._connection.receive()


def stop_from_outside(
    host: str, deceleration_m_s2: float, *, dashboard: Dashboard | None = None
) -> str:
    """End the program on the controller without the library. Never raises.

    Tries the open dashboard connection, then a new one, then a one-line script, which replaces the
    program and brakes. Only the dashboard confirms (``CONFIRMED``); a script has no confirmation.

    Returns:
        The method that was used; empty if none worked.
    """
    with suppress(RobotError, OSError):
        if dashboard is not None and dashboard.stops_program():
            return CONFIRMED
    with suppress(RobotError, OSError), closing(Dashboard(host, URGENT_S)) as fresh:
        if fresh.stops_program():
            return CONFIRMED
    with suppress(RobotError, OSError):
        connection = _Connection(host, SCRIPT_PORT, "UR script port", URGENT_S)
        connection.send(f"stopl({deceleration_m_s2:g})\n".encode())
        connection.close()
        return "stopl sent to the script port, unconfirmed"
    return ""
