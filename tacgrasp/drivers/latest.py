"""The newest item captured by one thread, for another thread that waits for a fresh one."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

from cltp.errors import TouchError

T = TypeVar("T")

STALE_MARGIN_S = 0.02
"""A reading is stale after two of its sensor's periods and this time [s]. Our choice: one lost
reading, and the longest pause that an ordinary computer makes, are no reason to stop an arm."""


class Latest(Generic[T]):
    """Holds one item; a reported failure stays for good."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._item: T | None = None
        self._failure: str | None = None

    def put(self, item: T) -> None:
        with self._changed:
            self._item = item
            self._changed.notify_all()

    def fail(self, reason: str) -> None:
        """Report that no item will follow; the first reason is kept."""
        with self._changed:
            self._failure = self._failure or reason
            self._changed.notify_all()

    def newest(self) -> T | None:
        """The present item; None before the first.

        Raises:
            TouchError: Capturing has failed.
        """
        with self._changed:
            self._check()
            return self._item

    def wait_for(self, accepts: Callable[[T], bool], timeout_s: float) -> T | None:
        """Wait for an accepted item; None if there was none within ``timeout_s`` [s].

        Raises:
            TouchError: Capturing has failed.
        """

        def accepted() -> bool:
            return self._item is not None and accepts(self._item)

        with self._changed:
            self._changed.wait_for(lambda: self._failure is not None or accepted(), timeout_s)
            self._check()
            return self._item if accepted() else None

    def _check(self) -> None:
        if self._failure is not None:
            raise TouchError(self._failure)
