"""Start an emulator as a child process and end it again, both in bounded time."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping
from typing import Any

from primitives.errors import RobotError
from sim.emulators.process.control import ControlClient

READY_S = 60.0
"""Longest start: on a machine that is busy, loading torch alone can take many seconds."""

END_S = 5.0


_CLASS = re.compile(r"^(?:[a-z_]\w*\.)+\w+: ")
"""What a traceback writes before an error's message."""


def without_class(line: str) -> str:
    """The last line of a traceback without its error's class."""
    return _CLASS.sub("", line)


class EmulatorProcess:
    """A running ``python -m sim.emulators KIND OPTIONS``; a context manager.

    Attributes:
        ready: Announced addresses and ports, by name.
        control: Client of the emulator's control channel.
    """

    def __init__(self, kind: str, *options: str, ready_s: float = READY_S) -> None:
        """Start it and wait for its ready line.

        Raises:
            RobotError: It ended or was silent for ``ready_s`` [s]; with its last error line.
        """
        command = [sys.executable, "-m", "sim.emulators", kind, *options]
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed with the process
        self._child = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            env={**os.environ, "COLUMNS": "1000"},  # refused options are explained on one line
        )
        self.ready: Mapping[str, Any] = {}
        try:
            self.ready = self._ready_line(kind, ready_s)
            self.control = ControlClient(self.ready["control_port"])
        except BaseException:
            self._end()
            raise

    def __enter__(self) -> EmulatorProcess:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def running(self) -> bool:
        return self._child.poll() is None

    def close(self) -> None:
        self.control.close()
        self._end()

    def _ready_line(self, kind: str, ready_s: float) -> Mapping[str, Any]:
        stdout = self._child.stdout
        if stdout is None:
            raise RuntimeError("an emulator is started with its output piped")
        lines: list[bytes] = []
        reader = threading.Thread(target=lambda: lines.append(stdout.readline()), daemon=True)
        reader.start()
        reader.join(ready_s)
        if not lines or not lines[0].strip():
            if not lines and not self._error():
                raise RobotError(
                    f"the {kind} emulator was silent for {ready_s:g} s, without an error: this "
                    "computer had no time for it; end other work and start again"
                )
            failure = "ended at once" if lines else f"was silent for {ready_s:g} s"
            raise RobotError(f"the {kind} emulator {failure}: {self._error() or 'no error text'}")
        ready = json.loads(lines[0])
        if not isinstance(ready, dict) or not isinstance(ready.get("control_port"), int):
            raise RobotError(f"the {kind} emulator announced {ready!r}, expected a control_port")
        return ready

    def _error(self) -> str:
        """The last line of the emulator's standard error, without frames, hints and class names."""
        self._errors.seek(0)
        lines = self._errors.read().decode(errors="replace").splitlines()
        texts = (line.strip("╭╮╰╯│─ ") for line in reversed(lines))
        last = next((text for text in texts if text and "full helptext" not in text), "")
        return without_class(last)

    def _end(self) -> None:
        if self._child.stdin is not None:
            self._child.stdin.close()
        if self._child.poll() is None:
            self._child.terminate()
            try:
                self._child.wait(END_S)
            except subprocess.TimeoutExpired:
                self._child.kill()
                self._child.wait(END_S)
        if self._child.stdout is not None:  # last: it waits for who still reads a ready line
            self._child.stdout.close()
        self._errors.close()
