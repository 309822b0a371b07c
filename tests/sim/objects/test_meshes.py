"""Which meshes are taken, and what is said of those that are not."""

import struct

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from cltp import TouchError
from sim.objects.meshes import MAX_FACES, checked_mesh, volume_and_centre

BOX = trimesh.creation.box((20.0, 30.0, 40.0))


def written(mesh, folder, name="thing.ply"):
    path = folder / name
    mesh.export(path)
    return path


@pytest.mark.parametrize("name", ["thing.ply", "thing.obj", "thing.stl", "thing.off"])
def test_a_box_comes_back_from_every_format_with_each_corner_once(name, tmp_path):
    vertices, faces = checked_mesh(written(BOX, tmp_path, name))
    assert vertices.shape == (8, 3)
    assert vertices.dtype == np.float64
    assert faces.shape == (12, 3)
    assert faces.dtype == np.int64
    np.testing.assert_allclose(np.ptp(vertices, axis=0), [20, 30, 40])


@settings(max_examples=15)
@given(
    st.tuples(*[st.floats(3, 200)] * 3), st.tuples(*[st.floats(-500, 500)] * 3), st.integers(0, 99)
)
def test_volume_and_centre_are_a_boxs_wherever_it_lies(extents, shift, seed):
    turn = trimesh.transformations.random_rotation_matrix(np.random.default_rng(seed).random(3))
    box = trimesh.creation.box(extents, turn)
    volume, centre = volume_and_centre(box.vertices + shift, box.faces)
    assert volume == pytest.approx(np.prod(extents), rel=1e-9)
    np.testing.assert_allclose(centre, shift, atol=1e-6)


def test_a_mesh_with_a_hole_is_open(tmp_path):
    mesh = BOX.copy()
    mesh.update_faces(np.arange(12) > 0)
    with pytest.raises(TouchError, match=r"thing\.ply: the mesh is open \(3 edges"):
        checked_mesh(written(mesh, tmp_path))


def test_a_mesh_inside_out_is_refused_and_a_cavity_is_not(tmp_path):
    inverted = BOX.copy()
    inverted.invert()
    with pytest.raises(TouchError, match="inside out"):
        checked_mesh(written(inverted, tmp_path))
    bubble = trimesh.creation.icosphere(radius=4.0)
    bubble.invert()
    hollow = trimesh.util.concatenate([BOX, bubble])
    volume, _ = volume_and_centre(*checked_mesh(written(hollow, tmp_path)))
    assert 24000 - 270 < volume < 24000 - 200
    bubble.apply_translation((100, 0, 0))
    with pytest.raises(TouchError, match=r"inside out.* 1 of 2 parts"):
        checked_mesh(written(trimesh.util.concatenate([BOX, bubble]), tmp_path))


def test_faces_that_turn_both_ways_are_refused(tmp_path):
    mesh = BOX.copy()
    faces = np.array(mesh.faces)
    faces[0] = faces[0, ::-1]
    path = written(trimesh.Trimesh(mesh.vertices, faces, process=False), tmp_path)
    with pytest.raises(TouchError, match="turn both ways"):
        checked_mesh(path)


def test_two_boxes_that_touch_along_an_edge_are_closed(tmp_path):
    other = BOX.copy()
    other.apply_translation((20, 30, 0))
    vertices, faces = checked_mesh(written(trimesh.util.concatenate([BOX, other]), tmp_path))
    assert len(vertices) == 14
    assert volume_and_centre(vertices, faces)[0] == pytest.approx(48000)


@pytest.mark.parametrize(("scale", "message"), [(1e-3, "metres"), (1e3, "µm")])
def test_a_mesh_in_another_unit_is_refused(scale, message, tmp_path):
    mesh = BOX.copy()
    mesh.apply_scale(scale)
    with pytest.raises(TouchError, match=message):
        checked_mesh(written(mesh, tmp_path))


def test_a_flat_sheet_with_two_sides_encloses_nothing(tmp_path):
    vertices = np.array([[0, 0, 0], [10, 0, 0], [0, 10, 0]], float)
    sheet = trimesh.Trimesh(vertices, [[0, 1, 2], [0, 2, 1]], process=False)
    with pytest.raises(TouchError, match="no volume"):
        checked_mesh(written(sheet, tmp_path))


def test_ten_million_faces_are_refused_before_they_are_read(tmp_path):
    head = b"ply\nformat binary_little_endian 1.0\nelement vertex 5000000\n"
    ply = tmp_path / "huge.ply"
    ply.write_bytes(head + b"element face 10000000\nend_header\n")
    with pytest.raises(TouchError, match="10,000,000 faces; simplify it to below 2,000,000"):
        checked_mesh(ply)
    stl = tmp_path / "huge.stl"
    with stl.open("wb") as file:  # sparse: it takes no room
        file.write(b" " * 80 + struct.pack("<I", 10_000_000))
        file.truncate(84 + 50 * 10_000_000)
    with pytest.raises(TouchError, match="10,000,000 faces"):
        checked_mesh(stl)


@pytest.mark.parametrize(
    ("name", "head", "size"),
    [
        ("comments.ply", b"ply\n" + b"comment scan\n" * 600 + b"element face 10000000\n", 20_000),
        ("comment.off", b"OFF # made by hand\n# 5 6\n5000000 10000000 0\n", 20_000),
        ("longer.stl", b" " * 80 + struct.pack("<I", 10_000_000), 86 + 50 * 10_000_000),
    ],
)
def test_faces_are_counted_whatever_stands_around_the_count(name, head, size, tmp_path):
    with (tmp_path / name).open("wb") as file:
        file.write(head)
        file.truncate(size)
    with pytest.raises(TouchError, match="10,000,000 faces; simplify it"):
        checked_mesh(tmp_path / name)


def test_a_binary_stl_that_is_cut_off_is_not_called_empty(tmp_path):
    path = tmp_path / "half.stl"
    path.write_bytes(BOX.export(file_type="stl")[: 84 + 50 * 7])
    with pytest.raises(TouchError, match="announces 12 faces, but it ends after 7"):
        checked_mesh(path)


def test_what_a_reader_says_of_a_file_is_one_short_line(tmp_path):
    path = tmp_path / "thing.off"
    path.write_bytes(b"OFF\n3 1 0\n" + b"\0" * 100_000 + b"\n")
    with pytest.raises(TouchError, match="can't be read as a mesh") as error:
        checked_mesh(path)
    assert len(str(error.value)) < 500 + len(str(path))
    assert "\n" not in str(error.value)


def test_the_faces_of_an_obj_are_counted_across_chunks(tmp_path):
    path = tmp_path / "huge.obj"
    path.write_bytes(b"v 0 0 0\n" * 3 + b"f 1 2 3\n" * (MAX_FACES + 1))
    with pytest.raises(TouchError, match="2,000,001 faces"):
        checked_mesh(path)


def test_nan_and_cut_off_files_are_refused(tmp_path):
    vertices = np.array(BOX.vertices)
    vertices[3, 1] = np.nan
    path = written(trimesh.Trimesh(vertices, BOX.faces, process=False), tmp_path)
    with pytest.raises(TouchError, match=r"thing\.ply: the mesh has vertices that are NaN"):
        checked_mesh(path)
    whole = BOX.export(file_type="ply")
    path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(TouchError, match=r"thing\.ply"):
        checked_mesh(path)


@pytest.mark.parametrize("content", [b"", b"ply\nformat ascii 1.0\nend_header\n", b"not a mesh"])
@pytest.mark.parametrize("name", ["thing.ply", "thing.obj", "thing.stl", "thing.off"])
def test_empty_and_foreign_files_are_refused(content, name, tmp_path):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(TouchError, match=r"thing\."):
        checked_mesh(tmp_path / name)


def test_what_is_no_mesh_file_is_named(tmp_path):
    with pytest.raises(TouchError, match="does not exist"):
        checked_mesh(tmp_path / "none.ply")
    with pytest.raises(TouchError, match=r"\.ply, \.obj, \.stl, \.off, got '\.step'"):
        checked_mesh(tmp_path / "thing.step")
    (tmp_path / "folder.ply").mkdir()
    with pytest.raises(TouchError, match="is a directory"):
        checked_mesh(tmp_path / "folder.ply")
