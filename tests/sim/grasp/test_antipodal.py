"""Where fingers can hold a mesh: on opposite surface near the centre of mass, or nowhere."""

import numpy as np
import pytest
import trimesh
from trimesh.creation import annulus, box, cone, cylinder, icosphere

from cltp import TouchError
from sim.grasp.antipodal import FRICTION, MIN_PATCH_MM2, GraspPlace, find_grasp
from sim.grasp.bodies import OBJECTS

PAD_MM = (20.3, 15.2)


def grasp(mesh: trimesh.Trimesh, seed: int = 0) -> GraspPlace:
    vertices, faces = np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int64)
    return find_grasp(vertices, faces, PAD_MM, seed=seed)


def moved(mesh: trimesh.Trimesh, *by: float) -> trimesh.Trimesh:
    mesh.apply_translation(by)
    return mesh


def turned(mesh: trimesh.Trimesh, degrees: float, axis: tuple[float, ...]) -> trimesh.Trimesh:
    return mesh.copy().apply_transform(
        trimesh.transformations.rotation_matrix(np.radians(degrees), axis)
    )


def mug(radius: float = 40.0, wall: float = 3.0, height: float = 60.0) -> trimesh.Trimesh:
    """A cup with a floor and a square handle, open above; standing."""
    return trimesh.util.concatenate(
        [
            annulus(r_min=radius - wall, r_max=radius, height=height, sections=96),
            moved(cylinder(radius - wall, 4.0, sections=96), 0, 0, -height / 2 + 2),
            moved(box((4.0, 8.0, 40.0)), radius + 16, 0, 0),
        ]
    )


def test_the_friction_cone_is_that_of_the_most_slippery_object():
    assert min(ranges.friction.low for ranges in OBJECTS.values()) == FRICTION


def test_a_ball_is_held_across_its_middle():
    place = grasp(icosphere(subdivisions=4, radius=15.0))
    assert place.width_mm == pytest.approx(30.0, abs=0.2)
    assert place.from_com_mm < 1.0
    # the cap of 0.3 mm of a ball has the area 2 π r h
    assert place.patch_mm2[0] == pytest.approx(2 * np.pi * 15 * 0.3, rel=0.3)


def test_a_box_is_held_on_its_narrow_upright_sides_whichever_way_it_faces():
    lying = box((80.0, 12.0, 6.0))
    for degrees in (0, 35, 90):
        place = grasp(turned(lying, degrees, (0, 0, 1)))
        assert place.width_mm == pytest.approx(12.0, abs=0.05)
        normal = np.radians(90 + degrees)
        along = abs(place.closing[0] * np.cos(normal) + place.closing[1] * np.sin(normal))
        assert along == pytest.approx(1.0, abs=1e-3)
        assert place.from_com_mm < 3.0


def test_fingers_close_horizontally_and_the_mesh_is_never_tilted():
    place = grasp(turned(box((120.0, 12.0, 30.0)), 90, (1, 0, 0)))
    assert place.width_mm == pytest.approx(30.0, abs=0.05)  # the 12 mm are upright now
    assert place.closing[2] == 0.0
    np.testing.assert_allclose(place.body_from_mesh[1], (0, 0, 1))
    assert np.linalg.det(place.body_from_mesh) == pytest.approx(1.0)


def test_a_face_that_fills_the_pad_is_left_for_one_that_can_be_felt():
    place = grasp(box((80.0, 12.0, 30.0)))
    assert place.width_mm == pytest.approx(80.0, abs=0.05)  # by its ends, which are 12 mm wide
    assert place.patch_mm2[0] < 0.65 * PAD_MM[0] * PAD_MM[1]


def test_a_mug_is_held_across_its_body_and_not_in_the_air_beside_its_handle():
    place = grasp(mug())
    assert place.width_mm == pytest.approx(80.0, abs=0.5)
    assert np.hypot(*place.centre_mm[:2]) < 3.0


def test_a_mug_wider_than_the_gripper_is_held_by_its_wall_with_a_finger_inside():
    wide = mug(radius=70.0)
    wide = trimesh.util.concatenate(wide.split()[:2])  # without the handle
    place = grasp(wide)
    # inside, the flat pad touches the round wall with its two upright edges
    sagitta = 67 - np.sqrt(67**2 - (PAD_MM[0] / 2) ** 2)
    assert place.width_mm == pytest.approx(3.0 + sagitta, abs=0.15)
    assert np.hypot(*place.centre_mm[:2]) == pytest.approx(68.5, abs=0.6)


def test_an_angle_whose_bounding_box_has_an_empty_middle_is_held_on_a_leg():
    legs = [box((100.0, 20.0, 20.0)), moved(box((20.0, 100.0, 20.0)), -40, 60, 0)]
    place = grasp(trimesh.util.concatenate(legs))
    x, y, _ = place.centre_mm
    assert place.width_mm == pytest.approx(20.0, abs=0.05)
    assert abs(y) < 1 or abs(x + 40) < 1


def test_both_patches_suffice_and_the_camera_has_the_smaller():
    points = np.asarray(icosphere(subdivisions=4, radius=20.0).vertices)
    half = trimesh.convex.convex_hull(points[points[:, 1] > -1e-6])
    place = grasp(half)  # round on +y, flat on the other side
    assert MIN_PATCH_MM2 <= place.patch_mm2[0] < place.patch_mm2[1]
    assert place.closing[1] > 0.95


def test_the_same_seed_finds_the_same_and_another_one_nearly_that():
    mesh = mug()
    assert grasp(mesh, 3) == grasp(mesh, 3)
    assert grasp(mesh, 4).width_mm == pytest.approx(grasp(mesh, 3).width_mm, abs=1.0)


@pytest.mark.parametrize(
    ("mesh", "expected"),
    [
        (box((150.0, 150.0, 150.0)), "too wide: 150 mm .* takes 106 mm"),
        (cone(40.0, 100.0), "no upright surface"),
        (  # one face is upright, the others lean
            trimesh.convex.convex_hull([(0, -60, 0), (0, 60, 0), (0, 0, 80), (100, 0, 0)]),
            "no two upright surfaces",
        ),
        (box((2.5, 2.5, 1.5)), "a patch is below 8 mm²"),
        (
            trimesh.util.concatenate(  # plates 5 mm apart, under a lid: no finger gets in
                [moved(box((120.0, 4.0, 80.0)), 0, 9 * i, 0) for i in range(14)]
                + [moved(box((120.0, 125.0, 4.0)), 0, 58, 42)]
            ),
            "no room for a finger",
        ),
    ],
)
def test_where_there_is_no_grasp_one_line_says_why(mesh, expected):
    with pytest.raises(TouchError, match=expected) as error:
        grasp(mesh)
    assert "\n" not in str(error.value)
