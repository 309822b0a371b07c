"""Frames of a gel with dots to heights and to the shear field. Loads no torch.

Dots hide the colour that tells the slope: they are painted over with a plane through the colours
around each, in the frame and in the background. Displacements along the gel are those of the dots,
read at the points of the sensor's grid; that into the gel is the height there.

Not here: where the dots are (``cltp.sensing.marker_dots``), colours to heights
(``cltp.sensing.photometric``).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay, KDTree

from cltp.errors import TouchError
from cltp.processor import one_blas_thread
from cltp.sensing.calibration import WITHOUT_DOTS
from cltp.sensing.frames import Frame
from cltp.sensing.marker_dots import Dots, DotTracker
from cltp.sensing.photometric import FloatArray, GradientNet, Photometer
from cltp.tactile.cloud import Stamp, heights_at
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.contact_shape import grid_of
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import MIN_POINTS

MARGIN_PX, RING_PX = 2.0, 3.0
"""How far beyond a dot's radius it is painted over, and the width of the ring about that from
which its colours are taken. Our choice: a dot's edge is blurred by a pixel or two."""

COARSE = 2
"""Pixels of a frame along one of the heights of a shear field: its points lie 35 px apart."""

LEAST_FOLLOWED = 0.5
"""Fraction of the dots that a single frame must show. Our choice: steep walls hide a fifth."""

LEAST_WEIGHT = 0.5
"""Weight of the dots that were found at a point of the grid from which it is read."""


class MarkerReader:
    """Reads the frames of one gel with dots.

    Args:
        photometer: Colours to heights of the unit; its background is not used.
        background: Frame of the untouched gel.
        sensor: The sensor, with dots at its ``shear_grid``.

    Raises:
        TouchError: The background is no frame of this sensor, or shows no such dots.
    """

    def __init__(self, photometer: Photometer, background: Frame, sensor: SensorSpec) -> None:
        self.sensor = sensor
        self._tracker = DotTracker(background, sensor)
        self._painter = _Painter(self._tracker.radius_px)
        untouched = self._tracker.untouched
        painted = self._painter.over(background, untouched.places_px)
        self._photometer = photometer.with_background(painted)
        self._coarse = photometer.coarser(COARSE, coarse_frame(painted))
        grid = grid_of(sensor)
        self._points_mm = np.stack([grid.x, grid.y], axis=1)
        self._weights = _weights(untouched.places_px, self._px_of(self._points_mm))

    def follow(self, frame: Frame, before: Dots | None = None) -> Dots:
        """The dots of a frame; see ``DotTracker.follow``."""
        return self._tracker.follow(frame, before)

    def without_dots(self, frame: Frame, dots: Dots | None = None) -> Frame:
        """A frame whose dots are painted over; they are looked for where they are not given."""
        return self._painter.over(frame, (dots or self.follow(frame)).places_px)

    def heights(self, frame: Frame, dots: Dots | None = None) -> FloatArray:
        """Surface of the gel, (rows, columns) [mm]; see ``Photometer.heights``."""
        return self._photometer.heights(self.without_dots(frame, dots))

    def coarse_heights(self, frame: Frame, dots: Dots) -> FloatArray:
        """The same at one in ``COARSE`` × ``COARSE`` pixels, in a quarter of the time."""
        return self._coarse.heights(coarse_frame(self.without_dots(frame, dots)))

    def field(
        self, dots: Dots, height_mm: NDArray[np.floating], *, stamp: Stamp | None = None
    ) -> ShearField:
        """The shear field of a frame: at those points of the grid whose dots were found.

        Args:
            dots: The frame's dots, or a mean of several frames'.
            height_mm: Its heights, of any resolution [mm].
            stamp: Time of capture.

        Raises:
            TouchError: Fewer than ``MIN_POINTS`` of them, or a dot that moved by more than the gel
                is thick.
        """
        weight = self._weights @ dots.found.astype(np.float64)
        seen = weight > LEAST_WEIGHT
        if seen.sum() < MIN_POINTS:
            raise _too_few(dots, self.sensor)
        moved_px = dots.places_px - self._tracker.untouched.places_px
        along_px = (self._weights @ (dots.found[:, None] * moved_px))[seen] / weight[seen, None]
        along_mm = along_px * self.sensor.mm_per_px * (1.0, -1.0)
        at = self._points_mm[seen]
        x_mm, y_mm = (at + along_mm).T
        depth_mm = heights_at(height_mm.astype(np.float64), x_mm, y_mm, self.sensor)
        return ShearField(
            positions_mm=at.astype(np.float32),
            displacement_mm=np.column_stack([along_mm, depth_mm]).astype(np.float32),
            sensor=self.sensor,
            stamp=stamp,
        )

    def _px_of(self, points_mm: NDArray[np.float64]) -> NDArray[np.float64]:
        spec = self.sensor
        column = (points_mm[:, 0] + spec.width_mm / 2) / spec.mm_per_px - 0.5
        return np.stack([column, (spec.height_mm / 2 - points_mm[:, 1]) / spec.mm_per_px - 0.5], 1)


def heights_of_frame(
    frame: Frame, background: Frame, net: GradientNet, sensor: SensorSpec
) -> FloatArray:
    """Heights (rows, columns) [mm] of one frame of a gel, with dots or without.

    Raises:
        TouchError: As ``Photometer`` and ``without_dots``.
    """
    if sensor.name in WITHOUT_DOTS:
        (frame,), background = without_dots([frame], background, sensor)
    return Photometer(net, background, sensor).heights(frame)


def without_dots(
    frames: Sequence[Frame], background: Frame, sensor: SensorSpec
) -> tuple[list[Frame], Frame]:
    """Frames of one gel, and that of it untouched, with their dots painted over.

    Raises:
        TouchError: As ``DotTracker``, or a frame shows less than ``LEAST_FOLLOWED`` of the dots.
    """
    tracker = DotTracker(background, sensor)
    painter = _Painter(tracker.radius_px)
    painted = []
    for frame in frames:
        dots = tracker.follow(frame)
        if dots.found.mean() < LEAST_FOLLOWED:
            raise _too_few(dots, sensor)
        painted.append(painter.over(frame, dots.places_px))
    return painted, painter.over(background, tracker.untouched.places_px)


def _too_few(dots: Dots, sensor: SensorSpec) -> TouchError:
    return TouchError(
        f"{int(dots.found.sum())} of the {len(dots.found)} dots of {sensor.name} were found: is "
        "the frame of the background's gel? Is the gel torn, dirty or out of focus? A gel without "
        "dots is gelsight_mini"
    )


class _Painter:
    """Paints over discs of one size.

    Args:
        radius_px: Radius of a dot [px].
    """

    def __init__(self, radius_px: float) -> None:
        inner = radius_px + MARGIN_PX
        reach = int(np.ceil(inner + RING_PX))
        axis = np.arange(-reach, reach + 1)
        columns, rows = (each.ravel() for each in np.meshgrid(axis, axis))
        distance = np.hypot(columns, rows)
        self._disc = np.stack([columns, rows], axis=1)[distance <= inner]
        is_ring = (distance > inner) & (distance <= inner + RING_PX)
        self._ring = np.stack([columns, rows], axis=1)[is_ring]
        plane = np.linalg.pinv(_terms(self._ring))
        self._fill = (_terms(self._disc) @ plane).astype(np.float32)  # (disc, ring)

    def over(self, frame: Frame, places_px: NDArray[np.float64]) -> Frame:
        """A copy of a frame, (H, W, 3), without the dots at some places (N, 2)."""
        last = np.array(frame.shape[1::-1]) - 1
        middles = np.rint(places_px).astype(np.intp)[:, None]
        ring = np.clip(middles + self._ring, 0, last)
        colours = frame[ring[..., 1], ring[..., 0]].astype(np.float32)  # (N, ring, 3)
        fill = np.matmul(self._fill, colours)
        disc = middles + self._disc
        inside = ((disc >= 0) & (disc <= last)).all(axis=2)
        painted = frame.copy()
        column, row = disc[inside].T
        painted[row, column] = np.clip(np.rint(fill[inside]), 0, 255).astype(np.uint8)
        return painted


def _terms(offsets: NDArray[np.intp]) -> NDArray[np.float64]:
    return np.column_stack([np.ones(len(offsets)), offsets]).astype(np.float64)


def coarse_frame(frame: Frame) -> Frame:
    """The mean of ``COARSE`` × ``COARSE`` pixels each, (H / COARSE, W / COARSE, 3)."""
    rows = np.add.reduceat(frame, np.arange(0, frame.shape[0], COARSE), axis=0, dtype=np.uint16)
    both = np.add.reduceat(rows, np.arange(0, frame.shape[1], COARSE), axis=1)
    return np.asarray((both + COARSE**2 // 2) // COARSE**2, dtype=np.uint8)


@one_blas_thread()
def _weights(dots: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weights (M, N) of the dots at some points: linear between three; beyond, of the nearest."""
    mesh = Delaunay(dots)
    inside = mesh.find_simplex(points)
    weights = np.zeros((len(points), len(dots)))
    _, nearest = KDTree(dots).query(points)
    for k, simplex in enumerate(inside):
        if simplex < 0:
            weights[k, nearest[k]] = 1.0
            continue
        transform = mesh.transform[simplex]
        two = transform[:2] @ (points[k] - transform[2])
        weights[k, mesh.simplices[simplex]] = [*two, 1.0 - two.sum()]
    return weights
