"""Reading and checking of users' meshes: closed surfaces in millimetres, normals outwards.

Nothing is repaired or scaled, but vertices at the same position are joined, since STL repeats them
for every face.

Not here: objects (``sim.objects.mesh_objects``) and bodies (``sim.grasp.mesh_bodies``) of meshes.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray

IntArray = NDArray[np.int64]

SUFFIXES = (".ply", ".obj", ".stl", ".off")
MAX_FACES = 2_000_000
"""Our choice: at 0.1 mm a face this is a body of 100 mm; more is slower and no more accurate."""

SMALLEST_MM = 2.0
"""A smaller mesh is taken to be in metres. Our choice: a pad of 15 mm can hardly tell smaller
objects from a point, and no hand-held object is 2 m large."""

LARGEST_MM = 5000.0
"""A larger mesh is taken to be in micrometres. Our choice."""

_HEADER_BYTES = 1 << 16  # longer than the header of any PLY with comments
_CHUNK_BYTES = 1 << 22
_REASON_LENGTH = 200  # readers may quote a whole file in their error


def checked_mesh(path: Path) -> tuple[FloatArray, IntArray]:
    """Read a mesh; refuse it unless it is a closed surface in millimetres.

    Args:
        path: PLY, OBJ, STL or OFF file.

    Returns:
        Vertices, shape (V, 3) [mm], and faces, shape (F, 3), indices into them, counter-clockwise
        seen from outside.

    Raises:
        TouchError: The file is missing or truncated; the mesh is empty, has more than ``MAX_FACES``
            faces (counted before it is loaded), NaN or missing vertices, is apparently not in
            millimetres, open, inconsistently oriented, flat, or inside out.
    """
    path = Path(path)
    _check_file(path)
    vertices, faces = _load(path)
    try:
        _check_numbers(vertices, faces)
        vertices, faces = _join_vertices(vertices, faces)
        _check_surface(vertices, faces)
    except TouchError as error:
        raise TouchError(f"{path}: {error}") from None
    return vertices, faces


def volume_and_centre(vertices: FloatArray, faces: IntArray) -> tuple[float, FloatArray]:
    """Volume of a closed mesh [mm³] and its centre of mass, shape (3,) [mm]."""
    volumes = _face_volumes(vertices, faces)
    middle = vertices.mean(axis=0)
    # A tetrahedron's centre lies 3/4 of the way from its apex to the centre of the opposite face.
    centres = middle + 0.75 * (vertices[faces].mean(axis=1) - middle)
    total = float(volumes.sum())
    return total, np.asarray(volumes @ centres / total)


def connected_parts(links: IntArray, num: int) -> tuple[int, IntArray]:
    """Number of connected parts of ``num`` nodes by links (L, 2), and the part of each node."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    graph = coo_matrix((np.ones(len(links), bool), links.T), shape=(num, num))
    number, part = connected_components(graph, directed=False)
    return int(number), part.astype(np.int64)


def ray_scene(vertices: FloatArray, faces: IntArray) -> tuple[Any, Any]:
    """An open3d scene of a mesh that rays can be cast against, and the class of its tensors."""
    import open3d

    scene: Any = open3d.t.geometry.RaycastingScene()
    tensor: Any = open3d.core.Tensor
    scene.add_triangles(tensor(vertices.astype(np.float32)), tensor(faces.astype(np.uint32)))
    return scene, tensor


def _check_file(path: Path) -> None:
    if path.suffix.lower() not in SUFFIXES:
        raise TouchError(
            f"{path}: expected a mesh ending in {', '.join(SUFFIXES)}, "
            f"got {path.suffix or 'none'!r}"
        )
    if not path.is_file():
        raise TouchError(f"{path} {'is a directory' if path.is_dir() else 'does not exist'}")
    try:
        size = path.stat().st_size
        declared = _declared_faces(path, size)
    except OSError as error:
        raise TouchError(f"{path} can't be read: {error.strerror or error}") from None
    except TouchError as error:
        raise TouchError(f"{path}: {error}") from None
    if size == 0:
        raise TouchError(f"{path} is an empty file; expected a closed surface in mm")
    if declared is not None:
        _check_count(path, declared)


def _check_count(path: Path, faces: int) -> None:
    if faces == 0:
        raise TouchError(f"{path}: the mesh is empty (no faces); expected a closed surface in mm")
    if faces > MAX_FACES:
        raise TouchError(f"{path}: {faces:,} faces; simplify it to below {MAX_FACES:,}")


def _declared_faces(path: Path, size: int) -> int | None:
    """Number of faces by a file's header or lines; None where neither gives it."""
    with path.open("rb") as file:
        head = file.read(_HEADER_BYTES)
        match path.suffix.lower():
            case ".stl":
                binary = _binary_stl_faces(head, size)
                return (_occurrences(file, head, b"endfacet") or None) if binary is None else binary
            case ".obj":  # none: the reader reports it, as above
                return _occurrences(file, head, b"\nf ") or None
            case ".off":
                lines = (line.partition(b"#")[0] for line in head.splitlines())
                counts = [word for word in b" ".join(lines).split()[:4] if word.isdigit()]
                return int(counts[1]) if len(counts) > 1 else None
    match = re.search(rb"[\r\n]element\s+face\s+(\d+)", head.split(b"end_header")[0])
    return int(match[1]) if match else None


def _binary_stl_faces(head: bytes, size: int) -> int | None:
    """Number of faces by the header of a binary STL, which may have a tail; None for a text STL.

    Raises:
        TouchError: The file ends before its last face.
    """
    announced = int.from_bytes(head[80:84], "little")
    is_ascii = head.lstrip()[:5] == b"solid" and b"facet" in head
    if len(head) < 84 or (is_ascii and size != 84 + 50 * announced):
        return None
    if size < 84 + 50 * announced:
        raise TouchError(
            f"its header announces {announced:,} faces, but it ends after "
            f"{(size - 84) // 50:,}; is the file cut off, or no STL?"
        )
    return announced


def _occurrences(file: BinaryIO, head: bytes, pattern: bytes) -> int:
    count, chunk = 0, b"\n" + head
    while chunk:
        count += chunk.count(pattern)
        next_chunk = file.read(_CHUNK_BYTES)
        # An occurrence may lie across two chunks; its tail alone is too short to count twice.
        chunk = chunk[-len(pattern) + 1 :] + next_chunk if next_chunk else b""
    return count


def _load(path: Path) -> tuple[FloatArray, IntArray]:
    import trimesh

    try:
        mesh: Any = trimesh.load(path, force="mesh", process=False, skip_materials=True)
        vertices = np.asarray(mesh.vertices, dtype=np.float64).reshape(-1, 3)
        faces = np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3)
    except Exception as error:  # trimesh raises any exception of its readers
        lacks = "it lacks " if isinstance(error, KeyError) else ""
        reason = lacks + " ".join(str(error).split())[:_REASON_LENGTH]
        raise TouchError(
            f"{path} can't be read as a mesh ({', '.join(SUFFIXES)}): {reason}"
        ) from None
    _check_count(path, len(faces))
    return vertices, faces


def _check_numbers(vertices: FloatArray, faces: IntArray) -> None:
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise TouchError(
            f"a face names vertex {int(faces.max())} of {len(vertices)}; is the file cut off?"
        )
    if not np.isfinite(vertices).all():
        raise TouchError("the mesh has vertices that are NaN or infinite")
    largest = float(np.ptp(vertices[np.unique(faces)], axis=0).max())
    if largest < SMALLEST_MM:
        raise TouchError(
            f"the mesh is only {largest:.3g} mm large; is it in metres? Multiply by 1000"
        )
    if largest > LARGEST_MM:
        raise TouchError(
            f"the mesh is {largest:.3g} mm large, more than {LARGEST_MM:.0f}; is it in µm? "
            "Scale it to millimetres"
        )


def _join_vertices(vertices: FloatArray, faces: IntArray) -> tuple[FloatArray, IntArray]:
    """Join vertices at one position; drop faces without area and vertices without a face."""
    positions, index = np.unique(vertices, axis=0, return_inverse=True)
    faces = index.reshape(-1)[faces]
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    if len(faces) == 0:
        raise TouchError("the mesh is empty: every face has two corners at one place")
    used, renumbered = np.unique(faces, return_inverse=True)
    return positions[used], renumbered.reshape(-1, 3)


def _check_surface(vertices: FloatArray, faces: IntArray) -> None:
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    low, high = edges.min(axis=1), edges.max(axis=1)
    _, edge, count = np.unique(low * len(vertices) + high, return_inverse=True, return_counts=True)
    # Four faces at an edge are two parts that touch there, which is closed as well.
    if (count % 2).any():
        raise TouchError(
            f"the mesh is open ({int((count % 2).sum()):,} edges lack a face: holes or loose "
            "sheets); close it first"
        )
    forward = np.bincount(edge.reshape(-1), weights=edges[:, 0] < edges[:, 1])
    if (2 * forward != count).any():
        raise TouchError(
            "neighbouring faces of the mesh turn both ways; make its normals consistent first"
        )
    # Normals of every part point outwards, those of a cavity in a part inwards.
    links = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]]])
    number, part = connected_parts(links, len(vertices))
    volumes = np.bincount(part[faces[:, 0]], weights=_face_volumes(vertices, faces))
    if np.abs(volumes).sum() < 1e-9 * float(np.prod(np.ptp(vertices, axis=0) + 1e-9)):
        raise TouchError("the mesh encloses no volume; expected a body, not a sheet")
    low, high = np.full((number, 3), np.inf), np.full((number, 3), -np.inf)
    np.minimum.at(low, part, vertices)
    np.maximum.at(high, part, vertices)
    solid = volumes > 0
    for part_id in np.flatnonzero(volumes < 0):
        encloses = (low[solid] <= low[part_id]).all(axis=1) & (high[solid] >= high[part_id]).all(
            axis=1
        )
        if not encloses.any():
            raise TouchError(
                "the mesh is inside out (normals point inwards"
                f"{f' in {int((~solid).sum())} of {number} parts' if number > 1 else ''}); "
                "flip its faces"
            )


def _face_volumes(vertices: FloatArray, faces: IntArray) -> FloatArray:
    """Signed volume of the tetrahedron from each face to the mesh's centre [mm³], shape (F,)."""
    middle = vertices.mean(axis=0)
    a, b, c = (vertices[faces[:, i]] - middle for i in range(3))
    return np.asarray(np.einsum("ij,ij->i", a, np.cross(b, c)) / 6)
