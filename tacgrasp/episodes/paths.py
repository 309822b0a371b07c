"""Directory and names of episodes, and the error message when a disk refuses a file."""

from __future__ import annotations

import errno
import os
import re
import tempfile
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

from cltp.tactile.cloud import Stamp
from tacgrasp.episodes.errors import EpisodeError


def make_record_directory(path: Path) -> Path:
    """Create the directory ``path`` when it is missing, and check that it can be written to.

    Raises:
        EpisodeError: It can't be created, is not a directory, or is read-only.
    """
    check_record_directory(path)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise EpisodeError(refusal(path, "create", error)) from None
    return path


def check_record_directory(path: Path) -> None:
    """Check that episodes can be written into the directory ``path``; nothing is left behind.

    Raises:
        EpisodeError: It, or the directory that it would be made in, is none, is read-only, or takes
            no new entries, as ``/proc``.
    """
    nearest = next(each for each in (path, *path.absolute().parents) if each.exists())
    if not nearest.is_dir():
        raise EpisodeError(f"{nearest} is not a directory; give --record a directory for episodes")
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise EpisodeError(
            f"{nearest} is read-only; make it writable or give another directory with --record"
        )
    try:  # the file system itself may refuse, whatever the permissions say
        Path(tempfile.mkdtemp(prefix=".tacgrasp-", dir=nearest)).rmdir()
    except OSError as error:
        above = [each for each in (path, *path.absolute().parents) if not each.exists()]
        raise EpisodeError(refusal(above[-1] if above else path, "create", error)) from None


def episode_path(directory: Path, task: str, stamp: Stamp, seed: int | None) -> Path:
    """Path of a new episode, ``<task>-<UTC time>-<seed>.mcap``; without a seed the process's id."""
    started = datetime.fromtimestamp(stamp.wall_s, tz=UTC)
    time = f"{started:%Y%m%dT%H%M%S}.{started.microsecond // 1000:03d}Z"
    safe_task = re.sub(r"[^\w-]+", "-", task).strip("-") or "task"
    return directory / f"{safe_task}-{time}-{f'p{os.getpid()}' if seed is None else seed}.mcap"


def sync_directory(directory: Path) -> None:
    """Make the names of a directory's files durable; syncing a file saves only its content."""
    descriptor = os.open(directory, os.O_RDONLY)
    try:
        with suppress(OSError):  # some file systems can't sync a directory
            os.fsync(descriptor)
    finally:
        os.close(descriptor)


def refusal(path: Path, operation: str, error: OSError, *, flag: str = "--record") -> str:
    """Error message for a refused file operation: the operation, its reason, and a remedy.

    Args:
        path: The file.
        operation: What was tried (create, write).
        error: The refusal.
        flag: Flag that names another place.
    """
    known = {
        errno.ENOENT: ("its directory does not exist", f"create it or give another with {flag}"),
        errno.ENOTDIR: ("its parent is not a directory", f"give another directory with {flag}"),
        errno.EEXIST: ("the file exists", "episodes are never overwritten; give another name"),
        errno.ENOSPC: ("the disk is full", f"free space or write to another disk with {flag}"),
        errno.EDQUOT: ("the disk quota is used up", f"free space or give another {flag}"),
        errno.EFBIG: ("the file would exceed the size limit", "raise it (ulimit -f)"),
        errno.EISDIR: ("it is a folder", f"name a file with {flag}"),
        errno.EROFS: ("the file system is read-only", f"give another directory with {flag}"),
        errno.EACCES: ("permission denied", "make its directory writable or give another"),
    }
    if error.errno == errno.ENOENT and path.absolute().parent.exists():  # as of /proc
        known = {errno.ENOENT: (os.strerror(errno.ENOENT), f"give another directory with {flag}")}
    default = (error.strerror or str(error), "check the disk")
    reason, remedy = known.get(error.errno or 0, default)
    return f"can't {operation} {path}: {reason}; {remedy}"
