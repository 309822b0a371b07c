"""A connected GelSight Mini: frames in, clouds out by ``cltp.sensing.photometric``.

A read takes the first frame that arrived so long after the call that its exposure began after it.

Not here: opening and checking the one of a rig's file (``gelsight_mini``), where frames come from
(``gelsight_sources``), their thread (``gelsight_thread``), backgrounds (``gelsight_background``).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cltp.errors import TouchError
from cltp.sensing.frames import Frame
from cltp.sensing.photometric import Photometer
from cltp.tactile.cloud import Stamp, TactileCloud, cloud_from_heights
from cltp.tactile.sensors import SensorSpec
from tacgrasp.drivers.gelsight.background import mismatch
from tacgrasp.drivers.gelsight.cameras import FrameSource, frame_problem
from tacgrasp.drivers.gelsight.capture_thread import Captured, FrameCounts, FrameThread
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.drivers.stamps import real_stamp


class GelSightMini:
    """A connected GelSight Mini, or a recording of one; a ``TactileSensor``.

    Args:
        settings: Of the rig's file.
        opener: Opens the source of frames.
        photometer: Of its calibration and background.
        background: The same background.
        rng: Jitters the points in their cells; None puts them at the cells' centres.
        stamp: Both clocks.

    Raises:
        TouchError: A recording can't be opened. A camera is opened in its thread:
            ``wait_until_alive`` says what became of it.
    """

    def __init__(
        self,
        settings: GelSightSettings,
        opener: Callable[[], FrameSource],
        photometer: Photometer,
        background: Frame,
        *,
        rng: np.random.Generator | None = None,
        stamp: Callable[[], Stamp] = real_stamp,
    ) -> None:
        self._settings, self._photometer, self._background = settings, photometer, background
        self._rng, self._stamp = rng, stamp
        self._disconnected = False
        self._source: FrameSource | None = None
        self._thread: FrameThread | None = None
        if settings.is_camera or settings.play_hz is not None:
            self._thread = FrameThread(
                opener,
                age_s=settings.frame_age_s if settings.is_camera else 0.0,
                pace_s=0.0 if settings.play_hz is None else 1 / settings.play_hz,
                stamp=stamp,
            )
        else:
            self._source = opener()

    @property
    def spec(self) -> SensorSpec:
        """Which sensor this is."""
        return self._photometer.sensor

    def counts(self) -> FrameCounts | None:
        """What has come so far; None for a recording that gives one image for each read."""
        return None if self._thread is None else self._thread.counts()

    def wait_until_alive(self) -> None:
        """Wait for the first frame that shows a gel; ``connect_gelsight`` has done it.

        A camera's very first frames may be dark: it is given the time to set its exposure.

        Raises:
            TouchError: None came in time, or the source can't be opened.
        """
        if self._thread is None:
            return
        within_s, latest = self._settings.connect_timeout_s, self._thread.latest
        if latest.wait_for(lambda one: not one.problem, within_s) is None:
            newest = latest.newest()
            if newest is None:
                raise TouchError(self._why_none(within_s))
            self._check(newest)

    def read(self) -> TactileCloud:
        """Capture the gel now.

        Raises:
            TouchError: Unplugged, disconnected, the recording has ended, no frame exposed after
                the call within the time-out, a frame without a gel (black, over-exposed), or one
                that the background doesn't belong to.
        """
        captured = self._fresh_frame()
        try:
            heights = self._photometer.heights(captured.frame)
            return cloud_from_heights(heights, self.spec, rng=self._rng, stamp=captured.stamp)
        except TouchError as error:
            raise TouchError(f"{self._settings.source}: {error}") from None

    def fresh_frame(self) -> Frame:
        """A frame exposed after the call, for backgrounds and calibrations. Raises as ``read``."""
        return self._fresh_frame().frame

    def expect_untouched(self) -> None:
        """Compare the gel with the background; call it when nothing touches the gel.

        A recording is left alone: it plays touches, and none of them may be used up.

        Raises:
            TouchError: As ``read``; or the gel is touched, dirty or damaged, or the background is
                stale.
        """
        if not self._settings.is_camera:
            return
        why = mismatch(self._fresh_frame().frame, self._background)
        if why:
            raise TouchError(f"{self._settings.source}: {why}")

    def check_alive(self) -> None:
        """Return at once when frames are coming; for whoever watches while the arm moves.

        Raises:
            TouchError: Unplugged, disconnected, no frame for ``stale_s``, or the last one shows no
                gel.
        """
        if self._thread is None:
            self._check_connected()
            return
        newest = self._thread.latest.newest()
        if newest is None or self._age_s(newest) > self._settings.stale_s:
            raise TouchError(self._why_none(self._settings.stale_s))
        self._check(newest)

    def disconnect(self) -> None:
        """Free the camera. Idempotent, never raises."""
        self._disconnected = True
        if self._thread is not None:
            self._thread.end(f"{self._settings.source}: disconnected; connect it again to read")
        if self._source is not None:
            self._source.close()

    def _fresh_frame(self) -> Captured:
        called_s = self._stamp().monotonic_s
        if self._source is not None:
            self._check_connected()
            captured = self._next_recorded(self._source)
        elif self._thread is not None:
            wanted = self._thread.latest.wait_for(
                lambda one: one.begun_s >= called_s, self._settings.read_timeout_s
            )
            if wanted is None:
                raise TouchError(self._why_none(self._settings.read_timeout_s))
            captured = wanted
        self._check(captured)
        return captured

    def _next_recorded(self, source: FrameSource) -> Captured:
        frame, stamp = source.next_frame(), self._stamp()
        return Captured(
            frame=frame, stamp=stamp, begun_s=stamp.monotonic_s, problem=frame_problem(frame)
        )

    def _check(self, captured: Captured) -> None:
        if captured.problem:
            raise TouchError(f"{self._settings.source}: {captured.problem}")

    def _check_connected(self) -> None:
        if self._disconnected:
            raise TouchError(f"{self._settings.source}: disconnected; connect it again to read")

    def _age_s(self, captured: Captured) -> float:
        return self._stamp().monotonic_s - captured.stamp.monotonic_s

    def _why_none(self, waited_s: float) -> str:
        thread, source = self._thread, self._settings.source
        newest = None if thread is None else thread.latest.newest()
        if thread is None or newest is None:
            return (
                f"{source} gave no frame within {waited_s:g} s; expected 25 a second: unplug it, "
                "plug it in again, and look whether another program has it"
            )
        repeated = thread.counts().repeated
        frozen = (
            f"; {repeated} frames were equal to the one before: its picture is frozen"
            if repeated
            else ""
        )
        return (
            f"{source} gave no fresh frame within {waited_s:g} s; the last one is "
            f"{self._age_s(newest):.2f} s old{frozen}; unplug the camera and plug it in again"
        )
