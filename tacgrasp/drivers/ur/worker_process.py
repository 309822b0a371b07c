"""The UR worker process as its owner sees it: start, commands, state, end. All waits bounded."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

from primitives.errors import RobotError
from tacgrasp.drivers.ur.settings import UrSettings
from tacgrasp.drivers.ur.shared_state import (
    CommandRecord,
    SharedStateBlock,
    WorkerPhase,
    WorkerState,
)

POLL_S = 0.002
"""Interval between two looks at the worker's state while waiting for it [s]."""

KILL_WAIT_S = 5.0


class WorkerProcess:
    """One worker process with its command pipe and its block of shared memory.

    Attributes:
        pid: Id of the process.
        block: Its shared memory.
    """

    def __init__(self, settings: UrSettings) -> None:
        """Start the process; ``await_ready`` waits until it supervises the arm."""
        self._settings = settings
        self.block = SharedStateBlock()
        self.block.write(WorkerState(text="starting Python", beat_s=time.monotonic()))
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 - closed with the worker
        packages = str(Path(__file__).resolve().parents[3])
        path = os.pathsep.join(filter(None, [packages, os.environ.get("PYTHONPATH", "")]))
        self._process = subprocess.Popen(
            [
                sys.executable, "-m", "tacgrasp.drivers.ur.worker", str(self.block.fd),
                settings.model_dump_json(),
            ],
            stdin=subprocess.PIPE,
            stdout=self._output,
            stderr=self._output,
            pass_fds=(self.block.fd,),
            env=os.environ | {"PYTHONPATH": path, "OMP_NUM_THREADS": "1"},
            start_new_session=True,  # a Ctrl-C in the terminal is for the owner alone
        )  # fmt: skip
        self.pid = self._process.pid
        if self._process.stdin is not None:
            os.set_blocking(self._process.stdin.fileno(), False)

    def await_ready(self) -> None:
        """Wait until the arm is supervised, at most ``start_timeout_s``: the library may hang.

        Raises:
            RobotError: The start failed or took too long; the message has its last step.
        """
        until_s = time.monotonic() + self._settings.start_timeout_s
        while True:
            ended, state = self.has_ended, self.read()
            if state.phase == WorkerPhase.READY:
                return
            if state.phase == WorkerPhase.FAULT:
                raise RobotError(f"the UR arm can't be used: {state.text}")
            if ended:
                raise RobotError(f"the UR arm can't be used: {self.exit_message(state)}")
            if time.monotonic() > until_s:
                raise RobotError(
                    f"the UR arm was not ready within {self._settings.start_timeout_s:g} s, while "
                    f"{state.text}; restart the controller if it is so again"
                )
            time.sleep(POLL_S)

    def send(self, command: CommandRecord) -> None:
        """Send a command without waiting.

        Raises:
            OSError: The worker is gone, or has not read for a long time.
        """
        if self._process.stdin is None or self._process.stdin.closed:
            raise BrokenPipeError("the worker's command pipe is closed")
        os.write(self._process.stdin.fileno(), command.packed())

    def read(self) -> WorkerState:
        """Last state published by the worker.

        Raises:
            RobotError: No whole state, or the memory was freed by another thread.
        """
        try:
            return self.block.read()
        except ValueError:
            raise RobotError("the UR arm is disconnected") from None

    @property
    def has_ended(self) -> bool:
        return self._process.poll() is not None

    @property
    def exited_cleanly(self) -> bool:
        """Whether the process has ended with exit code 0, as after a command to end."""
        return self._process.poll() == 0

    def wait(self, seconds: float) -> None:
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(seconds)

    def kill(self) -> None:
        if not self.has_ended:
            self._process.kill()
            self.wait(KILL_WAIT_S)

    def exit_message(self, state: WorkerState) -> str:
        """Message for an end without a fault: exit code and the last words of the output."""
        self._output.seek(0)
        words = " ".join(self._output.read().decode(errors="replace").split()[-40:])
        code = self._process.poll()
        return f"its worker ended (exit {code}) while {state.text or 'working'}: {words}"

    def close(self) -> None:
        if self._process.stdin is not None:
            with suppress(OSError):
                self._process.stdin.close()
        self.kill()
        self._output.close()
        self.block.close()
