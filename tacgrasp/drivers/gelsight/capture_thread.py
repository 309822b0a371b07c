"""One thread that captures frames all the time, and counts those that are missing or frozen.

A camera that is not read keeps old frames in its buffers; so it is read all the time. Frames equal
to the one before to the last bit are none: a camera has noise, so they are a frozen picture, and
are never taken for a new touch.

Not here: what becomes of frames (``gelsight_sensor``), where they come from (``gelsight_sources``).
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
from tacgrasp.drivers.latest import Latest

_GAPS = 50  # intervals whose median is the camera's own
_LATE = 1.5  # times that median, and a frame has been dropped


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameCounts:
    """What has come since the camera was opened.

    Attributes:
        frames: New ones.
        dropped: That should have come, from the gaps between those that did.
        repeated: Equal to the one before.
        interval_ms: Median time between frames; NaN before the third.
    """

    frames: int
    dropped: int
    repeated: int
    interval_ms: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Captured:
    """A frame.

    Attributes:
        frame: (rows, columns, 3) uint8.
        stamp: Measured when it had arrived.
        begun_s: Its exposure began then or later, on the monotonic clock [s].
        problem: Why it shows no gel; empty when it may.
    """

    frame: Frame
    stamp: Stamp
    begun_s: float
    problem: str


class FrameThread:
    """Captures all the time; what it captured last is ``latest``.

    Args:
        opener: Opens the source; called in the thread, which alone uses it.
        age_s: How old a frame can be when it arrives [s].
        pace_s: Shortest time between two frames; 0 for a camera, which has its own [s].
        stamp: Both clocks.
    """

    def __init__(
        self,
        opener: Callable[[], FrameSource],
        *,
        age_s: float,
        pace_s: float,
        stamp: Callable[[], Stamp],
    ) -> None:
        self.latest: Latest[Captured] = Latest()
        self._opener, self._age_s, self._pace_s, self._stamp = opener, age_s, pace_s, stamp
        self._ending = threading.Event()
        self._gaps: deque[float] = deque(maxlen=_GAPS)
        self._frames = self._dropped = self._repeated = 0
        self._thread = threading.Thread(target=self._run, name="gelsight mini", daemon=True)
        self._thread.start()

    def counts(self) -> FrameCounts:
        """What has come so far."""
        gaps = list(self._gaps)
        return FrameCounts(
            frames=self._frames,
            dropped=self._dropped,
            repeated=self._repeated,
            interval_ms=1e3 * statistics.median(gaps) if len(gaps) > 1 else float("nan"),
        )

    def end(self, why: str) -> None:
        """Capture no more. A camera that hangs keeps its thread, but nobody waits for it long."""
        self.latest.fail(why)
        self._ending.set()
        self._thread.join(timeout=1)

    def _run(self) -> None:
        why, source = "the capture ended without a reason; this is a bug", None
        try:
            source = self._opener()
            before: Captured | None = None
            while not self._ending.is_set():
                frame = source.next_frame()
                before = self._take(frame, before)
                self._ending.wait(self._pace_s)
            why = "it is disconnected"
        except TouchError as error:
            why = str(error)
        finally:
            self.latest.fail(why)
            if source is not None:
                source.close()

    def _take(self, frame: Frame, before: Captured | None) -> Captured:
        stamp = self._stamp()
        if before is not None and np.array_equal(frame, before.frame):
            self._repeated += 1
            return before
        if before is not None:
            self._count_dropped(stamp.monotonic_s - before.stamp.monotonic_s)
        captured = Captured(
            frame=frame,
            stamp=stamp,
            begun_s=stamp.monotonic_s - self._age_s,
            problem=frame_problem(frame),
        )
        self._frames += 1
        self.latest.put(captured)
        return captured

    def _count_dropped(self, gap_s: float) -> None:
        if len(self._gaps) >= 5:
            usual_s = statistics.median(self._gaps)
            if gap_s > _LATE * usual_s:
                self._dropped += round(gap_s / usual_s) - 1
        self._gaps.append(gap_s)
