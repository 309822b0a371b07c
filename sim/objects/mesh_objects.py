"""Objects from meshes (millimetres), in addition to those of the catalogue.

A mesh is cut into regions along its creases; a region is flat, curved, or around a tip. The regions
that touch then label a contact as for any object (``sim.tcl3d.shape_labels``): a scanned box gives
planes, edges and corners like one of solids.

Not here: reading and checking mesh files (``sim.objects.meshes``), rays
(``sim.objects.mesh_rays``).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.objects.faces import Cell, Form
from sim.objects.mesh_rays import mesh_rays
from sim.objects.meshes import SUFFIXES, IntArray, checked_mesh, connected_parts
from sim.objects.object import Family, Part, SolidObject

CREASE_DEG = 25.0
"""Angle between faces from which they belong to different regions. Our choice: a tube with 16 sides
is still round."""

SMALL_MM = 50.0
"""Largest extent of a small object. Source: the paper, section 3.1."""

_INSIDE_CHECK_STRIDE = 37  # rays between those that are checked for a start inside the mesh
_LEVEL_DEG = 2.0  # largest deviation of a normal in a flat region
_TIP_MM = 0.6  # faces this near to a tip belong to it
_TIP_DEFECT = 1.2  # angle defect of the vertex at a tip, at least [rad]


def meshes_in(folder: Path) -> list[Path]:
    """List the mesh files of a folder, by name.

    Raises:
        TouchError: The folder does not exist or has no mesh.
    """
    if not folder.is_dir():
        raise TouchError(f"{folder} is no folder; --meshes expects one with PLY, OBJ or STL files")
    paths = sorted(path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES)
    if not paths:
        raise TouchError(f"{folder} has no mesh; expected files that end in {', '.join(SUFFIXES)}")
    return paths


@lru_cache(maxsize=4)
def object_from_mesh(path: Path) -> SolidObject:
    """Make a smooth, rigid object of a mesh, centred on its bounding box.

    Raises:
        TouchError: The mesh is not one closed surface in mm; the message says why.
    """
    vertices, faces = checked_mesh(path)
    vertices = vertices - (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    surface = _MeshSolid(vertices, faces)
    large = float(np.ptp(vertices, axis=0).max()) >= SMALL_MM
    return MeshObject(
        name=path.stem,
        family=Family.HOUSEHOLD if large else Family.PEG,
        features=f"mesh of {len(faces):,} faces",
        parts=(Part(surface),),
    )


class _MeshSolid:
    """A closed mesh as a ``sim.objects.solids.Solid``."""

    def __init__(self, vertices: FloatArray, faces: IntArray) -> None:
        self._rays = mesh_rays(vertices, faces)
        self._region, self.cells = _regions(vertices, faces)
        self.reach_mm = float(np.linalg.norm(vertices, axis=1).max())
        self.max_slope = 1.0

    def distance(self, points: Tensor) -> Tensor:
        distances = self._rays.distances(_flat(points))
        return torch.from_numpy(distances.reshape(points.shape[:-1])).to(points)

    def cell(self, points: Tensor) -> Tensor:
        face = self._rays.nearest_faces(_flat(points))
        return torch.from_numpy(self._region[face].reshape(points.shape[:-1])).to(points.device)

    def rays(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        starts = _flat(origins)
        distances = self._rays.hits(starts, along.detach().cpu().numpy())
        distances[distances > far_mm] = np.inf
        # A part that is in the way is no needle.
        if (self._rays.distances(starts[::_INSIDE_CHECK_STRIDE]) < 0).any():
            distances[:] = np.nan
        return torch.from_numpy(distances).to(origins)


def _flat(points: Tensor) -> FloatArray:
    """Points (..., 3) as an array (N, 3)."""
    return np.asarray(points.detach().cpu().numpy().reshape(-1, 3))


@dataclass(frozen=True)
class MeshObject(SolidObject):
    """An object whose only part is a mesh."""

    def surface(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        """See ``sim.objects.ray_casting.Castable``: by rays, exact, instead of sphere tracing."""
        solid = self.parts[0].solid
        if not isinstance(solid, _MeshSolid):
            raise TypeError(f"{self.name} is not made of a mesh")
        return solid.rays(origins, along, far_mm)

    def surface_over(self, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
        return self.surface(origins.view(-1, 3), along, far_mm).view(origins.shape[:2])


def _regions(vertices: FloatArray, faces: IntArray) -> tuple[IntArray, tuple[Cell, ...]]:
    """Region of every face, and the cell of every region."""
    import trimesh

    mesh: Any = trimesh.Trimesh(vertices, faces, process=False)
    pairs = mesh.face_adjacency[mesh.face_adjacency_angles < np.radians(CREASE_DEG)]
    count, region = connected_parts(pairs, len(faces))
    normals, areas = np.asarray(mesh.face_normals), np.asarray(mesh.area_faces)
    cells: list[Cell] = []
    in_order = np.argsort(region, kind="stable")
    ends = np.cumsum(np.bincount(region, minlength=count))
    for members in np.split(in_order, ends[:-1]):  # no search per region: a scan has many
        mean = (normals[members] * areas[members, None]).sum(axis=0)
        mean /= max(float(np.linalg.norm(mean)), 1e-12)
        level = bool((normals[members] @ mean > np.cos(np.radians(_LEVEL_DEG))).all())
        outline = _outline(vertices, faces[members], mean) if level else None
        cells.append(Cell(form=Form.FLAT if level else Form.CURVED, outline=outline))
    return _with_tips(mesh, region, cells)


def _with_tips(mesh: Any, region: IntArray, cells: list[Cell]) -> tuple[IntArray, tuple[Cell, ...]]:
    """Split the curved region around a vertex with a large angle defect into a side and a tip."""
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    defects = np.asarray(mesh.vertex_defects)
    for vertex in np.flatnonzero(defects > _TIP_DEFECT):
        neighbours = mesh.vertex_faces[vertex]
        neighbours = neighbours[neighbours >= 0]
        region_ids = np.unique(region[neighbours])
        if len(region_ids) != 1 or cells[region_ids[0]].form is Form.FLAT:
            continue
        side = np.flatnonzero(region == region_ids[0])
        corners = vertices[faces[side]]
        near = np.linalg.norm(corners - vertices[vertex], axis=2).max(axis=1) < _TIP_MM
        cells[region_ids[0]] = Cell(form=Form.TAPER)
        region[side[near | np.isin(side, neighbours)]] = len(cells)
        cells.append(Cell(form=Form.TAPER, outline=Shape.PEAK))
    return region, tuple(cells)


def _outline(vertices: FloatArray, faces: IntArray, normal: FloatArray) -> Shape | None:
    """Shape of a contact with the whole of a flat region; None: by its proportions."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    rim, counts = np.unique(edges, axis=0, return_counts=True)
    rim = rim[counts == 1]
    names, ends = np.unique(rim, return_inverse=True)
    if connected_parts(ends.reshape(-1, 2), len(names))[0] > 1:  # loops
        return Shape.HOLE
    edges = vertices[rim[:, 1]] - vertices[rim[:, 0]]
    lengths = np.linalg.norm(edges, axis=1)
    first = np.cross(normal, edges[int(lengths.argmax())])
    first /= max(float(np.linalg.norm(first)), 1e-12)
    second = np.cross(normal, first)
    angle = np.degrees(np.arctan2(edges @ second, edges @ first)) % 180
    bins = np.bincount((np.round(angle / 10).astype(int)) % 18, weights=lengths, minlength=18)
    main = int((bins > 0.08 * lengths.sum()).sum())
    if main >= 5:
        return Shape.DISC
    if main != 3:
        return None
    # A hexagon maps to itself when turned by 180°, no triangle does.
    from scipy.spatial import cKDTree

    corners = vertices[names]
    turned = corners.min(axis=0) + corners.max(axis=0) - corners
    distances, _ = cKDTree(corners).query(turned)
    is_symmetric = float(distances.max()) < 0.05 * float(np.ptp(corners, axis=0).max())
    return Shape.HEXAGON if len(rim) % 2 == 0 and is_symmetric else Shape.TRIANGLE
