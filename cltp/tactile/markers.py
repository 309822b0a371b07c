"""Sensors that track markers: heights to a sparse cloud, and a sparse cloud to 1024 points.

A GelStereo knows its surface at its markers alone, 1.1 mm apart. The encoder takes 1024 points in
a lattice; they are read off the smooth surface through the markers (piecewise cubic with continuous
slope; beyond the outermost markers, the nearest one's height). Nothing finer than the markers is
made up, and nothing that a marker measured is lost.

Not here: noise figures (``cltp.tactile.sensor_noise``), sensors that see their whole surface
(``cltp.tactile.cloud``).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CloughTocher2DInterpolator, NearestNDInterpolator
from scipy.ndimage import map_coordinates
from scipy.spatial import QhullError

from cltp.errors import TouchError
from cltp.tactile.cloud import NUM_POINTS, Stamp, TactileCloud, stratified
from cltp.tactile.sensor_noise import NoiseUnit
from cltp.tactile.sensors import SensorSpec


def marker_places_mm(sensor: SensorSpec) -> NDArray[np.float64]:
    """Where the markers of an untouched gel are, shape (N, 2) [mm], from the top left row by row.

    Raises:
        TouchError: The sensor has no markers.
    """
    if sensor.markers is None:
        raise TouchError(f"{sensor.name} has no markers: it sees its whole surface")
    down, across = sensor.markers
    x = ((np.arange(across) + 0.5) / across - 0.5) * sensor.width_mm
    y = (0.5 - (np.arange(down) + 0.5) / down) * sensor.height_mm
    return np.stack([np.tile(x, down), np.repeat(y, across)], axis=1)


def marker_cloud(
    height_mm: NDArray[np.floating],
    sensor: SensorSpec,
    *,
    unit: NoiseUnit | None = None,
    rng: np.random.Generator | None = None,
    stamp: Stamp | None = None,
) -> TactileCloud:
    """The sparse cloud that a sensor with markers reports.

    Markers stay where they are along the surface: the press is without friction.

    Args:
        height_mm: Shape (H, W), true indentation over the sensor's whole field [mm].
        sensor: One with markers.
        unit: Its errors; None measures without any.
        rng: Draws this frame's errors; needed with a ``unit``.
        stamp: When the heights were captured.

    Returns:
        A point for each marker that was found; their median height is 0, as of every cloud that
        an encoder is given.

    Raises:
        TouchError: No markers, a bad map, a unit without a generator, or too few markers found.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    if heights.ndim != 2 or min(heights.shape) < 8 or not np.isfinite(heights).all():
        raise TouchError(f"a height map needs finite (H, W), 8 or more; got {heights.shape}")
    if unit is not None and rng is None:
        raise TouchError("a noisy unit needs a generator to draw its frame from")
    places = marker_places_mm(sensor)
    if unit is not None and rng is not None:
        smooth = NoiseUnit(
            depth_scale=unit.depth_scale,
            tilt_x=unit.tilt_x,
            tilt_y=unit.tilt_y,
            drift_mm=unit.drift_mm,
            drift_length_mm=unit.drift_length_mm,
        )
        heights = smooth.apply(heights, sensor, rng).astype(np.float64)
        found = places[rng.random(len(places)) >= unit.marker_loss]
        depths = _at(heights, found, sensor) + rng.normal(0.0, unit.fine_mm, len(found))
        depths -= np.median(depths) if len(depths) else 0.0
        places = found + rng.normal(0.0, unit.marker_mm, found.shape)
    else:
        depths = _at(heights, places, sensor)
        depths -= np.median(depths)
    points = np.concatenate([places, depths[:, None]], axis=1)
    return TactileCloud(points_mm=points.astype(np.float32), sensor=sensor, stamp=stamp)


def densified(
    cloud: TactileCloud,
    *,
    rng: np.random.Generator | None = None,
    num_points: int = NUM_POINTS,
) -> TactileCloud:
    """Points on the smooth surface through a sparse cloud, one in each cell of a lattice.

    Args:
        cloud: At least ``MIN_POINTS`` points, not all on a line.
        rng: Jitters each point inside its cell, as ``cloud_from_heights`` does; None puts it at the
            cell's centre.
        num_points: How many, as in ``cloud_from_heights``.

    Raises:
        TouchError: The points are all on a line.
    """
    known = cloud.points_mm.astype(np.float64)
    u, v = stratified(num_points, rng)
    x, y = (u - 0.5) * cloud.sensor.width_mm, (0.5 - v) * cloud.sensor.height_mm
    try:
        z = CloughTocher2DInterpolator(known[:, :2], known[:, 2])(x, y)
    except QhullError:
        raise TouchError("the points of the cloud lie on a line; they span no surface") from None
    outside = ~np.isfinite(z)
    z[outside] = NearestNDInterpolator(known[:, :2], known[:, 2])(x[outside], y[outside])
    points = np.stack([x, y, z], axis=1).astype(np.float32)
    return TactileCloud(points_mm=points, sensor=cloud.sensor, stamp=cloud.stamp)


def _at(
    heights: NDArray[np.float64], places: NDArray[np.float64], sensor: SensorSpec
) -> NDArray[np.float64]:
    rows, columns = heights.shape
    row = (0.5 - places[:, 1] / sensor.height_mm) * rows - 0.5
    column = (places[:, 0] / sensor.width_mm + 0.5) * columns - 0.5
    return np.asarray(map_coordinates(heights, [row, column], order=1, mode="nearest"))
