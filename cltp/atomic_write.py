"""Files that are either whole or absent, whatever interrupts the writing."""

from __future__ import annotations

import errno
import os
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
