"""Geometry constants of the supported tactile sensors, and the gel frame they share.

Gel frame: origin at the centre of the sensing area, in the sensor's own view; +x right, +y towards
the palm ('top'), -y towards the fingertip ('bottom'), z = indentation in mm, positive into the gel.
Row 0 of a height map is the top (+y), column 0 the left (-x).

Not here: materials and noise of a gel (``sim.gel.layer``, ``cltp.tactile.sensor_noise``), frame
capture (drivers).
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from cltp.errors import TouchError

MAX_PX = 10_000
"""Most pixels along a side of any sensor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SensorSpec:
    """Constants of one model of sensor.

    Attributes:
        name: Identifier used in files and on the command line.
        columns: Width of its height map [px].
        rows: Height of its height map [px].
        mm_per_px: Edge of a (square) pixel on the gel [mm].
        gel_mm: Thickness of the gel [mm], the limit of any indentation.
        max_depth_mm: Indentation at which the scaled z is 1 [mm].
        markers: Rows and columns of tracked markers, each in the middle of one of as many equal
            cells of the sensing area; None where the sensor sees its whole surface.
        shear_grid: Rows and columns of the points at which it measures displacement along the
            surface too, in equal cells likewise; None where it measures none.
        frame_hz: Frames that it gives in a second [Hz].

    Raises:
        TouchError: A number that no sensor has.
    """

    name: str
    columns: int
    rows: int
    mm_per_px: float
    gel_mm: float
    max_depth_mm: float
    markers: tuple[int, int] | None = None
    shear_grid: tuple[int, int] | None = None
    frame_hz: float = 25.0

    def __post_init__(self) -> None:
        counts = (self.columns, self.rows, *(self.markers or ()), *(self.shear_grid or ()))
        numbers = (self.mm_per_px, self.gel_mm, self.max_depth_mm, self.frame_hz)
        if not (all(1 <= n <= MAX_PX for n in counts) and all(0 < x < 1e3 for x in numbers)):
            raise TouchError(
                f"no sensor has {self.columns} × {self.rows} px, {self.mm_per_px} mm/px, a gel of "
                f"{self.gel_mm} mm, {self.max_depth_mm} mm deep at most, markers {self.markers}, "
                f"shear at {self.shear_grid}, {self.frame_hz} Hz"
            )

    @property
    def width_mm(self) -> float:
        """Extent of the sensing area along x [mm]."""
        return self.columns * self.mm_per_px

    @property
    def height_mm(self) -> float:
        """Extent of the sensing area along y [mm]."""
        return self.rows * self.mm_per_px

    @property
    def area_mm2(self) -> float:
        """Size of the sensing area [mm²]."""
        return self.width_mm * self.height_mm


# 320×240 px and 0.0634 mm/px: gsrobotics README (GelSight Mini); gel 3.4 mm: fit of the elastic
# layer to real presses (``tacgrasp bench gel``). DIGIT: 320×240 at the value that gs_sdk uses; gel
# thickness not published, assumed like the Mini's. GelStereo 2.0: about 530 tracked points, a
# square area of 595 px at f = 651 px and 28.7 mm, so 26.2 mm (TacFlex by its makers,
# github.com/Zhang-Chaofan); that the points are 23 × 23 in equal cells, and the gel's thickness,
# are assumed. Rows, columns and mm_per_px are those of the grid that we simulate it on. GelSight
# R1.5: 320×240 px and 0.081 mm/px (gsrobotics, its 3D view); gel thickness not published, assumed
# like the Mini's. GelSight Mini with the marker gel: 7 × 9 markers (trackers that build on
# gsrobotics count them so); that they lie in equal cells is assumed. Taxels: an array of our own
# (docs/taxels.md) that sends displacements at 12 × 12 points, 100 times a second, from a gel like
# the Mini's: assumed. Frame rates of the others: 25 Hz, that of a GelSight Mini.
_TABLE: tuple[tuple[Any, ...], ...] = (
    ("gelsight_mini", 320, 240, 0.0634, 3.4, 1.5, None, None, 25.0),
    ("gelsight_mini_markers", 320, 240, 0.0634, 3.4, 1.5, None, (7, 9), 25.0),
    ("gelsight_r15", 320, 240, 0.081, 3.4, 1.5, None, None, 25.0),
    ("digit", 320, 240, 0.0405, 3.4, 1.5, None, None, 25.0),
    ("gelstereo", 240, 240, 0.1092, 4.0, 1.5, (23, 23), None, 25.0),
    ("taxels", 320, 240, 0.0634, 3.4, 1.5, (12, 12), (12, 12), 100.0),
)
_FIELDS = [field.name for field in fields(SensorSpec)]
SENSORS = {row[0]: SensorSpec(**dict(zip(_FIELDS, row, strict=True))) for row in _TABLE}


def sensor_named(name: str) -> SensorSpec:
    """Return the sensor called ``name``.

    Raises:
        TouchError: No sensor has this name; the message lists those that exist.
    """
    try:
        return SENSORS[name]
    except KeyError:
        raise TouchError(f"unknown sensor {name!r}; known: {', '.join(sorted(SENSORS))}") from None
