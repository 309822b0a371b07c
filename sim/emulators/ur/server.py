"""The sockets of an emulated controller: one thread serves all clients and advances the controller.

No client can take it from the others. Each gets a turn of a few kilobytes; a stream that is not
read loses packets (as the RTDE guide says of a controller without time); unread answers and
connections beyond a number end the connection. These limits are our choice. An error of the
emulation itself is logged, and ends only the connection that met it.

It also emulates the faults of the link: a controller that accepts and is silent, garbage for an
answer, a frozen stream, connections that drop. Ports are those of a real controller, so every
emulator has its own loopback address.
"""

from __future__ import annotations

import contextlib
import logging
import selectors
import socket
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeGuard

from sim.emulators.process.lifetime import request_real_time
from sim.emulators.ur.controller import Controller
from sim.emulators.ur.dashboard_session import DashboardSession
from sim.emulators.ur.packets import StreamLostError
from sim.emulators.ur.rtde_session import RtdeSession
from sim.emulators.ur.sessions import (
    DASHBOARD_PORT,
    PORTS,
    RTDE_PORT,
    ScriptSession,
    Session,
)

CYCLE_S = 0.004
"""Cycle while the arm moves [s]; events between two cycles are computed at their exact time."""

IDLE_S = 0.02
GARBAGE = bytes(range(256)) * 2
TURN_BYTES = 4096
"""Most bytes that are taken from a client before it is another one's turn."""

MAX_CLIENTS = 64
MAX_UNSENT = 1 << 20
"""Most bytes of answers that wait for a client to read them."""

_log = logging.getLogger(__name__)


@dataclass(slots=True)
class Link:
    """Faults of the connections.

    Attributes:
        mute: New connections are accepted and never answered.
        garbage: New connections get bytes of no protocol.
        frozen: No packet is sent.
        deaf: No packet is read.
        refused: Ports that do not listen.
    """

    mute: bool = False
    garbage: bool = False
    frozen: bool = False
    deaf: bool = False
    refused: set[int] = field(default_factory=set)


@dataclass(slots=True)
class _Connection:
    socket: socket.socket
    port: int
    session: Session | None
    due_s: float = 0.0
    unsent: bytearray = field(default_factory=bytearray)


class Server:
    """Serves a controller on one loopback address.

    Attributes:
        link: Faults of the connections; change them under ``lock``.
        lock: Guards controller and link against the control channel.
        fastest_hz: Highest rate of a client's stream [Hz].
    """

    def __init__(
        self,
        host: str,
        controller: Controller,
        version: tuple[int, int],
        fastest_hz: float,
    ) -> None:
        """Listen and serve.

        Raises:
            OSError: The ports of this address are taken.
        """
        self.host, self.version, self.fastest_hz = host, version, fastest_hz
        self.link = Link()
        self.lock = threading.RLock()
        self._controller = controller
        self._taken: dict[str, RtdeSession] = {}
        self._selector = selectors.DefaultSelector()
        self._listening: dict[int, socket.socket] = {}
        self._connections: list[_Connection] = []
        self._reopen_s: float | None = None
        self._ended = False
        try:
            self._listen()
        except OSError:
            self._close_all()
            raise
        self._thread = threading.Thread(target=self._serve, name=f"ur {host}", daemon=True)
        self._thread.start()

    def close(self) -> None:
        self._ended = True
        self._thread.join(timeout=2)
        with self.lock:
            self._close_all()

    @property
    def num_clients(self) -> int:
        return len(self._connections)

    def reserve(self, names: Sequence[str], *, taken: bool) -> None:
        if taken:
            other = RtdeSession(self._controller, self.version, self._taken)
            self._taken |= dict.fromkeys(names, other)
        else:
            for name in names:
                self._taken.pop(name, None)

    def drop(self, ports: Sequence[int], reopen_after_s: float | None = None) -> None:
        """Reset all connections to some ports; refuse new ones for a time or until ``restore``."""
        self.link.refused |= set(ports)
        for connection in [c for c in self._connections if c.port in ports]:
            with contextlib.suppress(OSError):  # a reset instead of an orderly end
                connection.socket.setsockopt(
                    socket.SOL_SOCKET, socket.SO_LINGER, b"\x01\x00\x00\x00\x00\x00\x00\x00"
                )
            self._hang_up(connection)
        for port in ports:
            self._unlisten(port)
        self._reopen_s = None if reopen_after_s is None else time.monotonic() + reopen_after_s

    def restore(self) -> None:
        """End all faults of the link, and the connections that were opened under one."""
        for connection in [c for c in self._connections if c.session is None]:
            self._hang_up(connection)
        self.link, self._reopen_s = Link(), None
        self._listen()

    def _serve(self) -> None:
        request_real_time()
        while not self._ended:
            ready = self._selector.select(self._pause_s())
            with self.lock:
                now_s = time.monotonic()
                if self._reopen_s is not None and now_s >= self._reopen_s:
                    self.restore()
                for key, _ in ready:
                    if isinstance(key.data, _Connection):
                        if key.data in self._connections:
                            self._guarded(key.data, self._receive)
                    elif key.data in self._listening:
                        self._accept(key.data)
                self._advance()
                for connection in list(self._connections):
                    self._guarded(connection, self._stream)
            if self.link.deaf and ready:
                time.sleep(CYCLE_S)  # unread input keeps the selector awake

    def _guarded(self, connection: _Connection, serve: Callable[[_Connection], None]) -> None:
        """Serve one connection; an error of the emulation ends this connection alone."""
        try:
            serve(connection)
        except Exception:
            _log.exception("the UR emulator failed on port %d: a bug of it", connection.port)
            self._hang_up(connection)

    def _advance(self) -> None:
        try:
            self._controller.advance()
        except Exception:
            _log.exception("the emulated UR failed: a bug of it; its program ends")
            self._controller.program = None

    def _pause_s(self) -> float:
        with self.lock:
            now_s = time.monotonic()
            due_s = [c.due_s for c in self._connections if _is_streaming(c.session)]
            if (deadline_s := self._controller.next_deadline_s) is not None:
                due_s.append(deadline_s)
            pause_s = min(due_s, default=now_s + IDLE_S) - now_s
            longest_s = CYCLE_S if self._controller.robot.moving else IDLE_S
            return max(0.0, min(pause_s, longest_s))

    def _listen(self) -> None:
        for port in PORTS:
            if port in self._listening or port in self.link.refused:
                continue
            listener = socket.socket()
            self._listening[port] = listener
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listener.bind((self.host, port))
            listener.listen(16)
            listener.setblocking(False)
            self._selector.register(listener, selectors.EVENT_READ, port)

    def _unlisten(self, port: int) -> None:
        listener = self._listening.pop(port, None)
        if listener is not None:
            with contextlib.suppress(KeyError, ValueError):
                self._selector.unregister(listener)
            listener.close()

    def _accept(self, port: int) -> None:
        try:
            client, _ = self._listening[port].accept()
        except OSError:
            return
        if len(self._connections) >= MAX_CLIENTS:
            client.close()
            return
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        session: Session | None = None
        if not (self.link.mute or self.link.garbage):
            if port == RTDE_PORT:
                session = RtdeSession(self._controller, self.version, self._taken)
            elif port == DASHBOARD_PORT:
                session = DashboardSession(self._controller, self.version)
            else:
                session = ScriptSession(self._controller)
        connection = _Connection(client, port, session)
        self._connections.append(connection)
        self._selector.register(client, selectors.EVENT_READ, connection)
        if self.link.garbage:
            self._send(connection, GARBAGE)
        elif isinstance(session, DashboardSession):
            self._send(connection, DashboardSession.GREETING)

    def _receive(self, connection: _Connection) -> None:
        if self.link.deaf:
            return
        try:
            data = connection.socket.recv(TURN_BYTES)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if not data:
            self._hang_up(connection)
        elif connection.session is not None:
            try:
                self._send(connection, connection.session.receive(data))
            except StreamLostError:
                self._hang_up(connection)
                return
            if connection.session.ended:
                self._hang_up(connection)
        elif self.link.garbage:
            self._send(connection, GARBAGE)

    def _stream(self, connection: _Connection) -> None:
        """Send what still waits, and the next packet of a stream when it is due."""
        session, now_s = connection.session, time.monotonic()
        if connection.unsent:
            self._send(connection, b"")
        if _is_streaming(session) and now_s >= connection.due_s:
            period_s = max(session.period_s, 1.0 / self.fastest_hz)
            late = now_s - connection.due_s > period_s
            connection.due_s = (now_s if late else connection.due_s) + period_s
            if not (self.link.frozen or connection.unsent):
                self._send(connection, session.data())

    def _send(self, connection: _Connection, data: bytes) -> None:
        if self.link.frozen:
            return
        connection.unsent += data
        try:
            sent = connection.socket.send(connection.unsent) if connection.unsent else 0
        except BlockingIOError:
            sent = 0
        except OSError:
            self._hang_up(connection)
            return
        del connection.unsent[:sent]
        if len(connection.unsent) > MAX_UNSENT:
            self._hang_up(connection)

    def _hang_up(self, connection: _Connection) -> None:
        if connection in self._connections:
            self._connections.remove(connection)
            self._selector.unregister(connection.socket)
            connection.socket.close()
            if connection.session is not None:
                connection.session.close()

    def _close_all(self) -> None:
        for connection in list(self._connections):
            self._hang_up(connection)
        for port in PORTS:
            self._unlisten(port)


def _is_streaming(session: Session | None) -> TypeGuard[RtdeSession]:
    return isinstance(session, RtdeSession) and session.streaming
