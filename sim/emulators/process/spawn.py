"""Start an emulator as a child process and end it again, both in bounded time."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping
from types import TracebackType

from primitives.errors import RobotError
from sim.emulators.process.control import ControlClient

READY_S = 60.0
"""Longest start: on a machine that is busy, loading torch alone can take many seconds."""

END_S = 5.0


class EmulatorProcess:
    """A running ``python -m sim.emulators KIND OPTIONS``; a context manager.

    Attributes:
        ready: What the emulator announced: addresses and ports, by name.
        control: Its control channel.
        pid: Its process.
    """

    def __init__(self, kind: str, *options: str, ready_s: float = READY_S) -> None:
        """Start it and wait for its ready line.

        Raises:
            RobotError: It ended or was silent for ``ready_s`` [s]; with what it said.
        """
        command = [sys.executable, "-m", "sim.emulators", kind, *options]
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed with the process
        self._child = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors
        )
        self.pid = self._child.pid
        self.ready: Mapping[str, object] = {}
        try:
            self.ready = self._ready_line(kind, ready_s)
            self.control = ControlClient(_port(self.ready))
        except BaseException:
            self._end()
            raise

    def __enter__(self) -> EmulatorProcess:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def running(self) -> bool:
        """Whether the process has not ended."""
        return self._child.poll() is None

    def close(self) -> None:
        """End the process and wait until it is gone. Idempotent."""
        self.control.close()
        self._end()

    def _ready_line(self, kind: str, ready_s: float) -> Mapping[str, object]:
        stdout = self._child.stdout
        if stdout is None:
            raise RuntimeError("an emulator is started with its output piped")
        lines: list[bytes] = []
        reader = threading.Thread(target=lambda: lines.append(stdout.readline()), daemon=True)
        reader.start()
        reader.join(ready_s)
        if not lines or not lines[0].strip():
            how = "ended at once" if lines else f"was silent for {ready_s:g} s"
            raise RobotError(f"the {kind} emulator {how}: {self._said() or 'it said nothing'}")
        ready = json.loads(lines[0])
        if not isinstance(ready, dict):
            raise RobotError(f"the {kind} emulator announced {ready!r}, expected an object")
        return ready

    def _said(self) -> str:
        """The last line that the emulator wrote to its standard error."""
        self._errors.seek(0)
        lines = self._errors.read().decode(errors="replace").split("\n")
        return next((line.strip() for line in reversed(lines) if line.strip()), "")

    def _end(self) -> None:
        for pipe in (self._child.stdin, self._child.stdout):
            if pipe is not None and not pipe.closed:
                pipe.close()
        if self._child.poll() is None:
            self._child.terminate()
            try:
                self._child.wait(END_S)
            except subprocess.TimeoutExpired:
                self._child.kill()
                self._child.wait(END_S)
        self._errors.close()


def _port(ready: Mapping[str, object]) -> int:
    port = ready.get("control_port")
    if not isinstance(port, int):
        raise RobotError(f"an emulator announces its control_port, got {dict(ready)}")
    return port
