"""The UR arm's worker process as its owner holds it: start, orders, state, end. All bounded.

Not here: what a fault means (``ur``), what the worker does (``ur_worker``).
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from primitives.errors import RobotError
from tacgrasp.drivers.ur.settings import UrSettings
from tacgrasp.drivers.ur.shared_state import (
    CommandRecord,
    Distribution,
    SharedStateBlock,
    WorkerPhase,
    WorkerState,
)

LOOK_S = 0.002
"""How often the worker's state is looked at while waiting for it [s]."""

BURY_S = 5.0


class WorkerProcess:
    """One worker process with its order pipe and its block of shared memory.

    Attributes:
        pid: The worker's process.
    """

    def __init__(self, settings: UrSettings) -> None:
        """Start the worker; it is not ready yet."""
        self._settings = settings
        self._block = SharedStateBlock()
        self._block.write(WorkerState(text="starting Python", beat_s=time.monotonic()))
        self._said = tempfile.TemporaryFile()  # noqa: SIM115 - closed with the worker
        packages = str(Path(__file__).resolve().parents[3])
        path = os.pathsep.join(filter(None, [packages, os.environ.get("PYTHONPATH", "")]))
        self._worker = subprocess.Popen(
            [
                sys.executable, "-m", "tacgrasp.drivers.ur.worker", str(self._block.fd),
                settings.model_dump_json(),
            ],
            stdin=subprocess.PIPE,
            stdout=self._said,
            stderr=self._said,
            pass_fds=(self._block.fd,),
            env=os.environ | {"PYTHONPATH": path, "OMP_NUM_THREADS": "1"},
            start_new_session=True,  # a Ctrl-C in the terminal is for the owner alone
        )  # fmt: skip
        self.pid = self._worker.pid
        if self._worker.stdin is not None:
            os.set_blocking(self._worker.stdin.fileno(), False)

    def await_ready(self, clock: Callable[[], float], sleep: Callable[[float], None]) -> None:
        """Wait until the arm is under supervision; the library may hang, so this is bounded.

        Raises:
            RobotError: It can't be, or not in ``start_timeout_s``; with what it was doing.
        """
        until_s = clock() + self._settings.start_timeout_s
        while True:
            ended, state = self.has_ended, self.read()
            if state.phase == WorkerPhase.READY:
                return
            if state.phase == WorkerPhase.FAULT or ended:
                why = state.text if state.phase == WorkerPhase.FAULT else self.last_said(state)
                raise RobotError(f"the UR arm can't be used: {why}")
            if clock() > until_s:
                raise RobotError(
                    f"the UR arm was not ready within {self._settings.start_timeout_s:g} s, while "
                    f"{state.text}; restart the controller if it is so again"
                )
            sleep(LOOK_S)

    def send(self, order: CommandRecord) -> None:
        """Hand an order over; never waits.

        Raises:
            OSError: The worker is gone, or has not read for a long time.
        """
        if self._worker.stdin is None or self._worker.stdin.closed:
            raise BrokenPipeError("the worker's order pipe is closed")
        os.write(self._worker.stdin.fileno(), order.packed())

    def read(self) -> WorkerState:
        """What the worker last published.

        Raises:
            RobotError: Nothing whole, or it was freed by another thread.
        """
        try:
            return self._block.read()
        except ValueError:
            raise RobotError("the UR arm is disconnected") from None

    def distribution(self, counter: int) -> Distribution:
        """What one of the worker's counters has gathered."""
        return self._block.distribution(counter)

    @property
    def has_ended(self) -> bool:
        """The process is gone."""
        return self._worker.poll() is not None

    @property
    def ended_well(self) -> bool:
        """The process is gone, as it was told."""
        return self._worker.poll() == 0

    def wait(self, seconds: float) -> None:
        """Wait for its end, at most so long [s]."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._worker.wait(seconds)

    def kill(self) -> None:
        """End it at once, if it has not ended. Idempotent."""
        if not self.has_ended:
            self._worker.kill()
            self.wait(BURY_S)

    def last_said(self, state: WorkerState) -> str:
        """Why it ended without a word: exit code and the end of its output."""
        self._said.seek(0)
        said = " ".join(self._said.read().decode(errors="replace").split()[-40:])
        code = self._worker.poll()
        return f"its worker ended (exit {code}) while {state.text or 'working'}: {said}"

    def close(self) -> None:
        """Be rid of it, however it is, and of what it left. Idempotent."""
        if self._worker.stdin is not None:
            with contextlib.suppress(OSError):
                self._worker.stdin.close()
        self.kill()
        self._said.close()
        self._block.close()
