"""Output that may be lost: a robot goes on, and is made safe, after ``| head`` or on a full disk.

Not here: output of commands that move nothing, which end with their reader.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO


@contextmanager
def lasting_output() -> Iterator[None]:
    """Let standard output be written to when its reader has gone, or its disk is full.

    What can't be written is lost.
    """
    before = sys.stdout
    sys.stdout = _Lasting(before)
    try:
        yield
    finally:
        sys.stdout = before


class _Lasting:
    """A text stream that leads its output nowhere once it can't be written."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        try:
            return self._stream.write(text)
        except OSError:
            self._lead_nowhere()
            return len(text)

    def flush(self) -> None:
        try:
            self._stream.flush()
        except OSError:
            self._lead_nowhere()

    def _lead_nowhere(self) -> None:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, self._stream.fileno())
        os.close(nowhere)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)
