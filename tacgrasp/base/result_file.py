"""Files of results: whole or absent, and one line when the disk refuses one.

Not here: episodes (``tacgrasp.episodes.writer``), weights (``cltp.checkpoints``).
"""

from __future__ import annotations

from pathlib import Path

from cltp.atomic_write import write_atomically
from tacgrasp.base.errors import UsageError


def write_result(path: Path, text: str, *, flag: str = "--out") -> None:
    """Write a text all at once in the place of a file, or into a pipe or terminal.

    Args:
        path: Where to; a link is followed.
        text: The text.
        flag: Flag that named the path, for the message.

    Raises:
        UsageError: It can't be written.
    """
    try:
        if path.exists() and not path.is_file() and not path.is_dir():
            path.write_text(text, encoding="utf-8")
        else:
            write_atomically(path.resolve(), text)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise UsageError(f"{flag} {path} can't be written: {error.strerror or error}") from None
