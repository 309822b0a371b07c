"""Runs the reflex beside the arm's motion, in a thread of its own, on rigs in real time.

The thread takes each new frame of the sensor as soon as it is there. When it fails it stops the
arm, again and again until the motion has ended; the motion then ends with the reflex's own error.
However the motion ends, the thread has ended before anything else is commanded.

Not here: what a frame leads to (``tacgrasp.runtime.reflex_loop``), stale readings and faults of the
gripper (``tacgrasp.rig.guard``, which watches both besides).
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from cltp.errors import TouchError
from cltp.tactile.shear.field import ShearField
from policies.reflex import MARGIN_S, PERIODS
from primitives.errors import RobotError
from tacgrasp.drivers.scheduling import request_priority
from tacgrasp.episodes.interrupts import delayed_interrupts
from tacgrasp.rig.protocols import StreamingShearSensor

POLL_S = 0.001
"""Interval at which a new frame is looked for [s]."""

AGAIN_S = 0.1
"""Interval at which a failed reflex stops the arm again, which may just be about to move [s]."""

Beat = Callable[[ShearField | None, float | None], None]
"""Called with a new frame, or None where none came in time, and when the newest was captured, on
this computer's monotonic clock [s]; None before the first."""


@contextmanager
def beside_motion(
    sensor: StreamingShearSensor, period_s: float, beat: Beat, stop: Callable[[], None]
) -> Iterator[None]:
    """Call ``beat`` for each frame while the block moves the arm or waits.

    Args:
        sensor: The sensor.
        period_s: Its period [s].
        beat: May raise, which ends the block.
        stop: Stops the arm; never raises.

    Raises:
        Exception: What ``beat`` raised, in place of the error of the motion that it ended.
    """
    ended = threading.Event()
    errors: list[Exception] = []

    def run() -> None:
        request_priority()
        try:
            for field, captured_s in _frames(sensor, period_s, ended):
                beat(field, captured_s)
        except Exception as error:
            errors.append(error)
            stop()
            while not ended.wait(AGAIN_S):
                stop()

    thread = threading.Thread(target=run, name="reflex", daemon=True)
    try:
        thread.start()  # within: Ctrl-C may come while it starts
        yield
    except (RobotError, TouchError) as error:
        _end(thread, ended)
        if errors:
            raise errors[0] from error
        raise
    finally:
        _end(thread, ended)
    if errors:
        raise errors[0]


def _end(thread: threading.Thread, ended: threading.Event) -> None:
    """Wait until a thread that may have started has ended; another Ctrl-C waits too."""
    ended.set()
    with delayed_interrupts():
        if thread.ident is not None:
            thread.join()


def _frames(
    sensor: StreamingShearSensor, period_s: float, ended: threading.Event
) -> Iterator[tuple[ShearField | None, float | None]]:
    """New frames with the time of their capture; None for each period in which all are too old."""
    stale_s = PERIODS * period_s + MARGIN_S
    captured_s: float | None = None
    known_s = time.monotonic()  # no frame is younger than its arrival, whatever its stamp says
    beat_s = -math.inf
    while not ended.wait(POLL_S):
        try:
            field = sensor.newest_shear()
        except TouchError:  # the frame shows no gel, or the sensor has failed for good
            field = None
        now_s = time.monotonic()
        at_s = None if field is None or field.stamp is None else field.stamp.monotonic_s
        if at_s is not None and at_s != captured_s:
            captured_s, known_s = at_s, min(at_s, now_s)
            yield field, at_s
        elif now_s - max(beat_s, known_s) > stale_s:
            beat_s = now_s - stale_s + period_s  # the next one a period later
            yield None, captured_s
