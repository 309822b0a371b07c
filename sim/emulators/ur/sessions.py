"""What a connection of a client to an emulated controller is, and the script port's connection.

A session turns received bytes into answers. Not here: sockets and faults of the link
(``sim.emulators.ur.server``), RTDE (``rtde_session``), the dashboard (``dashboard_session``).

Source: Universal Robots, 'Remote control via TCP/IP' (script ports).
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod

from sim.emulators.ur.controller import Controller
from sim.emulators.ur.motion import RATES
from sim.emulators.ur.packets import StreamLostError

RTDE_PORT, DASHBOARD_PORT, SCRIPT_PORT = 30004, 29999, 30003
PORTS = (DASHBOARD_PORT, SCRIPT_PORT, RTDE_PORT)

LONGEST_SCRIPT = 1 << 20
"""Longest accepted script [bytes]; ur_rtde's is about 42 kB. Our choice."""

_PROGRAM_END = re.compile(rb"\nend[ \t\r]*\n")
_STOP_LINE = re.compile(r"stop[lj]\(\s*(?:a\s*=\s*)?(\d*\.?\d+(?:[eE][+-]?\d+)?)\s*\)")
_LONGEST_END = 64


class Session(ABC):
    """One connection.

    Attributes:
        ended: The controller closes the connection after the answer.
    """

    ended = False

    @abstractmethod
    def receive(self, data: bytes) -> bytes:
        """Take any bytes of the client and return the answer.

        Raises:
            StreamLostError: Nothing after these bytes can be understood; the connection is closed.
        """

    def close(self) -> None:  # noqa: B027 - most sessions hold nothing
        """Release what the connection holds."""


class ScriptSession(Session):
    """Port 30003: a program (``def ... end``), or a one-line script. It has no data stream.

    As on a real controller any script replaces the running program, also one that does not compile
    (the error is told in the pendant's log alone, never on this port), and a secondary program
    (``sec ... end``) leaves it running. In local control scripts are ignored.
    """

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._text = b""
        self._searched = 0

    def receive(self, data: bytes) -> bytes:
        """Take lines; a program starts at its ``end`` at the margin."""
        self._text += data
        while self._take_script():
            pass
        if len(self._text) > LONGEST_SCRIPT:
            raise StreamLostError("a script without an end")
        return b""

    def _take_script(self) -> bool:
        """Run the first script if it is complete; returns whether it was."""
        if not self._searched:
            self._text = self._text.lstrip()
        if self._text.startswith((b"def ", b"sec ")):
            end = _PROGRAM_END.search(self._text, max(0, self._searched - _LONGEST_END))
            if end is None:
                self._searched = len(self._text)
                return False
            if self._text.startswith(b"def "):
                self._controller.start_program()
            self._text, self._searched = self._text[end.end() :], 0
            return True
        line, newline, rest = self._text.partition(b"\n")
        if newline:
            self._text = rest
            self._line(line.decode("utf-8", "replace").strip())
        return bool(newline)

    def _line(self, line: str) -> None:
        if not self._controller.remote:
            return
        stop = _STOP_LINE.fullmatch(line)
        deceleration = float(stop[1]) if stop is not None else 0.0
        if RATES[0] <= deceleration <= RATES[1]:
            self._controller.stop_program("a one-line script replaced it")
            self._controller.robot.halt(deceleration)
        elif line:
            self._controller.stop_program(f"replaced by {line[:40]!r}")
