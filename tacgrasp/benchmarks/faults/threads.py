"""Calls of the fault benchmark in threads of their own, each bounded in time.

Not here: the faults (``tacgrasp.benchmarks.faults.cases``), their injection
(``tacgrasp.benchmarks.faults.injection``).
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Generic, TypeVar

from cltp.errors import TouchError
from primitives.errors import RobotError
from tacgrasp.episodes import EpisodeError, read_episode
from tacgrasp.runtime.outcome import Outcome

T = TypeVar("T")

Episode = tuple[Outcome, Path]


class BackgroundCall(Generic[T]):
    """A call in a thread of its own, started at once.

    Attributes:
        result: Returned value; None before the end and after an error.
        error: Message of an error of a device or a record; '' without one.
        ended_s: Time of the end, monotonic [s].
    """

    def __init__(self, call: Callable[[], T]) -> None:
        self.result: T | None = None
        self.error, self.ended_s = "", float("nan")
        self._call = call
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def wait(self, seconds: float) -> bool:
        """Wait; True when the call has ended by then."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def _run(self) -> None:
        try:
            self.result = self._call()
        except (RobotError, TouchError, EpisodeError) as error:
            self.error = str(error)
        finally:
            self.ended_s = time.monotonic()


def check_episode(call: BackgroundCall[Episode], *, expect_fault: bool) -> str:
    """Read the recorded file: 'intact', or its problem."""
    if call.result is None:
        return call.error or "it did not end"
    outcome, path = call.result
    try:
        episode = read_episode(path)
    except EpisodeError as error:
        return str(error)
    if not episode.complete or episode.end is None:
        return episode.problem or "it has no end"
    reason = outcome.reason.value
    if episode.end.reason != reason or (expect_fault and reason != "fault"):
        return f"its end is {episode.end.reason}"
    return "intact"
