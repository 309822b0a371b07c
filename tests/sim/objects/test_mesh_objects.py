"""Meshes as objects: their regions, and what a press on them is called."""

import numpy as np
import pytest
import trimesh

from cltp.errors import TouchError
from cltp.tactile.states import Shape
from sim.objects.faces import Form
from sim.objects.mesh_objects import meshes_in, object_from_mesh
from sim.tcl3d.series import make_series


def stored(tmp_path, mesh, name="it.ply"):
    mesh.export(tmp_path / name)
    return object_from_mesh(tmp_path / name)


def test_regions_follow_creases(tmp_path):
    box = stored(tmp_path, trimesh.creation.box((40, 30, 20)))
    assert [cell.form for cell in box.cells] == [Form.FLAT] * 6
    rod = stored(tmp_path, trimesh.creation.cylinder(6, 40, sections=48), "rod.ply")
    assert sorted(cell.form for cell in rod.cells) == [Form.CURVED, Form.FLAT, Form.FLAT]
    assert {cell.outline for cell in rod.cells} == {None, Shape.DISC}
    ball = stored(tmp_path, trimesh.creation.icosphere(3, 15), "ball.ply")
    assert [cell.form for cell in ball.cells] == [Form.CURVED]
    cone = stored(tmp_path, trimesh.creation.cone(10, 10, sections=48), "cone.ply")
    assert {cell.outline for cell in cone.cells} == {None, Shape.DISC, Shape.PEAK}


@pytest.mark.parametrize(
    ("sections", "outline"), [(3, Shape.TRIANGLE), (4, None), (6, Shape.HEXAGON)]
)
def test_ends_of_prisms_are_known_by_their_outline(sections, outline, tmp_path):
    prism = stored(tmp_path, trimesh.creation.cylinder(6, 40, sections=sections), "prism.ply")
    ends = [cell.outline for cell in prism.cells if cell.outline is not None]
    assert ends == ([outline] * 2 if outline else [])


def test_an_annulus_has_a_hole(tmp_path):
    ring = stored(tmp_path, trimesh.creation.annulus(3, 7, 10, sections=48), "ring.ply")
    assert [cell.outline for cell in ring.cells].count(Shape.HOLE) == 2


def test_a_ball_is_felt_as_a_sphere_and_its_distance_is_that_of_a_ball(tmp_path):
    import torch

    ball = stored(tmp_path, trimesh.creation.icosphere(4, 15), "ball.ply")
    away = ball.distance(torch.tensor([[20.0, 0, 0], [0, 0, 0]], dtype=torch.float64))
    np.testing.assert_allclose(away, [5, -15], atol=0.05)
    names = {contact.state.shape for contact in make_series(0, 3_000_000, obj=ball)}
    assert names == {Shape.SPHERE}


def test_an_empty_folder_and_an_open_mesh_are_refused(tmp_path):
    with pytest.raises(TouchError, match="has no mesh"):
        meshes_in(tmp_path)
    with pytest.raises(TouchError, match="is no folder"):
        meshes_in(tmp_path / "nothing")
    box = trimesh.creation.box((40, 30, 20))
    box.update_faces(np.arange(10))
    with pytest.raises(TouchError, match="open"):
        stored(tmp_path, box, "open.ply")
