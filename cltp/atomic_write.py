"""Files and folders that are either whole or absent, whatever interrupts the writing."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replacing(path: Path, *, suffix: str = ".part") -> Iterator[Path]:
    """Give a temporary path beside ``path``; on success it is synced and takes ``path``'s place.

    Args:
        path: The file to write; its folder exists.
        suffix: Ending of the temporary name, for writers that go by it (``.part.png``).

    Raises:
        OSError: The file can't be written, or something stands there that is no regular file (a
            device would be replaced by it). What stood at ``path`` before still stands there, and
            the temporary file is removed, as after any other error.
    """
    if path.exists() and not path.is_file():
        code = errno.EISDIR if path.is_dir() else errno.EINVAL
        reason = "it is a folder" if path.is_dir() else "it is a device or pipe, not a file"
        raise OSError(code, reason, str(path))
    part = path.with_name(f"{path.name}.{os.getpid()}{suffix}")
    try:
        yield part
        with part.open("rb") as file:
            os.fsync(file.fileno())
        part.replace(path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write text (as UTF-8) or bytes in the place of any file before.

    Raises:
        OSError: As ``replacing``.
    """
    with replacing(path) as part:
        part.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)


@contextmanager
def new_folder(folder: Path) -> Iterator[Path]:
    """Give an empty temporary folder beside ``folder``; on success it becomes ``folder``.

    Its name is ``folder``'s with a dot before and ``.part`` behind it, which nobody else's folder
    has; what an earlier writing that was killed left there is removed first. One process alone may
    write a folder at a time.

    Args:
        folder: The folder to write, which does not exist yet; its parents are created.

    Raises:
        OSError: It can't be written. The temporary folder is removed, as after any other error.
    """
    part = folder.with_name(f".{folder.name}.part")
    shutil.rmtree(part, ignore_errors=True)
    try:
        part.mkdir(parents=True)
        yield part
        part.rename(folder)
    except BaseException:
        shutil.rmtree(part, ignore_errors=True)
        raise


def copy_files(source: Path, folder: Path) -> None:
    """Copy all files and folders in ``source`` into the folder ``folder``.

    Raises:
        OSError: The first one that can't be read or written, whose path the error names.
    """
    for path in sorted(source.rglob("*")):  # a folder comes before its files
        target = folder / path.relative_to(source)
        if path.is_dir():
            target.mkdir()
            continue
        with path.open("rb") as source_file:
            try:
                with replacing(target) as part, part.open("wb") as target_file:
                    shutil.copyfileobj(source_file, target_file)
            except OSError as error:  # of a full disk, it names no file
                raise OSError(error.errno, error.strerror, str(target)) from None


def copy_folder(source: Path, folder: Path) -> None:
    """Copy a folder to a place where none is yet; the copy is whole or absent.

    Raises:
        OSError: As ``new_folder`` and ``copy_files``.
    """
    with new_folder(folder) as part:
        copy_files(source, part)
