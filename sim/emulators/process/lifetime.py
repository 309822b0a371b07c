"""Scheduling and lifetime of an emulator's process: one ready line, then service until the end.

The process ends on SIGTERM, on Ctrl-C and when its standard input closes, so that it never outlives
the process that started it.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
from collections.abc import Mapping
from contextlib import closing, suppress
from types import FrameType

from sim.emulators.process.control import ControlServer, Emulated

REAL_TIME_PRIORITY, WORLD_PRIORITY = 11, 1
"""Real-time priorities of an emulated device, and of the world that is solved for it: below every
device and driver, above ordinary work, which a real world would not have to share a computer with.
"""

Ready = Mapping[str, str | float]
"""What the parent process has to know: addresses and ports, by name."""


def request_real_time(*, inherited: bool = True, priority: int = REAL_TIME_PRIORITY) -> None:
    """Run this thread before ordinary work, where the system allows it.

    A device answers in real time; an emulated one on a busy machine would show that machine's
    pauses as its own.

    Args:
        inherited: Threads that this one starts get the same priority. Set it to False where one of
            them solves contacts.
        priority: Priority among the real-time threads of this machine.
    """
    with suppress(OSError, AttributeError):
        reset = 0 if inherited else os.SCHED_RESET_ON_FORK
        os.sched_setscheduler(0, os.SCHED_FIFO | reset, os.sched_param(priority))


def serve(devices: Mapping[str, Emulated], ready: Ready) -> None:
    """Open the control channel of some devices, announce it and wait until the process is to end.

    Args:
        devices: Emulated devices by name.
        ready: Their addresses; the control channel's port is added as ``control_port``.
    """
    with closing(ControlServer(devices)) as control:
        announce_and_wait({"control_port": control.port, **ready})


def announce_and_wait(ready: Ready) -> None:
    """Print ``ready`` as one JSON line and return when the process is to end.

    Call it from the main thread (it takes SIGTERM and SIGINT); the emulator's own threads run on.
    """
    ended = threading.Event()

    def end(signum: int, frame: FrameType | None) -> None:
        ended.set()

    signal.signal(signal.SIGTERM, end)
    signal.signal(signal.SIGINT, end)
    threading.Thread(target=_wait_for_closed_stdin, args=(ended,), daemon=True).start()
    sys.stdout.write(json.dumps(dict(ready)) + "\n")
    sys.stdout.flush()
    while not ended.wait(0.2):  # a bare wait would not let the signal's Python code run at once
        pass


def _wait_for_closed_stdin(ended: threading.Event) -> None:
    # os.read, not sys.stdin: a thread blocked inside a buffered reader hinders the exit
    while os.read(0, 4096):
        pass
    ended.set()
