"""SIGTERM and SIGHUP end a command as Ctrl-C does: with a ``KeyboardInterrupt`` in its main thread.

Without it a stopped service or a closed terminal would end the process at once, with a robot that
moves or presses. Not here: what a command does at its end.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType

STOP_SIGNALS = (signal.SIGTERM, signal.SIGHUP)


@contextmanager
def stop_signals_as_ctrl_c() -> Iterator[list[int]]:
    """Raise ``KeyboardInterrupt`` at the first SIGTERM or SIGHUP; gives the signals that came.

    Later ones are noted alone: they must not cut short how the first one ends the command. A
    signal that whoever started this program has it ignore (``nohup``) stays ignored. Only the main
    thread may take signals; in another one this does nothing.
    """
    received: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield received
        return
    terminals = [descriptor for descriptor in (1, 2) if _is_terminal(descriptor)]

    def stop(number: int, _frame: FrameType | None) -> None:
        received.append(number)
        if number == signal.SIGHUP:
            _silence(terminals)
        if len(received) == 1:
            raise KeyboardInterrupt(f"stopped by {signal.Signals(number).name}")

    taken = [number for number in STOP_SIGNALS if signal.getsignal(number) == signal.SIG_DFL]
    try:
        for number in taken:
            signal.signal(number, stop)
        yield received
    finally:
        for number in taken:
            signal.signal(number, signal.SIG_DFL)


@contextmanager
def until_ctrl_c() -> Iterator[None]:
    """End the block alone at Ctrl-C, which is its usual end; a stop signal ends the command."""
    try:
        yield
    except KeyboardInterrupt as stop:
        if str(stop):  # of a signal
            raise


def _is_terminal(descriptor: int) -> bool:
    with suppress(OSError):
        return os.isatty(descriptor)
    return False


def _silence(terminals: list[int]) -> None:
    """Lead output away from a terminal that is gone: writing to it would fail in the ending."""
    with suppress(OSError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        for descriptor in terminals:
            os.dup2(nowhere, descriptor)
        os.close(nowhere)
