"""A file is whole or absent, and what stood there before survives a failed write."""

from pathlib import Path

import pytest

from cltp.atomic_write import replacing, write_atomically


def test_text_and_bytes_take_the_place_of_a_file(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    write_atomically(path, "first")
    write_atomically(path, "zweites ß")
    assert path.read_text(encoding="utf-8") == "zweites ß"
    write_atomically(path, b"\x00\xff")
    assert path.read_bytes() == b"\x00\xff"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("error", [OSError("no space left"), KeyboardInterrupt()])
def test_a_write_that_is_cut_short_leaves_the_old_file_and_no_rest(
    tmp_path: Path, error: BaseException
) -> None:
    path = tmp_path / "a.txt"
    write_atomically(path, "old")
    with pytest.raises(type(error)), replacing(path) as part:
        part.write_text("half")
        raise error
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_the_temporary_name_can_carry_a_suffix(tmp_path: Path) -> None:
    with replacing(tmp_path / "a.png", suffix=".part.png") as part:
        assert part.suffix == ".png"
        assert part.parent == tmp_path
        part.write_bytes(b"x")
