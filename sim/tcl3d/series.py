"""The series of the TCL3D data set: object, pose and gel of each, and its labelled contacts.

A series is one object in one pose under one gel, pressed to rising depths. Every draw follows from
the seed and the number of the series. A series is cast, solved and labelled alone, so that its
contacts depend neither on other series, nor on the number of workers, nor on the machine.

Not here: poses (``sim.tcl3d.poses``), files and worker processes (``tacgrasp.datasets.generate``),
noise (``cltp.tactile.sensor_noise``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import torch

from cltp.data.contact import Contact, Split
from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import DEPTH_LIMITS_MM
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import ElasticLayer, GelMaterial, Press, gel_of
from sim.objects.catalogue import CATALOGUE, SMALL, UNSEEN
from sim.objects.catalogue_large import LARGE
from sim.objects.object import SolidObject
from sim.objects.ray_casting import PadView, cast_pad_rays
from sim.objects.skins import SMOOTH, fade, relief_of
from sim.tcl3d.contact_geometry import ContactGeometry, Mask
from sim.tcl3d.labelled_press import Naming, label_press
from sim.tcl3d.labels import name_texture
from sim.tcl3d.poses import PressPose, draw_pose
from sim.tcl3d.shape_labels import name_shape

ROWS, COLUMNS = 75, 100
"""Grid over the sensing area of a GelSight Mini: 0.2 mm; other sensors get elements as large."""

CONTACTS, GELSTEREO_CONTACTS, GELSIGHT_CONTACTS = 50_860, 1_450, 115
"""Contacts of the main set and of two further domains. Source: the paper, section 3.1."""

ALL_CONTACTS = CONTACTS + GELSTEREO_CONTACTS + GELSIGHT_CONTACTS

LOADS, DOMAIN_LOADS = 4, 5
"""Contacts of a series: in the main set one of each depth class where the gel allows it."""

GELSTEREO_FIRST, GELSIGHT_FIRST = 1_000_000, 2_000_000
"""First series numbers of the two domains."""

GELS = (
    gel_of("gelsight_mini"),
    GelMaterial(thickness_mm=3.2, young_mpa=0.59, poisson=0.480),
    GelMaterial(thickness_mm=3.8, young_mpa=0.254, poisson=0.490),
    GelMaterial(thickness_mm=4.2, young_mpa=0.34, poisson=0.470),
)
OTHER_GELS = (
    GelMaterial(thickness_mm=2.6, young_mpa=0.20, poisson=0.490),
    GelMaterial(thickness_mm=3.0, young_mpa=0.72, poisson=0.450),
    GelMaterial(thickness_mm=5.5, young_mpa=0.65, poisson=0.480),
)
"""Gels of training, and those of the split ``physics``, whose thickness, modulus or Poisson's ratio
does not occur in training. Our choice: training has Young's modulus over 0.6-1.4 of nominal and h
3.2-4.2 mm, as units differ; the split lies outside. In the set ``full``, which has thicknesses of
2.3 to 6.2 mm, it lies between those, and outside in the modulus."""

TEST_FRACTION, VALIDATION_FRACTION, PHYSICS_FRACTION = 0.08, 0.04, 0.07
"""Fractions of the series of seen objects; the rest is for training. Our choice."""

_TOLERANCE = 1e-3  # of the solver: heights within about 1 µm, as they are stored
_SHALLOWEST_MM, _SHALLOWEST_FINE_MM, _DEEPEST_MM = 0.1, 0.18, 1.3
_GENTLE_MM, _GENTLE_FRACTION = 0.6, 0.22  # depth limit where more than this fraction is near
_NEAR_MM = 0.25  # largest gap of surface that is near
_HAND_MM, _HAND_SPREAD = 0.30, 0.507  # depths of real hand presses: median, spread of the logarithm
_BORDER_MARGIN = 4  # grid points: an object that first touches nearer to the border slips off
_MAX_ATTEMPTS = 40


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """Object over the pad in a series.

    Attributes:
        view: Bare surface of the object over the pad.
        cells: Shape (H, W), index of the cell at each point; -1 where there is no surface.
        relief_mm: Shape (H, W), relief of its skin [mm].
    """

    view: PadView
    cells: np.ndarray[tuple[int, ...], np.dtype[np.int64]]
    relief_mm: FloatArray

    @property
    def gap_mm(self) -> FloatArray:
        """Gap with the skin, shape (H, W), least value 0 [mm]."""
        covered = self.cells >= 0
        gap = self.view.gap_mm + self.relief_mm
        return np.where(covered, gap - gap[covered].min(), NO_BODY_MM)


@dataclass(frozen=True, slots=True, kw_only=True)
class SeriesRequest:
    """Settings of one series.

    Attributes:
        number: Number of the series.
        obj: The pressed object.
        gel: Gel of the sensor.
        split: The split of its contacts.
    """

    number: int
    obj: SolidObject
    gel: GelMaterial
    split: Split

    @property
    def sensor(self) -> SensorSpec:
        return sensor_named("gelstereo" if self.split is Split.GELSTEREO else "gelsight_mini")


def grid_over(sensor: SensorSpec) -> tuple[int, int]:
    """Rows and columns of a sensor's grid, with square elements of the size that ``ROWS`` gives."""
    element_mm = sensor_named("gelsight_mini").height_mm / ROWS
    columns = round(sensor.width_mm / element_mm)
    return round(sensor.height_mm * columns / sensor.width_mm), columns


def series_numbers(contacts: int) -> list[int]:
    """Numbers of the series of a data set with ``contacts`` contacts, domains in proportion.

    Args:
        contacts: At least 1; the last series may have to be cut short.
    """
    stereo = contacts * GELSTEREO_CONTACTS // ALL_CONTACTS // DOMAIN_LOADS
    sight = contacts * GELSIGHT_CONTACTS // ALL_CONTACTS // DOMAIN_LOADS
    main = math.ceil((contacts - (stereo + sight) * DOMAIN_LOADS) / LOADS)
    return [
        *range(main),
        *range(GELSTEREO_FIRST, GELSTEREO_FIRST + stereo),
        *range(GELSIGHT_FIRST, GELSIGHT_FIRST + sight),
    ]


MESH_FIRST, MESH_SERIES = 3_000_000, 105
"""First series number of meshes, and number of series of each mesh: 420 contacts, within the
paper's 400-500."""


def mesh_numbers(index: int) -> range:
    """Numbers of the series of mesh ``index``, from 0."""
    first = MESH_FIRST + MESH_SERIES * index
    return range(first, first + MESH_SERIES)


def num_loads(number: int) -> int:
    """Contacts in series ``number``."""
    return DOMAIN_LOADS if GELSTEREO_FIRST <= number < MESH_FIRST else LOADS


def series_request(seed: int, number: int) -> SeriesRequest:
    """Object, sensor, gel and split of series ``number`` of the data set of ``seed``."""
    if number < GELSTEREO_FIRST:
        return _main_request(seed, number, CATALOGUE[number % len(CATALOGUE)])
    if number < GELSIGHT_FIRST:
        obj, gel, split = SMALL[number % len(SMALL)], gel_of("gelstereo"), Split.GELSTEREO
    else:
        index = int(np.random.default_rng([seed, number, 3]).integers(len(LARGE)))
        obj, gel, split = LARGE[index], gel_of("gelsight_mini"), Split.GELSIGHT
    return SeriesRequest(number=number, obj=obj, gel=gel, split=split)


def _main_request(seed: int, number: int, obj: SolidObject) -> SeriesRequest:
    rng = np.random.default_rng([seed, number, 3])
    u, index = float(rng.random()), int(rng.integers(1 << 30))
    split = Split.TRAIN
    if obj.name in UNSEEN:
        split = Split.OBJECT
    elif u < TEST_FRACTION:
        split = Split.TEST
    elif u < TEST_FRACTION + VALIDATION_FRACTION:
        split = Split.VALIDATION
    elif u < TEST_FRACTION + VALIDATION_FRACTION + PHYSICS_FRACTION:
        split = Split.PHYSICS
    gels = OTHER_GELS if split is Split.PHYSICS else GELS
    return SeriesRequest(number=number, obj=obj, gel=gels[index % len(gels)], split=split)


def make_series(
    seed: int, number: int, device: torch.device | str = "cpu", *, obj: SolidObject | None = None
) -> list[Contact]:
    """Make the contacts of one series, lightest first.

    Args:
        seed: Random seed of the data set.
        number: Number of the series (``series_numbers``, ``mesh_numbers``).
        device: Torch device on which rays are cast and contacts are solved.
        obj: Object to press instead of one of the catalogue.
    """
    request = series_request(seed, number) if obj is None else _main_request(seed, number, obj)
    rng = np.random.default_rng([seed, number, 1])
    scene, approach = draw_scene(request, rng, device)
    rows, columns = grid_over(request.sensor)
    layer = ElasticLayer(
        request.gel,
        rows=rows,
        columns=columns,
        pitch_mm=request.sensor.width_mm / columns,
        body_modulus_mpa=request.obj.modulus_mpa,
        device=device,
    )
    gaps = torch.from_numpy(scene.gap_mm.astype(np.float32)).expand(len(approach), -1, -1)
    with torch.inference_mode():
        press = layer.press_to_depth(
            gaps.to(device), torch.tensor(approach, device=device), tol=_TOLERANCE
        )
    return label_scene(seed, request, scene, press)


@torch.inference_mode()
def draw_scene(
    request: SeriesRequest, rng: np.random.Generator, device: torch.device | str = "cpu"
) -> tuple[Scene, list[float]]:
    """Draw the pose of the object, cast its surface, and draw the approaches of the presses [mm].

    Raises:
        ValueError: No pose of the object on the pad was found.
    """
    obj, sensor = request.obj, request.sensor
    x, y = np.meshgrid(*grid_axes_mm(sensor, *grid_over(sensor)))
    textured = any(part.skin is not SMOOTH for part in obj.parts)
    shallowest_mm = _SHALLOWEST_FINE_MM if textured else _SHALLOWEST_MM
    fractions = rng.random(num_loads(request.number))
    lightest = _depths(request, fractions, shallowest_mm, gentle=False)[0]
    mounted = request.split is Split.GELSTEREO
    for attempt in range(_MAX_ATTEMPTS):
        pose = draw_pose(obj, rng, sensor, lightest, mounted=mounted)
        view = cast_pad_rays(obj, pose.object_from_pad, pose.point, x, y, device)
        slips = view is not None and not pose.flat and _at_border(view.gap_mm)
        if view is not None and not (slips and attempt < _MAX_ATTEMPTS // 2):
            break
    else:
        raise ValueError(f"{obj.name} could not be brought to the pad in {_MAX_ATTEMPTS} attempts")
    scene = _scene(obj, pose, view, rng, x, y, sensor)
    is_gentle = float((view.gap_mm < _NEAR_MM).mean()) > _GENTLE_FRACTION
    # A soft body flattens as well; 0.35 MPa is roughly the stiffness of a gel on its back.
    factor = 1 + (0.35 / obj.modulus_mpa if obj.modulus_mpa else 0.0)
    depths = _depths(request, fractions, shallowest_mm, gentle=is_gentle)
    return scene, [depth * factor for depth in depths]


def _depths(
    request: SeriesRequest, fractions: FloatArray, shallowest_mm: float, *, gentle: bool
) -> list[float]:
    """Rising depths [mm]: one of each class, or distributed like those of a hand or a machine."""
    if request.split is Split.GELSIGHT:
        normal = np.sqrt(2) * torch.special.erfinv(torch.from_numpy(2 * fractions - 1)).numpy()
        depths = np.sort(_HAND_MM * np.exp(_HAND_SPREAD * normal)).clip(shallowest_mm, _DEEPEST_MM)
        return [float(d) for d in depths]
    limits = [shallowest_mm, *DEPTH_LIMITS_MM, _DEEPEST_MM]
    if gentle:
        limits = np.linspace(shallowest_mm, _GENTLE_MM, len(limits)).tolist()
    if request.split is Split.GELSTEREO:
        return [float(limits[0] + s * (limits[-1] - limits[0])) for s in np.sort(fractions)]
    return [
        float(low + s * (high - low))
        for low, high, s in zip(limits, limits[1:], fractions, strict=False)
    ]


def _at_border(gap_mm: FloatArray) -> bool:
    """Whether the foremost point is at the pad's border, where the object slips off."""
    row, column = np.unravel_index(int(gap_mm.argmin()), gap_mm.shape)
    rows, columns = gap_mm.shape
    return min(row, column, rows - 1 - row, columns - 1 - column) < _BORDER_MARGIN


def _scene(
    obj: SolidObject,
    pose: PressPose,
    view: PadView,
    rng: np.random.Generator,
    x: FloatArray,
    y: FloatArray,
    sensor: SensorSpec,
) -> Scene:
    covered = view.gap_mm < NO_BODY_MM
    cells = np.full(covered.shape, -1, dtype=np.int64)
    cells[covered] = obj.cell(torch.from_numpy(view.points[covered])).numpy()
    axis = pose.object_from_pad[2, :2]
    if np.hypot(*axis) < 0.3:
        axis = pose.object_from_pad[0, :2]
    relief = np.zeros(covered.shape)
    part_of_cell = np.array([*obj.part_of_cell, -1])
    for number, part in enumerate(obj.parts):
        own = relief_of(part.skin, rng, x, y, math.atan2(axis[1], axis[0]), sensor)
        if part.skin is not SMOOTH:
            relief = np.where(part_of_cell[cells] == number, own, relief)
    if relief.any():
        down, right = np.gradient(view.gap_mm, sensor.width_mm / view.gap_mm.shape[1])
        relief = fade(relief, np.hypot(down, right))
    return Scene(view=view, cells=cells, relief_mm=relief)


def label_scene(seed: int, request: SeriesRequest, scene: Scene, press: Press) -> list[Contact]:
    """Contacts of a series that has been pressed, with their labels."""

    def name(touching: Mask, closed: Mask, depth_mm: float) -> Naming:
        geometry = ContactGeometry(
            gap_mm=scene.view.gap_mm,
            cells=scene.cells,
            cell_table=request.obj.cells,
            touching=touching,
            closed=closed,
            depth_mm=depth_mm,
            pitch_mm=request.sensor.width_mm / scene.cells.shape[1],
        )
        texture, is_texture_sure = name_texture(request.obj, geometry, scene.relief_mm)
        return Naming(shape=name_shape(geometry), texture=texture, is_texture_sure=is_texture_sure)

    return label_press(
        press,
        name,
        object_name=request.obj.name,
        sensor=request.sensor,
        gel=request.gel,
        split=request.split,
        seed=seed,
        series=request.number,
    )
