"""Rays against meshes without open3d: the same as with it."""

import builtins

import numpy as np
import pytest
import trimesh

from sim.objects import mesh_objects
from sim.objects import mesh_rays as module
from sim.objects.mesh_rays import Open3dRays, TriangleRays, mesh_rays
from sim.tcl3d.series import make_series


def bodies():
    bumpy = trimesh.creation.icosphere(3, 12)
    bumpy.vertices += np.random.default_rng(0).normal(0, 0.3, bumpy.vertices.shape)
    return {
        "box": trimesh.creation.box((40, 30, 20)),
        "cone": trimesh.creation.cone(10, 10, sections=24),
        "annulus": trimesh.creation.annulus(3, 7, 10, sections=32),
        "bumpy": bumpy,
    }


@pytest.fixture(params=bodies())
def both(request):
    mesh = bodies()[request.param]
    arrays = np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int64)
    return Open3dRays(*arrays), TriangleRays(*arrays)


def test_parallel_rays_hit_at_the_same_distance(both):
    theirs, ours = both
    rng = np.random.default_rng(1)
    for _ in range(4):
        along = rng.normal(size=3)
        along /= np.linalg.norm(along)
        origins = rng.uniform(-18, 18, (600, 3)) - 60 * along
        first, second = theirs.hits(origins, along), ours.hits(origins, along)
        assert np.mean(np.isfinite(first) != np.isfinite(second)) < 0.005  # rays along a silhouette
        common = np.isfinite(first) & np.isfinite(second)
        assert common.any()
        np.testing.assert_allclose(second[common], first[common], atol=1e-3)


def test_a_ray_does_not_look_back(both):
    _, ours = both
    assert np.isinf(ours.hits(np.array([[0.0, 0.0, 100.0]]), np.array([0.0, 0, 1]))).all()


def test_distances_have_the_same_value_and_sign(both):
    theirs, ours = both
    points = np.random.default_rng(2).uniform(-25, 25, (800, 3))
    np.testing.assert_allclose(ours.distances(points), theirs.distances(points), atol=1e-4)


def test_a_box_has_the_distances_of_a_box():
    mesh = trimesh.creation.box((4, 4, 4))
    ours = TriangleRays(np.asarray(mesh.vertices), np.asarray(mesh.faces))
    points = np.array([(0.0, 0, 0), (3, 0, 0), (3, 3, 0), (3, 3, 3), (1.5, 0, 0)])
    np.testing.assert_allclose(ours.distances(points), [-2, 1, np.sqrt(2), np.sqrt(3), -0.5])


def test_the_nearest_face_is_as_near_as_theirs(both):
    theirs, ours = both
    points = np.random.default_rng(3).uniform(-15, 15, (300, 3))
    faces = ours.nearest_faces(points), theirs.nearest_faces(points)
    one = [module._closest(ours._corners[each], points)[0] for each in faces]
    away = [np.linalg.norm(points - closest, axis=1) for closest in one]
    np.testing.assert_allclose(away[0], away[1], atol=1e-4)


@pytest.mark.parametrize(("name", "worst_mm"), [("box", 0.002), ("bumpy", 0.02)])
def test_contacts_without_open3d_are_those_with_it(name, worst_mm, tmp_path, monkeypatch):
    bodies()[name].export(tmp_path / f"{name}.ply")
    contacts = []
    for rays in (Open3dRays, TriangleRays):
        monkeypatch.setattr(mesh_objects, "mesh_rays", rays)
        mesh_objects.object_from_mesh.cache_clear()
        obj = mesh_objects.object_from_mesh(tmp_path / f"{name}.ply")
        contacts.append(make_series(0, 3_000_002, obj=obj))
    for theirs, ours in zip(*contacts, strict=True):
        # Single precision leaves open3d's normals, and so the pose, uncertain by about 1 mrad:
        # on a jagged ball tips shift by a fraction of a grid point.
        off = ours.height_mm - theirs.height_mm
        assert np.abs(off).max() < worst_mm
        assert np.sqrt(np.mean(off**2)) < 0.002
        assert (ours.state.shape, ours.state.position) == (
            theirs.state.shape,
            theirs.state.position,
        )
    mesh_objects.object_from_mesh.cache_clear()


def test_without_open3d_its_place_is_taken(monkeypatch):
    mesh = trimesh.creation.box((4, 4, 4))
    real = builtins.__import__

    def refuse(name, *args, **options):
        if name == "open3d":
            raise ImportError(name)
        return real(name, *args, **options)

    monkeypatch.setattr(builtins, "__import__", refuse)
    rays = mesh_rays(np.asarray(mesh.vertices), np.asarray(mesh.faces))
    assert isinstance(rays, TriangleRays)
