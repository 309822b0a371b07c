"""The disposable process that alone owns the connection to a UR arm.

``python -m tacgrasp.drivers.ur.worker FD SETTINGS``, started by
``tacgrasp.drivers.ur.worker_process``: connect, set up, supervise (``ur_supervisor``). The first
thing wrong is latched: the arm is braked by every way left and the process ends, since the library
never recovers from a lost link. The end of the order pipe means that the owner is gone: brake and
end.
"""

from __future__ import annotations

import contextlib
import gc
import math
import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import NoReturn

from primitives.errors import RobotError
from tacgrasp.drivers.ur.dashboard import Dashboard, stop_from_outside
from tacgrasp.drivers.ur.rtde_link import UrLink
from tacgrasp.drivers.ur.settings import UrSettings
from tacgrasp.drivers.ur.shared_state import SharedStateBlock, WorkerPhase, WorkerState
from tacgrasp.drivers.ur.supervisor import OwnerGoneError, Supervisor, within

LIBRARY_END_S = 0.2
DASHBOARD_S = 0.1
"""Longest wait for the dashboard, which is asked when a stop can't wait [s]."""

ROUNDS, LIBRARY = 10, 12
"""Real-time priorities (SCHED_FIFO) of supervision and of the library's threads."""


def main(argv: list[str]) -> NoReturn:
    """Connect, supervise, end. Never returns: the library's destructors would reconnect."""
    block = SharedStateBlock(int(argv[0]))
    settings = UrSettings.model_validate_json(argv[1])
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the owner's: it stops the arm
    # A library that hangs holds the interpreter: only the kernel can end this process then.
    signal.alarm(math.ceil(settings.start_timeout_s) + 1)
    starting = WorkerState()

    def step(text: str) -> None:
        starting.text, starting.beat_s = text, time.monotonic()
        block.write(starting)

    try:
        link = UrLink(settings, step)
        _ask_for_real_time()
        link.set_up(step)
        dashboard = Dashboard(settings.host, DASHBOARD_S)
        supervisor = Supervisor(settings, link, block, sys.stdin.fileno())
        supervisor.state.phase = WorkerPhase.READY
        gc.collect()
        gc.disable()  # a collection would be a hole in the supervision
        link.arm_watchdog()
    except Exception as error:
        _last_words(block, starting, f"{error}" or repr(error))
    signal.alarm(0)
    signal.signal(signal.SIGTERM, _gone)
    try:
        supervisor.run()
    except OwnerGoneError as gone:
        supervisor.state.phase, supervisor.state.text = WorkerPhase.ENDED, str(gone)
        supervisor.brake()
        ended = within(LIBRARY_END_S, link.end)
        if not ended:
            _stop_from_outside(settings, dashboard)
        supervisor.publish(time.monotonic())
        os._exit(0)
    except Exception as error:
        text = str(error) if isinstance(error, RobotError) else repr(error)
        supervisor.state.phase, supervisor.state.text = WorkerPhase.FAULT, text
        supervisor.publish(supervisor.state.beat_s)
        ways = [supervisor.brake(), _stop_from_outside(settings, dashboard)]
        told = ", ".join(filter(None, ways)) or "no way to tell it is left but its own watchdog"
        _last_words(block, supervisor.state, f"{text} (stop: {told})")


def _stop_from_outside(settings: UrSettings, dashboard: Dashboard) -> str:
    return stop_from_outside(settings.host, settings.stop_deceleration_m_s2, dashboard=dashboard)


def _ask_for_real_time() -> None:
    """Run before ordinary work where the system allows it; else a busy machine shows as jitter.

    The library's threads come first: its calls spin while they wait for an answer, and with equal
    priorities they kept the thread that receives it off the processor, measured up to a second.
    """
    with contextlib.suppress(OSError, AttributeError):
        for task in Path("/proc/self/task").iterdir():
            rounds = int(task.name) == threading.get_native_id()
            priority = os.sched_param(ROUNDS if rounds else LIBRARY)
            os.sched_setscheduler(int(task.name), os.SCHED_FIFO, priority)


def _gone(signum: int, frame: object) -> NoReturn:
    raise OwnerGoneError("told to end by a signal")


def _last_words(block: SharedStateBlock, state: WorkerState, text: str) -> NoReturn:
    state.phase, state.text = WorkerPhase.FAULT, text
    block.write(state)
    with contextlib.suppress(OSError, ValueError):
        sys.stderr.flush()
    os._exit(1)


if __name__ == "__main__":
    main(sys.argv[1:])
