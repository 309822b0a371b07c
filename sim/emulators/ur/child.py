"""An emulated UR controller as a child process, for the emulation of a whole rig.

A real controller is a computer of its own. In one process with a simulated world, the world's
solves held up the stream by 60 ms and more on a busy machine, and the driver rightly took that for
a dead controller. The child sends its moves over a local connection and waits until the world has
followed. Not here: the emulation (``sim.emulators.ur.controller_process``).
"""

from __future__ import annotations

import json
import logging
import socket
import threading
from collections.abc import Callable

import numpy as np

from primitives.errors import RobotError
from sim.emulators.process.control import Facts
from sim.emulators.process.spawn import EmulatorProcess
from sim.emulators.ur.motion import MotionSegment
from sim.emulators.ur.sessions import PORTS

log = logging.getLogger(__name__)

CALL_S = 20.0
"""Longest wait for the child to connect [s]."""

FOLLOW_S = 120.0
"""Longest time that a world may take to follow one move [s]."""

Follow = Callable[[MotionSegment], None]
"""Function of a world that follows a segment; returns when it is solved."""

Begin = Callable[[MotionSegment], None]
"""Function of a world that is told of the plan of a line that begins; returns at once."""


class RemoteWorld:
    """The child's side: it sends segments to the parent's world."""

    def __init__(self, port: int) -> None:
        """Connect to the parent.

        Raises:
            OSError: Nobody listens there.
        """
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=FOLLOW_S)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._answers = self._socket.makefile("rb")

    def follow(self, segment: MotionSegment) -> None:
        """Send a segment and wait until the world has followed.

        Raises:
            OSError: The parent is gone, or its world failed.
        """
        self._send("ended", segment)
        if self._answers.readline() != b"followed\n":
            raise OSError("the world that follows this arm is gone")

    def begin(self, plan: MotionSegment) -> None:
        """Send the plan of a line that begins.

        Raises:
            OSError: The parent is gone.
        """
        self._send("begins", plan)

    def _send(self, event: str, segment: MotionSegment) -> None:
        numbers = [
            segment.by_base_m.tolist(),
            segment.rotvec_rad.tolist(),
            segment.speed_m_s,
            segment.acceleration_m_s2,
        ]
        self._socket.sendall(json.dumps([event, *numbers]).encode() + b"\n")


class UrChild:
    """A child process that emulates a controller; an ``Emulated`` device of the parent.

    Attributes:
        host: Loopback address of the controller.
    """

    def __init__(self, host: str, follow: Follow, begin: Begin | None = None) -> None:
        """Start it; ``follow`` is called with every segment, in a thread of its own.

        ``begin`` is called in that thread too, with the plan of every line.

        Raises:
            OSError: The ports are taken on this address.
            RobotError: The child can't start.
        """
        for port in PORTS:
            with socket.socket() as probe:
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
                probe.bind((host, port))
        self.host = host
        self._follow, self._begin = follow, begin
        with socket.create_server(("127.0.0.1", 0)) as listener:
            listener.settimeout(CALL_S)
            port = listener.getsockname()[1]
            self._child = EmulatorProcess("ur", "--host", host, "--world-port", str(port))
            try:
                self._connection, _ = listener.accept()
            except OSError as error:
                self._child.close()
                raise RobotError(f"the UR emulator did not call its world: {error}") from None
        self._connection.settimeout(None)
        self._connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def inject(self, fault: str, **details: float | str) -> None:
        self._child.control.inject("ur", fault, **details)

    def clear(self) -> None:
        self._child.control.clear("ur")

    def facts(self) -> Facts:
        return self._child.control.facts("ur")

    def close(self) -> None:
        self._child.close()
        self._connection.close()
        self._thread.join(timeout=2)

    def _run(self) -> None:
        # When the world fails, the connection closes, and the move in the child never ends.
        with self._connection, self._connection.makefile("rb") as lines:
            for line in lines:
                event, by_base_m, rotvec_rad, *limits = json.loads(line)
                segment = MotionSegment(np.array(by_base_m), np.array(rotvec_rad), *limits)
                try:
                    if event == "begins":
                        if self._begin is not None:
                            self._begin(segment)
                        continue
                    self._follow(segment)
                except Exception:
                    log.exception("the emulated world could not follow the arm")
                    return
                try:
                    self._connection.sendall(b"followed\n")
                except OSError:
                    return
