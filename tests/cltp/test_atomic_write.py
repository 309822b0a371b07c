"""A file or folder is whole or absent, and what stood there before survives a failed write."""

import errno
import shutil
from pathlib import Path

import pytest

from cltp.atomic_write import copy_folder, new_folder, replacing, write_atomically


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


@pytest.fixture
def source(tmp_path: Path) -> Path:
    folder = tmp_path / "source"
    (folder / "below").mkdir(parents=True)
    (folder / "a.bin").write_bytes(b"\x00\xff")
    (folder / "below" / "b.txt").write_text("b")
    return folder


def test_a_folder_is_copied_with_all_that_lies_in_it(source: Path, tmp_path: Path) -> None:
    copy_folder(source, tmp_path / "new" / "copy")
    copied = tmp_path / "new" / "copy"
    assert (copied / "a.bin").read_bytes() == b"\x00\xff"
    assert (copied / "below" / "b.txt").read_text() == "b"
    assert list((tmp_path / "new").iterdir()) == [copied]


def test_what_a_killed_copy_left_is_no_part_of_the_next(source: Path, tmp_path: Path) -> None:
    left = tmp_path / ".copy.part"
    left.mkdir()
    (left / "old.bin").write_bytes(b"half")
    copy_folder(source, tmp_path / "copy")
    assert not left.exists()
    assert sorted(path.name for path in (tmp_path / "copy").iterdir()) == ["a.bin", "below"]


@pytest.mark.parametrize("error", [OSError("no space left"), KeyboardInterrupt()])
def test_a_folder_that_is_cut_short_is_absent(tmp_path: Path, error: BaseException) -> None:
    with pytest.raises(type(error)), new_folder(tmp_path / "copy") as part:
        (part / "half").write_text("half")
        raise error
    assert not list(tmp_path.iterdir())


def test_a_full_disk_names_the_file_that_found_no_space(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(shutil, "copyfileobj", full)
    with pytest.raises(OSError, match="No space left on device") as caught:
        copy_folder(source, tmp_path / "copy")
    assert caught.value.errno == errno.ENOSPC
    assert caught.value.filename == str(tmp_path / ".copy.part" / "a.bin")
    assert list(tmp_path.iterdir()) == [source]
