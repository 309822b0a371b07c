"""Rays against a closed mesh, distances from it and its nearest faces: by open3d, or without it.

An accelerator machine often has no open3d. ``TriangleRays`` needs numpy and scipy alone and agrees
with it to float32's rounding; it takes several times as long on a mesh of many faces.

Not here: what a mesh is as an object (``sim.objects.mesh_objects``).
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from cltp.tactile.cloud import FloatArray
from sim.objects.meshes import IntArray, ray_scene


class MeshRays(Protocol):
    """What an object made of a mesh asks for; points and origins are (N, 3) [mm]."""

    def hits(self, origins: FloatArray, along: FloatArray) -> FloatArray:
        """Length of parallel rays along a unit vector (3,) to the first face, (N,); inf: none."""

    def distances(self, points: FloatArray) -> FloatArray:
        """Signed distance from the surface, negative inside, (N,) [mm]."""

    def nearest_faces(self, points: FloatArray) -> IntArray:
        """Index of the nearest face, (N,)."""


def mesh_rays(vertices: FloatArray, faces: IntArray) -> MeshRays:
    """Rays against a closed mesh: open3d's where it is installed, else our own."""
    try:
        import open3d  # noqa: F401
    except ImportError:
        return TriangleRays(vertices, faces)
    return Open3dRays(vertices, faces)


class Open3dRays:
    """open3d's rays."""

    def __init__(self, vertices: FloatArray, faces: IntArray) -> None:
        self._scene, self._tensor = ray_scene(vertices, faces)

    def hits(self, origins: FloatArray, along: FloatArray) -> FloatArray:
        starts = origins.astype(np.float32)
        directions = np.broadcast_to(along.astype(np.float32), starts.shape)
        rays = self._tensor(np.concatenate([starts, directions], axis=1))
        return np.array(self._scene.cast_rays(rays)["t_hit"].numpy())

    def distances(self, points: FloatArray) -> FloatArray:
        return np.array(self._scene.compute_signed_distance(self._points(points)).numpy())

    def nearest_faces(self, points: FloatArray) -> IntArray:
        closest = self._scene.compute_closest_points(self._points(points))
        return np.asarray(closest["primitive_ids"].numpy().astype(np.int64))

    def _points(self, points: FloatArray) -> Any:
        return self._tensor(np.ascontiguousarray(points.astype(np.float32)))


_BINS = 12  # classes of faces by size, each twice as large as the one before
_PAIRS = 2_000_000  # pairs of a point and a face that are compared at once
_EDGE_SLACK = 1e-9  # of barycentric coordinates: a ray through an edge hits


class TriangleRays:
    """The same by searching among faces that lie near enough, sorted by size into k-d trees."""

    def __init__(self, vertices: FloatArray, faces: IntArray) -> None:
        self._corners = vertices[faces]  # (F, 3, 3)
        self._vertices, self._faces = vertices, faces
        self._vertex_tree = cKDTree(vertices)
        self._middle = self._corners.mean(axis=1)
        self._radius = np.linalg.norm(self._corners - self._middle[:, None], axis=2).max(axis=1)
        self._classes = _size_classes(self._radius)
        self._trees = [(cKDTree(self._middle[each]), each) for each in self._classes]
        self._face_normal, self._edge_normal, self._vertex_normal = _pseudo_normals(vertices, faces)

    def hits(self, origins: FloatArray, along: FloatArray) -> FloatArray:
        direction = along / np.linalg.norm(along)
        frame = _frame(direction)
        starts = origins @ frame
        nearest = np.full(len(origins), np.inf)
        corners = self._corners @ frame
        tree = cKDTree(starts[:, :2])
        middle = corners[:, :, :2].mean(axis=1)
        radius = np.linalg.norm(corners[:, :, :2] - middle[:, None], axis=2).max(axis=1) + 1e-9
        for face_ids in _chunks(len(corners), max(1, _PAIRS // 200)):
            found = tree.query_ball_point(middle[face_ids], radius[face_ids])
            count = np.array([len(each) for each in found])
            if not count.any():
                continue
            face = np.repeat(face_ids, count)
            ray = np.concatenate([np.asarray(each, dtype=np.int64) for each in found if each])
            inside, depth = _under(corners[face], starts[ray, :2])
            length = depth - starts[ray, 2]
            inside &= length >= 0
            np.minimum.at(nearest, ray[inside], length[inside])
        return nearest

    def distances(self, points: FloatArray) -> FloatArray:
        face, closest, feature = self._nearest(points)
        away = points - closest
        normal = self._normal_of(face, feature)
        sign = np.where(np.einsum("ij,ij->i", away, normal) < 0, -1.0, 1.0)
        return np.asarray(sign * np.linalg.norm(away, axis=1))

    def nearest_faces(self, points: FloatArray) -> IntArray:
        return self._nearest(points)[0]

    def _nearest(self, points: FloatArray) -> tuple[IntArray, FloatArray, IntArray]:
        """Nearest face of each point, the point on it, and what of the face it is.

        That is 0-2 for a corner, 3-5 for an edge (from corner 0, 1, 2), 6 for its inside.
        """
        bound, vertex = self._vertex_tree.query(points)
        best = np.full(len(points), np.inf)
        face = np.zeros(len(points), dtype=np.int64)
        at, feature = self._vertices[vertex].copy(), np.full(len(points), 6, dtype=np.int64)
        for tree, members in self._trees:
            reach = float(self._radius[members].max()) + 1e-9
            for ids in _chunks(len(points), 4096):
                found = tree.query_ball_point(points[ids], bound[ids] + reach)
                for part in _split_pairs(ids, found):
                    self._compare(points, part, members, best, face, at, feature)
        return face, at, feature

    def _compare(
        self,
        points: FloatArray,
        pairs: tuple[IntArray, IntArray],
        members: IntArray,
        best: FloatArray,
        face: IntArray,
        at: FloatArray,
        feature: IntArray,
    ) -> None:
        """Take the nearest of pairs of point and face where it is nearer than what was found."""
        point, candidate = pairs[0], members[pairs[1]]
        closest, kind = _closest(self._corners[candidate], points[point])
        squared = ((closest - points[point]) ** 2).sum(axis=1)
        order = np.lexsort((candidate, squared, point))
        first = order[np.unique(point[order], return_index=True)[1]]
        nearer = first[squared[first] < best[point[first]]]
        own = point[nearer]
        best[own], face[own] = squared[nearer], candidate[nearer]
        at[own], feature[own] = closest[nearer], kind[nearer]

    def _normal_of(self, face: IntArray, feature: IntArray) -> FloatArray:
        normal = self._face_normal[face].copy()
        corner, edge = feature < 3, (feature >= 3) & (feature < 6)
        normal[corner] = self._vertex_normal[self._faces[face[corner], feature[corner]]]
        normal[edge] = self._edge_normal[face[edge], feature[edge] - 3]
        return normal


def _size_classes(radius: FloatArray) -> list[IntArray]:
    level = np.log2(radius / max(float(radius.max()), 1e-12)).clip(1 - _BINS, 0)
    number = np.ceil(-level).astype(np.int64)
    return [np.flatnonzero(number == n) for n in np.unique(number)]


def _chunks(total: int, size: int) -> list[IntArray]:
    return [np.arange(first, min(first + size, total)) for first in range(0, total, size)]


def _split_pairs(ids: IntArray, found: Any) -> list[tuple[IntArray, IntArray]]:
    """Pairs of a point's number and a candidate's, in parts of bounded size."""
    counts = np.array([len(each) for each in found])
    cuts = np.searchsorted(np.cumsum(counts), np.arange(_PAIRS, counts.sum(), _PAIRS))
    parts = []
    for part in np.split(np.arange(len(ids)), np.unique(cuts)):
        if counts[part].sum():
            listed = [np.asarray(found[i], dtype=np.int64) for i in part]
            parts.append((np.repeat(ids[part], counts[part]), np.concatenate(listed)))
    return parts


def _frame(direction: FloatArray) -> FloatArray:
    """Orthonormal columns, the third along a direction."""
    least = np.eye(3)[int(np.abs(direction).argmin())]
    first = np.cross(least, direction)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(direction, first), direction], axis=1)


def _under(corners: FloatArray, at: FloatArray) -> tuple[NDArray[np.bool_], FloatArray]:
    """Whether points (N, 2) lie in triangles (N, 3, 3) seen along z, and the z of each there."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac, ap = b[:, :2] - a[:, :2], c[:, :2] - a[:, :2], at - a[:, :2]
    area = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        second = (ap[:, 0] * ac[:, 1] - ap[:, 1] * ac[:, 0]) / area
        third = (ab[:, 0] * ap[:, 1] - ab[:, 1] * ap[:, 0]) / area
        inside = (second >= -_EDGE_SLACK) & (third >= -_EDGE_SLACK)
        inside &= second + third <= 1 + 2 * _EDGE_SLACK
        depth = a[:, 2] + second * (b[:, 2] - a[:, 2]) + third * (c[:, 2] - a[:, 2])
    return inside & (np.abs(area) > 1e-15), depth


def _closest(corners: FloatArray, points: FloatArray) -> tuple[FloatArray, IntArray]:
    """Closest point of each triangle (N, 3, 3) to a point (N, 3), and what of it that is."""
    best = np.full(len(points), np.inf)
    closest, kind = np.zeros_like(points), np.full(len(points), 6, dtype=np.int64)
    for i in range(3):  # edges, and corners at their ends
        start, along = corners[:, i], corners[:, (i + 1) % 3] - corners[:, i]
        length = np.einsum("ij,ij->i", along, along).clip(min=1e-24)
        fraction = np.einsum("ij,ij->i", points - start, along) / length
        on_line = start + fraction.clip(0, 1)[:, None] * along
        squared = ((on_line - points) ** 2).sum(axis=1)
        what = np.where(fraction <= 0, i, np.where(fraction >= 1, (i + 1) % 3, 3 + i))
        nearer = squared < best
        best[nearer], closest[nearer], kind[nearer] = squared[nearer], on_line[nearer], what[nearer]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(first, second)
    size = np.einsum("ij,ij->i", normal, normal).clip(min=1e-24)
    away = points - corners[:, 0]
    foot = points - (np.einsum("ij,ij->i", away, normal) / size)[:, None] * normal
    to_foot = foot - corners[:, 0]
    beta = np.einsum("ij,ij->i", np.cross(to_foot, second), normal) / size
    gamma = np.einsum("ij,ij->i", np.cross(first, to_foot), normal) / size
    inside = (beta > 0) & (gamma > 0) & (beta + gamma < 1)
    closest[inside], kind[inside] = foot[inside], 6
    return closest, kind


def _pseudo_normals(
    vertices: FloatArray, faces: IntArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Normals of faces (F, 3), of their edges (F, 3, 3) and of vertices (V, 3), not of unit length.

    Source: Baerentzen and Aanaes (2005): with them the sign of a distance is right at edges and
    corners of any closed mesh.
    """
    corners = vertices[faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True).clip(min=1e-24)
    ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    keys = np.sort(ends, axis=1)
    _, edge = np.unique(keys[:, 0] * len(vertices) + keys[:, 1], return_inverse=True)
    edge = edge.reshape(-1)
    of_edges = np.zeros((int(edge.max()) + 1, 3))
    np.add.at(of_edges, edge, np.repeat(normal, 3, axis=0))
    of_vertices = np.zeros_like(vertices)
    for i in range(3):
        to_next = corners[:, (i + 1) % 3] - corners[:, i]
        to_last = corners[:, (i + 2) % 3] - corners[:, i]
        cosine = np.einsum("ij,ij->i", to_next, to_last)
        cosine /= (np.linalg.norm(to_next, axis=1) * np.linalg.norm(to_last, axis=1)).clip(
            min=1e-24
        )
        angle = np.arccos(cosine.clip(-1, 1))
        np.add.at(of_vertices, faces[:, i], angle[:, None] * normal)
    return normal, of_edges[edge].reshape(-1, 3, 3), of_vertices
