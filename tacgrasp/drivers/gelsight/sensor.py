"""A connected GelSight Mini: frames in, clouds out by ``cltp.sensing.photometric``.

A read takes the first frame whose exposure began after the call. A gel with dots gives shear fields
too, by ``cltp.sensing.marker_field``.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from cltp.errors import TouchError
from cltp.sensing.calibration import WITHOUT_DOTS
from cltp.sensing.frames import Frame
from cltp.sensing.marker_dots import Dots, mean_dots
from cltp.sensing.marker_field import MarkerReader
from cltp.sensing.photometric import FloatArray, Photometer
from cltp.tactile.cloud import TactileCloud, cloud_of_pixels
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField
from tacgrasp.drivers.gelsight.background import check_still, mismatch
from tacgrasp.drivers.gelsight.cameras import FrameSource, frame_problem
from tacgrasp.drivers.gelsight.capture_thread import CapturedFrame, CaptureThread, FrameCounts
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.drivers.stamps import real_stamp

REFERENCE_FRAMES = 5
"""Frames that a reference is the mean of. Our choice: its noise is less than half that of a frame,
and a camera of 25 frames a second gives them in 0.3 s."""

FOLLOWED_S = 0.2
"""Age up to which the dots of a frame are where those of a later one are looked for [s]. Our
choice: five frames, in which they move by less than half of their pitch."""


class GelSightMini:
    """A connected GelSight Mini, or a recording of one; a ``rig.protocols.WatchedSensor``.

    Of a gel with dots it is a ``StreamingShearSensor`` that has something to stream.

    A read raises ``TouchError`` when the camera is unplugged or disconnected, the recording has
    ended, no frame was exposed after the call within the time-out, or the frame shows no gel
    (black, over-exposed) or belongs to another background.

    Args:
        settings: The sensor's section of the rig's file.
        opener: Opens the source of frames.
        photometer: Photometer of the unit's calibration and stored background.
        background: The same background.
        force_scale: Force scale of the unit.

    Raises:
        TouchError: The background lacks the dots that the settings promise, or a recording can't be
            opened. A camera is opened in its thread, and ``wait_until_alive`` raises its error.
    """

    def __init__(
        self,
        settings: GelSightSettings,
        opener: Callable[[], FrameSource],
        photometer: Photometer,
        background: Frame,
        *,
        force_scale: ForceScale = UNCALIBRATED,
    ) -> None:
        self._settings, self._background = settings, background
        self._stored_photometer = self._photometer = photometer
        self._force_scale = force_scale
        self._stored_markers = self._markers = (
            self._marker_reader(background) if self.spec.name in WITHOUT_DOTS else None
        )
        self._followed: tuple[CapturedFrame, Dots] | None = None
        self._newest: tuple[CapturedFrame, MarkerReader, ShearField] | None = None
        self._last_shear: ShearField | None = None
        self._disconnected = False
        self._last_frame: Frame | None = None
        self._source: FrameSource | None = None
        self._thread: CaptureThread | None = None
        if settings.is_camera or settings.play_hz is not None:
            self._thread = CaptureThread(
                opener,
                age_s=settings.frame_age_s if settings.is_camera else 0.0,
                pace_s=0.0 if settings.play_hz is None else 1 / settings.play_hz,
            )
        else:
            self._source = opener()

    @property
    def spec(self) -> SensorSpec:
        return self._photometer.sensor

    def counts(self) -> FrameCounts | None:
        """Numbers of frames so far; None for a recording that gives one image for each read."""
        return None if self._thread is None else self._thread.counts()

    def wait_until_alive(self) -> None:
        """Wait for the first frame that shows a gel; called by ``connect_gelsight``.

        A camera's first frames may be dark, until it has set its exposure.

        Raises:
            TouchError: No such frame in time, or the source can't be opened.
        """
        if self._thread is None:
            return
        timeout_s, latest = self._settings.connect_timeout_s, self._thread.latest
        if latest.wait_for(lambda captured: not captured.problem, timeout_s) is None:
            newest = latest.newest()
            if newest is None:
                raise TouchError(self._no_frame_message(timeout_s))
            self._check(newest)

    def read(self, frames: int = 1) -> TactileCloud:
        """See the contract; heights are relative to the last reference, else to the background."""
        captured = self._fresh_frame()
        self._last_frame = captured.frame
        try:
            seen = [self._seen(captured)]
            num_frames = frames if self._settings.is_camera else 1
            for _ in range(num_frames - 1):
                captured = self._frame_after(captured)
                seen.append(self._seen(captured))
            heights = np.mean([each for each, _ in seen], axis=0)
            if self._markers is not None:
                dots = mean_dots([each for _, each in seen if each is not None])
                self._last_shear = self._markers.field(dots, heights, stamp=captured.stamp)
            return cloud_of_pixels(
                heights, self.spec, stamp=captured.stamp, force_scale=self._force_scale
            )
        except TouchError as error:
            raise TouchError(f"{self._settings.source}: {error}") from None

    def _seen(self, captured: CapturedFrame) -> tuple[FloatArray, Dots | None]:
        """Heights of a frame, and its dots where the gel has any."""
        if self._markers is None:
            return self._photometer.heights(captured.frame), None
        dots = self._dots(captured, self._markers)
        return self._markers.heights(captured.frame, dots), dots

    def _dots(self, captured: CapturedFrame, markers: MarkerReader) -> Dots:
        followed = self._followed
        before = None
        if followed is not None and self._thread is not None:  # images may be of many contacts
            since_s = captured.stamp.monotonic_s - followed[0].stamp.monotonic_s
            before = followed[1] if abs(since_s) < FOLLOWED_S else None
        dots = markers.follow(captured.frame, before)
        self._followed = captured, dots
        return dots

    def last_shear(self) -> ShearField | None:
        """The shear field of the frames that the last cloud came from; None of a gel without dots.

        Of a recording, relative to its background.
        """
        return self._last_shear

    def newest_shear(self) -> ShearField | None:
        """The shear field of the newest frame, at once; the same object while none is newer.

        None of a gel without dots, and of a recording that gives one image for each read.

        Raises:
            TouchError: As ``read``, but for the wait.
        """
        thread, markers = self._thread, self._markers
        captured = None if thread is None else thread.latest.newest()
        if markers is None or captured is None:
            return None
        self._check(captured)
        newest = self._newest  # a reference may be taken meanwhile, in another thread
        if newest is None or newest[0] is not captured or newest[1] is not markers:
            try:
                dots = self._dots(captured, markers)
                heights = markers.coarse_heights(captured.frame, dots)
                field = markers.field(dots, heights, stamp=captured.stamp)
            except TouchError as error:
                raise TouchError(f"{self._settings.source}: {error}") from None
            self._newest = newest = captured, markers, field
        return newest[2]

    def last_frame(self) -> Frame | None:
        """The frame that the last cloud was computed from; None before the first read."""
        return self._last_frame

    def take_reference(self) -> None:
        """Compute heights against the mean of ``REFERENCE_FRAMES`` fresh frames from now on.

        The stored background is kept, and ``expect_untouched`` still compares with it. Does nothing
        for a recording, whose frames belong to its own background.

        Raises:
            TouchError: As ``read``; or the picture is not still. The old reference stays.
        """
        if not self._settings.is_camera:
            self._check_connected()
            return
        captured = self._fresh_frame()
        frames = [captured.frame]
        while len(frames) < REFERENCE_FRAMES:
            captured = self._frame_after(captured)
            frames.append(captured.frame)
        try:
            check_still(frames)
            mean = np.rint(np.mean(frames, axis=0)).astype(np.uint8)
            self._stored_photometer.check_background(mean)
            if self._stored_markers is not None:
                self._markers = self._marker_reader(mean)
                self._followed = None
            self._photometer = self._stored_photometer.with_background(mean)
        except TouchError as error:
            raise TouchError(f"{self._settings.source}: {error}") from None

    def expect_untouched(self) -> None:
        """Compare the gel with the stored background; call it when nothing touches the gel.

        Does nothing for a recording, because a comparison would use up one of its frames.

        Raises:
            TouchError: As ``read``; or the gel is touched, dirty or damaged, or the background is
                stale.
        """
        if not self._settings.is_camera:
            return
        frame, background = self._fresh_frame().frame, self._background
        if self._stored_markers is not None:  # dots may move by a pixel: their edges are left out
            frame, background = map(self._stored_markers.without_dots, (frame, background))
        if reason := mismatch(frame, background):
            raise TouchError(f"{self._settings.source}: {reason}")

    def check_alive(self) -> str:
        if self._thread is None:
            self._check_connected()
            return ""
        newest, stale_s = self._thread.latest.newest(), self._thread.stale_s
        if newest is None or self._age_s(newest) > stale_s:
            return self._no_frame_message(stale_s)
        self._check(newest)
        return ""

    def disconnect(self) -> None:
        self._disconnected = True
        if self._thread is not None:
            self._thread.end(f"{self._settings.source}: disconnected; connect it again to read")
        if self._source is not None:
            self._source.close()

    def _marker_reader(self, background: Frame) -> MarkerReader:
        return MarkerReader(self._stored_photometer, background, self.spec)

    def _fresh_frame(self) -> CapturedFrame:
        called_s = time.monotonic()
        if self._source is not None:
            self._check_connected()
            captured = self._next_recorded(self._source)
            self._check(captured)
            return captured
        return self._captured(lambda frame: frame.exposed_s >= called_s)

    def _frame_after(self, previous: CapturedFrame) -> CapturedFrame:
        """The first frame that a camera captured after another one."""
        return self._captured(lambda frame: frame.exposed_s > previous.exposed_s)

    def _captured(self, accepts: Callable[[CapturedFrame], bool]) -> CapturedFrame:
        thread, timeout_s = self._thread, self._settings.read_timeout_s
        captured = None if thread is None else thread.latest.wait_for(accepts, timeout_s)
        if captured is None:
            raise TouchError(self._no_frame_message(timeout_s))
        self._check(captured)
        return captured

    def _next_recorded(self, source: FrameSource) -> CapturedFrame:
        frame, stamp = source.next_frame(), real_stamp()
        return CapturedFrame(frame, stamp, stamp.monotonic_s, frame_problem(frame))

    def _check(self, captured: CapturedFrame) -> None:
        if captured.problem:
            raise TouchError(f"{self._settings.source}: {captured.problem}")

    def _check_connected(self) -> None:
        if self._disconnected:
            raise TouchError(f"{self._settings.source}: disconnected; connect it again to read")

    def _age_s(self, captured: CapturedFrame) -> float:
        return time.monotonic() - captured.stamp.monotonic_s

    def _no_frame_message(self, waited_s: float) -> str:
        thread, source = self._thread, self._settings.source
        newest = None if thread is None else thread.latest.newest()
        if thread is None or newest is None:
            return (
                f"{source} gave no frame within {waited_s:g} s; expected 25 a second: unplug it, "
                "plug it in again, and look whether another program has it"
            )
        frozen = ""
        if repeated := thread.counts().repeated:
            frozen = f"; {repeated} frames were equal to the one before: its picture is frozen"
        return (
            f"{source} gave no fresh frame within {waited_s:g} s; the last one is "
            f"{self._age_s(newest):.2f} s old{frozen}; unplug the camera and plug it in again"
        )
