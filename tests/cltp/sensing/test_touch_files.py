"""Clouds and height maps from files, and one clear error for every kind of bad file."""

from __future__ import annotations

import io
import re
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from cltp import TouchError
from cltp.sensing.touch_files import read_cloud
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.sensors import sensor_named

MINI = sensor_named("gelsight_mini")


def points() -> NDArray[np.float64]:
    """A 16 × 16 grid over most of the field, pressed in its middle."""
    y, x = np.mgrid[-7:7:16j, -9:9:16j]
    z = 0.5 * np.exp(-(x**2 + y**2) / 8)
    return np.stack([x, y, z], axis=-1).reshape(-1, 3)


def ply(order: str, vertices: NDArray[np.float64], extra: str = "") -> bytes:
    head = (
        f"ply\nformat {order} 1.0\ncomment made here\nelement vertex {len(vertices)}\n"
        f"property float x\nproperty uchar red\nproperty double y\nproperty float z\n{extra}"
        "end_header\n"
    ).encode()
    if order == "ascii":
        return head + "".join(f"{x} 7 {y} {z}\n" for x, y, z in vertices).encode()
    sign = "<" if "little" in order else ">"
    return head + b"".join(struct.pack(f"{sign}fBdf", x, 7, y, z) for x, y, z in vertices)


def pcd(coding: str, vertices: NDArray[np.float64]) -> bytes:
    head = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z normal\nSIZE 4 4 4 4\nTYPE F F F F\n"
        f"COUNT 1 1 1 3\nWIDTH {len(vertices)}\nHEIGHT 1\nPOINTS {len(vertices)}\nDATA {coding}\n"
    ).encode()
    if coding == "ascii":
        return head + "".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in vertices).encode()
    return head + b"".join(struct.pack("<6f", x, y, z, 0, 0, 1) for x, y, z in vertices)


def xyz(vertices: NDArray[np.float64]) -> bytes:
    return b"# x y z\n" + "".join(f"{x}, {y}, {z}\n" for x, y, z in vertices).encode()


def npy_header(kind: str, shape: tuple[int, ...]) -> bytes:
    """A .npy file without its numbers."""
    file = io.BytesIO()
    head = {"descr": kind, "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(file, head)
    return file.getvalue()


def npz(files: dict[str, bytes], compression: int = zipfile.ZIP_DEFLATED) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", compression, compresslevel=1) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return file.getvalue()


def encrypted(archive: bytes) -> bytes:
    """The same archive with the flag of encryption on its first file, in both headers."""
    data = bytearray(archive)
    data[6] |= 1
    data[archive.index(b"PK\x01\x02") + 8] |= 1
    return bytes(data)


def damaged(archive: bytes) -> bytes:
    """The same archive with the start of its first compressed stream overwritten."""
    start = 30 + len("a.npy")
    return archive[:start] + b"\xff\xff\xff\xff" + archive[start + 4 :]


CLOUDS = {
    "ascii.ply": ply("ascii", points(), "element face 1\nproperty list uchar int i\n"),
    "little.ply": ply("binary_little_endian", points()),
    "big.ply": ply("binary_big_endian", points()),
    "ascii.pcd": pcd("ascii", points()),
    "binary.pcd": pcd("binary", points()),
    "rows.xyz": xyz(points()),
}


@pytest.mark.parametrize("name", CLOUDS)
def test_the_same_cloud_is_read_from_every_format(name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(CLOUDS[name])
    np.testing.assert_allclose(read_cloud(path, MINI).points_mm, points(), atol=1e-5)


def test_a_cloud_is_read_from_npy_and_npz(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", points())
    np.savez(tmp_path / "a.npz", points_mm=points(), other=np.zeros(3))
    for name in ("a.npy", "a.npz"):
        np.testing.assert_allclose(read_cloud(tmp_path / name, MINI).points_mm, points(), atol=1e-6)


def test_a_height_map_becomes_1024_points_with_row_0_at_the_top(tmp_path: Path) -> None:
    heights = np.zeros((240, 320))
    heights[:120] = 0.5  # the upper half is pressed
    np.save(tmp_path / "h.npy", heights)
    cloud = read_cloud(tmp_path / "h.npy", MINI)
    assert cloud.points_mm.shape == (1024, 3)
    upper = cloud.points_mm[:, 1] > 0.3
    np.testing.assert_allclose(cloud.points_mm[upper, 2], 0.5)
    np.testing.assert_allclose(cloud.points_mm[cloud.points_mm[:, 1] < -0.3, 2], 0.0)


@pytest.mark.parametrize("name", ["h.npy", "c.npy"])
@pytest.mark.parametrize("option", ["background", "calibration"])
def test_what_a_frame_alone_needs_is_refused_with_another_file(
    name: str, option: str, tmp_path: Path
) -> None:
    np.save(tmp_path / name, np.zeros((240, 320)) if name == "h.npy" else points())
    with pytest.raises(
        TouchError, match=rf"--{option} no\.png is for a camera's frame .* leave it"
    ):
        read_cloud(tmp_path / name, MINI, **{option: Path("no.png")})


def touch_error(path: Path) -> str:
    with pytest.raises(TouchError) as caught:
        read_cloud(path, MINI)
    message = str(caught.value)
    assert path.name in message
    assert "\n" not in message
    return message


BAD_FILES: dict[str, tuple[bytes, str]] = {
    "empty.ply": (b"", "empty"),
    "foreign.ply": (b"solid teapot", "expected a PLY"),
    "cut.ply": (CLOUDS["little.ply"][:-5], "truncated"),
    "cut_text.ply": (b"".join(CLOUDS["ascii.ply"].splitlines(True)[:-3]), "truncated"),
    "no_z.ply": (CLOUDS["little.ply"].replace(b"float z", b"float w"), "fields x, y and z"),
    "no_points.ply": (ply("ascii", np.zeros((0, 3))), "empty"),
    "faces_first.ply": (b"ply\nformat ascii 1.0\nelement face 1\nend_header\n", "vertices first"),
    "words.ply": (ply("ascii", points()).replace(b" 7 ", b" seven "), "numbers in a row"),
    "foreign.pcd": (b"not a cloud\n", "expected a PCD"),
    "packed.pcd": (pcd("binary_compressed", points()), "save it as binary"),
    "cut.pcd": (CLOUDS["binary.pcd"][:-1], "truncated"),
    "header.pcd": (pcd("ascii", points()).replace(b"SIZE 4 4 4 4", b"SIZE 4 4"), "fit together"),
    "words.xyz": (b"left right up\n", "three numbers"),
    "two.xyz": (b"1 2\n3 4\n", "three numbers"),
    "comment.xyz": (b"# nothing\n", "empty"),
    "binary.xyz": (b"\xff\xfe\x00\x9f", "binary data"),
    "foreign.npy": (b"hello", "not a whole .npy"),
    "foreign.npz": (b"hello", "not a whole .npz"),
    "header.npy": (b"\x93NUMPY\x01\x00\x0e\x00{'descr': '<f4'", "not a whole .npy"),
    "archive.npy": (b"PK\x03\x04 of something", "not a whole .npy"),
    "squared.ply": (ply("ascii", points()).replace(b"vertex ", b"vertex \xc2\xb2"), "a number of"),
    "digits.ply": (ply("ascii", points()).replace(b"vertex ", b"vertex " + b"9" * 5000), "number"),
    "float8.pcd": (pcd("ascii", points()).replace(b"SIZE 4", b"SIZE 1"), "read the PCD field 'x'"),
    "wide.pcd": (
        pcd("ascii", points()).replace(b"COUNT 1 1 1 3", b"COUNT 1 1 1 99999999999999"),
        "COUNT of 99999999999999; at most 1000 are read",
    ),
    "allocates.pcd": (
        pcd("binary", points()).replace(b"COUNT 1 1 1 3", b"COUNT 1 1 1 300000000"),
        "COUNT of 300000000; at most 1000 are read",
    ),
    "fields.pcd": (
        pcd("binary", points()).replace(b"COUNT 1 1 1 3", b"COUNT 1 999 999 999"),
        "at most 1000 are read",
    ),
    "points.ply": (
        ply("binary_little_endian", points()).replace(b"vertex 256", b"vertex 999999999"),
        "number of points of 999999999; at most 2000000 are read",
    ),
    "property.ply": (
        ply("ascii", points()).replace(b"property float x", b"property"),
        "can't read the vertex property",
    ),
    "long.xyz": (b"1 2 3\n" * 3_000_000, "at most 16000000 are read"),
    "huge.npy": (npy_header("<f8", (1_200_000_000, 1)), "at most 8000000 numbers are read"),
    "many.npy": (npy_header("<f8", (10**30, 0)), "at most 8000000 numbers are read"),
    "keys.npy": (npy_header("<f8", (3, 3)).replace(b"'descr'", b"'d scr'"), "not a whole .npy"),
    "words.npy": (npy_header("<f8", (3, 3)).replace(b"(3, 3)", b"(3, x)"), "not a whole .npy"),
    "grows.npz": (
        npz({"a.npy": npy_header("<f8", (30_000, 10_000)) + bytes(50_000_000)}),
        "at most 8000000 numbers are read",
    ),
    "padded.npz": (
        npz({"a.npy": npy_header("<f8", (256, 3)) + bytes(300_000_000)}),
        "lie at one place",  # what follows the array is never unpacked
    ),
    "encrypted.npz": (encrypted(npz({"a.npy": npy_header("<f8", (3, 3))})), "encrypted"),
    "zlib.npz": (damaged(npz({"a.npy": npy_header("<f8", (3, 3)) * 9})), "not a whole .npz"),
    "lzma.npz": (npz({"a.npy": b""}, zipfile.ZIP_LZMA), "neither stored nor deflated"),
    "arrays.npz": (npz({f"{n}.npy": b"" for n in range(1001)}), "more than 1000"),
    "photo.tiff": (b"II*\0", "expected a file ending in"),
    "photo.jpg": (b"\xff\xd8", "not an image"),
    "few.xyz": (xyz(points()[:10]), "at least 64"),
    "metres.xyz": (xyz(points() / 1000), "in metres"),
    "depths in metres.xyz": (
        "\n".join(f"{x:.3f} {y:.3f} {z / 1000:.7f}" for x, y, z in points()).encode(),
        "is it in metres",
    ),
    "nan.xyz": (xyz(np.where(points() > 0.49, np.nan, points())), "NaN"),
    "elsewhere.xyz": (xyz(points() + np.array([30, 0, 0])), "beyond the sensing area"),
}


@pytest.mark.parametrize("name", BAD_FILES)
def test_a_bad_file_is_refused_in_one_line_that_names_it(name: str, tmp_path: Path) -> None:
    content, expected = BAD_FILES[name]
    path = tmp_path / name
    path.write_bytes(content)
    assert re.search(expected, touch_error(path))


def test_a_missing_file_and_a_directory_are_refused(tmp_path: Path) -> None:
    assert "does not exist" in touch_error(tmp_path / "missing.ply")
    (tmp_path / "folder.ply").mkdir()
    assert "is a directory" in touch_error(tmp_path / "folder.ply")
    assert "is a directory" in touch_error(tmp_path)


def test_a_truncated_npy_is_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", points())
    whole = (tmp_path / "a.npy").read_bytes()
    (tmp_path / "a.npy").write_bytes(whole[: len(whole) // 2])
    assert "not a whole .npy" in touch_error(tmp_path / "a.npy")


@pytest.mark.parametrize(
    ("array", "expected"),
    [
        (np.zeros((320, 240)), "doesn't fit"),  # transposed
        (np.zeros((24, 32, 3)), "shape"),
        (np.array(["a", "b"]), "real numbers"),
        (np.full((240, 320), np.nan), "NaN"),
        (np.linspace(0, 0.0009, 240 * 320).reshape(240, 320), "in metres"),
        (np.full((240, 320), 20.0), "more than"),
        (np.array([{"a": 1}]), "real numbers"),
    ],
)
def test_an_array_that_is_no_touch_is_refused(
    array: NDArray[np.generic], expected: str, tmp_path: Path
) -> None:
    np.save(tmp_path / "a.npy", array, allow_pickle=True)
    assert re.search(expected, touch_error(tmp_path / "a.npy"))


def test_an_npz_with_two_unnamed_arrays_is_refused(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", one=points(), two=points())
    assert "one, two" in touch_error(tmp_path / "a.npz")


def test_reading_gives_a_tactile_cloud_without_a_clock(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", points())
    cloud = read_cloud(tmp_path / "a.npy", MINI)
    assert isinstance(cloud, TactileCloud)
    assert cloud.stamp is None


@pytest.mark.parametrize("name", ["points", "points_mm"])
def test_points_of_another_shape_are_told_as_a_cloud(name: str, tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", **{name: np.zeros((5, 2))})
    with pytest.raises(TouchError, match=rf"{name} is a cloud .* shape \(N, 3\), got \(5, 2\)"):
        read_cloud(tmp_path / "a.npz", MINI)


def test_an_array_of_few_columns_may_be_meant_as_a_cloud(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", np.zeros((5, 2)))
    with pytest.raises(TouchError, match=r"a cloud needs shape \(N, 3\)"):
        read_cloud(tmp_path / "a.npy", MINI)
    np.save(tmp_path / "b.npy", np.zeros((320, 240)))
    with pytest.raises(TouchError, match="doesn't fit") as caught:
        read_cloud(tmp_path / "b.npy", MINI)
    assert "cloud" not in str(caught.value)
