"""TCL3D: what is pressed in every series of the data set, and the contacts that come of it.

A series is one object in one pose under one gel, pressed deeper and deeper. All that is drawn
follows from the seed and the number of the series; it is cast, solved and labelled alone, so that
its contacts don't depend on what is made beside it, on how many workers or on which machine.

Not here: how objects come to lie on the pad (``sim.tcl3d.poses``), files and worker processes
(``tacgrasp.datasets.generate``), noise (``cltp.tactile.sensor_noise``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import torch

from cltp.data.contact import Contact, Gel, Split
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import DEPTH_LIMITS_MM
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import ElasticLayer, GelMaterial, Press, gel_of
from sim.objects.catalogue import SMALL, THINGS, UNSEEN
from sim.objects.catalogue_large import LARGE
from sim.objects.object import Thing
from sim.objects.ray_casting import Felt, FloatArray, feel
from sim.objects.skins import SMOOTH, faded, relief_of
from sim.tcl3d.labels import in_contact, label
from sim.tcl3d.poses import Pose, draw_pose
from sim.tcl3d.shape_labels import name_shape
from sim.tcl3d.texture_labels import TEXTURE, doubts, name_texture
from sim.tcl3d.touch import Touch

ROWS, COLUMNS = 75, 100
"""Grid over the field of a GelSight Mini: 0.2 mm. Other sensors get elements of that size."""

CONTACTS, GELSTEREO_CONTACTS, GELSIGHT_CONTACTS = 50_860, 1_450, 115
"""Contacts of the main set and of two further domains. Source: the paper, section 3.1."""

ALL_CONTACTS = CONTACTS + GELSTEREO_CONTACTS + GELSIGHT_CONTACTS

LOADS, DOMAIN_LOADS = 4, 5
"""Contacts in a series: in the main set one in each class of depth where the gel allows it."""

GELSTEREO_FIRST, GELSIGHT_FIRST = 1_000_000, 2_000_000
"""Where the numbers of the domains' series begin."""

GELS = (
    GelMaterial(thickness_mm=3.6, young_mpa=0.145, poisson=0.495),
    GelMaterial(thickness_mm=3.4, young_mpa=0.145, poisson=0.480),
    GelMaterial(thickness_mm=3.9, young_mpa=0.145, poisson=0.470),
    GelMaterial(thickness_mm=4.3, young_mpa=0.145, poisson=0.490),
)
OTHER_GELS = (
    GelMaterial(thickness_mm=2.6, young_mpa=0.10, poisson=0.490),
    GelMaterial(thickness_mm=3.0, young_mpa=0.25, poisson=0.450),
    GelMaterial(thickness_mm=5.5, young_mpa=0.20, poisson=0.480),
)
"""Gels of training, the first the GelSight Mini's; and those of the split ``physics``, whose
thickness, modulus or Poisson's ratio training never saw. Our choice about the notes' h 3.4-4.6 mm,
nu 0.47-0.49."""

TEST_SHARE, VALIDATION_SHARE, PHYSICS_SHARE = 0.08, 0.04, 0.07
"""Shares of the series of seen objects; the rest is for training. Our choice."""

_TOLERANCE = 1e-3  # of the solver: heights within about 1 µm, as they are stored
_SHALLOWEST_MM, _SHALLOWEST_FINE_MM, _DEEPEST_MM = 0.1, 0.18, 1.3
_GENTLE_MM, _GENTLE_SHARE = 0.6, 0.22  # deepest where much of the field touches at once
_TOUCH_MM = 0.25  # gap up to which a surface counts for that
_HAND_MM, _HAND_SPREAD = 0.30, 0.507  # real hand presses: median, and spread of the logarithm
_MARGIN = 4  # grid points: what touches first nearer to the border slips off
_TRIES = 40


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """What lies over the pad in a series.

    Attributes:
        thing: The object.
        felt: Its bare surface there.
        cells: Shape (H, W), the cell of each point; -1 where nothing is.
        relief_mm: Shape (H, W), of its skin [mm].
        flat: Whether it was met on a flat face.
    """

    thing: Thing
    felt: Felt
    cells: np.ndarray[tuple[int, ...], np.dtype[np.int64]]
    relief_mm: FloatArray

    @property
    def gap_mm(self) -> FloatArray:
        """Shape (H, W), skin included; least value 0 [mm]."""
        there = self.cells >= 0
        gap = self.felt.gap_mm + self.relief_mm
        return np.where(there, gap - gap[there].min(), NO_BODY_MM)


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """What a series is to be.

    Attributes:
        number: Which series.
        thing: The object.
        sensor: Whose field.
        gel: Under which gel.
        split: What its contacts may be used for.
        loads: How many contacts.
    """

    number: int
    thing: Thing
    sensor: SensorSpec
    gel: GelMaterial
    split: Split
    loads: int


def grid_over(sensor: SensorSpec) -> tuple[int, int]:
    """Rows and columns of square elements over a sensor's field, as large as those of ``ROWS``."""
    element_mm = sensor_named("gelsight_mini").height_mm / ROWS
    columns = round(sensor.width_mm / element_mm)
    return round(sensor.height_mm * columns / sensor.width_mm), columns


def series_numbers(contacts: int) -> list[int]:
    """Numbers of the series of a data set of so many contacts, domains included in proportion.

    Args:
        contacts: At least 1; the last series may have to be cut.
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
"""Where the numbers of series of meshes begin, and how many each mesh has: 420 contacts, of the
paper's 400-500."""


def mesh_numbers(which: int) -> range:
    """Numbers of the series of mesh ``which``, from 0."""
    first = MESH_FIRST + MESH_SERIES * which
    return range(first, first + MESH_SERIES)


def num_loads(number: int) -> int:
    """Contacts in series ``number``."""
    return DOMAIN_LOADS if GELSTEREO_FIRST <= number < MESH_FIRST else LOADS


def order_of(seed: int, number: int) -> Order:
    """What series ``number`` of the data set of ``seed`` is to be."""
    if number >= GELSIGHT_FIRST:
        rng = np.random.default_rng([seed, number, 3])
        thing, sensor = LARGE[int(rng.integers(len(LARGE)))], sensor_named("gelsight_mini")
        return _order(number, thing, sensor, gel_of(sensor.name), Split.GELSIGHT, DOMAIN_LOADS)
    if number >= GELSTEREO_FIRST:
        thing, sensor = SMALL[number % len(SMALL)], sensor_named("gelstereo")
        return _order(number, thing, sensor, gel_of(sensor.name), Split.GELSTEREO, DOMAIN_LOADS)
    return _main_order(seed, number, THINGS[number % len(THINGS)])


def _main_order(seed: int, number: int, thing: Thing) -> Order:
    rng = np.random.default_rng([seed, number, 3])
    u, which = float(rng.random()), int(rng.integers(1 << 30))
    split = Split.TRAIN
    if thing.name in UNSEEN:
        split = Split.OBJECT
    elif u < TEST_SHARE:
        split = Split.TEST
    elif u < TEST_SHARE + VALIDATION_SHARE:
        split = Split.VALIDATION
    elif u < TEST_SHARE + VALIDATION_SHARE + PHYSICS_SHARE:
        split = Split.PHYSICS
    gels = OTHER_GELS if split is Split.PHYSICS else GELS
    sensor = sensor_named("gelsight_mini")
    return _order(number, thing, sensor, gels[which % len(gels)], split, LOADS)


def _order(
    number: int, thing: Thing, sensor: SensorSpec, gel: GelMaterial, split: Split, loads: int
) -> Order:
    return Order(number=number, thing=thing, sensor=sensor, gel=gel, split=split, loads=loads)


def make_series(
    seed: int, number: int, device: torch.device | str = "cpu", *, thing: Thing | None = None
) -> list[Contact]:
    """Make the contacts of one series, lightest first.

    Args:
        seed: Of the data set.
        number: Of the series (``series_numbers``, ``mesh_numbers``).
        device: Where rays are cast and contacts are solved.
        thing: What is pressed, instead of an object of the catalogue.
    """
    order = order_of(seed, number) if thing is None else _main_order(seed, number, thing)
    rng = np.random.default_rng([seed, number, 1])
    scene, depths = draw_scene(order, rng, device)
    soft = order.thing.modulus_mpa
    rows, columns = grid_over(order.sensor)
    layer = ElasticLayer(
        order.gel,
        rows=rows,
        columns=columns,
        pitch_mm=order.sensor.width_mm / columns,
        body_modulus_mpa=soft,
        device=device,
    )
    # A soft body flattens as well; 0.35 MPa stands for a gel on its back, roughly.
    approach = [depth * (1 + (0.35 / soft if soft else 0.0)) for depth in depths]
    gaps = torch.from_numpy(scene.gap_mm.astype(np.float32)).expand(len(depths), -1, -1)
    with torch.inference_mode():
        press = layer.press_to_depth(
            gaps.to(device), torch.tensor(approach, device=device), tol=_TOLERANCE
        )
    return _labelled(seed, order, scene, approach, press)


@torch.inference_mode()
def draw_scene(
    order: Order, rng: np.random.Generator, device: torch.device | str = "cpu"
) -> tuple[Scene, list[float]]:
    """Draw what lies over the pad, and how deep it is pressed [mm].

    Raises:
        ValueError: The object can't be brought to the pad.
    """
    thing, sensor = order.thing, order.sensor
    x, y = np.meshgrid(*grid_axes_mm(sensor, *grid_over(sensor)))
    textured = any(part.skin is not SMOOTH for part in thing.parts)
    lowest = _SHALLOWEST_FINE_MM if textured else _SHALLOWEST_MM
    shares = rng.random(order.loads)
    lightest = _depths(order, shares, lowest, gentle=False)[0]
    held = order.split is Split.GELSTEREO
    for tries in range(_TRIES):
        pose = draw_pose(thing, rng, sensor, lightest, held=held)
        felt = feel(thing, pose.object_from_pad, pose.point, x, y, device)
        slips = felt is not None and not pose.flat and _at_border(felt.gap_mm)
        if felt is not None and not (slips and tries < _TRIES // 2):
            break
    else:
        raise ValueError(f"{thing.name} could not be brought to the pad in {_TRIES} tries")
    scene = _scene(thing, pose, felt, rng, x, y, sensor)
    much = float((felt.gap_mm < _TOUCH_MM).mean()) > _GENTLE_SHARE
    return scene, _depths(order, shares, lowest, gentle=much)


def _depths(order: Order, shares: FloatArray, lowest: float, *, gentle: bool) -> list[float]:
    """Rising depths [mm]: one in each class, or spread like those of a hand or a machine."""
    if order.split is Split.GELSIGHT:
        normal = np.sqrt(2) * torch.special.erfinv(torch.from_numpy(2 * shares - 1)).numpy()
        depths = np.sort(_HAND_MM * np.exp(_HAND_SPREAD * normal)).clip(lowest, _DEEPEST_MM)
        return [float(d) for d in depths]
    limits = [lowest, *DEPTH_LIMITS_MM, _DEEPEST_MM]
    if gentle:
        limits = np.linspace(lowest, _GENTLE_MM, len(limits)).tolist()
    if order.split is Split.GELSTEREO:
        return [float(limits[0] + s * (limits[-1] - limits[0])) for s in np.sort(shares)]
    return [
        float(low + s * (high - low))
        for low, high, s in zip(limits, limits[1:], shares, strict=False)
    ]


def _at_border(gap_mm: FloatArray) -> bool:
    """Whether the foremost point is at the pad's border: the object slips off it."""
    row, column = np.unravel_index(int(gap_mm.argmin()), gap_mm.shape)
    rows, columns = gap_mm.shape
    return not (_MARGIN <= row < rows - _MARGIN and _MARGIN <= column < columns - _MARGIN)


def _scene(
    thing: Thing,
    pose: Pose,
    felt: Felt,
    rng: np.random.Generator,
    x: FloatArray,
    y: FloatArray,
    sensor: SensorSpec,
) -> Scene:
    there = felt.gap_mm < NO_BODY_MM
    cells = np.full(there.shape, -1, dtype=np.int64)
    cells[there] = thing.cell(torch.from_numpy(felt.points[there])).numpy()
    axis = pose.object_from_pad[2, :2]
    if np.hypot(*axis) < 0.3:
        axis = pose.object_from_pad[0, :2]
    relief = np.zeros(there.shape)
    part_of_cell = np.array([*thing.part_of_cell, -1])
    for number, part in enumerate(thing.parts):
        own = relief_of(part.skin, rng, x, y, math.atan2(axis[1], axis[0]), sensor)
        if part.skin is not SMOOTH:
            relief = np.where(part_of_cell[cells] == number, own, relief)
    if relief.any():
        down, right = np.gradient(felt.gap_mm, sensor.width_mm / felt.gap_mm.shape[1])
        relief = faded(relief, np.hypot(down, right))
    return Scene(thing=thing, felt=felt, cells=cells, relief_mm=relief)


def _labelled(
    seed: int, order: Order, scene: Scene, approach: list[float], press: Press
) -> list[Contact]:
    pitch = order.sensor.width_mm / scene.cells.shape[1]
    pressure = press.pressure_kpa.cpu()
    closed = in_contact(pressure, pitch)
    material = order.gel
    gel = Gel(
        thickness_mm=material.thickness_mm,
        young_mpa=material.young_mpa,
        poisson=material.poisson,
    )
    contacts = []
    for i, approach_mm in enumerate(approach):
        height_mm, load = press.height_mm[i].cpu().numpy(), pressure[i].numpy()
        touch = Touch(
            gap_mm=scene.felt.gap_mm,
            cells=scene.cells,
            table=scene.thing.cells,
            touching=load > 0,
            closed=closed[i],
            depth_mm=float(height_mm.max()),
            pitch_mm=pitch,
        )
        shape = name_shape(touch)
        texture = name_texture(scene.thing, touch, scene.relief_mm)
        state = label(
            height_mm=height_mm,
            pressure_kpa=load,
            touching=closed[i],
            force_n=float(press.force_n[i]),
            sensor=order.sensor,
            shape=shape.shape,
            texture=texture.texture,
        )
        unsure = doubts(state, order.sensor)
        unsure |= {"shape"} if not shape.sure else set()
        unsure |= {TEXTURE} if not texture.sure else set()
        contacts.append(
            Contact(
                height_mm=height_mm,
                sensor=order.sensor,
                state=state,
                object=order.thing.name,
                series=order.number,
                split=order.split,
                gel=gel,
                seed=seed,
                unsure=frozenset(unsure),
                approach_mm=approach_mm,
                peak_kpa=float(load.max()),
            )
        )
    return contacts
