"""Intervals between the frames of a taxel array, by its own clock and by this computer's.

A frame that arrives late was captured late, or was only delivered late. The array's own clock,
which each frame carries, tells the two apart.

Not here: the packets (``cltp.sensing.taxel_packets``).
"""

from __future__ import annotations

import statistics
from collections import deque

from cltp.sensing.taxel_packets import TaxelFrame
from tacgrasp.drivers.latest import STALE_MARGIN_S

UNKNOWN_INTERVAL_S = 0.05
"""Interval that is assumed until the array's own is known [s]: 20 frames a second."""

_NUM_INTERVALS = 25
_MIN_INTERVALS = 5
_WRAP = 2**32
_LONGEST_S = 1.0  # longer ones are restarts of the array's clock, or pauses


class FrameIntervals:
    """The array's interval, and the long gaps between its frames.

    Attributes:
        stalls: Gaps in which the array itself paused.
        delays_here: Gaps in which it did not: its frames were delivered or read late.
    """

    def __init__(self) -> None:
        self.stalls = self.delays_here = 0
        self._intervals_s: deque[float] = deque(maxlen=_NUM_INTERVALS)
        self._previous: tuple[TaxelFrame, float] | None = None

    @property
    def stale_s(self) -> float:
        """Age from which on the last frame is too old to move by [s]: two intervals, and 20 ms."""
        intervals_s = list(self._intervals_s)
        known = len(intervals_s) >= _MIN_INTERVALS
        interval_s = statistics.median(intervals_s) if known else UNKNOWN_INTERVAL_S
        return 2 * interval_s + STALE_MARGIN_S

    def add(self, frame: TaxelFrame, arrived_s: float) -> None:
        """Note a new frame and the time of its arrival, monotonic [s]."""
        previous, self._previous = self._previous, (frame, arrived_s)
        if previous is None:
            return
        earlier, earlier_s = previous
        num_frames = (frame.sequence - earlier.sequence) % _WRAP
        captured_s = 1e-6 * (frame.clock_us - earlier.clock_us)
        if arrived_s - earlier_s > self.stale_s:
            if captured_s > self.stale_s:
                self.stalls += 1
            else:
                self.delays_here += 1
        if 0 < num_frames < _NUM_INTERVALS and 0 < captured_s < _LONGEST_S:
            self._intervals_s.append(captured_s / num_frames)
