"""The newest of what one thread captures, for another thread that waits for something fresh.

Not here: capturing, and what makes something fresh (``taxels``, ``gelsight_mini``).
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

from cltp.errors import TouchError

T = TypeVar("T")


class Latest(Generic[T]):
    """Holds one item; a failure that was put in stays for good."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._item: T | None = None
        self._failure: str | None = None

    def put(self, item: T) -> None:
        """Replace the item."""
        with self._changed:
            self._item = item
            self._changed.notify_all()

    def fail(self, why: str) -> None:
        """Nothing will come any more; the first reason is kept."""
        with self._changed:
            self._failure = self._failure or why
            self._changed.notify_all()

    def newest(self) -> T | None:
        """The item as it is; None before the first.

        Raises:
            TouchError: Capturing has failed.
        """
        with self._changed:
            self._check()
            return self._item

    def wait_for(self, wanted: Callable[[T], bool], timeout_s: float) -> T | None:
        """The first item that is wanted; None when none came within ``timeout_s`` [s].

        Raises:
            TouchError: Capturing has failed.
        """
        with self._changed:
            self._changed.wait_for(
                lambda: (
                    self._failure is not None or (self._item is not None and wanted(self._item))
                ),
                timeout_s,
            )
            self._check()
            return self._item if self._item is not None and wanted(self._item) else None

    def _check(self) -> None:
        if self._failure is not None:
            raise TouchError(self._failure)
