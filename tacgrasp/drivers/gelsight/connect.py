"""Open and check the GelSight Mini of a rig's file, and take its background."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from cltp.errors import TouchError
from cltp.sensing.calibration import Calibration, default_calibration, load_calibration
from cltp.sensing.frames import Frame
from cltp.sensing.photometric import Photometer
from cltp.tactile.sensors import SensorSpec, sensor_named
from tacgrasp.drivers.check import Finding, finding, read_durations_ms
from tacgrasp.drivers.force_scale import force_scale_of
from tacgrasp.drivers.gelsight.background import Background, average_frames, load_background
from tacgrasp.drivers.gelsight.cameras import FrameSource, frame_problem, make_source
from tacgrasp.drivers.gelsight.capture_thread import CapturedFrame, CaptureThread
from tacgrasp.drivers.gelsight.sensor import GelSightMini
from tacgrasp.drivers.gelsight.settings import GelSightSettings

_WARM_UP = 10  # frames until a camera's exposure has settled
_CHECKS = 20

Opener = Callable[[GelSightSettings, SensorSpec], FrameSource]
Now = Callable[[], datetime.datetime]


def local_now() -> datetime.datetime:
    """Present date and time, with the time zone."""
    return datetime.datetime.now().astimezone()


def connect_gelsight(
    settings: GelSightSettings,
    *,
    now: Now = local_now,
    opener: Opener = make_source,
) -> GelSightMini:
    """Open the GelSight Mini of a rig's file and wait for its first frame.

    Calibration and background are checked first: nothing is opened with a wrong one.

    Raises:
        TouchError: Calibration or background is missing, of another unit or too old; the background
            shows no dots where the settings say so; the camera or recording is missing, can't be
            opened, or gives no frame.
    """
    sensor = sensor_named(settings.sensor)
    calibration, background = load_unit_files(settings, now())
    scale = force_scale_of(settings, lambda: now().date())
    photometer = Photometer(calibration.net, background.frame, sensor)
    open_source = partial(opener, settings, sensor)
    gelsight = GelSightMini(settings, open_source, photometer, background.frame, force_scale=scale)
    try:
        gelsight.wait_until_alive()
    except BaseException:
        gelsight.disconnect()
        raise
    return gelsight


def load_unit_files(
    settings: GelSightSettings, now: datetime.datetime
) -> tuple[Calibration, Background]:
    """Read calibration and background of a rig's file.

    Raises:
        TouchError: A file is missing, damaged, of another unit, or, for a camera, too old.
    """
    sensor = sensor_named(settings.sensor)
    if settings.calibration == "shipped":
        calibration = load_calibration(default_calibration(sensor), sensor)
    else:
        calibration = load_calibration(settings.calibration, sensor, unit=settings.unit)
        age_days = calibration.age_days(now.date())
        if settings.is_camera and not 0 <= age_days <= settings.max_calibration_age_days:
            raise TouchError(
                f"calibration {settings.calibration} is {age_days} days old, expected 0 to "
                f"{settings.max_calibration_age_days:g} (max_calibration_age_days): calibrate this "
                "unit anew: tacgrasp calibrate gelsight-mini; if it is new, set the clock"
            )
    background = load_background(
        settings.background,
        sensor,
        unit=settings.unit,
        max_age_h=settings.max_background_age_h,
        now=now,
        dated=settings.is_camera,
    )
    return calibration, background


def take_background(
    settings: GelSightSettings,
    *,
    num_frames: int = 20,
    now: Now = local_now,
    opener: Opener = make_source,
) -> Background:
    """Average frames of the gel, which nothing may touch, for ``save_background``.

    Raises:
        TouchError: The source can't be read, shows no gel, or the picture isn't still.
    """
    sensor = sensor_named(settings.sensor)
    open_source = partial(opener, settings, sensor)
    if settings.is_camera:
        frames = _camera_frames(settings, open_source, num_frames)
    else:
        source = open_source()
        try:
            frames = [_good_frame(source, settings) for _ in range(num_frames)]
        finally:
            source.close()
    return average_frames(frames, sensor, settings.unit, now())


def _good_frame(source: FrameSource, settings: GelSightSettings) -> Frame:
    """The next image of a recording; a camera's are checked as they come."""
    frame = source.next_frame()
    if problem := frame_problem(frame):
        raise TouchError(f"{settings.source}: {problem}; no background was taken")
    return frame


def _camera_frames(
    settings: GelSightSettings, open_source: Callable[[], FrameSource], num_frames: int
) -> list[Frame]:
    """Successive frames of a camera, without its first ones."""
    thread = CaptureThread(open_source, age_s=0.0, pace_s=0.0)
    frames: list[Frame] = []
    last_s, timeout_s = -np.inf, settings.connect_timeout_s
    try:
        for number in range(_WARM_UP + num_frames):
            captured = thread.latest.wait_for(partial(_is_after, last_s), timeout_s)
            if captured is None or captured.problem:
                reason = captured.problem if captured else f"no frame within {timeout_s:g} s"
                raise TouchError(f"{settings.source}: {reason}; no background was taken")
            last_s, timeout_s = captured.stamp.monotonic_s, settings.read_timeout_s
            if number >= _WARM_UP:
                frames.append(captured.frame)
    finally:
        thread.end(f"{settings.source}: the background was taken")
    return frames


def _is_after(time_s: float, captured: CapturedFrame) -> bool:
    return captured.stamp.monotonic_s > time_s


def check(
    settings: GelSightSettings, *, now: Now = local_now, opener: Opener = make_source
) -> Sequence[Finding]:
    """Check the sensor for ``tacgrasp doctor``; nothing may touch the gel of a camera."""
    try:
        calibration, background = load_unit_files(settings, now())
    except TouchError as error:
        advice = "make or name the right file; see docs/hardware.md"
        return [_finding("calibration and background", False, str(error), advice)]
    findings = _file_findings(settings, calibration, background, now())
    try:
        sensor = connect_gelsight(settings, now=now, opener=opener)
    except TouchError as error:
        advice = "check cable and device; another program may have the camera"
        return [*findings, _finding("connection", False, str(error), advice)]
    try:
        connection = _finding("connection", True, settings.source)
        return [*findings, connection, _read_finding(sensor, settings)]
    finally:
        sensor.disconnect()


def _file_findings(
    settings: GelSightSettings,
    calibration: Calibration,
    background: Background,
    now: datetime.datetime,
) -> list[Finding]:
    detail = f"{calibration.age_days(now.date())} days old, unit {calibration.unit}"
    if settings.calibration == "shipped":
        detail += ": not this unit's, so heights are rough; tacgrasp calibrate gelsight-mini"
    age_h = background.age_h(now)
    age = "no date" if age_h is None else f"{age_h:.1f} h old, {background.num_frames} frames"
    return [_finding("calibration", True, detail), _finding("background", True, age)]


def _read_finding(sensor: GelSightMini, settings: GelSightSettings) -> Finding:
    num_reads = _CHECKS if settings.is_camera or settings.repeat else 1
    try:
        p50, p99, _ = read_durations_ms(sensor.read, num_reads)
        sensor.expect_untouched()
    except TouchError as error:
        return _finding("reads", False, str(error), "correct the error, then check again")
    counts, shear = sensor.counts(), sensor.last_shear()
    too_many_dropped = counts is not None and counts.dropped > 0.05 * counts.frames + 1
    rate = "" if counts is None else (
        f"; {counts.frames} frames, {counts.dropped} dropped, {counts.repeated} repeated, every "
        f"{counts.interval_ms:.0f} ms"
    )  # fmt: skip
    detail = f"p50 {p50:.0f}, p99 {p99:.0f} ms{rate}"
    if shear is not None:
        detail += f"; shear at {len(shear.positions_mm)} points"
    advice = "plug it into a USB port of its own"
    return _finding("fresh cloud", not too_many_dropped, detail, advice)


_finding = partial(finding, "sensor")
