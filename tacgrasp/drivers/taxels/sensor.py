"""An open serial taxel array: packets of displacements in, clouds and shear fields out.

The array streams. A read sends a mark and waits for the first frame that repeats the mark: the
capture of that frame began after the call, whatever the clocks. Older, damaged and repeated frames
are never returned.

Not here: opening the port (``connect``), the packets (``cltp.sensing.taxel_packets``), the emulated
array (``sim.emulators.taxels.array``).
"""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from cltp.errors import TouchError
from cltp.sensing.taxel_packets import (
    DISPLACEMENTS,
    HEIGHTS,
    PacketParser,
    SequenceCount,
    TaxelFrame,
    encode_mark,
)
from cltp.sensing.touch_files import ASPECT_TOLERANCE
from cltp.tactile.cloud import FloatArray, Stamp, TactileCloud, cloud_of_pixels
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.shear.field import ShearField
from tacgrasp.drivers.check import EMULATOR_ADVICE
from tacgrasp.drivers.latest import STALE_MARGIN_S, Latest
from tacgrasp.drivers.scheduling import request_priority
from tacgrasp.drivers.stamps import real_stamp
from tacgrasp.drivers.taxels.displacements import displacement_mm, problem_of, shear_of
from tacgrasp.drivers.taxels.intervals import FrameIntervals
from tacgrasp.drivers.taxels.settings import TaxelSettings

if TYPE_CHECKING:
    from serial import Serial

REFERENCE_FRAMES = 5
"""Frames that a reference is the mean of. Our choice: its noise is less than half that of a frame,
and an array of 30 frames a second gives them in 0.3 s."""

_MARK_GAP = 1000
_NUM_SENDS = 2  # per mark: a mark damaged on the line costs half of the time-out, not the read


@dataclass(frozen=True, slots=True, kw_only=True)
class LineCounts:
    """Numbers of frames on the line since it was opened.

    Attributes:
        frames: Whole, new frames.
        damaged: Frames that are torn or have a wrong checksum.
        missing: Sequence numbers that never arrived.
        repeated: Frames that arrived twice; the second is dropped.
        restarts: Restarts of the array.
        garbage_bytes: Bytes that belong to no packet.
        stalls: Gaps between frames in which the array itself paused, by its own clock.
        delays_here: Gaps in which the array went on: this computer, or the line, was late.
    """

    frames: int
    damaged: int
    missing: int
    repeated: int
    restarts: int
    garbage_bytes: int
    stalls: int
    delays_here: int


class _StampedFrame(NamedTuple):
    frame: TaxelFrame
    stamp: Stamp
    problem: str


class TaxelArray:
    """An open array; a ``rig.protocols.WatchedSensor``. One thread reads the port.

    A read raises ``TouchError`` when the array is unplugged or disconnected, no frame was captured
    after the call within the time-out, the frame shows no gel, or it has another grid than the
    reference. Displacements are relative to the last reference, if there was one.

    Args:
        port: Open and claimed port; closed by the array.
        settings: The sensor's section of the rig's file.
        force_scale: Force scale of the unit.
    """

    def __init__(
        self,
        port: Serial,
        settings: TaxelSettings,
        *,
        force_scale: ForceScale = UNCALIBRATED,
    ) -> None:
        self._port, self._settings = port, settings
        self._force_scale = force_scale
        self._spec = sensor_named(settings.sensor)
        self._latest: Latest[_StampedFrame] = Latest()
        self._parser, self._numbers = PacketParser(), SequenceCount()
        self._intervals = FrameIntervals()
        self._ending = threading.Event()
        self._sending = threading.Lock()
        self._mark = 0
        self._reference_mm: FloatArray | None = None
        self._last_shear: ShearField | None = None
        self._newest: tuple[_StampedFrame, ShearField | None] | None = None
        self._opened_s = time.monotonic()
        self._thread = threading.Thread(target=self._capture, name="taxel array", daemon=True)
        self._thread.start()

    @property
    def spec(self) -> SensorSpec:
        return self._spec

    def counts(self) -> LineCounts:
        wire, numbers = self._parser.counts, self._numbers
        return LineCounts(
            frames=wire.packets - numbers.repeated,
            damaged=wire.damaged,
            missing=numbers.missing,
            repeated=numbers.repeated,
            restarts=numbers.restarts,
            garbage_bytes=wire.garbage_bytes,
            stalls=self._intervals.stalls,
            delays_here=self._intervals.delays_here,
        )

    def wait_until_alive(self) -> None:
        """Wait for the first whole frame; called by ``connect_taxels``.

        Raises:
            TouchError: No frame in time, or its grid does not fit the sensor.
        """
        first = self._latest.wait_for(lambda _: True, self._settings.connect_timeout_s)
        if first is None:
            raise self._no_frame_error(self._settings.connect_timeout_s)
        self._check_grid(*first.frame.counts_um.shape)
        with self._sending:  # far from any mark of another program that is still on the line
            self._mark = (first.frame.mark + _MARK_GAP) % 2**32

    def _check_grid(self, rows: int, columns: int) -> None:
        spec = self._spec
        expected = f"the sensing area of {spec.name} ({spec.rows} × {spec.columns} px, or the same "
        expected += "aspect; at least 8 × 8)"
        aspect = columns / rows / (spec.columns / spec.rows)
        fits = min(rows, columns) >= 8 and abs(aspect - 1) <= ASPECT_TOLERANCE
        if spec.markers is not None:
            fits, expected = (rows, columns) == spec.markers, f"the taxels of {spec.name}"
            expected += f" ({spec.markers[0]} × {spec.markers[1]})"
        if not fits:
            raise TouchError(
                f"{self._name} sends {rows} × {columns} taxels, which doesn't fit {expected}; name "
                "the right sensor or port"
            )

    def read(self, frames: int = 1) -> TactileCloud:
        fresh, moved_mm = self._mean_of(frames)
        moved_mm = self._relative(moved_mm)
        heights_mm = moved_mm[:, :, -1].astype(np.float32)
        cloud = cloud_of_pixels(
            heights_mm, self._spec, stamp=fresh.stamp, force_scale=self._force_scale
        )
        self._last_shear = shear_of(moved_mm, self._spec, fresh.stamp)
        return cloud

    def last_shear(self) -> ShearField | None:
        """The shear field of the frames that the last cloud came from; None in version 1."""
        return self._last_shear

    def newest_shear(self) -> ShearField | None:
        """The shear field of the newest frame, at once; the same object while none is newer.

        Raises:
            TouchError: As ``read``, but for the wait.
        """
        newest = self._latest.newest()
        if newest is None:
            return None
        if newest.problem:
            raise TouchError(f"{self._name}: {newest.problem}")
        if self._newest is None or self._newest[0] is not newest:
            moved_mm = self._relative(displacement_mm(newest.frame))
            self._newest = newest, shear_of(moved_mm, self._spec, newest.stamp)
        return self._newest[1]

    def _relative(self, moved_mm: FloatArray) -> FloatArray:
        """Displacements relative to the last reference, if there was one."""
        reference_mm = self._reference_mm
        if reference_mm is None:
            return moved_mm
        if moved_mm.shape != reference_mm.shape:
            raise TouchError(
                f"{self._name} sends a grid of {moved_mm.shape} taxels and numbers, its "
                f"reference has {reference_mm.shape}: was it exchanged? Connect it again"
            )
        return moved_mm - reference_mm

    def take_reference(self) -> None:
        """Subtract the mean of ``REFERENCE_FRAMES`` fresh frames from all later ones.

        Raises:
            TouchError: As ``read``; the old reference stays.
        """
        _, self._reference_mm = self._mean_of(REFERENCE_FRAMES)

    def _mean_of(self, count: int) -> tuple[_StampedFrame, FloatArray]:
        """The last of some fresh frames, and the mean of their displacements [mm].

        Raises:
            TouchError: As ``read``.
        """
        frames = [self._fresh_frame() for _ in range(count)]
        moved_mm = [displacement_mm(frame.frame) for frame in frames]
        if len({each.shape for each in moved_mm}) > 1:
            raise TouchError(f"{self._name} sends frames of different sizes: connect it again")
        return frames[-1], np.mean(moved_mm, axis=0, dtype=np.float64)

    def check_alive(self) -> str:
        newest, stale_s = self._latest.newest(), self._intervals.stale_s
        if newest is not None and newest.problem:
            raise TouchError(f"{self._name}: {newest.problem}")
        since_s = self._opened_s if newest is None else newest.stamp.monotonic_s
        if time.monotonic() - since_s > stale_s + (STALE_MARGIN_S if self._has_unread else 0.0):
            return str(self._no_frame_error(stale_s))
        return ""

    def expect_untouched(self) -> None:
        """Nothing to compare: taxels have no background."""

    def disconnect(self) -> None:
        self._latest.fail(f"{self._name} is disconnected; connect it again to read")
        self._ending.set()
        if self._thread is not threading.current_thread():
            self._thread.join(timeout=2)

    @property
    def _has_unread(self) -> bool:
        """Bytes wait to be read: this computer is late, not the array."""
        from serial import SerialException

        try:
            return self._port.in_waiting > 0
        except (SerialException, OSError, TypeError):  # closed by its thread
            return False

    @property
    def _name(self) -> str:
        return f"the taxel array at {self._settings.port}"

    def _fresh_frame(self) -> _StampedFrame:
        """A whole frame of a gel, captured after the call.

        Raises:
            TouchError: As ``read``.
        """
        with self._sending:
            fresh = self._read_fresh()
        if fresh is None:
            raise self._no_frame_error(self._settings.read_timeout_s)
        if fresh.problem:
            raise TouchError(f"{self._name}: {fresh.problem}")
        return fresh

    def _read_fresh(self) -> _StampedFrame | None:
        """The first frame with a new mark; None if it does not arrive in time."""
        self._latest.newest()  # raises a latched failure before anything is sent
        self._mark = self._mark % (2**32 - 1) + 1
        mark = self._mark
        for _ in range(_NUM_SENDS):
            self._send(encode_mark(mark))
            fresh = self._latest.wait_for(
                lambda latest: latest.frame.mark == mark, self._settings.read_timeout_s / _NUM_SENDS
            )
            if fresh is not None:
                return fresh
        return None

    def _send(self, data: bytes) -> None:
        from serial import SerialException

        try:
            self._port.write(data)
        # pyserial writes to no file where the reading thread closes the port meanwhile
        except (SerialException, OSError, TypeError) as error:
            message = f"{self._name} was unplugged, or its port failed: {error}"
            self._latest.fail(message)
            raise TouchError(message) from None

    def _no_frame_error(self, waited_s: float) -> TouchError:
        counts, newest = self.counts(), self._latest.newest()
        advice = "check cable and port, and power the array off and on"
        if self._settings.is_emulated:
            advice = EMULATOR_ADVICE
        if newest is not None:
            age_s = time.monotonic() - newest.stamp.monotonic_s
            problem = (
                f"no fresh frame within {waited_s:.2g} s; the last one came "
                f"{age_s:.2f} s ago with mark {newest.frame.mark} ({counts.damaged} damaged so "
                f"far); expected a steady stream that repeats the host's marks: {advice}"
            )
        elif self._parser.counts.foreign:
            problem = (
                "its packets are of another version or kind; expected version "
                f"{HEIGHTS} or {DISPLACEMENTS}: load the firmware that fits docs/taxels.md"
            )
        elif counts.garbage_bytes:
            problem = (
                f"{counts.garbage_bytes} bytes came within {waited_s:g} s, but no packet; expected "
                "those of docs/taxels.md: is it another device, or another baud rate than "
                f"{self._settings.baud}?"
            )
        else:
            problem = f"silent for {waited_s:.2g} s; expected a steady stream of frames: {advice}"
        return TouchError(f"{self._name}: {problem}")

    def _capture(self) -> None:
        """Read until the end, and latch its reason."""
        from serial import SerialException

        request_priority()
        reason = "its reader ended without a reason; this is a bug"
        try:
            while not self._ending.is_set():
                for packet in self._parser.feed(self._port.read(max(1, self._port.in_waiting))):
                    if isinstance(packet, TaxelFrame) and self._numbers.is_new(packet.sequence):
                        stamp = real_stamp()
                        self._intervals.add(packet, stamp.monotonic_s)
                        self._latest.put(_StampedFrame(packet, stamp, problem_of(packet)))
            reason = "it is disconnected"
        except (SerialException, OSError) as error:
            reason = f"it was unplugged, or its port failed: {error}; plug it in and start again"
        finally:
            self._latest.fail(f"{self._name}: {reason}")
            self._port.close()
