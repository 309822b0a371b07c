"""Sensors that track markers: heights to a sparse cloud, and a sparse cloud to 1024 points.

A GelStereo measures its surface at its markers alone, 1.1 mm apart. The encoder takes 1024 points
in a lattice; they are read off the smooth surface through the markers (piecewise cubic with
continuous slope; beyond the outermost markers, the nearest one's height). No detail finer than the
markers is invented, and no marker's measurement is lost.

Not here: noise figures (``cltp.tactile.sensor_noise``), sensors that see their whole surface
(``cltp.tactile.cloud``).
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import (
    CloughTocher2DInterpolator,
    LinearNDInterpolator,
    NearestNDInterpolator,
)
from scipy.spatial import QhullError

from cltp.errors import TouchError
from cltp.processor import one_blas_thread
from cltp.tactile.cloud import (
    NUM_POINTS,
    FloatArray,
    Stamp,
    TactileCloud,
    checked_heights,
    grid_axes_mm,
    heights_at,
    stratified,
)
from cltp.tactile.sensor_noise import NoiseUnit
from cltp.tactile.sensors import SensorSpec


def marker_positions_mm(sensor: SensorSpec) -> FloatArray:
    """Markers of an untouched gel, shape (N, 2) [mm], from the top left row by row.

    Raises:
        TouchError: The sensor has no markers.
    """
    if sensor.markers is None:
        raise TouchError(f"{sensor.name} has no markers: it sees its whole surface")
    x, y = np.meshgrid(*grid_axes_mm(sensor, *sensor.markers))
    return np.stack([x.ravel(), y.ravel()], axis=1)


def marker_cloud(
    height_mm: NDArray[np.floating],
    sensor: SensorSpec,
    *,
    unit: NoiseUnit | None = None,
    rng: np.random.Generator | None = None,
    stamp: Stamp | None = None,
) -> TactileCloud:
    """The sparse cloud that a sensor with markers reports.

    Markers do not move along the surface: the press is without friction.

    Args:
        height_mm: Shape (H, W), true indentation over the whole sensing area [mm].
        sensor: A sensor with markers.
        unit: Errors of the unit; None measures without any.
        rng: Draws the errors of this frame; needed with a ``unit``.
        stamp: Time of capture.

    Returns:
        A point for each marker that was detected; their median height is 0, as of every cloud that
        an encoder is given.

    Raises:
        TouchError: No markers, a bad map, a unit without a generator, or too few markers detected.
    """
    heights = checked_heights(height_mm)
    positions = marker_positions_mm(sensor)
    depth_errors: FloatArray | float = 0.0
    position_errors: FloatArray | float = 0.0
    if unit is not None:
        if rng is None:
            raise TouchError("a noisy unit needs a generator to draw its frame from")
        # Per-pixel errors and dead borders are the camera's; markers have errors of their own.
        surface = dataclasses.replace(unit, gain_x=1.0, gain_y=1.0, fine_mm=0.0, border_mm=0.0)
        heights = surface.apply(heights, sensor, rng).astype(np.float64)
        positions = positions[rng.random(len(positions)) >= unit.marker_loss]
        depth_errors = rng.normal(0.0, unit.fine_mm, len(positions))
        position_errors = rng.normal(0.0, unit.marker_mm, positions.shape)
    depths = heights_at(heights, positions[:, 0], positions[:, 1], sensor) + depth_errors
    depths -= np.median(depths) if len(depths) else 0.0
    points = np.concatenate([positions + position_errors, depths[:, None]], axis=1)
    return TactileCloud(points_mm=points.astype(np.float32), sensor=sensor, stamp=stamp)


def densified(
    cloud: TactileCloud, *, rng: np.random.Generator | None = None, num_points: int = NUM_POINTS
) -> TactileCloud:
    """Points on the smooth surface through a sparse cloud, one in each cell of a lattice.

    ``rng`` and ``num_points`` are those of ``cloud_from_heights``.

    Raises:
        TouchError: The points are all on a line.
    """
    u, v = stratified(num_points, rng)
    x, y = (u - 0.5) * cloud.sensor.width_mm, (0.5 - v) * cloud.sensor.height_mm
    z = interpolated(cloud, x, y, CloughTocher2DInterpolator)
    points = np.stack([x, y, z], axis=1).astype(np.float32)
    return dataclasses.replace(cloud, points_mm=points)


@one_blas_thread()
def interpolated(
    cloud: TactileCloud,
    x_mm: FloatArray,
    y_mm: FloatArray,
    interpolator: type[CloughTocher2DInterpolator | LinearNDInterpolator],
) -> FloatArray:
    """Heights [mm] of the surface through a cloud; outside its hull, those of the nearest points.

    Positions and heights have one shape, whatever it is.

    Raises:
        TouchError: The points are all on a line.
    """
    points = cloud.points_mm.astype(np.float64)
    try:
        z = interpolator(points[:, :2], points[:, 2])(x_mm, y_mm)
    except QhullError:
        raise TouchError("the points of the cloud lie on a line; they span no surface") from None
    outside = ~np.isfinite(z)
    nearest = NearestNDInterpolator(points[:, :2], points[:, 2])
    z[outside] = nearest(x_mm[outside], y_mm[outside])
    return np.asarray(z)
