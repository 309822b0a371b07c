"""Meshes between the fingers: what they become, and which are refused."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from cltp import TouchError
from sim.grasp.bodies import draw_body
from sim.grasp.mesh_bodies import ScannedObject, body_from_mesh
from sim.grasp.rig import build
from sim.grasp.ripeness import BerrySize, Flesh
from tests.paths import SHARED_DATA

LIKE = draw_body("strawberry", np.random.default_rng(0))
SHARED = SHARED_DATA / "meshes"


def written(mesh: trimesh.Trimesh, folder: Path) -> Path:
    path = folder / "thing.ply"
    mesh.export(path)
    return path


def test_a_ball_becomes_a_ball(tmp_path):
    path = written(trimesh.creation.icosphere(subdivisions=5, radius=15.0), tmp_path)
    body = body_from_mesh(ScannedObject(path=path), LIKE)
    gap = body.gap_on(np.array([0.0, 4.0]), np.array([0.0, -4.0]))
    sagitta = 15 - np.sqrt(15**2 - 16)
    assert gap[0, 0] == pytest.approx(0.0, abs=0.02)
    assert gap[0, 1] == pytest.approx(sagitta, abs=0.05)
    assert gap[1, 0] == pytest.approx(sagitta, abs=0.05)
    assert body.thickness_mm == pytest.approx(30.0, abs=0.1)
    assert body.mass_kg == pytest.approx(0.3e-6 * 4 / 3 * np.pi * 15**3, rel=0.02)


def test_a_long_box_lies_as_its_file_says_and_keeps_a_given_mass(tmp_path):
    path = written(trimesh.creation.box((80.0, 12.0, 6.0)), tmp_path)
    body = body_from_mesh(ScannedObject(path=path, mass_g=50.0), LIKE)
    assert body.thickness_mm == pytest.approx(12.0)
    assert body.mass_kg == 0.05
    x_mm, y_mm = body.com_mm  # of the box's middle, from the pad's
    assert abs(x_mm) < 3
    assert abs(y_mm) < 3
    inside = body.gap_on(np.array([-20.0, 20.0]), np.array([y_mm + 2.8, y_mm - 2.8]))
    assert inside.max() == pytest.approx(0.0, abs=1e-3)
    assert body.gap_on(np.array([0.0]), np.array([y_mm + 3.2]))[0, 0] > 1.0


def test_a_mesh_is_as_soft_and_bruisable_as_the_object_whose_place_it_takes(tmp_path):
    path = written(trimesh.creation.icosphere(radius=15.0), tmp_path)
    tomato = draw_body("cherry_tomato", np.random.default_rng(0))
    body = body_from_mesh(ScannedObject(path=path), tomato)
    assert (body.young_mpa, body.poisson) == (tomato.young_mpa, tomato.poisson)
    assert (body.friction, body.bruise_n) == (tomato.friction, tomato.bruise_n)


def test_a_mesh_in_the_place_of_a_berry_is_as_ripe_as_it(tmp_path):
    path = written(trimesh.creation.icosphere(radius=15.0), tmp_path)
    body = body_from_mesh(ScannedObject(path=path), LIKE)
    assert (body.poisson, body.friction) == (LIKE.poisson, LIKE.friction)
    assert ripeness(body) == pytest.approx(ripeness(LIKE), rel=0.01)


def ripeness(berry):
    """Bruise force over slip minimum."""
    size = BerrySize(mass_g=1000 * berry.mass_kg, size_mm=berry.thickness_mm, com_mm=berry.com_mm)
    return size.ripeness(Flesh(young_mpa=berry.young_mpa, bruise_n=berry.bruise_n))


def test_the_stiffness_and_the_bruise_force_of_a_mesh_can_be_given(tmp_path):
    path = written(trimesh.creation.icosphere(radius=15.0), tmp_path)
    body = body_from_mesh(ScannedObject(path=path, young_mpa=7.0, bruise_n=4.5), LIKE)
    assert (body.young_mpa, body.bruise_n) == (7.0, 4.5)


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        ({"young_mpa": 0.0002}, r"Young's modulus must be 0\.005 to 500000 MPa, got 0\.0002"),
        ({"young_mpa": float("nan")}, "got nan"),
        ({"bruise_n": -1.0}, "bruise force must be"),
        ({"mass_g": 0.0}, "mass must be"),
    ],
)
def test_an_absurd_number_of_a_mesh_is_refused(number, expected):
    with pytest.raises(TouchError, match=expected):
        ScannedObject(path=Path("thing.ply"), **number)


def test_a_scanned_berry_bruises_where_one_of_steel_does_not(tmp_path):
    path = written(trimesh.creation.icosphere(subdivisions=4, radius=14.0), tmp_path)

    def bruised(object_name: str, factor: float) -> bool:
        mesh = ScannedObject(path=path, mass_g=12.0)
        rig = build(object_name, 0, mesh=mesh, start_offset_mm=(0.0, 0.0))
        berry = build("strawberry", 0, mesh=mesh).grasp.fingers.body
        rig.grasp.close(0.05)
        rig.grasp.close(factor * berry.bruise_n)
        return rig.grasp.bruised

    assert bruised("strawberry", 2.0)
    assert not bruised("strawberry", 0.5)
    assert not bruised("peg", 2.0)


def test_where_a_mesh_bulges_beside_the_pad_the_body_is_nearer_to_the_finger(tmp_path):
    bar = trimesh.creation.box((120.0, 20.0, 8.0))
    boss = trimesh.creation.box((10.0, 22.0, 8.0)).apply_translation((18.0, 0.0, 0.0))
    path = written(trimesh.util.concatenate([bar, boss]), tmp_path)
    body = body_from_mesh(ScannedObject(path=path), LIKE)
    beside = body.gap_mm[body.gap_mm.shape[0] // 2]  # along the bar
    assert body.gap_on(np.zeros(1), np.zeros(1))[0, 0] == pytest.approx(0.0, abs=1e-3)
    assert beside.min() == pytest.approx(-1.0, abs=0.01)


def test_a_mug_is_grasped_and_lifted(tmp_path):
    cup = trimesh.creation.annulus(r_min=37.0, r_max=40.0, height=60.0, sections=96)
    handle = trimesh.creation.box((6.0, 8.0, 40.0)).apply_translation((54.0, 0.0, 0.0))
    path = written(trimesh.util.concatenate([cup, handle]), tmp_path)
    mesh = ScannedObject(path=path, mass_g=30.0)
    grasp = build("peg", 0, mesh=mesh, start_offset_mm=(0.0, 0.0)).grasp
    grasp.close(6.0)
    grasp.move((0.0, 40.0), 0.1, 1.0)
    assert grasp.patch is not None
    assert not grasp.slipped


def test_an_open_mesh_is_refused(tmp_path):
    mesh = trimesh.creation.box((20.0, 20.0, 20.0))
    mesh.update_faces(np.arange(len(mesh.faces)) > 1)
    with pytest.raises(TouchError, match="open"):
        body_from_mesh(ScannedObject(path=written(mesh, tmp_path)), LIKE)


def test_a_mesh_in_metres_is_refused(tmp_path):
    with pytest.raises(TouchError, match="metres"):
        body_from_mesh(
            ScannedObject(path=written(trimesh.creation.icosphere(radius=0.015), tmp_path)), LIKE
        )


def test_a_mesh_inside_out_is_refused(tmp_path):
    mesh = trimesh.creation.icosphere(radius=15.0)
    mesh.invert()
    with pytest.raises(TouchError, match="inside out"):
        body_from_mesh(ScannedObject(path=written(mesh, tmp_path)), LIKE)


def test_a_mesh_wider_than_the_gripper_is_refused(tmp_path):
    with pytest.raises(TouchError, match=r"thing\.ply: the mesh.* too wide: 150 mm"):
        mesh = trimesh.creation.box((150.0, 150.0, 150.0))
        body_from_mesh(ScannedObject(path=written(mesh, tmp_path)), LIKE)


@pytest.mark.parametrize("content", [b"", b"ply\nformat ascii 1.0\nend_header\n", b"not a mesh"])
def test_an_empty_or_foreign_file_is_refused(tmp_path, content):
    path = tmp_path / "thing.ply"
    path.write_bytes(content)
    with pytest.raises(TouchError, match=r"thing\.ply"):
        body_from_mesh(ScannedObject(path=path), LIKE)


@pytest.mark.skipif(not SHARED.is_dir(), reason=f"{SHARED} is absent")
@pytest.mark.parametrize("name", ["household/plastic_apple", "household/black_marker"])
def test_scanned_objects_can_be_held(name):
    body = body_from_mesh(ScannedObject(path=SHARED / f"{name}.ply"), LIKE)
    middle = body.gap_mm.shape[0] // 2
    assert body.gap_mm[middle, middle] < 2.0
