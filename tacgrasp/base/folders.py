"""Refuse a folder that can't be one, before any work begins.

Not here: whether what lies in a folder may be replaced or mixed with (its writer).
"""

from __future__ import annotations

from pathlib import Path

from tacgrasp.base.errors import UsageError


def check_folder(folder: Path, flag: str) -> None:
    """Refuse a folder to write that is a file, or would lie in one; nothing is created.

    Args:
        folder: The folder, which need not exist.
        flag: What named it, for the message.

    Raises:
        UsageError: It, or the nearest thing above it that exists, is no folder.
    """
    nearest = next(each for each in (folder, *folder.absolute().parents) if each.exists())
    if not nearest.is_dir():
        below = "" if nearest == folder else f": {nearest}"
        raise UsageError(
            f"{flag} {folder}{below} is a file, not a folder; name a new folder or an existing one"
        )
