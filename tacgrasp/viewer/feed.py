"""Steps on their way to a viewer, so that the loop never waits for it.

The loop hands over a reference; a thread draws. When the viewer is slower than the loop, the oldest
steps that wait are left out and counted.
"""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable

from tacgrasp.episodes.record import StepRecord

log = logging.getLogger(__name__)

WAITING = 8
"""Most steps that wait to be drawn. Our choice: seconds of a run, a few megabytes."""


class Feed:
    """Draws steps in a thread of its own; an ``Observer`` of the loop.

    Attributes:
        num_dropped: Steps that were left out.

    Args:
        draw: Draws one step; an error of it ends the drawing, not the run.
    """

    def __init__(self, draw: Callable[[StepRecord], None]) -> None:
        self._draw = draw
        self._waiting: deque[StepRecord] = deque()
        self._changed = threading.Condition()
        self._ended = False
        self.num_dropped = 0
        self._thread = threading.Thread(target=self._run, name="viewer", daemon=True)
        self._thread.start()

    def __call__(self, record: StepRecord) -> None:
        """Hand over a step; returns at once."""
        with self._changed:
            if len(self._waiting) >= WAITING:
                self._waiting.popleft()
                self.num_dropped += 1
            self._waiting.append(record)
            self._changed.notify()

    def close(self, timeout_s: float = 5.0) -> None:
        """Draw what still waits, at most for ``timeout_s``, and end."""
        with self._changed:
            self._ended = True
            self._changed.notify()
        self._thread.join(timeout_s)

    def _run(self) -> None:
        while True:
            with self._changed:
                while not self._waiting and not self._ended:
                    self._changed.wait()
                if not self._waiting:
                    return
                record = self._waiting.popleft()
            try:
                self._draw(record)
            except Exception:
                log.exception("the viewer has failed; the run goes on without it")
                return
