"""Bodies from scanned meshes (millimetres): any closed mesh can be grasped in simulation.

The mesh is turned so that the fingers close on a narrow side that bulges in the middle, and the
longer of its other extents is upright. Its height field is cast with rays (open3d). Stiffness,
friction and bruise force are those of the drawn body whose place it takes, unless given.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from sim.gel.gap import NO_BODY_MM
from sim.grasp.bodies import GRID_MM, HALF_SPAN_MM, Body
from sim.grasp.devices import MAX_WIDTH_M
from sim.objects.meshes import IntArray, checked_mesh, ray_scene, volume_and_centre

DENSITY_G_PER_MM3 = 0.3e-3
"""Density of a mesh without a given mass. Our assumption: household objects are hollow or light."""

MASS_G = (0.1, 5000.0)
YOUNG_MPA = (0.005, 5e5)
"""Range of Young's moduli [MPa], from the softest gelatine to tungsten carbide."""

BRUISE_N = (0.05, 2000.0)
"""Range of bruise forces [N]. Our choice: the gripper presses with 20 N at most."""

MAX_OPENING_MM = 1000 * MAX_WIDTH_M
_EXTENT_WEIGHT = 0.05  # hollow [mm] that outweighs a narrower grasp, per mm of width


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


def body_from_mesh(scanned: ScannedObject, template: Body) -> Body:
    """Turn a mesh into a body between the fingers.

    Args:
        scanned: The mesh.
        template: Drawn body whose place it takes.

    Raises:
        TouchError: The mesh is refused by ``sim.objects.meshes``, or too large for the gripper.
    """
    path, mass_g = scanned.path, scanned.mass_g
    vertices, faces = checked_mesh(path)
    extents = np.ptp(vertices, axis=0)
    if extents.min() > MAX_OPENING_MM:
        raise TouchError(
            f"{path}: its smallest extent is {extents.min():.0f} mm, more than the gripper opens "
            f"({MAX_OPENING_MM:.0f} mm)"
        )
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    volume_mm3, centre = volume_and_centre(vertices, faces)
    grasps = []
    for closing in np.flatnonzero(extents <= MAX_OPENING_MM):
        turn = _turn(extents, int(closing))
        gap = _gap((vertices - middle) @ turn.T, faces)
        hollow = float(gap[gap.shape[0] // 2, gap.shape[1] // 2])
        grasps.append((hollow + _EXTENT_WEIGHT * extents[closing], closing, turn, gap))
    _, closing, turn, gap = min(grasps, key=lambda grasp: grasp[0])
    if gap.min() >= NO_BODY_MM:
        raise TouchError(f"{path}: no surface within {HALF_SPAN_MM} mm of the mesh's centre")
    com = turn @ (centre - middle)
    if mass_g is None:
        mass_g = max(1.0, DENSITY_G_PER_MM3 * volume_mm3)
    width, height, _ = np.abs(turn) @ extents
    return Body(
        name=path.stem,
        gap_mm=gap,
        com_mm=(float(com[0]), float(com[1])),
        gyration_mm=math.hypot(width, height) / math.sqrt(12),
        thickness_mm=float(extents[closing]),
        mass_kg=mass_g / 1000,
        young_mpa=scanned.young_mpa or template.young_mpa,
        poisson=template.poisson,
        friction=template.friction,
        bruise_n=scanned.bruise_n or template.bruise_n,
    )


def _turn(extents: FloatArray, closing: int) -> FloatArray:
    """Rotation that brings axis ``closing`` to +z and the longer of the others upright, +y."""
    across, along = sorted((axis for axis in range(3) if axis != closing), key=lambda a: extents[a])
    turn = np.zeros((3, 3))
    turn[0, across] = turn[1, along] = turn[2, closing] = 1.0
    if np.linalg.det(turn) < 0:
        turn[0] *= -1
    return turn


def _gap(vertices: FloatArray, faces: IntArray) -> FloatArray:
    """Height field of the side towards the sensor's finger (+z), as ``Body.gap_mm``."""
    scene, tensor = ray_scene(vertices, faces)
    x, y = np.meshgrid(GRID_MM, -GRID_MM)
    top = float(vertices[:, 2].max()) + 1.0
    origins = np.stack([x, y, np.full_like(x, top)], axis=-1)
    rays = np.concatenate([origins, np.zeros_like(origins)], axis=-1)
    rays[..., 5] = -1.0
    reach = scene.cast_rays(tensor(rays.astype(np.float32)))["t_hit"].numpy()
    hit = np.isfinite(reach)
    if not hit.any():
        return np.full(reach.shape, NO_BODY_MM)
    gap = np.where(hit, reach - reach[hit].min(), NO_BODY_MM)
    return np.clip(gap, 0.0, NO_BODY_MM).astype(np.float64)
