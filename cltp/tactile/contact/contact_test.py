"""Whether anything touches the gel: tests of a cloud against the untouched gel.

A contact is local: it has edges and slopes within millimetres. Drift, tilt and the loss of the zero
are broad: over 5 to 10 mm and more.

``UntouchedGel`` tests against frames of the open fingers of the same closing, which is the test of
the loop. Light contacts are bumps, and show by the likelihood ratio of a bump beside drift
(``matched_filter``, beside this module). Contacts of any shape show by band filters (differences of
Gaussians) of a few millimetres, which remove what is broad; their response has to be larger. Either
will do. While nothing touches the reference follows the drift, within bounds: see ``follow``. In a
contact the drift is told from what is around it: see ``follow_around``.

``touches_alone`` tests a single cloud, whose drift is unknown, by the band filters alone, and so
needs a deeper contact.

Loads no torch. Not here: depth, position, area and force of a contact (``cltp.tactile.measure``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cells import cell_means, cells_of, filled, less_heights, smoothed
from cltp.tactile.cloud import FloatArray, TactileCloud
from cltp.tactile.contact.matched_filter import (
    LEAST_NOISE_MM,
    MOST_S,
    BoolArray,
    Bump,
    MatchedFilter,
    filter_noise_mm,
)
from cltp.tactile.sensor_noise import drift_in, spread_of
from cltp.tactile.sensors import SensorSpec

SCALES_MM = (0.6, 1.0, 1.6)
"""Widths of the inner Gaussians of the filters; the outer ones are twice as wide [mm]. Our choice:
from the cells of 1024 points to half the width of a light contact of a berry."""

NUM_FRAMES = 8
"""Frames of the untouched gel that a test is made from: their mean is as good as a reading of a few
frames, and they take a third of a second at 25 Hz."""

LEAST_GAIN = 70.0
"""Least gain of a contact (``matched_filter.Bump``). Source: of approaches of three seconds in air,
0.3 % of 700 with taxels and 0.7 % of 300 with a GelSight Mini have more. It is large since drift is
not all that a covariance says."""

LIGHT_MM = 0.12
"""Depth below which the drift under a contact is told from what is around it [mm]. Our choice:
drift of a few seconds is a small part of a deeper one, which covers more of the pad."""

LEAST_LEFT = 0.75
"""Least response to the band filters that is left of a contact without its drift. Our choice: drift
is broad, so that what takes more away is no drift."""

MAX_CELLS = 16
"""Most cells along either side of that test. Our choice: no bump is narrower than a cell."""

THRESHOLD = 8.5
"""Noise's part of the least response of a contact to the band filters, over the standard deviation
of the noise. It is large because 1024 cells at three scales are looked at again and again."""

CREEP_MM_S, CREEP_MM = (0.0026, 0.0036, 0.0046), (0.001, 0.0015, 0.002)
"""Drift's part of it, by scale: for each second since the reference [mm/s], and always [mm].
Source: of 600 simulated units, 0.2 % respond with more after 0.5, 1, 2 and 4 s."""

FOLLOWED_RATIO = 0.5
"""Frames with a ratio below this are followed (``ContactEvidence.ratio``)."""

FOLLOWED_TOTAL = 1.0
"""What has been followed responds to the band filters with at most this part of a contact's least
response, so that none can be learned away, however slowly it came. Our choice."""

FOLLOWED_S = 2.0
"""Time of creep in those responses [s]. Our choice: half of an approach."""

FOLLOWED_PART = 0.5
"""Part of a change that one frame takes into the reference: its noise counts for little."""

FOLLOWED_MM_S = 0.03
"""Most that the reference changes anywhere [mm/s]. Our choice: drift of 0.3 mm in a minute moves at
0.03 mm/s at most; a finger that closes is a hundred times as fast."""

FOLLOWED_PAUSE_S, FRAME_S = 1.0, 0.04
"""Longest time between two frames that counts for the rate, and the time where clouds bear none."""

FOLLOWED_SCALES_MM = (1.6, 5.0)
"""Changes are averaged with a Gaussian of the first width before they are followed; where that
would respond too much, with the second, which keeps what is broad [mm]."""

SLID = 0.5
"""Part of a contact's cells that lies where it was before, below which it has slid. Our choice: in
200 grasps of a peg across the pad, whose bump is found now here and now there along it, a fifteenth
more fail where any other cell counts as slid."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactEvidence:
    """Result of a test.

    Attributes:
        in_contact: Whether something touches the gel.
        ratio: Largest response over the least one of a contact; 1 and more is a contact.
        largest: The same of the largest response of either sign.
        is_inverted: Whether the gel seems to rise where a contact would press it in: z has the
            wrong sign.
    """

    in_contact: bool
    ratio: float
    largest: float
    is_inverted: bool = False


class _Seen(NamedTuple):
    """A cloud beside the reference and the drift followed: its change (n, n) [mm], and the test."""

    cloud: TactileCloud
    drift_mm: FloatArray
    change_mm: FloatArray
    bump: Bump
    evidence: ContactEvidence


def prepare_tests(cloud: TactileCloud) -> None:
    """Compute what every ``UntouchedGel`` of such clouds shares, and keep it.

    It takes 0.2 s, several times as much on a busy computer, and no other thread of this process
    runs meanwhile: scipy's solvers keep the interpreter.
    """
    MatchedFilter(cloud.sensor, _cells_tested(cloud), LEAST_NOISE_MM)


def _cells_tested(cloud: TactileCloud) -> int:
    return min(MAX_CELLS, cells_of(cloud))


class UntouchedGel:
    """The untouched gel of one closing, as the sensor sees it now."""

    def __init__(self, frames: Sequence[TactileCloud], *, averaged: int = 1) -> None:
        """Learn the mean and the noise of the untouched gel.

        Args:
            frames: At least two clouds of one sensor while nothing touches, a frame each.
            averaged: Frames that each cloud to be tested is the mean of.

        Raises:
            TouchError: Fewer than two frames, or frames of different sensors.
        """
        if len(frames) < 2 or len({frame.sensor.name for frame in frames}) > 1:
            raise TouchError(
                f"the untouched gel needs at least 2 frames of one sensor, got {len(frames)}"
            )
        self._sensor = frames[0].sensor
        # Frames can miss points.
        self._cells = min(_cells_tested(frame) for frame in frames)
        cells = [cell_means(frame, self._cells) for frame in frames]
        self._mean = _mean(cells)
        count = len(frames)
        noise = [filled(frame - self._mean) for frame in cells]
        # A frame of the mean differs less from it than a new frame does.
        factor = math.sqrt((1 / averaged + 1 / count) / (1 - 1 / count))
        responses = [_responses(each, self._sensor) for each in noise]
        self._noise_mm = THRESHOLD * factor * np.std(responses, axis=(0, 2, 3))
        noise_mm = factor * filter_noise_mm(noise, self._sensor)
        self._filter = MatchedFilter(self._sensor, self._cells, noise_mm)
        self._drift_mm = np.zeros_like(self._mean)
        self._last_seen: _Seen | None = None
        self._region: BoolArray | None = None  # cells of the contact that drift is followed around
        stamp = frames[-1].stamp
        self._last_s = self._since_s = None if stamp is None else stamp.monotonic_s

    def test(self, cloud: TactileCloud) -> ContactEvidence:
        """Test whether something touches the gel now.

        Raises:
            TouchError: A cloud of another sensor.
        """
        return self._seen(cloud).evidence

    def follow(self, cloud: TactileCloud) -> None:
        """Let the reference follow slow drift towards a frame in which nothing touches.

        A frame whose ratio reaches ``FOLLOWED_RATIO``, in either direction, changes nothing. The
        reference moves by at most ``FOLLOWED_MM_S``, and in all by what responds with at most
        ``FOLLOWED_TOTAL``: broad drift is followed all the way, what is local only in part.

        Raises:
            TouchError: A cloud of another sensor.
        """
        self._region = None
        seen = self._seen(cloud)
        if seen.evidence.largest >= FOLLOWED_RATIO:
            return
        most_mm = FOLLOWED_MM_S * self._seconds_to(cloud)
        for scale_mm in FOLLOWED_SCALES_MM:
            smooth = FOLLOWED_PART * smoothed(seen.change_mm, self._sensor, scale_mm)
            drift_mm = self._drift_mm + np.clip(smooth, -most_mm, most_mm)
            responses = np.abs(_responses(drift_mm, self._sensor)).max(axis=(1, 2))
            if (responses <= FOLLOWED_TOTAL * self._least_mm(FOLLOWED_S)).all():
                self._drift_mm, self._since_s = drift_mm, self._last_s
                return

    def _seconds_to(self, cloud: TactileCloud) -> float:
        """Time since the last frame that was followed [s]."""
        if cloud.stamp is None:
            return FRAME_S
        last_s, self._last_s = self._last_s, cloud.stamp.monotonic_s
        if last_s is None:
            return FRAME_S
        return min(max(self._last_s - last_s, 0.0), FOLLOWED_PAUSE_S)

    def follow_around(self, cloud: TactileCloud) -> None:
        """Let the reference follow the drift in a frame of a light contact.

        The cells around the contact tell it, and it is continued under the contact. Its place is
        that of the frame before, less the drift, together with what seems to be its place now
        where that is another: it has slid. A deep contact is left as it is.

        Raises:
            TouchError: A cloud of another sensor.
        """
        seen, region = self._seen(cloud), self._region
        change = seen.change_mm
        if _depth_mm(change, region) >= LIGHT_MM:
            self._region = None
            return
        here = self._filter.region(seen.bump)
        if region is None:
            region = here
        elif (region & here).sum() < SLID * here.sum():
            region = region | here
        drift_mm = self._filter.drift_under(change, region)
        if self._region is None and self._takes_away(change, drift_mm):
            return
        self._drift_mm, self._since_s = self._drift_mm + drift_mm, _time_s(cloud)
        region = self._filter.region(self._filter.fit(change - drift_mm))
        self._region = region if region.any() else None

    def _takes_away(self, change_mm: FloatArray, drift_mm: FloatArray) -> bool:
        """Whether what seems to be drift is part of the contact."""
        whole, left = (
            _responses(each, self._sensor).max(axis=(1, 2))
            for each in (change_mm, change_mm - drift_mm)
        )
        return bool((left < LEAST_LEFT * whole).any())

    def without_drift(self, cloud: TactileCloud) -> TactileCloud:
        """The cloud less the drift that has been followed since the reference.

        Raises:
            TouchError: A cloud of another sensor.
        """
        self._check_sensor(cloud)
        return cloud if not self._drift_mm.any() else less_heights(cloud, self._drift_mm)

    def _change_mm(self, cloud: TactileCloud) -> FloatArray:
        """Cells of a cloud less the reference and the drift followed since, (n, n) [mm]."""
        self._check_sensor(cloud)
        return filled(cell_means(cloud, self._cells) - self._mean - self._drift_mm)

    def _seen(self, cloud: TactileCloud) -> _Seen:
        """What a cloud shows beside the reference; the last one is kept."""
        last = self._last_seen
        if last is not None and last.cloud is cloud and last.drift_mm is self._drift_mm:
            return last
        change = self._change_mm(cloud)
        now_s, elapsed_s = _time_s(cloud), MOST_S
        if now_s is not None and self._since_s is not None:
            elapsed_s = max(0.0, now_s - self._since_s)
        bump = self._filter.fit(change, elapsed_s)
        of_bump = _compared(*(math.sqrt(g / LEAST_GAIN) for g in (bump.gain, bump.raised_gain)))
        of_bands = _evidence(_responses(change, self._sensor), self._least_mm(elapsed_s))
        pressed = max(of_bands.ratio, of_bump.ratio)
        evidence = _compared(pressed, max(of_bands.largest, of_bump.largest))
        self._last_seen = _Seen(cloud, self._drift_mm, change, bump, evidence)
        return self._last_seen

    def _least_mm(self, elapsed_s: float) -> FloatArray:
        """Least response of a contact to the band filters, by scale [mm]."""
        creep_mm = np.array(CREEP_MM_S) * min(elapsed_s, MOST_S) + np.array(CREEP_MM)
        return np.asarray(self._noise_mm + creep_mm)

    def _check_sensor(self, cloud: TactileCloud) -> None:
        if cloud.sensor.name != self._sensor.name:
            raise TouchError(
                f"expected a cloud of {self._sensor.name}, got one of {cloud.sensor.name}"
            )


def _time_s(cloud: TactileCloud) -> float | None:
    """Time of a cloud on its monotonic clock [s]; None where it bears none."""
    return None if cloud.stamp is None else cloud.stamp.monotonic_s


def _depth_mm(change_mm: FloatArray, region: BoolArray | None) -> float:
    """Depth of a contact (n, n) [mm], over what is around its cells where they are known."""
    if region is None or region.all():
        return float(change_mm.max())
    return float(change_mm[region].max() - np.median(change_mm[~region]))


def _mean(cells_mm: Sequence[FloatArray]) -> FloatArray:
    """Mean of cells over frames; NaN where no frame has a point."""
    count = np.isfinite(cells_mm).sum(axis=0)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.nansum(cells_mm, axis=0) / count)


def touches_alone(cloud: TactileCloud) -> ContactEvidence:
    """Test a single cloud, without frames of the untouched gel.

    The least response of a contact is what the sensor's drift and fine noise reach
    (``cltp.tactile.sensor_noise``): light contacts can't be told from drift in one frame, unless
    the frame itself shows next to none.
    """
    spread, sensor = spread_of(cloud.sensor), cloud.sensor
    cells = cell_means(cloud)
    drift_mm = drift_alone_mm(cloud)
    pitch_mm = math.sqrt(sensor.area_mm2 / len(cloud.points_mm))
    least_mm = []
    for scale_mm in SCALES_MM:
        drift = drift_mm * _drift_gain(scale_mm, spread.drift_length_mm[0])
        # White noise of each point, through the difference of Gaussians.
        fine = spread.fine_mm * pitch_mm / (2 * math.sqrt(math.pi) * scale_mm) * math.sqrt(0.45)
        least_mm.append(SINGLE_THRESHOLD * math.hypot(drift, fine))
    return _evidence(_responses(cells, sensor), np.array(least_mm))


def drift_alone_mm(cloud: TactileCloud) -> float:
    """Drift that a single cloud may have, standard deviation [mm]; see ``drift_in``."""
    return drift_in(filled(cell_means(cloud)), spread_of(cloud.sensor))


def _evidence(responses: FloatArray, least_mm: FloatArray) -> ContactEvidence:
    """Compare responses (scales, n, n) with the least ones of a contact (scales,)."""
    pressed = float((responses.max(axis=(1, 2)) / least_mm).max())
    raised = float((-responses.min(axis=(1, 2)) / least_mm).max())
    return _compared(pressed, raised)


def _compared(pressed: float, raised: float) -> ContactEvidence:
    """Compare what is pressed in with what rises, each over the least of a contact."""
    is_inverted = raised >= 1 and pressed < MIN_PRESSED * raised
    return ContactEvidence(
        in_contact=pressed >= 1 and not is_inverted,
        ratio=pressed,
        largest=max(pressed, raised),
        is_inverted=is_inverted,
    )


MIN_PRESSED = 0.5
"""Least response of what is pressed in over that of what rises, of a contact. A bump of the wrong
sign has 0.1 to 0.3; noise-free contacts of all shapes have 0.62 (a plane) and more."""

SINGLE_THRESHOLD = 4.0
"""As ``THRESHOLD``, of a single frame: drift has few independent places on a pad."""


def _drift_gain(scale_mm: float, length_mm: float) -> float:
    """Standard deviation that a filter leaves of a field of variance 1 and a Gaussian correlation.

    Args:
        scale_mm: Width of the inner Gaussian [mm].
        length_mm: Distance at which the correlation has fallen to 1/e [mm].
    """

    def covariance(one_mm: float, other_mm: float) -> float:
        return 1 / (1 + 2 * (one_mm**2 + other_mm**2) / length_mm**2)

    inner, outer = scale_mm, 2 * scale_mm
    variance = covariance(inner, inner) - 2 * covariance(inner, outer) + covariance(outer, outer)
    return math.sqrt(max(variance, 0.0))


def _responses(cells_mm: FloatArray, sensor: SensorSpec) -> FloatArray:
    """Responses of the filters, shape (scales, n, n) [mm]; cells without points count nothing."""
    return np.stack(
        [
            smoothed(cells_mm, sensor, scale) - smoothed(cells_mm, sensor, 2 * scale)
            for scale in SCALES_MM
        ]
    )
