"""Bodies from scanned meshes (millimetres): any closed mesh can be grasped in simulation.

The mesh is turned so that the fingers close on a narrow side that bulges in the middle, and the
longer of its other extents is upright. Its height field is cast with rays (open3d). It is rigid and
cannot be bruised.
"""

from __future__ import annotations

import math
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

RIGID_MPA = 2000.0
UNBRUISED_N = 1000.0
MAX_OPENING_MM = 1000 * MAX_WIDTH_M
_EXTENT_WEIGHT = 0.05  # hollow [mm] that outweighs a narrower grasp, per mm of width


def body_from_mesh(path: Path, *, mass_g: float | None, template: Body) -> Body:
    """Turn a mesh into a body between the fingers.

    Args:
        path: PLY, OBJ or STL file of a closed mesh in millimetres.
        mass_g: Its mass [g]; None: from its volume.
        template: Body with the friction of the new one.

    Raises:
        TouchError: The mesh is refused by ``sim.objects.meshes``, or too large for the gripper.
    """
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
        young_mpa=RIGID_MPA,
        poisson=0.3,
        friction=template.friction,
        bruise_n=UNBRUISED_N,
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
