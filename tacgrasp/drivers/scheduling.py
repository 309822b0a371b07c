"""Scheduling of the threads that must not be late: what is requested, and what the system grants.

A driver's thread that waits for the processor looks like a device that is late. Not here: the
priorities of the UR arm's worker process (``tacgrasp.drivers.ur.worker``).
"""

from __future__ import annotations

import os
import threading
import time
from contextlib import suppress
from dataclasses import dataclass

REAL_TIME_PRIORITY = 9
"""SCHED_FIFO priority of a driver's thread; below the arm's worker."""

NICE, USER_NICE = -15, -10
MIN_CORES = 2
"""One core for the drivers, one for everything else."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Granted:
    """What the operating system grants a driver's thread.

    Attributes:
        real_time: It may run before all ordinary work (SCHED_FIFO).
        nice: Its nice value; negative ones run before other ordinary work.
        cores: Number of processor cores that this program may use.
    """

    real_time: bool
    nice: int
    cores: int

    @property
    def problem(self) -> str:
        """What may make readings late on a busy computer; empty for nothing."""
        if self.cores < MIN_CORES:
            return f"{self.cores} core: needed are {MIN_CORES}"
        if self.real_time or self.nice <= NICE:
            return ""
        return "the drivers have no priority over other work"

    def __str__(self) -> str:
        """Priority and cores, for people."""
        priority = "real-time priority" if self.real_time else f"nice {self.nice}"
        return f"{priority}, {self.cores} cores"


ADVICE = (
    "a busy computer will hold the arm often: end other work, or allow priority (as root: setcap "
    "cap_sys_nice+ep on Python's binary, or 'username - rtprio 20' in /etc/security/limits.conf)"
)


def request_priority() -> Granted:
    """Run the calling thread before ordinary work, as far as the system allows it.

    Threads started by it do not inherit a real-time priority.
    """
    thread = threading.get_native_id()
    with suppress(OSError, AttributeError):
        policy = os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
        os.sched_setscheduler(thread, policy, os.sched_param(REAL_TIME_PRIORITY))
        return Granted(real_time=True, nice=0, cores=_num_cores())
    with suppress(OSError, AttributeError):
        os.setpriority(os.PRIO_PROCESS, thread, NICE)
    nice = os.getpriority(os.PRIO_PROCESS, thread)
    return Granted(real_time=False, nice=nice, cores=_num_cores())


def request_nice() -> None:
    """Prefer the calling thread, and those that it starts, to other ordinary work.

    For the thread that uses the drivers: while it holds Python's lock and waits for a processor, no
    driver's thread can run, whatever its own priority.
    """
    with suppress(OSError, AttributeError):
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), USER_NICE)


def granted() -> Granted:
    """What ``request_priority`` would get, tried in a thread that ends at once."""
    results: list[Granted] = []
    thread = threading.Thread(target=lambda: results.append(request_priority()), daemon=True)
    thread.start()
    thread.join()
    return results[0]


def lateness_s(num_sleeps: int = 30, sleep_s: float = 0.008) -> float:
    """Longest time by which the calling thread woke too late from some short sleeps [s]."""
    worst_s = 0.0
    for _ in range(num_sleeps):
        due_s = time.monotonic() + sleep_s
        time.sleep(sleep_s)
        worst_s = max(worst_s, time.monotonic() - due_s)
    return worst_s


def _num_cores() -> int:
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not on this system
        return os.cpu_count() or 1
