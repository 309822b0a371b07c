"""The process that alone owns the connection to a UR arm; it is replaced after a fault.

``python -m tacgrasp.drivers.ur.worker FD SETTINGS``, started by
``tacgrasp.drivers.ur.worker_process``: connect, set up, supervise (``supervisor``). The first fault
is latched: the arm is braked by every available method and the process ends, since the library
never recovers from a lost link. The end of the command pipe means that the owner is gone: brake and
end.
"""

from __future__ import annotations

import gc
import math
import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import NoReturn

from primitives.errors import RobotError
from tacgrasp.drivers.scheduling import lateness_s
from tacgrasp.drivers.ur.dashboard import Dashboard, stop_from_outside
from tacgrasp.drivers.ur.rtde_link import UrLink
from tacgrasp.drivers.ur.settings import UrSettings
from tacgrasp.drivers.ur.shared_state import SharedStateBlock, WorkerPhase, WorkerState
from tacgrasp.drivers.ur.supervisor import OwnerGoneError, Supervisor, returned_within

LIBRARY_END_S = 0.2
DASHBOARD_S = 0.1
"""Time-out of the dashboard connection that is kept for an urgent stop [s]."""

BUSY_S, BUSY_WATCHDOG_HZ, BUSY_STALE_MS = 0.003, 10.0, 120.0
"""Lateness from which on a computer is busy [s], and what it is then given without real-time
priority: at rest within 150 ms after a dead link, in place of 90."""

SUPERVISION_PRIORITY, LIBRARY_PRIORITY = 10, 12
"""Real-time priorities (SCHED_FIFO) of supervision and of the library's threads."""


def main(argv: list[str]) -> NoReturn:
    """Connect, supervise, end. Never returns: the library's destructors would reconnect."""
    block = SharedStateBlock(int(argv[0]))
    settings = UrSettings.model_validate_json(argv[1])
    for number in (signal.SIGINT, signal.SIGHUP):  # Ctrl-C, and the end of the terminal
        signal.signal(number, signal.SIG_IGN)  # they are the owner's: it stops the arm
    # A hanging library holds the interpreter: only the kernel can end this process then.
    signal.alarm(math.ceil(settings.start_timeout_s) + 1)
    starting = WorkerState()

    def report_step(text: str) -> None:
        starting.text, starting.beat_s = text, time.monotonic()
        block.write(starting)

    try:
        link = UrLink(settings, report_step)
        settings = patient(settings, is_real_time=_request_real_time())
        link.set_up(report_step)
        dashboard = Dashboard(settings.host, DASHBOARD_S)
        supervisor = Supervisor(settings, link, block, sys.stdin.fileno())
        supervisor.state.phase = WorkerPhase.READY
        gc.collect()
        gc.disable()  # a collection would be a gap in the supervision
        link.arm_watchdog(settings.watchdog_hz)
    except Exception as error:
        _exit_with_fault(block, starting, f"{error}" or repr(error))
    signal.alarm(0)
    signal.signal(signal.SIGTERM, _on_terminate)
    try:
        supervisor.run()
    except OwnerGoneError as error:
        supervisor.state.phase, supervisor.state.text = WorkerPhase.ENDED, str(error)
        supervisor.brake()
        if not returned_within(LIBRARY_END_S, link.end):
            _stop_from_outside(settings, dashboard)
        supervisor.publish(time.monotonic())
        os._exit(0)
    except Exception as error:
        text = str(error) if isinstance(error, RobotError) else repr(error)
        supervisor.state.phase, supervisor.state.text = WorkerPhase.FAULT, text
        supervisor.publish(supervisor.state.beat_s)
        methods = [supervisor.brake(), _stop_from_outside(settings, dashboard)]
        stop = ", ".join(filter(None, methods)) or "only the controller's own watchdog is left"
        _exit_with_fault(block, supervisor.state, f"{text} (stop: {stop})")


def _stop_from_outside(settings: UrSettings, dashboard: Dashboard) -> str:
    return stop_from_outside(settings.host, settings.stop_deceleration_m_s2, dashboard=dashboard)


def patient(
    settings: UrSettings, *, is_real_time: bool, late_s: Callable[[], float] = lateness_s
) -> UrSettings:
    """Settings for this computer as it is now: with more patience where its threads wake up late.

    A watchdog that a busy computer can't keep ends runs without a fault of the arm. Universal
    Robots' own client library waits ten times as long without real-time priority.

    Args:
        settings: The arm's section of the rig's file.
        is_real_time: Whether this process has real-time priority.
        late_s: Measures by how much this thread wakes up late [s].
    """
    if is_real_time or late_s() < BUSY_S:
        return settings
    return settings.model_copy(
        update={
            "watchdog_hz": min(settings.watchdog_hz, BUSY_WATCHDOG_HZ),
            "stale_ms": max(settings.stale_ms, BUSY_STALE_MS),
        }
    )


def _request_real_time() -> bool:
    """Run before ordinary work where the system allows it; otherwise a busy machine adds jitter.

    The library's threads get the higher priority: its calls spin while they wait for an answer, and
    with equal priorities they kept the receiving thread off the processor, up to a measured second.
    Returns whether the system allows it.
    """
    try:
        for task in Path("/proc/self/task").iterdir():
            supervises = int(task.name) == threading.get_native_id()
            priority = os.sched_param(SUPERVISION_PRIORITY if supervises else LIBRARY_PRIORITY)
            os.sched_setscheduler(int(task.name), os.SCHED_FIFO, priority)
    except (OSError, AttributeError):
        return False
    return True


def _on_terminate(signum: int, frame: object) -> NoReturn:
    raise OwnerGoneError("ended by a signal")


def _exit_with_fault(block: SharedStateBlock, state: WorkerState, text: str) -> NoReturn:
    state.phase, state.text = WorkerPhase.FAULT, text
    block.write(state)
    with suppress(OSError, ValueError):
        sys.stderr.flush()
    os._exit(1)


if __name__ == "__main__":
    main(sys.argv[1:])
