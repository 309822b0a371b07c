"""A thread that captures frames continuously, and counts dropped and frozen ones.

A camera keeps old frames in its buffers unless it is read continuously. A frame equal to its
predecessor in every bit is a frozen picture, since a camera has noise; it is never a new frame.
"""

from __future__ import annotations

import statistics
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cltp.errors import TouchError
from cltp.sensing.frames import Frame
from cltp.tactile.cloud import Stamp
from tacgrasp.drivers.gelsight.cameras import FrameSource, frame_problem
from tacgrasp.drivers.latest import STALE_MARGIN_S, Latest
from tacgrasp.drivers.scheduling import request_priority
from tacgrasp.drivers.stamps import real_stamp

_NUM_GAPS = 50  # intervals for the median, the camera's own interval
_MIN_GAPS = 5  # intervals from which on the median is taken
UNKNOWN_INTERVAL_S = 0.1
"""Interval that is assumed until it is known [s]: that of a slow camera in the dark."""

_LATE_FACTOR = 1.5  # an interval above so many medians means dropped frames


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameCounts:
    """Numbers of frames since the camera was opened.

    Attributes:
        frames: New frames.
        dropped: Missing frames, estimated from the gaps between frames.
        repeated: Frames equal to their predecessor.
        interval_ms: Median time between frames; NaN before the third.
    """

    frames: int
    dropped: int
    repeated: int
    interval_ms: float


@dataclass(frozen=True, slots=True)
class CapturedFrame:
    """A frame with its times.

    Attributes:
        frame: (rows, columns, 3) uint8.
        stamp: Time of arrival.
        exposed_s: Earliest start of the exposure, on the monotonic clock [s].
        problem: Reason why the frame shows no gel; empty for none.
    """

    frame: Frame
    stamp: Stamp
    exposed_s: float
    problem: str


class CaptureThread:
    """Captures frames continuously; ``latest`` holds the last one.

    Args:
        opener: Opens the source; called in the thread, which alone uses the source.
        age_s: Largest age of a frame at its arrival [s].
        pace_s: Shortest time between two frames; 0 for a camera, which has its own rate [s].
    """

    def __init__(self, opener: Callable[[], FrameSource], *, age_s: float, pace_s: float) -> None:
        self.latest: Latest[CapturedFrame] = Latest()
        self._opener, self._age_s, self._pace_s = opener, age_s, pace_s
        self._ending = threading.Event()
        self._gaps: deque[float] = deque(maxlen=_NUM_GAPS)
        self._frames = self._dropped = self._repeated = 0
        self._thread = threading.Thread(target=self._run, name="gelsight mini", daemon=True)
        self._thread.start()

    def counts(self) -> FrameCounts:
        gaps = list(self._gaps)
        return FrameCounts(
            frames=self._frames,
            dropped=self._dropped,
            repeated=self._repeated,
            interval_ms=1e3 * statistics.median(gaps) if len(gaps) > 1 else float("nan"),
        )

    @property
    def stale_s(self) -> float:
        """Age from which on the last frame is too old to move by [s]: two intervals, and 20 ms."""
        gaps = list(self._gaps)
        interval_s = statistics.median(gaps) if len(gaps) >= _MIN_GAPS else UNKNOWN_INTERVAL_S
        return 2 * interval_s + STALE_MARGIN_S

    def end(self, reason: str) -> None:
        """End the capture. A hanging camera keeps its thread, which is waited for 1 s only."""
        self.latest.fail(reason)
        self._ending.set()
        self._thread.join(timeout=1)

    def _run(self) -> None:
        request_priority()
        reason, source = "the capture ended without a reason; this is a bug", None
        try:
            source = self._opener()
            previous: CapturedFrame | None = None
            while not self._ending.is_set():
                previous = self._take(source.next_frame(), previous)
                self._ending.wait(self._pace_s)
            reason = "it is disconnected"
        except TouchError as error:
            reason = str(error)
        finally:
            self.latest.fail(reason)
            if source is not None:
                source.close()

    def _take(self, frame: Frame, previous: CapturedFrame | None) -> CapturedFrame:
        stamp = real_stamp()
        if previous is not None and np.array_equal(frame, previous.frame):
            self._repeated += 1
            return previous
        if previous is not None:
            self._count_dropped(stamp.monotonic_s - previous.stamp.monotonic_s)
        exposed_s = stamp.monotonic_s - self._age_s
        captured = CapturedFrame(frame, stamp, exposed_s, frame_problem(frame))
        self._frames += 1
        self.latest.put(captured)
        return captured

    def _count_dropped(self, gap_s: float) -> None:
        if len(self._gaps) >= _MIN_GAPS:
            usual_s = statistics.median(self._gaps)
            if gap_s > _LATE_FACTOR * usual_s:
                self._dropped += round(gap_s / usual_s) - 1
        self._gaps.append(gap_s)
