"""An emulated UR controller as a child process, for whoever emulates a whole rig.

A controller is a computer of its own: in one process with a simulated world, the world's solves
held up the stream by 60 ms and more on a busy machine, and the driver rightly took that for a dead
controller. The child tells its moves over a local connection and waits until the world has
followed. Not here: the emulation (``ur``).
"""

from __future__ import annotations

import json
import logging
import socket
import threading
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from primitives.errors import RobotError
from sim.emulators.process.control import Facts
from sim.emulators.process.spawn import EmulatorProcess

log = logging.getLogger(__name__)

CALL_S = 20.0
"""Longest wait for the child to call [s]."""

FOLLOW_S = 120.0
"""Longest time that a world may take to follow one move [s]."""

Moved = Callable[[NDArray[np.float64], NDArray[np.float64], float, float], None]
"""``sim.emulators.ur.controller_process.TcpListener.moved``."""


class RemoteWorld:
    """The child's side: a ``TcpListener`` that asks the parent's world over a connection."""

    def __init__(self, port: int) -> None:
        """Connect to the parent.

        Raises:
            OSError: Nobody listens there.
        """
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=FOLLOW_S)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._answers = self._socket.makefile("rb")

    def moved(
        self,
        by_base_m: NDArray[np.float64],
        rotvec_rad: NDArray[np.float64],
        speed_m_s: float,
        acceleration_m_s2: float,
    ) -> None:
        """Tell a move and wait until the world has followed.

        Raises:
            OSError: The parent is gone, or its world failed.
        """
        told = [by_base_m.tolist(), rotvec_rad.tolist(), speed_m_s, acceleration_m_s2]
        self._socket.sendall(json.dumps(told).encode() + b"\n")
        if self._answers.readline() != b"followed\n":
            raise OSError("the world that follows this arm is gone")


class UrChild:
    """A child process that emulates a controller; an ``Emulated`` device of the parent.

    Attributes:
        host: Its loopback address.
    """

    def __init__(self, host: str, moved: Moved) -> None:
        """Start it; ``moved`` is called in a thread of its own.

        Raises:
            OSError: The ports are taken on this address.
            RobotError: The child can't start.
        """
        for port in (29999, 30003, 30004):
            with socket.socket() as free:
                free.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
                free.bind((host, port))
        self.host = host
        self._moved = moved
        with socket.create_server(("127.0.0.1", 0)) as calls:
            calls.settimeout(CALL_S)
            port = calls.getsockname()[1]
            self._child = EmulatorProcess("ur", "--host", host, "--world-port", str(port))
            try:
                self._line, _ = calls.accept()
            except OSError as error:
                self._child.close()
                raise RobotError(f"the UR emulator did not call its world: {error}") from None
        self._line.settimeout(None)
        self._line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._thread = threading.Thread(target=self._follow, daemon=True)
        self._thread.start()

    def inject(self, fault: str, **details: float | str) -> None:
        """As ``UrEmulator.inject``."""
        self._child.control.inject("ur", fault, **details)

    def clear(self) -> None:
        """As ``UrEmulator.clear``."""
        self._child.control.clear("ur")

    def facts(self) -> Facts:
        """As ``UrEmulator.facts``."""
        return self._child.control.facts("ur")

    def close(self) -> None:
        """End the child. Idempotent."""
        self._child.close()
        self._line.close()
        self._thread.join(timeout=2)

    def _follow(self) -> None:
        # Hanging up is how a world that failed shows in the child: its move never ends.
        with self._line, self._line.makefile("rb") as lines:
            for line in lines:
                by_base_m, rotvec_rad, speed, acceleration = json.loads(line)
                try:
                    self._moved(np.array(by_base_m), np.array(rotvec_rad), speed, acceleration)
                except Exception:
                    log.exception("the emulated world could not follow the arm")
                    return
                try:
                    self._line.sendall(b"followed\n")
                except OSError:
                    return
