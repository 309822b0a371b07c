"""Files of results: whole or absent, never in the place of a file of another kind.

Not here: episodes (``tacgrasp.episodes.writer``), weights (``cltp.checkpoints``).
"""

from __future__ import annotations

from pathlib import Path

from cltp.atomic_write import write_atomically
from tacgrasp.base.errors import UsageError


def check_ending(path: Path, *endings: str, flag: str = "--out") -> None:
    """Check that a result goes to a file of its own kind, so that it replaces no other.

    Args:
        path: Where to; a link is followed. A pipe, a terminal or a folder passes.
        *endings: The endings of the kind, with their dot, in small letters.
        flag: Flag that named the path, for the message.

    Raises:
        UsageError: The path ends otherwise.
    """
    if path.exists() and not path.is_file():
        return
    if path.resolve().suffix.lower() not in endings:
        raise UsageError(f"{flag} expects a file ending in {' or '.join(endings)}, got {path}")


def check_kept(path: Path, *, overwrite: bool) -> None:
    """Refuse to write over a file that took somebody a measurement, before the next one begins.

    Raises:
        UsageError: The file exists, and may not be replaced.
    """
    if path.exists() and not overwrite:
        raise UsageError(
            f"{path} exists and is kept; give --overwrite to replace it, or another file by --out"
        )


def write_result(path: Path, text: str, *, flag: str = "--json", ending: str = ".json") -> None:
    """Write a text all at once in the place of a file of its kind, or into a pipe or terminal.

    Args:
        path: Where to; a link is followed.
        text: The text.
        flag: Flag that named the path, for the message.
        ending: Ending of the file's name.

    Raises:
        UsageError: It can't be written, or has another ending.
    """
    check_ending(path, ending, flag=flag)
    try:
        if path.exists() and not path.is_file() and not path.is_dir():
            path.write_text(text, encoding="utf-8")
        else:
            write_atomically(path.resolve(), text)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise UsageError(f"{flag} {path} can't be written: {error.strerror or error}") from None
