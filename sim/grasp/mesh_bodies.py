"""Bodies from scanned meshes (millimetres): any closed mesh can be grasped in simulation.

The fingers close where ``sim.grasp.antipodal`` finds opposite surface. The height field there is
cast with rays (open3d), on the side with the smaller patch; as for every body, both fingers are
given the same. Stiffness, friction and bruise force are those of the drawn body whose place it
takes, unless given.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from sim.gel.gap import NO_BODY_MM
from sim.grasp.antipodal import GraspPlace, find_grasp
from sim.grasp.bodies import OBJECTS, Body
from sim.grasp.pad_casting import CLEAR_MM
from sim.grasp.revolved import GRID_MM
from sim.grasp.ripeness import BerrySize, Flesh
from sim.objects.meshes import IntArray, checked_mesh, ray_scene, volume_and_centre

DENSITY_G_PER_MM3 = 0.3e-3
"""Density of a mesh without a given mass. Our assumption: household objects are hollow or light."""

MASS_G = (0.1, 5000.0)
YOUNG_MPA = (0.005, 5e5)
"""Range of Young's moduli [MPa], from the softest gelatine to tungsten carbide."""

BRUISE_N = (0.05, 2000.0)
"""Range of bruise forces [N]. Our choice: the gripper presses with 20 N at most."""

PAD_MM = (20.3, 15.2)
"""Width and height of the pad of a GelSight Mini [mm]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ScannedObject:
    """A mesh to grasp, and what is known of its material.

    Attributes:
        path: PLY, OBJ, STL or OFF file of a closed mesh in millimetres.
        mass_g: Mass [g]; None: from its volume and ``DENSITY_G_PER_MM3``.
        young_mpa: Young's modulus [MPa]; None: that of the drawn body.
        bruise_n: Force of flat gelled fingers that just bruises it [N]; None: that of the drawn
            body.

    Raises:
        TouchError: A number outside its range.
    """

    path: Path
    mass_g: float | None = None
    young_mpa: float | None = None
    bruise_n: float | None = None

    def __post_init__(self) -> None:
        for what, value, (low, high), unit in (
            ("mass", self.mass_g, MASS_G, "g"),
            ("Young's modulus", self.young_mpa, YOUNG_MPA, "MPa"),
            ("bruise force", self.bruise_n, BRUISE_N, "N"),
        ):
            if value is not None and not low <= value <= high:  # NaN too
                raise TouchError(
                    f"{self.path}: its {what} must be {low:g} to {high:g} {unit}, got {value:g}"
                )


def body_from_mesh(
    scanned: ScannedObject, template: Body, pad_mm: tuple[float, float] = PAD_MM
) -> Body:
    """Turn a mesh into a body between the fingers.

    Args:
        scanned: The mesh.
        template: Drawn body whose place it takes.
        pad_mm: Width and height of a pad [mm].

    Raises:
        TouchError: The mesh is refused by ``sim.objects.meshes``, or can't be grasped.
    """
    vertices, faces = checked_mesh(scanned.path)
    try:
        place = find_grasp(vertices, faces, pad_mm)
    except TouchError as error:
        raise TouchError(f"{scanned.path}: {error}") from None
    return placed_body(scanned, template, vertices, faces, place, pad_mm)


def placed_body(
    scanned: ScannedObject,
    template: Body,
    vertices: FloatArray,
    faces: IntArray,
    place: GraspPlace,
    pad_mm: tuple[float, float] = PAD_MM,
) -> Body:
    """The body that the fingers hold at one place of a mesh.

    Args:
        scanned: The mesh.
        template: Drawn body whose place it takes.
        vertices: The mesh's vertices, shape (V, 3) [mm].
        faces: Its faces, shape (F, 3).
        place: Where the fingers close.
        pad_mm: Width and height of a pad [mm].
    """
    turn, volume_mm3, com = place.body_from_mesh, *volume_and_centre(vertices, faces)
    mass_g = scanned.mass_g or _mass_g(volume_mm3)
    across, upright, _ = np.ptp(vertices @ turn.T, axis=0)
    com_x, com_y, _ = turn @ (com - np.array(place.centre_mm))
    com_mm = (float(com_x), float(com_y))
    size = BerrySize(mass_g=mass_g, size_mm=place.width_mm, com_mm=com_mm)
    flesh = _flesh(template, size)
    return Body(
        name=scanned.path.stem,
        gap_mm=_gap(vertices, faces, place, pad_mm),
        com_mm=com_mm,
        gyration_mm=math.hypot(across, upright) / math.sqrt(12),
        thickness_mm=place.width_mm,
        mass_kg=mass_g / 1000,
        young_mpa=scanned.young_mpa or flesh.young_mpa,
        poisson=template.poisson,
        friction=template.friction,
        bruise_n=scanned.bruise_n or flesh.bruise_n,
    )


def _flesh(drawn: Body, mesh: BerrySize) -> Flesh:
    """Stiffness and bruise force of a mesh: those of the drawn body, or of one as ripe as it."""
    flesh = Flesh(young_mpa=drawn.young_mpa, bruise_n=drawn.bruise_n)
    if OBJECTS[drawn.name].ripeness is None:
        return flesh
    size = BerrySize(mass_g=1000 * drawn.mass_kg, size_mm=drawn.thickness_mm, com_mm=drawn.com_mm)
    return mesh.flesh(size.ripeness(flesh))


def natural_mass_g(vertices: FloatArray, faces: IntArray) -> float:
    """Mass of a mesh that is given none [g]."""
    return _mass_g(volume_and_centre(vertices, faces)[0])


def _mass_g(volume_mm3: float) -> float:
    return max(1.0, DENSITY_G_PER_MM3 * volume_mm3)


def _gap(
    vertices: FloatArray, faces: IntArray, place: GraspPlace, pad_mm: tuple[float, float]
) -> FloatArray:
    """Height field that the camera's finger meets, as ``Body.gap_mm``.

    Rays start ``CLEAR_MM`` before the pad's place: what lies behind the finger is not met, and what
    already stands in the start is the nearest of all.
    """
    scene, tensor = ray_scene(vertices, faces)
    x, y = np.meshgrid(GRID_MM, -GRID_MM)
    start = np.full_like(x, place.width_mm / 2 + CLEAR_MM)
    turn = place.body_from_mesh
    origins = np.stack([x, y, start], axis=-1) @ turn + np.array(place.centre_mm)
    rays = np.concatenate([origins, np.broadcast_to(-turn[2], origins.shape)], axis=-1)
    hits = scene.cast_rays(tensor(rays.astype(np.float32)))
    distance = hits["t_hit"].numpy().astype(np.float64)
    starts_inside = np.isfinite(distance) & (hits["primitive_normals"].numpy() @ turn[2] < 0)
    distance[starts_inside] = 0.0
    on_pad = (np.abs(x) <= pad_mm[0] / 2) & (np.abs(y) <= pad_mm[1] / 2)
    return np.minimum(distance - distance[on_pad].min(), NO_BODY_MM)
