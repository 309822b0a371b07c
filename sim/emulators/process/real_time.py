"""Devices run in real time; their emulators ask for as much, thread by thread."""

from __future__ import annotations

import contextlib
import os

PRIORITY = 11


def ask_for_real_time(*, with_threads: bool = True) -> None:
    """Let this thread run before ordinary work, where the system allows it.

    A device answers in real time; an emulated one on a busy machine would show that machine's
    pauses as its own.

    Args:
        with_threads: Whether threads that it starts run as it does: not where one of them solves
            contacts.
    """
    with contextlib.suppress(OSError, AttributeError):
        alone = 0 if with_threads else os.SCHED_RESET_ON_FORK
        os.sched_setscheduler(0, os.SCHED_FIFO | alone, os.sched_param(PRIORITY))
