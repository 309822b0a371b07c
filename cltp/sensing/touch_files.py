"""Read one observation from a file: a cloud, a height map, or a camera's frame of the gel.

Clouds (.ply .pcd .xyz .npy .npz) are (N, 3) in mm in the gel frame; height maps (.npy .npz) are
(H, W) indentations in mm over the whole sensing area, row 0 at the top; frames (.png .jpg .bmp)
become heights by a calibration. Nothing is guessed, scaled or repaired.

Not here: data sets of many contacts (``cltp.data.dataset``), episodes (``tacgrasp.episodes``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.sensing.cloud_formats import read_pcd, read_ply, read_xyz
from cltp.sensing.frames import FRAME_SUFFIXES, read_frame
from cltp.sensing.numpy_files import read_npy, read_npz, sensor_in_npz
from cltp.tactile.cloud import TactileCloud, check_relief, cloud_from_heights, grid_axes_mm
from cltp.tactile.sensors import SENSORS, SensorSpec

ASPECT_TOLERANCE = 0.05
"""Largest relative difference of a map's aspect from the sensor's; transposed, it is 80 %."""

SURFACE_ROWS = 75
"""Rows of the map that a cloud becomes: 0.2 mm on a GelSight Mini, finer than its points."""

MAX_FILE_BYTES = 64_000_000
"""Most bytes of a file, which is read whole: 8 million numbers of 8 bytes. Our choice."""

LEAST_COLUMNS = 8
"""An array of fewer columns, which is no height map, may be meant as a cloud."""


def read_cloud(
    path: Path,
    sensor: SensorSpec,
    *,
    background: Path | None = None,
    calibration: Path | None = None,
) -> TactileCloud:
    """Read a cloud, or sample a height map or a frame's heights at the centres of 1024 cells.

    Args:
        path: File; its suffix gives the format.
        sensor: The sensor that the numbers belong to.
        background: Frame of the same unit with an untouched gel; a frame can't be read without. For
            frames only.
        calibration: Calibration of that unit; None is the shipped one. For frames only.

    Raises:
        TouchError: Missing, empty, truncated or foreign file; not numbers; numbers that can't come
            from this sensor; a frame without a background; or no frame, but with background or
            calibration.
    """
    if path.suffix.lower() in FRAME_SUFFIXES:
        heights = _frame_heights(path, sensor, background, calibration)
        with path_in_errors(path):
            try:
                return cloud_from_heights(heights, sensor)
            except TouchError as error:
                raise TouchError(
                    f"{error}; is the frame lit as its background was, with its colours in the "
                    "usual order, and calibrated for this unit?"
                ) from None
    array = _read_array(path, sensor)
    for flag, given in (("--background", background), ("--calibration", calibration)):
        if given is not None:
            raise TouchError(
                f"{flag} {given} is for a camera's frame ({' '.join(FRAME_SUFFIXES)}), and {path} "
                "is a cloud or height map; leave it out"
            )
    with path_in_errors(path):
        return _cloud_of(array, sensor)


def read_heights(
    path: Path,
    sensor: SensorSpec,
    *,
    background: Path | None = None,
    calibration: Path | None = None,
) -> NDArray[np.float32]:
    """Read heights: a height map as it is, a frame's, or the surface of a cloud.

    A cloud becomes a map of 75 rows by linear interpolation between its points; outside their hull
    the height is that of the nearest point. The arguments are those of ``read_cloud``; background
    and calibration may be given with any file, since a folder may hold frames and height maps.

    Returns:
        Shape (H, W), row 0 = top [mm].

    Raises:
        TouchError: As ``read_cloud``, but for a background or calibration without a frame.
    """
    if path.suffix.lower() in FRAME_SUFFIXES:
        return _frame_heights(path, sensor, background, calibration)
    array = _read_array(path, sensor)
    with path_in_errors(path):
        cloud = _cloud_of(array, sensor)
        return array.astype(np.float32) if array.shape[1] != 3 else _surface(cloud)


@contextmanager
def path_in_errors(path: Path) -> Iterator[None]:
    """Name the file in a ``TouchError`` of the block, which is about its content."""
    try:
        yield
    except TouchError as error:
        raise TouchError(f"{path}: {error}") from None


def _surface(cloud: TactileCloud) -> NDArray[np.float32]:
    """Heights on a grid over the whole sensing area, through the points of a cloud."""
    from scipy.interpolate import LinearNDInterpolator

    from cltp.tactile.markers import interpolated

    columns = round(SURFACE_ROWS * cloud.sensor.columns / cloud.sensor.rows)
    x, y = np.meshgrid(*grid_axes_mm(cloud.sensor, SURFACE_ROWS, columns))
    return interpolated(cloud, x, y, LinearNDInterpolator).astype(np.float32)


def _check_sensor(name: str, sensor: SensorSpec) -> None:
    """Refuse a file that says it is of another sensor."""
    if name in SENSORS and name != sensor.name:
        raise TouchError(
            f"it is of {name}, and was to be read as {sensor.name}; name --sensor {name}"
        )


def _read_array(path: Path, sensor: SensorSpec) -> NDArray[np.float64]:
    """The numbers in a file, unchanged."""
    readers: dict[str, Callable[[bytes], NDArray[np.float64]]] = {
        ".ply": read_ply,
        ".pcd": read_pcd,
        ".xyz": read_xyz,
        ".npy": read_npy,
        ".npz": read_npz,
    }
    if path.is_dir():
        raise TouchError(f"{path} is a directory; name a file in it")
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise TouchError(
            f"{path}: expected a file ending in {', '.join((*readers, *FRAME_SUFFIXES))}, "
            f"got {path.suffix or 'no ending'}"
        )
    if not path.is_file():
        raise TouchError(f"{path} does not exist")
    size = path.stat().st_size
    if size == 0:
        raise TouchError(f"{path} is empty; expected a cloud or a height map")
    if size > MAX_FILE_BYTES:
        raise TouchError(f"{path} has {size} bytes; at most {MAX_FILE_BYTES} are read")
    try:
        data = path.read_bytes()
        with path_in_errors(path):
            array = reader(data)
            if path.suffix.lower() == ".npz":
                _check_sensor(sensor_in_npz(data), sensor)
            return array
    except OSError as error:
        raise TouchError(f"{path} can't be read: {error.strerror or error}") from None


def _frame_heights(
    path: Path, sensor: SensorSpec, background: Path | None, calibration: Path | None
) -> NDArray[np.float32]:
    from cltp.sensing.calibration import default_calibration, load_calibration
    from cltp.sensing.marker_field import heights_of_frame

    frame = read_frame(path, sensor)
    if background is None:
        raise TouchError(
            f"{path} is a frame, and heights follow from its difference to the untouched gel: "
            "give a frame of the same unit with nothing touching it as --background"
        )
    net = load_calibration(calibration or default_calibration(sensor), sensor).net
    with path_in_errors(path):
        return heights_of_frame(frame, read_frame(background, sensor), net, sensor)


def _cloud_of(array: NDArray[np.float64], sensor: SensorSpec) -> TactileCloud:
    if array.ndim != 2:
        raise TouchError(
            f"expected a cloud (N, 3) or a height map (H, W), got an array of shape {array.shape}"
        )
    if array.shape[1] == 3:
        with np.errstate(over="ignore"):  # beyond float32 is beyond any sensor, and refused as such
            cloud = TactileCloud(points_mm=array.astype(np.float32), sensor=sensor)
        check_relief(cloud.points_mm[:, 2])
        return cloud
    rows, columns = array.shape
    expected = sensor.columns / sensor.rows
    if rows == 0 or columns == 0 or abs(columns / rows / expected - 1) > ASPECT_TOLERANCE:
        or_cloud = "; a cloud needs shape (N, 3)" if columns < LEAST_COLUMNS else ""
        raise TouchError(
            f"a height map of {rows} × {columns} doesn't fit {sensor.name}, whose sensing area is "
            f"{sensor.rows} × {sensor.columns} px (rows × columns, or any map of that aspect)"
            f"{or_cloud}"
        )
    if np.isfinite(array).all():
        check_relief(array, name="height map")
        highest = float(np.abs(array).max())
        if highest > sensor.gel_mm:
            raise TouchError(
                f"heights reach {highest:.3g} mm, more than the {sensor.gel_mm} mm gel of "
                f"{sensor.name}; is it in mm, with the untouched gel at 0? Divide µm by 1000"
            )
    return cloud_from_heights(array, sensor)
