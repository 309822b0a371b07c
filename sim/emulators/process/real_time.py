"""Real-time scheduling of an emulator's threads."""

from __future__ import annotations

import contextlib
import os

PRIORITY = 11


def request_real_time(*, inherited: bool = True) -> None:
    """Run this thread before ordinary work, where the system allows it.

    A device answers in real time; an emulated one on a busy machine would show that machine's
    pauses as its own.

    Args:
        inherited: Threads that this one starts get the same priority. Set it to False where one of
            them solves contacts.
    """
    with contextlib.suppress(OSError, AttributeError):
        reset = 0 if inherited else os.SCHED_RESET_ON_FORK
        os.sched_setscheduler(0, os.SCHED_FIFO | reset, os.sched_param(PRIORITY))
